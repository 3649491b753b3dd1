"""Ships whose motion is given: the same motion as the linear ship, and nothing that acts back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seacrane
from seacrane import (
    Curve,
    HydroDatabase,
    Lift,
    MotionHistory,
    MotionRaos,
    Result,
    Scene,
    SceneError,
    balance,
    motion_rao,
    simulate,
)
from seacrane.analysis import response_summed
from seacrane.analysis.ballast import add_ballast
from seacrane.crane import Payload
from seacrane.description.databases import without_databases
from seacrane.description.sum_of_cosines import curves_of_sum, ramp_of, summed
from seacrane.hydro import shipped_database
from seacrane.pictures.drawn_bodies import looks
from seacrane.pictures.pose import outlined_skeleton
from seacrane.warnings import AngleUnitWarning, NoWaveLoadsWarning

JOINTS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
PLACE: dict[str, Any] = {"position": (12.0, -7.0, 0.0), "heading_deg": 30.0}
WAVES: dict[str, Any] = {"hs": 2.0, "tp": 8.0, "direction_deg": 100.0, "seed": 3, "count": 60}
HEADINGS = np.radians([0.0, 45.0, 90.0, 135.0, 180.0])
LONG_WAVES = np.array([0.3, 0.5, 0.8, 1.2])


@pytest.fixture(scope="module")
def database() -> HydroDatabase:
    return shipped_database()


def afloat(database: HydroDatabase) -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(database, **PLACE)
    scene.add_sea(**WAVES)
    return scene


def given(motion: Any, **more: Any) -> Scene:
    scene = Scene(name="given")
    scene.add_given_vessel(motion, **{**PLACE, "duration": 60.0, **more})
    return scene


def with_crane(scene: Scene, base: str, **place: Any) -> Scene:
    scene.add_crane(base=base, slew=0.4, payload=Payload(mass=20e3, size=(1, 1, 1)), **place)
    for name, joint in JOINTS.items():
        scene.add_driver(name=name, joint=joint, curve=Curve.constant(value=0.0))
    return scene


def along_the_ship(motion: np.ndarray, heading: float) -> np.ndarray:
    """From inertial axes to those of the ship at rest."""
    c, s = np.cos(heading), np.sin(heading)
    turn = np.kron(np.eye(2), np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))
    return motion @ turn


def linear_ship(database: HydroDatabase, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The linear response of the floating ship, and its standard deviation, in axes of the ship."""
    response = response_summed(afloat(database), body="vessel")
    motion = along_the_ship(response.at(times), np.radians(PLACE["heading_deg"]))
    amplitude = along_the_ship(response.amplitude, np.radians(PLACE["heading_deg"]))
    return motion, np.sqrt(0.5 * np.sum(np.abs(amplitude) ** 2, axis=0))


def test_raos_move_the_ship_as_its_linear_response(database: HydroDatabase) -> None:
    """To the splines' error, 1e-6 of the root mean square; the linear model never sees the given ship."""
    scene = given(database, ramp=15.0)
    scene.add_sea(**WAVES)
    result = simulate(scene, 60.0, dt_out=0.37)
    expected, size = linear_ship(database, result.time)
    full = result.time > 15.0
    assert np.all(np.abs(result["vessel_motion"] - expected)[full] < 2e-6 * size)
    grown = expected * ramp_of(result.time, 15.0)[:, None]
    assert np.all(np.abs(result["vessel_motion"] - grown) < 2e-6 * size)
    assert not result["vessel_motion"][0].any()


def test_without_a_ramp_the_motion_is_full_from_the_start(database: HydroDatabase) -> None:
    scene = given(database, ramp=0.0)
    scene.add_sea(**WAVES)
    with pytest.warns(seacrane.warnings.AssemblyWarning):
        result = simulate(scene, 20.0, dt_out=0.5)
    expected, size = linear_ship(database, result.time)
    assert np.all(np.abs(result["vessel_motion"] - expected) < 2e-6 * size)


