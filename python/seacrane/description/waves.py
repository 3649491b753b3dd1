"""A sea and its loads on the vessels in it, as a scene keeps them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.provenance import SeaProvenance
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import finite_of, not_negative_of
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown
from seacrane.sea.current import Current

STRETCHING = ("wheeler", "none")
EVALUATIONS = ("table", "exact")


class _ReadOnly:
    """What holds arrays that nobody writes into: copies of those that somebody could, also after a pickle."""

    def _close(self) -> None:
        for name, value in vars(self).items():
            if isinstance(value, np.ndarray) and value.flags.writeable:
                closed = value.copy()
                closed.setflags(write=False)
                vars(self)[name] = closed

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        self._close()


@dataclass(frozen=True, kw_only=True, eq=False)
class ByHeading(_ReadOnly):
    """Loads of every wave component over its heading relative to the vessel.

    Attributes
    ----------
    heading : (m,) rad, increasing within one turn, at most 45 deg apart.
    values : ndarray, shape (m, n, 6), complex or real
        Force per amplitude (N/m, N m/m), or mean drift per squared amplitude (N/m2, N m/m2), at the
        frequencies of the n components.
    """

    heading: Array
    values: NDArray[Any]

    __repr__ = brief

    def __post_init__(self) -> None:
        self._close()


@dataclass(frozen=True, kw_only=True, eq=False)
class HullLoads(_ReadOnly):
    """Loads of every component of a sea on one vessel.

    Attributes
    ----------
    transfer : ndarray, shape (n, 6), complex
        Force RAO at each component's direction relative to `heading`, N/m and N m/m about the body origin in
        the vessel's axes, exp(+i w t).
    position : Where the phase is taken, (x, y), m, inertial frame.
    heading : rad, of the vessel where its loads are taken.
    force_by_heading : ByHeading, optional
        Force RAOs over the heading. With them loads are those at the vessel's position and heading of the
        moment, summed exactly; `transfer` then only serves the linear model.
    drift : ndarray, shape (n, 6), optional
        Mean drift load per squared amplitude at each component, N/m2 and N m/m2: adds Newman's slow drift.
    drift_by_heading : The same over the heading, for loads at the actual or the slow position.
    cutoff : float
        rad/s: with `force_by_heading`, loads are those at the position and heading below this frequency; 0:
        at those of the moment.
    """

    transfer: NDArray[np.complex128]
    position: tuple[float, float] = (0.0, 0.0)
    heading: float = 0.0
    force_by_heading: ByHeading | None = None
    drift: Array | None = None
    drift_by_heading: ByHeading | None = None
    cutoff: float = 0.0

    __repr__ = brief

    @property
    def phase(self) -> str:
        """Where loads are taken, as `Scene.add_sea` says it: "mean", "slow" or "actual"."""
        return "mean" if self.force_by_heading is None else "slow" if self.cutoff else "actual"

    def __post_init__(self) -> None:
        finite_of("waves: heading", self.heading, "rad")
        if not_negative_of("waves: cutoff", self.cutoff, "rad/s") and self.force_by_heading is None:
            raise SceneError.of(
                "waves: cutoff",
                f"is {self.cutoff} rad/s and there is no force_by_heading; loads at one place "
                "have no slow position, take phase='slow' in add_sea, or cutoff=0",
            )
        for name in ("force_by_heading", "drift_by_heading"):
            table = getattr(self, name)
            if table is not None and not isinstance(table, ByHeading):
                raise SceneError.of(f"waves: {name}", f"is {shown(table)}; give a seacrane.scene.ByHeading")
        self._close()


@dataclass(frozen=True, kw_only=True)
class Waves(_ReadOnly):
    """One sea and its loads on the vessels in it, as plain arrays.

    Attributes
    ----------
    omega, amplitude, phase, direction : ndarray, shape (n,)
        rad/s, m, rad at the origin of the inertial frame, rad (travelling to, from +x towards +y).
    hulls : mapping of str to HullLoads
        By the vessel's body.
    relative_bound : float
        Bound on a table's interpolation error over the sum of component magnitudes.
    depth : float
        Water depth, m, for the wavenumbers.
    evaluation : str
        "table": knots made as a run reaches them. "exact": the sum in every evaluation.
    negligible : float
        Components whose magnitudes sum to no more than this share of all, in every load and the elevation,
        are left out when the scene is compiled, 0 to 0.1; 0 leaves out those that add nothing.
    current : Current, optional
        On which the waves travel. Frequencies are those that a fixed observer sees, wavenumbers follow.
    stretching : str
        How moving points see the waves above and below the still water, "wheeler" or "none"; see
        `Scene.sea_at`.
    provenance : SeaProvenance
        What the sea was made from, and its realisation: seed, realised Hs, repeat period.
    """

    omega: Array
    amplitude: Array
    phase: Array
    direction: Array
    hulls: Mapping[str, HullLoads]
    relative_bound: float = 1e-9
    depth: float = float("inf")
    evaluation: str = "table"
    negligible: float = 1e-9
    current: Current | None = None
    stretching: str = "wheeler"
    provenance: SeaProvenance = field(default_factory=SeaProvenance)

    def __post_init__(self) -> None:
        hulls = self.hulls
        if not isinstance(hulls, Mapping) or not all(isinstance(h, HullLoads) for h in hulls.values()):
            raise SceneError.of("waves: hulls", f"is {shown(hulls)}; give HullLoads by the vessel's body")
        if not (self.current is None or isinstance(self.current, Current)):
            raise SceneError.of("waves: current", f"is {shown(self.current)}; give a seacrane.sea.Current")
        for name, known in (("evaluation", EVALUATIONS), ("stretching", STRETCHING)):
            value = getattr(self, name)
            if not (isinstance(value, str) and value in known):
                raise SceneError.of(
                    f"waves: {name}", f"is {shown(value)}; choose {' or '.join(map(repr, known))}"
                )
        if not isinstance(self.provenance, SeaProvenance):
            raise SceneError.of(
                "waves: provenance", f"is {shown(self.provenance)}; give a seacrane.scene.SeaProvenance"
            )
        self._require_shapes()
        object.__setattr__(self, "hulls", ReadOnly(hulls))
        self._close()

    def _require_shapes(self) -> None:
        """Each array as long as the sea has components."""
        n = np.size(self.omega)
        shapes: dict[str, tuple[Any, tuple[int, ...]]] = {
            key: (getattr(self, key), (n,)) for key in ("omega", "amplitude", "phase", "direction")
        }
        for body, hull in self.hulls.items():
            shapes |= {f"{key} of {body!r}": (getattr(hull, key), (n, 6)) for key in ("transfer", "drift")}
            for key in ("force_by_heading", "drift_by_heading"):
                if (table := getattr(hull, key)) is not None:
                    shapes[f"{key} of {body!r}"] = table.values, (np.size(table.heading), n, 6)
        for key, (values, shape) in shapes.items():
            if values is not None and np.shape(values) != shape:
                raise SceneError.of(
                    f"waves: {key}", f"has shape {np.shape(values)}; the sea has {n} components, give {shape}"
                )

    def __repr__(self) -> str:
        on = ", ".join(map(repr, self.hulls)) or "no vessel"
        return f"<Waves: {np.size(self.omega)} components on {on}, depth {self.depth:g} m>"

    def hull(self, body: str | None = None) -> HullLoads:
        """Loads on a vessel, by its body; without a name, on the only one. SceneError if there is no such."""
        return self.hulls[self.body_of(body)]

    def body_of(self, body: str | None = None) -> str:
        """The body asked for, or without a name the only one; SceneError if this sea loads no such vessel."""
        if body is None and len(self.hulls) == 1:
            return next(iter(self.hulls))
        if body is None or body not in self.hulls:
            known = ", ".join(map(repr, self.hulls)) or "no vessel"
            fix = "name one of them" if body is None else f"no vessel {body!r} is in it; add_sea puts one in"
            raise SceneError(f"waves: the sea is on {known}; {fix}")
        return body

    def changed(self, body: str | None = None, **changes: Any) -> Waves:
        """The sea with other fields of the `HullLoads` of a vessel; without a name, of the only one."""
        name = self.body_of(body)
        return replace(self, hulls={**self.hulls, name: replace(self.hulls[name], **changes)})

    def has_tables(self) -> bool:
        """Whether any vessel has its loads at one place, where they are functions of time alone."""
        return any(hull.force_by_heading is None for hull in self.hulls.values())

    def components(self) -> _core.WaveComponents:
        """The sea alone."""
        flow: dict[str, Any] = {} if self.current is None else {"current": self.current.core()}
        return _core.WaveComponents(
            omega=self.omega, amplitude=self.amplitude, phase=self.phase, direction=self.direction,
            depth=self.depth, **flow,
        )  # fmt: skip


def flowing_water(current: Current, depth: float, stretching: str) -> Waves:
    """A sea without waves that flows: one component of no height."""
    none = np.zeros(1)
    return Waves(
        omega=none + 1.0, amplitude=none, phase=none, direction=none, hulls={}, depth=depth, current=current,
        stretching=stretching,
    )  # fmt: skip


def calm_water(waves: Waves | None) -> Waves | None:
    """The water of a scene without its waves, at rest or on its current."""
    if waves is None or waves.current is None:
        return None
    return flowing_water(waves.current, waves.depth, waves.stretching)
