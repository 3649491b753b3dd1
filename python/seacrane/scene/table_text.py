"""A scene as a table of what it holds."""

from __future__ import annotations

from textwrap import wrap

from seacrane.analysis.scene_report import elements_of
from seacrane.description.description import Description
from seacrane.plotting.html import notebook_table

WIDTH = 100  # characters of a line of text


def rows(scene: Description) -> list[tuple[str, list[str]]]:
    """Kinds of element and the elements of each."""
    found = [(kind, list(names)) for kind, names in elements_of(scene)]
    found.append(("points", [f"{name} ({at.body})" for name, at in scene.points.items()]))
    found.append(("recorded", [f"{name} ({joint} {c})" for name, (joint, c) in scene.recorded.items()]))
    found.append(
        (
            "ranges",
            [
                f"{name} ({limit.minimum + 0.0:g} to {limit.maximum + 0.0:g})"
                for name, limit in scene.ranges.items()
            ],
        )
    )
    found.append(("limit states", list(scene.limit_states)))
    found.append(("clearances", list(scene.clearances)))
    found.append(("meshes", list(scene.meshes)))
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
    held = [(kind, len(names), ", ".join(names)) for kind, names in rows(scene)]
    return notebook_table(("", "number", "names"), held, caption=f"Scene {scene.name!r}")
