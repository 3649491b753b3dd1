"""A scene as a table of what it holds."""

from __future__ import annotations

from html import escape
from textwrap import wrap

from seacrane.analysis.scene_report import elements_of
from seacrane.description.crane_parts import cylinders, hooks, payloads, slews
from seacrane.description.scene import Description

WIDTH = 100  # characters of a line of text


def rows(scene: Description) -> list[tuple[str, list[str]]]:
    """Kinds of element and the elements of each."""
    found = [(kind, list(names)) for kind, names in elements_of(scene)]
    found.append(("recorded", [f"{name} ({joint} {c})" for name, (joint, c) in scene.recorded.items()]))
    found.append(
        (
            "ranges",
            [f"{name} ({limit.minimum:g} to {limit.maximum:g})" for name, limit in scene.ranges.items()],
        )
    )
    parts = [f"{label} ({drive[0]})" for label, drive in slews(scene).items()]
    for named in (cylinders(scene), hooks(scene), payloads(scene)):
        parts += [f"{label} ({name})" for label, name in named.items()]
    found.append(("crane parts", parts))
    return [(kind, names) for kind, names in found if names]


def as_text(scene: Description) -> str:
    """Lines of kind, number and names; long ones wrapped."""
    lines = [f"Scene {scene.name!r}, gravity {scene.gravity:g} m/s2"]
    held = rows(scene)
    margin = max((len(kind) for kind, _ in held), default=0) + 8
    for kind, names in held:
        first = f"  {len(names):>3}  {kind}"
        begin, after = first.ljust(margin) + " ", " " * (margin + 1)
        lines += wrap(", ".join(names), WIDTH, initial_indent=begin, subsequent_indent=after)
    return "\n".join(lines if held else [*lines, "  empty"])


def as_html(scene: Description) -> str:
    """The same as a table for notebooks."""
    held = "".join(
        f"<tr><th style='text-align:left'>{escape(kind)}</th><td>{len(names)}</td>"
        f"<td style='text-align:left'>{escape(', '.join(names))}</td></tr>"
        for kind, names in rows(scene)
    )
    return f"<table><caption>Scene {escape(repr(scene.name))}</caption>{held}</table>"
