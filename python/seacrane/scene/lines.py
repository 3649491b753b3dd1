"""Elastic lines over points of bodies, and the winches that pay them out and haul them in."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.description.forces import add_load
from seacrane.description.loads import lines_of
from seacrane.description.scene import Description
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of

NO_BOUND = 1e7  # m/s or m/s2: a bound here or beyond is none


def add_line(
    scene: Description,
    *,
    name: str,
    bodies: Sequence[str],
    points: ArrayLike,
    stiffness: float,
    length: _core.Curve | float,
    damping_ratio: float = 0.02,
    mass: float = 0.0,
    stretch: str = "elastic",
    settling: float = 0.2,
) -> _core.Line:
    """An elastic line without mass from point to point, through which it runs without friction.

    Its tension is the same along all of it, EA e + c l0 e' with the strain e = l / l0 - 1, and never below
    zero: it goes slack. A path that passes between two blocks n times makes n falls. See docs/lines.md.

    Parameters
    ----------
    name : str
    bodies : sequence of str, length n
        Of the points, in the order of the path; "ground" is one too.
    points : array_like, shape (n, 3)
        In coordinates of these bodies, m.
    stiffness : float
        EA, the tension over the strain, N.
    length : Curve or float
        Unstretched, m; for a line on a winch, that at the start.
    damping_ratio : float
        Of critical damping, for `mass` on the line: c = 2 damping_ratio sqrt(EA mass / l0).
    mass : float
        kg; default (0): that of the path's last body, the ground left aside. Of a load on n falls, its mass
        over n^2.
    stretch : {"elastic", "quasi-static", "auto"}
        Quasi-static: the stretch follows the tension within `settling`, so that a stiff line costs no more
        than a soft one. It must stay taut. Auto: a run takes it where its bound holds, else the elastic line;
        `stats` say which, and why. See docs/lines.md.
    settling : float
        s, of a quasi-static stretch: no mode of the line is faster than 1 / settling.

    Returns
    -------
    Line

    Raises
    ------
    SceneError
        For a path of fewer than two points or two bodies, or one that visits a point twice in a row; and for
        values that are no numbers, or not positive where they must be.
    """
    line = _core.Line(
        name=name,
        bodies=bodies,
        points=points,
        stiffness=stiffness,
        length=length,
        damping_ratio=damping_ratio,
        mass=mass,
        stretch=stretch,
        settling=settling,
    )
    added: _core.Line = add_load(scene, line)
    return added


def add_winch(
    scene: Description,
    *,
    line: str,
    rate: _core.Curve | float = 0.0,
    maximum_rate: float = NO_BOUND,
    maximum_acceleration: float = NO_BOUND,
    lag: float = 0.0,
    minimum_length: float = 0.1,
) -> _core.Line:
    """Put a line on a winch: its unstretched length becomes a state, "<line>.length", driven by a rate.

    With a lag the rate is a state too, "<line>.rate". Input "<line>.rate" adds to the command during a run.

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

    Returns
    -------
    Line
        In the place of the one without a winch.

    Raises
    ------
    SceneError
        For a line that is not there or has a winch; what else does not fit is said by `Scene.compile`.
    """
    name = text_of("winch: line", line)
    known = lines_of(scene.loads)
    old = known.get(name)
    if old is None:
        has = ", ".join(known) or "none"
        raise SceneError(f"winch: there is no line {name!r}; the scene has {has}: add it first")
    if old.winch:
        raise SceneError(f"line {name!r}: has a winch already; give one to another line, or replace it")
    winch = {
        "winch": True, "rate": rate, "maximum_rate": maximum_rate, "lag": lag,
        "maximum_acceleration": maximum_acceleration, "minimum_length": minimum_length,
    }  # fmt: skip
    wound = _core.Line(**old.__getstate__() | winch)
    scene.loads[name] = wound
    return wound
