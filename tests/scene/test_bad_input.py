"""Bad input that no single field tells (those: `test_elements.py`) is refused by object, value and fix."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from typing import Any

import joint_examples
import named
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seacrane import Curve, Frame, Run, SampledController, Scene, State, _core, simulate
from seacrane.analysis import Evaluator
from seacrane.crane import Payload
from seacrane.errors import SceneError, SimulationError
from seacrane.hydro import StateSpaceBlock
from seacrane.scene import HullLoads, Waves, spline_curve

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

NAN, INF = float("nan"), float("inf")
KINDS = tuple(joint_examples.KINDS)


def scene_of_two(**settings: Any) -> Scene:
    scene = Scene(**settings)
    scene.add_body("a", mass=1.0, inertia=[1.0, 1.0, 1.0])
    scene.add_body("b", mass=2.0, inertia=[1.0, 1.0, 1.0], position=(1, 0, 0))
    return scene


def pendulum() -> Scene:
    scene = named.pendulum()
    scene.add_actuator(name="motor", joint="pin", damping=0.1)
    return scene


def refused(action: Callable[[], Any], told: str, error: Any = SceneError) -> None:
    """The action raises that error, and its message holds the words in that order."""
    with pytest.raises(error, match=f"(?s){told}"):
        action()


def rows(*table: tuple[Any, str]) -> Any:
    ids = [re.sub(r"\W+", " ", row[1]) for row in table]
    return pytest.mark.parametrize(("what", "told"), table, ids=ids)


@rows(
    ({"mass": 1e-310}, "units"), ({"inertia": [1, -1, 1]}, "positive definite.*-1"),
    ({"inertia": np.eye(3) + np.eye(3, k=1) / 2}, "not symmetric"),
    ({"inertia": [1, 1, 3]}, "1, 1, 3 kg m2.*sum of the others"),
    ({"position": (0, 0, 1e12)}, r"position holds 1e\+12 m.*1e\+07"),
    ({"quaternion": (0, 0, 0, 0)}, "length 0.*normalise"),
    ({"quaternion": (1, 1, 0, 0)}, "1.41421.*normalise"), ({"name": "a\0b"}, r"name is 'a\\x00b'.*printable"),
    ({"name": "ground"}, "body 'ground'.*inertial"), ({"name": "a"}, "'a'.*twice"),
)  # fmt: skip
def test_bodies(what: dict[str, Any], told: str) -> None:
    scene = scene_of_two()
    own, usual = "" if "name" in what else "body 'x'.*", {"name": "x", "mass": 1, "inertia": [1, 1, 1]}
    refused(lambda: (scene.add_body(**usual | what), scene.compile()), own + told)


SCALED, LEFT_HANDED = Frame(axes=2.0 * np.eye(3)), Frame(axes=np.diag([1.0, 1.0, -1.0]))
ROD = {"kind": "distance", "point": (0, 0, 0), "second_point": (0, 0, 0)}


@rows(
    ({"kind": "hinge"}, "kind 'hinge' is unknown.*revolute"), ({"second": "c"}, "no body 'c'"),
    ({"second": "a"}, "joins 'a' to itself"), ({"first": "ground", "second": "ground"}, "'ground' to itself"),
    ({"point": (NAN, 0, 0)}, "first_frame holds nan"), ({"axis": (0, 0, 0)}, r"axis is \(0, 0, 0\).*zero"),
    ({"first_frame": LEFT_HANDED, "second_frame": Frame()}, "right-handed"),
    ({"first_frame": Frame(), "second_frame": SCALED}, "second_frame"),
    ({"first_frame": Frame()}, "one frame only"), ({"second_point": (1, 0, 0)}, "second_point belongs to"),
    ({"second_axis": (1, 0, 0)}, "second_axis belongs to"), ({"kind": "universal"}, "needs second_axis"),
    ({"kind": "universal", "axis": (1, 0, 0), "second_axis": (1, 0, 0)}, "0.0 deg from.*perpendicular"),
    ({"kind": "distance"}, "needs second_point"), (ROD, "length is 0 m"),
    (ROD | {"length": 1.0}, "coincide"), ({"name": "rod"}, "joint 'rod'.*twice"),
)  # fmt: skip
def test_joints(what: dict[str, Any], told: str) -> None:
    scene = scene_of_two()
    scene.add_joint("rod", kind="distance", first="a", second="b", point=(0, 0, 0), second_point=(1, 0, 0))
    usual = {"kind": "revolute", "name": "j", "first": "a", "second": "b"}
    own = "" if "name" in what else "joint 'j'.*"
    refused(lambda: (scene.add_joint(**usual | what), scene.compile()), own + told)


HEAVE = np.zeros((6, 6))
HEAVE[2, 2] = 1e6


def memory_block(**changes: Any) -> StateSpaceBlock:
    values = {"inputs": [2], "outputs": [2], "a": [[-1.0]], "b": [[1.0]], "c": [[1.0]], "d": [[0.0]]}
    return StateSpaceBlock(**values | changes)


@rows(
    ({"drag": 1.0}, "drag is unknown.*added_mass"), ({"added_mass": -HEAVE}, "added_mass is not positive"),
    ({"restoring": np.eye(6)}, r"restoring\(0, 0\).*mooring"),
    ({"restoring": HEAVE + 1e5 * np.outer(np.eye(6)[2], np.eye(6)[4])}, "not symmetric"),
    ({"memory": 3}, "memory is 3.*StateSpaceBlock"), ({"memory": [memory_block(inputs=[6])]}, "input 6"),
    ({"memory": [memory_block(b=[[1.0, 2.0]])]}, "block 0.*shapes"),
    ({"memory": [memory_block(a=[[NAN]])]}, "block 0.*not finite"),
    ({"memory": [memory_block(state_scale=[0.0])]}, "state_scale"),
    ({"name": "two"}, "vessel 'two'.*'a' is a vessel"),
)  # fmt: skip
def test_vessels(what: dict[str, Any], told: str) -> None:
    scene = scene_of_two()
    if "name" in what:
        scene.add_vessel(body="a", name="one")
    own = "" if {"name", "body"} & set(what) else "vessel 'a'.*"
    refused(lambda: (scene.add_vessel(**{"body": "a"} | what), scene.compile()), own + told)


def hang(**more: Any) -> Callable[[Scene], Any]:
    return lambda scene: scene.add_spring("s", first="ground", second="bob", **more)


def gust(times: Any, loads: Any) -> Callable[[Scene], Any]:
    return lambda scene: scene.add_force("bob", name="t", times=times, force=loads)


def twice_driven(scene: Scene) -> None:
    for name in ("one", "two"):
        scene.add_driver("pin", curve=0.0, name=name)


def a_ball_driven(scene: Scene) -> None:
    scene.add_joint("ball", kind="spherical", first="ground", second="bob")
    scene.add_driver("ball", coordinate="angle", curve=0.0)


def one_name_for_two_coordinates(scene: Scene) -> None:
    scene.add_joint("sleeve", kind="cylindrical", first="ground", second="bob")
    for _ in range(2):  # the same again: nothing is lost
        scene.add_channel(joint="sleeve")
    scene.add_channel(joint="sleeve", coordinate="angle")


@rows(
    (lambda s: s.add_driver("pin", coordinate="x", curve=0.0), "driver 'pin.x'.*no coord.*angle"),
    (twice_driven, "driver 'two'.*pin.angle.*driver 'one'"),
    (a_ball_driven, "'ball' is spherical.*no coordinate"),
    (lambda s: s.add_force("ground", name="f", force=(0, 0, 1)), "point force 'f'.*'ground'"),
    (lambda s: s.add_force("bob", name="motor", force=(0, 0, 1)), "actuator.*motor.force"),
    (lambda s: s.add_spring("s", first="bob", second="bob"), "spring 's'.*itself"),
    (hang(lengths=[1, 2], forces=[1]), "spring 's'.*2 lengths and 1 forces"),
    (hang(lengths=[2, 1], forces=[1, 2]), "spring 's'.*lengths must increase"),
    (gust([0, 1, 2], np.zeros((2, 6))), "force table 't'.*3 times and 2"),
    (gust(None, np.zeros((2, 6))), "force table 't'.*0 times and 2"),
    (gust([0, 1], np.zeros((2, 3))), r"force 't': force has shape \(2, 3\); give \(3,\), or \(n, 6\) with"),
    (gust([0, 1], (0, 0, 1)), "force 't': times is given; a PointForce takes point, body_axes"),
    (gust(None, len), "force 't': force is .*C function of it by numba"),
    (gust([1, 0], np.zeros((2, 6))), "force table 't'.*times must increase"),
    (gust([], np.zeros((0, 6))), "force table 't'.*0 times"),
    (lambda s: s.add_channel(joint="pin", coordinate="x"), "'pin'.*'x'.*angle"),
    (lambda s: s.add_channel("a", joint="pin", expression="bob.z"), "expression is given; a channel by"),
    (one_name_for_two_coordinates, "recorded coordinate 'sleeve'.*sleeve.displacement.*another name"),
)  # fmt: skip
def test_drives_and_loads(what: Callable[[Scene], Any], told: str) -> None:
    scene = pendulum()
    refused(lambda: (what(scene), scene.compile()), told)


def frames(first: Any, second: Any, **of_first: Any) -> dict[str, Any]:
    return {"first_frame": Frame(point=first, **of_first), "second_frame": Frame(point=second)}


def a_strut_too_short() -> Scene:
    """The bob turns on a circle of 1 m about the pin: the strut's end stays 4 m or more from (5, 0, 0)."""
    scene = pendulum()
    scene.add_joint("strut", kind="distance", first="ground", second="bob", point=(5, 0, 0),
                    second_point=(1, 0, 0), length=1.0)  # fmt: skip
    return scene


