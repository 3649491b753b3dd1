"""Cheap models of a run in the very waves of its seed, as control variates."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.drag_in_sea import drag_in_components
from seacrane.analysis.frequency_domain import component_forces
from seacrane.analysis.frequency_memory import Resolvent
from seacrane.analysis.linear_system import LinearModel, linear_model
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.arrays import Array, Complex
from seacrane.description.channels import CHANNELS, FIXED
from seacrane.description.crane_parts import hooks
from seacrane.description.pick import Pick, pick_of
from seacrane.description.wet_parts import wet_bodies
from seacrane.ensembles.members import Value
from seacrane.ensembles.other_sea import WORDS, other_sea, require_same_sea
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.frames import heading_of, rotation_about_z
from seacrane.inputs.shown import shown
from seacrane.one_thread import one_thread
from seacrane.scene.scene import Scene

EXTREMES = {"maximum": np.max, "minimum": np.min}
ANGLES = ("heel", "trim", "yaw")
ORDERS = {  # of the derivatives that channels are
    **dict.fromkeys(("position", *ANGLES), 0),
    **dict.fromkeys(("velocity", "angular_velocity"), 1),
    **dict.fromkeys(("acceleration", "angular_acceleration"), 2),
}
MOST_TIMES = 10**6


@dataclass(frozen=True, kw_only=True)
class Motion:
    """One coordinate of a point of a body that rests upright, or its rate of a higher order."""

    channel: str  # one of `ORDERS`
    body: str
    axis: str = ""  # x, y or z; nothing of an angle
    point: ArrayLike | None = None  # body coordinates, m; None: the centre of mass

    def row(self, linear: LinearModel) -> Array:
        """The weights of the states of a linear model."""
        body = linear.scene.bodies.get(self.body)
        place = self.point if self.point is not None or body is None else body.center_of_mass
        rows = linear.output(body=self.body, point=(0.0, 0.0, 0.0) if place is None else place)
        if self.channel in ANGLES:
            assert body is not None
            turned = rotation_about_z(heading_of(body.quaternion)).T @ rows[3:]
            return np.asarray(turned[ANGLES.index(self.channel)])
        first = 3 if self.channel.startswith("angular") else 0
        return np.asarray(rows[first + FIXED["axis"].index(self.axis)])


def motion_of(channel: str | Pick, point: ArrayLike | None) -> Motion:
    """The motion that a text picks, at a point of its body.

    Raises SceneError for a channel that is no motion of a body, and one that is not a single curve.
    """
    pick = pick_of("control", channel)
    if pick.channel not in ORDERS:
        raise SceneError(f"control: {pick.channel} is no motion of a body; choose from {', '.join(ORDERS)}")
    missing = [dim for dim in CHANNELS[pick.channel].dims_of_several[1:] if dim not in pick.names]
    if missing or pick.parts:
        wrong = f"name its {missing[0]}" if missing else f"give {pick.parts} beside it"
        raise SceneError(f"control: {pick}: {wrong}, as in 'position[load, z]'")
    return Motion(channel=pick.channel, **pick.names, point=point)


def _times(t_end: Any, after: Any, dt_out: Any) -> Array:
    end, begin, step = (
        number_of(f"control: {n}", v) for n, v in (("t_end", t_end), ("after", after), ("dt_out", dt_out))
    )
    if not (0.0 <= begin < end and 0.0 < step <= end - begin and end / step < MOST_TIMES):
        raise SceneError(
            f"control: t_end is {end:g} s, after {begin:g} s, dt_out {step:g} s; give outputs between after "
            f"and t_end, at most {MOST_TIMES}"
        )
    times = step * np.arange(round(end / step) + 1)
    return np.asarray(times[times >= begin - 1e-9 * step])


def _decays(a: Array, rows: Array, orders: Sequence[int], times: Array) -> Array:
    """What is left at each time of motions per state at the start, shape (motions, times, states)."""
    from scipy.linalg import expm

    with one_thread:
        first, step = expm(a * times[0]), expm(a * (times[1] - times[0]))
        now = (
            np.array([row @ np.linalg.matrix_power(a, n) for row, n in zip(rows, orders, strict=True)])
            @ first
        )
    out = np.empty((len(rows), times.size, len(a)))
    for place in range(times.size):
        out[:, place] = now
        now = now @ step
    return out


def _sums_of(omega: Array, amplitudes: Complex, times: Array) -> Array:
    """Sums of Re amplitude exp(i omega t) at even times: by blocks, which take few exponentials."""
    inside = int(np.ceil(np.sqrt(times.size)))
    step = times[1] - times[0]
    blocks = times[0] + step * inside * np.arange(int(np.ceil(times.size / inside)))
    first = amplitudes[:, None, :] * np.exp(1j * np.outer(blocks, omega))
    then = np.exp(1j * np.outer(omega, step * np.arange(inside)))
    sums = first.real @ then.real - first.imag @ then.imag
    return np.asarray(sums.reshape(len(amplitudes), -1)[:, : times.size])


class LinearControl:
    """A motion of the linearised scene, from rest, in the waves of any seed.

    Its extremes go along with those of runs of the same seeds as far as the lift is linear. A seed takes
    milliseconds. Waves load what is under water too, with drag made linear in the sea as described.

    Parameters
    ----------
    scene : Scene
        With a sea of one wave system, whose seed varies.
    channel : str or Pick
        A motion of a body, such as "position[load, z]", "velocity[load, y]" or "heel[vessel]".
    t_end, after, dt_out : float
        Times as of the runs, s: until when, from when on extremes are taken, and between outputs.
    point : array_like, shape (3,), optional
        Body coordinates, m; default: the centre of mass, as of the channel `position`.
    words : mapping
        Other words of the sea than the seed, such as ``{"hs": 2.0}``.
    state : State, optional
        At rest, about which the scene is linearised; default ``equilibrium(scene)``.

    Raises
    ------
    SceneError
        For a scene without such a sea, a value that makes no sense, a vessel whose memory is a convolution,
        or a part in water that crosses the surface at rest.
    """

    def __init__(
        self,
        scene: Scene,
        channel: str | Pick,
        *,
        t_end: float,
        after: float = 0.0,
        dt_out: float = 0.1,
        point: ArrayLike | None = None,
        words: Mapping[str, Value] | None = None,
        state: _core.State | None = None,
    ) -> None:
        self._begin(scene, [motion_of(channel, point)], _times(t_end, after, dt_out), words, state)

    def series(self, seed: int) -> Array:
        """The motion of a seed at `times`, shape (n,)."""
        return np.asarray(self._curves(seed)[0])

    def extremes(self, seeds: Iterable[int], *, what: str = "maximum") -> Array:
        """The largest ("maximum") or smallest ("minimum") value of each seed."""
        if what not in EXTREMES:
            raise SceneError(f"control: what is {shown(what)}; choose 'maximum' or 'minimum'")
        return np.array([EXTREMES[what](self.series(seed)) for seed in seeds])

    def _begin(
        self, scene: Scene, motions: Sequence[Motion], times: Array, words: Mapping[str, Value] | None,
        state: _core.State | None,
    ) -> None:  # fmt: skip
        """Linearise, for motions at even `times` (s); drag is made linear in the sea as described."""
        self._words = dict(words or {})
        for word in self._words:
            if word not in WORDS or word == "seed":
                raise SceneError(f"control: {word!r} is no word of the sea beside its seed")
        require_same_sea(scene, ("seed", *self._words))
        assert scene.waves is not None
        self._scene = scene.copy()
        linear = linear_model(scene, state=state, vessel=next(iter(scene.waves.hulls)))
        if linear.memories:
            raise SceneError(
                "control: the memory of a vessel is a convolution, whose start from rest the linear model "
                "does not know; take a fitted one, such as memory='by-motion'"
            )
        linear = drag_in_components(linear, other_sea(self._scene, self._words))
        self._parts = PartsInWaves(linear)
        self.times = times
        self._by_vessel = {vessel: linear.excited(vessel).b for vessel in scene.waves.hulls}
        self._resolvent = Resolvent(linear.a, linear.scene.name)
        self._rows = np.array([motion.row(linear) for motion in motions])
        self._orders = [ORDERS[motion.channel] for motion in motions]
        self._decays = _decays(linear.a, self._rows, self._orders, self.times)

    def _curves(self, seed: int) -> Array:
        """All motions in the sea of a seed, shape (motions, times)."""
        sea = other_sea(self._scene, {**self._words, "seed": int(seed)})
        omega, forces = component_forces(sea)
        rates: Complex = np.zeros((omega.size, self._rows.shape[1]), dtype=complex)
        for vessel, force in forces.items():
            rates += force @ self._by_vessel[vessel].T
        if self._parts:
            rates += self._parts.rates(omega, self._parts.flow_of(sea))
        x = self._resolvent.response(omega, rates)
        orders = (1j * omega) ** np.array(self._orders)[:, None]
        steady = _sums_of(omega, (self._rows @ x.T) * orders, self.times)
        return np.asarray(steady - self._decays @ x.sum(axis=0).real)


class HookLoadControl(LinearControl):
    """The load in a link by the linear motions of its ends, to second order in the swing.

    m (g + a - g theta^2 / 2 + L theta'^2): of the mass m that hangs L below the upper end of the link, the
    vertical acceleration a of that end and the angle theta of the swing. What follows the square of a swing
    is in no linear response, but in this.

    Parameters
    ----------
    scene : Scene
        With a sea of one wave system, whose seed varies, and a load on a link.
    t_end, after, dt_out, words, state
        As of `LinearControl`.
    link : str, optional
        Joint between crane and load; default: the only one.

    Raises
    ------
    SceneError
        As of `LinearControl`, for a link that is none, and for a load in water.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        t_end: float,
        after: float = 0.0,
        dt_out: float = 0.1,
        link: str | None = None,
        words: Mapping[str, Value] | None = None,
        state: _core.State | None = None,
    ) -> None:
        joint = scene.joints[_link(scene, link)]
        if joint.second in wet_bodies(scene):
            raise SceneError(
                f"control: load {joint.second!r} is in water, which pushes it too, and this knows its weight "
                "alone; take a LinearControl of its motion"
            )
        head, load = np.array(joint.first_frame.point), scene.bodies[joint.second]
        below = np.array(joint.second_frame.point) - np.array(load.center_of_mass)
        self._length = float(np.linalg.norm(below)) + float(joint.parameters["length"])
        self._mass, self._gravity = load.mass, scene.gravity
        motions = [
            Motion(channel=channel, body=body, axis=axis, point=point)
            for axis in ("x", "y")
            for channel in ("position", "velocity")
            for body, point in ((joint.second, None), (joint.first, head))
        ]
        motions.append(Motion(channel="acceleration", body=joint.first, axis="z", point=head))
        self._begin(scene, motions, _times(t_end, after, dt_out), words, state)

    def series(self, seed: int) -> Array:
        """The load in the link of a seed at `times`, N, shape (n,)."""
        *ends, lift = self._curves(seed)
        x, x_rate, y, y_rate = (
            (below - above) / self._length for below, above in zip(ends[::2], ends[1::2], strict=True)
        )
        swing = self._length * (x_rate**2 + y_rate**2) - 0.5 * self._gravity * (x**2 + y**2)
        return np.asarray(self._mass * (self._gravity + lift + swing))


def _link(scene: Scene, name: str | None) -> str:
    known = list(hooks(scene).values())
    if name is None and len(known) == 1:
        return known[0]
    if name not in known:
        told = "no load hangs from a link" if not known else f"choose from {', '.join(known)}"
        raise SceneError(f"control: link is {shown(name)}; {told}")
    return str(name)
