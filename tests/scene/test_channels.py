"""The core's table of channels is the only one: results, files and documents follow from it."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_restart import chain, crank

from seacrane import Result, SceneError, _core, cases, simulate
from seacrane.description.channels import DERIVED, FIXED, NAMED, OWN
from seacrane.result import CHANNELS

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

TOOL = Path(__file__).parents[2] / "tools" / "channel_table.py"


def tool() -> Any:
    spec = importlib.util.spec_from_file_location("channel_table", TOOL)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_every_channel_has_a_name_of_its_own_dimensions_a_unit_and_a_text() -> None:
    core = _core.channels()
    assert len({channel.name for channel in core}) == len(core)
    assert [*(channel.name for channel in core), *DERIVED] == list(CHANNELS)
    for name, channel in CHANNELS.items():
        assert channel.dims[0] == channel.dims_of_several[0] == "time", name
        assert set(channel.dims_of_several[1:]) <= set(FIXED) | NAMED, name
        assert channel.unit and channel.long_name, name


def test_no_channel_has_the_name_of_a_dimension() -> None:
    """A file has one name for either."""
    assert not set(CHANNELS) & (NAMED | set(FIXED))


def test_what_a_scene_offers_by_default_is_what_the_table_says() -> None:
    model = cases.case2().compile()
    offered, default = model.channel_names(defaults_only=False), model.channel_names()
    assert default == [name for name in offered if CHANNELS[name].by_default]
    assert {"acceleration", "angular_acceleration"} <= set(offered) - set(default)


@pytest.mark.parametrize("make", [chain, crank, cases.case2])
def test_every_channel_carries_the_names_of_the_scene(make: Any) -> None:
    scene = make()
    model = scene.compile()
    result = simulate(scene, t_end=0.1, channels=model.channel_names(defaults_only=False))
    for name, array in result.channels.items():
        assert array.shape[1:] == tuple(len(result.coords[dim]) for dim in result.dims[name][1:]), name
    expected = {
        "body": scene.bodies, "joint": scene.joints, "joint_coordinate": scene.recorded,
        "actuator": scene.actuators, "driver": scene.drivers,
        "link": [name for name, joint in scene.joints.items() if joint.kind == "distance"],
    }  # fmt: skip
    for dim, names in expected.items():
        assert result.coords.get(dim, ()) == tuple(names), dim


@pytest.mark.warns("UnitWarning")
def test_several_vessels_are_told_apart_by_name() -> None:
    scene = cases.vessel(hs=0.0, memory="none")
    there = next(iter(scene.vessels.values()))
    scene.add_body(name="barge", mass=1e6, inertia=(1e8, 1e8, 1e8), position=(200.0, 0.0, 0.0))
    scene.add_vessel(
        body="barge",
        added_mass=there.added_mass,
        restoring=there.restoring,
        linear_damping=there.linear_damping,
    )
    result = simulate(scene, t_end=0.1)
    assert result.dims["vessel_motion"] == ("time", "vessel", "motion")
    assert result.coords["vessel"] == tuple(scene.vessels)


def test_channels_recorded_alone_are_those_of_a_run_that_records_all() -> None:
    """Whatever is evaluated for an output, for few channels or for many, leaves the steps as they are."""
    scene = cases.case2()
    offered = scene.compile().channel_names(defaults_only=False)
    settings: dict[str, Any] = {"t_end": 3.0, "formulation": "redundant"}
    whole = simulate(scene, channels=offered, **settings)
    for name in offered:
        alone = simulate(scene, channels=[name], **settings)
        assert np.array_equal(alone[name], whole[name]), name
        assert alone.stats["evaluations"] == whole.stats["evaluations"], name


def test_what_is_derived_says_what_it_is_made_of() -> None:
    core = {channel.name for channel in _core.channels()}
    for name, channel in DERIVED.items():
        assert set(channel.made_of) <= core and bool(channel.made_of) == (name != OWN), name
    with pytest.raises(SceneError, match="channel 'stroke' is unknown to this scene"):
        simulate(chain(), t_end=0.1, channels=["stroke"])


def test_an_axis_of_any_name_is_saved_and_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither results nor files know axes by name: a channel over a new one needs its entry alone."""
    from seacrane.description import channels
    from seacrane.result import result, result_file

    dims = ("time", "point", "axis")
    new = channels.Channel(dims=dims, dims_of_several=dims, unit="m", long_name="of named points")
    table = {**CHANNELS, "point_position": new}
    for module in (channels, result):
        monkeypatch.setattr(module, "CHANNELS", table)
    monkeypatch.setattr(result_file, "NAMED", NAMED | {"point"})
    stats = simulate(chain(), t_end=0.1).stats
    made = Result.from_arrays(
        time=[0.0, 1.0], arrays={"point_position": np.arange(12.0).reshape(2, 2, 3)},
        coords={"point": ["hook", "tip"]}, stats=stats,
    )  # fmt: skip
    read = Result.load(made.save(tmp_path / "r.nc"))
    assert read.coords == made.coords == {"point": ("hook", "tip"), "axis": ("x", "y", "z")}
    assert np.array_equal(read.select("point_position", point="tip", axis="z"), [5.0, 11.0])


def test_the_documented_table_is_current() -> None:
    made = tool()
    text = made.DOCUMENT.read_text(encoding="utf-8")
    assert text == made.current(text), "run python tools/channel_table.py"
