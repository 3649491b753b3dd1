"""Bad input raises an exception that names the object, the value and the fix; nothing crashes or hangs."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import joint_examples
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from seacrane import (
    Curve,
    Frame,
    Run,
    SampledController,
    Scene,
    SceneError,
    SimulationError,
    State,
    _core,
    simulate,
)
from seacrane.analysis import Evaluator, inverse_dynamics
from seacrane.crane import Payload
from seacrane.hydro import StateSpaceBlock
from seacrane.scene import HullLoads, Waves, spline_curve

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

NAN, INF = float("nan"), float("inf")
KINDS = tuple(joint_examples.KINDS)


def scene_of_two(**settings: Any) -> Scene:
    """Two bodies 1 m apart, not joined."""
    scene = Scene(**settings)
    scene.add_body(name="a", mass=1.0, inertia=[1.0, 1.0, 1.0])
    scene.add_body(name="b", mass=2.0, inertia=[1.0, 1.0, 1.0], position=(1.0, 0.0, 0.0))
    return scene


def pendulum(**settings: Any) -> Scene:
    scene = Scene(name="pendulum", **settings)
    scene.add_body(name="bob", mass=1.0, inertia=[0.1, 0.1, 0.1], position=(1.0, 0.0, 0.0))
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    scene.add_actuator(name="motor", joint="pin", damping=0.1)
    return scene


def refused(action: Callable[[], Any], *parts: str, error: type[Exception] = SceneError) -> None:
    """The action raises that error and its message holds all the parts."""
    with pytest.raises(error) as caught:
        action()
    assert isinstance(caught.value, (SceneError, SimulationError)), type(caught.value)
    for part in parts:
        assert part in str(caught.value)


def case(name: str, arguments: dict[str, Any], *parts: str) -> Any:
    return pytest.param(arguments, parts, id=name)


BODIES = [
    case("mass nan", {"mass": NAN}, "body 'x'", "mass is nan", "finite"),
    case("mass inf", {"mass": INF}, "body 'x'", "mass is inf"),
    case("mass zero", {"mass": 0.0}, "body 'x'", "mass is 0 kg", "positive"),
    case("mass negative", {"mass": -3.0}, "body 'x'", "mass is -3 kg", "positive"),
    case("mass text", {"mass": "3"}, "body 'x'", "mass is '3'", "give a number"),
    case("mass none", {"mass": None}, "body 'x'", "mass is None"),
    case("mass vanishing", {"mass": 1e-310}, "body 'x'", "units"),
    case("mass overflowing", {"mass": 1e300}, "body 'x'", "units"),
    case("inertia nan", {"inertia": [1, NAN, 1]}, "body 'x'", "inertia holds nan at (1, 1)"),
    case("inertia shape", {"inertia": np.eye(4)}, "body 'x'", "inertia has shape (4, 4)", "(3, 3)"),
    case("inertia ragged", {"inertia": [[1], [1, 2]]}, "body 'x'", "inertia is", "give numbers"),
    case("inertia complex", {"inertia": [1j, 1, 1]}, "body 'x'", "inertia is"),
    case("inertia indefinite", {"inertia": [1, -1, 1]}, "body 'x'", "positive definite", "eigenvalue is -1"),
    case("inertia singular", {"inertia": [0, 1, 1]}, "body 'x'", "positive definite"),
    case("inertia asymmetric", {"inertia": np.eye(3) + np.eye(3, k=1) / 2}, "body 'x'", "not symmetric"),
    case("inertia triangle", {"inertia": [1, 1, 3]}, "body 'x'", "1, 1, 3 kg m2", "sum of the others"),
    case("inertia vanishing", {"inertia": [5e-324] * 3}, "body 'x'", "units"),
    case("center of mass shape", {"center_of_mass": (1, 2)}, "body 'x'", "center_of_mass has shape (2,)"),
    case(
        "center of mass inf",
        {"center_of_mass": (0, INF, 0)},
        "body 'x'",
        "center_of_mass holds inf at (1, 0)",
    ),
    case("position text", {"position": "here"}, "body 'x'", "position is 'here'"),
    case("position far", {"position": (0, 0, 1e12)}, "body 'x'", "position holds 1e+12 m", "at most 1e+07"),
    case("quaternion zero", {"quaternion": (0, 0, 0, 0)}, "body 'x'", "length 0", "normalise"),
    case("quaternion long", {"quaternion": (1, 1, 0, 0)}, "body 'x'", "length 1.41421", "normalise"),
    case("quaternion nan", {"quaternion": (NAN, 0, 0, 1)}, "body 'x'", "quaternion holds nan"),
    case("quaternion of three", {"quaternion": (1, 0, 0)}, "body 'x'", "quaternion has shape (3,)", "(4,)"),
    case("velocity nan", {"velocity": (0, 0, NAN)}, "body 'x'", "velocity holds nan"),
    case("spin inf", {"angular_velocity": (INF, 0, 0)}, "body 'x'", "angular_velocity holds inf"),
    case("gravity text", {"gravity": "no"}, "body 'x'", "gravity is 'no'", "True or False"),
    case("name empty", {"name": ""}, "body", "name is empty"),
    case("name number", {"name": 3}, "body", "name is 3", "text"),
    case("name not printable", {"name": "a\0b"}, "body", "name is 'a\\x00b'", "printable"),
    case("name surrogate", {"name": "\ud800"}, "body", "printable"),
    case("name of the ground", {"name": "ground"}, "body 'ground'", "inertial frame", "another name"),
    case("name twice", {"name": "a"}, "body 'a'", "used twice"),
]


@pytest.mark.parametrize(("arguments", "parts"), BODIES)
def test_bodies(arguments: dict[str, Any], parts: tuple[str, ...]) -> None:
    def build() -> None:
        scene = scene_of_two()
        scene.add_body(**{"name": "x", "mass": 1.0, "inertia": [1.0, 1.0, 1.0], **arguments})
        scene.compile()

    refused(build, *parts)


SCALED = Frame(axes=2.0 * np.eye(3))
LEFT_HANDED = Frame(axes=np.diag([1.0, 1.0, -1.0]))
JOINTS = [
    case("kind unknown", {"kind": "hinge"}, "joint 'j'", "kind 'hinge' is unknown", "revolute"),
    case("kind none", {"kind": None}, "joint 'j'", "kind is None"),
    case("body unknown", {"second": "c"}, "joint 'j'", "no body 'c'", "add it first"),
    case("first unknown", {"first": "c"}, "joint 'j'", "no body 'c'"),
    case("body a list", {"first": ["a"]}, "joint 'j'", "['a']"),
    case("to itself", {"second": "a"}, "joint 'j'", "joins 'a' to itself", "two different"),
    case("ground to ground", {"first": "ground", "second": "ground"}, "joint 'j'", "'ground' to itself"),
    case("point nan", {"point": (NAN, 0, 0)}, "joint 'j'", "first_frame holds nan"),
    case("point shape", {"point": (0, 0)}, "joint 'j'", "point has shape (2,)"),
    case("point far", {"point": (0, 1e9, 0)}, "joint 'j'", "first_frame holds 1e+09 m"),
    case("axis zero", {"axis": (0, 0, 0)}, "joint 'j'", "axis is (0, 0, 0)", "not all zero"),
    case("axis text", {"axis": "z"}, "joint 'j'", "axis is 'z'", "three numbers"),
    case("axis inf", {"axis": (INF, 0, 0)}, "joint 'j'", "axis is (inf, 0, 0)"),
    case("left-handed", {"first_frame": LEFT_HANDED, "second_frame": Frame()}, "joint 'j'", "right-handed"),
    case("scaled axes", {"first_frame": Frame(), "second_frame": SCALED}, "joint 'j'", "second_frame"),
    case("one frame", {"first_frame": Frame()}, "joint 'j'", "one frame only", "or neither"),
    case("no frame", {"first_frame": 1, "second_frame": 2}, "joint 'j'", "a frame is 1", "seacrane.Frame"),
    case("length of a hinge", {"length": 3.0}, "joint 'j'", "length belongs to a distance joint"),
    case("second point of a hinge", {"second_point": (1, 0, 0)}, "joint 'j'", "second_point belongs to"),
    case("second axis of a hinge", {"second_axis": (1, 0, 0)}, "joint 'j'", "second_axis belongs to"),
    case("universal without second axis", {"kind": "universal"}, "joint 'j'", "needs second_axis"),
    case(
        "universal with parallel axes",
        {"kind": "universal", "axis": (1, 0, 0), "second_axis": (1, 0, 0)},
        "joint 'j'", "second_axis is 0.0 deg from the first axis", "perpendicular",
    ),
    case("distance without point", {"kind": "distance"}, "joint 'j'", "needs second_point"),
    case(
        "distance zero",
        {"kind": "distance", "point": (0, 0, 0), "second_point": (0, 0, 0)},
        "joint 'j'", "length is 0 m", "positive",
    ),
    case(
        "distance negative",
        {"kind": "distance", "point": (0, 0, 0), "second_point": (1, 0, 0), "length": -1.0},
        "joint 'j'", "length is -1 m",
    ),
    case(
        "distance nan",
        {"kind": "distance", "point": (0, 0, 0), "second_point": (1, 0, 0), "length": NAN},
        "joint 'j'", "length is nan",
    ),
    case(
        "distance between coincident points",
        {"kind": "distance", "point": (0, 0, 0), "second_point": (0, 0, 0), "length": 1.0},
        "joint 'j'", "coincide",
    ),
    case("name empty", {"name": ""}, "joint", "name is empty"),
]  # fmt: skip


@pytest.mark.parametrize(("arguments", "parts"), JOINTS)
def test_joints(arguments: dict[str, Any], parts: tuple[str, ...]) -> None:
    def build() -> None:
        scene = scene_of_two()
        scene.add_joint(**{"kind": "revolute", "name": "j", "first": "a", "second": "b", **arguments})
        scene.compile()

    refused(build, *parts)


def test_joint_named_twice() -> None:
    scene = pendulum()
    refused(
        lambda: scene.add_joint(kind="spherical", name="pin", first="ground", second="bob"),
        "joint 'pin'",
        "twice",
    )


def test_contradictory_joints_are_named_with_their_gap() -> None:
    scene = pendulum()
    scene.add_joint(
        kind="distance",
        name="strut",
        first="ground",
        second="bob",
        point=(5, 0, 0),
        second_point=(1, 0, 0),
        length=1.0,
    )
    # The bob turns on a circle of 1 m about the pin: the strut's end stays 4 m or more from (5, 0, 0).
    refused(scene.compile, "joint", "'strut'", "'pin'", "does not close", "contradictory")


def test_impossible_four_bar_names_its_loop() -> None:
    scene = scene_of_two()
    scene.add_joint(kind="revolute", name="o", first="ground", second="a", point=(0, 0, 0), axis=(0, 1, 0))
    scene.add_joint(
        kind="revolute", name="p", first="a", second="b",
        first_frame=Frame(point=(1, 0, 0)), second_frame=Frame(point=(-1, 0, 0)),
    )  # fmt: skip
    scene.add_joint(kind="spherical", name="q", first="ground", second="b",
                    first_frame=Frame(point=(9, 0, 0)),
                    second_frame=Frame(point=(1, 0, 0)))  # fmt: skip
    refused(scene.compile, "does not close", "'o'", "'p'", "'q'")


def test_joint_that_closes_only_upside_down() -> None:
    scene = scene_of_two()
    upside_down = Frame(axes=np.diag([1.0, -1.0, -1.0]))
    scene.add_joint(kind="weld", name="w", first="ground", second="a")
    scene.add_joint(
        kind="revolute", name="r", first="ground", second="a", first_frame=upside_down, second_frame=Frame()
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        refused(scene.compile, "joint 'r'", "180 deg")


def test_prescribed_rates_that_contradict_a_joint() -> None:
    scene = pendulum()
    scene.add_joint(kind="weld", name="fixed", first="ground", second="bob")
    moving = Curve.pieces(starts=[-1.0], coefficients=[[-1.0, 1.0, 0, 0, 0, 0]])  # 0 at t = 0, at 1 rad/s
    scene.add_driver(joint="pin", curve=moving)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        refused(scene.compile, "rates contradict", "'pin.angle'", "'fixed'")


def test_velocities_that_break_a_joint_are_corrected_and_reported() -> None:
    scene = Scene()
    scene.add_body(
        name="bob", mass=1.0, inertia=[0.1] * 3, position=(1.0, 0.0, 0.0), velocity=(5.0, 0.0, 0.0)
    )
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    model = scene.compile()
    assert model.assembly["largest_velocity_change"] == pytest.approx(5.0, rel=1e-12)
    assert model.assembly["rate_residual_after"] < 1e-9


ADDED = [
    (
        "driver joint unknown",
        lambda s: s.add_driver(joint="x", curve=Curve.constant(value=0.0)),
        ("joint 'x'",),
    ),
    (
        "driver curve a text",
        lambda s: s.add_driver(joint="pin", curve="0"),
        ("driver", "curve is '0'", "give a number"),
    ),
    (
        "driver coordinate not offered",
        lambda s: s.add_driver(joint="pin", coordinate="x", curve=Curve.constant(value=0.0)),
        ("driver 'pin.x'", "no coordinate 'x'", "angle"),
    ),
    ("actuator joint unknown", lambda s: s.add_actuator(joint="x"), ("no joint 'x'",)),
    (
        "actuator stiffness nan",
        lambda s: s.add_actuator(name="m", joint="pin", stiffness=NAN),
        ("'m'", "nan"),
    ),
    (
        "actuator stiffness < 0",
        lambda s: s.add_actuator(name="m", joint="pin", stiffness=-1.0),
        ("'m'", "-1"),
    ),
    (
        "actuator reference inf",
        lambda s: s.add_actuator(name="m", joint="pin", reference=INF),
        ("'m'", "inf"),
    ),
    (
        "actuator reference text",
        lambda s: s.add_actuator(name="m", joint="pin", reference="up"),
        ("'m'", "'up'"),
    ),
    ("actuator named twice", lambda s: s.add_actuator(name="motor", joint="pin"), ("'motor'", "twice")),
    (
        "point force on no body",
        lambda s: s.add_point_force(name="f", body="x", force=(0, 0, 1)),
        ("point force 'f'", "no body 'x'"),
    ),
    (
        "point force on the ground",
        lambda s: s.add_point_force(name="f", body="ground", force=(0, 0, 1)),
        ("point force 'f'", "'ground'"),
    ),
    ("point force nan", lambda s: s.add_point_force(name="f", body="bob", force=(0, NAN, 1)), ("'f'", "nan")),
    (
        "point force that shares an input with an actuator",
        lambda s: s.add_point_force(name="motor", body="bob", force=(0, 0, 1)),
        ("point force 'motor'", "actuator", "motor.force", "rename"),
    ),
    (
        "spring to itself",
        lambda s: s.add_spring(name="s", first="bob", second="bob"),
        ("spring 's'", "itself"),
    ),
    ("spring unknown body", lambda s: s.add_spring(name="s", first="bob", second="x"), ("spring 's'", "'x'")),
    (
        "spring softening",
        lambda s: s.add_spring(name="s", first="ground", second="bob", stiffness=-2.0),
        ("spring 's'", "stiffness is -2"),
    ),
    (
        "spring table uneven",
        lambda s: s.add_spring(name="s", first="ground", second="bob", lengths=[1, 2], forces=[1]),
        ("spring 's'", "2 lengths and 1 forces"),
    ),
    (
        "spring table unordered",
        lambda s: s.add_spring(name="s", first="ground", second="bob", lengths=[2, 1], forces=[1, 2]),
        ("spring 's'", "lengths must increase"),
    ),
    (
        "spring table of tables",
        lambda s: s.add_spring(name="s", first="ground", second="bob", lengths=[[1, 2]], forces=[1]),
        ("spring 's'", "lengths has shape (1, 2)"),
    ),
    (
        "force table shape",
        lambda s: s.add_force_table(name="t", body="bob", times=[0, 1], loads=np.zeros((2, 3))),
        ("force table 't'", "(2, 3)", "(n, 6)"),
    ),
    (
        "force table lengths",
        lambda s: s.add_force_table(name="t", body="bob", times=[0, 1, 2], loads=np.zeros((2, 6))),
        ("force table 't'", "3 times and 2"),
    ),
    (
        "force table order",
        lambda s: s.add_force_table(name="t", body="bob", times=[1, 0], loads=np.zeros((2, 6))),
        ("force table 't'", "times must increase"),
    ),
    (
        "force table empty",
        lambda s: s.add_force_table(name="t", body="bob", times=[], loads=np.zeros((0, 6))),
        ("force table 't'", "0 times"),
    ),
    (
        "force table nan",
        lambda s: s.add_force_table(name="t", body="bob", times=[0.0], loads=np.full((1, 6), NAN)),
        ("force table 't'", "nan"),
    ),
    (
        "function at 0",
        lambda s: s.add_function_force(name="c", body="bob", address=0),
        ("'c'", "address is 0"),
    ),
    ("function below 0", lambda s: s.add_function_force(name="c", body="bob", address=-8), ("'c'", "-8")),
    (
        "function itself",
        lambda s: s.add_function_force(name="c", body="bob", address=len),
        ("'c'", "address"),
    ),
    ("recorded joint unknown", lambda s: s.record_coordinate(joint="x"), ("no joint 'x'",)),
    (
        "recorded coordinate",
        lambda s: s.record_coordinate(joint="pin", coordinate="x"),
        ("'pin'", "'x'", "angle"),
    ),
]


@pytest.mark.parametrize(("add", "parts"), [pytest.param(a, p, id=name) for name, a, p in ADDED])
def test_drives_and_loads(add: Callable[[Scene], Any], parts: tuple[str, ...]) -> None:
    def build() -> None:
        scene = pendulum()
        add(scene)
        scene.compile()

    refused(build, *parts)


def test_two_drivers_on_one_coordinate() -> None:
    scene = pendulum()
    scene.add_driver(joint="pin", curve=Curve.constant(value=0.0), name="one")
    scene.add_driver(joint="pin", curve=Curve.constant(value=0.1), name="two")
    refused(scene.compile, "driver 'two'", "pin.angle", "driver 'one'")


def test_a_joint_without_coordinates_cannot_be_driven() -> None:
    scene = scene_of_two()
    scene.add_joint(kind="spherical", name="ball", first="a", second="b")
    scene.add_driver(joint="ball", coordinate="angle", curve=Curve.constant(value=0.0))
    refused(scene.compile, "'ball' is spherical", "no coordinate")


def test_one_name_for_two_recorded_coordinates() -> None:
    scene = scene_of_two()
    scene.add_joint(kind="cylindrical", name="sleeve", first="a", second="b")
    scene.record_coordinate(joint="sleeve")
    scene.record_coordinate(joint="sleeve")  # the same again: nothing is lost
    refused(
        lambda: scene.record_coordinate(joint="sleeve", coordinate="angle"),
        "recorded coordinate 'sleeve'", "sleeve.displacement", "another name",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("settings", "parts"),
    [
        case("gravity nan", {"gravity": NAN}, "scene 'scene'", "gravity is nan"),
        case("gravity text", {"gravity": "9.81"}, "scene 'scene'", "gravity is '9.81'"),
        case("orientation", {"orientation": "rpy"}, "scene 'scene'", "'rpy' is unknown", "quaternion"),
        case("baumgarte negative", {"baumgarte": -1.0}, "scene 'scene'", "baumgarte is -1"),
        case("length scale zero", {"length_scale": 0.0}, "scene 'scene'", "length_scale is 0 m"),
        case("length scale inf", {"length_scale": INF}, "scene 'scene'", "length_scale is inf m"),
        case("name a number", {"name": 3}, "scene", "name is 3"),
    ],
)
def test_scene_settings(settings: dict[str, Any], parts: tuple[str, ...]) -> None:
    refused(scene_of_two(**settings).compile, *parts)


def test_scene_without_bodies() -> None:
    refused(Scene(name="empty").compile, "scene 'empty'", "no bodies", "add at least one")


HEAVE = np.zeros((6, 6))
HEAVE[2, 2] = 1e6


def memory_block(**changes: Any) -> StateSpaceBlock:
    values = {"inputs": [2], "outputs": [2], "a": [[-1.0]], "b": [[1.0]], "c": [[1.0]], "d": [[0.0]]}
    return StateSpaceBlock(**{**values, **changes})


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        case("body unknown", {"body": "x"}, "vessel 'x'", "no body 'x'"),
        case("unknown argument", {"drag": 1.0}, "vessel 'a'", "drag is unknown", "added_mass"),
        case("added mass shape", {"added_mass": np.eye(3)}, "vessel 'a'", "added_mass has shape (3, 3)"),
        case("added mass nan", {"added_mass": HEAVE * NAN}, "vessel 'a'", "added_mass holds nan"),
        case("added mass indefinite", {"added_mass": -HEAVE}, "vessel 'a'", "added_mass is not positive"),
        case("restoring in surge", {"restoring": np.eye(6)}, "vessel 'a'", "restoring(0, 0) is 1", "mooring"),
        case(
            "restoring asymmetric",
            {"restoring": HEAVE + 1e5 * np.outer(np.eye(6)[2], np.eye(6)[4])},
            "vessel 'a'", "not symmetric",
        ),
        case("damping nan", {"linear_damping": HEAVE * NAN}, "vessel 'a'", "linear_damping holds nan"),
        case("quadratic damping < 0", {"quadratic_damping": [0, 0, 0, -1, 0, 0]}, "vessel 'a'", "is -1"),
        case("mooring < 0", {"mooring_stiffness": [0, -5, 0]}, "vessel 'a'", "mooring_stiffness[1] is -5"),
        case("kinematics", {"kinematics": "fast"}, "vessel 'a'", "'fast' is unknown", "yaw_following"),
        case("memory a number", {"memory": 3}, "vessel 'a'", "memory is 3", "StateSpaceBlock"),
        case("memory motion", {"memory": [memory_block(inputs=[6])]}, "vessel 'a'", "block 0", "input 6"),
        case("memory shapes", {"memory": [memory_block(b=[[1.0, 2.0]])]}, "vessel 'a'", "block 0", "shapes"),
        case("memory nan", {"memory": [memory_block(a=[[NAN]])]}, "vessel 'a'", "block 0", "not finite"),
        case("memory scale", {"memory": [memory_block(state_scale=[0.0])]}, "vessel 'a'", "state_scale"),
    ],
)  # fmt: skip
def test_vessels(arguments: dict[str, Any], parts: tuple[str, ...]) -> None:
    def build() -> None:
        scene = scene_of_two()
        scene.add_vessel(**{"body": "a", **arguments})
        scene.compile()

    refused(build, *parts)


def test_two_vessels_on_one_body() -> None:
    scene = scene_of_two()
    scene.add_vessel(body="a", name="one")
    scene.add_vessel(body="a", name="two")
    refused(scene.compile, "vessel 'two'", "'a' is a vessel already")


@pytest.mark.parametrize(
    ("changes", "parts"),
    [
        case(
            "body not a vessel",
            {"hulls": {"b": HullLoads(transfer=np.ones((1, 6)))}},
            "wave load",
            "'b' is not a vessel",
        ),
        case("hulls a list", {"hulls": []}, "hulls is []", "HullLoads"),
        case("heading nan", {"heading": NAN}, "heading is nan", "finite"),
        case("tables no tables", {"force_by_heading": 3.0}, "force_by_heading is 3.0", "ByHeading"),
        case("amplitude nan", {"amplitude": [NAN]}, "waves on 'a'", "amplitude"),
        case("omega negative", {"omega": [-1.0]}, "waves on 'a'", "omega"),
        case("lengths differ", {"phase": [0.0, 1.0]}, "waves on 'a'"),
        case("transfer shape", {"transfer": np.zeros((1, 5))}, "waves on 'a'", "transfer"),
        case("transfer flat", {"transfer": np.zeros(6)}, "waves on 'a'", "transfer"),
        case("transfer nan", {"transfer": np.full((1, 6), NAN)}, "waves on 'a'", "transfer"),
        case("bound negative", {"relative_bound": -1.0}, "waves on 'a'", "relative_bound"),
        case("bound zero", {"relative_bound": 0.0}, "waves on 'a'", "relative_bound is 0; give"),
        case("bound text", {"relative_bound": "small"}, "waves on 'a'"),
        case("depth zero", {"depth": 0.0}, "waves on 'a'", "depth"),
    ],
)
def test_waves(changes: dict[str, Any], parts: tuple[str, ...]) -> None:
    scene = scene_of_two()
    scene.add_vessel(body="a")
    one = {
        "omega": [1.0],
        "amplitude": [1.0],
        "phase": [0.0],
        "direction": [0.0],
    }
    fields = HullLoads.__dataclass_fields__
    hull = {"transfer": np.ones((1, 6)), **{name: v for name, v in changes.items() if name in fields}}
    sea = {name: v for name, v in changes.items() if name not in fields}

    def compiled() -> None:
        scene.waves = Waves(**{"hulls": {"a": HullLoads(**hull)}, **one, **sea})
        scene.compile()

    refused(compiled, *parts)


@pytest.mark.parametrize(
    ("make", "parts"),
    [
        pytest.param(lambda: Curve.pieces(starts=[], coefficients=[]), ("no pieces",), id="empty"),
        pytest.param(lambda: Curve.constant(value=NAN), ("not finite",), id="nan"),
        pytest.param(
            lambda: Curve.pieces(starts=[1.0, 0.0], coefficients=[[0.0] * 6] * 2),
            ("piece 1", "0.0"),
            id="order",
        ),
        pytest.param(
            lambda: Curve.pieces(starts=[1.0], coefficients=[[0.0] * 6] * 2),
            ("one entry per piece",),
            id="counts",
        ),
        pytest.param(
            lambda: Curve.quintic(start_time=2.0, end_time=1.0, start=0.0, end=1.0),
            ("1.0", "2.0"),
            id="backwards",
        ),
        pytest.param(lambda: spline_curve(times=[0, 1], values=[0, 1]), ("at least 6",), id="few samples"),
        pytest.param(
            lambda: spline_curve(times=[0, 1, 2, 3, 3, 4], values=[0] * 6),
            ("must increase",),
            id="samples order",
        ),
    ],
)
def test_curves(make: Callable[[], Any], parts: tuple[str, ...]) -> None:
    refused(make, *parts)


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        case("t_end nan", {"t_end": NAN}, "t_end is nan"),
        case("t_end inf", {"t_end": INF}, "t_end is inf"),
        case("t_end before start", {"t_end": -1.0}, "t_end is -1.0 s", "before the start"),
        case("t_end text", {"t_end": "x"}, "t_end is 'x'", "number"),
        case("t_end none", {"t_end": None}, "t_end is None"),
        case("dt_out zero", {"dt_out": 0.0}, "dt_out is 0.0 s", "positive"),
        case("dt_out negative", {"dt_out": -0.1}, "dt_out is -0.1 s"),
        case("dt_out nan", {"dt_out": NAN}, "dt_out is nan"),
        case("dt_out vanishing", {"dt_out": 1e-300}, "dt_out is 1e-300 s", "longer"),
        case("outputs uncountable", {"t_end": 1e15, "dt_out": 1e-3}, "dt_out is 0.001 s", "longer"),
        case("rtol zero", {"rtol": 0.0}, "rtol is 0", "positive"),
        case("rtol negative", {"rtol": -1e-6}, "rtol is -1e-06"),
        case("rtol nan", {"rtol": NAN}, "rtol is nan"),
        case("rtol huge", {"rtol": 1e9}, "rtol is 1e+09", "up to 0.1"),
        case("rtol text", {"rtol": "tight"}, "rtol is 'tight'"),
        case("dt negative", {"dt": -0.1, "integrator": "rk4"}, "dt is -0.1 s", "leave it out"),
        case("dt zero", {"dt": 0.0, "integrator": "rk4"}, "dt is 0.0 s", "leave it out"),
        case("dt nan", {"dt": NAN, "integrator": "rk4"}, "dt is nan s"),
        case("maximum_step negative", {"maximum_step": -1.0}, "maximum_step is -1.0 s"),
        case("maximum_step inf", {"maximum_step": INF}, "maximum_step is inf s"),
        case("maximum_step zero", {"maximum_step": 0.0}, "maximum_step is 0.0 s; give a finite"),
        case("dt zero", {"dt": 0.0}, "dt is 0.0 s; give a finite positive number, or leave it out"),
        case("integrator unknown", {"integrator": "euler"}, "euler", "dopri5"),
        case("integrator a number", {"integrator": 3}, "integrator is 3", "dopri5"),
        case("formulation unknown", {"formulation": "magic"}, "formulation 'magic'", "redundant"),
        case("channel unknown", {"channels": ["colour"]}, "channel 'colour'", "position"),
        case("channel not of this scene", {"channels": ["wave_force"]}, "channel 'wave_force'", "position"),
        case("channels a text", {"channels": "position"}, "channels is 'position'", "list"),
        case("channels a number", {"channels": 3}, "channels is 3", "list"),
        case("start a number", {"start": 3}, "start is 3", "State"),
        case("controllers a number", {"controllers": 3}, "controllers holds 3", "SampledController"),
        case("controllers of numbers", {"controllers": [3]}, "controllers holds 3", "SampledController"),
    ],
)
def test_settings_of_a_run(arguments: dict[str, Any], parts: tuple[str, ...]) -> None:
    refused(lambda: simulate(pendulum(), **{"t_end": 1.0, **arguments}), *parts)


@pytest.mark.parametrize(
    ("change", "parts"),
    [
        pytest.param({"values": [1.0, 2.0]}, ("state", "2 values", "15"), id="too short"),
        pytest.param({"values": np.full(15, NAN)}, ("state", "not finite"), id="nan"),
        pytest.param({"values": np.zeros(15)}, ("state", "give a state of this scene"), id="no orientation"),
        pytest.param({"values": np.r_[5.0, 0, 0, 1, np.zeros(11)]}, (), id="off its joints"),
        pytest.param({"inputs": []}, ("inputs", "0 values", "3 slots"), id="inputs missing"),
        pytest.param({"inputs": [NAN, 0.0, 0.0]}, ("inputs", "not finite"), id="inputs nan"),
        pytest.param({"time": NAN}, ("start time is nan",), id="time nan"),
        pytest.param({"time": 7.0}, ("t_end is 1.0 s", "7.0"), id="time after the end"),
    ],
)
def test_start_state(change: dict[str, Any], parts: tuple[str, ...]) -> None:
    scene = pendulum()
    good = _core.initial_state(scene.compile())
    start = State(**{"time": 0.0, "values": good.values, "inputs": good.inputs, **change})
    if parts:
        refused(lambda: simulate(scene, t_end=1.0, start=start), *parts)
    else:  # near enough to be closed: it is, before the first output
        result = simulate(scene, t_end=1.0, start=start)
        assert result["constraint_error"].max() < 1e-9


def test_euler_angles_at_their_singularity() -> None:
    scene = Scene(orientation="euler_xyz")
    scene.add_body(name="mast", mass=1.0, inertia=[1, 1, 1], quaternion=(np.sqrt(0.5), 0, np.sqrt(0.5), 0))
    refused(
        lambda: simulate(scene, t_end=1.0), "body 'mast'", "phi_y is 90", "quaternion", error=SimulationError
    )


# Of the others some know no tolerance.
@pytest.mark.parametrize(
    "method", [m.name for m in _core.integrators() if m.setting == "rtol" or m.uses_jacobian]
)
def test_impossible_accuracy_stops_with_the_state_named_once(method: str) -> None:
    with pytest.raises(SimulationError) as caught:
        simulate(pendulum(), t_end=1.0, rtol=1e-30, integrator=method, formulation="redundant")
    text = str(caught.value)
    assert text.count("stopped at t =") == 1
    assert method in text


def test_step_of_a_fixed_step_method_beyond_stability_is_not_silent() -> None:
    scene = pendulum()
    scene.actuators.clear()
    scene.add_actuator(name="stiff", joint="pin", stiffness=1e9)
    refused(lambda: simulate(scene, t_end=100.0, integrator="rk4", dt=0.5), "smaller", error=SimulationError)


def test_joints_too_close_together_to_hold_stop_the_run_by_name() -> None:
    """Two ball joints 0.01 mm apart are a hinge in name only: the run may not go on with open joints."""
    scene = scene_of_two()
    scene.add_joint(kind="weld", name="base", first="ground", second="a")
    for name, height in (("lower", 0.0), ("upper", 1e-5)):
        scene.add_joint(kind="spherical", name=name, first="a", second="b", point=(0.0, 0.0, height))
    with pytest.warns(UserWarning, match="redundant"):
        refused(lambda: simulate(scene, t_end=5.0), "open by", "er'", "nearly depend", error=SimulationError)


@pytest.mark.parametrize(
    ("function", "error", "parts"),
    [
        pytest.param(lambda t, m: 1 / 0, SimulationError, ("ZeroDivisionError", "t = 0"), id="raises"),
        pytest.param(
            lambda t, m: m["colour"], SimulationError, ("KeyError", "colour"), id="reads what is not there"
        ),
        pytest.param(
            lambda t, m: None, SimulationError, ("returned None", "{input: value}"), id="returns nothing"
        ),
        pytest.param(lambda t, m: 3.0, SimulationError, ("returned 3.0",), id="returns a number"),
        pytest.param(lambda t, m: {"x": 1.0}, SceneError, ("input 'x'", "motor.force"), id="unknown input"),
        pytest.param(lambda t, m: {"motor.force": NAN}, SceneError, ("'motor.force' is nan",), id="nan"),
        pytest.param(lambda t, m: {"motor.force": "a"}, SceneError, ("'motor.force' is 'a'",), id="text"),
        pytest.param(
            lambda t, m: {"motor.force": [1, 2]}, SceneError, ("'motor.force'", "1 finite"), id="shape"
        ),
    ],
)
def test_controllers(function: Any, error: type[Exception], parts: tuple[str, ...]) -> None:
    controller = SampledController(period=0.1, function=function)
    refused(lambda: simulate(pendulum(), t_end=1.0, controllers=[controller]), *parts, error=error)


@pytest.mark.parametrize("period", [0.0, -1.0, NAN, INF, "fast", None])
def test_controller_period(period: Any) -> None:
    refused(lambda: SampledController(period=period, function=lambda t, m: {}), "period is", str(period))


@pytest.mark.parametrize(
    "call",
    [
        pytest.param(lambda s: s.add_point_force(name="f", body="bob", force=["1", "2", "3"]), id="force"),
        pytest.param(
            lambda s: s.add_point_force(name="f", body="bob", force=np.array(["1", "2", "3"])), id="array"
        ),
        pytest.param(lambda s: s.add_point_force(name="f", body="bob", force=[1.0, "2", 3.0]), id="one text"),
        pytest.param(
            lambda s: s.add_point_force(name="f", body="bob", force=np.array([1, b"2", 3], dtype=object)),
            id="bytes",
        ),
        pytest.param(lambda s: s.add_body(name="x", mass=1, inertia=["1", "1", "1"]), id="inertia"),
        pytest.param(
            lambda s: s.add_body(name="x", mass=1, inertia=[1, 1, 1], position=("0", 0, 0)), id="position"
        ),
        pytest.param(
            lambda s: s.add_joint(
                kind="revolute", name="j", first="ground", second="bob", axis=("0", "0", "1")
            ),
            id="axis",
        ),
        pytest.param(
            lambda s: s.add_spring(name="s", first="ground", second="bob", lengths=["1", "2"], forces=[0, 1]),
            id="lengths",
        ),
        pytest.param(
            lambda s: s.add_force_table(name="t", body="bob", times=["0", "1"], loads=np.zeros((2, 6))),
            id="times",
        ),
        pytest.param(lambda s: s.add_crane(foot=("33", "10", "10")), id="foot"),
        pytest.param(lambda s: Payload(mass="20e3"), id="payload"),
        pytest.param(lambda s: inverse_dynamics(s, times=["0", "1"]), id="times of inverse dynamics"),
        pytest.param(lambda s: Run(s, t_end=1.0).set_inputs({"motor.force": "1"}), id="input"),
        pytest.param(
            lambda s: s.add_body(name="x", mass=1, inertia=np.array(["2026-01-01"] * 3, dtype="M8[D]")),
            id="dates",
        ),
    ],
)
def test_texts_that_read_as_numbers_are_no_numbers(call: Any) -> None:
    with pytest.raises(SceneError, match=r"give .*number"):
        call(pendulum())


def test_controller_function() -> None:
    refused(lambda: SampledController(period=1.0, function=3), "function is 3")


def test_controller_period_below_the_resolution_of_time_does_not_hang() -> None:
    tick = SampledController(period=1e-20, function=lambda t, m: {})
    scene = pendulum()
    model = scene.compile()
    first = _core.initial_state(model)
    start = State(time=1.0, values=first.values, inputs=first.inputs)
    refused(lambda: simulate(scene, t_end=2.0, start=start, controllers=[tick]), "period is 1e-20 s")


def test_inputs_of_a_run() -> None:
    run = Run(pendulum(), t_end=1.0)
    refused(lambda: run.set_inputs({"motor": 1.0}), "input 'motor'", "motor.force, motor.reference")
    refused(lambda: run.core.set_inputs([1.0]), "inputs", "1 values", "3 slots")
    refused(lambda: run.advance(NAN), "t_end", "finite")


def test_low_level_calls_refuse_what_would_crash() -> None:
    model = pendulum().compile()
    evaluator = Evaluator(model)
    refused(lambda: evaluator.derivative(0.0, np.zeros(3)), "3 values", "15")
    refused(lambda: evaluator.project(0.0, np.zeros((15, 15))), "225 values")
    refused(lambda: evaluator.time_parts(0.0, np.array(model.initial_state), 0), "count is 0")
    for call in (Evaluator, _core.initial_state):
        with pytest.raises(TypeError):
            call(None)


ANYTHING = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=5),
    st.lists(st.floats(), max_size=5),
    st.lists(st.lists(st.floats(), max_size=3), max_size=3),
    st.complex_numbers(),
    st.binary(max_size=3),
    st.just(np.eye(3)),
    st.just(Frame()),
)
VECTOR = st.lists(st.floats(allow_nan=True, allow_infinity=True), min_size=3, max_size=3)
NUMBER = st.floats(min_value=-10.0, max_value=10.0)
NEAR = st.lists(NUMBER, min_size=3, max_size=3)
PLAUSIBLE = settings(max_examples=150, deadline=None, suppress_health_check=[HealthCheck.too_slow])


def compiles_or_is_refused(build: Callable[[], Scene]) -> None:
    """Compiles to a finite start on its constraints, or raises SceneError: nothing else."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # redundant joints
        try:
            model = build().compile()
        except SceneError as error:
            assert len(str(error)) > 10
            return
    assert np.isfinite(model.initial_state).all()
    assert model.assembly["residual_after"] < 1e-8


