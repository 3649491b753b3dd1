"""The two barges of the package, groups in files, and a lift off one of them by the other."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Outputs, Scene, Stage, Until, simulate_stages
from seacrane.answers import contact_hits
from seacrane.crane import load_crane
from seacrane.errors import FileFormatError
from seacrane.hydro import HydroGroup, passivity_certificate, two_barges
from seacrane.hydro.data.memory_model import MemoryBlock
from seacrane.hydro.memory.independent_states import independent_blocks
from seacrane.validity.left_range import findings

MASS, DECK, SLACK, RATE = 60e3, 2.5, 0.3, 0.4  # kg, m, m, m/s
FEET = [(x, y, -2.5) for x in (-3.5, 3.5) for y in (-2.5, 2.5)]
OFF = {"until": Until.clear("feet", minimum=1.0), "maximum_duration": 30.0}
LIFT = [Stage(name="wait", duration=2.0), Stage(name="lift off", commands={"hoist.rate": -RATE}, **OFF)]
RECORDED = Outputs(dt_out=0.02, channels=("contact_press", "line_tension", "position"))


@lru_cache(maxsize=4)
def feeder_lift(lid_damping: float | None, hs: float) -> Scene:
    scene = Scene(name="feeder lift", gravity=9.81)
    scene.add_vessels(two_barges(lid_damping=lid_damping), mooring_period=60.0)
    jib, head = scene.add_crane(
        load_crane("lattice_boom_100t"), base="crane vessel", foot=(0.0, 6.0, 3.0),
        coordinates={"slew": -0.5 * np.pi, "boom": 1.176},
    ).tip  # fmt: skip
    scene.add_ballast(vessel="crane vessel")
    x, y, z = scene.place_of("tip")
    scene.add_body(name="load", mass=MASS, size=(8.0, 6.0, 5.0), position=(x, y, DECK + 2.5))
    scene.add_contact("load", on="feeder", points=FEET, place=(0.0, 0.0, DECK), friction=0.4, name="feet")
    scene.add_line(
        name="hoist", bodies=[jib, "load"], points=[head, (0.0, 0.0, 2.5)], EA=3e8,
        length=z - DECK - 5.0 + SLACK,
    )  # fmt: skip
    scene.add_winch(line="hoist", maximum_acceleration=0.5, lag=0.2)
    for vessel in scene.vessels if hs > 0.0 else ():
        scene.add_sea(vessel=vessel, hs=hs, tp=8.0, direction_deg=-120.0, seed=1)
    return scene


@pytest.mark.parametrize("lid", [None, 0.03])
def test_their_memory_is_passive_and_near_their_matrices(lid: float | None) -> None:
    group = two_barges(lid_damping=lid)
    assert passivity_certificate(group.memory).passive
    assert group.memory.motion.error.worst < 0.035
    assert group.lid_damping == lid
    coupling = np.abs(group.damping[:, :6, 6:]).max()
    assert coupling == 0.0 if lid is None else coupling > 0.02 * np.abs(group.damping[:, :6, :6]).max()
    assert group.names == ("crane vessel", "feeder")
    for body, volume in zip(group.bodies, (100.0 * 25.0 * 5.5, 60.0 * 18.0 * 3.5), strict=True):
        assert body.mass_matrix[0, 0] == pytest.approx(1025.0 * volume, rel=1e-12)
        assert body.restoring[2, 2] * body.draught == pytest.approx(1025.0 * 9.81 * volume, rel=1e-6)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [(b"group 1\n", b"group 2\n", "version '2'"), (b"\0" * 9, b"", "damaged group")],
)
def test_a_group_is_kept_and_a_file_of_none_refused(
    old: bytes, new: bytes, message: str, tmp_path: Path
) -> None:
    path, group = tmp_path / "pair.hydro", two_barges(lid_damping=0.01)
    group.save(path)
    again = HydroGroup.load(path)
    assert again.digest == group.digest
    assert replace(again, rho=1000.0).digest != group.digest
    path.write_bytes(path.read_bytes().replace(old, new, 1))
    with pytest.raises(FileFormatError, match=f"pair.hydro.*{message}"):
        HydroGroup.load(path)


def test_a_lift_in_still_water_is_that_by_hand() -> None:
    """The feet leave in the second in which the wire has taken the weight; no foot comes back."""
    result = simulate_stages(feeder_lift(0.03, 0.0), LIFT, start=None, outputs=RECORDED, rtol=1e-5)
    hook = np.asarray(result.select("line_tension", line="hoist"))
    off = [event.time for event in result.events if event.kind == "release"]
    at = np.searchsorted(result.time, max(off))
    assert hook[at] == pytest.approx(MASS * 9.81, rel=0.1)
    assert all(hit.number == 0 for hit in contact_hits(result, "feet"))
    assert result.stages[1].ended_by.startswith("contact_least_gap")


def test_a_second_of_a_run_does_not_tell_a_mean_place_or_a_frequency() -> None:
    scene = feeder_lift(0.03, 1.5)
    for span, told in ((1.0, False), (60.0, True)):
        time = np.linspace(0.0, span, 241)
        moved = np.zeros((241, 2, 6))
        moved[:, 1, 1] = 5.0 + 0.1 * np.sin(9.0 * time)
        found = findings(scene, time, {"vessel_motion": moved}, {})
        said = [kind.__name__ for kind, _ in found]
        assert ("RelativePlaceWarning" in said) == told
        assert ("OutsideDatabaseWarning" in said) == told


def test_blocks_whose_states_do_not_feel_each_other_make_the_same_loads() -> None:
    def transfer(block: MemoryBlock, omega: float) -> Any:
        shifted = 1j * omega * np.eye(len(block.A)) - block.A
        return block.C @ np.linalg.solve(shifted, block.B) + block.D

    for block in two_barges(lid_damping=0.03).memory.blocks:
        parts = independent_blocks(block)
        assert len(parts) > 1
        assert sum(len(part.A) for part in parts) == len(block.A)
        for omega in (0.0, 0.7, 3.0):
            whole, apart = transfer(block, omega), sum(transfer(part, omega) for part in parts)
            np.testing.assert_allclose(apart, whole, rtol=0.0, atol=1e-12 * np.abs(whole).max())
