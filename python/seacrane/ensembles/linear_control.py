"""The linear response to the very waves of a seed: a cheap model of a run, as a control variate."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.analysis.frequency_domain import component_forces
from seacrane.analysis.linear_system import Resolvent, linear_model
from seacrane.ensembles.members import Value
from seacrane.ensembles.other_sea import WORDS, Databases, require_same_sea, with_sea
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.shown import shown
from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
Complex = NDArray[np.complex128]
AXES = ("x", "y", "z", "roll", "pitch", "yaw")
EXTREMES = {"maximum": np.max, "minimum": np.min}
MOST_TIMES = 10**6


class LinearControl:
    """A motion of the linearised scene, from rest, in the waves of any seed.

    Its extremes go along with those of runs of the same seeds as far as the lift is linear: an acceleration
    of the load with its hook load, a motion with that motion. A seed takes milliseconds.

    Parameters
    ----------
    scene : Scene
        With a sea of one wave system, whose seed varies.
    database : HydroDatabase or mapping
        With which its sea was added, by vessel where there are several.
    body : str
    axis : str
        "x", "y", "z" of the point, or "roll", "pitch", "yaw" of the body's rotation vector; inertial frame.
    t_end, after, dt : float
        Times as of the runs, s: until when, from when on extremes are taken, and between outputs.
    point : array_like, shape (3,), optional
        Body coordinates, m; default: the centre of mass, as of the channel `position`.
    derivative : int
        0: motion, m or rad. 1: speed. 2: acceleration.
    words : mapping
        Other words of the sea than the seed, such as ``{"hs": 2.0}``.
    state : State, optional
        At rest, about which the scene is linearised; default ``equilibrium(scene)``.

    Raises
    ------
    SceneError
        For a scene without such a sea, a value that makes no sense, or a vessel whose memory is a
        convolution.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        database: Databases,
        body: str,
        axis: str,
        t_end: float,
        after: float = 0.0,
        dt: float = 0.1,
        point: ArrayLike | None = None,
        derivative: int = 0,
        words: Mapping[str, Value] | None = None,
        state: _core.State | None = None,
    ) -> None:
        if axis not in AXES:
            raise SceneError(f"control: axis is {shown(axis)}; choose from {', '.join(AXES)}")
        if derivative not in (0, 1, 2):
            raise SceneError(f"control: derivative is {shown(derivative)}; give 0, 1 or 2")
        self._words = dict(words or {})
        for word in self._words:
            if word not in WORDS or word == "seed":
                raise SceneError(f"control: {word!r} is no word of the sea beside its seed")
        require_same_sea(scene, database, ("seed", *self._words))
        assert scene.waves is not None
        self._scene, self._databases = scene.copy(), database
        linear = linear_model(scene, state=state, vessel=next(iter(scene.waves.hulls)))
        if linear.memories:
            raise SceneError(
                "control: the memory of a vessel is a convolution, whose start from rest the linear model "
                "does not know; take memory='per-pair' or 'passive'"
            )
        self._times = _times(t_end, after, dt)
        self._by_vessel = {vessel: linear.excited(vessel).b for vessel in scene.waves.hulls}
        self._resolvent, self._derivative = Resolvent(linear), derivative
        place = _center_of_mass(scene, body) if point is None else point
        self._row = linear.output(body=body, point=place)[AXES.index(axis)]
        self._decay = _decay(linear.a, self._row, self._times, derivative)

    @property
    def times(self) -> Array:
        """s, shape (n,)."""
        return self._times

    def series(self, seed: int) -> Array:
        """The motion of a seed at `times`, shape (n,)."""
        sea = with_sea(self._scene, self._databases, {**self._words, "seed": int(seed)}).waves
        assert sea is not None
        omega, forces = component_forces(sea)
        rates: Complex = np.zeros((omega.size, self._row.size), dtype=complex)
        for vessel, force in forces.items():
            rates += force @ self._by_vessel[vessel].T
        x = self._resolvent.response(omega, rates)
        steady = _sum_of(omega, (x @ self._row) * (1j * omega) ** self._derivative, self._times)
        return np.asarray(steady - self._decay @ x.sum(axis=0).real)

    def extremes(self, seeds: Iterable[int], *, what: str = "maximum") -> Array:
        """The largest ("maximum") or smallest ("minimum") value of each seed."""
        if what not in EXTREMES:
            raise SceneError(f"control: what is {shown(what)}; choose 'maximum' or 'minimum'")
        return np.array([EXTREMES[what](self.series(seed)) for seed in seeds])


def _center_of_mass(scene: Scene, body: str) -> ArrayLike:
    return scene.bodies[body].center_of_mass if body in scene.bodies else (0.0, 0.0, 0.0)


def _times(t_end: Any, after: Any, dt: Any) -> Array:
    end, begin, step = (
        number_of(f"control: {n}", v) for n, v in (("t_end", t_end), ("after", after), ("dt", dt))
    )
    if not (0.0 <= begin < end and 0.0 < step <= end - begin and end / step < MOST_TIMES):
        raise SceneError(
            f"control: t_end is {end:g} s, after {begin:g} s, dt {step:g} s; give outputs between after and "
            f"t_end, at most {MOST_TIMES}"
        )
    times = step * np.arange(round(end / step) + 1)
    return np.asarray(times[times >= begin - 1e-9 * step])


def _decay(a: Array, row: Array, times: Array, derivative: int) -> Array:
    """What is left at each time of a motion per state at the start, shape (n, states)."""
    from scipy.linalg import expm

    now = row @ np.linalg.matrix_power(a, derivative) @ expm(a * times[0])
    step = expm(a * (times[1] - times[0]))
    out = np.empty((times.size, len(a)))
    for place in range(times.size):
        out[place] = now
        now = now @ step
    return out


def _sum_of(omega: Array, amplitude: Complex, times: Array) -> Array:
    """Sum of Re amplitude exp(i omega t) at even times: by blocks, which take few exponentials."""
    inside = int(np.ceil(np.sqrt(times.size)))
    step = times[1] - times[0]
    blocks = times[0] + step * inside * np.arange(int(np.ceil(times.size / inside)))
    first = amplitude * np.exp(1j * np.outer(blocks, omega))
    then = np.exp(1j * np.outer(omega, step * np.arange(inside)))
    return np.asarray((first.real @ then.real - first.imag @ then.imag).reshape(-1)[: times.size])
