"""Results, files and documents follow from the core's table of channels; what a scene has not is refused."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_restart import chain, crank

from seacrane import Outputs, Run, Scene, Stage, _core, cases, simulate, simulate_stages
from seacrane.description.channels import DERIVED, FIXED, NAMED, OWN
from seacrane.errors import SceneError
from seacrane.hydro import shipped_database
from seacrane.result import CHANNELS

# Assembly makes consistent what some scenes describe roughly, on purpose.
pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.AssemblyWarning")

TOOL = Path(__file__).parents[2] / "tools" / "channel_table.py"


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


@pytest.mark.warns("UnitWarning")
def test_several_vessels_are_told_apart_by_name() -> None:
    scene = cases.vessel(hs=0.0, memory="none")
    there = scene.vessels["vessel"]
    scene.add_body("barge", mass=1e6, inertia=(1e8,) * 3, position=(200, 0, 0))
    same = {key: getattr(there, key) for key in ("added_mass", "restoring", "linear_damping")}
    scene.add_vessel(body="barge", **same)
    run = simulate(scene, t_end=0.1)
    assert run.dims["vessel_motion"] == ("time", "vessel", "motion")
    assert run.coords["vessel"] == tuple(scene.vessels)


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


def test_the_documented_table_is_current() -> None:
    spec = importlib.util.spec_from_file_location("channel_table", TOOL)
    assert spec is not None and spec.loader is not None
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    text = made.DOCUMENT.read_text(encoding="utf-8")
    assert text == made.current(text), "run python tools/channel_table.py"


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
            run = Run(scene, 0.1, outputs=Outputs(channels=[channel]))
        except SceneError as error:
            assert f"channel {channel!r} is unknown to this scene" in str(error)
            refused.add(channel)
        else:
            assert channel in run.measure(), channel
    assert {"own", "clearance"} < refused < set(CHANNELS)


@pytest.mark.warns("LineLengthWarning")
def test_what_a_later_stage_connects_is_recorded_there_and_its_limits_hold() -> None:
    scene = ship(hoist=True)
    scene.add_limit_state("swing", maximum=1.0)
    stages = [Stage(name="before", duration=0.2), Stage(name="hooked", connect=["hoist"], duration=0.2)]
    run = simulate_stages(scene, stages, channels=["swing", "position"], rtol=1e-3)
    assert np.isnan(run["swing"][0]) and np.isfinite(run["swing"][-1])
    assert np.isfinite(run.utilisation.largest)
