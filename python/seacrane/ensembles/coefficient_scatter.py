"""What the scatter of coefficients in water does to numbers of a lift: runs with more and less of each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from types import MappingProxyType
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.loads import changed
from seacrane.ensembles.ensemble import ensemble
from seacrane.ensembles.kept import Kept
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.plotting.table import Answer, Column, Table
from seacrane.result import Result
from seacrane.scene.scene import Scene

SPAN = "line"
COEFFICIENTS = ("added_mass", "drag")
# Shares by which coefficients of a shape are uncertain: usual for lifts, and unverified.
SHARES: Mapping[str, Mapping[str, float]] = MappingProxyType(
    {
        "box": {"added_mass": 0.3, "drag": 0.5},
        "cylinder": {"added_mass": 0.2, "drag": 0.3},
        "sphere": {"added_mass": 0.2, "drag": 0.5},
        "table": {"added_mass": 0.3, "drag": 0.5},
        SPAN: {"added_mass": 0.2, "drag": 0.3},
    }
)
DESCRIBED, SLOW = "as described", "added mass at zero frequency"
CASES = {
    "less added mass": ("added_mass", -1.0),
    "more added mass": ("added_mass", 1.0),
    "less drag": ("drag", -1.0),
    "more drag": ("drag", 1.0),
}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class CoefficientScatter(Answer):
    """Numbers of a lift with other coefficients in water. Made by `coefficient_scatter`; prints as a table.

    Attributes
    ----------
    values : mapping of str to mapping of str to float
        By case, then by name of what is kept. The first case is the lift as described.
    shares : mapping of str to mapping of str to float
        By which added mass and drag were varied, by shape; those of the scene.
    sources : mapping of str to str
        Where the shares are from, by shape.
    """

    values: Mapping[str, Mapping[str, float]]
    shares: Mapping[str, Mapping[str, float]]
    sources: Mapping[str, str]

    def changes(self, name: str) -> dict[str, float]:
        """By case, how a number that is kept differs from that of the lift as described, in its unit."""
        described = self.values[DESCRIBED][name]
        return {case: row[name] - described for case, row in self.values.items() if case != DESCRIBED}

    __repr__ = Answer.__str__

    def _shown(self) -> Table:
        told = [
            f"{shape}: added mass {100 * one['added_mass']:g} %, drag {100 * one['drag']:g} %, "
            f"{self.sources[shape]}"
            for shape, one in self.shares.items()
        ]
        columns = [self._column(name) for name in self.values[DESCRIBED]]
        return Table(
            axes=[Column(name="coefficients", values=list(self.values))], columns=columns, remarks=told
        )

    def _column(self, name: str) -> Column:
        changes = {case: f" ({change:+.2g})" for case, change in self.changes(name).items()}
        values = {case: row[name] for case, row in self.values.items()}
        told = [f"{value:.4g}{changes.get(case, '')}" for case, value in values.items()]
        return Column(name=name, values=list(values.values()), read=("", told))


def coefficient_scatter(
    scene: Scene,
    *,
    keep: Mapping[str, Kept | str | Callable[[Result], float]],
    shares: Mapping[str, Mapping[str, float]] | None = None,
    **given: Any,
) -> CoefficientScatter:
    """Run a lift with more and less added mass and drag of all that is in water.

    Both are known to some 20 to 50 %, which is more than any error of integration. Each is varied by itself,
    of all parts and lines together. Where parts know their added mass at zero frequency (spheres, meshes), a
    further run takes it, as far as it is not above that of an unbounded fluid: what a load has that rides
    slow waves at the surface.

    Parameters
    ----------
    scene : Scene
        With parts or lines in water.
    keep : mapping
        Single numbers by name, as of `ensemble`, such as ``{"least": "line_tension[wire].min"}``.
    shares : mapping of str to mapping of str to float, optional
        By shape ("box", "cylinder", "sphere", "table", "line"): ``{"box": {"added_mass": 0.2, "drag": 0.3}}``
        in place of the defaults; plates are boxes.
    **given
        Further arguments of `ensemble`: t_end, stages, executor, rtol and so on.

    Returns
    -------
    CoefficientScatter

    Raises
    ------
    SceneError
        For a scene with nothing in water, shares that are none, a number that is none, and a run that fails.

    Notes
    -----
    The default shares are 20 to 30 % of added mass and 30 to 50 % of drag, unverified.
    """
    used = {shape: dict(SHARES[shape]) for shape in shapes_in(scene)}
    if not used:
        raise SceneError(f"scene {scene.name!r}: has nothing in water; add_immersed parts first")
    sources = dict.fromkeys(used, "usual, unverified")
    for shape, one in _checked(shares).items():
        if shape in used:
            used[shape] |= one
            sources[shape] = "given"
    cases = [DESCRIBED, *CASES, *([SLOW] if _knows_slow(scene) else [])]
    done = ensemble(
        partial(scattered, scene, used), over={"case": cases}, keep=keep, on_error="raise", **given
    )
    values: dict[str, dict[str, float]] = {case: {} for case in cases}
    for name in keep:
        found = done.dataset[name].to_numpy()
        if found.shape != (len(cases),):
            raise SceneError(f"coefficient_scatter: {name!r} is several numbers of a run; keep one of them")
        for case, value in zip(cases, found, strict=True):
            values[case][name] = float(value)
    return CoefficientScatter(values=values, shares=used, sources=sources)


def shapes_in(scene: Scene) -> list[str]:
    """Of what is in water, each once."""
    found = (_shape(load) for load in scene.loads.values())
    return list(dict.fromkeys(shape for shape in found if shape))


def _shape(load: Any) -> str:
    if isinstance(load, _core.ImmersedPart):
        return "cylinder" if load.shape == "disc" else str(load.shape)  # its ends
    return SPAN if isinstance(load, _core.ImmersedSpan) else ""


def _knows_slow(scene: Scene) -> bool:
    return any(
        isinstance(load, _core.ImmersedPart) and len(load.slow_added_masses) for load in scene.loads.values()
    )


def _checked(shares: Any) -> dict[str, dict[str, float]]:
    if shares is None:
        return {}
    if not isinstance(shares, Mapping):
        raise SceneError(f"shares is {shown(shares)}; give {{'box': {{'added_mass': 0.2, 'drag': 0.3}}}}")
    out: dict[str, dict[str, float]] = {}
    for shape, one in shares.items():
        if shape not in SHARES or not isinstance(one, Mapping) or not set(one) <= set(COEFFICIENTS):
            raise SceneError(
                f"shares: {shown(shape)} has {shown(one)}; give 'added_mass' and 'drag' of "
                f"{', '.join(SHARES)}"
            )
        out[shape] = {name: number_of(f"shares: {shape}: {name}", value) for name, value in one.items()}
        for name, value in out[shape].items():
            if not 0.0 <= value <= 1.0:
                raise SceneError(f"shares: {shape}: {name} is {value:g}; give a share from 0 to 1")
    return out


def scattered(scene: Scene, shares: Mapping[str, Mapping[str, float]], *, case: str) -> Scene:
    """The scene with the coefficients of one of the cases, by shares of each shape."""
    out = scene.copy()
    for name, load in scene.loads.items():
        if not (shape := _shape(load)):
            continue
        if case in CASES:
            coefficient, sign = CASES[case]
            out.loads[name] = _times(load, coefficient, 1.0 + sign * shares[shape][coefficient])
        elif case == SLOW and shape != SPAN and len(load.slow_added_masses):
            out.loads[name] = changed(load, added_masses=_growing(np.asarray(load.slow_added_masses)))
    return out


def _times(load: Any, coefficient: str, factor: float) -> Any:
    """A part or a span with one of its coefficients times a factor."""
    if isinstance(load, _core.ImmersedPart):
        name = {"added_mass": "added_masses", "drag": "drag"}[coefficient]
        return changed(load, **{name: factor * np.asarray(getattr(load, name))})
    names = {
        "added_mass": ("added_mass_coefficient",),
        "drag": ("drag_coefficient", "drag_coefficient_along"),
    }[coefficient]
    return changed(load, **{name: factor * getattr(load, name) for name in names})


def _growing(masses: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """At each depth no more than at any below: slam asks for what never falls."""
    return np.asarray(np.minimum.accumulate(masses[::-1])[::-1])
