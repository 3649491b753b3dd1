"""Cheap models of a run in the very waves of its seed, as control variates."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane import _core
from seacrane.description.crane_parts import hooks
from seacrane.description.pick import Pick
from seacrane.description.wet_parts import wet_bodies
from seacrane.ensembles.linear_motions import LinearMotions, Motion, motion_of
from seacrane.ensembles.members import Value
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.scene.scene import Scene

Array = NDArray[np.float64]
EXTREMES = {"maximum": np.max, "minimum": np.min}


class _Control(ABC):
    """A series for each seed, and its extremes."""

    _motions: LinearMotions

    @property
    def times(self) -> Array:
        """s, shape (n,)."""
        return self._motions.times

    @abstractmethod
    def series(self, seed: int) -> Array:
        """The series of a seed at `times`, shape (n,)."""

    def extremes(self, seeds: Iterable[int], *, what: str = "maximum") -> Array:
        """The largest ("maximum") or smallest ("minimum") value of each seed."""
        if what not in EXTREMES:
            raise SceneError(f"control: what is {shown(what)}; choose 'maximum' or 'minimum'")
        return np.array([EXTREMES[what](self.series(seed)) for seed in seeds])


class LinearControl(_Control):
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
        self._motions = LinearMotions(
            scene, [motion_of(channel, point)],
            t_end=t_end, after=after, dt_out=dt_out, words=words, state=state,
        )  # fmt: skip

    def series(self, seed: int) -> Array:
        """The motion of a seed at `times`, shape (n,)."""
        return np.asarray(self._motions.series(seed)[0])


class HookLoadControl(_Control):
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
        lift = Motion(channel="acceleration", body=joint.first, axis="z", point=head)
        self._motions = LinearMotions(
            scene, [*motions, lift], t_end=t_end, after=after, dt_out=dt_out, words=words, state=state
        )

    def series(self, seed: int) -> Array:
        """The load in the link of a seed at `times`, N, shape (n,)."""
        *ends, lift = self._motions.series(seed)
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
