"""A ship section across a wave flume, held and free, in beam waves (NTNU 2025)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from measured_numbers import columns
from measured_row import Array, MeasuredRow, Source
from numpy.typing import NDArray
from test_vessel import complex_amplitude, regular_wave

from seacrane import Scene, _core, simulate
from seacrane.hydro import (
    Hull,
    HydroDatabase,
    OffsetTable,
    hydro_from_hull,
    motion_response,
    section_eddy_damping,
)

ComplexArray = NDArray[np.complex128]
SOURCE = Source(
    title="Section in a flume",
    repository="KRSundsdal1/2D-ship-cross-section-in-regular-waves",
    commit="2465ceee234b7ad6973cb7d00d918546c57d8111",
    licence="CC0 1.0",
    about="wave flume: ship section held and free, Sundsdal, Greco, Hanssen, Lugni (2025)",
)
DEPTH, STRIP = "panels, depth 1 m", "strip theory, deep"
RAD = "omega, rad/s"
BREADTH, DRAUGHT, BILGE_RADIUS, HEIGHT_OF_GRAVITY = 0.4, 0.2, 0.0512, 0.106  # m
SPRINGS, RIDES_ALONG, RIG = 60.0, 0.303, 8.70  # N/m and kg of sway, N s/m of sway and heave
LOW, HIGH = 0.024, 0.04  # wave heights, m
JUDGED, OUT_OF_LINE = (4.9, 9.0), 2031  # rad/s; a run whose mean force is not believed
ROLL_RESONANCE = 2.0 * np.pi / 1.26
SWAY, HEAVE, ROLL = 1, 2, 3
RHO, G, LENGTH = 1000.0, 9.81, 0.586


@lru_cache
def databases() -> dict[str, HydroDatabase]:
    """The section as the tank had it, and as the strip theory of its hull has it, in deep water."""
    in_depth = HydroDatabase.load(Path(__file__).with_suffix(".nc"))
    strip = hydro_from_hull(
        _hull(), method="strip", omega=in_depth.omega, heading=in_depth.heading, rho=RHO, g=G,
        mass=float(in_depth.mass_matrix[0, 0]), center_of_gravity=[0.0, 0.0, HEIGHT_OF_GRAVITY - DRAUGHT],
    )  # fmt: skip
    return {DEPTH: in_depth, STRIP: replace(strip, mass_matrix=in_depth.mass_matrix)}


def rows(folder: Path) -> Iterator[MeasuredRow]:
    held = columns(folder / "fixed.csv")
    for height, words in ((LOW, "low wave"), (HIGH, "high wave")):
        at = held["H_nominal_m"] == height
        every = {name: values[at] for name, values in held.items()}
        for by, database in databases().items():
            yield from _forces(every, by, database, words)
            yield from _drifts(every, by, database, words)
    for by, database in databases().items():
        yield _phases(held, by, database)
    free = columns(folder / "free.csv")
    low = {name: values[free["H_nominal_m"] == LOW] for name, values in free.items()}
    for by, database in databases().items():
        motion = motion_response(hung(database))[0]
        yield from _motions(low, by, database.omega, _of_gravity(motion))
    at = np.unique(low["omega_rad_s"])
    eddying = hung(databases()[DEPTH]).with_roll_damping(quadratic=eddies())
    runs = np.array([in_time(eddying, float(omega)) for omega in at])
    yield from _motions(low, "run in time, depth 1 m, with eddies", at, _of_gravity(runs))


def hung(database: HydroDatabase) -> HydroDatabase:
    """Free between the springs of the rig, with what its carriage adds."""
    added, infinite, restoring, damping = (np.array(one) for one in (
        database.added_mass, database.infinite_frequency_added_mass, database.restoring,
        database.linear_damping,
    ))  # fmt: skip
    for mass in (added, infinite):
        mass[..., SWAY, SWAY] += RIDES_ALONG  # of sway only, as added mass is
    restoring[SWAY, SWAY] += SPRINGS
    damping[SWAY, SWAY], damping[HEAVE, HEAVE] = RIG, RIG
    return replace(
        database, added_mass=added, infinite_frequency_added_mass=infinite, restoring=restoring,
        linear_damping=damping,
    )  # fmt: skip


def _forces(held: dict[str, Array], by: str, database: HydroDatabase, words: str) -> Iterator[MeasuredRow]:
    for motion, name, expected in ((SWAY, "sway", 0.05), (HEAVE, "heave", 0.08)):
        found = _grouped(held["omega_rad_s"], held[f"{name}_force_N_per_m"])
        line = np.abs(database.force[0, :, motion])
        common = _common(
            "held", f"{name} force, {words}", "force over amplitude, N/m", by, found, database.omega, line
        )
        for kept, told, judged in _parts(found["omega"], words):
            yield _row(
                common,
                found,
                found["mean"],
                kept,
                f"held, {told}: {name} force",
                expected if judged else None,
            )


def _drifts(held: dict[str, Array], by: str, database: HydroDatabase, words: str) -> Iterator[MeasuredRow]:
    kept = held["run"] != OUT_OF_LINE
    found = _grouped(held["omega_rad_s"][kept], held["mean_sway_force_over_half_rho_g_a2_L"][kept])
    line = _drift_over_wall(by, database)
    common = _common(
        "held", f"mean drift, {words}", "over rho g a$^2$ L / 2", by, found, database.omega, line
    )
    for at, told, judged in _parts(found["omega"], words):
        yield _row(common, found, found["mean"], at, f"held, {told}: mean drift", 0.2 if judged else None)


def _drift_over_wall(by: str, database: HydroDatabase) -> Array:
    if database.drift is not None:
        return np.asarray(database.drift.coefficient[0, :, SWAY] / (0.5 * RHO * G * LENGTH))
    points = _hull().sections(np.array([0.0]))[0].section
    told = _core.section_radiation(points=points, omega=database.omega, rho=RHO, g=G)
    phase = np.angle(told["wave_amplitude"][:, :2])
    return np.asarray(
        np.cos(phase[:, 0] - phase[:, 1]) ** 2
    )  # |R|^2: both waves leave as they came, but turned


def _phases(held: dict[str, Array], by: str, database: HydroDatabase) -> MeasuredRow:
    """Of sway ahead of heave; a model that stands elsewhere shifts both."""
    ahead = np.mod(held["sway_force_phase_deg"] - held["heave_force_phase_deg"] + 180.0, 360.0) - 180.0
    found = _grouped(held["omega_rad_s"], ahead)
    force = database.force[0]
    line = np.degrees(np.angle(force[:, SWAY] / force[:, HEAVE]))
    common = _common(
        "held", "sway force ahead of heave force", "deg", by, found, database.omega, line, of="range"
    )
    kept = found["omega"] < 9.0
    return _row(common, found, found["mean"], kept, "held, to 9 rad/s: sway force ahead of heave force", None)


def _motions(free: dict[str, Array], by: str, omega: Array, motion: Array) -> Iterator[MeasuredRow]:
    """``motion`` (n, 6) per metre of wave, as amplitudes, at the frequencies ``omega``."""
    for index, name, unit in ((SWAY, "sway", "m"), (HEAVE, "heave", "m"), (ROLL, "roll", "rad")):
        camera = free[f"{name}_{unit}_per_m"]
        other = free.get(f"{name}_by_accelerometers_{unit}_per_m", camera)
        found = _grouped(np.tile(free["omega_rad_s"], 2), np.concatenate([camera, other]))
        common = _common(
            "free", name, f"motion over amplitude, {unit}/m", by, found, omega, motion[:, index],
            joined=omega.size > camera.size,
        )  # fmt: skip
        between = np.clip(np.interp(found["omega"], omega, motion[:, index]), found["low"], found["high"])
        resonant = np.abs(found["omega"] / ROLL_RESONANCE - 1.0) < 0.1
        told, expected = "between camera and accelerometers", 0.05
        if name == "sway":
            told, expected, between = "camera alone", 0.2, found["mean"]
        if name != "heave":
            yield _row(common, found, between, resonant, f"free, roll in resonance: {name}, {told}", None)
        kept = ~resonant if name != "heave" else np.ones_like(resonant)
        yield _row(common, found, between, kept, f"free, low wave: {name}, {told}", expected)


def _of_gravity(motion: ComplexArray) -> Array:
    """Amplitudes (n, 6) of the centre of gravity, where the waterline's centre moves by ``motion``."""
    moved = motion.copy()
    moved[:, SWAY] -= (HEIGHT_OF_GRAVITY - DRAUGHT) * motion[:, ROLL]
    return np.abs(moved)