@PLAUSIBLE
@given(
    st.dictionaries(
        st.sampled_from(
            [
                "name",
                "mass",
                "inertia",
                "center_of_mass",
                "position",
                "quaternion",
                "velocity",
                "angular_velocity",
                "gravity",
            ]
        ),
        ANYTHING | VECTOR,
    )
)
def test_any_body_compiles_or_is_refused(arguments: dict[str, Any]) -> None:
    def build() -> Scene:
        scene = scene_of_two()
        scene.add_body(**{"name": "x", "mass": 1.0, "inertia": [1.0, 1.0, 1.0], **arguments})
        return scene

    compiles_or_is_refused(build)


@PLAUSIBLE
@given(
    st.sampled_from(KINDS),
    st.dictionaries(
        st.sampled_from(
            [
                "kind",
                "name",
                "first",
                "second",
                "point",
                "axis",
                "second_axis",
                "second_point",
                "length",
                "first_frame",
                "second_frame",
            ]
        ),
        ANYTHING | VECTOR,
    ),
)
def test_any_joint_compiles_or_is_refused(kind: str, arguments: dict[str, Any]) -> None:
    def build() -> Scene:
        scene = scene_of_two()
        scene.add_joint(**{"kind": kind, "name": "j", "first": "a", "second": "b", **arguments})
        return scene

    compiles_or_is_refused(build)


