"""Channels by the core's table, by one text that says which curves are meant, and by expressions."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import hung, settled, swinging
from named import pendulum
from numpy.testing import assert_allclose, assert_array_equal
from test_relative_motion import hoisting, tumbling
from test_restart import chain, crank
from wet_scenes import hung_on_links

from seacrane import Kept, Result, Run, Scene, Stage, Until, _core, cases, ensemble, simulate
from seacrane.analysis import linear_model
from seacrane.description.channels import CHANNELS, DERIVED, FIXED, NAMED, OWN
from seacrane.description.expression import DEEPEST, LONGEST
from seacrane.description.pick import Pick, column_name, pick_of
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import shipped_database
from seacrane.operability import Criterion
from seacrane.operability.linear_channels import linear_channels
from seacrane.scene.file import scene_digest

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")


def test_every_channel_has_a_name_of_its_own_dimensions_a_unit_and_a_text() -> None:
    """Not that of a dimension: a file has one name for either."""
    core = [channel.name for channel in _core.channels()]
    assert len(set(core)) == len(core) and [*core, *DERIVED] == list(CHANNELS)
    assert not set(CHANNELS) & (NAMED | set(FIXED))
    for name, channel in CHANNELS.items():
        assert channel.dims[0] == channel.dims_of_several[0] == "time", name
        assert set(channel.dims_of_several[1:]) <= set(FIXED) | NAMED, name
        assert channel.unit and channel.long_name, name
    for name, derived in DERIVED.items():
        assert set(derived.made_of) <= set(core) and bool(derived.made_of) == (name != OWN), name


@pytest.mark.parametrize("make", [chain, crank, cases.case2])
def test_every_channel_carries_the_names_of_the_scene(make: Any) -> None:
    scene = make()
    model = scene.compile()
    offered, default = model.channel_names(defaults_only=False), model.channel_names()
    assert default == [name for name in offered if CHANNELS[name].by_default]
    assert {"acceleration", "angular_acceleration"} <= set(offered) - set(default)
    run = simulate(scene, t_end=0.1, channels=offered)
    for name, array in run.channels.items():
        assert array.shape[1:] == tuple(len(run.coords[dim]) for dim in run.dims[name][1:]), name
    expected = {"body": scene.bodies, "joint": scene.joints, "joint_coordinate": scene.recorded,
                "actuator": scene.actuators, "driver": scene.drivers,
                "link": [name for name,
                         joint in scene.joints.items() if joint.kind == "distance"]}  # fmt: skip
    for dim, names in expected.items():
        assert run.coords.get(dim, ()) == tuple(names), dim


def test_channels_recorded_alone_are_those_of_a_run_that_records_all() -> None:
    """Whatever is evaluated for an output, for few channels or for many, leaves the steps as they are."""
    scene = cases.case2()
    offered = scene.compile().channel_names(defaults_only=False)
    settings: dict[str, Any] = {"t_end": 3.0, "formulation": "redundant"}
    whole = simulate(scene, channels=offered, **settings)
    for name in offered:
        alone = simulate(scene, channels=[name], **settings)
        assert_allclose(
            alone[name], whole[name], rtol=0.0, atol=1e-9 * np.abs(whole[name]).max(), err_msg=name
        )
        assert alone.stats["evaluations"] == whole.stats["evaluations"], name


def box() -> Scene:
    scene = Scene(name="box")
    scene.add_body("load", mass=1e3, size=(1, 1, 1), position=(0, 0, 5))
    return scene


def rod() -> Scene:
    scene, ends = box(), {"point": (0, 0, 20), "second_point": (0, 0, 5)}
    scene.add_joint("rod", kind="distance", first="ground", second="load", **ends)
    scene.add_body("arm", mass=1.0, inertia=(1.0,) * 3)
    scene.add_joint("slide", kind="prismatic", first="ground", second="arm", axis=(1, 0, 0))
    scene.add_driver("slide", curve=0.0)
    return scene


def beside_a_rod() -> Scene:
    """A load on a quasi-static line, which moves nothing of another on a rod."""
    scene = settled(swinging(), length=7.72)
    scene.add_body("other", mass=1e3, size=(1, 1, 1), position=(30, 2, -8))
    ends = {"point": (30, 0, 0), "second_point": (30, 2, -8)}
    scene.add_joint("rod", kind="distance", first="ground", second="other", **ends)
    return scene


def ship(*, crane: bool = False, hoist: bool = False) -> Scene:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database())
    scene.add_sea(hs=1.0, tp=8.0, direction_deg=90.0)
    if crane or hoist:
        scene.add_crane()
    if hoist:
        scene.add_hoist(mass=1e4, size=(2, 2, 2), length=8.0, EA=1e7)
    if crane or hoist:
        scene.add_ballast()
    return scene


@pytest.mark.parametrize("make", [box, rod, ship, partial(ship, crane=True), partial(ship, hoist=True)])
def test_each_channel_is_recorded_or_refused_by_its_name(make: Callable[[], Scene]) -> None:
    scene, refused = make(), set()
    for channel in CHANNELS:
        try:
            run = Run(scene, 0.1, channels=[channel])
        except SceneError as error:
            assert f"channel {channel!r} is unknown to this scene" in str(error)
            refused.add(channel)
        else:
            assert channel in run.measure(), channel
    assert {"own", "clearance"} < refused < set(CHANNELS)


SOLVED = {"reaction_force", "reaction_moment", "limit_force"}  # multipliers of the described joints


@pytest.mark.parametrize(
    "make",
    [
        chain,
        crank,
        cases.case2,
        tumbling,
        hoisting,
        rod,
        hung_on_links,
        lambda: settled(hung()),
        beside_a_rod,
    ],
)
def test_accelerations_and_forces_are_those_of_what_is_stepped_and_of_the_described_bodies(make: Any) -> None:
    """Two formulations tell the same: the few channels of what is stepped, and those that solve for all."""
    scene = make()
    offered = scene.compile().channel_names(defaults_only=False)
    settings: dict[str, Any] = {"t_end": 1.0, "dt_out": 0.1}
    whole = simulate(scene, channels=offered, **settings)
    few = simulate(scene, channels=[name for name in offered if name not in SOLVED], **settings)
    for name in set(offered) - SOLVED:
        size = np.nanmax(np.abs(whole[name]), initial=0.0)
        assert_allclose(few[name], whole[name], rtol=0.0, atol=1e-9 * size, err_msg=name)


@pytest.mark.warns("LineLengthWarning")
def test_what_a_later_stage_connects_is_recorded_there_and_its_limits_hold() -> None:
    scene = ship(hoist=True)
    scene.add_limit_state("swing", maximum=1.0)
    stages = [Stage(name="before", duration=0.2), Stage(name="hooked", connect=["hoist"], duration=0.2)]
    run = simulate(scene, stages, channels=["swing", "position"], rtol=0.001)
    assert np.isnan(run["swing"][0]) and np.isfinite(run["swing"][-1])
    assert np.isfinite(run.utilisation.largest)


@pytest.fixture(scope="module")
def lift() -> Result:
    return simulate(cases.case2(), t_end=3.0, dt_out=0.5)


PICKS: dict[str, tuple[Any, ...]] = {  # channel, names along its dimensions, and the time after which
    "hook_load": ("hook_load", {}, None), "roll": ("vessel_motion", {"motion": "roll"}, None),
    "vessel_motion[barge, roll]": ("vessel_motion", {"vessel": "barge", "motion": "roll"}, None),
    "vessel_motion[ roll ,after=60]": ("vessel_motion", {"motion": "roll"}, 60.0),
    "position[z, load]": ("position", {"body": "load", "axis": "z"}, None),
    "position[axis=x, body=z]": ("position", {"body": "z", "axis": "x"}, None),
    'hook_load["a, b"]': ("hook_load", {"suspension": "a, b"}, None),
    "load_state[hoist.length]": ("load_state", {"state_name": "hoist.length"}, None),
    "reaction_force[main foot, y]": ("reaction_force", {"joint": "main foot", "axis": "y"}, None),
}  # fmt: skip


@pytest.mark.parametrize("text", PICKS)
def test_a_text_names_channel_dimensions_and_time(text: str) -> None:
    channel, names, after = PICKS[text]
    assert pick_of("test", text) == Pick(channel=channel, names=names, after=after)


def test_every_curve_of_every_channel_has_a_text_that_finds_it() -> None:
    for channel, about in CHANNELS.items():
        dims = about.dims_of_several[1:]
        names = {dim: FIXED[dim][-1] if dim in FIXED else f"the {dim}, 1" for dim in dims}
        assert pick_of("test", column_name(channel, list(names.values()))).names == names
        whole = Pick(channel=channel, names=names)
        assert pick_of("test", whole) == whole


def test_a_text_that_says_nothing_is_refused_by_what_is_wrong() -> None:
    for text, told in {
        "hok_load": "did you mean 'hook_load'", "position[load, z, y]": "has no 'y'",
        "position[load, axis=w]": "axis is 'w'.*x, y, z", "position[load, hook=z]": "no dimension 'hook'",
        "position[axis=z, axis=y]": "two names along axis", "hook_load[after=soon]": "after is 'soon'.*time",
        "position[load": "give a channel",
    }.items():  # fmt: skip
        with pytest.raises(SceneError, match=told):
            pick_of("test", text)


def test_select_and_curve_take_the_text(lift: Result) -> None:
    roll = lift.select("vessel_motion", motion="roll")
    for found in (lift.select("roll"), lift.select("vessel_motion[roll]"), lift.curve("roll")):
        assert np.array_equal(found, roll)
    assert lift.select("position[payload]").shape == (lift.time.size, 3)
    with pytest.raises(SceneError, match="several curves; give axis: one of x, y, z"):
        lift.curve("position[payload]")
    for late in ("roll[after=1]", "vessel_motion[roll, after=1]"):  # the first has no such dimension
        with pytest.raises(ValueError, match="all outputs"):
            lift.select(late)


def test_a_table_has_a_column_for_each_curve_under_its_text(lift: Result, tmp_path: Path) -> None:
    table = lift.to_dataframe("roll", "position[payload]")
    assert list(table) == ["vessel_motion[roll]", *(f"position[payload, {axis}]" for axis in "xyz")]
    assert table.index.name == "time"
    assert table.attrs["units"]["vessel_motion[roll]"] == "rad"
    for name in table:
        assert np.array_equal(table[name], lift.select(name))
    whole = lift.to_dataframe()
    assert len(whole.columns) == sum(array[0].size for array in lift.channels.values())
    assert lift.to_dataframe("vessel_motion[roll, after=1]").index[0] == 1.0
    with pytest.raises(SceneError, match="of one part of the run"):
        lift.to_dataframe("vessel_motion[roll, after=1]", "link_tension")

    path = lift.to_csv(tmp_path / "lift.csv", "roll", "link_tension")
    first, *rows = path.read_text(encoding="utf-8").splitlines()
    assert first == "time [s],vessel_motion[roll] [rad],link_tension [N]"
    read = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert np.array_equal(read.T, [lift.time, lift.select("roll"), lift["link_tension"]])


def test_what_is_kept_is_said_by_a_text() -> None:
    late = {"channel": "position", "what": "minimum", "names": {"body": "load", "axis": "z"}, "after": 60.0}
    assert Kept.of_text("position[load, z, after=60].min") == Kept(**late)
    assert Kept(channel="position[load, z, after=60]", what="minimum") == Kept(**late)
    roll = Kept(channel="vessel_motion", what="standard_deviation", names={"motion": "roll"})
    assert Kept.of_text("roll.std") == roll
    with pytest.raises(SceneError, match="give each name once"):
        Kept(channel="position[load, z]", names={"axis": "x"})
    low = Kept(channel="position", what="minimum", names={"body": "bob", "axis": "z"})
    keep: dict[str, Any] = {"low": "position[bob, z].min", "same": low}
    found = ensemble(pendulum(), over={"gravity": [9.0, 9.8]}, keep=keep, t_end=1.0)
    assert np.array_equal(found.dataset.low, found.dataset.same)


def z(result: Result, body: str) -> Any:
    return result.select("position", body=body, axis="z")


def of_load(result: Result, axis: str, channel: str = "velocity") -> Any:
    return result.select(channel, body="load", axis=axis)


def corner(result: Result, axis: str) -> Any:
    return result.select("point_position", point="corner", axis=axis)


EXPRESSIONS: dict[str, tuple[str, str, Callable[[Result], Any]]] = {
    "rate": ("corner.vz - load.vz", "m/s",
             lambda r: r.select("point_velocity", point="corner", axis="z") - of_load(r, "z")),
    "sum": ("corner.z - load.z + 3 m", "m", lambda r: corner(r, "z") - z(r, "load") + 3.0),
    "signs": ("-load.z - -hull.z", "m", lambda r: -z(r, "load") + z(r, "hull")),
    "order": ("load.z - 2 * hull.z / 4 - 1 m", "m", lambda r: z(r, "load") - 2 * z(r, "hull") / 4 - 1),
    "left": ("load.z / 2 / 3 * 4", "m", lambda r: z(r, "load") / 2 / 3 * 4),
    "nested": ("(load.z - (hull.z - 2 m)) * 0.5", "m", lambda r: (z(r, "load") - (z(r, "hull") - 2.0)) * 0.5),
    "speed": ("hypot(velocity[load, x], velocity[load, axis=y])", "m/s",
              lambda r: np.hypot(of_load(r, "x"), of_load(r, "y"))),
    "root": ("sqrt(load.x * load.x + load.y * load.y)", "m",
             lambda r: np.sqrt(of_load(r, "x", "position") ** 2 + of_load(r, "y", "position") ** 2)),
    "angle": ("atan2(corner.y, corner.x)", "rad", lambda r: np.arctan2(corner(r, "y"), corner(r, "x"))),
    "most": ("max(abs(hull.z), load.z, 200 mm)", "m",
             lambda r: np.maximum(np.maximum(np.abs(z(r, "hull")), z(r, "load")), 0.2)),
    "least": ("min(load.z, hull.z)", "m", lambda r: np.minimum(z(r, "load"), z(r, "hull"))),
    "heel": ("heel[hull] - 10 deg", "rad", lambda r: r.select("heel", body="hull") - np.radians(10.0)),
    "power": ("1e3 kg * acceleration[load, z] * velocity[load, z]", "W",
              lambda r: 1e3 * of_load(r, "z", "acceleration") * of_load(r, "z")),
    "units": ("load.z + 6 m/min(2, 3) - 6 m/min * 10 s", "m", lambda r: z(r, "load") + 3.0 - 1.0),
    "constant": ("2.5e1 kN", "N", lambda r: np.full(r.time.size, 25e3)),
}  # fmt: skip


def described(scene: Scene) -> Scene:
    for name, (text, _, _) in EXPRESSIONS.items():
        scene.add_channel(name, expression=text)
    return scene


def test_expressions_are_those_of_numpy_on_what_was_recorded() -> None:
    scene = described(tumbling())
    result = simulate(scene, 3.0)
    assert {"heel", "acceleration"} <= set(result)  # on request, and recorded by themselves
    for name, (_, unit, expected) in EXPRESSIONS.items():
        assert scene.channels[name].unit == unit
        values = result.curve(f"own[{name}]")
        assert values.shape == result.time.shape
        assert_allclose(values, expected(result), rtol=4e-16, atol=1e-15, err_msg=name)
    assert np.ptp(result.curve("own[speed]")) > 0.0 or np.ptp(result.curve("own[angle]")) > 0.1
    alone = simulate(scene, 3.0, channels=["own"])
    assert list(alone) == ["own"] and alone.coords["expression"] == tuple(EXPRESSIONS)
    assert_allclose(alone["own"], result["own"], rtol=1e-13, atol=1e-13)
    assert "own" not in simulate(tumbling(), 0.1)


def test_a_limit_state_a_criterion_and_what_is_kept_take_it() -> None:
    scene = tumbling()
    scene.add_channel("over", expression="load.z - hull.z")
    scene.add_limit_state("own[over]", minimum=5.0)
    result = simulate(scene, 2.0)
    lowest = result.curve("own[over]").min()
    assert result.utilisation[0].utilisation == pytest.approx(5.0 / lowest)
    assert Criterion(channel="own[over]", minimum=5.0).names == {"expression": "over"}
    assert Kept.of_text("own[over].min").of(result).values == pytest.approx(lowest)


def test_a_stage_ends_where_it_says(tmp_path: Path) -> None:
    scene = hoisting()
    scene.add_channel("raised", expression="load.z + 10 m")
    scene.add_channel("slack", expression="line_unstretched_length[wire] - 2 m")
    up = {"until": Until.channel("own[raised]", minimum=1.0), "maximum_duration": 20.0}
    stages = [Stage(name="up", **up), Stage(name="on", duration=1.0)]
    for asked in (None, ["own", "position", "hook_speed"]):
        result = simulate(scene, stages, dt_out=0.05, channels=asked)
        end = result.stages[0].end
        assert 1.5 < end < 3.0
        assert np.interp(end, result.time, result.curve("own[raised]")) == pytest.approx(1.0, abs=1e-3)
        assert_allclose(result.curve("own[raised]"), result.curve("position[load, z]") + 10.0, atol=1e-12)
    assert "hook_speed" in result
    assert_array_equal(Result.load(result.save(tmp_path / "run.nc"))["own"], result["own"])


def test_files_keep_it_and_digests_tell_it(tmp_path: Path) -> None:
    scene = tumbling()
    digest, path = scene_digest(scene), tmp_path / "scene.json"
    scene.save(path)
    assert not Scene.load(path).channels
    described(scene)
    assert scene_digest(scene) != digest and scene_digest(tumbling()) == digest
    scene.save(path)
    assert Scene.load(path).channels == scene.channels
    path.write_text(path.read_text().replace("corner.z", "croner.z"))
    with pytest.raises(FileFormatError, match=r"no point or body 'croner'; did you mean 'corner'\?"):
        Scene.load(path)


NEEDED, DEEP = "number or a curve was expected at", f"more than {DEEPEST} parentheses"
REFUSED = [
    ("load.z + heel[hull]", r"'\+' is of m and rad"), ("load.z - 3", "'-' is of m and 1.*'3 m'"),
    ("hypot(load.z, velocity[load, z])", "'hypot' is of m and m/s"), ("lod.z", "'lod'; did you mean 'load'"),
    ("sqr(load.z)", "function 'sqr'; did you mean 'sqrt'"), ("atan2(load.z)", "atan2 has 1 arguments.*2"),
    ("load.z load.x", "operator or the end .* at 'load.x'"), ("(load.z", r"'\)' was expected at its end"),
    ("", f"channel 'a' is '': a {NEEDED}"), ("1e999 m", "'1e999' is no finite number"),
    ("own[a]", "is a channel of your own too"), ("slew_angle", "slew_angle counts on over a whole run"),
    ("load_state", "load_state is in SI"), ("vessel_motion", "one unit"),
    ("position[load, z, after=3]", "leave after out"), ("__import__('os').system('true')", "is no part"),
    ("load.z ** 2", rf"{NEEDED} '\*'"), ("(" * 100 + "load.z" + ")" * 100, DEEP),
    ("-" * 900 + "load.z", DEEP), ("load.z+" * 500 + "load.z", f"3506 characters, above {LONGEST}"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "told"), REFUSED, ids=[row[0][:30] for row in REFUSED])
def test_what_makes_no_sense_is_refused_by_name(text: str, told: str) -> None:
    scene = tumbling()
    with pytest.raises(SceneError, match=told) as caught:
        scene.add_channel("a", expression=text)
    assert str(caught.value).startswith("channel 'a'") and len(str(caught.value)) < 500
    assert not scene.channels


def test_names_that_the_scene_does_not_have_end_before_a_run() -> None:
    scene = hoisting()
    scene.add_channel("a", expression="line_tension[wier]")
    with pytest.raises(SceneError, match=r"channel 'a': line_tension.*'wier'; did you mean 'wire'"):
        simulate(scene, 0.1)


def test_a_name_of_a_point_and_a_body_is_told_apart() -> None:
    scene = tumbling()
    scene.add_point(name="load", body="hull", point=(0, 0, 0))
    with pytest.raises(SceneError, match=r"point and a body; write point_position\[load, z\] or position"):
        scene.add_channel("a", expression="load.z")
    scene.add_point(name="corner 0", body="hull", point=(0, 0, 0))
    scene.add_channel("a", expression="'corner 0'.z - \"corner 0\".x")
    assert scene.channels["a"].unit == "m"


def test_ensembles_and_linear_models_take_it() -> None:
    scene = cases.vessel(hs=1.0, tp=8.0)
    scene.add_channel("bow", expression="vessel_motion[heave] - 60 m * vessel_motion[pitch] / 1 rad")
    kept = ensemble(scene, over={"seed": [1, 2]}, keep={"bow": "own[bow].max"}, t_end=10.0)
    assert not kept.failures
    values = kept.dataset["bow"].values
    assert values.shape == (2,) and values[0] != values[1]
    motions = [Criterion(channel=channel, maximum=1.0) for channel in ("own[bow]", "heave", "pitch")]
    known = linear_channels(linear_model(scene), motions)
    assert_allclose(known.c[0], known.c[1] - 60.0 * known.c[2], atol=1e-9)
