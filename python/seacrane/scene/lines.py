"""Lines, from a rigid wire to one with mass, and the winches that pay them out and haul them in."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from typing import Any, Literal

from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.forces import add_load
from seacrane.description.joints import add_joint
from seacrane.description.loads import changed, lines_of, refuse_winch_of_segment, whole_of
from seacrane.description.places import place_of
from seacrane.description.ratings import note_rating, rating_of
from seacrane.description.rungs import (
    AUTO,
    ELASTIC,
    QUASI_STATIC,
    RIGID,
    WITH_MASS,
    Rung,
    StretchingRung,
)
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, shaped_of, text_of, texts_of, vector_of
from seacrane.inputs.shown import shown
from seacrane.scene.heavy_line import chain_of_segments, on_a_winch
from seacrane.scene.limits import STICKING_SPEED, add_wire
from seacrane.scene.line_fluid import CIRCLE_ADDED_MASS, CYLINDER_DRAG, SKIN_DRAG, Fluid
from seacrane.scene.line_seabed import Seabed
from seacrane.scene.line_start import UNKNOWN_LENGTH, path_between, starting_length

NO_BOUND = 1e7  # m/s or m/s2: a bound here or beyond is none
STRONGEST = 1e12  # N or W: likewise
STRETCHING = (QUASI_STATIC, ELASTIC, AUTO)
RUNGS = (RIGID, *STRETCHING, WITH_MASS)
TAKEN_BY: Mapping[str, tuple[str, ...]] = {  # keywords that not every rung takes
    **dict.fromkeys(("joint", "restitution", "sticking_speed"), (RIGID,)),
    **dict.fromkeys(("EA", "damping_ratio", "settling"), (*STRETCHING, WITH_MASS)),
    **dict.fromkeys(
        ("tension_at_start", "mass", "radii", "axes", "turns", "efficiencies", "frictions", "slip_speed",
         "strains", "tensions"), STRETCHING),
    **dict.fromkeys(
        ("mass_per_length", "segments", "segment_rung", "diameter", "drag_coefficient",
         "drag_coefficient_along", "added_mass_coefficient", "density", "flow", "medium", "seabed"),
        (WITH_MASS,)),
}  # fmt: skip


def add_line(
    scene: Description,
    name: str | None = None,
    first: str | None = None,
    second: str | None = None,
    *,
    first_point: ArrayLike | None = None,
    second_point: ArrayLike | None = None,
    bodies: Sequence[str] | None = None,
    points: ArrayLike | None = None,
    joint: str | None = None,
    EA: float | None = None,
    length: _core.Curve | float | None = None,
    tension_at_start: float | None = None,
    rung: Rung = "elastic",
    settling: float = 0.2,
    damping_ratio: float = 0.02,
    mass: float = 0.0,
    radii: ArrayLike = (),
    axes: ArrayLike = (),
    turns: ArrayLike = (),
    efficiencies: ArrayLike = (),
    frictions: ArrayLike = (),
    slip_speed: float = 0.01,
    strains: ArrayLike = (),
    tensions: ArrayLike = (),
    restitution: float = 0.0,
    sticking_speed: float = STICKING_SPEED,
    mass_per_length: float = 0.0,
    segments: int = 20,
    segment_rung: StretchingRung = "elastic",
    diameter: float = 0.0,
    drag_coefficient: float = CYLINDER_DRAG,
    drag_coefficient_along: float = SKIN_DRAG,
    added_mass_coefficient: float = CIRCLE_ADDED_MASS,
    density: float | None = None,
    flow: ArrayLike = (0.0, 0.0, 0.0),
    medium: Literal["air", "sea"] = "air",
    seabed: Seabed | Mapping[str, Any] | None = None,
    breaking_load: float | None = None,
    safety_factor: float | None = None,
) -> _core.Line | _core.Limit | list[_core.Line]:
    """A line, which pulls and never pushes: between two bodies, or over points and sheaves of several.

    What it is made of is its rung. "rigid": a length that is never exceeded; it snatches. "elastic": it
    stretches by its EA. "quasi-static": the stretch follows the tension, and a stiff line costs no more than
    a soft one; it must stay taut. "auto": a run takes one of these two, and says why. "with mass": elastic
    segments with masses between them. See docs/lines.md. A rod, which pushes too, is a joint of kind
    "distance".

    Parameters
    ----------
    first, second : str
        Bodies at its two ends; "ground" is one too.
    first_point, second_point : array_like, shape (3,), optional
        Where it is tied to them, in their coordinates, m. Default: the top centre of a body that has a size,
        else the origin.
    bodies : sequence of str, length n
        In place of first and second: those of all points of a path, in its order.
    points : array_like, shape (n, 3)
        Of that path, in coordinates of these bodies, m.
    joint : str, optional
        Rigid, in place of first and second: a joint of kind "distance", such as a crane's "link", that from
        now on pulls only. The line then has its name by default.
    EA : float
        Axial stiffness, the tension over the strain, N; left out with a table, and rigid.
    length : Curve or float, optional
        Unstretched, m; for a line on a winch, that at the start. Default: the one with `tension_at_start`,
        or that of the path as described. Rigid, a number. With mass, a curve pays it out and hauls it in at
        its first end; its rate must not jump.
    tension_at_start : float, optional
        N, that the line carries along its path as described, in place of a length; default: 0.
    rung : {"rigid", "quasi-static", "elastic", "auto", "with mass"}
    settling : float
        s, in which the stretch of a quasi-static line follows: no mode of it is faster than 1 / settling.
    damping_ratio : float
        Of critical damping, for `mass` on the line: c = 2 damping_ratio sqrt(EA mass / l0), with a table EA
        being the secant to its last row. With mass: for one mass on one segment.
    mass : float
        kg; default (0): that with which the line bounces at the start, as bodies are joined and whichever way
        its path is written: of a load on n falls its mass over n^2. `Scene.report` tells it, and the ratio
        that the bounce reaches.
    radii : array_like, shape (n,), optional
        Of the sheaves of which the points are the centres, m; 0: a point. Lines begin and end at points.
    axes : array_like, shape (n, 3), optional
        Of the sheaves, in coordinates of their bodies: the line runs about them by the right hand.
    turns : array_like, shape (n,), optional
        Whole turns on each sheave besides its wrap, which is between 0 and 264 degrees.
    efficiencies : array_like, shape (n,), optional
        Of each sheave or point, the smaller tension over the larger; 1: no friction. Roller bearings have
        0.98, bushings 0.96.
    frictions : array_like, shape (n,), optional
        Coefficient mu of each sheave: tensions differ by exp(mu wrap).
    slip_speed : float
        m/s, of the rope over a sheave: friction acts with tanh of the rate over it.
    strains, tensions : array_like, shape (m,), optional
        Of a shock cord, in place of EA, N: a monotone cubic spline runs through them; both start at 0 and
        increase. Beyond the last it goes on along its tangent.
    restitution : float
        Rigid: 0 (default: it stays stretched after a snatch) to 1 (no energy is lost).
    sticking_speed : float
        Rigid, m/s; slower snatches do not rebound, so that rebounds come to an end.
    mass_per_length : float
        With mass, kg/m.
    segments : int
        With mass, from 1 to 1000. The fastest mode is 2 segments / length sqrt(EA / mass_per_length), 1/s.
    segment_rung : {"elastic", "quasi-static", "auto"}
        With mass, of each segment. Quasi-static: waves along the line settle within `settling`.
    diameter : float
        With mass, m, for what air or water does to it; 0 (default): nothing in air, refused in the sea.
    drag_coefficient : float
        With mass, across the line. Default 1.2, a cylinder (DNV-RP-C205).
    drag_coefficient_along : float
        With mass, in the sea, along the line on its skin, pi diameter length. Default 0.01 (unverified). In
        air there is none.
    added_mass_coefficient : float
        With mass, in the sea: added mass across the line over the water that it displaces; there is none
        along it. Default 1, a circle in ideal flow.
    density : float
        With mass, kg/m3, of the fluid; default: that of the medium, air or sea water.
    flow : array_like, shape (3,)
        With mass, velocity of the air, or of a fluid that has drag alone, m/s, inertial axes.
    medium : {"air", "sea"}
        With mass. In the sea what is below the surface has buoyancy, added mass and drag in the water of
        `add_sea`, its waves and current; still water without one.
    seabed : mapping or Seabed, optional
        With mass, a level seabed on which its masses lie, no model of soil: `depth` below z = 0, m;
        `stiffness` for each metre of line, N/m2; Coulomb's `friction`; and `damping_ratio` (1) where it has
        sunk in at rest, `give` (0.05 m) before friction is full.
    breaking_load : float, optional
        Minimum breaking load of the rope, one fall, N: `lift_sheet` and the report compare the tension.
    safety_factor : float, optional
        Least breaking load over largest tension, 1 or more.

    Returns
    -------
    Line, Limit or list of Line
        What the scene holds by its name: a line, of rung "rigid" a limit, of rung "with mass" its segments.

    Raises
    ------
    SceneError
        For a keyword that its rung does not take; for a path of fewer than two points or two bodies, or one
        that visits a point twice in a row; for values that are no numbers, or out of range; for a length
        beside a tension, or neither where a body of the path is not there yet.
    """
    told = locals().copy()
    name = name_of("line", joint if name is None and joint is not None else name)
    what = f"line {name!r}"
    _check_rung(what, rung, {key: told[key] for key in TAKEN_BY})
    rating = rating_of(name, breaking_load, safety_factor)
    ends = first, second, first_point, second_point
    over: tuple[Any, Any] = (bodies, points)
    if joint is not None:
        _refuse_second(what, "a joint", *ends, bodies, points, length)
    elif bodies is not None or points is not None:
        _refuse_second(what, "bodies and points", *ends)
    else:
        over = path_between(scene, what, (first, second), (first_point, second_point))
    added: Any
    if joint is not None:
        added = add_wire(scene, joint, restitution, sticking_speed, name)
    elif rung == RIGID:
        added = _wire(scene, what, name, *over, length, restitution, sticking_speed)
    elif rung == WITH_MASS:
        added = chain_of_segments(
            scene, name, *over, EA=EA, length=length, mass_per_length=mass_per_length,
            segments=segments, damping_ratio=damping_ratio, rung=segment_rung, settling=settling,
            fluid=Fluid(
                medium=medium, density=density, diameter=diameter, drag_coefficient=drag_coefficient,
                drag_coefficient_along=drag_coefficient_along, flow=flow,
                added_mass_coefficient=added_mass_coefficient,
            ),
            seabed=seabed,
        )  # fmt: skip
    else:
        if length is not None and tension_at_start is not None:
            raise SceneError(f"{what}: has a length and a tension_at_start; give one of them")
        line = _core.Line(
            name=name, bodies=over[0], points=over[1], EA=_axial_stiffness(what, EA, strains, tensions),
            length=UNKNOWN_LENGTH if length is None else length, damping_ratio=damping_ratio, mass=mass,
            rung=rung, settling=settling, radii=radii, axes=axes, turns=turns, efficiencies=efficiencies,
            frictions=frictions, slip_speed=slip_speed, strains=strains, tensions=tensions,
        )  # fmt: skip
        if length is None:
            line = changed(line, length=starting_length(scene, line, tension_at_start))
        added = add_load(scene, line)
    note_rating(scene, rating)
    return added  # type: ignore[no-any-return]


def _check_rung(what: str, rung: str, given: Mapping[str, Any]) -> None:
    """Refuse a rung that there is not, and what it does not take."""
    if rung not in RUNGS:
        raise SceneError(f"{what}: rung is {shown(rung)}; choose one of {', '.join(map(repr, RUNGS))}")
    usual = inspect.signature(add_line).parameters
    for keyword, value in given.items():
        if rung in TAKEN_BY[keyword] or _alike(value, usual[keyword].default):
            continue
        others = " or ".join(map(repr, TAKEN_BY[keyword]))
        raise SceneError(f"{what}: rung {rung!r} takes no {keyword}; leave it out, or choose rung {others}")


def _alike(value: Any, usual: Any) -> bool:
    return value is usual or (isinstance(value, type(usual)) and bool(value == usual))


def _refuse_second(what: str, has: str, *given: Any) -> None:
    """Refuse a second description of where a line runs."""
    if any(value is not None for value in given):
        raise SceneError(
            f"{what}: has {has} beside other words for its path; give first and second with their points, or "
            "bodies and points, or a joint of rung 'rigid'"
        )


def _wire(
    scene: Description, what: str, name: str, bodies: Any, points: Any, length: Any,
    restitution: float, sticking_speed: float,
) -> _core.Limit:  # fmt: skip
    """A distance joint that pulls only; its length as described where none is given."""
    names = texts_of(f"{what}: bodies", bodies)
    if len(names) != 2:
        raise SceneError(
            f"{what}: rung 'rigid' runs between two bodies, and bodies has {len(names)} names; choose rung "
            "'elastic' for a path over sheaves"
        )
    start, end = (
        place_of(scene, body=body, point=point)
        for body, point in zip(names, shaped_of(f"{what}: points", points, (2, 3)), strict=True)
    )
    add_joint(
        scene, kind="distance", name=name, first=names[0], second=names[1], point=start, second_point=end,
        length=None if length is None else number_of(f"{what}: length", length),
    )  # fmt: skip
    try:
        return add_wire(scene, name, restitution, sticking_speed, None)
    except SceneError:
        del scene.joints[name]
        raise


def _axial_stiffness(what: str, given: float | None, strains: ArrayLike, tensions: ArrayLike) -> float:
    """EA as given, or the last secant of a table, N."""
    rows = [vector_of(f"{what}: table", column) for column in (strains, tensions)]
    table = all(rows)
    if table and given is not None:
        raise SceneError(f"{what}: has EA and a table; give one of them")
    if table:
        return rows[1][-1] / rows[0][-1] if rows[0][-1] > 0.0 else 1.0
    if given is None:
        raise SceneError(f"{what}: has no EA; give it in N, or strains and tensions")
    return given


def add_winch(
    scene: Description,
    line: str,
    *,
    rate: _core.Curve | float = 0.0,
    maximum_rate: float = NO_BOUND,
    maximum_acceleration: float = NO_BOUND,
    lag: float = 0.0,
    minimum_length: float = 0.1,
    tension: _core.Curve | float = 0.0,
    tension_gain: float = 0.0,
    dead_band: float = 0.0,
    drum_inertia: float = 0.0,
    drum_radius: float = 0.0,
    maximum_tension: float = STRONGEST,
    maximum_power: float = STRONGEST,
    brake: _core.Curve | float = 0.0,
    brake_capacity: float = 0.0,
    brake_give: float = 1e-3,
) -> _core.Line:
    """Put a line on a winch: its unstretched length becomes a state, "<line>.length", driven by a rate.

    With a lag the rate is a state too, "<line>.rate". Input "<line>.rate" adds to the command during a run.
    A line with mass goes by its own name too, and its first segment, "<line>.1", is on the winch.
    With `tension` and `tension_gain` it holds a tension; with `drum_inertia` and `drum_radius` its drum has
    inertia, a motor within bounds and a brake. A bound that is reached is an event of the result, of kind
    "limit". See docs/lines.md.

    Parameters
    ----------
    line : str
        A line of the scene, whose length is a number: that at the start. It leaves the drum at its first end.
    rate : Curve or float
        Commanded, m/s; positive pays out, negative hauls in.
    maximum_rate : float
        m/s, of the command in both directions; 1e7 (default): no bound.
    maximum_acceleration : float
        m/s2, of the rate; needs a lag. 1e7 (default): no bound.
    lag : float
        s, of the rate behind the command, first order, from rest; 0 (default): the rate is the command. A
        line with mass needs one.
    minimum_length : float
        m, at which hauling in stops; on a line with mass a run ends there.
    tension : Curve or float
        N, held: the winch pays out above it and hauls in below it, also a slack line. Needs `tension_gain`.
    tension_gain : float
        m/s for each N beyond the tension and its dead band, added to the command; 0 (default): none is held.
    dead_band : float
        N on both sides of the tension, in which nothing is added.
    drum_inertia : float
        kg m2, of drum, gear and motor at the drum; needs a lag. 0 (default): the rate is that of the lag.
    drum_radius : float
        m, at which the rope runs.
    maximum_tension : float
        N at the rope, of the motor in both directions; 0: no motor. 1e12 (default): no bound.
    maximum_power : float
        W that the motor gives; what it takes is not bounded. 1e12 (default): no bound.
    brake : Curve or float
        Share of its capacity that is applied, 0 (open) to 1 (closed). The motor lets go by that share.
    brake_capacity : float
        N at the rope, beyond which the brake slips; 0 (default): no brake.
    brake_give : float
        m of rope that the drum turns before the brake bears its capacity.

    Returns
    -------
    Line
        In the place of the one without a winch; of one with mass its first segment.

    Raises
    ------
    SceneError
        For a line that is not there, has a winch, or is a segment of one with mass; for one with mass whose
        length is a Curve, or that has drag in air; what else does not fit is
        said by `Scene.compile`.
    """
    name = text_of("winch: line", line)
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
    winch = {
        "winch": True, "rate": rate, "maximum_rate": maximum_rate, "lag": lag,
        "maximum_acceleration": maximum_acceleration, "minimum_length": minimum_length,
        "tension": tension, "tension_gain": tension_gain, "dead_band": dead_band,
        "drum_inertia": drum_inertia, "drum_radius": drum_radius, "maximum_tension": maximum_tension,
        "maximum_power": maximum_power, "brake": brake, "brake_capacity": brake_capacity,
        "brake_give": brake_give,
    }  # fmt: skip
    if old.name != name:
        return on_a_winch(scene, name, winch)
    scene.loads[name] = wound = changed(old, **winch)
    return wound