@st.composite
def plausible_joint(draw: st.DrawFn) -> dict[str, Any]:
    first, second = draw(st.permutations(["a", "b", "ground"]))[:2]
    joint = {
        "kind": draw(st.sampled_from(KINDS)),
        "first": first,
        "second": second,
        "point": draw(NEAR),
        "axis": draw(NEAR),
    }
    about = joint_examples.KINDS[joint["kind"]]
    if about.own_axis:
        joint["second_axis"] = draw(NEAR)
    if about.own_point:
        joint["second_point"] = draw(NEAR)
    return joint | {field.name: draw(st.none() | NUMBER) for field in about.parameters}


@PLAUSIBLE
@given(st.lists(plausible_joint(), min_size=1, max_size=4), st.sampled_from(["quaternion", "euler_xyz"]))
def test_any_set_of_joints_compiles_and_runs_or_is_refused(
    joints: list[dict[str, Any]], orientation: str
) -> None:
    """Redundant, contradictory or singular as they may be, a run ends with closed joints or with an error."""

    def build() -> Scene:
        scene = scene_of_two(orientation=orientation)
        for i, joint in enumerate(joints):
            scene.add_joint(name=f"j{i}", **joint)
        return scene

    compiles_or_is_refused(build)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            result = simulate(build(), t_end=0.2, dt_out=0.1)
        except (SceneError, SimulationError):
            return
    assert result["constraint_error"].max() <= 1e-6
    assert all(np.isfinite(values).all() for values in result.channels.values())
