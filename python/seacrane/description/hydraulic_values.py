"""What a hydraulic cylinder is made of, as values; pressures are absolute, the core checks the numbers."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.inputs.values import value

NEVER = 1e7  # s


@value(_core.HydraulicCylinder)
class Chamber:
    """The full side or the rod side of a cylinder.

    Without a pressure it has that which holds the scene at rest as described, a tenth of the pump's where it
    carries nothing. Without a hose volume it has 5 % of the swept volume.
    """

    pressure: float | None = None  # Pa
    hose_volume: float | None = None  # m3


@value(_core.HydraulicCylinder, "oil", "modulus", "density")
class Oil:
    """Oil, and what gives with it. Where it boils is an event, and a `BoilingOilWarning`."""

    modulus: float = 1.5e9  # Pa
    hose_modulus: float = 1.5e8  # Pa
    cylinder_modulus: float = 3.15e10  # Pa
    density: float = 870.0  # kg/m3
    air: float = 0.0
    vapour_pressure: float = 2e3  # Pa
    refuse_void: bool = False


@value(_core.HydraulicCylinder)
class Valve:
    """The valve whose spool opens the way from pump and to tank; without a rated flow there is none."""

    rated_flow: float = 0.0  # m3/s
    rated_flow_rod: float = 0.0  # m3/s
    rated_drop: float = 3.5e6  # Pa
    laminar_drop: float = 2e5  # Pa
    overlap: float = 0.0
    spool_lag: float = 4.547e-3  # s
    gain: float = 0.0  # 1/m
    rate_gain: float = 0.0  # s/m


@value(_core.HydraulicCylinder, "pump", "pressure", "check")
class Pump:
    """Where oil comes from, and goes to."""

    pressure: float = 0.0  # Pa
    tank_pressure: float = 1e5  # Pa
    makeup_flow: float = 0.0  # m3/s
    check: bool = False


@value(_core.HydraulicCylinder, "relief")
class Relief:
    """Relief valves."""

    pressure: float = 0.0  # Pa
    pressure_rod: float = 0.0  # Pa
    flow: float = 0.0  # m3/s
    override: float = 1e6  # Pa


@value(_core.HydraulicCylinder, "counterbalance", "pressure", "pressure_rod", "flow", "range")
class Counterbalance:
    """Load-holding valves."""

    pressure: float = 0.0  # Pa
    pressure_rod: float = 0.0  # Pa
    flow: float = 0.0  # m3/s
    range: float = 5e6  # Pa
    pilot_ratio: float = 4.0


@value(_core.HydraulicCylinder, "accumulator")
class Accumulator:
    """A gas accumulator on the full side."""

    volume: float = 0.0  # m3
    pressure: float = 0.0  # Pa
    flow: float = 0.0  # m3/s
    exponent: float = 1.4


@value(_core.HydraulicCylinder)
class Piston:
    """What a piston and its seals do."""

    viscous_friction: float = 0.0  # N s/m
    friction: float = 0.0  # N
    friction_speed: float = 0.01  # m/s
    internal_leakage: float = 0.0  # m3/s/Pa
    external_leakage: float = 0.0  # m3/s/Pa
    stop_stiffness: float = 1e9  # N/m


@value(_core.HydraulicCylinder, "rupture", "time", "area", rod_side="rod_side_ruptures")
class Rupture:
    """A hose that bursts."""

    time: float = NEVER  # s
    area: float = 0.0  # m2
    rod_side: bool = False
    discharge_coefficient: float = 0.6


VALUES: dict[str, type[Any]] = {
    "chamber": Chamber, "rod_chamber": Chamber, "oil": Oil, "valve": Valve, "pump": Pump, "relief": Relief,
    "counterbalance": Counterbalance, "accumulator": Accumulator, "piston": Piston, "rupture": Rupture,
}  # fmt: skip
