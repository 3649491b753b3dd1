"""One text says which curves are meant, wherever a result, a criterion or what is kept asks for them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from named import pendulum

from seacrane import Kept, Result, cases, ensemble, simulate
from seacrane.description.channels import CHANNELS, FIXED
from seacrane.description.pick import Pick, column_name, pick_of
from seacrane.errors import SceneError


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
    assert first == "time,vessel_motion[roll],link_tension"
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
