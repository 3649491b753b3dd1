"""Hydraulic cylinders against an independent solver, closed forms, and Exudyn's as peers/ recorded it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from hydraulic_scenes import FULL, MASS, RING, SET, STROKE, lifted, own_solution, raised
from measure.table import read
from multibody_runs import record
from numpy.typing import NDArray
from peers import exudyn_hydraulics as peer

from seacrane import Scene, natural_modes
from seacrane.scene import Chamber, Oil, Piston, Pump, Valve

from .row import Row

Array = NDArray[np.float64]
SUBJECT, TEST = "Hydraulic cylinders", "cranes/test_hydraulics.py"


def hung() -> Scene:
    """The scene of the peer."""
    scene = Scene(name="hung", gravity=peer.GRAVITY)
    place = (0.0, 0.0, -peer.LENGTH)
    scene.add_body(name="load", mass=peer.MASS, inertia=(10.0, 10.0, 10.0), position=place)
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="load", point=(0, 0, 0), axis=(0, 0, 1)
    )
    scene.add_hydraulic_cylinder(
        name="ram", first="ground", second="load", full_area=peer.FULL, rod_side_area=peer.RING,
        retracted_length=peer.OFFSET, stroke=peer.STROKE, command=peer.OPENING,
        chamber=Chamber(pressure=peer.START[0], hose_volume=peer.HOSES[0]),
        rod_chamber=Chamber(pressure=peer.START[1], hose_volume=peer.HOSES[1]),
        oil=Oil(modulus=peer.OIL, cylinder_modulus=peer.CYLINDER, hose_modulus=peer.HOSE),
        valve=Valve(rated_flow=peer.CONDUCTANCE, rated_drop=1.0, laminar_drop=1.0),
        piston=Piston(viscous_friction=peer.DAMPING),
        pump=Pump(pressure=peer.SUPPLY, tank_pressure=peer.TANK),
    )  # fmt: skip
    return scene


def recorded(path: Path = peer.RESULT) -> Array:
    """Rows of the peer: time, length, speed, pressures."""
    return np.array(read(path)[1], dtype=float)


def exudyn(rows: Array | None = None) -> Iterator[Row]:
    """A mass that an open valve lifts, for 1 s."""
    theirs = recorded() if rows is None else rows
    ours = record(hung(), peer.T_END, dt_out=peer.EVERY, rtol=1e-11)
    found = {
        "length": (ours["hydraulic_stroke"][:, 0] + peer.OFFSET - theirs[:, 1], "m", 1e-8),
        "speed": (ours["velocity"][:, 0, 2] - theirs[:, 2], "m/s", 1e-6),
        "pressures over the pump's": (
            (ours["hydraulic_pressure"][:, 0] - theirs[:, 3:]) / peer.SUPPLY, "", 1e-6
        ),
    }  # fmt: skip
    for what, (difference, unit, limit) in found.items():
        yield Row(
            subject=SUBJECT, compared=f"a mass lifted through an open valve, 1 s: {what}",
            reference="hydraulic actuator of Exudyn", difference=float(np.abs(difference).max()), unit=unit,
            limit=limit, test="lines/test_exudyn_peer.py",
        )  # fmt: skip


def solver() -> Iterator[Row]:
    """The complete parameter set through a lift and a descent."""
    scene = lifted()
    ram = scene.loads["ram"]
    out = record(scene, 1.8, dt_out=0.02, rtol=1e-9)
    s, v, p1, p2, u = own_solution(out["time"], (ram.pressure, ram.pressure_rod))
    pressures = out["hydraulic_pressure"][:, 0] - np.column_stack([p1, p2])
    for what, difference, unit in (
        ("stroke over the largest", (out["hydraulic_stroke"][:, 0] - s) / STROKE, ""),
        ("speed", out["velocity"][:, 0, 2] - v, "m/s"),
        ("pressures over the pump's", pressures / SET["pump_pressure"], ""),
        ("spool", out["hydraulic_spool"][:, 0] - u, ""),
        ("energy over work", out["energy_balance"] / out["absolute_work"][-1], ""),
    ):
        yield Row(
            subject=SUBJECT, compared=f"lift and descent on the complete parameter set: {what}",
            reference="its equations, by SciPy's Radau" if "energy" not in what else "conservation",
            difference=float(np.abs(difference).max()), unit=unit, limit=1e-6, test=TEST,
        )  # fmt: skip


def closed_forms() -> Iterator[Row]:
    """The natural frequency of closed chambers."""
    worst = 0.0
    for stroke in (0.1, 0.3, 0.5):
        stiffness = sum(
            area**2
            / (
                (swept + hose) / SET["oil_modulus"]
                + swept / SET["cylinder_modulus"]
                + hose / SET["hose_modulus"]
            )
            for area, swept, hose in (
                (FULL, FULL * stroke, SET["hose_volume"]),
                (RING, RING * (STROKE - stroke), SET["hose_volume_rod"]),
            )
        )
        modes = natural_modes(raised(piston=Piston(), retracted_length=1.35 - stroke))
        expected = 2.0 * np.pi / np.sqrt(stiffness / MASS)
        worst = max(worst, float(np.min(np.abs(modes.natural_period / expected - 1.0))))
    yield Row(
        subject=SUBJECT, compared="natural period on closed chambers, three strokes", reference="closed form",
        difference=worst, unit="", limit=1e-6, test=TEST,
    )  # fmt: skip
