"""Winches of lines, and of the ropes that luff cranes."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.description.crane_parts import luffing_ropes, luffs
from seacrane.description.description import Description
from seacrane.description.loads import changed, lines_of, refuse_winch_of_segment, whole_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of
from seacrane.inputs.values import told_by
from seacrane.scene.heavy_line import on_a_winch
from seacrane.scene.hydraulics import holding_forces
from seacrane.scene.lines import add_line

NO_BOUND = 1e7  # m/s, m/s2 or m: a bound here or beyond is none
STRONGEST = 1e12  # N or W: likewise


@told_by(_core.Line)
def add_winch(
    scene: Description, line: str, *, rate: _core.Curve | float = 0.0, maximum_rate: float = NO_BOUND,
    maximum_acceleration: float = NO_BOUND, lag: float = 0.0, minimum_length: float = 0.1,
    maximum_length: float = NO_BOUND,
    tension: _core.Curve | float = 0.0, tension_gain: float = 0.0, dead_band: float = 0.0,
    drum_inertia: float = 0.0, drum_radius: float = 0.0, maximum_tension: float = STRONGEST,
    maximum_power: float = STRONGEST, brake: _core.Curve | float = 0.0, brake_capacity: float = 0.0,
    brake_give: float = 1e-3,
) -> _core.Line:  # fmt: skip
    """Put a line on a winch: its unstretched length becomes a state, "<line>.length", driven by a rate.

    With a lag the rate is a state too, "<line>.rate". Input "<line>.rate" adds to the command during a run.
    A line with mass goes by its own name too, and its first segment, "<line>.1", is on the winch.
    With `tension` and `tension_gain` it holds a tension: it pays out above it and hauls in below it, also a
    slack line. With `drum_inertia` and `drum_radius` its drum has inertia, a motor within bounds and a brake,
    which takes its share of the motor away; these need a lag. A bound that is reached is an event of the
    result, of kind "limit". See docs/winches.md.

    A crane's luffing rope, by its name in the crane's file, then carries its jib, as an elastic line of all
    its falls. It starts with the tension that holds what is beyond the hinge as described: add the hoist
    before it. A driver that holds the hinge still (`add_crane(held=True)`) is taken away. The luffing hook
    moves by the rate over the falls.

    Parameters
    ----------
    line : str
        A line of the scene, whose length is a number: that at the start. It leaves the drum at its first end.
    lag : float
        s, of the rate behind the command, first order, from rest; 0 (default): the rate is the command. A
        line with mass needs one.
    minimum_length : float
        m, at which hauling in stops; on a line with mass a run ends there.
    maximum_length : float
        m, that the drum holds: there paying out stops, likewise.

    Returns
    -------
    Line
        In the place of the one without a winch; of one with mass its first segment.

    Raises
    ------
    SceneError
        For a line that is not there, has a winch, or is a segment of one with mass; for one with mass whose
        length is a Curve, or that has drag in air; for a luffing rope that would have to push, or whose hinge
        a moving driver or an actuator leads; what else does not fit is said by `Scene.compile`.
    """
    given = {key: one for key, one in locals().items() if key not in ("scene", "line")}
    winch: dict[str, Any] = {"winch": True, **given}
    name = text_of("winch: line", line)
    for label, rope in luffing_ropes(scene).items():
        if rope.name == name and name not in scene.loads:
            _hang_jib(scene, label)
    known = lines_of(scene.loads)
    old = known.get(name, known.get(f"{name}.1"))
    if isinstance(scene.loads.get(name), _core.Limit):
        raise SceneError(f"line {name!r}: rung 'rigid' takes no winch; choose rung 'elastic'")
    if old is None or (old.name != name and whole_of(old.name, old) != name):
        has = ", ".join(known) or "none"
        raise SceneError(f"winch: there is no line {name!r}; the scene has {has}: add it first")
    if old.winch:
        raise SceneError(f"line {name!r}: has a winch already; give one to another line, or replace it")
    if old.name == name:
        refuse_winch_of_segment(old)
    if old.name != name:
        return on_a_winch(scene, name, winch)
    scene.loads[name] = wound = changed(old, **winch)
    return wound


def _hang_jib(scene: Description, label: str) -> None:
    """Let a luffing rope carry its hinge's jib; `statics` with coordinates leads the hinge in its place."""
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
    keys = ("first", "first_point", "second", "second_point")
    rod = dict(zip(keys, (*rope.first, *rope.second), strict=True)) | {"name": rope.name}
    push = holding_forces(scene, what, [rod], free=joint)[rope.name]
    if push > 0.0:
        raise SceneError(
            f"{what}: would have to push by {push:.4g} N as described: the jib falls backwards; describe it "
            "lower"
        )
    add_line(
        scene, rope.name, bodies=[body for body, _ in ends], points=[point for _, point in ends], EA=rope.EA,
        tension_at_start=-push / rope.falls,
    )  # fmt: skip