def test_a_table_of_raos_moves_the_ship_as_its_database(database: HydroDatabase) -> None:
    """The table holds what the linear model gives at the database's headings: what is left is in omega."""
    alone = Scene()
    alone.add_vessel(database)
    omega = np.linspace(0.2, 2.5, 231)
    heading = database.heading
    values = motion_rao(alone, omega=omega, direction=heading[:, None] + 0.0 * omega, body="vessel")
    table = MotionRaos(omega=omega, heading=heading, values=values)
    scene = given(table)
    scene.add_sea(**WAVES)
    result = simulate(scene, 60.0, dt_out=0.37)
    expected, size = linear_ship(database, result.time)
    full = result.time > 20.0
    assert np.all(np.abs(result["vessel_motion"] - expected)[full] < 5e-3 * size)


@pytest.mark.warns("RaoPhaseWarning")
def test_a_database_with_raos_of_its_own_moves_the_ship_by_these(database: HydroDatabase) -> None:
    own = np.zeros((database.heading.size, database.omega.size, 6), dtype=complex)
    own[:, :, 2] = 0.5j
    other = replace(database, motion_rao=own)
    scene = given(other)
    scene.add_sea(hs=2.0, tp=8.0, count=40)
    result = simulate(scene, 40.0, dt_out=0.5)
    sea = scene.waves.components()
    k = np.array(sea.wavenumber)
    along = np.cos(sea.direction) * 12.0 + np.sin(sea.direction) * -7.0
    angle = np.outer(result.time, sea.omega) + np.array(sea.phase) - k * along
    heave = np.cos(angle + 0.5 * np.pi) @ (0.5 * np.array(sea.amplitude))
    full = result.time > 20.0
    np.testing.assert_allclose(result["vessel_motion"][full, 2], heave[full], atol=2e-6)
    assert not result["vessel_motion"][:, [0, 1, 3, 4, 5]].any()


def test_the_elevation_is_that_of_the_floating_ship(database: HydroDatabase) -> None:
    scene = given(database)
    scene.add_sea(**WAVES)
    both = [simulate(one, 10.0, dt_out=0.5) for one in (scene, afloat(database))]
    np.testing.assert_allclose(both[0]["wave_elevation"], both[1]["wave_elevation"], atol=1e-7)
    assert not both[0]["wave_force"].any()


def test_the_splines_keep_their_bound_and_have_no_kink() -> None:
    random = np.random.default_rng(5)
    omega = np.sort(random.uniform(0.3, 2.5, 80))
    amplitude = random.normal(size=(80, 3)) + 1j * random.normal(size=(80, 3))
    amplitude[:, 2] = 0.0
    curves = curves_of_sum(omega, amplitude, ramp=10.0, duration=100.0)
    times = np.linspace(0.0, 99.999, 7001)
    exact = summed(omega, amplitude, times) * ramp_of(times, 10.0)[:, None]
    for i, curve in enumerate(curves[:2]):
        size = np.sqrt(0.5 * np.sum(np.abs(amplitude[:, i]) ** 2))
        assert np.abs(curve.evaluate(times)[:, 0] - exact[:, i]).max() < 1.2e-6 * size
        assert set(curve.breakpoints) <= {0.0, 100.0}
    accelerations = summed(omega, -amplitude * omega[:, None] ** 2, times)[times > 10.0, 0]
    found = curves[0].evaluate(times)[times > 10.0, 2]
    assert np.abs(found - accelerations).max() < 1e-3 * accelerations.std()
    assert not curves[2].evaluate(times).any()


def hanging(scene: Scene, mass: float) -> Scene:
    """A load on a rod below a point of the ship."""
    scene.add_body(name="load", mass=mass, inertia=np.full(3, mass), position=(5.0, 15.0, 8.0))
    scene.add_joint(
        kind="distance", name="rod", first="vessel", second="load", point=(5, 15, 20),
        second_point=(5, 15, 8.0),
    )  # fmt: skip
    return scene


def of_floating(database: HydroDatabase, mass: float | None) -> Result:
    scene = Scene()
    scene.add_vessel(database, memory="none")
    scene.add_sea(hs=1.0, tp=8.0, direction_deg=100.0, count=40)
    if mass is not None:
        hanging(scene, mass)
    return simulate(scene, 30.0, dt_out=0.1, rtol=1e-10)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.MassUnitWarning")
