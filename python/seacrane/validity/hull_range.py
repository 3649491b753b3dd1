"""Where hulls left what their wave loads and moorings hold for: each a warning, once, after the run."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.given import given_vessels
from seacrane.description.once import once
from seacrane.inputs.frames import heading_of, rotation_about_z
from seacrane.warnings import (
    ForwardSpeedWarning,
    MeanHeadingWarning,
    MeanPositionWarning,
    MooringTurnWarning,
    NoWaveLoadsWarning,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from seacrane import _core
    from seacrane.description.description import Description
    from seacrane.description.waves import HullLoads, Waves

Array = NDArray[np.float64]
Finding = tuple[type[Warning], str]

LARGEST_PHASE = (
    0.3  # rad, of the slow drift over the wavelength of the peak: 30 % of the load is out of phase
)
LARGEST_TURN = np.radians(10.0)
LARGEST_SHIFT = 0.1  # of the encounter frequency from the wave's, as a share
SLOW = 2.0  # peak periods: what two running means over so many leave of a motion is slow
TINY = float(np.finfo(float).tiny)
BINS = 32  # of the band, in which the peak is looked for


def motions(
    scene: Description, channels: Mapping[str, Array]
) -> Iterator[tuple[_core.VesselHydrodynamics, Array]]:
    """Every vessel with its six motions (n, 6), as far as they are recorded."""
    recorded = channels.get("vessel_motion")
    if recorded is not None:
        for i, vessel in enumerate(scene.vessels.values()):
            yield vessel, recorded if recorded.ndim == 2 else recorded[:, i]


def hull_findings(scene: Description, time: Array, channels: Mapping[str, Array]) -> list[Finding]:
    """What is out of range of wave loads and moorings, vessel by vessel."""
    found: list[Finding] = []
    waves = scene.waves
    peak: Peak | None = None
    given = given_vessels(scene)
    for vessel, motion in motions(scene, channels):
        if vessel.body in given:
            found += _unmoved(vessel.name, given[vessel.body], waves, vessel.body)
            continue
        found += _moored(vessel, time, motion)
        if waves is None:
            continue
        if vessel.body not in waves.hulls:
            found.append((NoWaveLoadsWarning, _unloaded(vessel.name, waves)))
            continue
        hull = waves.hulls[vessel.body]
        peak = peak or peak_of(scene)
        if hull.force_by_heading is None:
            found += _posed(scene.bodies[vessel.body], vessel.name, hull, peak, time, motion)
        found += _under_way(peak, vessel.name, time, motion)
    return found


@dataclass(frozen=True, kw_only=True)
class Peak:
    """Peak of a sea: frequency (rad/s) and wavenumber (1/m) of its densest energy, and the mean of e e^T
    over the directions of travel e."""

    omega: float
    wavenumber: float
    spread: Array

    @classmethod
    def of(cls, waves: Waves) -> Peak:
        """By the components."""
        components = waves.components()
        omega = peak_frequency(waves)
        nearest = int(np.argmin(np.abs(np.asarray(waves.omega) - omega)))
        travel = np.stack([np.cos(components.direction), np.sin(components.direction)])
        energy = np.asarray(components.amplitude) ** 2
        spread = (travel * energy) @ travel.T / max(energy.sum(), TINY)
        return cls(omega=omega, wavenumber=float(components.wavenumber[nearest]), spread=spread)

    @property
    def period(self) -> float:
        """s."""
        return 2.0 * np.pi / self.omega

    def phase(self, place: Array) -> Array:
        """Phase of waves at the peak, over displacements (n, 2), m: root mean square over directions, rad."""
        return np.asarray(self.wavenumber * np.sqrt(np.sum((place @ self.spread) * place, axis=1)))


@once
def peak_of(scene: Description) -> Peak:
    """The peak of the sea of a scene that has one."""
    assert scene.waves is not None
    return Peak.of(scene.waves)


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
    start: _core.Body, name: str, hull: HullLoads, peak: Peak, time: Array, motion: Array
) -> list[Finding]:
    """How far the hull is, slowly, from the place and heading of its loads."""
    heading = heading_of(start.quaternion)
    place = motion[:, :2] @ rotation_about_z(heading)[:2, :2].T + (start.position[:2] - hull.position)
    turn = math.remainder(heading - hull.heading, 2.0 * np.pi)
    # A mean is never farther than what it is taken of.
    near = peak.phase(place).max() <= LARGEST_PHASE
    if near and np.abs(motion[:, 5]).max() + abs(turn) <= LARGEST_TURN:
        return []
    slow = slowly(time, np.column_stack([place, np.unwrap(motion[:, 5]) + turn]), peak.period)
    found: list[Finding] = []
    far, turned = peak.phase(slow[:, :2]), np.abs(slow[:, 2])
    way_out = (
        "take them where the vessel slowly goes by phase='slow' in add_sea, "
        "where it is on the average by position and heading_deg there, or moor it stiffer"
    )
    if far.max() > LARGEST_PHASE:
        at = int(far.argmax())
        found.append(
            (
                MeanPositionWarning,
                f"vessel {name!r}: is {np.hypot(*slow[at, :2]):.3g} m from where its wave loads are "
                f"taken at t = {time[at]:.6g} s, {far[at]:.2g} rad of the phase of waves at the peak "
                f"(limit {LARGEST_PHASE}): {way_out}",
            )
        )
    if turned.max() > LARGEST_TURN:
        at = int(turned.argmax())
        found.append(
            (
                MeanHeadingWarning,
                f"vessel {name!r}: yaw reaches {np.degrees(turned[at]):.3g} deg from the heading at "
                f"which its wave loads are taken, at t = {time[at]:.6g} s (limit "
                f"{np.degrees(LARGEST_TURN):.0f}): the hull has left their direction; {way_out}",
            )
        )
    return found


def _under_way(peak: Peak, name: str, time: Array, motion: Array) -> list[Finding]:
    if time.size < 2:
        return []
    rate = np.diff(motion[:, :2], axis=0) / np.diff(time)[:, None]
    if peak.wavenumber * np.hypot(*rate.T).max() <= LARGEST_SHIFT * peak.omega:
        return []
    speed = np.hypot(*slowly(time[1:], rate, peak.period).T)
    at = int(speed.argmax())
    shift = peak.wavenumber * speed[at] / peak.omega
    if shift <= LARGEST_SHIFT:
        return []
    return [
        (
            ForwardSpeedWarning,
            f"vessel {name!r}: makes {speed[at]:.3g} m/s at t = {time[at + 1]:.6g} s, and its hydrodynamics "
            f"are those of zero speed: waves are met up to {shift:.0%} faster or slower, and added mass, "
            "damping and wave loads change with it, which the time domain does not know. Slow it down, or "
            "moor it",
        )
    ]


def _moored(vessel: _core.VesselHydrodynamics, time: Array, motion: Array) -> list[Finding]:
    passed = np.abs(np.diff(motion[:, 5])) > np.pi
    if vessel.mooring_stiffness[2] == 0.0 or not passed.any():
        return []
    at = int(np.argmax(passed)) + 1
    return [
        (
            MooringTurnWarning,
            f"vessel {vessel.name!r}: passes half a turn from its rest at t = {time[at]:.6g} s, where its "
            "mooring in yaw, a spring of the angle to the nearest whole turn, pulls the other way: it does "
            "not stop a turning vessel. Give it a stiffer mooring, or look for what turns it",
        )
    ]


def _unmoved(name: str, motion: str, waves: Waves | None, body: str) -> list[Finding]:
    """A ship that would move by RAOs in a sea that it was not put into."""
    if motion != "raos" or waves is None or body in waves.hulls:
        return []
    return [
        (
            NoWaveLoadsWarning,
            f"vessel {name!r}: rests in the sea that {', '.join(map(repr, waves.hulls))} meets, and would "
            f"follow its RAOs there; call scene.add_sea(vessel={body!r})",
        )
    ]


def _unloaded(name: str, waves: Waves) -> str:
    return (
        f"vessel {name!r}: floats in the sea that loads {', '.join(map(repr, waves.hulls))}, and has no wave "
        f"loads itself; call scene.add_sea(vessel={name!r})"
    )
