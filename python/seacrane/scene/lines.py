"""Elastic lines over points of bodies, and the winches that pay them out and haul them in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.forces import add_load
from seacrane.description.loads import lines_of, refuse_heavy_winch
from seacrane.description.scene import Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of, vector_of
from seacrane.scene.line_start import starting_line

NO_BOUND = 1e7  # m/s or m/s2: a bound here or beyond is none
STRONGEST = 1e12  # N or W: likewise


def add_line(
    scene: Description,
    *,
    name: str,
    bodies: Sequence[str],
    points: ArrayLike,
    stiffness: float | None = None,
    length: _core.Curve | float | None = None,
    tension_at_start: float | None = None,
    damping_ratio: float = 0.02,
    mass: float = 0.0,
    stretch: str = "elastic",
    settling: float = 0.2,
    radii: ArrayLike = (),
    axes: ArrayLike = (),
    turns: ArrayLike = (),
    efficiencies: ArrayLike = (),
    frictions: ArrayLike = (),
    slip_speed: float = 0.01,
    strains: ArrayLike = (),
    tensions: ArrayLike = (),
) -> _core.Line:
    """An elastic line without mass over points, through which it runs without friction, and sheaves.

    Its tension is EA e + c l0 e' with the strain e = l / l0 - 1, and never below zero: it goes slack. It is
    the same along all of the line, or with friction its mean. A path that passes between two blocks n times
    makes n falls. See docs/lines.md.

    Parameters
    ----------
    name : str
    bodies : sequence of str, length n
        Of the points, in the order of the path; "ground" is one too.
    points : array_like, shape (n, 3)
        In coordinates of these bodies, m.
    stiffness : float
        EA, the tension over the strain, N; left out with a table.
    length : Curve or float, optional
        Unstretched, m; for a line on a winch, that at the start. Default: the one with `tension_at_start`.
    tension_at_start : float, optional
        N, that the line carries along its path as described, in place of a length; default (0): the length
        is that of the path.
    damping_ratio : float
        Of critical damping, for `mass` on the line: c = 2 damping_ratio sqrt(EA mass / l0), with a table EA
        being the secant to its last row.
    mass : float
        kg; default (0): that with which the line bounces at the start, as bodies are joined and whichever way
        its path is written: of a load on n falls its mass over n^2. `Scene.report` tells it, and the ratio
        that the bounce reaches.
    stretch : {"elastic", "quasi-static", "auto"}
        Quasi-static: the stretch follows the tension within `settling`, so that a stiff line costs no more
        than a soft one. It must stay taut. Auto: a run takes it where its bound holds, else the elastic line;
        `stats` say which, and why. See docs/lines.md.
    settling : float
        s, of a quasi-static stretch: no mode of the line is faster than 1 / settling.
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

    Returns
    -------
    Line

    Raises
    ------
    SceneError
        For a path of fewer than two points or two bodies, or one that visits a point twice in a row; and for
        values that are no numbers, or not positive where they must be; for a length beside a tension, or
        neither where a body of the path is not there yet.
    """
    given: dict[str, Any] = {
        "name": name, "bodies": bodies, "points": points,
        "stiffness": _stiffness_of(name, stiffness, strains, tensions), "damping_ratio": damping_ratio,
        "mass": mass, "stretch": stretch, "settling": settling, "radii": radii, "axes": axes, "turns": turns,
        "efficiencies": efficiencies, "frictions": frictions, "slip_speed": slip_speed, "strains": strains,
        "tensions": tensions,
    }  # fmt: skip
    if length is not None and tension_at_start is not None:
        raise SceneError(f"line {name!r}: has a length and a tension_at_start; give one of them")
    if length is None:
        line = starting_line(scene, tension_at_start, given)
    else:
        line = _core.Line(**given, length=length)
    added: _core.Line = add_load(scene, line)
    return added


def _stiffness_of(name: str, stiffness: float | None, strains: ArrayLike, tensions: ArrayLike) -> float:
    """EA as given, or the last secant of a table, N."""
    rows = [vector_of(f"line {name!r}: table", column) for column in (strains, tensions)]
    table = all(rows)
    if table and stiffness is not None:
        raise SceneError(f"line {name!r}: has a stiffness and a table; give one of them")
    if table:
        return rows[1][-1] / rows[0][-1] if rows[0][-1] > 0.0 else 1.0
    if stiffness is None:
        raise SceneError(f"line {name!r}: has no stiffness; give EA in N, or strains and tensions")
    return stiffness


def add_winch(
    scene: Description,
    *,
    line: str,
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
    With `tension` and `tension_gain` it holds a tension; with `drum_inertia` and `drum_radius` its drum has
    inertia, a motor within bounds and a brake. A bound that is reached is an event of the result, of kind
    "limit". See docs/lines.md.

    Parameters
    ----------
    line : str
        A line of the scene, whose length is a number: that at the start.
    rate : Curve or float
        Commanded, m/s; positive pays out, negative hauls in.
    maximum_rate : float
        m/s, of the command in both directions; 1e7 (default): no bound.
    maximum_acceleration : float
        m/s2, of the rate; needs a lag. 1e7 (default): no bound.
    lag : float
        s, of the rate behind the command, first order, from rest; 0 (default): the rate is the command.
    minimum_length : float
        m, at which hauling in stops.
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
        In the place of the one without a winch.

    Raises
    ------
    SceneError
        For a line that is not there, has a winch or is a segment of one with mass; what else does not fit is
        said by `Scene.compile`.
    """
    name = text_of("winch: line", line)
    known = lines_of(scene.loads)
    old = known.get(name)
    if old is None:
        has = ", ".join(known) or "none"
        raise SceneError(f"winch: there is no line {name!r}; the scene has {has}: add it first")
    if old.winch:
        raise SceneError(f"line {name!r}: has a winch already; give one to another line, or replace it")
    refuse_heavy_winch(old)
    winch = {
        "winch": True, "rate": rate, "maximum_rate": maximum_rate, "lag": lag,
        "maximum_acceleration": maximum_acceleration, "minimum_length": minimum_length,
        "tension": tension, "tension_gain": tension_gain, "dead_band": dead_band,
        "drum_inertia": drum_inertia, "drum_radius": drum_radius, "maximum_tension": maximum_tension,
        "maximum_power": maximum_power, "brake": brake, "brake_capacity": brake_capacity,
        "brake_give": brake_give,
    }  # fmt: skip
    wound = _core.Line(**old.__getstate__() | winch)
    scene.loads[name] = wound
    return wound
