"""Velocity, acceleration and pressure under waves: the equations of linear theory, by differences."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane.sea import SeaState, WaveComponents, WaveSystem, cos_2s, jonswap

G, RHO = 9.80665, 1025.0
DEPTHS = [12.0, float("inf")]


def sea(depth: float) -> WaveComponents:
    system = WaveSystem(
        spectrum=jonswap(hs=1.5, tp=7.0), direction_deg=130.0, spreading=cos_2s(8.0), count=60
    )
    return SeaState(systems=[system], seed=4, depth=depth).realise().waves


def points(depth: float, count: int = 40) -> dict[str, np.ndarray]:
    rng = np.random.default_rng(8)
    floor = min(depth, 60.0)
    return {
        "time": rng.uniform(0.0, 300.0, count), "x": rng.uniform(-80.0, 80.0, count),
        "y": rng.uniform(-80.0, 80.0, count), "z": -0.8 * floor * rng.uniform(0.0, 1.0, count) ** 2 - 1.5,
    }  # fmt: skip


def slope(waves: WaveComponents, at: dict[str, np.ndarray], along: str, what: str) -> np.ndarray:
    """Central difference of fourth order."""
    h = 0.05 if along != "time" else 0.02

    def value(offset: float) -> np.ndarray:
        moved = at | {along: at[along] + offset}
        return np.asarray(getattr(waves.kinematics(**moved, stretching="none", density=RHO), what))

    return (8.0 * (value(h) - value(-h)) - (value(2.0 * h) - value(-2.0 * h))) / (12.0 * h)


@pytest.mark.parametrize("depth", DEPTHS)
def test_the_flow_obeys_continuity_irrotationality_and_the_linear_euler_equation(depth: float) -> None:
    waves, at = sea(depth), points(depth)
    here = waves.kinematics(**at, stretching="none", density=RHO)
    du, dv, dw = (slope(waves, at, axis, "velocity") for axis in "xyz")
    scale = np.abs(du).max()
    assert scale > 0.01
    np.testing.assert_allclose(du[:, 0] + dv[:, 1] + dw[:, 2], 0.0, atol=1e-6 * scale)
    for curl in (dv[:, 2] - dw[:, 1], dw[:, 0] - du[:, 2], du[:, 1] - dv[:, 0]):
        np.testing.assert_allclose(curl, 0.0, atol=1e-6 * scale)
    largest = np.abs(here.acceleration).max()
    np.testing.assert_allclose(slope(waves, at, "time", "velocity"), here.acceleration, atol=1e-6 * largest)
    gradient = np.stack([slope(waves, at, axis, "dynamic_pressure") for axis in "xyz"], axis=-1)
    np.testing.assert_allclose(gradient, -RHO * here.acceleration, atol=1e-6 * RHO * largest)


@pytest.mark.parametrize("depth", DEPTHS)
def test_free_surface_sea_floor_and_wheeler_stretching(depth: float) -> None:
    waves, at = sea(depth), points(depth)
    surface = waves.kinematics(**(at | {"z": 0.0}), stretching="none", density=RHO)
    wet = surface.submerged
    assert 5 < np.count_nonzero(wet) < wet.size
    # Linear dynamic and kinematic conditions at z = 0: p = rho g eta, w = d eta / dt.
    pressure = RHO * G * surface.elevation[wet]
    np.testing.assert_allclose(surface.dynamic_pressure[wet], pressure, rtol=1e-12, atol=1e-8)
    h = 1e-3
    eta = [waves.elevation(at["time"] + s * h, x=at["x"], y=at["y"]) for s in (-2, -1, 1, 2)]
    rate = (8.0 * (eta[2] - eta[1]) - (eta[3] - eta[0])) / (12.0 * h)
    np.testing.assert_allclose(surface.velocity[wet, 2], rate[wet], atol=1e-8)
    if np.isfinite(depth):
        floor = waves.kinematics(**(at | {"z": -depth}), density=RHO)
        np.testing.assert_allclose(floor.velocity[:, 2], 0.0, atol=1e-15)
        assert np.abs(floor.velocity[:, :2]).max() > 1e-4
    line = {"time": np.linspace(0.0, 60.0, 121), "x": 3.0, "y": 2.0}
    level = waves.elevation(line["time"], x=3.0, y=2.0)
    top = waves.kinematics(**line, z=level, density=RHO)
    assert top.submerged.all()
    # Total pressure -rho g z + p vanishes at the surface itself.
    np.testing.assert_allclose(top.dynamic_pressure, RHO * G * level, rtol=1e-12, atol=1e-8)
    mapped = (-4.0 - level) / (1.0 + level / depth)
    stretched, plain = waves.kinematics(**line, z=-4.0), waves.kinematics(**line, z=mapped, stretching="none")
    np.testing.assert_allclose(stretched.velocity, plain.velocity, rtol=1e-12, atol=1e-15)
    air = waves.kinematics(**line, z=level + 1e-6)
    assert not air.submerged.any()
    assert not air.velocity.any() and not air.acceleration.any() and not air.dynamic_pressure.any()
    np.testing.assert_array_equal(air.elevation, level)


def test_times_and_points_broadcast() -> None:
    waves = sea(12.0)
    x, y = np.linspace(-50.0, 50.0, 5), np.linspace(0.0, 30.0, 3)
    field = waves.elevation(12.0, x=x, y=y[:, None])
    assert field.shape == (3, 5)
    k, b = np.array(waves.wavenumber), np.array(waves.direction)
    angle = 12.0 * waves.omega + waves.phase - k * (x[1] * np.cos(b) + y[2] * np.sin(b))
    assert field[2, 1] == pytest.approx(float(np.sum(waves.amplitude * np.cos(angle))), abs=1e-12)
    assert waves.kinematics(time=[0.0, 1.0], x=0.0, y=0.0, z=-2.0).velocity.shape == (2, 3)
    with pytest.raises(ValueError, match=r"z is -12.5.*sea floor"):
        waves.kinematics(time=0.0, x=0.0, y=0.0, z=-12.5)
