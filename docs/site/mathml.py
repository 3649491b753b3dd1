"""Formulas as MathML, which browsers draw by themselves: no script, no fonts, no network."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.util import logging

NAME = "mathml"
STYLE = "margin: 0; padding: 0.8em 0"  # roots and exponents stay within the box that the theme puts around

log = logging.getLogger(__name__)


def setup(app: Any) -> None:
    """Offer the renderer under its name, for `html_math_renderer`."""
    app.add_html_math_renderer(NAME, inline_renderers=(inline, None), block_renderers=(block, None))


def inline(translator: Any, node: nodes.math) -> None:
    """A formula within a line."""
    translator.body.append(mathml(node, as_block=False))
    raise nodes.SkipNode


def block(translator: Any, node: nodes.math_block) -> None:
    """A formula by itself, in the middle."""
    translator.body.append(f'<div class="math" style="{STYLE}">{mathml(node, as_block=True)}</div>\n')
    raise nodes.SkipNode


def mathml(node: nodes.Element, *, as_block: bool) -> str:
    """The formula of a node; what cannot be read is a warning, which fails the build."""
    try:
        return str(tex2mathml(node.astext().strip(), as_block=as_block))
    except MathError as error:
        log.warning("formula %r: %s", node.astext(), error, location=node)
        return ""
