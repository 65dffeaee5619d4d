"""Ways to get config.yaml wrong, as hypothesis strategies of whole files."""

import copy
import json
import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import yaml
from hypothesis import strategies as st

from tests.workflow.conftest import ROOT

SHIPPED = (ROOT / "config.yaml").read_text(encoding="utf-8")
LINES = SHIPPED.splitlines()
CONFIG: dict[str, Any] = yaml.safe_load(SHIPPED)
NAMES = [
    "../x", "/etc/x", "a/b", "..", ".", "", "~", "a b", "a; touch pwned", "$(touch pwned)",
    "`touch pwned`", "a|b", "a&b", "a>pwned", "a\ntouch pwned", "a\n", "a\0b", "{wildcard}",
    "{input}", "{{x}}", "%(x)s", "*", "?", "-rf", "--config", "A", "\uff41", "\u0430bc", "a\u200bb",
    "é", "a" * 20, "a" * 42, "a" * 5000, "con.", "a.nc", "<b>", "a'b", 'a"b', "a\\b", "\ud800",
    "\u202eabc", 7, None, True, ["a"], {"a": 1},
]  # fmt: skip
TEXTS = [*NAMES, "<script>alert(1)</script>", "&lt;", "$x^2$", "{rule}", "{{ config }}", "a" * 121]
VALUES: list[Any] = [
    None, True, False, "", "x", "30", "nan", [], {}, [1], {"a": 1}, [[]], 0, -1, 1, 2, 3, 1.5,
    400.0, -0.0, 1e-300, 5e-324, 1e300, 10**30, -(10**30), 10**400, math.nan, math.inf, -math.inf,
    "a" * 10_000, list(range(1000)), "🜚", "\u202e", "../x", "{input}", "$(touch pwned)",
]  # fmt: skip
EXTRA_KEYS = ["extra", "Radial", "rad\u0131al", "a b", "", "{input}", "pathvars", "__use_yte__",
              "a\nb", "🜚", "x" * 10_000, "../x", "__class__", "$ref"]  # fmt: skip
# In place of the value on a line; YAML reads none of them as what it looks like, or not at all.
SCALARS = [
    "010", "0o17", "0x1F", "0b11", "1_000", "1:30", "190:20:30", "yes", "no", "on", "Off", "true",
    "~", "2026-01-01", "2026-01-01 10:00:00", "1e3", "1e-3", "1E5", ".nan", ".inf", "-.INF", "'30'",
    '"30"', "!!float '3'", "!!python/object/apply:os.system ['touch pwned']",
    "!!python/name:os.system", "!!python/object/new:os.system ['touch pwned']", "!local 3",
    "!!binary aGk=", "!!set {a}", "&a 3", "*a", "=", "<<", "@x", "`touch pwned`", "%x", "|", ">",
    "? x", "- 1", "{", "[", "}", "]", "{}", "[]", "\t3", "3\t", "3 # four", "3 4", "3,4", "+3",
    "3.", ".5", "00", "-", "--- 3", '"\\x00"', '"\\ud800"', "!!str 3", "0" * 50, "9" * 5000, "'",
    '"', "3: 4", "?__import__('os').system('touch pwned')",
]  # fmt: skip


@dataclass(frozen=True)
class Mutation:
    """A configuration file.

    Attributes
    ----------
    kind : str
        A key of :data:`KINDS`.
    content : bytes
        The file.
    section : str or None
        Section of the configuration that a refusal must name, None where there are several.
    line : int or None
        The line it must name, where it is one of the file's form.
    """

    kind: str
    content: bytes
    section: str | None = None
    line: int | None = None


