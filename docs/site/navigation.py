"""The lists of links of the first page are the site's table of contents."""

from __future__ import annotations

from typing import Any

from docutils import nodes
from sphinx import addnodes


def add_toctrees(app: Any, doctree: nodes.document) -> None:
    """Add to each section of the first page a hidden tree of the documents that its list links to."""
    if app.env.docname != app.config.root_doc:
        return
    for listed in list(doctree.findall(nodes.bullet_list)):
        links = list(listed.findall(addnodes.pending_xref))
        section = listed.parent
        assert isinstance(section, nodes.section)
        section += _toctree(app.env.docname, section[0].astext(), links)


def _toctree(parent: str, caption: str, links: list[addnodes.pending_xref]) -> nodes.Element:
    entries = [(link.astext(), link["reftarget"]) for link in links]
    tree = addnodes.toctree(
        parent=parent,
        entries=entries,
        includefiles=[document for _, document in entries],
        caption=caption,
        rawcaption=caption,
        hidden=True,
        maxdepth=1,
        glob=False,
        includehidden=False,
        numbered=0,
        titlesonly=False,
    )
    return nodes.compound("", tree, classes=["toctree-wrapper"])
