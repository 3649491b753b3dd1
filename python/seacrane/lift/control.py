"""How commanded coordinates are controlled: gains by frequency and damping, feed-forward by statics."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from seacrane._core import Curve
from seacrane.analysis.inverse import Balance, balance, reflected_inertia, tuned_gains
from seacrane.analysis.quasi_static import feed_forward
from seacrane.errors import SceneError
from seacrane.scene.scene import Scene

MOST_TIMES = 10_000  # each takes a rest state
WHOLE = 1e-6  # of an interval


def gains_of(tuning: Scene, settings: Mapping[str, Any]) -> dict[str, tuple[float, float]]:
    """Stiffness and damping of every actuator of a scene, by [control]."""
    for key in ("natural_frequency", "damping_ratio"):
        if not settings[key] > 0.0:
            raise SceneError(f"{key} is {settings[key]:g}; give a number above zero")
    return tuned_gains(
        reflected_inertia(tuning),
        natural_frequency=2.0 * np.pi * settings["natural_frequency"],
        damping_ratio=settings["damping_ratio"],
    )


def feed_forward_of(
    scene: Scene,
    start: Balance | None,
    references: Mapping[str, Curve],
    settings: Mapping[str, Any],
    *,
    at_rest: Callable[[], Scene],
) -> dict[str, Curve]:
    """Loads that hold the coordinates at rest, by [control].

    Parameters
    ----------
    scene : Scene
    start : Balance or None
        Of the scene, where it is known.
    references : mapping of str to Curve
        By command.
    settings : mapping
        Keywords of [control].
    at_rest : callable
        Makes the scene without waves and fluid memory.
    """
    kind = settings.get("feed_forward", "references")
    if kind != "references":
        for key in ("times", "period"):
            if key in settings:
                raise SceneError(
                    f"{key} is given, which feed_forward = {kind!r} has no use for; leave it out"
                )
    if kind == "none":
        return {}
    if kind == "start":
        loads = (balance(scene) if start is None else start).loads
        return {name: Curve.constant(value=loads[name]) for name in references}
    if "times" not in settings:
        raise SceneError(
            "feed_forward along the references needs times, such as [{until_s = 45, every_s = 5}]"
        )
    times = times_of(settings["times"])
    return feed_forward(at_rest(), references=references, times=times, period=settings.get("period"))


def times_of(parts: Sequence[Mapping[str, float]]) -> list[float]:
    """From zero on, part after part, each at its own interval, s."""
    times = [0.0]
    for part in parts:
        begin, until, every = times[-1], part["until"], part["every"]
        steps = (until - begin) / every if every > 0.0 else 0.0
        count = round(min(steps, MOST_TIMES))
        if not 1 <= count < MOST_TIMES - len(times) or abs(steps - count) > WHOLE:
            raise SceneError(
                f"times is wrong from {begin:g} s until {until:g} s every {every:g} s; the part must begin "
                f"before its end, hold its interval a whole number of times, and all parts {MOST_TIMES} times"
            )
        times += (begin + every * np.arange(1, count + 1)).tolist()
    return times
