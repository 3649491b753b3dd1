"""Axes of lines: their stiffness taut and snatching, length, falls, and the load on them."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Scene, _core
from seacrane.accuracy.case import Case
from stability_atlas.axis import Axis

MASS, LENGTH, STIFFNESS, GRAVITY = 2e4, 10.0, 1.5e8, 9.80665  # kg, m, N, m/s2


def _heaved(
    *,
    mass: float = MASS,
    stiffness: float = STIFFNESS,
    length: float = LENGTH,
    falls: int = 1,
    heave: _core.Curve | None = None,
    **line: Any,
) -> Scene:
    """A load at rest on a line over a block that heaves gently; `length` is that of one fall, stretched."""
    scene = Scene(name="load on a line")
    scene.add_body(name="block", mass=100.0, inertia=(10.0, 10.0, 10.0))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="block", point=(0, 0, 0))
    wave = _core.Curve.harmonic(offset=-0.2, amplitude=0.2, omega=1.5)
    scene.add_driver(joint="guide", curve=wave if heave is None else heave)
    inertia = np.full(3, mass / 20.0)
    scene.add_body(name="load", mass=mass, inertia=inertia, position=(0.0, 0.0, -length))
    strain = mass * GRAVITY / falls / stiffness
    scene.add_line(
        name="hoist", bodies=(["block", "load"] * falls)[: falls + 1], points=np.zeros((falls + 1, 3)),
        EA=stiffness, length=falls * length / (1.0 + strain), mass=mass / falls**2, **line,
    )  # fmt: skip
    return scene


def _stiffness(stiffness: float) -> Case:
    return Case(scene=_heaved(stiffness=stiffness), t_end=5.0, dt_out=0.1)


def _quasi_static(stiffness: float) -> Case:
    return Case(scene=_heaved(stiffness=stiffness, rung="quasi-static"), t_end=5.0, dt_out=0.1)


def _snatching(stiffness: float) -> Case:
    """The block falls faster than the load can."""
    wave = _core.Curve.harmonic(offset=-3.0, amplitude=3.0, omega=2.0)
    return Case(scene=_heaved(stiffness=stiffness, heave=wave, damping_ratio=0.1), t_end=3.0, dt_out=0.05)


def _length(length: float) -> Case:
    return Case(scene=_heaved(length=length), t_end=5.0, dt_out=0.1)


def _hauled_in(minimum: float) -> Case:
    """A load that swings a little, hauled in by a winch until its line is no shorter than this."""
    scene = _heaved()
    scene.replace("load", velocity=(1e-3, 0.0, 0.0))
    scene.add_winch(line="hoist", rate=-1.5, lag=0.2, minimum_length=minimum)
    return Case(scene=scene, t_end=7.0, dt_out=0.1)


def _braked(within: float) -> Case:
    """A load that is lowered at 0.5 m/s when the brake closes within this time."""
    scene = _heaved(heave=_core.Curve.constant(value=0.0))
    brake = _core.Curve.quintic(start_time=1.0, end_time=1.0 + within, start=0.0, end=1.0)
    scene.add_winch(
        line="hoist", rate=_core.Curve.quintic(start_time=0.0, end_time=0.8, start=0.0, end=0.5), lag=0.1,
        drum_inertia=1e3, drum_radius=0.5, brake=brake, brake_capacity=2.0 * MASS * GRAVITY, brake_give=0.02,
    )  # fmt: skip
    return Case(scene=scene, t_end=3.0, dt_out=0.1)


def _held(band: float) -> Case:
    """A tension held within a band while the block heaves."""
    scene = _heaved()
    scene.add_winch(line="hoist", tension=MASS * GRAVITY, tension_gain=2e-5, dead_band=band, lag=0.1)
    return Case(scene=scene, t_end=5.0, dt_out=0.1)


def _falls(falls: float) -> Case:
    return Case(scene=_heaved(falls=round(falls)), t_end=5.0, dt_out=0.1)


def _load(tonnes: float) -> Case:
    return Case(scene=_heaved(mass=1e3 * tonnes), t_end=5.0, dt_out=0.1)


STIFFNESSES = (1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12)
AXES = (
    Axis(name="line-stiffness", title="20 t on 10 m of line that heaves", label="EA [N]",
         values=STIFFNESSES, quick=(1e5, 1e9), case=_stiffness),
    Axis(name="line-quasi-static", title="The same with a quasi-static stretch", label="EA [N]",
         values=STIFFNESSES, quick=(1e9,), case=_quasi_static),
    Axis(name="line-snatch", title="The same, going slack and snatching", label="EA [N]",
         values=STIFFNESSES[1:], quick=(1e7,), case=_snatching),
    Axis(name="line-length", title="20 t on a short line", label="length [m]",
         values=(0.0, 1e-6, 1e-4, 1e-2, 1.0, 100.0), quick=(0.0, 1.0), case=_length),
    Axis(name="line-hauled-in", title="20 t hauled in by a winch", label="minimum length [m]",
         values=(1e-3, 0.01, 0.1, 1.0, 5.0), quick=(1.0,), case=_hauled_in),
    Axis(name="line-brake", title="20 t lowered when the brake closes", label="within [s]",
         values=(1.0, 0.1, 0.01, 1e-3, 1e-4), quick=(1e-3,), case=_braked),
    Axis(name="line-dead-band", title="20 t at a held tension", label="dead band [N]",
         values=(0.0, 1.0, 1e2, 1e4, 1e6), quick=(1e2,), case=_held),
    Axis(name="line-falls", title="20 t on many falls", label="falls",
         values=(1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0), quick=(16.0,), case=_falls),
    Axis(name="line-load", title="What hangs on 10 m of line", label="load [t]",
         values=(0.01, 0.1, 0.5, 5.0, 50.0, 500.0, 1000.0, 1e4), quick=(0.5,), case=_load),
)  # fmt: skip
