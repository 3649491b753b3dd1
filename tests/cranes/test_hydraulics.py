"""Hydraulic cylinders and valves against closed forms, an independent stiff solver, volume and energy."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import hydraulic_scenes as made
import numpy as np
import pytest
from element_runs import both_forms, goes_on
from hydraulic_scenes import FULL, HOLDING, MASS, PUMP, RETRACTED, RING, SET, START, STROKE, VALVE, G
from multibody_runs import record
from numpy.testing import assert_allclose
from scipy.integrate import simpson
from scipy.optimize import brentq

from seacrane import Curve, SceneError, _core, natural_modes, simulate
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.inputs.values import entries_of
from seacrane.scene import Accumulator, Chamber, Counterbalance, Oil, Piston, Relief, Rupture, Valve

LEAKS: dict[str, Any] = {
    "piston": Piston(viscous_friction=1e5, internal_leakage=2e-13, external_leakage=1e-13),
    "valve": replace(VALVE, overlap=0.05),
}
SMALL, LARGE = Accumulator(volume=1e-3, pressure=1.5e6, flow=2e-4), Chamber(hose_volume=2.0)


def test_values_have_the_defaults_of_the_entries_for_which_they_stand() -> None:
    entries = {entry.name: entry for entry in _core.HydraulicCylinder.FIELDS}
    for word, kind in VALUES.items():
        for key, entry in entries_of(word, kind).items():
            assert entries[entry].required or getattr(kind(), key) == entries[entry].default


def test_pressures_at_the_start_hold_the_load() -> None:
    up, down = made.raised().loads["ram"], made.raised(above=False).loads["ram"]
    assert up.pressure * FULL - up.pressure_rod * RING == pytest.approx(HOLDING, rel=1e-12)
    assert down.pressure * FULL - down.pressure_rod * RING == pytest.approx(-HOLDING, rel=1e-12)
    assert min(up.pressure_rod, down.pressure) == pytest.approx(0.1 * SET["pump_pressure"])
    out = record(made.raised(), 0.5, rtol=1e-9)
    assert np.ptp(out["hydraulic_stroke"]) < 1e-9
    assert out["hydraulic_stroke"][0, 0] == pytest.approx(START, abs=1e-12)


@pytest.mark.parametrize("stroke", [0.1, 0.5])
def test_the_hydraulic_frequency_is_that_of_both_closed_chambers(stroke: float) -> None:
    scene = made.raised(piston=Piston(), retracted_length=1.35 - stroke)
    modes = natural_modes(scene)
    expected = 2.0 * np.pi / np.sqrt(made.closed_stiffness(stroke) / MASS)
    assert np.min(np.abs(modes.natural_period / expected - 1.0)) < 1e-6


@pytest.mark.parametrize("more", [{}, LEAKS], ids=["as given", "with leakage and overlap"])
def test_the_complete_parameter_set_follows_an_independent_stiff_solver(more: dict[str, Any]) -> None:
    scene = made.lifted(**more)
    ram, times = scene.loads["ram"], np.linspace(0.0, 1.8, 91)
    s, v, p1, p2, u = made.own_solution(times, (ram.pressure, ram.pressure_rod), **more)
    assert np.ptp(s) > 0.02
    for formulation in ("redundant", "recursive"):
        out = record(scene, 1.8, dt_out=0.02, rtol=1e-9, formulation=formulation)
        assert_allclose(out["time"], times, atol=1e-12)
        assert_allclose(out["hydraulic_stroke"][:, 0], s, atol=1e-6 * STROKE)
        assert_allclose(out["velocity"][:, 0, 2], v, atol=1e-6)
        assert_allclose(out["hydraulic_pressure"][:, 0, 0], p1, atol=1e-6 * SET["pump_pressure"])
        assert_allclose(out["hydraulic_pressure"][:, 0, 1], p2, atol=1e-6 * SET["pump_pressure"])
        assert_allclose(out["hydraulic_spool"][:, 0], u, atol=1e-6)
        assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


EVERYTHING: dict[str, Any] = LEAKS | {
    "oil": Oil(air=0.005), "piston": replace(LEAKS["piston"], friction=300.0),
    "relief": Relief(pressure=3.1e6, pressure_rod=4e6, flow=5e-4),
    "counterbalance": Counterbalance(pressure=6e6, flow=8e-4),
    "pump": replace(PUMP, makeup_flow=4e-4, check=True), "accumulator": SMALL,
    "rupture": Rupture(time=1.5, area=3e-6),
}  # fmt: skip


def test_oil_is_neither_lost_nor_made() -> None:
    out = record(made.lifted(), 1.6, dt_out=0.002, rtol=1e-10)
    through, returned = out["hydraulic_pump_flow"][:, 0], out["hydraulic_tank_flow"][:, 0]
    ports = out["hydraulic_flow"][:, 0]
    assert_allclose(through - returned, np.sum(ports, axis=1), atol=1e-15 * np.max(np.abs(ports)))
    p = out["hydraulic_pressure"][:, 0]
    s = out["hydraulic_stroke"][:, 0]
    k = 1.0 / SET["oil_modulus"] + 1.0 / SET["cylinder_modulus"]
    d = 1.0 / SET["hose_modulus"] - 1.0 / SET["cylinder_modulus"]
    for side, swept, hose in (
        (0, FULL * s, SET["hose_volume"]), (1, RING * (STROKE - s), SET["hose_volume_rod"])
    ):  # fmt: skip
        density = np.exp(k * p[:, side])
        content = swept * density + hose * (k + d) * (density - 1.0) / k
        taken_in = simpson(density * ports[:, side], x=out["time"])
        assert content[-1] - content[0] == pytest.approx(taken_in, abs=1e-6 * np.ptp(content))


def test_a_steady_cylinder_moves_by_the_flows_over_its_areas() -> None:
    """s' = C u sqrt(...) of both edges in series."""
    speed = record(made.lifted(piston=Piston()), 0.8, rtol=1e-8, dt_out=0.4)["velocity"][-1, 0, 2]
    c = 0.6 * SET["rated_flow"] / np.sqrt(SET["rated_drop"])
    # p0 FULL - p1 RING = weight; c sqrt(pump - p0) = FULL v; c sqrt(p1 - tank) = RING v
    supply = SET["pump_pressure"] * FULL - SET["tank_pressure"] * RING - HOLDING
    expected = c * np.sqrt(supply / (FULL**3 + RING**3))
    assert speed == pytest.approx(expected, rel=2e-3)


