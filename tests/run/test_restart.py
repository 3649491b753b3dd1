"""Runs that stop and go on: bit for bit with the step history, closely from the values alone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from multibody_runs import CRANK, slider_crank

from seacrane import Curve, Run, Scene, State, cases
from seacrane._core import StepHistory
from seacrane.arrays import Array

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

NONE = StepHistory(formulation="", integrator="", values=[], rate=[])
STOP, END = 0.73, 1.5


def chain() -> Scene:
    """Every branch whose coordinates poses do not tell: a link, a ball, and turns of more than one round."""
    scene = Scene(name="chain")
    ends = [(0.0, 0.0, 0.0), (0.5, 0.1, -0.4), (0.9, -0.2, -0.9), (1.2, 0.1, -1.4)]
    kinds = ["distance", "spherical", "revolute"]
    for i, kind in enumerate(kinds):
        last, here = np.array(ends[i]), np.array(ends[i + 1])
        scene.add_body(name=f"body {i}", mass=2.0, inertia=(0.1, 0.2, 0.15), position=here,
                       angular_velocity=(1.0, -2.0, 9.0 if kind == "revolute" else 1.0))  # fmt: skip
        extra = {"second_point": here} if kind == "distance" else {}
        first = "ground" if i == 0 else f"body {i - 1}"
        scene.add_joint(kind=kind, name=f"joint {i}", first=first, second=f"body {i}",
                        point=last if i == 0 else 0.5 * (last + here), **extra)  # fmt: skip
    return scene


def crank(feed_forward: float = 0.0) -> Scene:
    """A loop, and a curve that jumps before and after the stop."""
    scene = slider_crank(CRANK, 0.4, 6.0)
    push = Curve.quintic(start_time=0.1, end_time=0.5, start=0.0, end=0.3)
    scene.add_actuator(joint="shaft", stiffness=5.0, damping=1.0, reference=push, feed_forward=feed_forward)
    return scene


SCENES: dict[str, Callable[[], Scene]] = {"chain": chain, "crank": crank, "case2": cases.case2}


def run(scene: Scene, start: State | None = None, **settings: Any) -> Run:
    return Run(scene, t_end=END, dt_out=0.05, start=start, channels=["position"], **settings)


def values(going: Run) -> Array:
    return np.array(going.core.state.values)


def parts(state: State, **change: Any) -> State:
    """A copy, as a file would hold it."""
    steps = state.steps
    names = ("formulation", "integrator", "values", "rate")
    copied = StepHistory(**{name: getattr(steps, name) for name in names})
    given = {"time": state.time, "values": state.values, "inputs": state.inputs, "steps": copied}
    return State(**given | {"histories": state.histories} | change)


@pytest.mark.parametrize("change", [{"integrator": "tsit5"}, {"formulation": "redundant"}])
def test_other_settings_start_from_the_values(change: dict[str, str]) -> None:
    settings = {"rtol": 1e-10, "formulation": "recursive"}
    whole = run(crank(), **settings)
    whole.advance(STOP)
    left = whole.core.state
    whole.advance(END)
    starts = (parts(left), parts(left, steps=NONE))
    with_steps, without = (run(crank(), start, **settings | change) for start in starts)
    for going in (with_steps, without):
        going.advance(END)
        np.testing.assert_allclose(values(going)[:14], values(whole)[:14], atol=1e-7)
    assert np.array_equal(values(with_steps), values(without))


def test_steps_of_another_scene_inputs_or_values_are_not_gone_on_from() -> None:
    """The derivative kept from the last step would be wrong."""
    whole = run(crank(), formulation="recursive")
    whole.advance(STOP)
    left = whole.core.state
    moved = np.array(left.values)
    moved[-2] += 1.0  # the work integral
    inputs = np.array(left.inputs) + 30.0
    for scene, change in ((crank(), {"inputs": inputs}), (crank(), {"values": moved}), (crank(50.0), {})):
        starts = (parts(left, **change | more) for more in ({}, {"steps": NONE}))
        pair = [run(scene, start, formulation="recursive") for start in starts]
        for going in pair:
            going.advance(END)
        assert np.array_equal(values(pair[0]), values(pair[1]))
        assert not np.array_equal(values(pair[0]), values(whole))


def test_the_first_output_after_a_restart_sees_the_present_piece_of_a_curve() -> None:
    """Not the one before the first jump of all."""
    scene = Scene(name="hoist", gravity=0.0)
    scene.add_body(name="load", mass=1.0, inertia=(1.0, 1.0, 1.0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="load", point=(0.0, 0.0, 0.0))
    pull = Curve.quintic(start_time=0.0, end_time=0.5, start=0.0, end=1.0)
    scene.add_actuator(joint="rail", stiffness=10.0, reference=pull)
    first = Run(scene, t_end=2.0, channels=["position", "acceleration"])
    first.advance(1.0)
    again = Run(scene, t_end=2.0, start=first.core.state, channels=["position", "acceleration"])
    out = again.core.channels()
    force = 10.0 * (1.0 - out["position"][0, 0, 2])
    assert out["acceleration"][0, 0, 2] == pytest.approx(force, abs=1e-9)
