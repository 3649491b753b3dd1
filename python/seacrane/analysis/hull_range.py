"""Where hulls left what their wave loads, moorings and groups hold for: each a warning, after the run."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from seacrane import _core, warnings
from seacrane.analysis.after_run import Finding, peak
from seacrane.arrays import Array
from seacrane.description.given import given_vessels
from seacrane.description.once import once
from seacrane.hydro import HydroDatabase
from seacrane.inputs.frames import heading_of, rotation_about_z, rotation_matrix

if TYPE_CHECKING:
    from seacrane.description.description import Description
    from seacrane.description.waves import HullLoads, Waves


LARGEST_PHASE = 0.3  # rad of waves at the peak, of the slow drift: 30 % of the load is out of phase
LARGEST_TURN = np.radians(10.0)
LARGEST_SHIFT = 0.1  # of the encounter frequency from the wave's, as a share
SLOW = 2.0  # peak periods: what two running means over so many leave of a motion is slow
TINY = float(np.finfo(float).tiny)
BINS = 32  # of the band, in which the peak is looked for
LIGHTEST_WATER = 500.0  # kg/m3: a denser medium is water
LARGEST_GAP_SHARE = 0.1  # that vessels of a group may leave their place beside each other by
LARGEST_RELATIVE_TURN = np.radians(2.0)
WAY_OUT = (
    "take them where the vessel slowly goes by phase='slow' in add_sea, where it is on the average by "
    "position and heading_deg there, or moor it stiffer"
)
CORNERS = 0.5 * np.array(
    [[1, 1, 0], [-1, 1, 0], [-1, -1, 0], [1, -1, 0]]
)  # of a rectangle, over length and breadth


def motions(
    scene: Description, channels: Mapping[str, Array]
) -> Iterator[tuple[_core.VesselHydrodynamics, Array]]:
    """Every vessel with its six motions (n, 6), as far as they are recorded."""
    recorded = channels.get("vessel_motion")
    if recorded is not None:
        for i, vessel in enumerate(scene.vessels.values()):
            yield vessel, recorded if recorded.ndim == 2 else recorded[:, i]


def hull_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> Iterator[Finding]:
    """What is out of range of wave loads and moorings, vessel by vessel."""
    waves, given = scene.waves, given_vessels(scene)
    for vessel, motion in motions(scene, channels):
        name, body = vessel.name, vessel.body
        if waves is not None and body not in waves.hulls and given.get(body, "raos") == "raos":
            others = ", ".join(map(repr, waves.hulls))
            does = f"rests in the sea that {others} meets, and would follow its RAOs there"
            if body not in given:
                does = f"floats in the sea that loads {others}, and has no wave loads itself"
            call = f"scene.add_sea(vessel={name!r})"
            yield warnings.NoWaveLoadsWarning, f"vessel {name!r}: {does}; call {call}"
        if body in given:
            continue
        passed = np.abs(np.diff(motion[:, 5])) > np.pi
        if vessel.mooring_stiffness[2] != 0.0 and passed.any():
            yield (
                warnings.MooringTurnWarning,
                f"vessel {name!r}: passes half a turn from its rest at t = "
                f"{time[int(np.argmax(passed)) + 1]:.6g} s, from where its mooring in yaw pulls the other "
                "way. Give it a stiffer mooring, or look for what turns it",
            )
        if waves is not None and body in waves.hulls:
            hull, sea = waves.hulls[body], peak_of(scene)
            if hull.force_by_heading is None:
                yield from _posed(scene.bodies[body], name, hull, sea, time, motion)
            yield from _under_way(sea, name, time, motion)


@dataclass(frozen=True, kw_only=True)
class Peak:
    """Peak of a sea: frequency (rad/s), period (s) and wavenumber (1/m) of its densest energy, and the mean
    of e e^T over the directions of travel e."""

    omega: float
    period: float
    wavenumber: float
    spread: Array

    def phase(self, place: Array) -> Array:
        """Phase of waves at the peak, over displacements (n, 2), m: root mean square over directions, rad."""
        return np.asarray(self.wavenumber * np.sqrt(np.sum((place @ self.spread) * place, axis=1)))


@once
def peak_of(scene: Description) -> Peak:
    """The peak of the sea of a scene that has one."""
    assert scene.waves is not None
    components, omega = scene.waves.components(), peak_frequency(scene.waves)
    wavenumber = components.wavenumber[int(np.argmin(np.abs(np.asarray(scene.waves.omega) - omega)))]
    travel = np.stack([np.cos(components.direction), np.sin(components.direction)])
    energy = np.asarray(components.amplitude) ** 2
    spread = (travel * energy) @ travel.T / max(energy.sum(), TINY)
    return Peak(omega=omega, period=2.0 * np.pi / omega, wavenumber=float(wavenumber), spread=spread)


def peak_frequency(waves: Waves) -> float:
    """rad/s, where the energy of the components is densest."""
    omega = np.asarray(waves.omega, dtype=float)
    energy = np.broadcast_to(np.asarray(waves.amplitude, dtype=float) ** 2, omega.shape)
    lowest = omega.min()
    width = omega.max() - lowest or 1.0
    at = ((omega - lowest) * (BINS / width)).astype(int)
    dense = np.bincount(at, weights=energy)
    weight = energy * (dense[at] / max(dense.max(), TINY)) ** 4
    return float(weight @ omega / weight.sum()) if weight.any() else float(lowest)


def slowly(time: Array, values: Array, period: float) -> Array:
    """Values (n, k) less their motions at the peak period (s): two running means."""
    step = float(time[1] - time[0]) if time.size > 1 else period
    half = min(round(0.5 * SLOW * period / step), time.size)
    for _ in range(2 if half > 0 else 0):
        total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
        last = np.minimum(np.arange(time.size) + half + 1, time.size)
        first = np.maximum(np.arange(time.size) - half, 0)
        values = (total[last] - total[first]) / (last - first)[:, None]
    return values


def _posed(
    start: _core.Body, name: str, hull: HullLoads, sea: Peak, time: Array, motion: Array
) -> Iterator[Finding]:
    """How far the hull is, slowly, from the place and heading of its loads."""
    heading = heading_of(start.quaternion)
    place = motion[:, :2] @ rotation_about_z(heading)[:2, :2].T + (start.position[:2] - hull.position)
    turn = math.remainder(heading - hull.heading, 2.0 * np.pi)
    # A mean is never farther than what it is taken of.
    near = sea.phase(place).max() <= LARGEST_PHASE
    if near and np.abs(motion[:, 5]).max() + abs(turn) <= LARGEST_TURN:
        return
    slow = slowly(time, np.column_stack([place, np.unwrap(motion[:, 5]) + turn]), sea.period)
    for phase, at in peak(sea.phase(slow[:, :2]), above=LARGEST_PHASE):
        yield (
            warnings.MeanPositionWarning,
            f"vessel {name!r}: is {np.hypot(*slow[at, :2]):.3g} m from where its wave loads are taken at t = "
            f"{time[at]:.6g} s, {phase:.2g} rad of the phase of waves at the peak (limit {LARGEST_PHASE}): "
            f"{WAY_OUT}",
        )
    for turned, at in peak(np.abs(slow[:, 2]), above=LARGEST_TURN):
        yield (
            warnings.MeanHeadingWarning,
            f"vessel {name!r}: yaw reaches {np.degrees(turned):.3g} deg from the heading at which its wave "
            f"loads are taken, at t = {time[at]:.6g} s (limit {np.degrees(LARGEST_TURN):.0f}): the hull has "
            f"left their direction; {WAY_OUT}",
        )


def _under_way(sea: Peak, name: str, time: Array, motion: Array) -> Iterator[Finding]:
    if time.size < 2:
        return
    rate = np.diff(motion[:, :2], axis=0) / np.diff(time)[:, None]
    fast = LARGEST_SHIFT * sea.omega / sea.wavenumber if sea.wavenumber else np.inf
    if np.hypot(*rate.T).max() <= fast:
        return
    for speed, at in peak(np.hypot(*slowly(time[1:], rate, sea.period).T), above=fast):
        yield (
            warnings.ForwardSpeedWarning,
            f"vessel {name!r}: makes {speed:.3g} m/s at t = {time[at + 1]:.6g} s, and meets waves up to "
            f"{sea.wavenumber * speed / sea.omega:.0%} faster or slower, with hydrodynamics of zero speed. "
            "Slow it down, or moor it",
        )


def current_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> Iterator[Finding]:
    """Currents on vessels in waves, where k U along the waves is a tenth of the frequency or more."""
    waves = scene.waves
    if waves is None or not time.size:
        return
    lengths = "of still water" if waves.current is None else "on the current"
    for name, load in scene.loads.items():
        in_water = isinstance(load, _core.FlowForce) and load.density > LIGHTEST_WATER
        if not in_water or load.body not in waves.hulls:
            continue
        speed = float(np.abs(load.speed.evaluate(time)[:, 0]).max())
        flow = speed * np.array([[np.cos(load.direction), np.sin(load.direction)]])
        shift = float(peak_of(scene).phase(flow)[0]) / peak_of(scene).omega
        if shift > LARGEST_SHIFT:
            yield (
                warnings.CurrentInWavesWarning,
                f"current {name!r}: {speed:.3g} m/s on vessel {load.body!r} shift the frequency of waves at "
                f"the peak by {shift:.0%} between the water and a fixed place; wave lengths are those "
                f"{lengths}, loads those without flow. Give the spectrum as measured at a fixed place, and "
                "take motions in this current as an estimate",
            )


def relative_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> Iterator[Finding]:
    """Pairs of a group whose mean relative place or heading is out of range."""
    moved, waves = {vessel.name: motion for vessel, motion in motions(scene, channels)}, scene.waves
    pairs = [(name, pair) for name, group in scene.groups.items() for pair in combinations(group.vessels, 2)]
    if pairs and waves is not None and time[-1] - time[0] < peak_of(scene).period:
        return  # within one wave there is no mean
    for name, (one, other) in pairs:
        if not {one, other} <= moved.keys():
            continue
        fast = _relative(scene, (one, other), (moved[one], moved[other]))
        mean = np.broadcast_to(fast.mean(axis=0), fast.shape)
        slow = mean if waves is None else slowly(time, fast, peak_of(scene).period)
        gap = gap_between(scene, one, other)
        far, turned = np.hypot(*slow[:, :2].T), np.abs(slow[:, 2])
        if far.max() <= LARGEST_GAP_SHARE * gap and turned.max() <= LARGEST_RELATIVE_TURN:
            continue
        at = int(far.argmax())
        yield (
            warnings.RelativePlaceWarning,
            f"group {name!r}: {other!r} leaves its place beside {one!r} by {far[at]:.3g} m on the average "
            f"at t = {time[at]:.6g} s and its heading by {np.degrees(turned.max()):.3g} deg (limits: "
            f"{LARGEST_GAP_SHARE * gap:.3g} m, a tenth of the gap of {gap:.3g} m, and "
            f"{np.degrees(LARGEST_RELATIVE_TURN):.0f} deg). Moor them closer to the places of the group's "
            "data, or compute the group where they go",
        )


def _relative(scene: Description, pair: tuple[str, str], moved: tuple[Array, Array]) -> Array:
    """The second from its place beside the first: m in axes that follow the first, and rad, shape (n, 3)."""
    bodies = [scene.bodies[scene.vessels[name].body] for name in pair]
    starts = [np.asarray(body.position)[:2] for body in bodies]
    places = [
        start + motion[:, :2] @ rotation_about_z(heading_of(body.quaternion))[:2, :2].T
        for start, body, motion in zip(starts, bodies, moved, strict=True)
    ]
    apart, yaw = places[1] - places[0], moved[0][:, 5]
    followed = (apart[:, 0] + 1j * apart[:, 1]) * np.exp(-1j * yaw)
    followed = np.column_stack([followed.real, followed.imag])
    turn = np.unwrap(moved[1][:, 5]) - np.unwrap(yaw)
    return np.column_stack([followed - (starts[1] - starts[0]), turn])


def gap_between(scene: Description, one: str, other: str) -> float:
    """Least distance (m) of the rectangles of length and breadth of two vessels at the start.

    Of hulls whose rectangles overlap, as a float about a spar, the smaller breadth.
    """
    sizes = []
    for vessel in (scene.vessels[one], scene.vessels[other]):
        if not isinstance(vessel.database, HydroDatabase):
            return float("inf")
        sizes.append((scene.bodies[vessel.body], vessel.database.length, vessel.database.breadth))
    apart = [
        beside(own[0], hull.position + rotation_about_z(heading_of(hull.quaternion)) @ corner, *own[1:])
        for own, (hull, length, breadth) in (sizes, sizes[::-1])
        for corner in CORNERS * [length, breadth, 0.0]
    ]
    return min(apart) if min(apart) > 0.0 else float(min(breadth for _, _, breadth in sizes))


def beside(hull: _core.Body, place: Array, length: float, breadth: float) -> float:
    """Horizontal distance of a place from the box of a hull, m; 0 within it."""
    x, y, _ = rotation_matrix(hull.quaternion).T @ (place - np.asarray(hull.position))
    return float(np.hypot(max(abs(x) - 0.5 * length, 0.0), max(abs(y) - 0.5 * breadth, 0.0)))
