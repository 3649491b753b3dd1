"""Winches of lines, and slings from one point to several points of a load."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.description import Description, require
from seacrane.description.elements import put_load
from seacrane.description.line_path import described_poses
from seacrane.description.loads import changed, lines_of, refuse_winch_of_segment, whole_of
from seacrane.description.rungs import StretchingRung
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, rows_of, shaped_of, text_of, vector_of
from seacrane.inputs.shown import shown
from seacrane.scene.heavy_line import on_a_winch
from seacrane.scene.lift_factors import note_rating, rating_of
from seacrane.scene.lines import STRETCHING

NO_BOUND = 1e7  # m/s or m/s2: a bound here or beyond is none
STRONGEST = 1e12  # N or W: likewise


def add_bridle(
    scene: Description,
    name: str,
    *,
    hook: str,
    load: str,
    points: ArrayLike,
    EA: ArrayLike,
    hook_point: ArrayLike = (0.0, 0.0, 0.0),
    lengths: ArrayLike = (),
    damping_ratio: float = 0.02,
    rung: StretchingRung = "elastic",
    settling: float = 0.2,
    breaking_load: float | None = None,
    safety_factor: float | None = None,
) -> list[_core.Line]:
    """Slings from one point of a hook to points of a load: a line for each, "<name> 1", "<name> 2" and so on.

    Four or more share a load by their EA and lengths: the scene need not be determined by statics.

    Parameters
    ----------
    hook, load : str
        Bodies that are there; the hook may be "ground".
    points : array_like, shape (n, 3)
        On the load, in its coordinates, m.
    EA : array_like, shape (n,) or ()
        Axial stiffness of each sling, N; one number for all.
    hook_point : array_like, shape (3,)
        On the hook, in its coordinates, m.
    lengths : array_like, shape (n,), optional
        Unstretched, m; by default the distances between the bodies as they are described.
    damping_ratio, rung, settling, breaking_load, safety_factor
        Of each, as in `add_line`; the mass on each is its share of the load's.

    Returns
    -------
    list of Line

    Raises
    ------
    SceneError
        For fewer than two points, bodies that are not there, another rung, and what `add_line` refuses.
    """
    what = f"bridle {name_of('bridle', name)!r}"
    ends = rows_of(f"{what}: points", points, 3)
    if len(ends) < 2:
        raise SceneError(f"{what}: has {len(ends)} points; give two or more, or add_line for one sling")
    require(scene, what, "hook", hook, ground=True)
    require(scene, what, "load", load)
    if rung not in STRETCHING:
        raise SceneError.of(
            f"{what}: rung", f"is {shown(rung)}; choose one of {', '.join(map(repr, STRETCHING))}"
        )
    poses = described_poses(scene)
    top = shaped_of(f"{what}: hook_point", hook_point, (3,))
    origin, rotation = poses(hook)
    foot, turned = poses(load)
    apart = np.linalg.norm(foot + ends @ turned.T - origin - rotation @ top, axis=1)
    given = _for_each(f"{what}: lengths", lengths, len(ends)) if np.size(lengths) else apart.tolist()
    axial = _for_each(f"{what}: EA", EA, len(ends))
    ratings = [rating_of(f"{name} {i + 1}", breaking_load, safety_factor) for i in range(len(ends))]
    slings = [
        put_load(scene, _core.Line(
            name=f"{name} {i + 1}", bodies=[hook, load], points=[top, end], EA=axial[i],
            length=given[i], damping_ratio=damping_ratio, mass=scene.bodies[load].mass / len(ends),
            rung=rung, settling=settling,
        ))
        for i, end in enumerate(ends)
    ]  # fmt: skip
    for rating in ratings:
        note_rating(scene, rating)
    return slings


def _for_each(what: str, values: ArrayLike, count: int) -> list[float]:
    numbers = vector_of(what, np.atleast_1d(np.asarray(values, dtype=object)))
    if len(numbers) not in (1, count):
        raise SceneError.of(
            f"{what}", f"are {len(numbers)} numbers; give one for each of {count} points, or one"
        )
    return numbers * count if len(numbers) == 1 else numbers


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
    "limit". See docs/winches.md.

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
    given = {key: one for key, one in locals().items() if key not in ("scene", "line")}
    winch: dict[str, Any] = {"winch": True, **given}
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
    if old.name != name:
        return on_a_winch(scene, name, winch)
    scene.loads[name] = wound = changed(old, **winch)
    return wound
