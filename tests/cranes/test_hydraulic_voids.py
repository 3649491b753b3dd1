"""Oil that boils: a void opens at the vapour pressure, against a solution with its volume as a state."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from element_runs import goes_on
from hydraulic_scenes import FULL, MASS, RING, SET, START, STROKE, G, raised
from multibody_runs import record
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

from seacrane import Scene, SimulationError, simulate
from seacrane.arrays import Array
from seacrane.scene import Chamber, Oil, Piston, Pump, Rupture, Valve
from seacrane.warnings import BoilingOilWarning

VAPOUR, ATMOSPHERE, BURST = 2e3, 1e5, 0.2  # Pa, Pa, s
HOLE = 2e-5  # m2: the load comes down at about a metre a second
CLOSED: dict[str, Any] = {
    "piston": Piston(viscous_friction=2e3), "pump": Pump(), "valve": Valve(),
    "rod_chamber": Chamber(pressure=1e6, hose_volume=78.5e-6),
}  # fmt: skip
DROPPED = CLOSED | {"rupture": Rupture(time=BURST, area=HOLE)}


def dropped(**settings: Any) -> Scene:
    """A load that comes down by a burst hose; the rod side is shut, and is sucked empty."""
    return raised(**DROPPED | settings)


def quietly(scene: Scene, t_end: float, **settings: Any) -> dict[str, Array]:
    with warnings.catch_warnings(action="ignore", category=BoilingOilWarning):
        return record(scene, t_end, **settings)


def compressibility(p: float, air: float) -> float:
    bulk = 1.0 / SET["oil_modulus"] + 1.0 / SET["cylinder_modulus"]
    liquid = np.exp(-p * bulk)
    with np.errstate(invalid="ignore"):  # a trial step of SciPy's may leave the pressures that there are
        gas = air * (ATMOSPHERE / p) ** (1.0 / 1.4)
    return float((liquid * bulk + gas / (1.4 * p)) / (liquid + gas))


def own_solution(times: Array, start: tuple[float, float], air: float) -> Array:
    """Stroke, speed, pressures and volumes of voids (6, n): Radau in pieces between openings and closings."""
    areas = (FULL, RING)
    hoses = (SET["hose_volume"], SET["hose_volume_rod"])
    soft = 1.0 / SET["hose_modulus"] - 1.0 / SET["cylinder_modulus"]
    outflow = 0.6 * HOLE * np.sqrt(2.0 / 870.0)

    def rates(t: float, x: Array, boils: tuple[bool, bool], burst: bool) -> list[float]:
        s, v = x[0], x[1]
        swept = (FULL * s, RING * (STROKE - s))
        moves = (FULL * v, -RING * v)
        pressure_rates, void_rates = [0.0, 0.0], [0.0, 0.0]
        for side in (0, 1):
            p = VAPOUR if boils[side] else x[2 + side]
            drop = p - ATMOSPHERE
            out = 0.0
            if burst and side == 0 and drop > 0.0:
                out = outflow * drop / (drop**2 + SET["laminar_drop"] ** 2) ** 0.25
            if boils[side]:
                void_rates[side] = moves[side] + out
            else:
                k = compressibility(p, air)
                pressure_rates[side] = (-out - moves[side]) / (swept[side] * k + hoses[side] * (k + soft))
        p0, p1 = (VAPOUR if boils[side] else x[2 + side] for side in (0, 1))
        force = p0 * areas[0] - p1 * areas[1] - CLOSED["piston"].viscous_friction * v
        force -= 1e9 * (min(s, 0.0) + max(s - STROKE, 0.0))
        return [v, force / MASS - G, *pressure_rates, *void_rates]

    found: list[Array] = []
    x, t, boils = np.array([START, 0.0, *start, 0.0, 0.0]), 0.0, (False, False)
    while t < times[-1]:
        burst = t >= BURST
        end = times[-1] if burst else min(BURST, times[-1])

        def opens(side: int) -> Any:
            def margin(_: float, at: Array, void: tuple[bool, bool], __: bool) -> float:
                return float(at[4 + side] if void[side] else at[2 + side] - VAPOUR)

            margin.terminal, margin.direction = True, -1.0  # type: ignore[attr-defined]
            return margin

        inside = times[(times >= t) & (times < end)]
        part = solve_ivp(
            rates, (t, end), x, method="Radau", t_eval=np.unique([*inside, end]), args=(boils, burst),
            events=[opens(0), opens(1)], rtol=1e-9, atol=[1e-11, 1e-11, 1e-3, 1e-3, 1e-15, 1e-15],
        )  # fmt: skip
        found.append(part.y[:, np.isin(part.t, inside)])
        if part.status == 1:
            side = 0 if part.t_events[0].size else 1
            t, x = float(part.t_events[side][0]), part.y_events[side][0].copy()
            boils = (not boils[0], boils[1]) if side == 0 else (boils[0], not boils[1])
            x[2 + side], x[4 + side] = VAPOUR, 0.0
        else:
            t, x = end, part.y[:, -1]
    return np.hstack([*found, x[:, None]])


@pytest.mark.parametrize(("air", "formulation"), [(0.0, "redundant"), (0.01, "recursive")])
def test_a_void_opens_and_closes_as_an_independent_solver_says(air: float, formulation: str) -> None:
    scene = dropped(oil=Oil(air=air))
    ram, times = scene.loads["ram"], np.linspace(0.0, 0.6, 61)
    s, v, p0, p1, _, empty = own_solution(times, (ram.pressure, ram.pressure_rod), air)
    assert empty.max() > 1e-5, "the scene opens no void"
    out = quietly(scene, 0.6, dt_out=0.01, rtol=1e-9, formulation=formulation)
    assert_allclose(out["hydraulic_stroke"][:, 0], s, atol=1e-6 * STROKE)
    assert_allclose(out["velocity"][:, 0, 2], v, atol=2e-6)
    scale = 1e-5 * max(ram.pressure, p0.max())
    assert_allclose(out["hydraulic_pressure"][:, 0, 0], p0, atol=scale)
    assert_allclose(out["hydraulic_pressure"][:, 0, 1], np.where(empty > 0.0, VAPOUR, p1), atol=scale)
    assert_allclose(out["hydraulic_void"][:, 0, 1], empty, atol=1e-6 * empty.max())


@pytest.mark.parametrize(
    ("integrator", "air"), [("dopri5", 0.005), ("dopri5-stiff", 0.0), ("rosenbrock", 0.005)]
)
def test_no_pressure_falls_below_the_vapours_and_the_energy_closes(integrator: str, air: float) -> None:
    out = quietly(dropped(oil=Oil(air=air)), 1.0, dt_out=5e-3, rtol=1e-7, integrator=integrator)
    assert np.min(out["hydraulic_pressure"]) >= VAPOUR
    assert out["hydraulic_void"].max() > 1e-4
    assert np.max(np.abs(out["energy_balance"])) < 2e-6 * out["absolute_work"][-1]


@pytest.mark.warns("AssemblyWarning")
def test_a_closed_chamber_gets_its_oil_back() -> None:
    """Thrown up, the load sucks its closed full side empty, and comes down on the same oil."""
    scene = raised(velocity=1.0, **CLOSED)
    out = quietly(scene, 1.2, dt_out=1e-3, rtol=1e-9)
    s, p, empty = (out[name][:, 0] for name in ("hydraulic_stroke", "hydraulic_pressure", "hydraulic_void"))
    open_now = empty[:, 0] > 0.0
    assert 50 < open_now.sum() < 1000
    assert_allclose(
        np.ptp((empty[:, 0] - FULL * s)[open_now][:40]), 0.0, atol=1e-12
    )  # V' = A s', nothing flows in
    bulk = 1.0 / SET["oil_modulus"] + 1.0 / SET["cylinder_modulus"]
    soft = 1.0 / SET["hose_modulus"] - 1.0 / SET["cylinder_modulus"]
    density = np.exp(bulk * p[:, 0])
    hose = SET["hose_volume"]
    content = FULL * s * density + hose * (bulk + soft) * (density - 1.0) / bulk - empty[:, 0] * density
    assert_allclose(content, content[0], rtol=1e-8)


def test_a_void_is_told_or_ends_the_run_and_runs_go_on_bit_for_bit_within_it() -> None:
    with pytest.warns(BoilingOilWarning) as told:
        result = simulate(dropped(), 0.5, channels=["hydraulic_void"])
    (text,) = {str(one.message) for one in told if one.category is BoilingOilWarning}
    at = next(event.time for event in result.events if event.name == "ram.vapour_rod")
    assert f"'ram': the oil of its rod side boils at t = {at:.6g} s" in text
    assert f"of up to {1e3 * result['hydraulic_void'][:, 0, 1].max():.3g} l" in text
    with pytest.raises(SimulationError, match=r"'ram': .* rod side, and refuse_void is set"):
        simulate(dropped(oil=Oil(refuse_void=True)), 0.5)
    for integrator in ("dopri5", "dopri5-stiff"):
        how: dict[str, Any] = {"dt_out": 0.1, "rtol": 1e-6, "integrator": integrator}
        half = goes_on(lambda: dropped(oil=Oil(air=0.002)), 0.6, 0.3, **how)
        assert min(half.load_states[f"ram.{name}"] for name in ("pressure", "pressure_rod")) < VAPOUR