def test_a_light_load_moves_as_on_the_floating_ship(database: HydroDatabase) -> None:
    """What is left is the load's own effect on the floating ship: in proportion to its mass."""
    alone = of_floating(database, None)
    history = MotionHistory(time=alone.time, motion=alone["vessel_motion"])
    scene = Scene()
    scene.add_given_vessel(history, ramp=0.0)
    replayed = simulate(hanging(scene, 1e3), 30.0, dt_out=0.1, rtol=1e-10)
    np.testing.assert_allclose(replayed["vessel_motion"], alone["vessel_motion"], atol=1e-9)
    apart = []
    for mass in (1e2, 1e3, 1e4):
        floating = of_floating(database, mass)
        away = floating.select("position", body="load") - replayed.select("position", body="load")
        apart.append(np.abs(away).max() / mass)
    assert apart[0] * 1e2 < 2e-3
    assert apart[1] == pytest.approx(apart[0], rel=1e-3)
    assert apart[2] == pytest.approx(apart[0], rel=1e-2)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.MassUnitWarning")
def test_a_light_load_moves_as_in_the_linear_response_of_the_floating_ship(database: HydroDatabase) -> None:
    """On a rod too short to swing in these waves; what is left is of second order in the wave height."""
    apart = []
    for hs in (0.02, 0.1):
        scenes = []
        for add in ("add_vessel", "add_given_vessel"):
            scene = Scene()
            getattr(scene, add)(database)
            scene.add_body(name="load", mass=100.0, inertia=np.full(3, 100.0), position=(5, 3, 8))
            scene.add_joint(
                kind="distance", name="rod", first="vessel", second="load", point=(5, 3, 9),
                second_point=(5, 3, 8),
            )  # fmt: skip
            scene.add_sea(hs=hs, tp=10.0, direction_deg=100.0, count=40)
            scenes.append(scene)
        response = response_summed(scenes[0], body="load")
        result = simulate(scenes[1], 60.0, dt_out=0.5, rtol=1e-10)
        moved = result.select("position", body="load") - (5.0, 3.0, 8.0)
        full = result.time > 20.0
        error = np.abs(moved - response.at(result.time)[:, :3])[full].max(axis=0)
        apart.append((error / response.std[:3]).max())
    assert apart[1] < 2e-2
    assert apart[0] < 0.3 * apart[1]


def test_the_ledger_closes(database: HydroDatabase) -> None:
    scene = given(database)
    scene.add_sea(**WAVES)
    result = simulate(with_crane(scene, "vessel"), 60.0, rtol=1e-8)
    assert np.abs(result["energy_balance"]).max() < 1e-8 * result["absolute_work"][-1]
    assert result["absolute_work"][-1] > 1e6


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_a_ship_at_rest_is_the_ground(formulation: str) -> None:
    still = Scene()
    still.add_given_vessel("rest")
    scenes = [with_crane(still, "vessel"), with_crane(Scene(), "ground")]
    runs = []
    for scene in scenes:
        scene.add_point_force(name="push", body="payload", point=(0, 0, 0), force=(0.0, 3e4, 0.0))
        runs.append(simulate(scene, 10.0, dt_out=0.5, rtol=1e-8, formulation=formulation))
    for body in ("payload", "knuckle_jib"):
        np.testing.assert_allclose(*(run.select("position", body=body) for run in runs), atol=1e-6)
    np.testing.assert_allclose(runs[0]["link_tension"], runs[1]["link_tension"], rtol=1e-6)
    assert np.ptp(runs[0].select("position", body="payload"), axis=0).max() > 1.0


def test_driver_forces_carry_what_is_on_board() -> None:
    """Weight of all on board, and its moment about the reference point."""
    still = Scene()
    still.add_given_vessel("rest", position=(3.0, 4.0, 0.0))
    scene = with_crane(still, "vessel")
    result = simulate(scene, 0.1, dt_out=0.1)
    weight = scene.gravity * sum(b.mass for n, b in scene.bodies.items() if n != "vessel")
    assert result.select("driver_force", driver="vessel.motion.z")[0] == pytest.approx(weight, rel=1e-9)
    held = balance(scene)
    assert held.weight == pytest.approx(weight, rel=1e-9)
    x, y = held.weight_center[:2] - (3.0, 4.0)
    roll, pitch = (result.select("driver_force", driver=f"vessel.motion.{m}")[0] for m in ("roll", "pitch"))
    assert roll == pytest.approx(weight * y, rel=1e-4)
    assert pitch == pytest.approx(-weight * x, rel=1e-4)
    np.testing.assert_allclose(held.vessel_wrench[:3], [0.0, 0.0, weight], atol=1e-3)


