"""Water on parts of a body in waves and current: Froude and Krylov, moving parts, ledger, Jacobian, lanes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import wet_scenes as wet
from element_runs import both_forms, goes_on
from marks import needs_lanes
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from wet_scenes import EXACT, FORMS, RHO, G

from seacrane import Scene, _core, simulate
from seacrane.description.forces import add_load
from seacrane.scene import Waves
from seacrane.sea import Current
from seacrane.water import CylinderPart, SpherePart

Array = NDArray[np.float64]


def regular(scene: Scene, *, period: float, amplitude: float = 1.0) -> float:
    """One wave without stretching in deep water; its wavenumber."""
    scene.waves = Waves(
        omega=[2.0 * np.pi / period], amplitude=[amplitude], phase=[0.0], direction=[0.0], hulls={},
        stretching="none",
    )  # fmt: skip
    return float((2.0 * np.pi / period) ** 2 / G)


def amplitude(result: Any, axis: str) -> float:
    """Of the first harmonic of the forces of all parts over one period."""
    force = np.asarray(result.select("load_force", axis=axis)).reshape(len(result.time), -1).sum(axis=1)[:-1]
    turn = np.exp(2j * np.pi * np.arange(len(force)) / len(force))
    return float(2.0 * abs(np.mean(force * turn)))


@pytest.mark.warns("UnitWarning")  # far from any real one, so that its formula shows
@pytest.mark.parametrize("strips", [1, 4])
def test_froude_and_krylov_on_a_box_are_those_of_the_pressure_on_its_sides(strips: int) -> None:
    """12 x 6 x 4 m, 2 m under water, in a wave of 8 s and 1 m; strips change nothing."""
    scene = Scene(name="box", gravity=G)
    k = regular(scene, period=8.0)
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, -4.0))
    scene.add_joint(kind="weld", name="holds", first="ground", second="load", point=(0.0, 0.0, -4.0))
    for n in range(strips):
        add_load(scene, _core.ImmersedPart(
            name=f"strip {n}", body="load", shape="box", size=(12.0 / strips, 6.0, 4.0), density=RHO,
            point=(12.0 * ((n + 0.5) / strips - 0.5), 0.0, 0.0), depths=[0.0, 1.0],
            added_masses=np.zeros((2, 3)),
        ))  # fmt: skip
    result = simulate(scene, t_end=8.0, dt_out=0.25, channels=["load_force"], integrator="rk4", dt=0.25)
    expected = RHO * G * 6.0 * (2.0 * np.sin(6.0 * k) / k) * (np.exp(-2.0 * k) - np.exp(-6.0 * k))
    assert expected == pytest.approx(138615.297, abs=1e-3)
    assert amplitude(result, "x") == pytest.approx(expected, rel=1e-6)  # edges are round by a thousandth
    assert amplitude(result, "z") == pytest.approx(expected, rel=1e-6)


def test_a_small_neutral_sphere_moves_as_the_water() -> None:
    scene = Scene(name="particle", gravity=G)
    k, omega = regular(scene, period=6.0), 2.0 * np.pi / 6.0
    mass, flow = RHO * np.pi / 6.0 * 0.01**3, omega * np.exp(-5.0 * k)
    scene.add_body(
        name="load", mass=mass, inertia=mass * 1e-5 * np.ones(3), position=(0.0, 0.0, -5.0),
        velocity=(flow, 0.0, 0.0),
    )  # fmt: skip
    scene.add_immersed("load", parts=[SpherePart(diameter=0.01, drag=0.0)], density=RHO)

    def rate(t: float, y: Array) -> Array:
        size, angle = omega**2 * np.exp(k * y[1]), omega * t - k * y[0]
        return np.array([y[2], y[3], -size * np.sin(angle), -size * np.cos(angle)])

    result = simulate(scene, t_end=12.0, dt_out=1.0, channels=["position"], **EXACT)
    alone = solve_ivp(rate, (0.0, 12.0), [0.0, -5.0, flow, 0.0], t_eval=result.time, rtol=1e-12, atol=1e-12)
    found = np.asarray(result.select("position", body="load"))[:, [0, 2]]
    assert found == pytest.approx(alone.y[:2].T, abs=1e-6)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@pytest.mark.parametrize("formulation", FORMS)
def test_a_body_in_a_current_moves_as_one_that_is_towed_through_still_water(formulation: str) -> None:
    """Relativity of Galileo: added mass, its moment, slam and drag see the speed over the water alone."""
    u, runs = np.array([1.3, -0.6, 0.0]), []
    for towed in (True, False):
        scene = Scene(name="towed", gravity=G)
        scene.add_body(
            name="load", mass=2500.0, inertia=(1500.0, 2500.0, 3500.0), position=(0.0, 0.0, 1.0),
            velocity=np.array([0.5, 0.2, -2.0]) - (u if towed else 0.0), angular_velocity=(0.3, -0.4, 0.2),
        )  # fmt: skip
        scene.add_immersed("load", parts=list(wet.random_parts(np.random.default_rng(1))), density=RHO)
        if not towed:
            course = float(np.rad2deg(np.arctan2(u[1], u[0])))
            current = Current(speed=float(np.hypot(*u[:2])), direction_deg=course)
            scene.add_sea(vessel=None, hs=0.0, current=current)
        channels = ["position", "energy_balance", "absolute_work"]
        runs.append(simulate(scene, 3.0, dt_out=0.25, channels=channels, formulation=formulation, **EXACT))
    still, flowing = runs
    drift = np.asarray(still.time)[:, None, None] * u
    assert np.asarray(flowing["position"]) == pytest.approx(np.asarray(still["position"]) + drift, abs=1e-7)
    assert np.max(np.abs(flowing["energy_balance"])) < 1e-7 * np.max(flowing["absolute_work"])


def hanging(seed: int, hs: float = 1.5) -> Scene:
    """A load with parts of all kinds that swings on two links through a sea with a current."""
    scene = wet.hung_on_links()
    scene.add_immersed("load", parts=list(wet.random_parts(np.random.default_rng(7))), density=RHO)
    current = Current(speed=0.7, direction_deg=100.0)
    scene.add_sea(vessel=None, hs=hs, tp=6.0, seed=seed, direction_deg=30.0, current=current)
    return scene


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_agree_in_waves_and_the_ledger_closes(seed: int) -> None:
    """And the Jacobian is exact: that of the recursive form is in cpp/tests/test_jacobian.cpp."""
    result = both_forms(hanging(seed), 4.0, wet.ALIKE, **EXACT)
    assert np.all(np.diff(result["load_state"], axis=0) > -1e-6), "slam never gives back"
    wet.has_the_jacobian_of_differences(hanging(seed), 1.7, 5e-6)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@pytest.mark.parametrize("formulation", FORMS)
def test_a_run_in_waves_continues_bit_for_bit(formulation: str) -> None:
    goes_on(lambda: hanging(1), 2.0, 0.97, integrator="dopri5", dt_out=0.1, formulation=formulation)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@needs_lanes
def test_lanes_see_parts_each_in_its_own_sea_with_its_own_mass() -> None:
    scenes = [hanging(seed) for seed in range(4)]
    for lane, scene in enumerate(scenes):
        scene.replace("load", mass=3000.0 + 500.0 * lane)
    alone = wet.lanes_are_as_alone(scenes, 2.3)
    assert np.ptp(alone, axis=1).max() > 1e-3, "the seas differ"


def test_a_part_touches_the_wave_where_it_is() -> None:
    scene = Scene(name="touch", gravity=G)
    k = regular(scene, period=7.0, amplitude=0.8)
    scene.add_body(
        name="load", mass=9e3, inertia=(5e3, 5e3, 5e3), position=(11.0, 0.0, 3.0), velocity=(2.0, 0.0, -1.0)
    )
    upright = CylinderPart(length=2.0, diameter=1.0, axes=np.roll(np.eye(3), 1, axis=1))
    (part, *_) = scene.add_immersed("load", parts=[upright])
    result = simulate(scene, t_end=1.5, integrator="dopri5", rtol=1e-9)
    touch = next(event.time for event in result.events if event.name.endswith(".touch"))
    low = 3.0 - touch - 0.5 * G * touch**2 - (1.0 if abs(np.asarray(part.axes)[2, 0]) > 0.5 else 0.5)
    surface = 0.8 * np.cos(2.0 * np.pi / 7.0 * touch - k * (11.0 + 2.0 * touch))
    assert low == pytest.approx(surface, abs=1e-3)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
def test_strips_in_a_row_feel_what_each_feels_by_itself() -> None:
    """Their sums over components go from strip to strip; alone each begins anew."""
    together = hanging(1)
    apart = together.copy()
    for name, part in together.loads.items():
        if isinstance(part, _core.ImmersedPart) and part.count > 1:
            apart.replace(name, row="", place=0, count=1, step=(0.0, 0.0, 0.0))
    assert any(one.count > 1 for one in together.loads.values() if isinstance(one, _core.ImmersedPart))
    one, other = (simulate(scene, t_end=2.0, dt_out=0.5, **EXACT)["position"] for scene in (together, apart))
    assert one == pytest.approx(other, abs=1e-9)  # that of the steps
