"""What the pages of the site are made from, without Sphinx."""

import argparse
import ast
import doctest
import re
import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace

import pytest
import yaml

import hopper
from hopper_workflow import entries
from hopper_cli import main
from hopper_workflow.site import docstrings, gallery, notebooks, reference, texts, works
from hopper_workflow.site.source import SiteError, Source
from tests.site.conftest import ENVIRONMENT, ROOT

THEORY = (ROOT / "docs/site/theory.md").read_text(encoding="utf-8")
FUNCTIONS = (ROOT / "docs/site/functions.md").read_text(encoding="utf-8")
EXAMPLES = [
    path for path in sorted((ROOT / "src").rglob("*.py")) if ">>> " in path.read_text("utf-8")
]
MADE_LATER = ("configuration.md", "command.md", "glossary.md", "references.md")
NOTEBOOKS = sorted((ROOT / "docs/notebooks").glob("*.py"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebooks_run_and_show_something(path: Path):
    done = notebooks.run(path)
    assert done[0][0].content.startswith("# "), "a notebook begins with its title"
    assert any(output.printed for _, output in done)
    assert any(output.figures for _, output in done)


def test_a_cell_that_fails_is_named(tmp_path: Path):
    path = tmp_path / "broken.py"
    path.write_text("# %% [markdown]\n# # Broken\n\n# %%\nx = 1\n\n# %%\nx / 0\n")
    with pytest.raises(SiteError, match=r"broken[.]py, cell at line 8: ZeroDivisionError"):
        notebooks.run(path)


def test_a_notebook_is_run_again_only_if_it_or_code_changed(tmp_path: Path):
    (tmp_path / "src").mkdir()
    module = tmp_path / "src/module.py"
    module.write_text('"""Some words."""\n\ndef f():\n    """Say one."""\n    return 1\n')
    (tmp_path / "docs/notebooks").mkdir(parents=True)
    path = tmp_path / "docs/notebooks/one.py"
    path.write_text("# %% [markdown]\n# # One\n\n# %%\nprint(6 * 7)\n")
    source = Source(tmp_path / "source")
    notebooks.write(source, tmp_path, tmp_path / "kept")
    page = tmp_path / "kept/one/one.md"
    assert "```text\n42\n```" in page.read_text()
    before = page.stat().st_mtime_ns
    module.write_text(module.read_text().replace("words.", "other\nwords.").replace("Say", "Give"))
    notebooks.write(source, tmp_path, tmp_path / "kept")
    assert page.stat().st_mtime_ns == before
    module.write_text(module.read_text().replace("return 1", "return 2"))
    notebooks.write(source, tmp_path, tmp_path / "kept")
    assert page.stat().st_mtime_ns > before
    path.write_text(path.read_text().replace("7", "8"))
    notebooks.write(source, tmp_path, tmp_path / "kept")
    assert "48" in page.read_text()


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: str(path.relative_to(ROOT / "src")))
def test_examples_of_docstrings_hold(path: Path):
    parser, runner, told = doctest.DocTestParser(), doctest.DocTestRunner(), list[str]()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.Module):
            text, line = ast.get_docstring(node) or "", getattr(node, "lineno", 1)
            examples = parser.get_doctest(text, {}, f"{path.name}, line {line}", str(path), line)
            runner.run(examples, out=told.append)
    assert "".join(told) == ""


def test_functions_to_begin_with_have_an_example():
    assert [name for name in hopper.__all__[1:] if f"`{name} <hopper." not in FUNCTIONS] == []
    for path in re.findall(r"{py:func}`\w+ <([\w.]+)>`", FUNCTIONS):
        module, _, name = path.rpartition(".")
        assert ">>>" in (getattr(import_module(module), name).__doc__ or ""), path


def test_witnesses_and_modules_of_the_theory_exist():
    witnesses = re.findall(r"`(tests/[\w/]+[.]py)::(\w+)`", THEORY)
    for file, name in witnesses:
        assert f"def {name}(" in (ROOT / file).read_text(encoding="utf-8"), f"{file}::{name}"
    for module in re.findall(r"{py:mod}`([\w.]+)`", THEORY):
        path = ROOT / "src" / module.replace(".", "/")
        assert path.with_suffix(".py").is_file() or path.is_dir(), module
    assert len(witnesses) >= THEORY.count("$$ (") - 2  # of which two pairs have one in common


def test_every_figure_has_a_whole_caption():
    config = yaml.safe_load((ROOT / "config.yaml").read_text(encoding="utf-8"))
    for drawing in entries.drawings(config):
        assert gallery.entry_of(config, drawing), f"name the sections of {drawing.figure}"
        name = "plot_case" if drawing.kind == "case" else f"plot_{drawing.figure}"
        if not (ROOT / f"scripts/{name}.py").exists():
            continue  # of a rule with several figures, whose name Snakemake tells
        text = gallery.caption(ROOT, config, drawing, gallery.Made(name, []))
        assert "{" not in text
        assert gallery.title_of(drawing.figure, text)


