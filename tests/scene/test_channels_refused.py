"""A channel that a scene cannot have is refused by name, however it is asked for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from seacrane import (
    Criterion,
    Outputs,
    Run,
    Scene,
    SceneError,
    Stage,
    allowable_hs,
    ensemble,
    shipped_database,
    simulate,
    simulate_stages,
)
from seacrane.result import CHANNELS


def box() -> Scene:
    scene = Scene(name="box")
    scene.add_body("load", mass=1e3, size=(1, 1, 1), position=(0, 0, 5))
    return scene


def rod() -> Scene:
    scene = box()
    scene.add_joint(
        kind="distance", name="rod", first="ground", second="load", point=(0, 0, 20),
        second_point=(0, 0, 5),
    )  # fmt: skip
    scene.add_body("arm", mass=1.0, inertia=(1.0, 1.0, 1.0))
    scene.add_joint(
        kind="prismatic", name="slide", first="ground", second="arm", point=(0, 0, 0), axis=(1, 0, 0)
    )
    scene.add_driver(joint="slide", curve=0.0)
    return scene


def ship() -> Scene:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database())
    scene.add_sea(hs=1.0, tp=8.0, direction_deg=90.0)
    return scene


def crane() -> Scene:
    scene = ship()
    scene.add_crane()
    scene.add_ballast()
    return scene


def hoist() -> Scene:
    scene = ship()
    scene.add_crane()
    scene.add_hoist(mass=1e4, size=(2, 2, 2), length=8.0, EA=1e7)
    scene.add_ballast()
    return scene


@pytest.mark.parametrize("make", [box, rod, ship, crane, hoist])
def test_each_channel_is_recorded_or_refused_by_its_name(make: Callable[[], Scene]) -> None:
    scene = make()
    refused = set()
    for channel in CHANNELS:
        try:
            run = Run(scene, 0.1, outputs=Outputs(channels=[channel]))
        except SceneError as error:
            assert f"channel {channel!r} is unknown to this scene" in str(error)
            refused.add(channel)
        else:
            assert channel in run.measure(), channel
    assert {"own", "clearance"} < refused < set(CHANNELS)


WAYS: dict[str, Callable[[Scene, str], Any]] = {
    "outputs": lambda scene, channel: simulate(scene, 0.1, channels=[channel]),
    "stages": lambda scene, channel: simulate_stages(
        scene, [Stage(name="all", duration=0.1)], channels=[channel]
    ),
    "kept": lambda scene, channel: ensemble(scene, over={"seed": [1]}, keep={"most": f"{channel}.max"}),
    "criterion": lambda scene, channel: allowable_hs(
        scene, criteria=[Criterion(channel=channel, maximum=1.0)], tp=[8.0], direction_deg=[90.0], hs=[1.0]
    ),
    "limit state": lambda scene, channel: simulate(limited(scene, channel), 0.1),
    "limit state of stages": lambda scene, channel: simulate_stages(
        limited(scene, channel), [Stage(name="all", duration=0.1)]
    ),
}


def limited(scene: Scene, channel: str) -> Scene:
    scene.add_limit_state(channel, maximum=1.0)
    return scene


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("channel", ["swing", "offlead", "utilisation", "tip_velocity", "line_tension"])
def test_it_is_refused_by_every_way_of_asking(way: str, channel: str) -> None:
    with pytest.raises(SceneError, match=f"channel '{channel}' is unknown to this scene; it"):
        WAYS[way](ship(), channel)


@pytest.mark.warns("LineLengthWarning")
def test_what_a_later_stage_connects_is_recorded_there_and_its_limits_hold() -> None:
    scene = hoist()
    scene.add_limit_state("swing", maximum=1.0)
    stages = [Stage(name="before", duration=0.2), Stage(name="hooked", connect=["hoist"], duration=0.2)]
    result = simulate_stages(scene, stages, channels=["swing", "position"], rtol=1e-3)
    assert np.isnan(result["swing"][0]) and np.isfinite(result["swing"][-1])
    assert np.isfinite(result.utilisation.largest)
