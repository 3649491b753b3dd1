"""What the water does by cause: forces, powers, and the momentum that it takes and keeps."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from scipy.integrate import simpson
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation
from test_immersed import SLICE, dropped, hanging, heights, sunk_and_risen
from test_lines_in_water import tossed
from wet_scenes import EXACT, RHO, G, quaternion

from seacrane import Scene, simulate
from seacrane.arrays import Array
from seacrane.description.channels import FIXED
from seacrane.hydro import BoxPart, CylinderPart, SpherePart
from seacrane.run import Run
from seacrane.scene import Waves

BUOYANCY, WAVES, ADDED, DRAG, SLAM = range(5)
assert FIXED["cause"] == ("buoyancy", "waves", "added mass", "drag", "slam")


TWO_WAVES = Waves(
    omega=[0.9, 1.6], amplitude=[0.5, 0.2], phase=[0.3, 2.0], direction=[0.4, -1.0], hulls={}, depth=30.0
)


def tumbling(part: Any, *, waves: bool) -> Scene:
    """A free body with one part, which falls through the surface."""
    scene = Scene(name="tumbling", gravity=G)
    scene.add_body(
        name="load", mass=3000.0, inertia=(2000.0, 2500.0, 3000.0), position=(0.0, 0.0, 1.5),
        center_of_mass=(0.1, -0.2, 0.1), velocity=(1.0, 0.5, -3.0), angular_velocity=(0.4, -0.3, 0.5),
        quaternion=quaternion(Rotation.random(random_state=3)),
    )  # fmt: skip
    if waves:
        scene.waves = TWO_WAVES
    scene.add_immersed("load", parts=[part], density=RHO)
    return scene


@pytest.mark.parametrize("waves", [True, False])
@pytest.mark.parametrize(
    "part",
    [BoxPart(size=(2.0, 1.5, 1.0), point=(0.3, 0.1, -0.2)), CylinderPart(length=2.0, diameter=1.1, strips=1),
     SpherePart(diameter=1.6, point=(0.2, 0.0, 0.1))],
    ids=lambda part: part.kind,
)  # fmt: skip
def test_all_forces_are_mass_times_acceleration_less_weight(part: Any, waves: bool, formulation: str) -> None:
    result = simulate(tumbling(part, waves=waves), t_end=2.0, dt_out=0.02, formulation=formulation,
                      channels=["acceleration", "immersed_force"])  # fmt: skip
    force = np.asarray(result["immersed_force"]).sum(axis=1)  # of a cylinder and its ends
    expected = 3000.0 * (np.asarray(result.select("acceleration", body="load")) + np.array([0.0, 0.0, G]))
    scale = np.abs(force).max()
    assert np.abs(force.sum(axis=1) - expected).max() < 1e-11 * scale
    largest = np.abs(force).max(axis=(0, 2))
    assert np.all(largest[[BUOYANCY, ADDED, DRAG, SLAM]] > 1e-3 * scale)
    assert (largest[WAVES] > 1e-3 * scale) == waves
    assert np.all(force[0] == 0.0), "it starts in air"


def test_in_still_water_waves_bring_no_power_and_drag_and_slam_take_some() -> None:
    how = EXACT | {"channels": ["water_power", "load_state"], "formulation": "redundant"}
    result = simulate(hanging(1), t_end=3.0, dt_out=0.01, **how)
    power = np.asarray(result["water_power"])
    scale = np.abs(power).max()
    assert np.abs(power[..., WAVES]).max() < 1e-12 * scale
    assert np.all(power[..., [BUOYANCY, ADDED]] == 0.0), "both are in the energy"
    assert np.all(power[..., [DRAG, SLAM]] <= 0.0)
    assert np.abs(power[..., DRAG]).max() > 0.01 * scale
    taken = -simpson(power[..., SLAM], x=result.time, axis=0)
    assert taken == pytest.approx(np.asarray(result["load_state"])[-1], rel=0.02, abs=1.0)


@pytest.mark.parametrize("waves", [True, False])
def test_the_power_of_a_line_is_told_by_cause_and_waves_bring_none_in_still_water(waves: bool) -> None:
    result = simulate(tossed(waves=waves), t_end=2.0, dt_out=0.01, channels=["water_power"])
    power = np.asarray(result["water_power"])
    scale = np.abs(power).max()
    assert (np.abs(power[..., WAVES]).max() > 1e-3 * scale) == waves
    assert np.all(power[..., SLAM] <= 0.0)
    assert np.all(power[..., ADDED] == 0.0), "its length is the same"
    if not waves:
        assert np.abs(power.sum(axis=1)[..., WAVES]).max() < 1e-12 * scale


def test_the_work_by_cause_is_the_change_of_energy_deep_in_waves() -> None:
    """Of a sphere that sinks: kinetic energy with added mass, and that of buoyancy at its depth."""
    scene = Scene(name="deep", gravity=G)
    size = 0.3  # small beside the waves, whose elevation is a mean over it
    volume = np.pi / 6.0 * size**3
    mass = 1.2 * RHO * volume
    scene.add_body(name="load", mass=mass, inertia=(mass,) * 3, position=(0.0, 0.0, -9.0))
    scene.waves = TWO_WAVES
    scene.add_immersed("load", parts=[SpherePart(diameter=size)], density=RHO)
    (element,) = scene.loads.values()
    result = simulate(
        scene, t_end=4.0, dt_out=0.005, channels=["water_power", "velocity", "position"], **EXACT
    )
    power = np.asarray(result.select("water_power", wet="load.1"))
    z, speed = (np.asarray(result.select(name, body="load")) for name in ("position", "velocity"))
    work = simpson(power.sum(axis=1), x=result.time)
    ends = ((0, 0.0), (-1, 4.0))
    surface = [scene.sea_at(points=z[i][None, :], times=[t]).elevation[0, 0] for i, t in ends]
    sunk = np.array(surface) - z[[0, -1], 2]
    added = np.interp(sunk + 0.5 * size, element.depths, np.asarray(element.added_masses)[:, 2])
    energy = 0.5 * (mass + added) * np.sum(speed[[0, -1]] ** 2, axis=1) + mass * G * z[[0, -1], 2]
    energy += RHO * G * volume * sunk
    assert energy[1] - energy[0] == pytest.approx(work, rel=2e-5)


def integral(values: Array, times: Array) -> Array:
    """Over a stretch between events; values at its ends, which may be those beyond, by cubics."""
    y = values.copy()
    for at, inward in ((0, (1, 2, 3, 4)), (-1, (-2, -3, -4, -5))):
        a, b, c, d = (values[i] for i in inward)
        y[at] = 4.0 * a - 6.0 * b + 4.0 * c - d
    return np.asarray(simpson(y, x=times, axis=0))


def stretches(scene: Scene, t_end: float, count: int, formulation: str) -> list[Any]:
    """Results with so many outputs from one knot of the table of a part 1 m high, or turn, to the next.

    In between the force of the water is smooth.
    """
    given: dict[str, Any] = {"formulation": formulation, "model": scene.compile(), **EXACT}
    found = Run(scene, t_end, dt_out=1e-3, channels=["position", "velocity"], **given)
    found.advance(t_end)
    z, rate = heights(result := found.result())
    stops = [
        CubicHermiteSpline(result.time, z - 0.5 + depth, rate).roots(extrapolate=False)
        for depth in np.asarray(scene.loads["load.1"].depths)
    ]
    stops.append(CubicHermiteSpline(result.time, z, rate).derivative().roots(extrapolate=False))
    run, out = Run(scene, t_end, dt_out=t_end, **given), []
    channels = ["velocity", "immersed_force", "immersed_momentum", "immersed_shed"]
    for begin, end in pairwise([0.0, *np.sort(np.concatenate(stops)), t_end]):
        run.advance(begin)
        piece = Run(scene, end, start=run.state, outputs_from=begin, dt_out=(end - begin) / count,
                    channels=channels, **given)  # fmt: skip
        piece.advance(end)
        out.append(piece.result())
    return out


def test_momentum_closes_through_entry_exit_and_entry_with_weight(formulation: str) -> None:
    """m v + A v, what stays behind in the water, and the impulse of weight and buoyancy."""
    mass, balance, shed, largest, impulse = 150.0, [], 0.0, 0.0, 0.0
    for piece in stretches(sunk_and_risen(), 1.5, 32, formulation):
        time = np.asarray(piece.time)
        momentum = mass * np.asarray(piece.select("velocity", body="load", axis="z"))
        momentum = momentum + np.asarray(piece.select("immersed_momentum", part="load.1", axis="z"))
        balance.append(momentum[0] + shed - impulse)
        force = np.asarray(piece.select("immersed_force", part="load.1", axis="z"))
        impulse += float(integral(force[:, BUOYANCY] - mass * G, time))
        shed += float(integral(np.asarray(piece.select("immersed_shed", part="load.1", axis="z")), time))
        balance.append(momentum[-1] + shed - impulse)
        largest = max(largest, float(np.abs(momentum).max()))
    assert len(balance) > 200, "in, out and in again, from knot to knot"
    assert abs(shed) > 0.01 * largest
    assert np.ptp(balance) < 5e-9 * largest, "a knot is found to some 1e-9 m, on either side of it"


def test_slam_takes_by_its_power_what_its_state_says(formulation: str) -> None:
    scene = dropped(CylinderPart(**SLICE), mass=np.pi / 8.0 * 1000.0)
    how = EXACT | {"channels": ["water_power"], "formulation": formulation}
    result = simulate(scene, t_end=0.3, dt_out=1e-4, **how)
    power = np.asarray(result.select("water_power", wet="load.1", cause="slam"))
    assert -integral(power, np.asarray(result.time)) == pytest.approx(1270.2809, rel=3e-6)
