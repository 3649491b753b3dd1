"""Parts of a crane that was described by hand, and luffing ropes as elastic lines on winches."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.compilation import compile_scene
from seacrane.description.crane_parts import luffing_ropes, luffs
from seacrane.description.description import GROUND, Description, coordinate_of, require
from seacrane.description.line_path import Pose, described_poses, laid
from seacrane.description.loads import lines_of, path_of, whole_of
from seacrane.description.places import placed
from seacrane.description.roles import (
    CraneRoles,
    LuffingRope,
    Vector,
    areas_by_label,
    capacity_of,
    design_factor_of,
    lengthening,
)
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, shaped_of, text_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.scene.lines import add_line
from seacrane.scene.rigging import add_winch

Array = NDArray[np.float64]
SMALL = 1e-5  # rad, over which lengths are differenced


def add_roles(
    scene: Description,
    *,
    prefix: str = "",
    slew: str | tuple[str, str] | None = None,
    cylinders: Mapping[str, str] | None = None,
    link: str | None = None,
    line: str | None = None,
    payload: str | None = None,
    tip: tuple[str, Vector] | None = None,
    capacity: Any = (),
    areas: Mapping[str, Any] | None = None,
    luffs: Mapping[str, str | tuple[str, str]] | None = None,
    ropes: Mapping[str, LuffingRope] | None = None,
    design_factor: float = 1.0,
    held: bool = False,
    structure: str | None = None,
) -> CraneRoles:
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
    if link is not None:
        kind = scene.joints[require(scene, what, "link", link, "joints")].kind
        if kind != "distance":
            raise SceneError(f"{what}: link {link!r} is a {kind} joint; give a distance joint")
        payload = scene.joints[link].second if payload is None else payload
        tip = _start_of(scene, link) if tip is None else tip
    if line is not None:
        if link is not None:
            raise SceneError(f"{what}: has link {link!r} and line {line!r}; its payload hangs on one of them")
        path = _path(scene, what, line)
        payload = path[-1][0] if payload is None else payload
        tip = path[0] if tip is None else tip
    if structure is not None:
        require(scene, what, "structure", structure, "joints")
        require(scene, what, "structure", structure, "springs")
    for label, joint in (cylinders or {}).items():
        require(scene, what, f"cylinder {label!r}", joint, "joints")
    if payload is not None:
        require(scene, what, "payload", payload)
    hinges = {label: _drive(scene, f"{what}: luff {label!r}", one) for label, one in (luffs or {}).items()}
    for label, rope in (ropes or {}).items():
        _check_rope(scene, what, label, rope, hinges)
    parts |= {
        "payload": payload, "luffs": hinges, "ropes": ropes or {}, "cylinders": cylinders or {},
        "slew": None if slew is None else _drive(scene, f"{what}: slew", slew),
        "tip": None if tip is None else _tip(scene, what, tip),
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


def _tip(scene: Description, what: str, tip: tuple[str, Vector]) -> tuple[str, Vector]:
    body, point = tip
    require(scene, what, "tip", body)
    x, y, z = (float(value) for value in shaped_of(f"{what}: tip", point, (3,)))
    return body, (x, y, z)


def _path(scene: Description, what: str, line: str) -> list[tuple[str, Vector]]:
    """Bodies and points of a line by name, or of the segments of one with mass."""
    lines = lines_of(scene.loads)
    parts = [one for name, one in lines.items() if line in (name, whole_of(name, one))]
    if not parts:
        known = ", ".join(dict.fromkeys(whole_of(name, one) for name, one in lines.items())) or "none"
        raise SceneError(f"{what}: its line is {line!r}, which is not in the scene, that has {known}")
    return [(body, tuple(map(float, at))) for one in parts for body, at in path_of(one)]  # type: ignore[misc]


def _start_of(scene: Description, link: str) -> tuple[str, Vector] | None:
    """Where a link begins, on its first body; None on the ground."""
    joint = scene.joints[link]
    x, y, z = np.asarray(joint.first_frame.point).tolist()
    return (joint.first, (x, y, z)) if joint.first in scene.bodies else None


def add_luffing_rope(scene: Description, *, luff: str | None = None, **winch: Any) -> _core.Line:
    """Let a crane's luffing rope carry its jib, as an elastic line of all its falls on a winch.

    The rope starts with the tension that holds the weights beyond the hinge, and the pull of the lines that
    are there, at rest on an upright base: add the hoist before it. A driver that holds the hinge still
    (`add_crane(held=True)`) is taken away. The rope's name is that in the crane's file, such as "luffing
    rope"; `statics` with coordinates leads the hinge and tells the tension from its moment.

    Parameters
    ----------
    luff : str, optional
        Label of the hinge, with the crane's prefix; default: the only one with a rope.
    **winch
        As of `add_winch`, such as ``rate`` in m/s of rope: a luffing hook moves by the rate over the falls.

    Raises
    ------
    SceneError
        For a hinge without a rope, one that a moving driver or an actuator leads, or a rope that would have
        to push.
    """
    label = _which(scene, luff)
    rope, (joint, coordinate) = luffing_ropes(scene)[label], luffs(scene)[label]
    what = f"luffing rope {rope.name!r}"
    for name, driver in list(scene.drivers.items()):
        if (driver.joint, driver.coordinate) == (joint, coordinate):
            if driver.curve != _core.Curve.constant(value=0.0):
                raise SceneError(f"{what}: driver {name!r} leads its hinge; take the driver out first")
            del scene.drivers[name]
    for name, one in scene.actuators.items():
        if (one.joint, one.coordinate) == (joint, coordinate):
            raise SceneError(f"{what}: actuator {name!r} drives its hinge; take one of them out")
    ends = [rope.first if i % 2 == 0 else rope.second for i in range(rope.falls + 1)]
    add_line(
        scene, rope.name, bodies=[body for body, _ in ends], points=[point for _, point in ends], EA=rope.EA,
        tension_at_start=_tension(scene, what, joint, rope),
    )  # fmt: skip
    return add_winch(scene, line=rope.name, **winch)


def _which(scene: Description, luff: str | None) -> str:
    known = luffing_ropes(scene)
    label = next(iter(known)) if luff is None and len(known) == 1 else luff
    if label not in known:
        which = ", ".join(map(repr, known)) or "none"
        raise SceneError.of("luffing rope: luff", f"is {shown(luff)}; the hinges with a rope are {which}")
    return str(label)


def _tension(scene: Description, what: str, joint: str, rope: LuffingRope) -> float:
    """The tension of each fall, N, that carries what is beyond the hinge at the described pose: virtual work.

    That is the weights of the bodies there, and the pull of the lines that run to others.
    """
    base = scene.joints[joint].first
    hinge = placed(scene, base, scene.joints[joint].first_frame.point)
    axis = described_poses(scene)(base)[1] @ np.asarray(scene.joints[joint].first_frame.axes)[:, 2]
    up = np.array([0.0, 0.0, 1.0])
    beyond = _beyond(scene, joint)
    moment = _moment_of_lines(scene, beyond, hinge, axis)
    for body in sorted(beyond):
        one = scene.bodies[body]
        center = placed(scene, body, one.center_of_mass)
        moment -= one.mass * scene.gravity * float(up @ np.cross(axis, center - hinge))
    first, second = (placed(scene, *block) for block in (rope.first, rope.second))
    tension = moment / (rope.falls * lengthening(hinge, axis, first, second))
    if not tension >= 0.0:
        raise SceneError(
            f"{what}: would have to push by {-tension:.4g} N as described: the jib falls backwards; describe "
            "it lower"
        )
    return tension


def _moment_of_lines(scene: Description, beyond: set[str], hinge: Array, axis: Array) -> float:
    """About the hinge, N m, of the lines between bodies beyond it and others, as described: -T dl/dangle."""
    lines = lines_of(scene.loads)
    ends = {name: {*line.bodies} for name, line in lines.items()}
    pulling = [name for name, bodies in ends.items() if bodies & beyond and bodies - beyond]
    if not pulling:
        return 0.0
    tensions, poses = _tensions(scene), described_poses(scene)

    def length(name: str, angle: float) -> float:
        turn = rotation_matrix([np.cos(0.5 * angle), *(np.sin(0.5 * angle) * axis)])

        def pose(body: str) -> Pose:
            origin, rotation = poses(body)
            return (
                (hinge + turn @ (origin - hinge), turn @ rotation) if body in beyond else (origin, rotation)
            )

        return laid(lines[name], pose).length

    slopes = {name: (length(name, SMALL) - length(name, -SMALL)) / (2.0 * SMALL) for name in pulling}
    return -float(sum(tensions[name] * slope for name, slope in slopes.items()))


def _tensions(scene: Description) -> dict[str, float]:
    """The tensions of all lines as described, N."""
    model = compile_scene(scene)
    run = _core.Simulation(
        model=model,
        start=_core.initial_state(model),
        options=_core.RunOptions(integrator="rk4", output_times=[0.0], channels={"line_tension"}),
    )
    return dict(zip(lines_of(scene.loads), run.channels()["line_tension"][0].tolist(), strict=True))


def _beyond(scene: Description, hinge: str) -> set[str]:
    """Bodies that hang on the second side of a joint."""
    found, apart = {scene.joints[hinge].second}, {scene.joints[hinge].first, GROUND}
    while True:
        ends = [{one.first, one.second} for name, one in scene.joints.items() if name != hinge]
        more = {body for pair in ends if pair & found and not pair & apart for body in pair}
        if more <= found:
            return found
        found |= more