def an_impossible_four_bar() -> Scene:
    scene, ends, far = scene_of_two(), frames((1, 0, 0), (-1, 0, 0)), frames((9, 0, 0), (1, 0, 0))
    scene.add_joint("o", kind="revolute", first="ground", second="a", point=(0, 0, 0), axis=(0, 1, 0))
    scene.add_joint("p", kind="revolute", first="a", second="b", **ends)
    scene.add_joint("q", kind="spherical", first="ground", second="b", **far)
    return scene


def a_joint_that_closes_upside_down() -> Scene:
    scene, turned = scene_of_two(), frames((0, 0, 0), (0, 0, 0), axes=np.diag([1.0, -1.0, -1.0]))
    scene.add_joint("w", kind="weld", first="ground", second="a")
    scene.add_joint("r", kind="revolute", first="ground", second="a", **turned)
    return scene


def a_drive_of_what_is_welded() -> Scene:
    """From 0 at t = 0, at 1 rad/s."""
    scene = pendulum()
    scene.add_joint("fixed", kind="weld", first="ground", second="bob")
    scene.add_driver("pin", curve=Curve.pieces(starts=[-1.0], coefficients=[[-1.0, 1.0, 0, 0, 0, 0]]))
    return scene


@rows(
    (a_strut_too_short, "(?=.*'strut')(?=.*'pin').*does not close.*contradictory"),
    (an_impossible_four_bar, "(?=.*'o')(?=.*'p')(?=.*'q').*does not close"),
    (a_joint_that_closes_upside_down, "joint 'r'.*180 deg"),
    (a_drive_of_what_is_welded, "(?=.*'pin.angle')(?=.*'fixed').*rates contradict"),
    (lambda: Scene(name="empty"), "scene 'empty'.*no bodies"),
    (lambda: scene_of_two(gravity=NAN), "gravity is nan"),
    (lambda: scene_of_two(baumgarte=-1.0), "baumgarte is -1"),
    (lambda: scene_of_two(orientation="rpy"), "'rpy' is unknown.*quaternion"),
    (lambda: scene_of_two(length_scale=0.0), "length_scale is 0 m"),
)  # fmt: skip
def test_scenes_that_cannot_be_assembled(what: Callable[[], Scene], told: str) -> None:
    with warnings.catch_warnings(action="ignore"):  # redundant joints
        refused(lambda: what().compile(), told)


