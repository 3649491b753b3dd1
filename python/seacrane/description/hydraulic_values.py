"""What a hydraulic cylinder is made of, as values; pressures are absolute, the core checks the numbers."""

from __future__ import annotations

from typing import Any

from seacrane.inputs.values import value

NEVER = 1e7  # s


@value()
class Chamber:
    """The full side or the rod side of a cylinder.

    Attributes
    ----------
    pressure : float, optional
        Pa, at the start. Default: that which holds the scene at rest as described; the chamber that carries
        nothing has a tenth of the pump's pressure.
    hose_volume : float, optional
        m3, of oil beside the swept volume. Default: 5 % of the swept volume.
    """

    pressure: float | None = None
    hose_volume: float | None = None


@value("oil", "modulus", "density")
class Oil:
    """Oil, and what gives with it.

    Attributes
    ----------
    modulus, hose_modulus, cylinder_modulus : float
        Pa, of the oil, and of hoses and barrel by their volumes.
    density : float
        kg/m3, of what leaves through the hole of a hose that bursts.
    air : float
        Share of the volume that is free air at 1e5 Pa.
    vapour_pressure : float
        Pa, at which the oil boils and a void opens: an event, and a `BoilingOilWarning`.
    refuse_void : bool
        Whether a run ends with an error there.
    """

    modulus: float = 1.5e9
    hose_modulus: float = 1.5e8
    cylinder_modulus: float = 3.15e10
    density: float = 870.0
    air: float = 0.0
    vapour_pressure: float = 2e3
    refuse_void: bool = False


@value()
class Valve:
    """The valve whose spool opens the way from the pump and to the tank.

    Attributes
    ----------
    rated_flow, rated_flow_rod : float
        m3/s, of its open edges to the full side and to the rod side at `rated_drop`; 0: no valve, and the
        same.
    rated_drop, laminar_drop : float
        Pa, at which all flows of the cylinder are rated, and about which they turn from linear to a square
        root.
    overlap : float
        Share of the spool's travel before an edge opens.
    spool_lag : float
        s, of the spool behind its command; 0: it follows at once, and is no state.
    gain, rate_gain : float
        1/m and s/m: spool over the stroke that is missing to the reference, and over the reference's rate.
    """

    rated_flow: float = 0.0
    rated_flow_rod: float = 0.0
    rated_drop: float = 3.5e6
    laminar_drop: float = 2e5
    overlap: float = 0.0
    spool_lag: float = 4.547e-3
    gain: float = 0.0
    rate_gain: float = 0.0


@value("pump", "pressure", "check")
class Pump:
    """Where oil comes from, and goes to.

    Attributes
    ----------
    pressure, tank_pressure : float
        Pa; a pressure of 0: no pump.
    makeup_flow : float
        m3/s at `rated_drop`, of check valves from the tank; 0: none.
    check : bool
        Whether a check valve keeps oil from the pump.
    """

    pressure: float = 0.0
    tank_pressure: float = 1e5
    makeup_flow: float = 0.0
    check: bool = False


@value("relief")
class Relief:
    """Relief valves.

    Attributes
    ----------
    pressure, pressure_rod : float
        Pa, at which those of the full side and of the rod side open; 0: none.
    flow, override : float
        m3/s that one passes at that pressure (Pa) above its opening.
    """

    pressure: float = 0.0
    pressure_rod: float = 0.0
    flow: float = 0.0
    override: float = 1e6


@value("counterbalance", "pressure", "pressure_rod", "flow", "range")
class Counterbalance:
    """Load-holding valves.

    Attributes
    ----------
    pressure, pressure_rod : float
        Pa, at which those of the full side and of the rod side open without pilot; 0: none.
    flow, range : float
        m3/s of an open one at `rated_drop`; Pa from its opening to open.
    pilot_ratio : float
        Of the other side's pressure in its opening.
    """

    pressure: float = 0.0
    pressure_rod: float = 0.0
    flow: float = 0.0
    range: float = 5e6
    pilot_ratio: float = 4.0


@value("accumulator")
class Accumulator:
    """A gas accumulator on the full side.

    Attributes
    ----------
    volume, pressure : float
        m3 and Pa, of its gas without oil.
    flow : float
        m3/s through its throttle at `rated_drop`.
    exponent : float
        Of the gas law.
    """

    volume: float = 0.0
    pressure: float = 0.0
    flow: float = 0.0
    exponent: float = 1.4


@value()
class Piston:
    """What a piston and its seals do.

    Attributes
    ----------
    viscous_friction, friction, friction_speed : float
        N s/m; N, dry, and m/s, about which that changes its sign.
    internal_leakage, external_leakage : float
        m3/s/Pa, past the piston; from each side to the tank.
    stop_stiffness : float
        N/m, of the ends of the stroke.
    """

    viscous_friction: float = 0.0
    friction: float = 0.0
    friction_speed: float = 0.01
    internal_leakage: float = 0.0
    external_leakage: float = 0.0
    stop_stiffness: float = 1e9


@value("rupture", "time", "area", rod_side="rod_side_ruptures")
class Rupture:
    """A hose that bursts.

    Attributes
    ----------
    time, area : float
        s; m2, of the hole.
    rod_side : bool
        In place of the full side.
    discharge_coefficient : float
        Of the hole.
    """

    time: float = NEVER
    area: float = 0.0
    rod_side: bool = False
    discharge_coefficient: float = 0.6


VALUES: dict[str, type[Any]] = {
    "chamber": Chamber, "rod_chamber": Chamber, "oil": Oil, "valve": Valve, "pump": Pump, "relief": Relief,
    "counterbalance": Counterbalance, "accumulator": Accumulator, "piston": Piston, "rupture": Rupture,
}  # fmt: skip
