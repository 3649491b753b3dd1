"""Arguments of every kind where another is due give a value or an error by name; no NaN, hang or crash."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, Phase, assume, example, given, seed, settings
from hypothesis import strategies as st
from joint_examples import KINDS

from seacrane import Curve, MotionHistory, Scene, SceneError, SimulationError, simulate
from seacrane.scene import HullLoads, Waves, spline_curve

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

NAN, INF = float("nan"), float("inf")
SETTINGS = settings(max_examples=80, deadline=None, phases=(Phase.explicit, Phase.generate), database=None,
                    suppress_health_check=[HealthCheck.too_slow])  # fmt: skip
LONGEST_MESSAGE = 2000


class Strange:
    """An object that no argument expects."""


NUMBERS: tuple[Any, ...] = (NAN, INF, -INF, 0.0, -0.0, -1.0, 1e-320, 1e-200, 1e200, 1.7e308, -1e308, 10**400,
                            2**63, True, 1.5, 1e12)  # fmt: skip
OTHERS: tuple[Any, ...] = (None, "", "nan", "1", "\x00", "\ud800", "Ladekran 🏗", "é" * 400, b"bytes", 1j,
                           Strange(), Strange, len, {}, set(), [], [[]], [NAN], [1.0, 2.0], [1.0] * 3,
                           [INF] * 3, [1e308] * 3, [0.0] * 3, [0.0] * 4, [[1.0, 0.0], [0.0]], np.eye(3),
                           np.full((3, 3), NAN), np.zeros((6, 6)), -np.eye(6), np.eye(3, dtype=complex),
                           np.zeros((0, 3)), np.array(["a", "b", "c"]), np.array(None),
                           np.zeros((3, 3, 3, 3)), np.datetime64("now"), range(3))  # fmt: skip
HOSTILE = st.one_of(st.sampled_from(range(len(NUMBERS))).map(lambda i: NUMBERS[i]),
                    st.sampled_from(range(len(OTHERS))).map(lambda i: OTHERS[i]), st.floats(),
                    st.lists(st.floats(), max_size=7), st.text(max_size=5))  # fmt: skip


def base() -> Scene:
    """A pendulum on a hull, both free of constraints that could be singular."""
    scene = Scene(name="base")
    scene.add_body("hull", mass=1e6, inertia=[1e7, 2e7, 2e7])
    scene.add_body("bob", mass=1e3, inertia=[1e3, 1e3, 1e3], position=(0, 0, -10))
    scene.add_joint("pin", kind="revolute", first="hull", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    return scene


RESTORING = np.diag([0.0, 0.0, 1e7, 1e8, 1e9, 0.0])
MATRIX = np.diag([1e6, 1e6, 1e6, 1e8, 1e8, 1e8])
CALLS: dict[str, dict[str, Any]] = {
    "add_body": {
        "mass": 2.0, "inertia": [1.0] * 3, "center_of_mass": (0.0, 0.0, 0.1), "position": (3.0, 0.0, 0.0),
        "quaternion": (1.0, 0.0, 0.0, 0.0), "velocity": (0.1, 0.0, 0.0), "angular_velocity": (0.0, 0.1, 0.0),
        "gravity": True},
    "add_joint": {"kind": "spherical", "first": "ground", "second": "hull", "point": (0.0, 0.0, 0.0),
                  "axis": (0.0, 0.0, 1.0), "second_axis": None, "second_point": None, "length": None},
    "add_driver": {"joint": "pin", "curve": Curve.constant(value=0.1), "coordinate": "angle"},
    "add_actuator": {"joint": "pin", "coordinate": "angle", "stiffness": 1e3, "damping": 10.0,
                     "feed_forward": 1.0, "reference": 0.1},
    "add_force": {"body": "bob", "point": (0, 0, 0), "force": (1, 0, 0)},
    "add_spring": {"first": "hull", "second": "bob", "first_point": (1.0, 0, 0), "second_point": (0, 0, 0),
                   "stiffness": 1e3, "damping": 1.0, "natural_length": 1.0, "lengths": (), "forces": ()},
    "add_vessel": {"body": "hull", "added_mass": MATRIX, "linear_damping": MATRIX, "restoring": RESTORING,
                   "quadratic_damping": np.ones(6), "mooring_stiffness": np.ones(3),
                   "mooring_damping": np.ones(3)},
    "add_vessel led": {
        "motion": MotionHistory(time=range(6), motion=np.zeros((6, 6))), "position": (9.0, 0, 0),
        "heading_deg": 30.0, "ramp": 1.0, "duration": 10.0, "size": (90.0, 20.0, 5.0)},
    "add_channel": {"joint": "pin", "coordinate": "angle"},
}  # fmt: skip
CALLS = {call: {"name": "x"} | given for call, given in CALLS.items()}


def refused(action: Callable[[], Any], *others: type[Exception]) -> Any:
    """The action's value, or None where it is refused with a message that a screen can hold."""
    allowed = SceneError, *others
    with warnings.catch_warnings(action="ignore"):
        try:
            return action()
        except allowed as error:
            assert 0 < len(str(error)) <= LONGEST_MESSAGE, str(error)[:300]
            return None