def test_keys_of_the_configuration_from_a_schema():
    schema = {
        "properties": {"one": {"$ref": "#/$defs/part", "description": "a part"}},
        "$defs": {
            "part": {
                "description": "any part",
                "properties": {
                    "angles": {"type": "array", "items": {"type": "number", "minimum": 0}},
                    "old": {"deprecated": True},
                    "kind": {"enum": ["a", "b"], "description": "which | what", "default": "a"},
                },
            }
        },
    }
    rows = reference.configuration(schema).splitlines()
    assert rows[rows.index("## one") + 2] == "a part"
    assert "| `angles` |  | list, each number, ≥ 0 |  |" in rows
    assert '| `kind` | which \\| what | `a`, `b` | `"a"` |' in rows
    assert not any("old" in row for row in rows)


def test_every_option_of_the_command_is_in_its_reference():
    parser = main.build_parser()
    page = reference.command(parser)
    (parts,) = (one for one in parser._actions if isinstance(one, argparse._SubParsersAction))
    for name, part in parts.choices.items():
        section = page.partition(f"## hopper {name}\n")[2].partition("\n## ")[0]
        for action in part._actions:
            if action.dest != "help":
                assert all(option in section for option in action.option_strings)


def test_docstrings_keep_formulas_bars_and_works():
    lines = ["|x| of `y`, by [TE]_:", "", "    a = |b|", "", "see :func:`f` and :func:`g`."]
    assert docstrings.mended(lines) == [
        *(r"\|x\| of ``y``, by [TE]:", "", "::", "", "    a = |b|", ""),
        "see :func:`f` and :func:`g`.",
    ]
    example = ["    >>> x | y", "    `|`", "", "`z`"]
    assert docstrings.mended(example) == ["    >>> x | y", "    `|`", "", "``z``"]
    assert docstrings.mended([".. [TE] A book."]) == ["*  **[TE]** A book."]


def test_attributes_of_one_line_are_one_field():
    assert docstrings.joined(":ivar a, b: both") == ":ivar a,\u200bb: both"
    assert docstrings.joined(":ivar a: of b, c: d") == ":ivar a: of b, c: d"


def test_signatures_are_in_the_words_of_the_source():
    arguments, result = docstrings.signature(hopper.solve_radial) or ("", "")
    assert arguments.startswith("(hopper: Hopper, friction_angle: Radians, ")
    assert result == "RadialSolution"
    assert docstrings.signature(hopper.Hopper)
    assert docstrings.signature(3) is None


def test_a_page_of_the_api_follows_from_its_own_package():
    mine, others = ROOT / "src/hopper/radial/grid.py", ROOT / "src/hopper/stability/modes.py"
    pages = {"api/hopper.radial": {mine, others}, "gallery/fig_3_1": {others}}
    docstrings.own_files_alone(None, SimpleNamespace(dependencies=pages))
    assert pages == {"api/hopper.radial": {mine}, "gallery/fig_3_1": {others}}


def test_works_are_found_with_their_modules():
    found = dict(works.cited(ROOT / "src/hopper"))
    assert "hopper.spectral.pseudospectrum" in found.values()
    assert all(work.endswith(".") for work in found)


def test_links_out_of_the_docs_lead_to_pages(tmp_path: Path):
    source = Source(tmp_path)
    texts.write(source, ROOT)
    for page in tmp_path.glob("*.md"):
        for link in re.findall(r"\]\(([^)#:]+)\)", page.read_text(encoding="utf-8")):
            made_later = link.startswith(("gallery/", "api/", "notebooks/")) or link in MADE_LATER
            assert made_later or (tmp_path / link).is_file(), f"{page.name}: {link}"


def test_a_source_keeps_what_is_the_same_and_removes_what_is_not_written(tmp_path: Path):
    (tmp_path / "pages").mkdir()
    (tmp_path / "pages/old.md").write_text("old")
    source = Source(tmp_path / "pages")
    source.write("new.md", "new")
    assert source.finish()
    assert not source.finish()
    assert [path.name for path in (tmp_path / "pages").iterdir()] == ["new.md"]
    before = (tmp_path / "pages/new.md").stat().st_mtime_ns
    source.write("new.md", "new")
    assert (tmp_path / "pages/new.md").stat().st_mtime_ns == before


def test_the_readme_is_one_screen_whose_links_hold():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert text.count("\n") <= 50
    links = re.findall(r"\]\(([^)#:]+)\)", text)
    assert [link for link in links if not (ROOT / link).exists()] == []


def test_a_bad_configuration_is_named_in_one_line(tmp_path: Path):
    other = tmp_path / "other.yaml"
    other.write_text("radial: {fig_3_1: {points: many}}")
    command = [sys.executable, "-m", "hopper_workflow.site", str(other)]
    done = subprocess.run(
        command, cwd=ROOT, env=ENVIRONMENT, capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 1
    assert done.stderr.startswith("results/site not built: config key 'radial.fig_3_1.points'")
    assert done.stderr.count("\n") == 1
