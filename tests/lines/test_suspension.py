"""What hangs on what: a lift by any rung, and by the paper's rod, is told alike."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from line_scenes import below

from seacrane import Frame, Result, Scene, shipped_database, simulate
from seacrane.answers import load_chart, statics, summary
from seacrane.crane import Payload
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene import Slings
from seacrane.warnings import (
    BallastWarning,
    LargeHeelWarning,
    MeanPositionWarning,
    OverloadWarning,
)

G = 9.80665
MASS, SIZE, LENGTH = 40e3, (3.0, 3.0, 2.0), 12.0
RUNGS: Mapping[str, dict[str, Any]] = {
    "rigid": {}, "quasi-static": {"EA": 4e8}, "elastic": {"EA": 4e8}, "auto": {"EA": 4e8},
    "with mass": {"EA": 4e8, "mass_per_length": 20.0},
}  # fmt: skip
QUICK = ["rod", *(rung for rung in RUNGS if rung != "with mass")]  # whose masses ring at steps of 0.1 ms


def lift(
    rung: str, *, mass: float = MASS, slew: float = 0.0, base: str = "ground", length: float = LENGTH
) -> Scene:
    """The same load, as long a wire and the same crane, whatever it hangs on."""
    scene = Scene(name=f"lift by {rung}")
    if base == "vessel":
        scene.add_vessel(shipped_database())
    if rung == "rod":
        payload = Payload(mass=mass, size=SIZE, link_length=length)
        scene.add_crane(base=base, slew=slew, payload=payload)
    else:
        scene.add_crane(base=base, slew=slew)
        scene.add_hoist(
            load="payload", mass=mass, size=SIZE, length=length,
            rung=rung,  # type: ignore[arg-type]
            **RUNGS[rung],
        )  # fmt: skip
    return scene


@pytest.fixture(scope="module")
def runs() -> dict[str, Result]:
    found = {}
    for rung in QUICK:
        scene = lift(rung, base="vessel", slew=-0.5 * np.pi)
        scene.add_sea(hs=1.0, tp=8.0, seed=3, direction_deg=60.0)
        with warnings.catch_warnings():
            for told in (BallastWarning, LargeHeelWarning, MeanPositionWarning):  # an unballasted lift at sea
                warnings.simplefilter("ignore", told)
            found[rung] = simulate(scene, 60.0)
    return found


@pytest.mark.parametrize("rung", QUICK[1:])
def test_any_rung_and_the_rod_print_the_same_rows(runs: dict[str, Result], rung: str) -> None:
    told, rod = summary(runs[rung]), summary(runs["rod"])
    assert [row.name for row in told] == [row.name for row in rod]
    assert {"hook load", "hoist tension", "payload swing", "offlead", "sidelead"} <= {row.name for row in rod}
    for name in ("hook load", "hoist tension"):
        assert told[name].static_known and told[name].static == pytest.approx(MASS * G, rel=1e-12)
        assert told[name].factor == pytest.approx(rod[name].factor, rel=0.01)
    for name in ("payload swing", "offlead", "sidelead", "payload offset y"):
        assert told[name].maximum == pytest.approx(rod[name].maximum, rel=0.03)


@pytest.mark.parametrize("rung", QUICK)
def test_statics_and_charts_have_the_same_columns(rung: str) -> None:
    rod, told = (statics(lift(one), slew=[0.0, 0.5]) for one in ("rod", rung))
    assert [name for name in told.columns if not name.startswith("line ")] == list(rod.columns)
    for name in ("hook load", "hoist tension", "cylinder force main"):
        assert told[name] == pytest.approx(rod[name], rel=1e-6)
    charts = [load_chart(lift(one), radii=[14.0, 18.0], limits={"cylinder force main": 9e6})
              for one in ("rod", rung)]  # fmt: skip
    assert charts[1].allowable == pytest.approx(charts[0].allowable, rel=1e-5)


@pytest.mark.warns("BallastWarning")
@pytest.mark.parametrize("rung", QUICK)
def test_lead_and_swing_are_those_of_the_recorded_poses(runs: dict[str, Result], rung: str) -> None:
    """Offlead along the jib, sidelead across it to its left, by quaternions; the crane slews about z."""
    run, roles = runs[rung], runs[rung].scene.roles[""]
    assert roles.tip is not None and roles.slew is not None
    body, point = roles.tip
    turn = rotation_matrix(run.select("quaternion", body=body))
    lever = np.asarray(point) - run.scene.bodies[body].center_of_mass
    tip = run.select("position", body=body) + turn @ lever
    top = rotation_matrix(run.select("quaternion", body="payload")) @ np.array([0.0, 0.0, 0.5 * SIZE[2]])
    hang = run.select("position", body="payload") + top - tip
    slew = run.scene.joints[roles.slew[0]]
    out = tip - run.place_of(slew.first, slew.first_frame.point)
    along = out[:, :2] / np.linalg.norm(out[:, :2], axis=1, keepdims=True)
    ahead = np.einsum("ij,ij->i", hang[:, :2], along)
    left = hang[:, 1] * along[:, 0] - hang[:, 0] * along[:, 1]
    assert run["offlead"] == pytest.approx(np.arctan2(ahead, -hang[:, 2]), abs=1e-12)
    assert run["sidelead"] == pytest.approx(np.arctan2(left, -hang[:, 2]), abs=1e-12)
    again = simulate(run.scene, 1.0, channels=["swing", "sling_angle"])
    swing = np.arctan2(np.hypot(hang[:, 0], hang[:, 1]), -hang[:, 2])[: again.time.size]
    assert again["swing"] == pytest.approx(swing, abs=1e-6)
    assert again["sling_angle"][:, 0] == pytest.approx(0.5 * np.pi - swing, abs=1e-6)


def test_a_line_with_mass_has_the_columns_and_the_chart_of_the_others_but_for_the_wire() -> None:
    """At its upper end its own weight is on it too; in poses metres away what hangs is led along."""
    rod, told = (statics(lift(one)) for one in ("rod", "with mass"))
    assert [name for name in told.columns if not name.startswith("line ")] == list(rod.columns)
    wire = 20.0 * LENGTH
    assert told["hoist tension"] - told["hook load"] == pytest.approx(wire * G, rel=2e-3)
    assert told["hook load"] == pytest.approx(MASS * G, rel=1e-6)
    charts = [load_chart(lift(one), radii=[14.0], limits={"cylinder force main": 9e6})
              for one in ("rod", "with mass")]  # fmt: skip
    assert charts[1].allowable + wire == pytest.approx(charts[0].allowable, rel=2e-5)
    heavy = lift("elastic", mass=400e3)
    heavy.roles[""] = replace(heavy.roles[""], capacity=((10.0, 100e3), (40.0, 50e3)))
    with pytest.warns(OverloadWarning, match="of 40[0-9] t, with what holds it"):
        simulate(heavy, 0.01, dt_out=0.01, integrator="rk4", dt=1e-4)


def thrown(rung: str) -> Scene:
    """So fast from below its line of 5 m that it goes slack on its way round."""
    scene = below((0.0, 0.0, -6.0), mass=MASS, size=SIZE, velocity=(np.sqrt(4.0 * 5.0 * G), 0.0, 0.0))
    if rung == "rod":
        ends = {"first_frame": Frame(), "second_frame": Frame(), "length": 6.0}
        scene.add_joint(kind="distance", name="hoist", first="ground", second="load", **ends)
        return scene
    taut = {} if rung == "rigid" else {"EA": 1e7, "tension_at_start": 5.0 * MASS * G}
    scene.add_line(name="hoist", first="ground", second="load", rung=rung, **taut)  # type: ignore[arg-type]
    return scene


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("rung", ["rod", "rigid", "elastic", "auto"])
def test_a_rung_that_knows_no_snap_prints_a_dash_and_the_reason(rung: str) -> None:
    """Only the line that stretches tells a factor where it goes slack."""
    told = summary(simulate(thrown(rung), 3.0))
    row = told["hook load hoist"]
    assert row.static == pytest.approx(MASS * G) and row.minimum < 0.02 * MASS * G
    line = next(text for text in str(told).splitlines() if text.startswith("hook load"))
    knows = rung in ("elastic", "auto")
    assert row.blind != knows and (row.factor is not None) == knows
    assert ("knows no snap" in str(told)) != knows and (" - " in line) != knows


def rigged(*, design_factor: float = 1.0) -> Scene:
    """Block and four slings at 60 degrees on two falls."""
    scene = Scene(name="rigged")
    scene.add_crane(base="ground", design_factor=design_factor)
    scene.add_hoist(
        mass=MASS, size=SIZE, falls=2, EA=1e8, block_mass=2e3, slings=Slings(angle_deg=60, EA=8e7)
    )
    return scene


def test_margins_and_angles_of_a_rigged_load() -> None:
    """The hook carries block and load, a sling its share at rest; they stand at 60 degrees."""
    run = simulate(rigged(), 1.0, channels=["hook_load", "slack_margin", "sling_angle", "swing"])
    told = summary(run)
    assert (
        told["hook load"].static == pytest.approx((MASS + 2e3) * G) and told["hook load"].factor is not None
    )
    assert told["hoist tension"].static == pytest.approx(0.5 * (MASS + 2e3) * G, rel=1e-12)
    assert run.coords["weighed"] == ("hoist", *(f"hoist sling {i}" for i in range(1, 5)))
    assert run["slack_margin"] == pytest.approx(1.0, abs=1e-3)
    for number in range(1, 5):
        angle = run.select("sling_angle", suspension=f"hoist sling {number}")
        assert np.degrees(angle) == pytest.approx(60.0, abs=0.1)
    limited = rigged()
    limited.add_limit_state("slack")
    (state,) = simulate(limited, 1.0).utilisation
    assert state.kept


def test_utilisation_is_the_hook_load_over_the_table_with_its_design_factor() -> None:
    scene = rigged(design_factor=1.3)
    scene.roles[""] = replace(scene.roles[""], capacity=((10.0, 60e3), (40.0, 50e3)))
    run = simulate(scene, 1.0, channels=["utilisation", "hook_load"])
    radius = float(statics(scene)["tip radius"])
    allowed = np.interp(radius, [10.0, 40.0], [60e3, 50e3]) * 1.3 * G
    hook = run.select("hook_load", suspension="hoist")
    assert run["utilisation"] == pytest.approx(hook / allowed, rel=1e-3)