def run_for_some_steps(scene: Scene) -> None:
    """What compiles runs without NaN, or ends by name."""
    if refused(scene.compile) is None:
        return
    few: dict[str, Any] = {"t_end": 0.05, "dt_out": 0.05, "integrator": "rk4", "dt": 0.01}
    finite(refused(lambda: simulate(scene, **few), SimulationError))


def finite(result: Any) -> None:
    assert result is None or all(np.all(np.isfinite(array)) for array in result.channels.values())


def replaced(data: st.DataObject, usual: dict[str, Any], most: int = 2) -> dict[str, Any]:
    keys = st.lists(st.sampled_from(sorted(usual)), min_size=1, max_size=most, unique=True)
    return usual | {key: data.draw(HOSTILE, label=key) for key in data.draw(keys)}


@pytest.mark.parametrize("call", CALLS)
@seed(20)
@SETTINGS
@given(data=st.data())
def test_scene_methods(call: str, data: st.DataObject) -> None:
    scene, arguments = base(), CALLS[call]
    if call == "add_joint":
        arguments = arguments | {"kind": data.draw(st.sampled_from(sorted(KINDS)))}
    arguments = replaced(data, arguments)
    refused(lambda: getattr(scene, call.removesuffix(" led"))(**arguments), TypeError)
    run_for_some_steps(scene)


@pytest.mark.parametrize("call", CALLS)
def test_the_calls_themselves_are_sound_and_give_a_name_once(call: str) -> None:
    scene = base()
    getattr(scene, call.removesuffix(" led"))(**CALLS[call])
    scene.compile()
    if call != "add_channel":
        with pytest.raises(SceneError, match="'x'"):
            getattr(scene, call.removesuffix(" led"))(**CALLS[call])


SIMULATE: dict[str, Any] = {
    "dt_out": 0.05, "integrator": "rk4", "rtol": 1e-6, "dt": 0.01, "maximum_step": 0.05, "channels": None,
    "spectral_radius": None, "formulation": "auto", "controllers": (), "start": None, "accuracy": None,
}  # fmt: skip


@seed(21)
@SETTINGS
@given(key=st.sampled_from(sorted(SIMULATE)), value=HOSTILE)
@example(key="dt_out", value=1e-300)
@example(key="rtol", value=5e-324)
def test_simulate(key: str, value: Any) -> None:
    """Steps far below a microsecond are left out: they are what was asked for, and take their time."""
    assume(not (key in ("dt", "maximum_step") and isinstance(value, float) and 0.0 < value < 1e-6))
    settings = SIMULATE | {key: value}
    errors = SimulationError, ValueError, TypeError
    finite(refused(lambda: simulate(base(), t_end=0.05, **settings), *errors))


CURVES: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {
    "constant": (Curve.constant, {"value": 1.0}),
    "quintic": (Curve.quintic, {"start_time": 0.0, "end_time": 1.0, "start": 0.0, "end": 0.1}),
    "harmonic": (Curve.harmonic, {"offset": 0.0, "amplitude": 0.1, "omega": 1.0, "phase": 0.0}),
    "spline": (spline_curve, {"times": [0.0, 1.0, 2.0], "values": [0.0, 0.1, 0.0]}),
}


@pytest.mark.parametrize("kind", CURVES)
@seed(22)
@SETTINGS
@given(data=st.data())
def test_curves(kind: str, data: st.DataObject) -> None:
    """A curve that can be made drives a joint without NaN, or is refused there."""
    make, usual = CURVES[kind]
    arguments, scene = replaced(data, usual, most=1), base()
    curve = refused(lambda: make(**arguments), ValueError, TypeError)
    if curve is not None:
        refused(lambda: scene.add_actuator("pin", name="x", reference=curve, stiffness=1.0))
        run_for_some_steps(scene)


HULL: dict[str, Any] = {"transfer": np.ones((2, 6), dtype=complex), "position": (0.0, 0.0), "heading": 0.0,
                        "force_by_heading": None, "drift": None, "drift_by_heading": None}  # fmt: skip
WAVES: dict[str, Any] = {"omega": [0.5, 0.7], "amplitude": [0.1, 0.2], "phase": [0.0, 1.0],
                         "direction": [0.0, 0.5], "hulls": {"hull": HullLoads(**HULL)},
                         "relative_bound": 1e-9, "depth": INF, "evaluation": "exact",
                         "negligible": 1e-9}  # fmt: skip


@seed(23)
@settings(SETTINGS, max_examples=160)
@given(key=st.sampled_from(sorted(WAVES | HULL)), value=HOSTILE)
@example(key="evaluation", value=np.eye(3))
def test_waves(key: str, value: Any) -> None:
    scene = base()
    scene.add_vessel(**CALLS["add_vessel"])

    def waves() -> Waves:
        on_hull = {key: value} if key in HULL else {}
        given = {key: value} if key in WAVES else {"hulls": {"hull": HullLoads(**HULL | on_hull)}}
        return Waves(**WAVES | given)

    scene.waves = refused(waves, ValueError, TypeError)
    if scene.waves is not None:
        run_for_some_steps(scene)
