"""Studies whose lift varies in its keys, and studies with an accuracy."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lift_examples import ON_DECK

from seacrane import Lift, SceneError, simulate
from seacrane.errors import FileFormatError
from seacrane.lift.lift import LIFTS
from seacrane.lift.study_run import keys_in, run_study, with_keys

BALANCED = """format = "seacrane lift"
version = 2
vessel = { database = "hull_115", memory = "none" }
sea = { seed = 7, hs_m = 1.5, tp_s = 8, count = 20 }
balance = { vessel = "vessel" }
method = { integrator = "dopri5", rtol = 1e-3 }

[crane]
foot_m = [33, 10, 10]
payload = { mass_kg = 20e3, size_m = [4, 4, 3], link_length_m = 8 }
held = true
"""
STUDY = """format = "seacrane lift"
version = 2
run = { t_end_s = 2 }
[study]
lift = "held.toml"
over = { "crane.payload.mass_kg" = [20e3, 100e3], seed = [7, 8] }
[[study.keep]]
name = "heave"
channel = "position"
names = { body = "vessel", axis = "z" }
what = "mean"
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    (tmp_path / "held.toml").write_text(BALANCED)
    (tmp_path / "masses.toml").write_text(STUDY)
    return tmp_path / "masses.toml"


def test_what_is_derived_from_a_key_follows_it(study: Path) -> None:
    out, held = study.parent / "out", study.parent / "held.toml"
    found = run_study(study, out)
    assert not found.failures
    assert dict(found.dataset.sizes) == {"crane.payload.mass_kg": 2, "seed": 2}
    for mass in (20e3, 100e3):
        tables = Lift.load(held).tables
        tables["crane"]["payload"]["mass_kg"] = mass
        lift = Lift(tables)
        result = simulate(lift.scene(), 2.0, method=lift.method)
        expected = result.select("position", body="vessel", axis="z").mean()
        one = found.dataset.heave.sel({"crane.payload.mass_kg": mass, "seed": 7})
        assert float(one) == pytest.approx(expected, abs=1e-4)
    assert not np.array_equal(found.dataset.heave.sel(seed=7), found.dataset.heave.sel(seed=8))
    assert run_study(study, out).dataset.identical(found.dataset)
    held.write_text(BALANCED.replace("mass_kg = 20e3, size_m = [4", "mass_kg = 20e3, size_m = [5"))
    with pytest.raises(SceneError, match="is of another study"):
        run_study(study, out)
    with pytest.raises(SceneError, match="give a folder: object stores"):
        run_study(study, "memory://bucket/out")
    study.write_text(STUDY.replace("seed = [7, 8]", '"crane.payload.mass_t" = [20, 100]'))
    with pytest.raises(FileFormatError, match=r"mass_t is .*mass_kg in another unit"):
        run_study(study, study.parent / "other")


@pytest.mark.parametrize("name", LIFTS)
def test_every_key_of_a_lift_has_its_place(name: str) -> None:
    """Put back where it was found, each leaves the lift as it is."""
    lift = Lift.shipped(name)
    places = keys_in(lift.tables)
    assert len(places) > 10
    for path, place in places.items():
        value: Any = lift.tables
        for part in place.place:
            value = value.get(part) if isinstance(part, str) else value[part]
        if value is not None:
            assert with_keys(lift.tables, places, {path: value}) == lift.tables
            assert path.rsplit(".")[0] == place.place[0]


def test_paths_go_by_names_numbers_and_units() -> None:
    tables = {
        "crane": {"foot_m": [1.0, 2.0, 3.0], "slew_deg": 3.0},
        "actuator": [{"joint": "a"}, {"joint": "b", "stiffness_N_per_m": 5.0}],
        "command": {"name": "slew", "joint": "A", "reference_deg": {"kind": "constant", "value": 1.0}},
        "sea": {"systems": [{"name": "swell", "hs_m": 1.0}]},
        "method": {"tolerance": 1e-3},
    }
    places = keys_in(tables)
    found = with_keys(
        tables, places,
        {"crane.slew_rad": 0.1, "crane.foot_m.2": 9.0, "actuator.2.stiffness_N_per_m": 6.0,
         "sea.systems.swell.hs_m": 2.0},
    )  # fmt: skip
    assert found["crane"] == {"foot_m": [1.0, 9.0, 3.0], "slew_rad": 0.1}
    assert found["actuator"][1]["stiffness_N_per_m"] == 6.0 and found["sea"]["systems"][0]["hs_m"] == 2.0
    assert tables["crane"] == {"foot_m": [1.0, 2.0, 3.0], "slew_deg": 3.0}
    assert not {"command.reference_deg", "command.reference_rad"} & {*places}  # a curve, in any unit
    assert not [path for path in places if path.startswith("method")]


@pytest.mark.warns("ThroughSeatWarning")
def test_a_study_file_of_a_lift_in_stages(tmp_path: Path) -> None:
    over = '[study.over]\n"stages.lift off.commands.hoist.rate" = [-0.1]\n'
    keep = '[[study.keep]]\nname = "lifted"\nchannel = "stage[lift off].end"\n'
    (tmp_path / "study.toml").write_text(f"{ON_DECK}{over}{keep}")
    done = run_study(tmp_path / "study.toml", tmp_path / "out").dataset
    (tmp_path / "other.toml").write_text(ON_DECK.replace("m_per_s = -0.05", "m_per_s = -0.1"))
    run = Lift.load(tmp_path / "other.toml").simulate()
    assert float(done.lifted.squeeze()) == run.stages[1].end
