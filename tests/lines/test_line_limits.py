"""Elastic lines towards the rigid rung, through snatches, and what they must conserve."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, G, below
from multibody_runs import momentum, record
from numpy.typing import NDArray

from seacrane import Scene

Array = NDArray[np.float64]
FORMULATIONS = ["redundant", "recursive"]


def pendulum(stiffness: float | None, *, damping: float = 0.3, **rung: Any) -> Scene:
    """2 t on 8 m, let go at 1 rad; the line is as long under its tension there as the rigid link."""
    place = 8.0 * np.array([np.sin(1.0), 0.0, -np.cos(1.0)])
    if stiffness is not None:
        length = 8.0 / (1.0 + 2e3 * G * np.cos(1.0) / stiffness)
        return below(place, mass=2e3, EA=stiffness, length=length, damping_ratio=damping, **rung)
    scene = below(place, mass=2e3)
    ends = {"point": (0, 0, 0), "second_point": place}
    scene.add_joint(kind="distance", name="hoist", first="ground", second="load", **ends)
    return scene


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_motion_and_tension_tend_to_the_rigid_link_as_one_over_ea(rung: str, formulation: str) -> None:
    settings: dict[str, Any] = {"dt_out": 0.1, "rtol": 1e-9, "formulation": formulation}
    rigid = record(pendulum(None), 6.0, **settings)
    moved, pulled = [], []
    stiffnesses = np.array([1e7, 1e8, 1e9])
    for stiffness in stiffnesses:
        out = record(pendulum(float(stiffness), rung=rung), 6.0, **settings)
        moved.append(np.abs(out["position"] - rigid["position"]).max())
        pulled.append(np.abs(out["line_tension"][10:, 0] - rigid["tension"][10:, 0]).max())
    for errors in (moved, pulled):
        slopes = np.diff(np.log(errors)) / np.diff(np.log(stiffnesses))
        assert slopes == pytest.approx(-1.0, abs=0.05)
    assert pulled[-1] < 1e-4 * np.abs(rigid["tension"]).max()


def falling(speed: float, *, stiffness: float | None, ratio: float = 0.02, along: float = 0.0) -> Scene:
    """20 t that meets the end of its slack 10 m at a speed, downwards; sideways it goes at another."""
    place, velocity = (0.0, 0.0, -9.98), (along, 0.0, -np.sqrt(speed**2 - 2.0 * G * 0.02))
    if stiffness is not None:
        return below(place, velocity=velocity, EA=10.0 * stiffness, length=10.0, damping_ratio=ratio)
    scene = below(place, velocity=velocity)
    ends = {"point": (0, 0, 0), "second_point": place, "length": 10.0}
    scene.add_joint(kind="distance", name="rope", first="ground", second="load", **ends)
    scene.add_line(joint="rope", rung="rigid", restitution=np.exp(-np.pi * ratio / np.sqrt(1.0 - ratio**2)))
    return scene


@pytest.mark.warns("UnitWarning")
@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("along", [0.0, 0.5])
def test_a_snatch_is_the_impact_of_the_rigid_wire(along: float, formulation: str) -> None:
    """Impulse and speeds to 1 %: the wire's restitution is exp(-pi z / sqrt(1 - z^2)), 0.94 at 2 %."""
    assert np.exp(-np.pi * 0.02 / np.sqrt(1.0 - 0.02**2)) == pytest.approx(0.94, abs=2e-3)
    settings: dict[str, Any] = {"dt_out": 2e-5, "rtol": 1e-9, "formulation": formulation}
    line = record(falling(3.0, stiffness=3e10, along=along), 0.02, **settings)
    wire = record(falling(3.0, stiffness=None, along=along), 0.02, **settings)
    assert wire["velocity"][:, 0, 2].min() == pytest.approx(-3.0, rel=1e-3)
    impulse = np.trapezoid(line["line_tension"][:, 0], line["time"])
    change = MASS * (wire["velocity"][-1, 0, 2] - wire["velocity"][0, 0, 2] + G * 0.02)
    assert impulse == pytest.approx(change, rel=0.01)
    assert change == pytest.approx(1.94 * 3.0 * MASS, rel=0.01)
    for axis in (0, 2):
        expected = wire["velocity"][-1, 0, axis]
        assert line["velocity"][-1, 0, axis] == pytest.approx(expected, rel=0.01, abs=1e-9)
    left = wire["absolute_work"][-1], line["absolute_work"][-1]  # J, what wire and damping took
    assert left[0] == pytest.approx(0.5 * MASS * 9.0 * (1.0 - np.exp(-0.04 * np.pi)), rel=0.01)
    assert left[1] == pytest.approx(left[0], rel=0.05)


