"""Where the motions of a run left the range in which its models hold: each a warning, once, after the run."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.validity.after_run import tried
from seacrane.validity.current_in_waves import current_findings
from seacrane.validity.energy import energy_findings
from seacrane.validity.following import following
from seacrane.validity.hull_range import hull_findings, motions
from seacrane.validity.lifting import lifting
from seacrane.validity.line_checks import line_findings
from seacrane.validity.relative_place import relative_findings
from seacrane.warnings import (
    FullTurnWarning,
    LargeHeelWarning,
    NearSingularWarning,
    OutsideDatabaseWarning,
    PushingLinkWarning,
)

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
Channels = Mapping[str, Array]
Finding = tuple[type[Warning], str]

LARGEST_HEEL = np.radians(20.0)  # of roll and pitch: the sine of it is 2 % off, a righting arm 10 % and more
FOREIGN_SHARE = 0.2  # of the energy of a motion, outside the database
LEAST_RATE = 1e-3  # m/s, rad/s: motions below it do not matter
FEWEST_OUTPUTS = 32
FEWEST_PERIODS = 3.0  # of a database's highest frequency, in a record that tells what is above it


def findings(
    scene: Description,
    time: Array,
    channels: Channels,
    stats: Mapping[str, Any],
    steered: Collection[str] = (),
    *,
    described: bool = True,
) -> list[Finding]:
    """All that is out of range in a run: warning classes and messages. Channels left out are not judged.

    `steered` names actuators that a controller has moved: they do not follow their references alone.
    `described` says whether the run began in the pose that the scene describes.
    """
    found: list[Finding] = []
    looks = (
        _heel,
        hull_findings,
        relative_findings,
        current_findings,
        _frequencies,
        _links,
        lifting,
        _turns,
        energy_findings,
    )
    for look in looks:
        what = f"looking at {look.__name__.strip('_')}"
        found += tried(what, partial(look, scene, time, channels), [], found)
    lines = partial(line_findings, scene, time, channels, described=described)
    found += tried("looking at lines", lines, [], found)
    found += tried("following", partial(following, scene, time, channels, steered), [], found)
    return found + _singular(scene, stats)


def as_text(found: Iterable[Finding]) -> str:
    """One message a line."""
    return "\n".join(message for _, message in found)


def warn_of(found: Iterable[Finding]) -> None:
    """Warn, at the user's line, of what `findings` names."""
    for category, message in found:
        warn_caller(message, category)


def _worst(time: Array, values: Array) -> tuple[float, float]:
    """Largest magnitude and its time."""
    at = int(np.argmax(np.abs(values)))
    return float(np.abs(values[at])), float(time[at])


def _heel(scene: Description, time: Array, channels: Channels) -> list[Finding]:
    return [
        (
            LargeHeelWarning,
            f"vessel {vessel.name!r}: {name} reaches {np.degrees(angle):.3g} deg at t = {at:.6g} s, beyond "
            f"{np.degrees(LARGEST_HEEL):.0f} deg: restoring is linear and wave loads are those of "
            "the upright hull, so that righting moments and capsize are not told. Lower the sea or "
            "the load, add roll damping, or take motions beyond as an alarm only",
        )
        for vessel, motion in motions(scene, channels)
        if vessel.floats
        for name in ("roll", "pitch")
        for angle, at in [_worst(time, motion[:, MOTIONS.index(name)])]
        if angle > LARGEST_HEEL
    ]


def _frequencies(scene: Description, time: Array, channels: Channels) -> list[Finding]:
    """Energy of a vessel's velocities above its database's highest frequency, motion by motion."""
    found: list[Finding] = []
    for vessel, motion in motions(scene, channels):
        known = scene.provenance.get(vessel.name)
        if known is None or known.omega is None or time.size < FEWEST_OUTPUTS:
            continue
        highest = known.omega[1]
        if (time[-1] - time[0]) * highest < 2.0 * np.pi * FEWEST_PERIODS:
            continue
        worst, share = _foreign(time, motion, highest)
        if share > FOREIGN_SHARE:
            found.append(
                (
                    OutsideDatabaseWarning,
                    f"vessel {vessel.name!r}: {share:.0%} of the energy of {MOTIONS[worst]} is above "
                    f"{highest:.4g} rad/s, where database {known.database!r} ends: "
                    "added mass and damping are guessed there. Compute the database to higher frequencies, "
                    "or look for what shakes the vessel that fast",
                )
            )
    return found