@rows(({"hulls": {"b": HullLoads(transfer=np.ones((1, 6)))}}, "wave load.*'b' is not a vessel"),
      ({"heading": NAN}, "heading is nan"), ({"force_by_heading": 3.0}, "force_by_heading is 3.0.*ByHeading"),
      ({"amplitude": [NAN]}, "'a'.*amplitude"), ({"omega": [-1.0]}, "'a'.*omega"),
      ({"phase": [0.0, 1.0]}, "waves: phase"), ({"transfer": np.zeros((1, 5))}, "waves: transfer.*'a'"),
      ({"relative_bound": 0.0}, "'a'.*relative_bound is 0; give"),
      ({"depth": 0.0}, "'a'.*depth"))  # fmt: skip
def test_waves(what: dict[str, Any], told: str) -> None:
    scene, fields = scene_of_two(), HullLoads.__dataclass_fields__
    scene.add_vessel(body="a")
    hull = {"transfer": np.ones((1, 6))} | {name: value for name, value in what.items() if name in fields}
    sea = {name: value for name, value in what.items() if name not in fields}

    def compiled() -> None:
        one = {"omega": [1.0], "amplitude": [1.0], "phase": [0.0], "direction": [0.0]}
        scene.waves = Waves(**{"hulls": {"a": HullLoads(**hull)}} | one | sea)
        scene.compile()

    refused(compiled, told)


