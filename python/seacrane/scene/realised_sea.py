"""A sea with no vessel in it yet, and what the sea of a scene does at points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.compilation import field_of, pruned
from seacrane.description.description import Description
from seacrane.description.places import place_of
from seacrane.description.provenance import SeaProvenance
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.hydro.parts.density import SEA_WATER
from seacrane.inputs.alike import alike
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import number_of, numbers_of, positive_of, rows_of, text_of
from seacrane.sea import Current, SeaState, Spreading, WaveSystem, cos_2s, jonswap
from seacrane.warnings import BlockedWavesWarning, SecondOrderFlowWarning, UnitWarning

if TYPE_CHECKING:
    import xarray

DEFAULTS: dict[str, Any] = {
    "tp": 8.0,
    "gamma": 3.3,
    "spectrum": "jonswap",
    "direction_deg": 135.0,
    "spreading": None,
    "seed": 1,
    "count": 200,
}
COMPONENTS = ("omega", "amplitude", "phase", "direction")
USUAL_PERIODS = (0.5, 40.0)  # s, of peaks, those of wave basins included
SPECTRA = ("jonswap", "pierson-moskowitz", "torsethaugen")
MOST_FLOWS = 2_000_000
MOST_SECOND_ORDER = 0.3  # of the first order


def realised_sea(
    sea: SeaState | None, given: dict[str, Any], depth: float, *, current: Current | None = None,
    look_for_repeats: bool = True, **settings: Any,
) -> Waves:  # fmt: skip
    """A sea with no vessel in it yet, of that depth where it is not a SeaState; with settings of `Waves`.

    Looking for repeats takes longer than all the rest; without, its provenance does not tell them.

    Raises SceneError for arguments that make no sea.
    """
    sea, made_from = described_sea(sea, given, depth)
    found = realised(sea, made_from, sea.bins(), current=current, look_for_repeats=look_for_repeats)
    return Waves(hulls={}, **settings, **found, depth=sea.depth, current=current)


def described_sea(
    sea: SeaState | None, given: dict[str, Any], depth: float
) -> tuple[SeaState, SeaProvenance]:
    """That sea, and what it was made from; raises SceneError."""
    if sea is None:
        chosen = DEFAULTS | given
        if "gamma" in given and chosen["spectrum"] != "jonswap":
            raise SceneError(f"gamma: {chosen['spectrum']!r} has no free peak enhancement; leave gamma out")
        return _one_system(chosen, depth)
    if isinstance(sea, SeaState):
        return sea, SeaProvenance(sea=sea.description())
    raise SceneError.of("sea", f"is {sea!r}; give a SeaState")


def realised(
    sea: SeaState, made_from: SeaProvenance, bins: Sequence[_core.WaveBins | None], *,
    current: Current | None = None, look_for_repeats: bool = True,
) -> dict[str, Any]:  # fmt: skip
    """Components and provenance of a sea; its bins may be of another seed."""
    done = sea.realised(bins)
    waves = done.waves
    several = {system.name: system.hs for system in done.systems} if len(done.systems) > 1 else None
    components: dict[str, Any] = {key: getattr(waves, key) for key in COMPONENTS}
    if current is not None:
        kept = _not_stopped(waves, current)
        components = {key: values[kept] for key, values in components.items()}
    provenance = alike(
        made_from, realised_hs_of_systems=several, seed=sea.seed, realised_hs=done.hs,
        wave_components=len(waves),
        repeat_period_s=float(done.repeat.time) if look_for_repeats else None,
        repeat_found=int(done.repeat.found) if look_for_repeats else None,
    )  # fmt: skip
    return {**components, "provenance": provenance}


def _not_stopped(waves: _core.WaveComponents, current: Current) -> NDArray[np.bool_]:
    """Which components travel on a current; the energy of the others is told."""
    on_current = current.core().wavenumber(
        omega=waves.omega, direction=waves.direction, depth=waves.depth, gravity=waves.gravity
    )
    kept = ~np.isnan(on_current)
    energy = np.array(waves.amplitude) ** 2
    if not kept.any():
        raise SceneError("sea: the current stops all its waves; give a slower one, or longer waves")
    if energy[~kept].any():
        warn_caller(
            f"sea: the current stops waves above {np.min(np.array(waves.omega)[~kept]):.4g} rad/s that come "
            f"against it, {energy[~kept].sum() / energy.sum():.2%} of the energy; they are left out",
            BlockedWavesWarning,
        )
    return kept


def _one_system(given: Mapping[str, Any], depth: float) -> tuple[SeaState, SeaProvenance]:
    """The sea of plain arguments, and what it was made from."""
    hs, tp = (number_of(f"sea: {key}", given[key]) for key in ("hs", "tp"))
    least, most = USUAL_PERIODS
    if tp > 0.0 and not least <= tp <= most:
        warn_caller(
            f"sea: tp is {tp:.6g} s, and seas have {least:g} to {most:g} s: a slip in its unit? Give it in s",
            UnitWarning,
        )
    density = spectrum_named(given["spectrum"], hs, tp, given["gamma"])
    spreading, direction = given["spreading"], given["direction_deg"]
    if spreading is not None and not isinstance(spreading, Spreading):
        spreading = cos_2s(spreading)
    system = WaveSystem(spectrum=density, direction_deg=direction, spreading=spreading, count=given["count"])
    made_from = SeaProvenance(
        spectrum=given["spectrum"], hs=hs, tp=tp, gamma=density.gamma, wave_direction_deg=float(direction),
        spreading=None if spreading is None else {"kind": spreading.kind, "exponent": spreading.exponent},
    )  # fmt: skip
    return SeaState(systems=[system], seed=given["seed"], depth=depth), made_from


def spectrum_named(name: str, hs: float, tp: float, gamma: float | Literal["dnv"]) -> _core.Spectrum:
    """One of SPECTRA; only "jonswap" takes gamma. Raises SceneError."""
    if text_of("sea: spectrum", name) == "jonswap":
        return jonswap(hs=hs, tp=tp, gamma=gamma)
    if name == "pierson-moskowitz":
        return _core.pierson_moskowitz(hs=hs, tp=tp)
    if name == "torsethaugen":
        return _core.torsethaugen(hs=hs, tp=tp)
    raise SceneError(
        f"spectrum {name!r} is unknown; choose 'jonswap', 'pierson-moskowitz' or 'torsethaugen', "
        "or give a SeaState"
    )


def sea_at(
    scene: Description, *, points: Any, times: ArrayLike, density: float = SEA_WATER
) -> xarray.Dataset:
    """What the undisturbed sea of the scene does at points: as moving points of a run see it.

    From the components and phases that load its vessels, at the depth of the sea and on its current. Linear
    theory ends at the still water. With "wheeler" it is taken at z' = (z - elevation) / (1 + elevation /
    depth), so that the pressure vanishes at the surface; the field is then not harmonic. With "none" it is
    taken as it is, and above the still water as at it. The choice is that of `add_sea`.

    Parameters
    ----------
    points : array_like, shape (m, 3), or mapping of str to array_like, or list of str
        m, inertial frame; by name; or names of points of the scene, where it is described (`place_of`).
    times : array_like, shape (n,)
        s.
    density : float
        kg/m3, for the pressure.

    Returns
    -------
    xarray.Dataset
        Over time, point and axis: elevation (m), velocity (m/s, the current included), acceleration (m/s2, of
        the water: u_t + (U . grad) u, without the second-order part (u . grad) u), pressure (Pa, dynamic:
        without -density g z) and submerged. In air velocity, acceleration and pressure are zero.

    Raises
    ------
    SceneError
        For a scene without a sea, points below its floor, and values that are not finite.

    Warns
    -----
    SecondOrderFlowWarning
        Linear theory leaves out (u . grad) u, which is estimated to be 30 % of the acceleration or more.

    Notes
    -----
    J. D. Wheeler, "Method for calculating forces produced by irregular waves", J. Petroleum Technology 22,
    1970.
    """
    if scene.waves is None:
        raise SceneError(f"scene {scene.name!r}: has no sea; call add_sea first")
    names, places = _places(scene, points)
    moments = np.atleast_1d(numbers_of("sea_at: times", times))
    if moments.ndim != 1:
        raise SceneError.of("sea_at: times", f"has shape {moments.shape}; give one row")
    if len(places) * moments.size > MOST_FLOWS:
        raise SceneError(
            f"sea_at: {len(places):,} points at {moments.size:,} times would take minutes; give fewer, "
            f"at most {MOST_FLOWS:,} of both together"
        )
    rho = positive_of("sea_at: density", density, "kg/m3")
    try:
        flow: Array = field_of(pruned(scene.waves)).at(times=moments, points=places)
    except ValueError as error:
        raise SceneError(f"sea_at: {error}") from error
    _warn_of_second_order(scene.waves, float(places[:, 2].max(initial=-np.inf)))
    return _dataset(names, moments, places, flow, rho)


def _warn_of_second_order(waves: Waves, highest: float) -> None:
    """Standard deviations of u and of its gradient at the highest point, over that of the acceleration."""
    sea = waves.components()
    sigma, k = np.array(sea.intrinsic), np.array(sea.wavenumber)
    speed = np.array(sea.amplitude) * sigma * np.exp(k * min(highest, 0.0)) / np.sqrt(2.0)
    flow, shear, acceleration = (float(np.linalg.norm(speed * factor)) for factor in (1.0, k, sigma))
    if flow * shear > MOST_SECOND_ORDER * acceleration:
        warn_caller(
            f"sea_at: at z = {highest:.3g} m (u . grad) u is about {flow * shear / acceleration:.0%} of the "
            "acceleration, and linear theory leaves it out; take loads on what is near the surface as an "
            "estimate",
            SecondOrderFlowWarning,
        )


def _dataset(names: Any, times: Array, places: Array, flow: Array, rho: float) -> xarray.Dataset:
    import xarray

    wet = places[:, 2] <= flow[..., 0]
    in_water = np.where(wet[..., None], flow, 0.0)
    vector = ("time", "point", "axis")
    return xarray.Dataset(
        {
            "elevation": (vector[:2], flow[..., 0], {"units": "m"}),
            "velocity": (vector, in_water[..., 4:7], {"units": "m/s"}),
            "acceleration": (vector, in_water[..., 7:10], {"units": "m/s2"}),
            "pressure": (vector[:2], rho * in_water[..., 10], {"units": "Pa"}),
            "submerged": (vector[:2], wet),
        },
        {"time": times, "point": names, "axis": ["x", "y", "z"]},
    )


def _places(scene: Description, points: Any) -> tuple[Any, Array]:
    """Labels and places (m, 3)."""
    if isinstance(points, Mapping):
        names = list(points)
        return names, rows_of("sea_at: points", [points[name] for name in names], 3)
    if isinstance(points, (list, tuple)) and points and all(isinstance(name, str) for name in points):
        return list(points), np.array([place_of(scene, name) for name in points])
    rows = rows_of("sea_at: points", points, 3)
    return np.arange(len(rows)), rows
