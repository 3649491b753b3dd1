"""Why a search for rest came to nothing, in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.reduced_coordinates import Terms
from seacrane.analysis.taut_lines import slack_lines
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.given import given_vessels
from seacrane.description.loads import lines_of
from seacrane.validity.left_range import LARGEST_HEEL

Array = NDArray[np.float64]
STILL = 1e-6  # m/s2 and rad/s2: what accelerates less is not what keeps the scene from rest


def why_none(scene: Description, model: _core.Model, time: float, values: Array) -> str:
    """What still moves where the search ended, and the line that could hold it and is slack."""
    turned = most_turned(scene, model, values)
    if turned > LARGEST_HEEL:
        return (
            f"a vessel has turned by {np.degrees(turned):.0f} deg on the way, where restoring is not linear: "
            "it capsizes, or lacks ballast. Look at seacrane.statics(scene), add ballast "
            "(Scene.add_ballast), or lower the weights"
        )
    terms = Terms(model, time=time)
    acceleration, drift = terms.acceleration(values), np.abs(terms.drift(values))
    worst = int(np.argmax(np.abs(acceleration)))
    if abs(acceleration[worst]) <= STILL and drift.size:
        name, unit, place, *_ = model.load_states[int(np.argmax(drift))]
        rate = terms.evaluator.derivative(time, values)[place]
        return f"state {name!r} still changes by {rate:.3g} {unit}/s; correct what drives it"
    body = model.bodies[worst // 6]
    told = f"body {body!r} still accelerates by {acceleration[worst]:.3g} (m/s2 or rad/s2)"
    slack = _slack_on(scene, body, model, values)
    if slack:
        name, left = max(slack.items(), key=lambda one: one[1])
        return (
            f"{told}, and line {name!r}, which could hold it, is slack by {left:.3g} m in the pose that is "
            "tried; give it a length at which it is taut, or start from a state nearer to rest"
        )
    return f"{told}; start from a state nearer to rest, or hold what drifts"


def most_turned(scene: Description, model: _core.Model, values: Array) -> float:
    """By how much (rad) the vessel that heels and trims most leans from upright."""
    given = given_vessels(scene)
    upright = [
        1.0 - 2.0 * float(np.sum(np.square(values[at + 4 : at + 6])))
        for vessel in scene.vessels.values()
        if vessel.body not in given and np.any(np.asarray(vessel.restoring))
        for at in [model.pose_index(list(model.bodies).index(vessel.body))]
    ]
    return float(np.arccos(np.clip(min(upright, default=1.0), -1.0, 1.0)))


def _slack_on(scene: Description, body: str, model: _core.Model, values: Array) -> dict[str, float]:
    """The slack ones of the lines on a body; of all where none of its own is slack."""
    lines = lines_of(scene.loads)
    if not lines:
        return {}
    slack = slack_lines(scene, compile_scene(scene, merge=False), values)
    own = {name: left for name, left in slack.items() if body in lines[name].bodies}
    return own or slack
