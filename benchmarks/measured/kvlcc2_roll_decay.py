"""Roll decay of a tanker model without bilge keels, without speed (SSPA 2018)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from measured_numbers import columns
from measured_row import Array, MeasuredRow, Source
from scipy.optimize import brentq
from scipy.special import gamma

from seacrane import Scene, simulate
from seacrane.description.loads import changed
from seacrane.hydro import (
    Hull,
    HydroDatabase,
    MainParticulars,
    OffsetTable,
    hydro_from_hull,
    ikeda_roll_damping,
    section_eddy_damping,
)

SOURCE = Source(
    title="Roll decay of a tanker",
    repository=(
        "martinlarsalbert/Prediction-of-roll-motion-using-fully-nonlinear-potential-flow-and-Ikedas-method"
    ),
    commit="cce8abde16a15a2ae45008e48b1bba9f4aeaaad4",
    licence="MIT; data CC BY 4.0",
    about="towing tank: roll decay of the KVLCC2 at 1:68, Alexandersson (2021), SSPA test 21338",
)
SCALE = 68.0
LENGTH, BREADTH, DRAUGHT, VOLUME = 320.0 / SCALE, 58.0 / SCALE, 20.8 / SCALE, 312653.0 / SCALE**3
HEIGHT_OF_GRAVITY, GYRATION, METACENTRIC = 18.6 / SCALE, 23.2 / SCALE, 5.73 / SCALE
RHO, G, VISCOSITY = 1000.0, 9.81, 1.0e-6  # fresh water at 20 deg C: the tank's temperature is not told
FULLEST = 0.99  # midship coefficient where the simple formulas end; the hull has 0.995
OMEGA = np.array([0.75, 1.25, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.5, 4.0, 4.5, 5.0, 6.0, 7.0])
AMPLITUDE = 7.0  # deg, at which damping is taken, and at half of it
JUDGED = (5.0, 9.0)  # deg
AMPLITUDES, BIN = np.arange(1.5, 9.6, 0.5), 0.5  # deg
ROLL = 3


def rows(folder: Path) -> Iterator[MeasuredRow]:
    tank = columns(folder / "peaks.csv")
    omega = 2.0 * np.pi / float(by_amplitude(tank["time_s"], np.abs(tank["roll_rad"]))["period"].mean())
    panels, strips = HydroDatabase.load(Path(__file__).with_suffix(".nc")), tanker_database(folder, "strip")
    simple, whole = viscous(folder, omega, of_sections=False), viscous(folder, omega, of_sections=True)
    for by, database, judged in (
        ("Ikeda's simple formulas, waves by panels", panels.with_roll_damping(**simple), 0.25),
        ("Ikeda's simple formulas, waves by strips", strips.with_roll_damping(**simple), 0.25),
        ("Ikeda section by section, waves by panels", panels.with_roll_damping(**whole), None),
        ("waves by panels alone", panels, None),
    ):
        yield from _compared(by, database, tank, judged)


def tanker(folder: Path) -> Hull:
    """At model scale, about its centre of buoyancy; superellipses of each breadth, draught and area."""
    told = columns(folder / "sections.csv", ";")
    sections = [
        _half(b / SCALE, t / SCALE, area / (b * t))
        for b, t, area in zip(told["b"], told["t"], told["area"], strict=True)
    ]
    table = OffsetTable(x=told["x"] / SCALE, sections=tuple(sections), name="tanker model")
    return Hull.from_offsets(table).at_centre_of_buoyancy()


def _half(breadth: float, draught: float, area: float) -> list[tuple[float, float]]:
    """Points of (2 y / B)^n + (z / T)^n = 1 whose n gives the area, from deck to keel."""

    def share(n: float) -> float:
        return float(gamma(1.0 + 1.0 / n) ** 2 / gamma(1.0 + 2.0 / n))

    n = brentq(lambda n: share(n) - area, 0.2, 500.0)
    turn = 0.5 * np.pi * np.arange(1, 24) / 24
    inner = [(0.5 * breadth * np.cos(a) ** (2.0 / n), -draught * np.sin(a) ** (2.0 / n)) for a in turn]
    return [(0.5 * breadth, 0.05), (0.5 * breadth, 0.0), *inner, (0.0, -draught)]


def tanker_database(folder: Path, method: Any) -> HydroDatabase:
    """About the hull's centre of buoyancy, with the tank's mass, centre of gravity and roll radius."""
    hull, omega = tanker(folder), np.arange(0.75, 8.01, 0.25)
    if method == "capytaine":
        hull, omega = hull.remeshed(stations=36, girth=11), OMEGA
    return hydro_from_hull(
        hull, method=method, omega=omega, heading=[0.5 * np.pi], rho=RHO, g=G, mass=VOLUME * RHO,
        center_of_gravity=[0.0, 0.0, HEIGHT_OF_GRAVITY - DRAUGHT],
        radii_of_gyration=[GYRATION, 0.25 * LENGTH, 0.25 * LENGTH],
        trusted_band=(float(omega[0]), float(omega[-1])),  # also where strips do not vouch
    )  # fmt: skip


def viscous(folder: Path, omega: float, *, of_sections: bool) -> dict[str, float]:
    """Linear and quadratic roll damping beside waves; eddies by the simple formulas, or of each section."""
    ship = MainParticulars(
        length=LENGTH, breadth=BREADTH, draught=DRAUGHT,
        block_coefficient=VOLUME / (LENGTH * BREADTH * DRAUGHT), midship_coefficient=FULLEST,
    )  # fmt: skip
    found = ikeda_roll_damping(
        ship, amplitude_deg=AMPLITUDE, omega=omega, axis_height=HEIGHT_OF_GRAVITY - DRAUGHT, rho=RHO, g=G,
        viscosity=VISCOSITY,
    )  # fmt: skip
    more = _section_eddies(folder, omega) - found.eddy if of_sections else 0.0
    per_rate = 8.0 / (3.0 * np.pi) * omega * np.radians(AMPLITUDE)  # eddies grow with the amplitude
    return {"linear": found.linear, "quadratic": found.quadratic + more / per_rate}


def _section_eddies(folder: Path, omega: float) -> float:
    """N m s/rad at `AMPLITUDE`; sections whose keel is above the roll axis count as if it lay at theirs."""
    told = columns(folder / "sections.csv", ";")
    depth = DRAUGHT - HEIGHT_OF_GRAVITY
    each = []
    for b, t, area in zip(told["b"] / SCALE, told["t"] / SCALE, told["area"] / SCALE**2, strict=True):
        deep = min(depth, 0.5 * t * area / (b * t))
        each.append(
            section_eddy_damping(
                breadth=b, draught=t, area_coefficient=area / (b * t), amplitude_deg=AMPLITUDE, omega=omega,
                axis_height=-deep, rho=RHO,
            )
        )  # fmt: skip
    return float(np.trapezoid(each, told["x"] / SCALE))


def decay(database: HydroDatabase, start: float, t_end: float) -> tuple[Array, Array]:
    """Time and roll (rad) from rest at an angle about the centre of gravity; sway and yaw are free."""
    restoring = np.array(database.restoring)
    restoring[ROLL, ROLL] = RHO * VOLUME * G * METACENTRIC
    database = replace(database, restoring=restoring).at([0.0, 0.0, HEIGHT_OF_GRAVITY - DRAUGHT])
    scene = Scene(name="roll decay", gravity=G)
    scene.add_vessel(database, mooring=None)
    turned = (np.cos(0.5 * start), np.sin(0.5 * start), 0.0, 0.0)
    scene.bodies["vessel"] = changed(scene.bodies["vessel"], quaternion=turned)
    result = simulate(scene, t_end=t_end, dt_out=0.01)
    return result.time, result["vessel_motion"][:, ROLL]


def extremes(time: Array, roll: Array) -> tuple[Array, Array]:
    """Times and angles of all extremes after the start, by parabolas."""
    size = np.abs(roll)
    at = np.flatnonzero((size[1:-1] > size[:-2]) & (size[1:-1] >= size[2:])) + 1
    before, top, after = size[at - 1], size[at], size[at + 1]
    bend = 2.0 * top - before - after
    step = time[1] - time[0]
    return time[at] + 0.5 * step * (after - before) / bend, top + (after - before) ** 2 / (8.0 * bend)


def by_amplitude(times: Array, sizes: Array) -> dict[str, Array]:
    """Damping ratio and period (s) of each whole cycle, means of `BIN` deg about `AMPLITUDES`."""
    ratio = np.log(sizes[:-2] / sizes[2:]) / (2.0 * np.pi)
    period, middle = times[2:] - times[:-2], np.degrees(sizes[1:-1])
    inside = [np.abs(middle - one) <= 0.5 * BIN for one in AMPLITUDES]
    kept = [one for one in inside if one.any()]
    return {
        "at": np.array([a for a, one in zip(AMPLITUDES, inside, strict=True) if one.any()]),
        "ratio": np.array([ratio[one].mean() for one in kept]),
        "spread": np.array([ratio[one].std() for one in kept]),
        "period": np.array([period[one].mean() for one in kept]),
    }


def _compared(
    by: str, database: HydroDatabase, tank: dict[str, Array], expected: float | None
) -> Iterator[MeasuredRow]:
    measured = by_amplitude(tank["time_s"], np.abs(tank["roll_rad"]))
    time, roll = decay(database, float(tank["roll_rad"][0]), 1.5 * float(tank["time_s"][-1]))
    ours = by_amplitude(*extremes(time, roll))
    common: dict[str, Any] = {"picture": "measured_kvlcc2", "by": by, "x": "amplitude, deg", "of": "value"}
    mean = measured["ratio"]
    ratios = common | {
        "panel": "damping over critical", "y": "ratio", "points": (measured["at"], mean),
        "spread": (mean - measured["spread"], mean + measured["spread"]), "line": (ours["at"], ours["ratio"]),
    }  # fmt: skip
    judged = (measured["at"] >= JUDGED[0]) & (measured["at"] <= JUDGED[1])
    known = measured["at"] >= ours["at"].min()
    low = known & (measured["at"] < 4.0)
    for kept, words, bound in ((judged & known, "5 to 9 deg", expected), (low, "below 4 deg", None)):
        if not kept.any():
            continue  # it decays so little that it has not come there
        yield MeasuredRow(
            **ratios, compared=f"damping over critical, {words}", at=measured["at"][kept],
            measured=mean[kept], ours=np.interp(measured["at"][kept], ours["at"], ours["ratio"]),
            expected=bound,
        )  # fmt: skip
    yield MeasuredRow(
        **common, panel="period", y="s", points=(measured["at"], measured["period"]),
        line=(ours["at"], ours["period"]), compared="period", at=measured["at"][known],
        measured=measured["period"][known],
        ours=np.interp(measured["at"][known], ours["at"], ours["period"]), expected=0.02,
    )  # fmt: skip
