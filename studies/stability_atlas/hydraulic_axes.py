"""Axes of hydraulic cylinders: pressure, valve, volume of the lines, spool, oil and hole of a burst hose."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from seacrane import Scene, _core
from seacrane.accuracy.case import Case
from seacrane.scene import Chamber, Oil, Piston, Pump, Rupture, Valve
from stability_atlas.axis import Axis

MASS, RETRACTED, STROKE = 1000.0, 1.05, 0.6  # kg, m
FULL, RING = np.pi / 4.0 * 0.08**2, np.pi / 4.0 * (0.08**2 - 0.035**2)  # m2
SUPPLY, FLOW = 7.6e6, 4e-4  # Pa, m3/s at the rated drop
HOSES = 31.4e-6, 78.5e-6  # m3
PUMP, VALVE = Pump(pressure=SUPPLY), Valve(rated_flow=FLOW, spool_lag=0.01)
NEAR = 1e-3  # m


def _on_oil(*, stands: float = 0.3, **cylinder: Any) -> Scene:
    """1 t on a vertical cylinder that stands at a stroke, m; its valve lifts and lowers it gently."""
    scene = Scene(name="load on a cylinder")
    inertia = np.full(3, MASS / 50.0)
    scene.add_body(name="load", mass=MASS, inertia=inertia, position=(0.0, 0.0, RETRACTED + stands))
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="load", point=(0, 0, 0), axis=(0, 0, 1)
    )
    settings: dict[str, Any] = {
        "full_area": FULL, "rod_side_area": RING, "retracted_length": RETRACTED, "stroke": STROKE,
        "valve": VALVE, "pump": PUMP, "piston": Piston(viscous_friction=2e4),
        "rod_chamber": Chamber(hose_volume=HOSES[1]), "chamber": Chamber(hose_volume=HOSES[0]),
        "command": _core.Curve.harmonic(amplitude=0.2, omega=3.0),
    }  # fmt: skip
    scene.add_hydraulic_cylinder(name="ram", first="ground", second="load", **settings | cylinder)
    return scene


def _pressure(rod_side: float) -> Case:
    """A rod side that starts at this pressure, at which oil boils from 2 kPa down."""
    return Case(
        scene=_on_oil(rod_chamber=Chamber(pressure=rod_side, hose_volume=HOSES[1])), t_end=3.0, dt_out=0.05
    )


def _boiling(share: float) -> Case:
    """A load that falls onto its closed rod side's vacuum as the hose bursts; a share of the oil is air."""
    return Case(
        scene=_on_oil(command=0.0, oil=Oil(air=share), rupture=Rupture(time=0.5, area=4e-6)),
        t_end=2.0,
        dt_out=0.05,
    )


def _valve(within: float) -> Case:
    """A load that is being lifted when its valve closes within this time."""
    lift = _core.Curve.quintic(start_time=0.0, end_time=0.4, start=0.0, end=0.6)
    shut = _core.Curve.quintic(start_time=1.0, end_time=1.0 + within, start=0.6, end=0.0)
    closing = _on_oil(command=lift.then(time=1.0, curve=shut), valve=replace(VALVE, spool_lag=0.0))
    return Case(scene=closing, t_end=1.5, dt_out=0.02)


def _volume(share: float) -> Case:
    """Lines of this share of the swept volume, at 1 mm from the end of the stroke."""
    full, ring = (Chamber(hose_volume=share * area * STROKE) for area in (FULL, RING))
    move = _core.Curve.quintic(start_time=0.1, end_time=0.5, start=0.0, end=0.3)
    return Case(
        scene=_on_oil(stands=NEAR, command=move, chamber=full, rod_chamber=ring), t_end=1.0, dt_out=0.02
    )


def _lag(lag: float) -> Case:
    return Case(scene=_on_oil(valve=replace(VALVE, spool_lag=lag)), t_end=3.0, dt_out=0.05)


def _modulus(modulus: float) -> Case:
    """Oil, hoses and barrel of one bulk modulus: to the ideal cylinder."""
    oil = Oil(modulus=modulus, hose_modulus=modulus, cylinder_modulus=modulus)
    return Case(scene=_on_oil(oil=oil), t_end=3.0, dt_out=0.05)


def _hole(diameter: float) -> Case:
    """A hose that bursts by a hole of this diameter; check valves fill the rod side."""
    burst = Rupture(time=0.5, area=np.pi / 4.0 * diameter**2)
    oil = _on_oil(command=0.0, pump=replace(PUMP, makeup_flow=FLOW), rupture=burst)
    return Case(scene=oil, t_end=2.0, dt_out=0.02)


AXES = (
    Axis(name="oil-pressure", title="A cylinder whose rod side starts near a vacuum", label="pressure [Pa]",
         values=(-1e5, 0.0, 1.0, 1e2, 2e3, 1e4, 1e5, 1e6, 7e6), quick=(0.0, 2e3, 1e6), case=_pressure),
    Axis(name="oil-air", title="Oil that boils under a burst hose", label="share of air",
         values=(0.0, 1e-6, 1e-4, 1e-2, 0.1), quick=(1e-2,), case=_boiling),
    Axis(name="oil-valve", title="A valve that closes on a moving load", label="within [s]",
         values=(1e-4, 1e-3, 1e-2, 0.1, 0.4), quick=(1e-3,), case=_valve),
    Axis(name="oil-volume", title="Lines of little volume", label="over the swept volume",
         values=(0.0, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1.0), quick=(0.0, 1e-3), case=_volume),
    Axis(name="oil-lag", title="A spool that follows late", label="lag [s]",
         values=(0.0, 1e-4, 1e-3, 1e-2, 0.1, 1.0), quick=(1e-2,), case=_lag),
    Axis(name="oil-modulus", title="From foam to steel", label="bulk modulus [Pa]",
         values=(1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13), quick=(1e9,), case=_modulus),
    Axis(name="oil-hole", title="A hose that bursts", label="diameter [m]",
         values=(1e-4, 1e-3, 3e-3, 1e-2, 3e-2), quick=(3e-3,), case=_hole),
)  # fmt: skip