def test_a_spool_without_lag_is_the_limit_of_a_quick_one() -> None:
    strokes = []
    for lag in (2e-3, 1e-3, 0.0):
        valve = replace(VALVE, spool_lag=lag)
        out = record(made.lifted(valve=valve, accumulator=SMALL), 1.0, rtol=1e-9, dt_out=0.05)
        strokes.append(out["hydraulic_stroke"][:, 0])
        assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]
        assert out["load_state"].shape[1] == (4 if lag else 3)
    assert_allclose(2.0 * strokes[1] - strokes[0], strokes[2], atol=2e-6)
    assert np.max(np.abs(strokes[1] - strokes[2])) > 2e-5


def test_energy_closes_with_every_part_and_runs_go_on_bit_for_bit() -> None:
    how: dict[str, Any] = {"dt_out": 0.01, "rtol": 1e-8}
    out = both_forms(made.lifted(**EVERYTHING), 2.0, {"hydraulic_stroke": 1e-6}, **how)
    power = out["hydraulic_power"][:, 0]
    assert np.max(power[:, 0]) > 0.0
    assert np.max(power[:, 2:]) < 1e-3 * np.max(np.abs(power))
    assert np.min(power[:, 2 + 5]) < 0.0  # of the rupture
    for integrator in ("dopri5", "dopri5-stiff", "rosenbrock"):
        goes_on(lambda: made.lifted(**EVERYTHING), 1.7, 0.83, dt_out=0.1, rtol=1e-6, integrator=integrator)


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"full_area": 50.3, "rod_side_area": 40.6, "chamber": LARGE, "rod_chamber": LARGE}, "m wide"),
        ({"relief": Relief(pressure=1e6, flow=1e-3)}, "below the holding pressure"),
        ({"stroke": 0.2}, "1.35 m apart as described, and it is 1.05 to 1.25 m long"),
        ({"rupture": Rupture(area=1e-4)}, "rupture_time is .*; give both"),
        ({"valve": Valve(rated_flow=24.0)}, "24 l/min are 0.0004"),
        ({"chamber": Chamber(pressure=1e6)}, "cannot hold the 9807 N"),
        ({"valve": 3.0}, r"valve is .*; give valve=Valve\(...\)"),
    ],
)  # fmt: skip
def test_bad_input_is_named(wrong: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=f"hydraulic cylinder 'ram': .*{message}"):
        made.raised(**wrong).compile()


CLOSED = {"piston": Piston()}
BURST = Rupture(time=0.2, area=4e-6)  # m2, 2.3 mm wide
HOLE = 0.6 * BURST.area * np.sqrt(2.0 / 870.0)  # m3/s/sqrt(Pa)
HOLDING_VALVE = Counterbalance(pressure=5e6, flow=8e-4)
AIR = 1e5  # Pa


