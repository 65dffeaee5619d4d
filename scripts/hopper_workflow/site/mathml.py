"""Formulas as MathML, which browsers draw themselves: no script, no font, no network."""

import logging
import re
from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml

# Functions stand close to their arguments unless told otherwise.
_FUNCTION = re.compile(r"(<mi>(?:arc)?(?:sin|cos|tan|cot|log)</mi>)(?!\s*<mo[^>]*>\()")


def _mathml(node: Any, *, as_block: bool) -> str:
    """Return a formula as MathML, or as it is, with a warning, if it cannot be read."""
    text = str(node.astext())
    try:
        formula = str(tex2mathml(text, as_block=as_block))
        return _FUNCTION.sub(r'\1<mspace width="0.17em"/>', formula)
    except MathError as error:
        logger = logging.getLogger("sphinx.hopper.mathml")
        logger.warning("formula %s: %s", text, error, extra={"location": node})
        return f"<code>{nodes.unescape(text)}</code>"


def _inline(translator: Any, node: Any) -> None:
    translator.body.append(_mathml(node, as_block=False))
    raise nodes.SkipNode


def _block(translator: Any, node: Any) -> None:
    attributes = {"ids": node["ids"]} if node["ids"] else {}
    translator.body.append(translator.starttag(node, "div", CLASS="math", **attributes))
    if node["number"]:
        translator.body.append(f'<span class="eqno">({node["number"]})</span>')
    translator.body.append(_mathml(node, as_block=True) + "</div>\n")
    raise nodes.SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Register the renderer with Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