@rows(
    ({"t_end": NAN}, "t_end is nan"), ({"t_end": -1.0}, "t_end is -1.0 s.*start"), ({"t_end": "x"}, "is 'x'"),
    ({"dt_out": 0.0}, "dt_out is 0.0 s.*positive"), ({"dt_out": 1e-300}, "dt_out is 1e-300 s.*longer"),
    ({"t_end": 1e15, "dt_out": 1e-3}, "dt_out is 0.001 s.*longer"), ({"rtol": 0.0}, "rtol is 0.*positive"),
    ({"rtol": NAN}, "rtol is nan"), ({"rtol": 1e9}, r"rtol is 1e\+09.*up to 0.1"),
    ({"dt": -0.1, "integrator": "rk4"}, "dt is -0.1 s.*leave it out"), ({"dt": 0.0}, "dt is 0 s.*leave it"),
    ({"maximum_step": -1.0}, "maximum_step is -1 s"), ({"integrator": "euler"}, "euler.*dopri5"),
    ({"formulation": "magic"}, "formulation 'magic'.*redundant"),
    ({"channels": ["colour"]}, "channel 'colour'.*position"),
    ({"channels": "position"}, "channels is 'position'.*list"), ({"start": 3}, "start is 3.*State"),
    ({"controllers": [3]}, "controllers holds 3.*SampledController"),
)  # fmt: skip
def test_settings_of_a_run(what: dict[str, Any], told: str) -> None:
    refused(lambda: simulate(pendulum(), **{"t_end": 1.0} | what), told)


@rows(({"values": [1.0, 2.0]}, "state.*2 values.*15"), ({"values": np.full(15, NAN)}, "state.*not finite"),
      ({"values": np.zeros(15)}, "state.*give a state of this scene"),
      ({"inputs": []}, "inputs.*0 values.*3 slots"), ({"inputs": [NAN, 0.0, 0.0]}, "inputs.*not finite"),
      ({"time": NAN}, "start time is nan"), ({"time": 7.0}, "t_end is 1.0 s.*7.0"))  # fmt: skip
def test_start_state(what: dict[str, Any], told: str) -> None:
    scene = pendulum()
    good = _core.initial_state(scene.compile())
    given = {"time": 0.0, "values": good.values, "inputs": good.inputs}
    refused(lambda: simulate(scene, t_end=1.0, start=State(**given | what)), told)
    near = State(**given | {"values": np.r_[5.0, 0, 0, 1, np.zeros(11)]})  # is closed before the first output
    assert simulate(scene, t_end=1.0, start=near)["constraint_error"].max() < 1e-9


@rows((lambda t, m: 1 / 0, "(?=.*t = 0).*ZeroDivisionError"), (lambda t, m: m["colour"], "KeyError.*colour"),
      (lambda t, m: None, "returned None.*{input: value}"), (lambda t, m: {"x": 1.0},
                                                             "input 'x'.*motor.force"),
      (lambda t, m: {"motor.force": NAN}, "'motor.force' is nan"),
      (lambda t, m: {"motor.force": [1, 2]}, "'motor.force'.*1 finite"))  # fmt: skip
def test_controllers(what: Any, told: str) -> None:
    tick = SampledController(period=0.1, function=what)
    refused(lambda: simulate(pendulum(), t_end=1.0, controllers=[tick]), told,
            error=(SceneError, SimulationError))  # fmt: skip


def test_euler_angles_at_their_singularity() -> None:
    scene = Scene(orientation="euler_xyz")
    scene.add_body("mast", mass=1.0, inertia=[1, 1, 1], quaternion=(np.sqrt(0.5), 0, np.sqrt(0.5), 0))
    refused(lambda: simulate(scene, t_end=1.0), "body 'mast'.*phi_y is 90.*quaternion", SimulationError)


# Of the others some know no tolerance.
@pytest.mark.parametrize(
    "method", [m.name for m in _core.integrators() if m.setting == "rtol" or m.uses_jacobian]
)
def test_impossible_accuracy_stops_with_the_state_named_once(method: str) -> None:
    with pytest.raises(SimulationError, match=method) as caught:
        simulate(pendulum(), t_end=1.0, rtol=1e-30, integrator=method, formulation="redundant")
    assert str(caught.value).count("stopped at t =") == 1


def test_joints_too_close_together_to_hold_stop_the_run_by_name() -> None:
    """Two ball joints 0.01 mm apart are a hinge in name only: the run may not go on with open joints."""
    scene = scene_of_two()
    scene.add_joint("base", kind="weld", first="ground", second="a")
    for name, height in (("lower", 0.0), ("upper", 1e-5)):
        scene.add_joint(name, kind="spherical", first="a", second="b", point=(0.0, 0.0, height))
    with pytest.warns(UserWarning, match="redundant"):
        refused(lambda: simulate(scene, t_end=5.0), "(?=.*nearly depend).*er'.*open by", SimulationError)


