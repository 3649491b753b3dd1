"""Any edit of a state is taken, however small beside what else the state holds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Run, Scene, State
from seacrane._core import StepHistory
from seacrane.hydro import StateSpaceBlock

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")
STOP, END = 3.0, 3.2
NONE = StepHistory(formulation="", integrator="", values=[], rate=[])
SETTINGS: list[dict[str, Any]] = [
    {"formulation": "recursive"},
    {"formulation": "redundant"},
    {"integrator": "tsit5", "rtol": 1e-5},
    {"integrator": "dopri5-stiff"},
    {"integrator": "rosenbrock", "rtol": 1e-4},
    {"integrator": "rk4", "dt": 2e-3},
]


def hauled(*, mass: float = 1e6, speed: float = -1.0, seed: int = 1) -> Scene:
    """A load that a winch hauls up, much work, beside a hull with fluid memory and a motor."""
    rng = np.random.default_rng(seed)
    scene = Scene(name="hauled")
    spin = 0.01 * rng.normal(size=3)
    scene.add_body("load", mass=mass, inertia=(mass,) * 3, position=(0.3, 0.0, -100.0), angular_velocity=spin)
    ends = [(0, 0, 0), (0, 0, 0.5)]
    scene.add_line("hoist", bodies=["ground", "load"], points=ends, EA=1e3 * mass, length=99.4)
    rate = Curve.quintic(start_time=0.0, end_time=1.0, start=0.0, end=speed)
    scene.add_winch(line="hoist", rate=rate, lag=0.2)
    scene.add_body(name="hull", mass=100.0, inertia=(50.0,) * 3, velocity=(0.0, 0.0, 0.5))
    block = StateSpaceBlock(inputs=[2], outputs=[2], a=[[0.0, 1.0], [-4.0, -1.5]], b=[[1.0], [0.5]],
                            c=[[30.0, 60.0]], d=[[0.0]])  # fmt: skip
    scene.add_vessel(
        body="hull", added_mass=20.0 * np.eye(6), linear_damping=5.0 * np.eye(6), memory=[block],
        restoring=np.diag([0.0, 0.0, 900.0, 700.0, 700.0, 0.0]), mooring_stiffness=np.full(3, 10.0),
    )  # fmt: skip
    scene.add_body(name="wheel", mass=2.0, inertia=(1.0, 2.0, 3.0), position=(9.0, 0.0, 0.0))
    scene.add_joint(kind="revolute", name="axle", first="ground", second="wheel", axis=(0, 1, 0))
    scene.add_actuator(joint="axle", stiffness=3.0, damping=0.1, reference=0.5)
    return scene


def edited(state: State, **changes: Any) -> State:
    names = ("time", "histories", "steps", "closed", "record", "parts", "values", "inputs")
    return State(**{name: getattr(state, name) for name in names} | changes)


def free(scene: Scene) -> list[int]:
    """Places in the state that nothing puts elsewhere: those of the load and of the hull but for quaternions,
    fluid memory, states of loads, work."""
    model = scene.compile()
    names = model.bodies
    out = list(range(model.twist_index(len(names)), model.states))
    for body in (names.index("load"), names.index("hull")):
        out += [*range(model.pose_index(body), model.pose_index(body) + 3)]
        out += [*range(model.twist_index(body), model.twist_index(body) + 6)]
    return out


MANY = pytest.param(range(1000, 1600), marks=pytest.mark.slow("many random states"))


@pytest.mark.parametrize("seeds", [range(20), MANY], ids=["some", "many"])
def test_random_edits_of_random_states_are_taken(seeds: range) -> None:
    for seed in seeds:
        rng = np.random.default_rng(seed)
        scene = hauled(mass=10.0 ** rng.uniform(3, 7), speed=float(rng.uniform(-2, 2)), seed=seed)
        settings = SETTINGS[seed % len(SETTINGS)]
        run = Run(scene, END, dt_out=0.05, **settings)
        run.advance(STOP)
        state = run.state
        for place in rng.choice(free(scene), 4, replace=False):
            was = state.values[place]
            tiny, values = rng.random() < 0.3, np.array(state.values)
            by = 4.0 * np.spacing(was) if tiny else 10.0 ** rng.uniform(-13, -1) * (abs(was) + 1e-3)
            values[place] = was + by
            starts = (edited(state, values=values), edited(state, values=values, steps=NONE))
            going, afresh = (Run(scene, END, dt_out=0.05, start=start, **settings) for start in starts)
            begins = np.array(going.core.state.values)
            assert begins[place] == values[place], (seed, place)
            # from poses to coordinates and back
            np.testing.assert_allclose(begins, values, rtol=1e-13, atol=1e-13, err_msg=f"{seed} {place}")
            for one in (going, afresh):
                one.advance(END)
            told = "goes on by a derivative of before"
            assert np.array_equal(going.core.state.values, afresh.core.state.values), (seed, place, told)


def test_an_edited_input_is_felt_at_once() -> None:
    scene = hauled()
    run = Run(scene, END, rtol=1e-7)
    run.advance(STOP)
    for by in (1e-3, 1e-9, 1e-15):
        inputs = np.array(run.state.inputs)
        inputs[next(slot for name, slot, _ in run.model.inputs if name == "axle.force")] += by
        starts = (edited(run.state, inputs=inputs), edited(run.state, inputs=inputs, steps=NONE))
        going, afresh = (Run(scene, END, dt_out=0.05, start=start, rtol=1e-7) for start in starts)
        for one in (going, afresh):
            assert np.array_equal(one.core.state.inputs, inputs)
            one.advance(END)
        assert np.array_equal(going.core.state.values, afresh.core.state.values)
