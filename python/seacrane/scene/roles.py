"""Parts of a crane that was described by hand."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from seacrane.description.description import Description, coordinate_of, require
from seacrane.description.loads import lines_of, path_of, whole_of
from seacrane.description.roles import (
    CraneRoles,
    LuffingRope,
    Vector,
    areas_by_label,
    capacity_of,
    design_factor_of,
)
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, shaped_of, text_of
from seacrane.inputs.shown import shown


def add_roles(
    scene: Description, *, prefix: str = "", slew: str | tuple[str, str] | None = None,
    cylinders: Mapping[str, str] | None = None, link: str | None = None, line: str | None = None,
    payload: str | None = None, tip: tuple[str, Vector] | None = None, capacity: Any = (),
    areas: Mapping[str, Any] | None = None, luffs: Mapping[str, str | tuple[str, str]] | None = None,
    ropes: Mapping[str, LuffingRope] | None = None, design_factor: float = 1.0, held: bool = False,
    structure: str | None = None,
) -> CraneRoles:  # fmt: skip
    """Tell which elements are the parts of a crane that was described by hand; `add_crane` does it by itself.

    From the roles come the channels stroke, stroke_rate, cylinder_force, slew_angle, slew_torque and
    link_tension, the quantities of `seacrane.trade`, and what pictures draw.

    Parameters
    ----------
    prefix : str
        Of the crane's labels, such as "aft "; it tells several cranes apart.
    slew : str or (str, str)
        Joint of the slew drive, or joint and coordinate.
    cylinders : mapping of str to str
        Sliding joint of every cylinder by its label, such as ``{"main": "main_cylinder"}``.
    link : str
        Distance joint from the tip to the payload.
    line : str
        In its place, the line from the tip that the payload hangs on, by itself or below a block.
    payload : str
        Body that hangs; default: the second body of the link, or the body that the line reaches last.
    tip : (str, array_like of shape (3,))
        Body and point in its coordinates, m; default: where the link begins.
    capacity : array_like, shape (n, 2), optional
        Allowable load (kg) over radii of the tip from the slew axis (m, increasing): linear in between, none
        beyond the last.
    areas : mapping of str to (float, float), optional
        Full side and rod side of the piston, m2, by the cylinder's label: the channel cylinder_pressure.
    luffs : mapping of str to str or (str, str), optional
        Hinge that raises and lowers the jib, or hinge and coordinate, by its label.
    ropes : mapping of str to LuffingRope, optional
        That holds a hinge, by the hinge's label.
    design_factor : float
        Dynamic factor that the capacity contains, 1 or more: the channel utilisation allows a hook load,
        block and rigging included, of so many times the capacity.
    held : bool
        Whether a slew drive, luff or cylinder on which nothing acts when the scene is compiled is held where
        it is described, as those of `add_crane` are.
    structure : str, optional
        Hinge and spring, of one name, that stand for what the crane's structure gives: N/m at the tip. What
        `add_hoist` hangs there preloads the spring.

    Raises
    ------
    SceneError
        For a part that is not in the scene, a link that is no distance joint, or a prefix used twice.
    """
    parts: dict[str, Any] = {key: one for key, one in locals().items() if key != "scene"}
    what = f"crane {text_of('crane: prefix', prefix)!r}" if prefix else "crane"
    if prefix in scene.roles:
        raise SceneError(f"{what}: its prefix {prefix!r} is used twice; give each crane its own")
    place: Any = tip
    if link is not None:
        kind = scene.joints[require(scene, what, "link", link, "joints")].kind
        if kind != "distance":
            raise SceneError(f"{what}: link {link!r} is a {kind} joint; give a distance joint")
        payload = scene.joints[link].second if payload is None else payload
        start, body = scene.joints[link].first_frame.point, scene.joints[link].first
        place = (body, start) if tip is None and body in scene.bodies else tip  # not on the ground
    if line is not None:
        if link is not None:
            raise SceneError(f"{what}: has link {link!r} and line {line!r}; its payload hangs on one of them")
        path = _path(scene, what, line)
        payload = path[-1][0] if payload is None else payload
        place = path[0] if tip is None else tip
    if structure is not None:
        require(scene, what, "structure", structure, "joints")
        require(scene, what, "structure", structure, "springs")
    for label, joint in (cylinders or {}).items():
        require(scene, what, f"cylinder {label!r}", joint, "joints")
    if payload is not None:
        require(scene, what, "payload", payload)
    if place is not None:
        point = shaped_of(f"{what}: tip", place[1], (3,)).tolist()
        place = require(scene, what, "tip", place[0]), tuple(point)
    hinges = {label: _drive(scene, f"{what}: luff {label!r}", one) for label, one in (luffs or {}).items()}
    for label, rope in (ropes or {}).items():
        _check_rope(scene, what, label, rope, hinges)
    parts |= {
        "payload": payload, "luffs": hinges, "ropes": ropes or {}, "cylinders": cylinders or {},
        "slew": None if slew is None else _drive(scene, f"{what}: slew", slew),
        "tip": place,
        "capacity": capacity_of(what, capacity),
        "areas": areas_by_label(what, {} if areas is None else areas, cylinders or {}),
        "held": flag_of(f"{what}: held", held), "design_factor": design_factor_of(what, design_factor),
    }  # fmt: skip
    scene.roles[prefix] = roles = CraneRoles(**parts)
    return roles


def _drive(scene: Description, what: str, drive: str | tuple[str, str]) -> tuple[str, str]:
    joint, coordinate = (drive, None) if isinstance(drive, str) else drive
    return joint, coordinate_of(scene, what, joint, coordinate)


def _check_rope(
    scene: Description, what: str, label: str, rope: Any, hinges: Mapping[str, tuple[str, str]]
) -> None:
    if not isinstance(rope, LuffingRope):
        raise SceneError(f"{what}: rope {label!r} is {shown(rope)}; give a LuffingRope")
    if label not in hinges:
        known = ", ".join(map(repr, hinges)) or "none"
        raise SceneError(f"{what}: a rope holds hinge {label!r}; the luffs are {known}")
    for body, _ in (rope.first, rope.second):
        require(scene, what, f"rope {rope.name!r}: block", body, ground=True)
    if not (rope.falls >= 1 and np.isfinite(rope.EA) and rope.EA > 0.0):
        raise SceneError(
            f"{what}: rope {rope.name!r} has {rope.falls} falls of EA {rope.EA:g} N; give one fall or "
            "more, and an EA above zero"
        )


def _path(scene: Description, what: str, line: str) -> list[tuple[str, Vector]]:
    """Bodies and points of a line by name, or of the segments of one with mass."""
    lines = lines_of(scene.loads)
    parts = [one for name, one in lines.items() if line in (name, whole_of(name, one))]
    if not parts:
        known = ", ".join(dict.fromkeys(whole_of(name, one) for name, one in lines.items())) or "none"
        raise SceneError(f"{what}: its line is {line!r}, which is not in the scene, that has {known}")
    return [(body, tuple(map(float, at))) for one in parts for body, at in path_of(one)]  # type: ignore[misc]