def eddies() -> float:
    """Quadratic roll damping by Ikeda's section method about the centre of gravity, N m s2/rad2."""
    area = 1.0 - (2.0 - 0.5 * np.pi) * BILGE_RADIUS**2 / (BREADTH * DRAUGHT)
    rate = 1.0  # rad/s, its amplitude
    linear = section_eddy_damping(
        breadth=BREADTH, draught=DRAUGHT, area_coefficient=area, bilge_radius=BILGE_RADIUS, rho=RHO,
        amplitude_deg=float(np.degrees(rate)), omega=1.0, axis_height=HEIGHT_OF_GRAVITY - DRAUGHT,
    )  # fmt: skip
    return LENGTH * linear / (8.0 / (3.0 * np.pi) * rate)


def in_time(database: HydroDatabase, omega: float) -> ComplexArray:
    """Motions (6,) per metre of a low regular wave, from a run with fluid memory and the rig's springs."""
    bare = np.array(database.restoring)
    bare[SWAY, SWAY] -= SPRINGS
    scene = Scene(name="flume", gravity=G)
    springs = np.diag([SPRINGS, SPRINGS, 0.0, 0.0, 0.0, SPRINGS])
    scene.add_vessel(replace(database, restoring=bare), mooring=springs, mooring_damping=0.0)
    wave = 0.5 * LOW
    scene.waves = regular_wave(database, omega=omega, heading_deg=90.0, amplitude=wave, phase=0.0)
    period = 2.0 * np.pi / omega
    result = simulate(scene, t_end=100.0 * period, dt_out=period / 20.0)
    return np.asarray(complex_amplitude(result, omega, start=80.0 * period) / wave)


