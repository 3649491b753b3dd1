"""What a newcomer is told: at the start of a run however it is asked for, and of what was never given."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mistaken_units import raos, record

import seacrane as sc
from seacrane.hydro import BoxPart, CylinderPart, PlatePart, SpherePart, load_database
from seacrane.warnings import NoisyMotionWarning, RaoPhaseWarning, UnitWarning

SHORT, ALL = {"rtol": 1e-2, "dt_out": 0.1}, [sc.Stage(name="all", duration=0.1)]


def module(*, height: float = -5.0, size: Any = (6, 4, 4), **hoist: Any) -> sc.Scene:
    scene = sc.Scene(name="module")
    scene.add_vessel(sc.shipped_database())
    scene.add_crane(slew=np.radians(-60.0), s1=2.0, s2=2.0)
    scene.add_hoist(mass=35e3, size=size, height=height, falls=2, EA=6e7, **hoist)
    scene.add_immersed("load", parts=[BoxPart(size=size, fill=0.2)])
    scene.add_ballast()
    scene.add_sea(hs=1.2, tp=6.5, direction_deg=90.0)
    return scene


def told(run: Callable[[], Any]) -> dict[str, str]:
    with warnings.catch_warnings(record=True, action="always") as caught:
        run()
    return {one.category.__name__: str(one.message) for one in caught}


RUNS: dict[str, Callable[[sc.Scene], Any]] = {
    "described": lambda scene: sc.simulate(scene, 0.1, **SHORT),
    "rest": lambda scene: sc.simulate(scene, 0.1, start="rest", **SHORT),
    "stages": lambda scene: sc.simulate(scene, ALL, **SHORT),
    "stages from rest": lambda scene: sc.simulate(scene, ALL, start="rest", **SHORT),
}


@pytest.mark.parametrize("run", RUNS)
def test_every_run_tells_the_same_of_a_scene(run: str) -> None:
    """But of the described pose, which a start at rest leaves."""
    scene = module()
    scene.add_point("mark", body="load", point=(2000.0, 0.0, 0.0))
    found = told(lambda: RUNS[run](scene))
    assert {"ScatteredWavesWarning", "UnitWarning"} <= found.keys()
    assert ("LiftedStartWarning" in found) == ("rest" not in run)


@pytest.mark.parametrize("rig", [{}, {"block_mass": 1e3, "slings": {"angle_deg": 60, "EA": 5e7}}])
def test_a_wire_that_carries_the_dry_weight_under_water_is_told(rig: dict[str, Any]) -> None:
    assert "'load': " in told(lambda: sc.simulate(module(**rig), 0.1, **SHORT))["LiftedStartWarning"]
    assert "LiftedStartWarning" not in told(lambda: sc.simulate(module(height=2.0, **rig), 0.1, **SHORT))


@pytest.mark.parametrize(
    ("slew", "height", "category"),
    [(0.0, 10.0, ""), (0.0, 5.0, "LoadInHullWarning"), (-np.pi / 2, 10.0, "LoadOffDeckWarning")],
)
def test_a_load_that_stands_on_no_deck_is_told_by_name(slew: float, height: float, category: str) -> None:
    scene = sc.Scene(name="deck")
    scene.add_vessel(sc.shipped_database())
    scene.add_crane(slew=slew, s1=2.0, s2=2.0)
    scene.add_hoist(mass=35e3, size=(6, 4, 4), on="vessel", height=height, EA=6e7)
    scene.add_ballast()
    said = told(lambda: RUNS["described"](scene))
    about = {name for name in said if name in ("LoadInHullWarning", "LoadOffDeckWarning")}
    assert about == ({category} if category else set())
    assert all("'load'" in said[name] for name in about)


@pytest.mark.parametrize(("aside", "told_of"), [(0.0, False), (24.0, True)])
def test_a_load_beside_the_plane_of_a_deck_is_told(aside: float, told_of: bool) -> None:
    scene = sc.Scene(name="ship")
    scene.add_vessel(sc.shipped_database())
    scene.add_body("box", mass=1e3, size=(1, 1, 1), position=(0.0, aside, 6.5))
    feet = [(x, y, -0.5) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]
    scene.add_contact("box", on="vessel", points=feet, place=(0, 0, 6))
    assert ("LoadOffDeckWarning" in told(lambda: sc.simulate(scene, 0.05, **SHORT))) == told_of
    scene = sc.Scene(name="barge")
    scene.add_body("barge", mass=1e6, size=(30.0, 10.0, 4.0))
    scene.add_joint("moored", kind="weld", first="ground", second="barge")
    y = 0.2 * aside + 2.0  # of 5 m
    scene.add_body("box", mass=1e3, size=(1, 1, 1), position=(0.0, y, 2.5))
    scene.add_joint("stands", kind="weld", first="barge", second="box", point=(0, y, 2), axis=(0, 0, 1))
    scene.add_stop("stands")
    assert ("'barge'" in told(lambda: sc.simulate(scene, 0.1)).get("LoadOffDeckWarning", "")) == told_of


def wire(**slip: Any) -> sc.Scene:
    scene = sc.Scene(name="wire")
    scene.add_body("load", mass=20e3, size=(4, 3, 2), position=(0, 0, -90))
    given = {"EA": slip.pop("EA", 4e8), "length": 99.0, "first": "ground", "first_point": (0, 0, 10)}
    wet = {"mass_per_length": 25.0, "diameter": 0.06, "medium": "sea", "segments": 5}
    scene.add_line("wire", second="load", **given, wire=wet | slip)
    return scene


ROPE = {"mass_per_length": 4.3, "diameter": 0.08, "EA": 1.2e8}
BOX = (4, 3, 2)
RIGHT = {
    "plate": partial(PlatePart, size=(4, 3), thickness=0.02),
    "cylinder": partial(CylinderPart, length=4.0, diameter=0.3),
    "steel wire": {},
    "fibre rope": ROPE,
    "chain": {"mass_per_length": 126.0, "diameter": 0.076, "EA": 4.9e8},
}
SLIPS = {
    "plate, thickness in cm": partial(PlatePart, size=(4, 3), thickness=2.0),
    "cylinder, length in cm": partial(CylinderPart, length=400.0, diameter=0.3),
    "open box in cm": partial(BoxPart, size=(400, 300, 200), fill=0.0),
    "box, slam as a force": partial(BoxPart, size=BOX, slam=5000.0),
    "sphere in cm": partial(SpherePart, diameter=200.0),
    "wire in N/m": {"mass_per_length": 245.0},
    "wire, diameter in cm": {"diameter": 6.0},
    "rope, EA in kN": ROPE | {"EA": 1.2e5},
}


def wet(part: Any) -> sc.Scene:
    scene = sc.Scene(name="wet")
    scene.add_body("load", mass=20e3, size=(4, 3, 2), position=(0, 0, 1.5))
    ends = {"first": "ground", "first_point": (0, 0, 40), "second": "load"}
    scene.add_line("wire", **ends, EA=1e8, tension_at_start=2e5)
    scene.add_immersed("load", parts=[part])
    return scene


@pytest.mark.parametrize("what", [*RIGHT, *SLIPS])
def test_slips_of_a_unit_in_water_are_told_and_what_is_right_is_not(what: str) -> None:
    one = (RIGHT | SLIPS)[what]
    said = told(lambda: sc.simulate(wire(**one) if isinstance(one, dict) else wet(one()), 0.05, **SHORT))
    assert ("UnitWarning" in said) == (what in SLIPS)


WORDS = ("heading_deg is 0.785398 deg", "direction_deg is 2.35619 deg")


@pytest.mark.filterwarnings("ignore")
def test_what_was_told_before_the_start_is_listed_once() -> None:
    scene = sc.Scene(name="told twice")  # heading and sea both look like radians
    scene.add_vessel(sc.shipped_database(), heading_deg=np.pi / 4)
    scene.add_sea(hs=1.0, tp=8.0, count=20, direction_deg=np.pi * 3 / 4)
    stages = [sc.Stage(name="one", duration=0.5), sc.Stage(name="two", duration=0.5)]
    for result in (sc.simulate(scene.copy(name="copy"), t_end=0.5), sc.simulate(scene, stages)):
        assert all(str(result.stats["described"]).count(word) == 1 for word in WORDS)


@pytest.mark.warns(sometimes=["WavesWithoutLoadWarning"])
@pytest.mark.parametrize("tp", [8000.0, 0.008])
def test_a_peak_period_in_another_unit_is_told(tp: float) -> None:
    scene = sc.Scene(name="ship")
    scene.add_vessel(sc.shipped_database(), memory="none")
    with pytest.warns(UnitWarning, match="sea: tp is"):
        scene.add_sea(tp=tp, hs=1e-6, count=5)


def test_noise_of_millimetres_is_told() -> None:
    """Also a minute that lasts 60 ms; not a record that was filtered, nor a ship that drifts."""
    for noise in (5e-3, 2e-3):
        with pytest.warns(NoisyMotionWarning, match="heave is shaken"):
            record(1.5, noise=noise)
    one, time = record(1.5), np.linspace(0.0, 600.0, 6001)
    with pytest.warns(NoisyMotionWarning):
        sc.MotionHistory(time=one.time / 1e3, motion=one.motion)
    record(1.5, noise=2e-4)
    motion = np.zeros((6001, 6))
    motion[:, 0], motion[:, 3] = 0.5 * time, 0.1 * np.sin(0.5 * time)
    sc.MotionHistory(time=time, motion=motion)


def test_phases_that_no_hull_has_are_told() -> None:
    def in_degrees(values: Any) -> Any:
        return np.abs(values) * np.exp(1j * np.degrees(np.angle(values)))

    for turned, guess in ((np.conj, "conjugate"), (in_degrees, "degrees"), (np.negative, "axis")):
        with pytest.warns(RaoPhaseWarning, match=guess):
            raos(turned)
    scene, database = sc.Scene(name="ship"), sc.shipped_database()
    scene.add_vessel(replace(database, force=np.conj(database.force)), memory="none")
    with pytest.warns(RaoPhaseWarning, match=r"by its wave loads, .*conjugate"):
        scene.add_sea(hs=1.0, tp=8.0, count=5)


@pytest.mark.parametrize("name", ["wamit/tanker.out", "wamit_fpso/fpso.out", "veres/supply/input.hyd"])
def test_databases_of_real_ships_follow_long_waves(name: str, shared: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        warnings.simplefilter("error", RaoPhaseWarning)
        load_database(shared / name)