def test_a_run_continues_from_its_state(database: HydroDatabase) -> None:
    scene = given(database)
    scene.add_sea(**WAVES)
    hanging(scene, 1e4)
    whole = simulate(scene, 10.0, dt_out=0.5, integrator="rk4", dt=0.0625)
    half = simulate(scene, 5.0, dt_out=0.5, integrator="rk4", dt=0.0625)
    rest = simulate(scene, 10.0, dt_out=0.5, integrator="rk4", dt=0.0625, start=half.state)
    np.testing.assert_array_equal(rest["position"][-1], whole["position"][-1])


def test_scene_files_hold_given_ships(database: HydroDatabase, tmp_path: Path) -> None:
    scene = given(database)
    scene.add_sea(**WAVES)
    scene.add_given_vessel("rest", name="quay", position=(0, 60, 0), size=(80, 30, 4))
    scene.save(tmp_path / "scene.json")
    read = Scene.load(tmp_path / "scene.json")
    assert read == scene
    assert read.provenance == scene.provenance
    with pytest.raises(SceneError, match="its given motion ends at 60 s, and the run at 61 s"):
        simulate(read, 61.0)


LIFT = """
format = "seacrane lift"
version = 2
[[given_vessel]]
database = "hull_115"
duration_s = 30
ramp_s = 5
[[given_vessel]]
name = "barge"
position_m = [0, 60, 0]
heading_deg = 90
size_m = [90, 30, 5]
[given_vessel.raos]
omega_rad_per_s = [0.3, 0.6]
[[given_vessel.raos.headings]]
heading_deg = 0
amplitude = [[1, 0, 1, 0, 0.009, 0], [0.8, 0, 0.8, 0, 0.02, 0]]
phase_deg = [[-90, 0, 0, 0, -90, 0], [-90, 0, 0, 0, -90, 0]]
[[given_vessel]]
name = "quay"
motion = "rest"
position_m = [0, 120, 0]
[[given_vessel]]
name = "measured"
position_m = [0, 180, 0]
[given_vessel.history]
time_s = [0, 1, 2, 3, 4, 5]
motion = [[0, 0, 0, 0, 0, 0], [0, 0, 0.1, 0, 0, 0], [0, 0, 0.2, 0, 0, 0],
          [0, 0, 0.3, 0, 0, 0], [0, 0, 0.2, 0, 0, 0], [0, 0, 0.1, 0, 0, 0]]
[[sea]]
hs_m = 1
tp_s = 12
direction_deg = 90
count = 40
[[sea]]
vessel = "barge"
[[sea]]
vessel = "quay"
[run]
t_end_s = 5
"""


@pytest.mark.warns("RaoPhaseWarning")
@pytest.mark.filterwarnings("ignore::seacrane.warnings.OutsideRaosWarning")
def test_lift_files_hold_given_ships(database: HydroDatabase, tmp_path: Path) -> None:
    (tmp_path / "lift.toml").write_text(LIFT)
    lift = Lift.load(tmp_path / "lift.toml")
    barge = MotionRaos(
        omega=[0.3, 0.6], heading=[0.0],
        values=[[[-1j, 0, 1, 0, -0.009j, 0], [-0.8j, 0, 0.8, 0, -0.02j, 0]]],
    )  # fmt: skip
    motion = np.zeros((6, 6))
    motion[:, 2] = 0.0, 0.1, 0.2, 0.3, 0.2, 0.1
    scene = Scene()
    scene.add_given_vessel(database, duration=30.0, ramp=5.0)
    scene.add_given_vessel(barge, name="barge", position=(0, 60, 0), heading_deg=90.0, size=(90, 30, 5))
    scene.add_given_vessel("rest", name="quay", position=(0, 120, 0))
    scene.add_given_vessel(MotionHistory(time=range(6), motion=motion), name="measured", position=(0, 180, 0))
    scene.add_sea(hs=1.0, tp=12.0, direction_deg=90.0, count=40)
    scene.add_sea(vessel="barge")
    scene.add_sea(vessel="quay")
    one, other = simulate(lift.scene(), 5.0), simulate(scene, 5.0)
    np.testing.assert_allclose(one["vessel_motion"], other["vessel_motion"], atol=1e-12)
    assert lift.scene().provenance == scene.provenance
    assert list(one.coords["vessel"]) == ["vessel", "barge", "quay", "measured"]


