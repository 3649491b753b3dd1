"""load_chart(): the allowable load over radius and slew angle."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.analysis.inverse import crane_of, values_of
from seacrane.analysis.rest_state import rest_from
from seacrane.answers.rest_columns import AtRest, columns_of
from seacrane.answers.statics import resting
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.loads import changed
from seacrane.description.roles import CraneRoles, allowed_at
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import angle_of
from seacrane.inputs.shown import shown
from seacrane.one_thread import one_thread
from seacrane.plotting.panel import Line, Panel, Sheet, draw
from seacrane.plotting.table import Answer, Column, Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DEGREES, ANGLES = "_deg", ("heel", "trim")
CAPACITY = "capacity"  # of the crane's table
EXACT = 1e-6  # of the load
MOST_ROUNDS = 40
LARGEST_GROWTH = 3.0  # of the load from one round to the next
LEAST_SHARE = 1e-3  # of the described load, which is tried first beside it


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class LoadChart(Answer):
    """The allowable load over radius and slew angle. Made by `load_chart`; prints as a table.

    Attributes
    ----------
    scene : Its name.
    slews, radii : (n,), rad; (k,), m.
    allowable : ndarray, shape (n, k)
        kg; infinite where nothing limits it, NaN where a limit is exceeded with no load at all.
    governing : (n, k) The limit that sets it; empty where none does.
    limits : mapping of str to (float, float)
        Lowest and highest value of each, SI, as the column of `statics`.
    capacity : ndarray, shape (k,), or None
        The crane's own table at these radii, kg.
    """

    scene: str
    slews: Array
    radii: Array
    allowable: Array
    governing: NDArray[np.str_]
    limits: Mapping[str, tuple[float, float]]
    capacity: Array | None = None

    def __repr__(self) -> str:
        return f"<LoadChart of {self.scene!r}: {len(self.slews)} slews x {len(self.radii)} radii>"

    def _shown(self) -> Table:
        rows = zip(self.slews, self.allowable, self.governing, strict=True)
        columns = [
            Column(
                head=f"slew {np.degrees(slew):.4g} deg", values=loads, read=("", [*map(_told, loads, names)])
            )
            for slew, loads, names in rows
        ]
        title = f"{self.scene}: allowable load [t], and what limits it"
        return Table(axes=[Column(name="radius", values=self.radii, unit="m")], columns=columns, title=title)

    def _data(self) -> Table:
        slew = Column(name="slew", values=self.slews, unit="rad")
        radius = Column(name="radius", values=self.radii, unit="m")
        load = Column(name="allowable", values=self.allowable, unit="kg")
        governing = Column(name="governing", values=self.governing)
        return Table(axes=[slew, radius], columns=[load, governing], attributes={"scene": self.scene})


def _told(load: float, limit: str) -> str:
    if np.isnan(load):
        return f"none, {limit}"
    return f"{load / 1e3:.4g} {limit}".rstrip() if np.isfinite(load) else "unlimited"


@named
@one_thread
def load_chart(
    scene: Description,
    *,
    radii: Any,
    slews: Any = 0.0,
    limits: Mapping[str, Any] | None = None,
    coordinates: Mapping[str, float] | None = None,
    luff: str | None = None,
    crane: str | None = None,
) -> LoadChart:
    """The largest load on the hook at each radius and slew angle that keeps every limit, at rest.

    The load of the scene is replaced by heavier and lighter ones, and the scene rests with each, until a
    limit is reached: the ship heels, cylinders carry it. The ballast of the scene stays as it is. Dynamic
    factors are not in it: take them off the limits, or off the load.

    Parameters
    ----------
    scene : Scene
        With a load on the crane's hook.
    radii : array_like
        From the slew axis to the tip, m.
    slews : float or array_like
        rad, as `statics`.
    limits : mapping of str to float or (float, float)
        By the name of a column of `statics`, SI, or an angle's name with "_deg" in degrees, such as
        ``{"cylinder force main": 9e6, "heel_deg": 5.0}``: the largest magnitude, or lowest and highest value.
    coordinates : mapping of str to float, optional
        Strokes of other cylinders than the one that luffs, m, as `statics`.
    luff, crane : str, optional
        As `statics`.

    Returns
    -------
    LoadChart
        The crane's own table, where it has one, is a limit called "capacity".

    Raises
    ------
    SceneError
        Where there is no limit, a limit that `statics` does not know, no load on the hook, or a pose that the
        crane does not reach.
    """
    roles = crane_of(scene, crane)
    if roles.payload not in scene.bodies:
        raise SceneError(
            f"load chart: crane {roles.prefix!r} has no load, which would be varied; give add_crane a "
            "payload, or add_roles a link"
        )
    if roles.slew is None:
        raise SceneError(
            f"load chart: crane {roles.prefix!r} has no slew drive, from whose axis radii are counted; tell "
            "it by add_roles, or vary the load in statics(coordinates=...)"
        )
    axes = {"slew": values_of("load chart: slews", slews), "radius": values_of("load chart: radii", radii)}
    for angle in axes["slew"]:
        angle_of("load chart: slews", float(angle))
    fixed = {label: number_of(f"load chart: {label}", v) for label, v in (coordinates or {}).items()}
    bounds = _bounds(limits or {})
    if not bounds and not roles.capacity:
        raise SceneError(
            "load chart: limits are none, and the crane has no table of its own; give at least one, such as "
            'limits={"heel_deg": 5.0}'
        )
    grid = [{"slew": slew, "radius": r, **fixed} for slew, r in itertools.product(*axes.values())]
    shape = (len(axes["slew"]), len(axes["radius"]))
    found = [
        _Hook(at_rest, roles, bounds).allowable(pose["radius"])
        for pose, at_rest in zip(grid, resting(scene, roles, grid, luff), strict=True)
    ]
    return LoadChart(
        scene=scene.name, slews=axes["slew"], radii=axes["radius"],
        allowable=np.array([load for load, _ in found]).reshape(shape),
        governing=np.array([name for _, name in found]).reshape(shape),
        limits=bounds, capacity=allowed_at(roles.capacity, axes["radius"]) if roles.capacity else None,
    )  # fmt: skip


def _bounds(limits: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    found = {}
    for name, given in limits.items():
        what = f"load chart: limit {name!r}"
        if isinstance(given, (tuple, list)):
            if len(given) != 2:
                raise SceneError(f"{what} is {shown(given)}; give one number, or lowest and highest")
            low, high = (number_of(what, one) for one in given)
        else:
            high = number_of(what, given)
            low = -high
        if not low < high:
            raise SceneError(f"{what} is {shown(given)}; give a positive number, or lowest below highest")
        first, _, of = str(name).partition(" ")  # "heel_deg ship" is of the column "heel ship"
        found[f"{first.removesuffix(DEGREES)} {of}".rstrip()] = _in_si(what, first, low, high)
    return found


def _in_si(what: str, first: str, low: float, high: float) -> tuple[float, float]:
    """Bounds of an angle in degrees as radians, and a word where those in radians look like degrees."""
    if first.endswith(DEGREES):
        return math.radians(low), math.radians(high)
    if first in ANGLES:
        angle_of(what, high)
    return low, high


class _Hook:
    """One pose of a crane, with loads of any mass on its hook."""

    def __init__(self, at_rest: AtRest, roles: CraneRoles, bounds: Mapping[str, tuple[float, float]]) -> None:
        assert roles.payload is not None
        self._at_rest, self._body, self._capacity = at_rest, roles.payload, roles.capacity
        self._bounds = bounds
        known = columns_of(at_rest)
        for name in bounds:
            if name not in known:
                raise SceneError(
                    f"load chart: limit {name!r} is no column of statics; choose from {', '.join(known)}"
                )

    def allowable(self, radius: float) -> tuple[float, str]:
        """Mass (kg) of the largest load, and the limit that sets it: by the secant method on the first."""
        described = self._at_rest.scene.bodies[self._body].mass
        before, now = LEAST_SHARE * described, described
        values, later = self._values(before), self._values(now)
        for _ in range(MOST_ROUNDS):
            mass, name = self._reached(before, values, now, later, radius)
            if mass <= 0.0:
                return math.nan, name
            if not math.isfinite(mass) or abs(mass - now) <= EXACT * now:
                return mass, name
            before, values = now, later
            now, later = self._tried(min(mass, LARGEST_GROWTH * now), now)
        raise SceneError(
            f"load chart: at a radius of {radius:g} m the load at limit {name!r} is not found, last tried "
            f"{now:.6g} kg; limits that the load does not move are none of a chart"
        )

    def _reached(
        self, before: float, values: dict[str, float], now: float, later: dict[str, float], radius: float
    ) -> tuple[float, str]:
        """The load at which the first of the limits would be reached, and its name."""
        reached = {CAPACITY: float(allowed_at(self._capacity, radius))} if self._capacity else {}
        for name, (low, high) in self._bounds.items():
            slope = (later[name] - values[name]) / (now - before)
            if abs(slope) * now <= EXACT * max(abs(low), abs(high)):
                outside = not low <= later[name] <= high
                reached[name] = -math.inf if outside else math.inf
                continue
            reached[name] = now + ((high if slope > 0.0 else low) - later[name]) / slope
        name = min(reached, key=lambda key: reached[key])
        return reached[name], name if math.isfinite(reached[name]) or reached[name] < 0.0 else ""

    def _tried(self, mass: float, known: float) -> tuple[float, dict[str, float]]:
        """A load and its values; nearer to a known one while the scene comes to no rest with it."""
        for _ in range(MOST_ROUNDS):
            try:
                return mass, self._values(mass)
            except SceneError:
                mass = 0.5 * (mass + known)
        return mass, self._values(mass)

    def _values(self, mass: float) -> dict[str, float]:
        scene = self._at_rest.scene.copy()
        old = scene.bodies[self._body]
        inertia = np.asarray(old.inertia) * (mass / old.mass)
        scene.bodies[self._body] = changed(old, mass=mass, inertia=inertia)
        told = columns_of(AtRest.of(scene, rest_from(scene, self._at_rest.state)))
        return {name: told[name][1] for name in self._bounds}


def plot_load_chart(chart: LoadChart) -> Figure:
    """Draw the allowable load over the radius, a curve for each slew angle, and the crane's own table.

    Where nothing limits the load, or no load is allowed at all, curves are left out.

    Raises
    ------
    SceneError
        For what is no chart, or one without a finite load.
    """
    if not isinstance(chart, LoadChart):
        raise SceneError(f"chart is a {type(chart).__name__}; give what load_chart() returns")
    order = np.argsort(chart.radii)
    loads = np.where(np.isfinite(chart.allowable), chart.allowable / 1e3, np.nan)[:, order]
    if not np.isfinite(loads).any():
        raise SceneError(f"load chart of {chart.scene!r}: no pose has a finite allowable load to draw")
    lines = [
        Line(label=f"slew {np.degrees(slew):.4g} deg", values=row, colour=i, style="-o")
        for i, (slew, row) in enumerate(zip(chart.slews, loads, strict=True))
    ]
    if chart.capacity is not None:
        capacity = chart.capacity[order] / 1e3
        lines.append(Line(label="table of the crane", values=capacity, colour=6, style="--"))
    limits = ", ".join(
        f"{name} {np.degrees(low):g} to {np.degrees(high):g} deg"
        if name.split(" ")[0] in ANGLES else f"{name} {low:g} to {high:g}"
        for name, (low, high) in chart.limits.items()
    )  # fmt: skip
    return draw(Sheet(
        title=f"{chart.scene}: allowable load at rest",
        caption=f"Limits: {limits or 'the table of the crane'}. No dynamic factor.",
        abscissa=chart.radii[order], abscissa_name="radius", abscissa_unit="m",
        panels=(Panel(quantity="allowable load", unit="t", lines=tuple(lines)),),
    ))  # fmt: skip
