"""Formulas as MathML, which browsers draw themselves: no script, no font, no network."""

import logging
import re
import zlib
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml

# Functions stand close to factors and arguments unless told otherwise.
_NAME = r"<mi>(?:arc)?(?:sin|cos|tan|cot|log)</mi>"
_FUNCTION = re.compile(rf"({_NAME})(?!\s*<mo[^>]*>\()")
_FACTOR = re.compile(rf"(</m(?:i|n|sub|sup|frac)>)(?=\s*{_NAME})")
_SPACE = r'\1<mspace width="0.17em"/>'


def _mathml(node: Any, *, as_block: bool) -> str:
    """Return a formula as MathML, or as it is, with a warning, if it cannot be read."""
    text = str(node.astext())
    try:
        formula = str(tex2mathml(text, as_block=as_block))
        return _FUNCTION.sub(_SPACE, _FACTOR.sub(_SPACE, formula))
    except MathError as error:
        logger = logging.getLogger("sphinx.hopper.mathml")
        logger.warning("formula %s: %s", text, error, extra={"location": node})
        return f"<code>{nodes.unescape(text)}</code>"


def _inline(translator: Any, node: Any) -> None:
    translator.body.append(_mathml(node, as_block=False))
    raise nodes.SkipNode


def _block(translator: Any, node: Any) -> None:
    # The theme's wrapper has the id.
    translator.body.append('<div class="math">')
    if node["number"]:
        translator.body.append(f'<span class="eqno">({node["number"]})</span>')
    translator.body.append(_mathml(node, as_block=True) + "</div>\n")
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, int]:
    """Register the renderer with Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    # All pages are made anew if this file changed.
    version = zlib.crc32(Path(__file__).read_bytes())
    return {"parallel_read_safe": True, "parallel_write_safe": True, "env_version": version}