MISTAKES_IN_LIFTS = {
    "two motions": ('motion = "rest"\nposition', 'motion = "rest"\ndatabase = "hull_115"\nposition'),
    "no motion": ('motion = "rest"\nposition', "position"),
    "rows missing": ("omega_rad_per_s = [0.3, 0.6]", "omega_rad_per_s = [0.3, 0.6, 0.9]"),
    "phases missing": ("phase_deg = [[-90, 0, 0, 0, -90, 0], ", "phase_deg = ["),
}


@pytest.mark.warns(sometimes=["RaoPhaseWarning"])
@pytest.mark.parametrize("case", MISTAKES_IN_LIFTS)
def test_mistakes_in_lift_files_are_told(case: str, tmp_path: Path) -> None:
    text = LIFT.replace(*MISTAKES_IN_LIFTS[case])
    assert text != LIFT
    (tmp_path / "lift.toml").write_text(text)
    with pytest.raises(seacrane.FileFormatError, match=r"lift\.toml line \d+: .*(given_vessel|raos)"):
        Lift.load(tmp_path / "lift.toml").scene()


def test_pictures_show_the_ship_that_the_light_body_stands_for(database: HydroDatabase) -> None:
    scene = given(database)
    scene.add_given_vessel("rest", name="barge", position=(0, 60, 0), size=(90, 30, 4))
    scene.add_given_vessel("rest", name="unknown", position=(0, 90, 0))
    found = looks(scene)
    assert "hull_115" in found["vessel"].note
    assert np.ptp(found["vessel"].points[:, 0]) == pytest.approx(115.0, abs=1.0)
    np.testing.assert_allclose(np.ptp(found["barge"].points[:, :2], axis=0), [90.0, 30.0], rtol=1e-6)
    assert "nobody gave" in found["unknown"].note
    result = simulate(scene, 1.0)
    assert "hull_115" in seacrane.view(result).html
    drawn = outlined_skeleton(result)
    assert np.ptp(np.concatenate(drawn["vessel"])[:, 0]) == pytest.approx(115.0)
    assert np.ptp(np.concatenate(drawn["barge"])[:, 1]) == pytest.approx(30.0)


def raos(**changes: Any) -> MotionRaos:
    values = np.zeros((5, 4, 6), dtype=complex)
    values[:, :, 2] = 1.0
    values[:, :, 4] = LONG_WAVES**2 / 9.81 * np.abs(np.cos(HEADINGS))[:, None]
    table: dict[str, Any] = {"omega": LONG_WAVES, "heading": HEADINGS, "values": values}
    return MotionRaos(**{**table, **changes})


def degrees() -> MotionRaos:
    values = raos().values.copy()
    values[:, :, 3:] *= 180.0 / np.pi
    return raos(values=values)


def history(**changes: Any) -> MotionHistory:
    motion = np.zeros((50, 6))
    motion[:, 2] = np.sin(np.linspace(0.0, 20.0, 50))
    return MotionHistory(**{"time": np.linspace(0.0, 40.0, 50), "motion": motion, **changes})


def far_apart() -> Any:
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 50.0])
    motion = np.zeros((7, 6))
    motion[:, 2] = 0.0, 0.1, 0.2, 0.3, 0.2, 0.1, 0.0
    return given(MotionHistory(time=time, motion=motion))


def in_sea(scene: Scene, **sea: Any) -> None:
    scene.add_sea(**{"hs": 1.0, "tp": 8.0, "count": 20, **sea})