def _paths(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    pairs = value.items() if isinstance(value, dict) else enumerate(value)
    found = []
    for key, item in pairs:
        found.append((*path, key))
        if isinstance(item, dict | list):
            found += _paths(item, (*path, key))
    return found


def _get(config: Any, path: tuple[Any, ...]) -> Any:
    for key in path:
        config = config[key]
    return config


PATHS = _paths(CONFIG)
NUMBERS = [path for path in PATHS if isinstance(_get(CONFIG, path), int | float)]
MAPPINGS = [path for path in PATHS if isinstance(_get(CONFIG, path), dict)]
LISTS = [path for path in PATHS if isinstance(_get(CONFIG, path), list)]
SCALAR_LINES = [
    index for index, line in enumerate(LINES) if re.match(r" *(- )?\w+: [^\[{#\s]+( #.*)?$", line)
]


def _dump(config: Any) -> bytes:
    text: str = yaml.safe_dump(config, sort_keys=False, allow_unicode=True, width=10_000)
    return text.encode("utf-8", "surrogatepass")


def _changed(
    kind: str, path: tuple[Any, ...], change: Callable[[Any, Any], None], *, sure: bool = True
) -> Mutation:
    """Apply change(container, key) to a copy; ``sure`` if only that section can be named."""
    config = copy.deepcopy(CONFIG)
    change(_get(config, path[:-1]), path[-1])
    return Mutation(kind, _dump(config), str(path[0]) if sure else None)


@st.composite
def _value(draw: st.DrawFn) -> Mutation:
    """Any value in any place."""
    path, value = draw(st.sampled_from(PATHS)), draw(st.sampled_from(VALUES))
    return _changed("value", path, lambda at, key: at.__setitem__(key, value), sure=False)


@st.composite
def _number(draw: st.DrawFn) -> Mutation:
    """Another number, near or far."""
    path = draw(st.sampled_from(NUMBERS))
    old = _get(CONFIG, path)
    near = st.sampled_from([old + 1, old - 1, old * 2, old / 2, old * 1.01, -old, float(old)])
    far = st.floats() | st.integers(-(10**20), 10**20) | st.floats(0, 100) | st.integers(0, 1000)
    new = draw(near | far)
    return _changed("number", path, lambda at, key: at.__setitem__(key, new), sure=False)


@st.composite
def _missing(draw: st.DrawFn) -> Mutation:
    path = draw(st.sampled_from([path for path in PATHS if isinstance(path[-1], str)]))
    found = _changed("missing", path, lambda at, key: at.pop(key))
    return found if len(path) > 1 else Mutation("missing", found.content)


@st.composite
def _extra(draw: st.DrawFn) -> Mutation:
    path = draw(st.sampled_from([*MAPPINGS, ()]))
    key = draw(st.sampled_from(EXTRA_KEYS) | st.text(max_size=20))
    value = draw(st.sampled_from(VALUES[:12]))
    config = copy.deepcopy(CONFIG)
    _get(config, path)[key] = value
    return Mutation("extra", _dump(config))


@st.composite
def _length(draw: st.DrawFn) -> Mutation:
    """A list that is empty, cut, doubled, reversed, or very long."""
    path = draw(st.sampled_from(LISTS))
    old = _get(CONFIG, path)
    new = draw(st.sampled_from([[], old[:1], old + old, old[::-1], old * 1000]))
    return _changed("length", path, lambda at, key: at.__setitem__(key, new), sure=False)


@st.composite
def _text_in_a_case(draw: st.DrawFn) -> Mutation:
    key = draw(st.sampled_from(["name", "description"]))
    text = draw(st.sampled_from(NAMES if key == "name" else TEXTS) | st.text(max_size=130))
    return _changed("text", ("cases", 0, key), lambda at, key: at.__setitem__(key, text))


@st.composite
def _scalar(draw: st.DrawFn) -> Mutation:
    """What YAML reads otherwise than it looks, in place of the value on a line."""
    index = draw(st.sampled_from(SCALAR_LINES))
    start = re.match(r" *(- )?\w+: ", LINES[index])
    assert start is not None
    new = start[0] + draw(st.sampled_from(SCALARS))
    return Mutation("scalar", _lines({index: new}))


def _lines(changed: dict[int, str]) -> bytes:
    return "\n".join(changed.get(i, line) for i, line in enumerate([*LINES, ""])).encode()


@st.composite
def _repeated(draw: st.DrawFn) -> Mutation:
    """A key for the second time, with another value."""
    index = draw(st.sampled_from([i for i in SCALAR_LINES if "- " not in LINES[i]]))
    again = re.sub(r": .*", ": 1", LINES[index])
    return Mutation("repeated", _lines({index: f"{LINES[index]}\n{again}"}), line=index + 2)


@st.composite
def _indented(draw: st.DrawFn) -> Mutation:
    """A line with a tab, another indentation, or none of its colon."""
    index = draw(st.sampled_from(SCALAR_LINES))
    line = LINES[index]
    new = [f"\t{line}", f" {line}", line.lstrip(), line.replace(":", ""), line.replace(": ", ":")]
    return Mutation("indented", _lines({index: draw(st.sampled_from(new))}))


@st.composite
def _cut(draw: st.DrawFn) -> Mutation:
    """The file up to some byte."""
    return Mutation("cut", SHIPPED.encode()[: draw(st.sampled_from(range(len(SHIPPED))))])


@st.composite
def _flipped(draw: st.DrawFn) -> Mutation:
    """Another byte in one place."""
    content = bytearray(SHIPPED.encode())
    content[draw(st.sampled_from(range(len(content))))] = draw(st.sampled_from(range(256)))
    return Mutation("flipped", bytes(content))


@st.composite
def _binary(draw: st.DrawFn) -> Mutation:
    return Mutation("binary", draw(st.binary(max_size=200) | st.text(max_size=200).map(_encoded)))


def _encoded(text: str) -> bytes:
    return text.encode("utf-8", "surrogatepass")


def _bomb(anchor: str, item: str) -> str:
    """Nine levels of nine aliases each: 4e8 values in 500 bytes."""
    lines = [f"{anchor}0: &{anchor}0 [{item}]"]
    for level in range(1, 10):
        aliases = ", ".join([f"*{anchor}{level - 1}"] * 9)
        lines.append(f"{anchor}{level}: &{anchor}{level} [{aliases}]")
    return "\n".join(lines)


_MERGES = "\n".join(
    ["m0: &m0 {a: 1}"]
    + [f"m{i}: &m{i} {{<<: [{', '.join([f'*m{i - 1}'] * 9)}]}}" for i in range(1, 10)]
)
_YTE = "__use_yte__: true\nfig_1_1: ?__import__('os').system('touch pwned')\n"
FILES = {
    "empty": "", "spaces": " \n \n", "comment": "# nothing\n", "null": "null", "number": "5",
    "word": "config", "list": "- 1\n- 2\n", "two documents": f"{SHIPPED}---\n{SHIPPED}",
    "end and more": f"{SHIPPED}...\n5\n", "document start": f"---\n{SHIPPED}",
    "directive": f"%YAML 1.1\n---\n{SHIPPED}",
    "strange directive": f"%TAG ! tag:x,2000:\n---\n{SHIPPED}",
    "byte order mark": f"\ufeff{SHIPPED}", "bomb": f"{SHIPPED}{_bomb('b', 'lol')}\n",
    "bomb of merges": f"{SHIPPED}{_MERGES}\n", "cycle": f"{SHIPPED}cycle: &c [*c]\n",
    "cycle of mappings": f"{SHIPPED}cycle: &c {{a: *c}}\n",
    "merge key": SHIPPED.replace("fig_1_1:\n", "fig_1_1:\n  <<: {theta_deg: 20}\n", 1),
    "anchors": SHIPPED.replace("fig_1_1:", "fig_1_1: &a", 1),
    "deep list": "a: " + "[" * 5000 + "]" * 5000,
    "deep mapping": "a: " + "{a: " * 3000 + "1" + "}" * 3000,
    "deep block": "\n".join(" " * i + "a:" for i in range(500)), "open brackets": "[" * 50_000,
    "long": SHIPPED + "#" * 2_000_000, "many keys": "\n".join(f"k{i}: 1" for i in range(100_000)),
    "yte": _YTE, "yte after all": SHIPPED + "__use_yte__: yes\n",
    "quoted yte": SHIPPED + '"__use_yte__": "x"\n',
    "yte in JSON": '{"__use_yte__": true, "?import os": 1}',
    "object": '!!python/object/apply:os.system ["touch pwned"]',
    "key of lists": f"{SHIPPED}? [a, b]\n: 1\n", "key of mappings": f"{SHIPPED}? {{a: b}}\n: 1\n",
    "null key": f"{SHIPPED}~: 1\n", "number key": f"{SHIPPED}5: 1\n",
    "date key": f"{SHIPPED}2026-01-01: 1\n", "truth key": f"{SHIPPED}yes: 1\n",
    "pathvars": f"{SHIPPED}pathvars: 5\n", "JSON": json.dumps(CONFIG),
    "JSON twice": '{"a": 1, "a": 2}', "deep JSON": '{"a":' * 5000 + "1" + "}" * 5000,
    "JSON NaN": json.dumps({**CONFIG, "fig_1_1": math.nan}),
    "huge JSON number": '{"fig_1_1": ' + "9" * 10_000 + "}",
    "carriage returns": SHIPPED.replace("\n", "\r"), "Windows": SHIPPED.replace("\n", "\r\n"),
    "line separators": SHIPPED.replace("\n", "\u2028"), "null byte": SHIPPED + "\0",
    "no-break spaces": SHIPPED.replace("  ", "\u00a0\u00a0"),
}  # fmt: skip
BYTES = {
    "UTF-16": SHIPPED.encode("utf-16"),
    "Latin-1": SHIPPED.replace("steel", "ståhl").encode("latin-1"),
    "half a character": SHIPPED.encode() + b"# \xe2\x82", "zeros": b"\0" * 1000,
    "gzip": b"\x1f\x8b\x08\0" * 9,
}  # fmt: skip
WHOLE = [
    Mutation(f"file: {name}", content)
    for name, content in [*((name, text.encode()) for name, text in FILES.items()), *BYTES.items()]
]
KINDS: dict[str, st.SearchStrategy[Mutation]] = {
    "value": _value(), "number": _number(), "missing": _missing(), "extra": _extra(),
    "length": _length(), "text": _text_in_a_case(), "scalar": _scalar(), "repeated": _repeated(),
    "indented": _indented(), "cut": _cut(), "flipped": _flipped(), "binary": _binary(),
}  # fmt: skip