@pytest.mark.parametrize(("speed", "stiffness"), [(1.0, 3e6), (1.0, 3e8), (2.0, 3e8), (4.0, 3e8)])
def test_the_peak_of_a_snatch_grows_as_v_root_km(speed: float, stiffness: float) -> None:
    """m g + sqrt((m g)^2 + k m v^2), never the impact of the rigid wire, which has no peak."""
    half = np.pi / np.sqrt(stiffness / MASS)
    begin = 0.02 / speed
    out = record(
        falling(speed, stiffness=stiffness, ratio=0.0), begin + 1.5 * half, dt_out=half / 400, rtol=1e-9
    )
    weight = MASS * G
    peak = float(out["line_tension"].max())
    assert peak == pytest.approx(weight + np.sqrt(weight**2 + stiffness * MASS * speed**2), rel=2e-5)
    if stiffness > 1e8:
        assert peak == pytest.approx(speed * np.sqrt(stiffness * MASS), rel=0.1)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_the_energy_ledger_converges_with_the_order_of_the_method(rung: str, formulation: str) -> None:
    residuals = []
    for step in (8e-3, 4e-3, 2e-3):
        scene = pendulum(2e6, rung=rung, damping=0.05)
        out = record(scene, 2.0, integrator="rk4", dt=step, rtol=1e-6, formulation=formulation)
        residuals.append(np.abs(out["energy_balance"]).max())
    assert np.diff(np.log2(residuals)) == pytest.approx(-4.5, abs=0.7)  # of order 4, of the damping 5


def flying(rung: str) -> Scene:
    """Three bodies without weight, one line over all of them; it is taut, and its ends fly apart."""
    scene = Scene(name="flying", gravity=0.0)
    places = {"first": (0.0, 0.0, 0.0), "block": (4.0, 0.0, 1.0), "last": (8.0, 1.0, 0.0)}
    for i, (name, place) in enumerate(places.items()):
        scene.add_body(
            name=name, mass=1e3 * (i + 1), inertia=(400.0, 500.0, 600.0), position=place,
            velocity=(0.0, 0.3 * i, -0.2), angular_velocity=(0.1, -0.2 * i, 0.05),
        )  # fmt: skip
    length = 2.0 * np.sqrt(17.0) + (np.sqrt(18.0) - np.sqrt(17.0))
    scene.add_line(
        name="rope", bodies=["first", "block", "last"], points=[(0.1, 0, 0), (0, 0.2, 0), (0, 0, 0.1)],
        EA=2e6, length=0.95 * length, rung=rung,
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_line_keeps_momentum(rung: str, formulation: str) -> None:
    """Linear and angular, of three bodies in free flight, taut, slack and snatching."""
    scene, quasi = flying(rung), rung == "quasi-static"
    if quasi:
        scene.replace("rope", settling=0.3)
        for name in scene.bodies:
            scene.replace(name, angular_velocity=(0.0, 0.0, 0.0), velocity=(0.1, 0.0, 0.0))
    out = record(scene, 0.3 if quasi else 3.0, rtol=1e-10, formulation=formulation)
    assert quasi or np.min(out["line_tension"]) == 0.0
    assert quasi or np.max(out["line_tension"]) > 1e3
    size = np.abs(out["velocity"]).max() * 1e3
    for kept in momentum(scene, out):
        assert np.abs(kept - kept[0]).max() < 1e-7 * size
