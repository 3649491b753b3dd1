"""Scripts of docs/mistakes.md with a value in another unit, and of records and tables that no ship has."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

import seacrane
from seacrane import Curve, Scene, Stage, Until, simulate, simulate_stages

MASS, G, AREA = 2e4, 9.80665, 0.02


def hung(line: Mapping[str, Any] | None = None, **winch: Any) -> None:
    scene = Scene(name="hoist")
    scene.add_body(name="load", mass=MASS, inertia=(MASS,) * 3, position=(0, 0, -15))
    given = {"EA": 5e7, "tension_at_start": MASS * G} | dict(line or {})
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), **given)
    if winch:
        scene.add_winch(line="wire", **winch)
    simulate(scene, t_end=0.2)


def raised(**oil: Any) -> None:
    scene = Scene(name="ram")
    scene.add_body(name="load", mass=MASS, inertia=(MASS,) * 3, position=(0, 0, 1.5))
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="load", axis=(0, 0, 1), point=(0, 0, 0)
    )
    given = {"full_area": AREA, "rod_side_area": 0.6 * AREA, "retracted_length": 1.0, "stroke": 1.0,
             "pump_pressure": 20e6, "rated_flow": 2e-3, "command": 0.2}  # fmt: skip
    scene.add_hydraulic_cylinder(name="ram", first="ground", second="load", **given | oil)
    simulate(scene, t_end=0.2)


def on_gas(pressure: float, volume: float) -> None:
    scene = Scene(name="passive compensator")
    scene.add_body(name="load", mass=MASS, inertia=(MASS,) * 3, position=(0, 0, -10))
    scene.add_gas_spring(
        name="gas", first="ground", second="load", area=0.05, pressure=pressure, volume=volume
    )
    simulate(scene, t_end=0.2)


def record(heave: float, noise: float = 0.0) -> seacrane.MotionHistory:
    time = np.linspace(0.0, 60.0, 601)
    motion = np.zeros((601, 6))
    motion[:, 2] = heave * np.sin(0.7 * time) + noise * np.random.default_rng(0).normal(size=601)
    return seacrane.MotionHistory(time=time, motion=motion)


def raos(turned: Callable[[Any], Any]) -> seacrane.MotionRaos:
    """Of a hull that follows long waves, with its phases as a table would hold them."""
    omega, heading = np.array([0.3, 0.6, 1.0]), np.array([0.0, np.pi / 2, np.pi])
    values = np.zeros((3, 3, 6), dtype=complex)
    values[:, :, 2] = np.exp(-1j * np.radians(3.0))
    values[:, :, 4] = 1j * omega**2 / 9.81 * np.cos(heading)[:, None]
    return seacrane.MotionRaos(omega=omega, heading=heading, values=turned(values))


def phases_in_degrees() -> None:
    raos(lambda values: np.abs(values) * np.exp(1j * np.degrees(np.angle(values))))


def phases_of_the_other_sign() -> None:
    raos(np.conj)


def lift_off_too_slowly() -> None:
    """A load lifted by a slow winch off a barge that heaves."""
    scene = Scene(name="deck")
    scene.add_body(name="barge", mass=1e6, inertia=(1e8,) * 3)
    scene.add_joint(kind="prismatic", name="heave", first="ground", second="barge", axis=(0, 0, 1))
    wave = Curve.harmonic(start_time=0.0, offset=0.0, amplitude=0.8, omega=0.8, phase=-np.pi / 2)
    scene.add_driver(joint="heave", curve=wave)
    scene.add_body(name="load", mass=30e3, inertia=(5e4,) * 3, position=(0, 0, 2.0))
    scene.add_joint(kind="weld", name="on deck", first="barge", second="load")
    scene.add_seat(joint="on deck")
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 40.0), (0, 0, 0)], EA=1e8,
                   length=38.5)  # fmt: skip
    scene.add_winch(line="hoist", lag=0.2)
    lift = Stage(
        name="lift", until=Until.release("on deck"), maximum_duration=60.0, commands={"hoist.rate": -0.05}
    )
    simulate_stages(scene, [lift, Stage(name="raised", duration=10.0)], dt_out=0.1)


def on_deck(**surface: Any) -> None:
    """A load on a deck whose surface is not where its feet are."""
    scene = Scene(name="deck")
    scene.add_body(name="load", mass=30e3, inertia=(5e4,) * 3, position=(0, 0, 3.0))
    scene.add_contact("load", on="ground", points=[(-1, 0, -1.0), (1, 0, -1.0)], **surface)
    simulate(scene, t_end=1.0)


SCRIPTS: dict[str, list[Callable[[], None]]] = {
    "EA in kilonewtons": [lambda: hung({"EA": 5e4})],
    "times in milliseconds": [
        lambda: hung(rate=-0.3, lag=200.0),
        lambda: hung({"settling": 200.0, "rung": "quasi-static"}),
        lambda: raised(spool_lag=4.5),
    ],
    "lengths and speeds in millimetres": [
        lambda: hung(lag=0.2, drum_inertia=1e3, drum_radius=500.0),
        lambda: hung(rate=100.0, lag=0.2),
        lambda: raised(rupture_time=1.0, rupture_area=300.0),
    ],
    "pressures in bar": [
        lambda: raised(counterbalance_pressure=250.0, counterbalance_flow=0.01),
        lambda: on_gas(pressure=39.2, volume=0.1),
    ],
    "volumes in litres": [
        lambda: raised(accumulator_volume=20.0, accumulator_pressure=8e6, accumulator_flow=0.01),
        lambda: on_gas(pressure=39.2e5, volume=100.0),
    ],
    "percentages for shares": [lambda: hung({"damping_ratio": 2.0}), lambda: raised(command=30.0)],
    "a heave in centimetres": [lambda: record(150.0) and None],
    "a record with noise": [lambda: record(1.5, noise=5e-3) and None],
    "phases of the other sign, or in degrees": [phases_of_the_other_sign, phases_in_degrees],
    "a load that comes back to its deck": [lift_off_too_slowly],
    "a deck upside down, or above the feet": [
        lambda: on_deck(axis=(0, 0, -1), place=(0, 0, 1.0)),
        lambda: on_deck(place=(0, 0, 2.8)),
    ],
}
