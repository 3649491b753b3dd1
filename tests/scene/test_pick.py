"""One text says which curves are meant, wherever a result, a criterion or what is kept asks for them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane import (
    Criterion,
    Kept,
    Result,
    Scene,
    SceneError,
    Until,
    cases,
    ensemble,
    extremes,
    simulate,
)
from seacrane.description.channels import CHANNELS, FIXED
from seacrane.description.pick import Pick, column_name, pick_of


@pytest.fixture(scope="module")
def lift() -> Result:
    return simulate(cases.case2(), t_end=3.0, dt_out=0.5)


@pytest.mark.parametrize(
    ("text", "channel", "names", "after"),
    [
        ("hook_load", "hook_load", {}, None),
        ("roll", "vessel_motion", {"motion": "roll"}, None),
        ("vessel_motion[barge, roll]", "vessel_motion", {"vessel": "barge", "motion": "roll"}, None),
        ("vessel_motion[ roll ,after=60]", "vessel_motion", {"motion": "roll"}, 60.0),
        ("position[z, load]", "position", {"body": "load", "axis": "z"}, None),
        ("position[axis=x, body=z]", "position", {"body": "z", "axis": "x"}, None),
        ('hook_load["a, b"]', "hook_load", {"suspension": "a, b"}, None),
        ("load_state[hoist.length]", "load_state", {"state_name": "hoist.length"}, None),
        ("reaction_force[main foot, y]", "reaction_force", {"joint": "main foot", "axis": "y"}, None),
    ],
)
def test_a_text_names_channel_dimensions_and_time(
    text: str, channel: str, names: dict[str, str], after: float | None
) -> None:
    assert pick_of("test", text) == Pick(channel=channel, names=names, after=after)


@pytest.mark.parametrize("channel", CHANNELS)
def test_every_curve_of_every_channel_has_a_text_that_finds_it(channel: str) -> None:
    dims = CHANNELS[channel].dims_of_several[1:]
    names = {dim: FIXED[dim][-1] if dim in FIXED else f"the {dim}, 1" for dim in dims}
    assert pick_of("test", column_name(channel, list(names.values()))).names == names
    whole = Pick(channel=channel, names=names)
    assert pick_of("test", whole) == whole


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("hok_load", "did you mean 'hook_load'"),
        ("position[load, z, y]", "has no 'y'"),
        ("position[load, axis=w]", "axis is 'w'; choose from x, y, z"),
        ("position[load, hook=z]", "has no dimension 'hook'"),
        ("position[axis=z, axis=y]", "two names along axis"),
        ("position[load,, z]", "names with commas between"),
        ("position[load", "give a channel"),
        ("hook_load[after=soon]", "after is 'soon'; give a time in s"),
        ("energy_balance[x]", "dimensions are none but time"),
    ],
)
def test_a_text_that_says_nothing_is_refused_by_what_is_wrong(text: str, said: str) -> None:
    with pytest.raises(SceneError, match=said.replace("[", r"\[")):
        pick_of("test", text)


def test_select_and_curve_take_the_text(lift: Result) -> None:
    roll = lift.select("vessel_motion", motion="roll")
    assert np.array_equal(lift.select("roll"), roll)
    assert np.array_equal(lift.select("vessel_motion[roll]"), roll)
    assert np.array_equal(lift.curve("roll"), roll)
    assert lift.select("position[payload]").shape == (lift.time.size, 3)
    with pytest.raises(SceneError, match="holds several curves; give axis: one of x, y, z"):
        lift.curve("position[payload]")
    with pytest.raises(KeyError, match="no channel 'hok'"):
        lift.select("hok")
    with pytest.raises(ValueError, match="all outputs"):
        lift.select("roll[after=1]")  # no such dimension without a channel
    with pytest.raises(ValueError, match="all outputs"):
        lift.select("vessel_motion[roll, after=1]")


def test_a_table_has_a_column_for_each_curve_under_its_text(lift: Result, tmp_path: Path) -> None:
    table = lift.to_dataframe("roll", "position[payload]")
    assert list(table) == [
        "vessel_motion[roll]",
        *(f"position[payload, {axis}]" for axis in "xyz"),
    ]
    assert table.index.name == "time"
    assert table.attrs["units"]["vessel_motion[roll]"] == "rad"
    for name in table:
        assert np.array_equal(table[name], lift.select(name))
    whole = lift.to_dataframe()
    assert len(whole.columns) == sum(array[0].size for array in lift.channels.values())
    late = lift.to_dataframe("vessel_motion[roll, after=1]")
    assert late.index[0] == 1.0
    with pytest.raises(SceneError, match="of one part of the run"):
        lift.to_dataframe("vessel_motion[roll, after=1]", "link_tension")

    path = lift.to_csv(tmp_path / "lift.csv", "roll", "link_tension")
    first, *rows = path.read_text(encoding="utf-8").splitlines()
    assert first == "time,vessel_motion[roll],link_tension"
    read = np.array([[float(cell) for cell in row.split(",")] for row in rows])
    assert np.array_equal(read.T, [lift.time, lift.select("roll"), lift["link_tension"]])


def test_what_is_kept_is_said_by_a_text() -> None:
    roll = {"motion": "roll"}
    assert Kept.of_text("roll.std") == Kept(channel="vessel_motion", what="standard_deviation", names=roll)
    assert Kept.of_text("hook_load.max") == Kept(channel="hook_load", what="maximum")
    assert Kept.of_text("load_state[hoist.length]") == Kept(
        channel="load_state", names={"state_name": "hoist.length"}
    )
    late = Kept(channel="position", what="minimum", names={"body": "load", "axis": "z"}, after=60.0)
    assert Kept.of_text("position[load, z, after=60].min") == late
    assert Kept(channel="position[load, z, after=60]", what="minimum") == late
    with pytest.raises(SceneError, match="give each name once"):
        Kept(channel="position[load, z]", names={"axis": "x"})
    with pytest.raises(SceneError, match="did you mean 'hook_load'"):
        Kept.of_text("hok_load.max")


def test_an_ensemble_keeps_by_text_what_it_keeps_by_value() -> None:
    scene = Scene(name="pendulum")
    scene.add_body(name="bob", mass=2.0, inertia=(0.1, 0.1, 0.1), position=(1, 0, 0))
    scene.add_joint(
        kind="revolute", name="pin", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    value = Kept(channel="position", what="minimum", names={"body": "bob", "axis": "z"})
    found = ensemble(
        scene, over={"gravity": [9.0, 9.8]}, keep={"low": "position[bob, z].min", "same": value}, t_end=1.0
    )
    assert np.array_equal(found.dataset.low, found.dataset.same)
    with pytest.raises(SceneError, match=r"give a text such as 'hook_load.max'"):
        ensemble(scene, over={"gravity": [9.0]}, keep={"low": 3}, t_end=1.0)  # type: ignore[dict-item]


def test_criteria_conditions_extremes_and_plots_take_the_text(lift: Result) -> None:
    given = {"names": {"body": "load", "axis": "z"}, "maximum": 1.0}
    assert Criterion(channel="position[load, z]", maximum=1.0) == Criterion(channel="position", **given)
    assert Until.channel("position[load, z]", minimum=1.0) == Until.channel(
        "position", minimum=1.0, body="load", axis="z"
    )
    figures = lift.plot("roll"), lift.plot("vessel_motion", motion="roll")
    drawn = [figure.axes[0].lines[0].get_ydata() for figure in figures]
    assert np.array_equal(*drawn)
    several = simulate(cases.vessel(), t_end=200.0, dt_out=0.5)
    by_text = extremes(several, channel="roll", after=20.0)
    by_names = extremes(several, channel="vessel_motion", motion="roll", after=20.0)
    assert str(by_text) == str(by_names)
    for ask in (
        lambda: Criterion(channel="roll[after=3]", maximum=1.0),
        lambda: Until.channel("vessel_motion[roll, after=3]", minimum=1.0),
        lambda: extremes(lift, channel="vessel_motion[roll, after=3]"),
    ):
        with pytest.raises(SceneError):
            ask()