def _foreign(time: Array, motion: Array, highest: float) -> tuple[int, float]:
    """The motion with the largest share of energy above a frequency (rad/s), and that share."""
    step = float(time[1] - time[0])
    even = int(time.size) - (abs(time[-1] - time[-2] - step) > 1e-6 * step)  # the last output may be early
    rate = np.diff(motion[:even], axis=0) / step
    rate = rate - rate.mean(axis=0)
    energy = np.abs(np.fft.rfft(rate * np.hanning(len(rate))[:, None], axis=0)) ** 2
    omega = 2.0 * np.pi * np.fft.rfftfreq(len(rate), step)
    total = energy.sum(axis=0)
    share = energy[omega > highest].sum(axis=0) / np.where(total > 0.0, total, 1.0)
    share[rate.std(axis=0) < LEAST_RATE] = 0.0
    return int(share.argmax()), float(share.max())


def _hangs(scene: Description, link: str) -> bool:
    """Whether a body hangs on nothing but this link, as on a wire; other links are rods of a mechanism."""
    ends = {scene.joints[link].first, scene.joints[link].second} - {"ground"}
    others = [joint for name, joint in scene.joints.items() if name != link]
    return any(all(end not in (joint.first, joint.second) for joint in others) for end in ends)


def _links(scene: Description, time: Array, channels: Channels) -> list[Finding]:
    links = [name for name, joint in scene.joints.items() if joint.kind == "distance"]
    found: list[Finding] = []
    for i, name in enumerate(links if "tension" in channels else []):
        tension = channels["tension"][:, i]
        if _hangs(scene, name) and tension.min() < -1e-9 * np.abs(tension).max():
            at = int(tension.argmin())
            found.append(
                (
                    PushingLinkWarning,
                    f"link {name!r}: pushes with {-tension[at]:.4g} N at t = {time[at]:.6g} s, which a wire "
                    "cannot: it would be slack, and its load when it tightens again is not in this result. "
                    f"scene.add_line(joint={name!r}, rung='rigid') makes it a wire",
                )
            )
    return found


def _turns(scene: Description, time: Array, channels: Channels) -> list[Finding]:
    values = channels.get("coordinate")
    found: list[Finding] = []
    for i, (name, (_, kind)) in enumerate(scene.recorded.items()):
        if values is None or kind != "angle":
            continue
        jumps = np.flatnonzero(np.abs(np.diff(values[:, i])) > np.pi)
        if jumps.size:
            found.append(
                (
                    FullTurnWarning,
                    f"coordinate {name!r}: passes 180 deg {jumps.size} time(s), first at t = "
                    f"{time[jumps[0] + 1]:.6g} s: it is recorded between -180 and 180 deg and jumps there, "
                    "and an actuator more than half a turn behind its reference pulls the other way. Unwrap "
                    "it by numpy.unwrap; keep references within half a turn of the motion",
                )
            )
    return found


def _singular(scene: Description, stats: Mapping[str, Any]) -> list[Finding]:
    if not stats.get("rank_changed"):
        return []
    value = stats["smallest_singular_value"]
    return [
        (
            NearSingularWarning,
            f"joint {stats['smallest_pivot_joint']!r}: its constraints came to depend on the others at t = "
            f"{stats['smallest_pivot_at_s']:.6g} s (relative singular value {value:.2g}): the mechanism "
            "can branch there, as at a dead centre; it went on by inertia, and reactions there are not "
            "unique. Look at energy_balance, which tells what was lost there; keep away from the position, "
            "or give the joint more freedom",
        )
    ]
