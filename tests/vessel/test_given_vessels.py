"""Ships whose motion is given: the same motion as the linear ship, and nothing that acts back."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from seacrane import (
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
from seacrane.crane import Payload
from seacrane.description.curves import ramp_of
from seacrane.hydro import shipped_database, two_barges
from seacrane.warnings import AngleUnitWarning

PLACE: dict[str, Any] = {"position": (12.0, -7.0, 0.0), "heading_deg": 30.0}
WAVES: dict[str, Any] = {"hs": 2.0, "tp": 8.0, "direction_deg": 100.0, "seed": 3, "count": 60}


def afloat() -> Scene:
    scene = Scene(name="afloat")
    scene.add_vessel(shipped_database(), **PLACE)
    scene.add_sea(**WAVES)
    return scene


def given(motion: Any, **more: Any) -> Scene:
    scene = Scene(name="given")
    scene.add_vessel(motion=motion, **{**PLACE, "duration": 60.0, **more})
    return scene


def with_crane(scene: Scene, base: str) -> Scene:
    scene.add_crane(base=base, slew=0.4, payload=Payload(mass=20e3, size=(1, 1, 1)))
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint=joint, curve=0.0)
    return scene


def along_the_ship(motion: np.ndarray, heading: float) -> np.ndarray:
    """From inertial axes to those of the ship at rest."""
    c, s = np.cos(heading), np.sin(heading)
    turn = np.kron(np.eye(2), np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]))
    return motion @ turn


def linear_ship(times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The linear response of the floating ship, and its standard deviation, in axes of the ship."""
    response = response_summed(afloat(), body="vessel")
    motion = along_the_ship(response.at(times), np.radians(PLACE["heading_deg"]))
    amplitude = along_the_ship(response.amplitude, np.radians(PLACE["heading_deg"]))
    return motion, np.sqrt(0.5 * np.sum(np.abs(amplitude) ** 2, axis=0))


@pytest.mark.warns(sometimes=["AssemblyWarning"])  # where it starts at once
@pytest.mark.parametrize("ramp", [0.0, 15.0])
def test_raos_move_the_ship_as_its_linear_response(ramp: float) -> None:
    """To the splines' error, 1e-6 of the root mean square; the linear model never sees the given ship."""
    scene = given(shipped_database(), ramp=ramp)
    scene.add_sea(**WAVES)
    result = simulate(scene, 60.0, dt_out=0.37)
    expected, size = linear_ship(result.time)
    full = result.time >= ramp
    assert np.all(np.abs(result["vessel_motion"] - expected)[full] < 2e-6 * size)
    if ramp:
        grown = expected * ramp_of(result.time, ramp)[:, None]
        assert np.all(np.abs(result["vessel_motion"] - grown) < 2e-6 * size)
        assert not result["vessel_motion"][0].any()


def test_a_table_of_raos_moves_the_ship_as_its_database() -> None:
    """The table holds what the linear model gives at the database's headings: what is left is in omega."""
    alone = Scene()
    alone.add_vessel(shipped_database())
    omega = np.linspace(0.2, 2.5, 231)
    heading = shipped_database().heading
    values = motion_rao(alone, omega=omega, direction=heading[:, None] + 0.0 * omega, body="vessel")
    table = MotionRaos(omega=omega, heading=heading, values=values)
    scene = given(table)
    scene.add_sea(**WAVES)
    result = simulate(scene, 60.0, dt_out=0.37)
    expected, size = linear_ship(result.time)
    full = result.time > 20.0
    assert np.all(np.abs(result["vessel_motion"] - expected)[full] < 5e-3 * size)


@pytest.mark.warns("RaoPhaseWarning")
def test_a_database_with_raos_of_its_own_moves_the_ship_by_these() -> None:
    own = np.zeros((shipped_database().heading.size, shipped_database().omega.size, 6), dtype=complex)
    own[:, :, 2] = 0.5j
    scene = given(replace(shipped_database(), motion_rao=own))
    scene.add_sea(hs=2.0, tp=8.0, count=40)
    result = simulate(scene, 40.0, dt_out=0.5)
    sea = scene.waves.components()
    along = np.cos(sea.direction) * 12.0 + np.sin(sea.direction) * -7.0
    angle = np.outer(result.time, sea.omega) + np.array(sea.phase) - np.array(sea.wavenumber) * along
    heave = np.cos(angle + 0.5 * np.pi) @ (0.5 * np.array(sea.amplitude))
    full = result.time > 20.0
    np.testing.assert_allclose(result["vessel_motion"][full, 2], heave[full], atol=2e-6)
    assert not result["vessel_motion"][:, [0, 1, 3, 4, 5]].any()
    np.testing.assert_allclose(result["wave_elevation"], np.cos(angle) @ sea.amplitude, atol=1e-7)
    assert not result["wave_force"].any()