def conductance(flow: float) -> float:
    return flow / float(np.sqrt(SET["rated_drop"]))


def through(drop: float) -> float:
    return drop / (drop**2 + SET["laminar_drop"] ** 2) ** 0.25


def test_a_burst_hose_lowers_the_load_as_fast_as_the_orifice_lets_oil_out() -> None:
    out = record(made.raised(pump=replace(PUMP, makeup_flow=1e-2), **CLOSED, rupture=BURST), 2.0, rtol=1e-8)
    makeup = conductance(1e-2)

    def left(v: float) -> float:
        rod = brentq(lambda p: makeup * through(SET["tank_pressure"] - p) - RING * v, -1e8, 1e5)
        return float(HOLE * through((HOLDING + rod * RING) / FULL - AIR) - FULL * v)

    speed = brentq(left, 1e-6, 0.1)
    assert -out["velocity"][-1, 0, 2] == pytest.approx(speed, rel=1e-5)
    spilled = out["hydraulic_spill"][:, 0]
    assert np.all(spilled[out["time"] < 0.2] == 0.0)
    assert spilled[-1] == pytest.approx(FULL * speed, rel=1e-4)


def test_a_load_holding_valve_holds_when_the_hose_bursts() -> None:
    up = Curve.quintic(start_time=0.5, end_time=0.6, start=0.0, end=0.5)
    out = record(made.raised(command=up, counterbalance=HOLDING_VALVE, rupture=BURST), 1.5, rtol=1e-8)
    assert np.ptp(out["hydraulic_stroke"]) < 3e-4  # as the rod side lets its pressure go
    assert out["hydraulic_spill"][-1, 0] == pytest.approx(out["hydraulic_pump_flow"][-1, 0], rel=1e-6)
    assert out["hydraulic_pump_flow"][-1, 0] == pytest.approx(
        0.5 * conductance(SET["rated_flow"]) * through(SET["pump_pressure"] - AIR), rel=1e-6
    )
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]


def test_a_load_holding_valve_lowers_by_its_pilot() -> None:
    """At rest it is closed; the pump on the rod side opens it, and the load goes down steadily."""
    down = Curve.quintic(start_time=0.1, end_time=0.3, start=0.0, end=-0.5)
    valve = replace(HOLDING_VALVE, pilot_ratio=3.0, range=4e7)
    out = record(made.raised(command=down, counterbalance=valve), 3.0, rtol=1e-8)
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
    parts = {"relief": Relief(pressure=5e6, flow=1e-3), "piston": Piston(viscous_friction=1e5)}
    scene = made.raised(retracted_length=RETRACTED - 0.29, command=0.5, **parts)
    scene.replace("ram", stop_stiffness=1e8)
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
    gas = Accumulator(volume=4e-3, pressure=1e6, flow=1.0, exponent=1.3)
    scene = made.raised(**CLOSED, accumulator=gas)
    ram = scene.loads["ram"]
    volume = gas.volume * (gas.pressure / ram.pressure) ** (1.0 / 1.3)
    sides = ((FULL * START, SET["hose_volume"]), (RING * (STROKE - START), SET["hose_volume_rod"]))
    full, ring = (
        (swept + hose) / SET["oil_modulus"] + swept / SET["cylinder_modulus"] + hose / SET["hose_modulus"]
        for swept, hose in sides
    )
    soft = FULL**2 / (full + volume / (1.3 * ram.pressure)) + RING**2 / ring
    modes = natural_modes(scene)
    assert np.min(np.abs(modes.natural_period * np.sqrt(soft / MASS) / (2.0 * np.pi) - 1.0)) < 1e-3


@pytest.mark.parametrize("air", [0.001, 0.02])
def test_air_softens_the_oil_as_its_formula_says(air: float) -> None:
    scene = made.raised(oil=Oil(air=air), **CLOSED)
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
    """Force peaks by v sqrt(k m), and the run sees it at a loose tolerance too."""
    shut = Curve.constant(value=0.6).then(
        time=0.5, curve=Curve.quintic(start_time=0.5, end_time=0.501, start=0.6, end=0.0)
    )
    parts = {"valve": replace(VALVE, spool_lag=1e-4), "piston": Piston(viscous_friction=2e3)}
    out = record(made.raised(command=shut, **parts), 0.56, dt_out=5e-4, rtol=1e-3)
    before = out["time"] < 0.5
    v, s = out["velocity"][before, 0, 2][-1], out["hydraulic_stroke"][before, 0][-1]
    push = out["hydraulic_force"][~before, 0]
    assert np.max(np.abs(push - MASS * G)) == pytest.approx(
        v * np.sqrt(made.closed_stiffness(s) * MASS), rel=0.05
    )
