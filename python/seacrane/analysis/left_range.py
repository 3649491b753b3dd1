"""Where the motions of a run left the range in which its models hold: each a warning, once, after the run."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import warnings
from seacrane.analysis.after_run import Finding, peak, tried
from seacrane.analysis.hull_range import current_findings, hull_findings, motions, relative_findings
from seacrane.analysis.lifting import lifting
from seacrane.analysis.line_checks import line_findings
from seacrane.arrays import Array
from seacrane.description.places import ANGLES, Pose, coordinate_at, wrapped
from seacrane.inputs.frames import MOTIONS, rotation_matrix

if TYPE_CHECKING:
    from seacrane import _core
    from seacrane.description.description import Description

Channels = Mapping[str, Array]
Look = Callable[["Description", Array, Channels], Iterable[Finding]]
MOTION, COORDINATE = ("vessel_motion",), ("coordinate", "position")

LARGEST_HEEL = np.radians(20.0)  # of roll and pitch: the sine of it is 2 % off, a righting arm 10 % and more
FOREIGN_SHARE = 0.2  # of the energy of a motion, outside the database
LEAST_RATE = 1e-3  # m/s, rad/s: motions below it do not matter
FEWEST_OUTPUTS = 32
FEWEST_PERIODS = 3.0  # of a database's highest frequency, in a record that tells what is above it
LARGEST_SHARE = 0.1  # of the work, or of the kinetic energy, that the balance of energy may miss
LEAST_RISE = 1e-3  # m times the length scale, by which all bodies are lifted: what does not matter
BEYOND = 0.01  # m times the length scale, or rad: what a control may overshoot a range
SHORT = {True: np.radians(5.0), False: 0.25}  # of a reference: of angles, and m times the length scale
STEADY = 3.0  # standard deviations: an error of the mean, not of a motion about it
LAST = 0.4  # of the outputs, which are judged
FEWEST_FOLLOWED = 16  # outputs


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
    lines, following = partial(line_findings, described=described), partial(_following, steered=steered)
    looks: Mapping[str, tuple[Look, tuple[str, ...]]] = {  # of which one channel must be there
        "heel": (_heel, MOTION), "hulls": (hull_findings, MOTION),
        "places in a group": (relative_findings, MOTION), "currents": (current_findings, ()),
        "frequencies": (_frequencies, MOTION), "links": (_links, ("tension",)),
        "lifting": (lifting, ("position",)), "turns": (_turns, ("coordinate",)),
        "energy": (_energy, ("energy_balance",)),
        "lines": (lines, ("line_unstretched_length", "sheave_fleet_angle")),
        "ranges": (_ranges, COORDINATE), "following": (following, COORDINATE),
    }  # fmt: skip
    for what, (look, judged) in looks.items():
        if not judged or not channels.keys().isdisjoint(judged):
            found += tried(f"looking at {what}", partial(_listed, look, scene, time, channels), [], found)
    return [*found, *_singular(stats)]


def _listed(look: Look, scene: Description, time: Array, channels: Channels) -> list[Finding]:
    return list(look(scene, time, channels))


def _heel(scene: Description, time: Array, channels: Channels) -> Iterator[Finding]:
    for vessel, motion in motions(scene, channels):
        for name, angles in zip(MOTIONS[3:5], motion.T[3:5], strict=True) if vessel.floats else ():
            for angle, at in peak(np.abs(angles), above=LARGEST_HEEL):
                yield (
                    warnings.LargeHeelWarning,
                    f"vessel {vessel.name!r}: {name} reaches {np.degrees(angle):.3g} deg at t = "
                    f"{time[at]:.6g} s, beyond {np.degrees(LARGEST_HEEL):.0f} deg, of which restoring and "
                    "wave loads know nothing. Lower the sea or the load, add roll damping, or take motions "
                    "beyond as an alarm only",
                )


def _frequencies(scene: Description, time: Array, channels: Channels) -> Iterator[Finding]:
    """Energy of a vessel's velocities above its database's highest frequency, motion by motion."""
    for vessel, motion in motions(scene, channels):
        known = scene.provenance.get(vessel.name)
        if known is None or known.omega is None or time.size < FEWEST_OUTPUTS:
            continue
        highest = known.omega[1]
        if (time[-1] - time[0]) * highest < 2.0 * np.pi * FEWEST_PERIODS:
            continue
        worst, share = _foreign(time, motion, highest)
        if share > FOREIGN_SHARE:
            yield (
                warnings.OutsideDatabaseWarning,
                f"vessel {vessel.name!r}: {share:.0%} of the energy of {MOTIONS[worst]} is above "
                f"{highest:.4g} rad/s, where database {known.database!r} ends. Compute it to higher "
                "frequencies, or look for what shakes the vessel that fast",
            )


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


def _links(scene: Description, time: Array, channels: Channels) -> Iterator[Finding]:
    links = [name for name, joint in scene.joints.items() if joint.kind == "distance"]
    for i, name in enumerate(links):
        tension = channels["tension"][:, i]
        ends = {scene.joints[name].first, scene.joints[name].second} - {"ground"}
        others = [joint for other, joint in scene.joints.items() if other != name]
        # A body hangs on nothing but this link, as on a wire; other links are rods of a mechanism.
        hangs = any(all(end not in (joint.first, joint.second) for joint in others) for end in ends)
        push = peak(-tension, above=1e-9 * np.abs(tension).max()) if hangs else ()
        for force, at in push:
            yield (
                warnings.PushingLinkWarning,
                f"link {name!r}: pushes with {force:.4g} N at t = {time[at]:.6g} s, which a wire cannot. "
                f"scene.add_line(joint={name!r}, rung='rigid') makes it a wire",
            )


def _jumps(time: Array, angle: Array) -> tuple[int, float]:
    """How often an angle (n,) passes half a turn, and when first, s."""
    jumps = np.flatnonzero(np.abs(np.diff(angle)) > np.pi)
    return jumps.size, float(time[jumps[0] + 1]) if jumps.size else np.nan


def _turns(scene: Description, time: Array, channels: Channels) -> Iterator[Finding]:
    for i, (name, (_, kind)) in enumerate(scene.recorded.items()):
        count, first = _jumps(time, channels["coordinate"][:, i]) if kind == "angle" else (0, 0.0)
        if count:
            yield (
                warnings.FullTurnWarning,
                f"coordinate {name!r}: passes 180 deg {count} time(s), first at t = {first:.6g} s: it is "
                "recorded between -180 and 180 deg, and jumps there. Unwrap it by numpy.unwrap; keep "
                "references within half a turn of the motion",
            )


def _energy(scene: Description, time: Array, channels: Channels) -> Iterator[Finding]:
    """Runs whose balance does not close by far: what was computed is no motion of the scene."""
    if not {"energy_balance", "absolute_work", "velocity"} <= channels.keys() or not time.size:
        return
    mass = np.array([body.mass for body in scene.bodies.values()])
    with np.errstate(over="ignore", invalid="ignore"):
        kinetic = 0.5 * np.einsum("k,nki,nki->n", mass, channels["velocity"], channels["velocity"])
        work = np.asarray(channels["absolute_work"])
        error = np.abs(np.asarray(channels["energy_balance"]))
        least = LEAST_RISE * scene.length_scale * scene.gravity * float(mass.sum())
        size = max(float(work.max()), float(kinetic.max()), least)
        off = np.flatnonzero(error > LARGEST_SHARE * size)
    if off.size and size != 0.0:
        worst = float(error.max())
        yield (
            warnings.EnergyErrorWarning,
            f"run: energy_balance reaches {worst:.3g} J, {worst / size:.2g} of work and kinetic energy, "
            f"from t = {time[off[0]]:.6g} s on: this is not the scene's motion. Give a shorter dt, a tighter "
            "rtol or an adaptive integrator; where it stays, a load tells a power that is not its force's",
        )


def _singular(stats: Mapping[str, Any]) -> Iterator[Finding]:
    if stats.get("rank_changed"):
        yield (
            warnings.NearSingularWarning,
            f"joint {stats['smallest_pivot_joint']!r}: its constraints came to depend on the others at t = "
            f"{stats['smallest_pivot_at_s']:.6g} s (relative singular value "
            f"{stats['smallest_singular_value']:.2g}): the mechanism can branch there, and went on by "
            "inertia. Look at energy_balance; keep away from the position, or give the joint more freedom",
        )


def _values(scene: Description, joint: str, coordinate: str, channels: Channels) -> Array | None:
    """A coordinate at the outputs (n,), or None where nothing recorded tells it."""
    places, bodies = list(scene.recorded.values()), list(scene.bodies)
    if "coordinate" in channels and (joint, coordinate) in places:
        return channels["coordinate"][:, places.index((joint, coordinate))]

    def pose(body: str) -> Pose:
        at = bodies.index(body)
        return channels["position"][:, at], rotation_matrix(channels["quaternion"][:, at])

    posed = {"position", "quaternion"} <= channels.keys()
    return coordinate_at(scene, joint, coordinate, pose) if posed else None


def _ranges(scene: Description, time: Array, channels: Channels) -> Iterator[Finding]:
    """Coordinates that left their ranges."""
    for name, limit in scene.ranges.items():
        values = _values(scene, limit.joint, limit.coordinate, channels)
        if values is None:
            continue
        angular = limit.coordinate in ANGLES
        beyond = np.maximum(limit.minimum - values, values - limit.maximum)
        for _, at in peak(beyond, above=BEYOND * (1.0 if angular else scene.length_scale)):
            yield (
                warnings.OutsideRangeWarning,
                f"range {name!r}: {limit.joint}.{limit.coordinate} reaches {values[at]:.4g} "
                f"{'rad' if angular else 'm'} at t = {time[at]:.6g} s, outside {limit.minimum:.4g} to "
                f"{limit.maximum:.4g} from the described pose: the real one ends there. Correct reference or "
                "gains, or add its end stops (Scene.add_stop)",
            )


def _following(
    scene: Description, time: Array, channels: Channels, steered: Collection[str]
) -> Iterator[Finding]:
    """Actuators that did not go where their references led them."""
    for name, actuator in scene.actuators.items():
        if name in steered or not _holds(actuator):
            continue
        values = _values(scene, actuator.joint, actuator.coordinate, channels)
        if values is None:
            continue
        error = actuator.reference.evaluate(time)[:, 0] - values
        if actuator.coordinate in ANGLES:
            error = wrapped(error)
            count, first = _jumps(time, error)
            if count:
                yield (
                    warnings.FullTurnWarning,
                    f"actuator {name!r}: came to be half a turn from its reference {count} time(s), first at "
                    f"t = {first:.6g} s, and was driven the other way round from there. Lead it by a slower "
                    "reference, or give it stronger gains",
                )
        if actuator.stiffness == 0.0 or actuator.damping > 0.0:  # else a spring
            yield from _short(scene, actuator, error)


def _holds(actuator: _core.Actuator) -> bool:
    """Whether an actuator has a reference to follow: a controller's gains, or a curve that says so."""
    if actuator.stiffness > 0.0:
        return actuator.damping > 0.0 or actuator.coordinate in ANGLES
    return bool(np.any(actuator.reference.to_pieces()["coefficients"]))


def _short(scene: Description, actuator: _core.Actuator, error: Array) -> Iterator[Finding]:
    last = error[-max(int(LAST * error.size), 1) :]
    angular = actuator.coordinate in ANGLES
    limit = SHORT[angular] * (1.0 if angular else scene.length_scale)
    mean = float(last.mean())
    if error.size < FEWEST_FOLLOWED or abs(mean) <= limit or abs(mean) <= STEADY * float(last.std()):
        return
    away = f"{np.degrees(mean):.4g} deg" if angular else f"{mean:.4g} m"
    yield (
        warnings.SoftGainsWarning,
        f"actuator {actuator.name!r}: ends {away} from its reference: stiffness {actuator.stiffness:.4g} and "
        f"damping {actuator.damping:.4g} {'N m/rad, N m s/rad' if angular else 'N/m, N s/m'} are too soft "
        "for what it carries. Give stiffness = inertia * omega**2 with omega well above the motion "
        "(seacrane.analysis.reflected_inertia), or its load as feed_forward (seacrane.balance)",
    )