BAD: dict[str, tuple[Callable[[], Any], str]] = {
    "motion": (lambda: given("still"), "motion is 'still'; give a HydroDatabase"),
    "ramp": (lambda: given("rest", ramp=-1.0), "ramp is -1.0 s; give"),
    "duration": (lambda: given("rest", duration=0.0), "duration is 0.0 s; give"),
    "size": (lambda: given("rest", size=(100, 20, -5)), "size is"),
    "place": (lambda: given("rest", position=(0, 0)), "position has shape"),
    "degrees per metre": (degrees, "pitch is .* multiply roll, pitch and yaw by pi / 180"),
    "headings in degrees": (lambda: raos(heading=np.degrees(HEADINGS)), "heading reaches 180 rad"),
    "headings twice": (lambda: raos(heading=[0, 0, 1, 2, 3]), "heading must increase"),
    "frequencies": (lambda: raos(omega=LONG_WAVES[::-1]), "omega must be positive, finite and increasing"),
    "shape": (lambda: raos(values=np.zeros((4, 5, 6))), r"values has shape \(4, 5, 6\); give \(5, 4, 6\)"),
    "texts": (lambda: raos(values=[["a"]]), "values is"),
    "not finite": (lambda: raos(values=np.full((5, 4, 6), np.nan)), "not finite"),
    "depth": (lambda: raos(depth=-60.0), "depth is -60.0 m"),
    "gap": (
        lambda: raos(heading=HEADINGS[:1], values=np.zeros((1, 4, 6))).at([0.5], [1.0]),
        "have no heading 57.2958 deg",
    ),
    "times": (lambda: history(time=np.linspace(40.0, 0.0, 50)), "time is .* times must increase"),
    "few": (lambda: MotionHistory(time=[0, 1], motion=np.zeros((2, 6))), "has 2 samples; give at least 6"),
    "rows": (lambda: history(time=np.linspace(0, 40, 49)), "motion has 50 rows and time 49"),
    "columns": (lambda: history(motion=np.zeros((50, 3))), r"motion has shape \(50, 3\); give \(n, 6\)"),
    "late": (lambda: history(time=np.linspace(5, 40, 50)), "starts at 5 s, and runs start at 0; subtract 5"),
    "hole": (lambda: history(motion=np.full((50, 6), np.nan)), "not finite"),
    "far apart": (far_apart, "heave would reach"),
    "short": (lambda: simulate(given(history()), 41.0), "ends at 40 s, and the run at 41 s; give a longer"),
    "too long": (
        lambda: in_sea(given(shipped_database(), duration=1e9)),
        "motion of 1e\\+09 s: takes .* give a shorter duration",
    ),
    "drift": (lambda: in_sea(given(shipped_database()), drift=True), "leave out drift"),
    "no RAOs": (
        lambda: in_sea(without_databases(given(shipped_database()))),
        "'vessel' has no RAOs; give it those",
    ),
    "linear": (
        lambda: response_summed(afloat_and_given(), body="vessel"),
        "vessel 'barge': its motion is given",
    ),
    "ballast": (lambda: add_ballast(given("rest")), "needs no ballast"),
}


def afloat_and_given() -> Scene:
    scene = afloat(shipped_database())
    scene.add_given_vessel("rest", name="barge", position=(0, 60, 0))
    return scene


@pytest.mark.warns(sometimes=["RaoPhaseWarning"])
@pytest.mark.parametrize("case", BAD)
def test_bad_input_is_told_by_name(case: str) -> None:
    call, message = BAD[case]
    with pytest.raises(SceneError, match=message):
        call()


def test_a_history_in_degrees_is_told() -> None:
    motion = history().motion.copy()
    motion[:, 3] = 5.0 * motion[:, 2]
    with pytest.warns(AngleUnitWarning, match="roll reaches 4.99"):
        history(motion=motion)


@pytest.mark.warns("RaoPhaseWarning")
def test_a_sea_outside_the_table_is_told(database: HydroDatabase) -> None:
    scene = given(raos())
    with pytest.warns(seacrane.warnings.OutsideRaosWarning, match="of the energy of the waves is outside"):
        scene.add_sea(hs=1.0, tp=4.0, count=20)


def test_a_ship_of_raos_that_was_not_put_into_the_sea_is_told(database: HydroDatabase) -> None:
    scene = afloat(database)
    scene.add_given_vessel(database, name="barge", position=(0, 60, 0))
    with pytest.warns(NoWaveLoadsWarning, match="'barge': rests in the sea"):
        simulate(scene, 2.0)


def test_a_floating_and_a_given_ship_in_one_sea(database: HydroDatabase) -> None:
    """The floating one does not know of the other."""
    both = afloat(database)
    both.add_given_vessel(database, name="barge", position=(0, 60, 0), duration=20.0)
    both.add_sea(vessel="barge")
    one, two = simulate(afloat(database), 10.0, rtol=1e-9), simulate(both, 10.0, rtol=1e-9)
    np.testing.assert_allclose(two.select("vessel_motion", vessel="vessel"), one["vessel_motion"], atol=1e-6)
    assert ("vessels of given motion", ["barge (raos)"]) in both.report()["elements"]
