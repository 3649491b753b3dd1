"""A box that floats free in the waves of a flume (Ren, He, Dong, Wen 2015)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from measured_row import Array, MeasuredRow, Source
from test_vessel import complex_amplitude, regular_wave

from seacrane import Scene, simulate
from seacrane.hydro import HydroDatabase, motion_response, section_eddy_damping

SOURCE = Source(
    title="Box that floats free in waves",
    repository="FloatStepper/FloatStepper",
    commit="4f2dd62a3d564f9b6df34c24386b8fb4b3084424",
    licence="GPL-3.0: a few numbers quoted",
    about="wave flume: floating box, Ren, He, Dong, Wen (2015), read from figures by others",
    quoted=True,
)
OMEGA, BREADTH, HEIGHT, DRAUGHT, LENGTH = 2.0 * np.pi / 1.2, 0.30, 0.20, 0.10, 0.40  # rad/s, m
RHO, G = 1000.0, 9.81
SWAY, HEAVE, ROLL = 1, 2, 3
# Amplitudes, of a harmonic and a drift that were fitted to the series: wave, surge, heave (m), pitch (deg).
WAVES = {"low wave": (0.0201, 0.0222, 0.0242, 2.95), "high wave": (0.0457, 0.0520, 0.0437, 10.9)}
MOTIONS = {"surge": (SWAY, 1.0, 0.1), "heave": (HEAVE, 1.0, 0.1), "pitch": (ROLL, 180.0 / np.pi, 0.2)}
PANELS, UNIFORM = "panels, depth 0.4 m", "panels, inertia of a uniform box"
IN_TIME = "run in time, depth 0.4 m, with eddies"


def rows(_: Path) -> Iterator[MeasuredRow]:
    database = HydroDatabase.load(Path(__file__).with_suffix(".nc"))
    heights = np.array([0.005, *(wave[0] for wave in WAVES.values())])
    at = int(np.argmin(np.abs(database.omega - OMEGA)))
    eddying = database.with_roll_damping(quadratic=eddies())
    found = {
        PANELS: heights[:, None] * np.abs(motion_response(database)[0][at]),
        UNIFORM: heights[:, None] * np.abs(motion_response(uniform(database))[0][at]),
        IN_TIME: np.array([in_time(eddying, float(height)) for height in heights]),
    }
    for by, motions in found.items():
        for k, (name, (index, unit, share)) in enumerate(MOTIONS.items()):
            line = unit * motions[:, index]
            points = np.array([[wave[0], wave[k + 1]] for wave in WAVES.values()])
            common: dict[str, Any] = {
                "picture": "measured_ren_box", "panel": name, "by": by, "x": "wave amplitude, m",
                "y": f"amplitude, {'deg' if name == 'pitch' else 'm'}", "of": "value",
                "points": points.T, "line": (heights, line),
            }  # fmt: skip
            for row, words in enumerate(WAVES):
                yield MeasuredRow(
                    **common, compared=f"{words}: {name}", at=points[row, :1], measured=points[row, 1:],
                    ours=line[row + 1 : row + 2], expected=share if words == "low wave" else None,
                )  # fmt: skip


def eddies() -> float:
    """Quadratic roll damping by Ikeda's section method about the waterline, N m s2/rad2."""
    rate = 1.0  # rad/s, its amplitude
    linear = section_eddy_damping(
        breadth=BREADTH, draught=DRAUGHT, area_coefficient=1.0, bilge_radius=0.0, rho=RHO,
        amplitude_deg=float(np.degrees(rate)), omega=1.0,
    )  # fmt: skip
    return LENGTH * linear / (8.0 / (3.0 * np.pi) * rate)


def in_time(database: HydroDatabase, amplitude: float) -> Array:
    """Amplitudes (6,) of the motions from a run in a regular wave.

    Its memory is judged by damping and added mass: memory by motion may err by a hundredth of the largest
    motions, which are far from this frequency.
    """
    scene = Scene(name="flume", gravity=G)
    scene.add_vessel(database)
    scene.waves = regular_wave(database, omega=OMEGA, heading_deg=90.0, amplitude=amplitude, phase=0.0)
    period = 2.0 * np.pi / OMEGA
    result = simulate(scene, t_end=100.0 * period, dt_out=period / 20.0)
    return np.abs(complex_amplitude(result, OMEGA, start=80.0 * period))


def uniform(database: HydroDatabase) -> HydroDatabase:
    """With the roll inertia of a box of one density, in place of the one that others computed with."""
    mass = np.array(database.mass_matrix)
    mass[ROLL, ROLL] = mass[0, 0] * (BREADTH**2 + HEIGHT**2) / 12.0
    return replace(database, mass_matrix=mass)