@pytest.mark.filterwarnings("ignore::seacrane.warnings.MassUnitWarning")
def test_a_light_load_moves_as_on_the_floating_ship() -> None:
    """What is left is the load's own effect on the floating ship: in proportion to its mass."""

    def run(mass: float, history: MotionHistory | None = None) -> Result:
        scene = Scene()
        if history is None:
            scene.add_vessel(shipped_database(), memory="none")
            scene.add_sea(hs=1.0, tp=8.0, direction_deg=100.0, count=40)
        else:
            scene.add_vessel(motion=history, ramp=0.0)
        if mass:
            scene.add_body(name="load", mass=mass, inertia=np.full(3, mass), position=(5.0, 15.0, 8.0))
            rod = {"point": (5, 15, 20), "second_point": (5, 15, 8.0)}
            scene.add_joint(kind="distance", name="rod", first="vessel", second="load", **rod)
        return simulate(scene, 30.0, dt_out=0.1, rtol=1e-10)

    alone = run(0.0)
    replayed = run(1e3, MotionHistory(time=alone.time, motion=alone["vessel_motion"]))
    np.testing.assert_allclose(replayed["vessel_motion"], alone["vessel_motion"], atol=1e-9)
    there = replayed.select("position", body="load")
    apart = [np.abs(run(m).select("position", body="load") - there).max() / m for m in (1e2, 1e4)]
    assert apart[0] * 1e2 < 2e-3
    assert apart[1] == pytest.approx(apart[0], rel=1e-2)


def test_a_ship_at_rest_is_the_ground(formulation: str) -> None:
    still, runs = Scene(), []
    still.add_vessel(motion="rest")
    for scene in (with_crane(still, "vessel"), with_crane(Scene(), "ground")):
        scene.add_force("payload", name="push", point=(0, 0, 0), force=(0.0, 3e4, 0.0))
        runs.append(simulate(scene, 10.0, dt_out=0.5, rtol=1e-8, formulation=formulation))
    for body in ("payload", "knuckle_jib"):
        np.testing.assert_allclose(*(run.select("position", body=body) for run in runs), atol=1e-6)
    np.testing.assert_allclose(runs[0]["link_tension"], runs[1]["link_tension"], rtol=1e-6)
    assert np.ptp(runs[0].select("position", body="payload"), axis=0).max() > 1.0


def test_driver_forces_carry_what_is_on_board() -> None:
    """Weight of all on board, and its moment about the reference point."""
    still = Scene()
    still.add_vessel(motion="rest", position=(3.0, 4.0, 0.0))
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


LONG = {"omega": np.array([0.3, 0.5, 0.8, 1.2]), "heading": np.radians([0.0, 90.0, 180.0])}
HEAVE = np.outer(np.sin(np.linspace(0.0, 20.0, 50)), np.eye(6)[2])
humps = np.outer([0, 1, 2, 3, 2, 1, 0], np.eye(6)[2])  # the last a long time after the others


@pytest.mark.warns(sometimes=["RaoPhaseWarning"])
def test_what_would_be_a_wrong_motion_is_told() -> None:
    def raos(**changes: Any) -> MotionRaos:
        return MotionRaos(**{**LONG, "values": np.ones((3, 4, 1)) * np.eye(6)[2], **changes})

    group = two_barges(lid_damping=None)
    for call, message in (
        (lambda: raos(values=np.full((3, 4, 6), 2.0)), "pitch"),  # degrees per metre
        (lambda: raos(heading=np.degrees(LONG["heading"])), "heading.*rad"),
        (lambda: MotionHistory(time=np.linspace(5, 40, 50), motion=HEAVE), "starts at 5 s"),
        (lambda: given(MotionHistory(time=[0, 1, 2, 3, 4, 5, 50], motion=humps)), "heave would reach"),
        (lambda: simulate(given(MotionHistory(time=np.linspace(0, 40, 50), motion=HEAVE)), 41.0), "at 40 s"),
        (lambda: given(shipped_database()).add_sea(hs=1.0, tp=8.0, count=20, drift=True), "drift"),
        (lambda: response_summed(beside_another(), body="vessel"), "'barge': its motion"),
        (lambda: given("rest", memory="none"), r"add_vessel\(motion=\): there is no 'memory'"),
        (lambda: Scene().add_vessel(shipped_database(), ramp=1.0), "of a HydroDatabase: there is no 'ramp'"),
        (lambda: Scene().add_vessel(group, name="a"), "of a HydroGroup: there is no 'name'"),
        (lambda: Scene().add_vessel(shipped_database(), motion="rest"), "a motion and a hull"),
        (lambda: Scene().add_vessel(raos()), "vessel: is <MotionRaos.*motion="),
    ):
        with pytest.raises(SceneError, match=message):
            call()
    with pytest.warns(AngleUnitWarning, match="roll"):
        MotionHistory(time=np.linspace(0, 40, 50), motion=HEAVE + 5.0 * np.roll(HEAVE, 1, axis=1))


def beside_another() -> Scene:
    """A floating and a given ship."""
    scene = afloat()
    scene.add_vessel(motion=shipped_database(), name="barge", position=(0, 60, 0), duration=20.0)
    return scene


def test_a_floating_ship_does_not_know_of_a_given_one() -> None:
    both = beside_another()
    both.add_sea(vessel="barge")
    one, two = simulate(afloat(), 10.0, rtol=1e-9), simulate(both, 10.0, rtol=1e-9)
    np.testing.assert_allclose(two.select("vessel_motion", vessel="vessel"), one["vessel_motion"], atol=1e-6)
