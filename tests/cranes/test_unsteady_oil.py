"""A gain that makes a cylinder's load swing by itself is told, against runs and the closed form."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import FULL, HOLDING, MASS, RING, SET, START, raised

from seacrane import Curve, Scene, Stage, simulate, simulate_stages
from seacrane.crane import Payload, load_crane
from seacrane.hydro import shipped_database
from seacrane.warnings import UnsteadyOilWarning

SETTINGS: dict[str, Any] = {"viscous_friction": 2e3, "spool_lag": 1e-3, "reference": START + 0.005}


def swings(gain: float) -> tuple[bool, list[str]]:
    """Whether the pressure still swings after a step of the reference, and what is told."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = simulate(raised(gain=gain, **SETTINGS), 4.0, dt_out=5e-3)
    late = result["hydraulic_pressure"][-200:, 0, 0]
    return bool(np.std(late) > 1e4), [
        str(one.message) for one in caught if one.category is UnsteadyOilWarning
    ]


def steady_gain() -> float:
    """Routh, of a quick spool: gain times its speed < 2 zeta omega = friction / mass; of the mean slope."""
    back = 0.1 * SET["pump_pressure"]
    load = (HOLDING + back * RING) / FULL
    conductance = SET["rated_flow"] / np.sqrt(SET["rated_drop"])
    drops = (SET["pump_pressure"] - load, load - SET["tank_pressure"])
    flow = conductance * 0.5 * sum(drop / (drop**2 + SET["laminar_drop"] ** 2) ** 0.25 for drop in drops)
    return float(SETTINGS["viscous_friction"] / MASS / (flow / FULL))


@pytest.mark.parametrize(("share", "unsteady"), [(0.6, False), (1.7, True)])
def test_a_gain_above_the_closed_form_is_told_and_swings(share: float, unsteady: bool) -> None:
    swinging, told = swings(share * steady_gain())
    assert swinging is unsteady
    assert bool(told) is unsteady
    if told:
        assert "hydraulic cylinder 'ram': with its gain of" in told[0] and "a lower gain" in told[0]


def test_the_gain_that_is_recommended_is_steady() -> None:
    _, (told,) = swings(4.0 * steady_gain())
    gain = float(told.partition("such as ")[2].split()[0])
    assert swings(gain) == (False, [])


def test_a_vessel_that_drifts_is_no_fault_of_the_valve() -> None:
    scene = Scene(name="afloat")
    scene.add_vessel(shipped_database())
    oil = {"pump_pressure": 32e6, "rated_flow": 0.06, "rated_drop": 1e6, "spool_lag": 0.02, "gain": 0.3}
    scene.add_crane(held=True, s1=2.0, s2=3.0, hydraulics={"main": oil | {"viscous_friction": 2e6}})
    scene.add_ballast()
    with warnings.catch_warnings():
        warnings.simplefilter("error", UnsteadyOilWarning)
        simulate(scene, 0.5)


def test_a_crane_that_loses_its_load_and_comes_to_rest_is_no_fault_of_its_gain() -> None:
    """The stage begins far from rest, where a linear model tells of modes that grow by 31 % of critical."""
    scene, mass = Scene(name="loses its load"), 100e3
    oil = {"pump_pressure": 32e6, "rated_flow": 0.03, "rated_drop": 1e6, "gain": 0.05, "air": 0.002}
    oil |= {"makeup_flow": 0.02, "viscous_friction": 4e5}
    crane = scene.add_crane(
        base="ground", slew=-np.pi / 2.0, s1=2.0, s2=3.0, held=True,
        hydraulics={"main": oil, "knuckle": oil},
    )  # fmt: skip
    body, head = crane.tip
    scene.add_body(
        name="load", mass=mass, inertia=(2e4, 2e4, 2e4),
        position=scene.place_of(body=body, point=head) - np.array([0.0, 0.0, 15.0]),
    )  # fmt: skip
    scene.add_line(
        name="hoist", bodies=[body, "load"], points=[head, (0, 0, 0)], EA=1e9,
        tension_at_start=mass * scene.gravity,
    )  # fmt: skip
    scene.hold_pressures()
    stages = [Stage(name="hang", duration=1.0), Stage(name="lost", duration=60.0, release=["hoist"])]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        warnings.simplefilter("error", UnsteadyOilWarning)
        result = simulate_stages(scene, stages, dt_out=0.1, rtol=1e-5)
    stroke = result.select("hydraulic_stroke", hydraulic_cylinder="knuckle_cylinder")
    assert np.std(stroke[-50:]) < 0.1 * np.std(stroke[20:200])


def test_a_pendulum_that_a_valve_feeds_grows_as_told() -> None:
    """An A-frame's load: its swing grows by the told share of critical damping, 250 s apart."""
    scene = Scene(name="A-frame")
    oil = {"pump_pressure": 25e6, "rated_flow": 0.01, "rated_drop": 1e6, "gain": 2.0, "spool_lag": 0.03}
    scene.add_crane(
        load_crane("a_frame_40t"), base="ground", coordinates={"tilt": 0.5}, held=True, damping=False,
        payload=Payload(mass=15e3, size=(2.0, 2.0, 2.0), link_length=3.0),
        hydraulics={"tilt": oil | {"viscous_friction": 5e5}},
    )  # fmt: skip
    stands = float(scene.loads["cylinder"].reference.evaluate([0.0])[0, 0])
    pushed = Curve.quintic(start_time=0.0, end_time=1.0, start=stands, end=stands + 0.02)
    scene.replace("cylinder", kind="load", reference=pushed)
    with pytest.warns(UnsteadyOilWarning) as caught:
        result = simulate(scene, 300.0, dt_out=0.1, rtol=1e-6)
    told = str(caught[0].message)
    omega, share = (float(re.findall(pattern, told)[0]) for pattern in (r"mode of (\S+)", r"by (\S+) %"))
    swing = result.select("position", body="payload", axis="x")
    early, late = (float(np.std(swing[np.abs(result.time - at) < 25.0])) for at in (25.0, 275.0))
    assert late / early == pytest.approx(np.exp(0.01 * share * omega * 250.0), rel=0.15)
