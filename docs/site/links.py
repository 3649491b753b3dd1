"""Links of documents that the site needs besides those that Sphinx and MyST make."""

from __future__ import annotations

import posixpath
from functools import lru_cache
from typing import Any

import public_face
from docutils import nodes
from sphinx import addnodes


def link_named_documents(app: Any, doctree: nodes.document) -> None:
    """A document that the text names in code letters, such as `docs/crane.md`, is linked."""
    here = posixpath.dirname(app.env.docname)
    for name in list(doctree.findall(nodes.literal)):
        if isinstance(name.parent, (nodes.reference, addnodes.pending_xref)):
            continue
        stem, extension = posixpath.splitext(name.astext())
        places = [stem, posixpath.normpath(posixpath.join(here, stem))]
        target = next((place for place in places if place in app.env.found_docs), None)
        if extension == ".md" and target:
            _link_document(name, app.env.docname, target)


def _link_document(name: nodes.literal, here: str, target: str) -> None:
    link = addnodes.pending_xref(
        refdomain="std", reftype="doc", reftarget=f"/{target}", refdoc=here, refexplicit=True, refwarn=True
    )
    name.replace_self(link)
    link += name


def unlink_folders(app: Any, doctree: nodes.document) -> None:
    """A link to a folder of the repository, which the site does not hold, becomes its text."""
    here = posixpath.dirname(app.env.docname)
    for link in list(doctree.findall(addnodes.pending_xref)):
        if link.get("reftype") == "myst" and (app.srcdir / here / link["reftarget"]).is_dir():
            link.replace_self(link.children)


def link_exact_names(app: Any, doctree: nodes.document) -> None:
    """A word of a docstring's type, such as "time", is no link to any attribute that ends so."""
    for link in doctree.findall(addnodes.pending_xref):
        if link.get("refdomain") == "py":
            link.attributes.pop("refspecific", None)


def public_name(app: Any, env: Any, node: addnodes.pending_xref, content: nodes.Element) -> Any:
    """A class or function that a docstring or signature names by its module leads to its public name."""
    public = _homes().get(node.get("reftarget", ""))
    if node.get("refdomain") != "py" or public is None:
        return None
    python = env.domains["py"]
    return python.resolve_xref(env, node["refdoc"], app.builder, "obj", public, node, content)


@lru_cache
def _homes() -> dict[str, str]:
    homes = public_face.homes()
    return homes | {public.rpartition(".")[2]: public for public in homes.values()}