def at_one_second() -> dict[str, Any]:
    """A time that a period of 1e-20 s does not change."""
    first = _core.initial_state(pendulum().compile())
    tick = SampledController(period=1e-20, function=lambda t, m: {})
    return {"start": State(time=1.0, values=first.values, inputs=first.inputs), "controllers": [tick]}


MODEL = pendulum().compile()
DATES = np.array(["2026-01-01"] * 3, dtype="M8[D]")


@rows(
    (lambda: Curve.pieces(starts=[], coefficients=[]), "no pieces"),
    (lambda: Curve.constant(value=NAN), "not finite"),
    (lambda: Curve.pieces(starts=[1.0, 0.0], coefficients=[[0.0] * 6] * 2), "piece 1.*0.0"),
    (lambda: Curve.pieces(starts=[1.0], coefficients=[[0.0] * 6] * 2), "one entry per piece"),
    (lambda: Curve.quintic(start_time=2.0, end_time=1.0, start=0.0, end=1.0), "(?=.*1.0).*2.0"),
    (lambda: spline_curve(times=[0, 1], values=[0, 1]), "at least 6"),
    (lambda: spline_curve(times=[0, 1, 2, 3, 3, 4], values=[0] * 6), "must increase"),
    (lambda: SampledController(period=0.0, function=len), "period is 0.0"),
    (lambda: SampledController(period=NAN, function=len), "period is nan"),
    (lambda: SampledController(period=1.0, function=3), "function is 3"),
    (lambda: simulate(pendulum(), t_end=2.0, **at_one_second()), "period is 1e-20 s"),
    (lambda: Scene().add_body("x", mass=1, inertia=DATES), "inertia.*give .*number"),
    (lambda: Scene().add_body("x", mass=1), "body 'x'.*neither inertia nor size"),
    (lambda: Scene().add_crane(foot=("33", "10", "10")), "foot.*give .*number"),
    (lambda: Payload(mass="20e3"), "mass.*give .*number"),
    (lambda: Run(pendulum(), t_end=1.0).set_inputs({"motor.force": "1"}), "motor.force.*give .*number"),
    (lambda: Run(pendulum(), t_end=1.0).set_inputs({"motor": 1.0}), "'motor'.*motor.force, motor.reference"),
    (lambda: Run(pendulum(), t_end=1.0).core.set_inputs([1.0]), "inputs.*1 values.*3 slots"),
    (lambda: Run(pendulum(), t_end=1.0).advance(NAN), "t_end.*finite"),
    (lambda: Evaluator(MODEL).derivative(0.0, np.zeros(3)), "3 values.*15"),
    (lambda: Evaluator(MODEL).project(0.0, np.zeros((15, 15))), "225 values"),
)  # fmt: skip
def test_calls(what: Callable[[], Any], told: str) -> None:
    refused(what, told)


NUMBER = st.floats(min_value=-10.0, max_value=10.0)
NEAR = st.lists(NUMBER, min_size=3, max_size=3)


@st.composite
def plausible_joint(draw: st.DrawFn) -> dict[str, Any]:
    first, second = draw(st.permutations(["a", "b", "ground"]))[:2]
    joint = {"kind": draw(st.sampled_from(KINDS)), "first": first, "second": second}
    joint |= {"point": draw(NEAR), "axis": draw(NEAR)}
    about = joint_examples.KINDS[joint["kind"]]
    if about.own_axis:
        joint["second_axis"] = draw(NEAR)
    if about.own_point:
        joint["second_point"] = draw(NEAR)
    return joint | {field.name: draw(st.none() | NUMBER) for field in about.parameters}


@settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(plausible_joint(), min_size=1, max_size=4), st.sampled_from(["quaternion", "euler_xyz"]))
def test_any_set_of_joints_compiles_and_runs_or_is_refused(joints: list[dict[str, Any]],
                                                           orientation: str) -> None:  # fmt: skip

    def build() -> Scene:
        scene = scene_of_two(orientation=orientation)
        for i, joint in enumerate(joints):
            scene.add_joint(f"j{i}", **joint)
        return scene

    with warnings.catch_warnings(action="ignore"):  # redundant joints
        try:
            model = build().compile()
        except SceneError:
            return
        assert np.isfinite(model.initial_state).all() and model.assembly["residual_after"] < 1e-8
        try:
            result = simulate(build(), t_end=0.2, dt_out=0.1)
        except (SceneError, SimulationError):
            return
    assert result["constraint_error"].max() <= 1e-6
    assert all(np.isfinite(values).all() for values in result.channels.values())
