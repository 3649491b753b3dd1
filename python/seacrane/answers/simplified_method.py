"""The simplified method of DNV-RP-N103 for the splash zone, draught by draught, beside what was simulated."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import exp, hypot, pi, sqrt

from seacrane.answers.code_factors import Beside, ratio_of, simulated_of
from seacrane.description.description import STANDARD_GRAVITY
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, not_negative_of, positive_of
from seacrane.inputs.keywords import named
from seacrane.inputs.values import listed_of
from seacrane.plotting.table import Table

SEA_WATER = 1025.0  # kg/m3
SOURCE = "DNV-RP-N103 ch. 4, as others quote it: unverified"
LEAST = 0.1  # of the static force, by the rule for slack
AMPLITUDE = 0.9  # of the wave, over Hs


@named
@dataclass(frozen=True, kw_only=True)
class Draught:
    """A load at one draught: what of it the water meets.

    Attributes
    ----------
    name : str
    depth : float
        Of the centre of what is wet, m.
    volume, added_mass : float
        Displaced, m3; vertical, kg.
    drag_area, slam_area : float
        C_D A and C_S A, m2: of what the water flows past, and of what strikes the surface at this draught.
    water_plane : float
        That cuts the surface, m2.
    """

    name: str
    depth: float = 0.0
    volume: float = 0.0
    added_mass: float = 0.0
    drag_area: float = 0.0
    slam_area: float = 0.0
    water_plane: float = 0.0

    def __post_init__(self) -> None:
        name_of("draught", self.name)
        for key in ("depth", "volume", "added_mass", "drag_area", "slam_area", "water_plane"):
            not_negative_of(f"draught {self.name!r}: {key}", getattr(self, key))


@dataclass(frozen=True, kw_only=True)
class DraughtRow:
    """Forces of the simplified method at one draught, N.

    Attributes
    ----------
    static : Weight less buoyancy.
    drag, slam, inertia, buoyancy : Of the waves and the tip.
    hydrodynamic : sqrt((drag + slam)^2 + (inertia - buoyancy)^2).
    margin : 1 - hydrodynamic / static: below a tenth the hoist counts as slack.
    simulated : The least slack margin of a simulation, or NaN.
    snap : From slack, v sqrt(k (m + A)), where a stiffness was given and the hoist counts as slack; or NaN.
    """

    name: str
    static: float
    drag: float
    slam: float
    inertia: float
    buoyancy: float
    hydrodynamic: float
    snap: float = float("nan")
    simulated: float = float("nan")

    @property
    def margin(self) -> float:
        return 1.0 - self.hydrodynamic / self.static

    @property
    def dynamic_factor(self) -> float:
        """Static and hydrodynamic force, over the static one."""
        return 1.0 + self.hydrodynamic / self.static

    @property
    def ratio(self) -> float:
        """What the water takes by the simulation, 1 - margin, over that by the method."""
        return ratio_of((1.0 - self.simulated) * self.static, self.hydrodynamic)


@dataclass(frozen=True, kw_only=True, repr=False)
class SimplifiedMethod(Beside[DraughtRow]):
    """Forces by draught. Made by `simplified_method`; prints as a table."""

    what, what_of_run = "METHOD", "minimum"

    def _shown(self) -> Table:
        forces = ("static", "drag", "slam", "inertia", "buoyancy", "hydrodynamic", "snap")
        columns = [self.column(name, unit="N") for name in forces]
        columns += [
            self.column("margin", form=".2f"), self.column("dynamic_factor", head="factor", form=".2f"),
            self.column("simulated", form=".2f"),
        ]  # fmt: skip
        remarks = [f"A margin below {LEAST:g} is slack; the ratio is of 1 - margin. {SOURCE}."]
        return self._beside(self.names("draught"), *columns, self._ratio(), remarks=remarks)


@named
def simplified_method(
    *,
    mass: float,
    draughts: Sequence[Draught],
    hs: float,
    tz: float,
    lowering_speed: float,
    tip_heave: float = 0.0,
    tip_speed: float = 0.0,
    tip_acceleration: float = 0.0,
    stiffness: float | None = None,
    density: float = SEA_WATER,
    simulated: Mapping[str, float] | None = None,
) -> SimplifiedMethod:
    """Forces on a load that is lowered through the waves, by the simplified method.

    The text could not be read: formulas are as others quote them. The wave has the amplitude 0.9 Hs and the
    period Tz. Speeds and accelerations of water and tip add as squares, in and out of phase.

    Parameters
    ----------
    mass : float
        Of the load and what hangs with it, kg, in air.
    draughts : sequence of Draught
    hs, tz : float
        m, and the zero-crossing period, s.
    lowering_speed : float
        Of the hook, m/s.
    tip_heave, tip_speed, tip_acceleration : float
        Largest vertical motion of the crane's tip, m, m/s, m/s2.
    stiffness : float, optional
        Vertical at the hook, N/m, for the snap force.
    density : float
        Of the water, kg/m3.
    simulated : mapping of str to float, optional
        By draught the least slack margin of simulations.

    Raises
    ------
    SceneError
        For values that make no sense, or a load that floats.
    """
    m, rho = positive_of("mass", mass, "kg"), positive_of("density", density, "kg/m3")
    omega = 2.0 * pi / positive_of("tz", tz, "s")
    wave = AMPLITUDE * not_negative_of("hs", hs, "m")
    rate = not_negative_of("lowering_speed", lowering_speed, "m/s")
    heave, v_t, a_t = (
        not_negative_of(name, one)
        for name, one in (
            ("tip_heave", tip_heave), ("tip_speed", tip_speed), ("tip_acceleration", tip_acceleration)
        )
    )  # fmt: skip
    k = None if stiffness is None else positive_of("stiffness", stiffness, "N/m")
    listed = listed_of("simplified_method: draughts", Draught, draughts)
    beside, rows = simulated_of("draught", simulated, [one.name for one in listed]), []
    for one in listed:
        static = (m - rho * one.volume) * STANDARD_GRAVITY
        if static <= 0.0:
            raise SceneError(f"draught {one.name!r}: the load floats; its volume is {one.volume:g} m3")
        v_w = wave * omega * exp(-omega * omega / STANDARD_GRAVITY * one.depth)
        speed = rate + hypot(v_t, v_w)
        slam, drag = (0.5 * rho * area * speed * speed for area in (one.slam_area, one.drag_area))
        inertia = hypot((m + one.added_mass) * a_t, (rho * one.volume + one.added_mass) * omega * v_w)
        buoyancy = rho * STANDARD_GRAVITY * one.water_plane * hypot(wave, heave)
        force = hypot(drag + slam, inertia - buoyancy)
        slack = k is not None and force > (1.0 - LEAST) * static
        snap = speed * sqrt((k or 0.0) * (m + one.added_mass)) if slack else float("nan")
        rows.append(DraughtRow(
            name=one.name, static=static, drag=drag, slam=slam, inertia=inertia, buoyancy=buoyancy,
            hydrodynamic=force, snap=snap, simulated=beside[one.name],
        ))  # fmt: skip
    return SimplifiedMethod(rows=tuple(rows), title=f"Simplified method, Hs {hs:g} m, Tz {tz:.3g} s")
