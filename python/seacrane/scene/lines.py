"""Lines, from a rigid wire to one with mass: where they run, and with what length they start."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.description import GROUND, Description
from seacrane.description.elements import add_joint, put_load
from seacrane.description.line_path import path_length
from seacrane.description.loads import changed
from seacrane.description.places import place_of
from seacrane.description.rungs import AUTO, ELASTIC, QUASI_STATIC, RIGID, WITH_MASS, Rung
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of, shaped_of, text_of, texts_of, vector_of
from seacrane.inputs.shown import shown
from seacrane.inputs.values import made_of, told_by, value
from seacrane.scene.heavy_line import chain_of_segments
from seacrane.scene.lift_factors import note_rating, rating_of
from seacrane.scene.limits import STICKING_SPEED, add_wire
from seacrane.scene.line_fluid import Wire

STRETCHING = (QUASI_STATIC, ELASTIC, AUTO)
RUNGS = (RIGID, *STRETCHING)
TAKEN_BY: Mapping[str, tuple[str, ...]] = {  # keywords that not every line takes
    **dict.fromkeys(("joint", "restitution", "sticking_speed"), (RIGID,)),
    **dict.fromkeys(("EA", "damping_ratio", "settling"), (*STRETCHING, WITH_MASS)),
    **dict.fromkeys(("tension_at_start", "mass", "sheaves", "strains", "tensions"), STRETCHING),
    "wire": (WITH_MASS,),
}
UNKNOWN_LENGTH = 1.0  # m, of a line that is made to be measured


@value(_core.Line)
class Sheaves:
    """Sheaves at the points of a line's path, of which these are the centres; lines begin and end at points.

    Besides its turns a line is wrapped by 0 to 264 degrees. Roller bearings have an efficiency of 0.98,
    bushings of 0.96. With a coefficient mu tensions differ by exp(mu wrap).
    """

    radii: ArrayLike = ()  # m
    axes: ArrayLike = ()
    turns: ArrayLike = ()
    efficiencies: ArrayLike = ()
    frictions: ArrayLike = ()
    slip_speed: float = 0.01  # m/s


@told_by(_core.Line)
def add_line(
    scene: Description, name: str | None = None, first: str | None = None, second: str | None = None, *,
    first_point: ArrayLike | None = None, second_point: ArrayLike | None = None,
    bodies: Sequence[str] | None = None, points: ArrayLike | None = None, joint: str | None = None,
    EA: float | None = None, length: _core.Curve | float | None = None,
    tension_at_start: float | None = None, rung: Rung = "elastic", settling: float = 0.2,
    damping_ratio: float = 0.02, mass: float = 0.0, sheaves: Sheaves | Mapping[str, Any] | None = None,
    strains: ArrayLike = (), tensions: ArrayLike = (), restitution: float = 0.0,
    sticking_speed: float = STICKING_SPEED, wire: Wire | Mapping[str, Any] | None = None,
    breaking_load: float | None = None, safety_factor: float | None = None,
) -> _core.Line | _core.Limit | list[_core.Line]:  # fmt: skip
    """A line, which pulls and never pushes: between two bodies, or over points and sheaves of several.

    What it is made of is its rung. "rigid": a length that is never exceeded; it snatches. "elastic": it
    stretches by its EA. "quasi-static": the stretch follows the tension, and a stiff line costs no more than
    a soft one; it must stay taut. "auto": a run takes one of these two, and says why. A `Wire` makes it one
    with mass: segments of that rung with masses between them. See docs/lines.md. A rod, which pushes too, is
    a joint of kind "distance".

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
    rung : {"rigid", "quasi-static", "elastic", "auto"}
        With mass, not rigid; quasi-static: waves along the line settle within `settling`.
    settling : float
        s, in which the stretch of a quasi-static line follows: no mode of it is faster than 1 / settling.
    damping_ratio : float
        Of critical damping, for `mass` on the line: c = 2 damping_ratio sqrt(EA mass / l0), with a table EA
        being the secant to its last row. With mass: for one mass on one segment.
    mass : float
        kg; default (0): that with which the line bounces at the start, as bodies are joined and whichever way
        its path is written: of a load on n falls its mass over n^2. `Scene.report` tells it, and the ratio
        that the bounce reaches.
    sheaves : Sheaves or mapping, optional
        At the points of the path, such as ``{"radii": [0, 0.4, 0], "efficiencies": [1, 0.98, 1]}``.
    strains, tensions : array_like, shape (m,), optional
        Of a shock cord, in place of EA, N: a monotone cubic spline runs through them; both start at 0 and
        increase. Beyond the last it goes on along its tangent.
    restitution : float
        Rigid: 0 (default: it stays stretched after a snatch) to 1 (no energy is lost).
    sticking_speed : float
        Rigid, m/s; slower snatches do not rebound, so that rebounds come to an end.
    wire : Wire or mapping, optional
        Of a line with mass, such as ``{"mass_per_length": 25, "segments": 10}``.
    breaking_load : float, optional
        Minimum breaking load of the rope, one fall, N: `lift_sheet` and the report compare the tension.
    safety_factor : float, optional
        Least breaking load over largest tension, 1 or more.

    Returns
    -------
    Line, Limit or list of Line
        What the scene holds by its name: a line, of rung "rigid" a limit, with mass its segments.

    Raises
    ------
    SceneError
        For a keyword that its rung does not take; for a path of fewer than two points or two bodies, or one
        that visits a point twice in a row; for values that are no numbers, or out of range; for a length
        beside a tension, or neither where a body of the path is not there yet.
    """
    given = {key: one for key, one in locals().items() if key in TAKEN_BY}
    name = name_of("line", joint if name is None and joint is not None else name)
    what = f"line {name!r}"
    _check_rung(what, rung, given)
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
    elif wire is not None:
        added = chain_of_segments(
            scene, name, *over, made_of(what, "wire", Wire, wire), EA=EA, length=length,
            damping_ratio=damping_ratio, rung=rung, settling=settling,
        )  # fmt: skip
    else:
        if length is not None and tension_at_start is not None:
            raise SceneError(f"{what}: has a length and a tension_at_start; give one of them")
        line = _core.Line(
            name=name, bodies=over[0], points=over[1], EA=_axial_stiffness(what, EA, strains, tensions),
            length=UNKNOWN_LENGTH if length is None else length, damping_ratio=damping_ratio, mass=mass,
            rung=rung, settling=settling, strains=strains, tensions=tensions,
            **({} if sheaves is None else vars(made_of(what, "sheaves", Sheaves, sheaves))),
        )  # fmt: skip
        if length is None:
            line = changed(line, length=starting_length(scene, line, tension_at_start))
        added = put_load(scene, line)
    note_rating(scene, rating)
    return added  # type: ignore[no-any-return]


def _check_rung(what: str, rung: str, given: Mapping[str, Any]) -> None:
    """Refuse a rung that there is not, and what it does not take."""
    if rung not in RUNGS:
        raise SceneError.of(f"{what}: rung", f"is {shown(rung)}; choose one of {', '.join(map(repr, RUNGS))}")
    if given["wire"] is not None:
        if rung == RIGID:
            raise SceneError(f"{what}: rung 'rigid' takes no wire; leave it out, or choose another rung")
        rung = WITH_MASS
    usual = inspect.signature(add_line).parameters
    for keyword, one in given.items():
        default = usual[keyword].default
        left = one is default or (isinstance(one, type(default)) and bool(one == default))
        if left or rung in TAKEN_BY[keyword]:
            continue
        others = " or ".join(map(repr, TAKEN_BY[keyword]))
        raise SceneError(f"{what}: a line {rung!r} takes no {keyword}; leave it out, or choose {others}")


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


def path_between(
    scene: Description, what: str, bodies: tuple[Any, Any], points: tuple[ArrayLike | None, ArrayLike | None]
) -> tuple[list[str], list[ArrayLike]]:
    """The bodies of both ends and a point on each, by default the one of `hung_from`."""
    names, places = [], []
    for role, body, point in zip(("first", "second"), bodies, points, strict=True):
        if body is None:
            raise SceneError(f"{what}: has no {role}; name the body of that end, which may be 'ground'")
        names.append(text_of(f"{what}: {role}", body))
        places.append(hung_from(scene, names[-1]) if point is None else point)
    return names, places


def hung_from(scene: Description, body: str) -> tuple[float, float, float]:
    """Where a line is tied by default, body coordinates, m: the top centre of a size, else the origin."""
    described = scene.bodies.get(body)
    if described is None or not np.any(described.size):
        return (0.0, 0.0, 0.0)
    x, y, z = map(float, described.center_of_mass)
    return (x, y, z + 0.5 * float(described.size[2]))


def starting_length(scene: Description, line: _core.Line, tension: float | None) -> float:
    """Unstretched length, m, with which a line carries a tension (N; None: 0) along its path as described."""
    what = f"line {line.name!r}"
    pull = 0.0 if tension is None else number_of(f"{what}: tension_at_start", tension)
    if not (np.isfinite(pull) and pull >= 0.0):
        raise SceneError.of(f"{what}: tension_at_start", f"is {pull!r} N; give zero or more")
    absent = [body for body in line.bodies if body != GROUND and body not in scene.bodies]
    if absent:
        raise SceneError(
            f"{what}: its path is measured as described, and body {absent[0]!r} is not in the scene; add it "
            "first, or give the length"
        )
    path = path_length(scene, line)
    if not (np.isfinite(path) and path > 0.0):
        raise SceneError(f"{what}: its path is {path:g} m long as described; correct its points")
    return path / (1.0 + _strain(line, pull))


def _strain(line: _core.Line, tension: float) -> float:
    """At which the line carries a tension."""
    if not len(line.strains):
        return tension / float(line.EA)
    from scipy.interpolate import PchipInterpolator

    table = PchipInterpolator(line.strains, line.tensions)
    last, highest = float(line.strains[-1]), float(line.tensions[-1])
    if tension >= highest:
        return last + (tension - highest) / float(table.derivative()(last))
    return float(table.solve(tension, extrapolate=False)[0])
