"""Relief, load-holding and check valves, accumulators, air and burst hoses against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import (
    FULL,
    HOLDING,
    MASS,
    RETRACTED,
    RING,
    SET,
    START,
    STROKE,
    G,
    closed_stiffness,
    raised,
)
from multibody_runs import record
from scipy.optimize import brentq

from seacrane import Curve, natural_modes, simulate

CLOSED = {"viscous_friction": 0.0}
BURST = {"rupture_time": 0.2, "rupture_area": 4e-6}  # m2, 2.3 mm wide
HOLE = 0.6 * BURST["rupture_area"] * np.sqrt(2.0 / 870.0)  # m3/s/sqrt(Pa)
HOLDING_VALVE = {"counterbalance_pressure": 5e6, "counterbalance_flow": 8e-4}
AIR = 1e5  # Pa


def conductance(flow: float) -> float:
    return flow / float(np.sqrt(SET["rated_drop"]))


def through(drop: float) -> float:
    return drop / (drop**2 + SET["laminar_drop"] ** 2) ** 0.25


def test_a_burst_hose_lowers_the_load_as_fast_as_the_orifice_lets_oil_out() -> None:
    out = record(raised(makeup_flow=1e-2, **CLOSED, **BURST), 2.0, rtol=1e-8)
    makeup = conductance(1e-2)

    def left(v: float) -> float:
        rod = brentq(lambda p: makeup * through(SET["tank_pressure"] - p) - RING * v, -1e8, 1e5)
        return float(HOLE * through((HOLDING + rod * RING) / FULL - AIR) - FULL * v)

    speed = brentq(left, 1e-6, 0.1)
    assert -out["velocity"][-1, 0, 2] == pytest.approx(speed, rel=1e-5)
    plain = (
        0.6
        * BURST["rupture_area"]
        * np.sqrt(2.0 * (HOLDING / FULL - AIR * (1.0 - RING / FULL)) / 870.0)
        / FULL
    )
    assert speed == pytest.approx(plain, rel=1e-2)
    spilled = out["hydraulic_spill"][:, 0]
    assert np.all(spilled[out["time"] < 0.2] == 0.0)
    assert spilled[-1] == pytest.approx(FULL * speed, rel=1e-4)


def test_a_load_holding_valve_holds_when_the_hose_bursts() -> None:
    """Lifting then only spills what the pump gives."""
    up = Curve.quintic(start_time=0.5, end_time=0.6, start=0.0, end=0.5)
    out = record(raised(command=up, **HOLDING_VALVE, **BURST), 1.5, rtol=1e-8)
    assert np.ptp(out["hydraulic_stroke"]) < 3e-4  # as the rod side lets its pressure go
    assert out["hydraulic_spill"][-1, 0] == pytest.approx(out["hydraulic_pump_flow"][-1, 0], rel=1e-6)
    assert out["hydraulic_pump_flow"][-1, 0] == pytest.approx(
        0.5 * conductance(SET["rated_flow"]) * through(SET["pump_pressure"] - AIR), rel=1e-6
    )
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


def test_a_load_holding_valve_lowers_by_its_pilot() -> None:
    """At rest it is closed; the pump on the rod side opens it, and the load goes down steadily."""
    down = Curve.quintic(start_time=0.1, end_time=0.3, start=0.0, end=-0.5)
    out = record(
        raised(command=down, pilot_ratio=3.0, counterbalance_range=4e7, **HOLDING_VALVE), 3.0, rtol=1e-8
    )
    v, (p, rod) = -out["velocity"][-1, 0, 2], out["hydraulic_pressure"][-1, 0]
    y = min(max((p + 3.0 * rod - 5e6) / 4e7, 0.0), 1.0)
    edge, valve = 0.5 * conductance(SET["rated_flow"]), conductance(8e-4) * y * y * (3.0 - 2.0 * y)
    series = edge * valve / np.hypot(edge, valve)
    assert 0.0 < y < 1.0
    assert FULL * v == pytest.approx(series * through(p - SET["tank_pressure"]), rel=1e-4)
    assert RING * v == pytest.approx(edge * through(SET["pump_pressure"] - rod), rel=1e-4)
    assert v > 0.01


def test_a_relief_valve_opens_at_its_pressure_and_passes_its_flow() -> None:
    """The pump drives the piston against the end of its stroke: what comes in leaves by the relief valve."""
    relief = {"relief_pressure": 5e6, "relief_flow": 1e-3, "relief_override": 1e6}
    scene = raised(retracted_length=RETRACTED - 0.29, stop_stiffness=1e8, command=0.5, **relief)
    result = simulate(scene, 1.5, dt_out=0.05, rtol=1e-8)
    told = [event.name for event in result.events if event.kind == "limit"]
    assert "ram.extended" in told and "ram.relief" in told
    edge = 0.5 * conductance(SET["rated_flow"])
    expected = brentq(lambda p: edge * through(SET["pump_pressure"] - p) - 1e-9 * (p - 5e6), 5e6, 7.6e6)
    assert result["hydraulic_pressure"][-1, 0, 0] == pytest.approx(expected, rel=1e-6)
    at = next(event.time for event in result.events if event.name == "ram.relief")
    fine = simulate(scene, at, dt_out=at, rtol=1e-8)
    assert fine["hydraulic_pressure"][-1, 0, 0] == pytest.approx(5e6, rel=1e-5)


def test_an_accumulator_makes_the_cylinder_soft() -> None:
    gas: dict[str, Any] = {
        "accumulator_volume": 4e-3, "accumulator_pressure": 1e6, "accumulator_flow": 1.0,
        "accumulator_exponent": 1.3,
    }  # fmt: skip
    scene = raised(**CLOSED, **gas)
    ram = scene.loads["ram"]
    volume = gas["accumulator_volume"] * (gas["accumulator_pressure"] / ram.pressure) ** (1.0 / 1.3)
    full, ring = (
        (swept + hose) / SET["oil_modulus"] + swept / SET["cylinder_modulus"] + hose / SET["hose_modulus"]
        for swept, hose in (
            (FULL * START, SET["hose_volume"]), (RING * (STROKE - START), SET["hose_volume_rod"]),
        )
    )  # fmt: skip
    soft = FULL**2 / (full + volume / (1.3 * ram.pressure)) + RING**2 / ring
    modes = natural_modes(scene)
    assert np.min(np.abs(modes.natural_period * np.sqrt(soft / MASS) / (2.0 * np.pi) - 1.0)) < 1e-3


@pytest.mark.parametrize("air", [0.001, 0.02])
def test_air_softens_the_oil_as_its_formula_says(air: float) -> None:
    scene = raised(air=air, **CLOSED)
    ram = scene.loads["ram"]
    stiffness = 0.0
    for p, area, swept, hose in (
        (ram.pressure, FULL, FULL * START, SET["hose_volume"]),
        (ram.pressure_rod, RING, RING * (STROKE - START), SET["hose_volume_rod"]),
    ):
        k = 1.0 / SET["oil_modulus"] + 1.0 / SET["cylinder_modulus"]
        liquid, gas = np.exp(-k * p), air * (AIR / p) ** (1.0 / 1.4)
        mixed = (liquid * k + gas / (1.4 * p)) / (liquid + gas)
        hoses = 1.0 / SET["hose_modulus"] - 1.0 / SET["cylinder_modulus"]
        stiffness += area**2 / (swept * mixed + hose * (mixed + hoses))
    modes = natural_modes(scene)
    period = 2.0 * np.pi / np.sqrt(stiffness / MASS)
    assert np.min(np.abs(modes.natural_period / period - 1.0)) < 1e-6


def test_a_valve_that_shuts_in_a_millisecond_leaves_the_load_swinging_on_its_oil() -> None:
    """Force peaks by v sqrt(k m), and the run sees it whatever its tolerance."""
    shut = Curve.constant(value=0.6).then(
        time=0.5, curve=Curve.quintic(start_time=0.5, end_time=0.501, start=0.6, end=0.0)
    )
    for rtol in (1e-3, 1e-8):
        out = record(raised(command=shut, spool_lag=1e-4, viscous_friction=2e3), 0.56, dt_out=5e-4, rtol=rtol)
        before = out["time"] < 0.5
        v, s = out["velocity"][before, 0, 2][-1], out["hydraulic_stroke"][before, 0][-1]
        k = closed_stiffness(s)
        push = out["hydraulic_force"][~before, 0]
        assert np.max(np.abs(push - MASS * G)) == pytest.approx(v * np.sqrt(k * MASS), rel=0.05)
        assert np.max(np.abs(out["energy_balance"])) < max(1e-6, rtol) * out["absolute_work"][-1]