def _parts(omega: Array, words: str) -> list[tuple[Array, str, bool]]:
    inside = (omega > JUDGED[0]) & (omega < JUDGED[1])
    parts = [
        (inside, f"{words}, 4.9 to 9 rad/s", words == "low wave"),
        (omega >= JUDGED[1], f"{words}, beyond 9 rad/s", False),
        (omega <= JUDGED[0], f"{words}, 4.1 rad/s", False),
    ]
    return [part for part in parts if part[0].any()]


def _grouped(omega: Array, values: Array) -> dict[str, Array]:
    """Mean, least and largest of what was measured at each frequency."""
    every = np.unique(omega)
    groups = [values[(omega == one) & np.isfinite(values)] for one in every]
    return {
        "omega": every,
        "mean": np.array([one.mean() for one in groups]),
        "low": np.array([one.min() for one in groups]),
        "high": np.array([one.max() for one in groups]),
        "count": np.array([float(one.size) for one in groups]),
    }


def _common(
    picture: str, panel: str, y: str, by: str, found: dict[str, Array], omega: Array, line: Array,
    *, of: str = "value", joined: bool = True,
) -> dict[str, Any]:  # fmt: skip
    shown = (omega > 3.9) & (omega < 10.5)
    several = found["count"] > 1
    scale = np.abs(found["mean"]) if of == "value" else np.ptp(found["mean"])
    half = (0.5 * (found["high"] - found["low"]) / scale)[several]
    return {
        "picture": f"measured_ntnu_{picture}", "panel": panel, "x": RAD, "y": y, "by": by, "of": of,
        "points": (found["omega"], found["mean"]), "spread": (found["low"], found["high"]),
        "line": (omega[shown], line[shown]), "repeats": float(half.max()) if half.size else None,
        "joined": joined,
    }  # fmt: skip


def _row(
    common: dict[str, Any], found: dict[str, Array], measured: Array, kept: Array, compared: str,
    expected: float | None,
) -> MeasuredRow:  # fmt: skip
    at = found["omega"][kept]
    return MeasuredRow(
        **common, compared=compared, at=at, measured=measured[kept], ours=np.interp(at, *common["line"]),
        expected=expected,
    )  # fmt: skip


@lru_cache
def _hull() -> Hull:
    """Of the section's sizes."""
    half, r, low = 0.5 * BREADTH, BILGE_RADIUS, DRAUGHT
    angle = np.linspace(0.0, -0.5 * np.pi, 25)
    bilge = [(half - r + r * np.cos(a), r - low + r * np.sin(a)) for a in angle]
    section = [(half, 0.05), *((half, z) for z in np.linspace(0.0, r - low, 9)[:-1]), *bilge, (0.0, -low)]
    ends = [-0.5 * LENGTH, 0.5 * LENGTH]
    return Hull.from_offsets(OffsetTable(x=ends, sections=(section, section), name="flume section"))
