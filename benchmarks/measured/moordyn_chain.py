"""A chain on the seabed whose top heaves, by OrcaFlex: the histories beside MoorDyn's quasi-static test."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from measured_row import Array, MeasuredRow, Source

from seacrane import Scene, simulate
from seacrane.result import heavy_line_tension
from seacrane.scene import spline_curve

SOURCE = Source(
    title="Chain on the seabed",
    repository="FloatingArrayDesign/MoorDyn",
    commit="319ff99771cffb835fea4423306a0849692afd53",
    licence="BSD-3-Clause",
    about="not measured: tensions of a chain on the seabed by OrcaFlex, its top heaving",
)
G, RHO, PERIOD = 9.81, 1025.0, 10.0
MASS, DIAMETER, EA = 390.0, 0.252, 1.674e9  # kg/m, m, N
ACROSS, ALONG, ADDED = 1.37, 0.64, 1.0  # as filed, over the diameter
PRESSURE, DASHPOT, FRICTION = 1e5, 1e4, 0.5  # Pa/m and Pa s/m of the seabed, as filed, over the diameter
RAISED = 0.27  # m: what OrcaFlex's tensions at rest have the chain lie above the level of the anchor
HEAVES = {"A1": 2.0, "A2": 5.0}  # m
RISE, RUNS = 1, 4  # periods in which the heave comes up, and that are run
OUTPUTS = 100  # in a period
VARIED_AT = (50.0, 5.0)  # m, depth and heave: where friction and seabed matter most
TOP, ANCHOR = 1, 0  # ends as `heavy_line_tension` has them


@dataclass(frozen=True, kw_only=True)
class Case:
    """Across, water depth and length in m, segments; the largest difference expected at the top."""

    span: float
    depth: float
    length: float
    segments: int
    expected: float


CASES = {
    "0050": Case(span=400.0, depth=50.0, length=410.0, segments=41, expected=0.15),
    "0200": Case(span=700.0, depth=200.0, length=760.0, segments=76, expected=0.05),
    "0600": Case(span=1500.0, depth=600.0, length=1700.0, segments=85, expected=0.05),
}


@dataclass(frozen=True, kw_only=True)
class Model:
    """What is chosen: by which name, drag along over the diameter, height of the seabed (m), the seabed."""

    by: str
    along: float = ALONG / np.pi
    raised: float = RAISED
    friction: float = FRICTION
    stiffer: float = 1.0
    finer: int = 1


FILED = Model(by="as filed, drag along over the skin", along=ALONG, raised=0.0)
BEST = Model(by="drag along over the diameter, seabed 0.27 m higher")
VARIED = (
    Model(by="no friction", friction=0.0),
    Model(by="friction 1", friction=1.0),
    Model(by="seabed four times as stiff", stiffer=4.0),
    Model(by="segments half as long", finer=2),
)


def rows(folder: Path) -> Iterator[MeasuredRow]:
    for name, case in CASES.items():
        for motion in HEAVES:
            told = np.loadtxt(folder / f"WD{name}_{motion}.txt")
            heave = check_motion(folder, motion)
            for model in (BEST, FILED):
                ours = tensions(case, model, heave)
                judged = case.expected if model is BEST else None
                yield row("measured_chain_top", case, model, heave, told, ours, end=TOP, expected=judged)
                if model is BEST:
                    yield row("measured_chain_anchor", case, model, heave, told, ours, end=ANCHOR)
            for model in VARIED if (case.depth, heave) == VARIED_AT else ():
                ours = tensions(case, model, heave)
                for end in (TOP, ANCHOR):
                    yield row("measured_chain_varied", case, model, heave, told, ours, end=end)


def check_motion(folder: Path, motion: str) -> float:
    """Amplitude (m) of the heave, which the file has to its digits."""
    told, heave = np.loadtxt(folder / f"motion_{motion}.txt"), HEAVES[motion]
    assert np.allclose(told[:, 3], heave * np.sin(2.0 * np.pi * told[:, 0] / PERIOD), atol=1e-3)
    return heave


def row(
    picture: str, case: Case, model: Model, heave: float, told: Array, ours: Array, *, end: int,
    expected: float | None = None,
) -> MeasuredRow:  # fmt: skip
    """The second period of OrcaFlex, and the last one here."""
    tension = told[:, 3 if end == TOP else 4]
    first, second = tension[:OUTPUTS], tension[OUTPUTS : 2 * OUTPUTS]
    at, where = told[OUTPUTS : 2 * OUTPUTS, 0], "top" if end == TOP else "anchor"
    what = f"{case.depth:g} m, heave {heave:g} m: tension at the {where}"
    return MeasuredRow(
        picture=picture, panel=what, compared=what, by=model.by, x="time, s", y="tension, kN", at=at,
        measured=second, ours=1e-3 * ours[:, end], of="range", points=(at, second),
        line=(at, 1e-3 * ours[:, end]), told="OrcaFlex", expected=expected,
        repeats=float(np.abs(second - first).max() / np.ptp(second) / 2.0),
    )  # fmt: skip


def tensions(case: Case, model: Model, heave: float) -> Array:
    """Of the last period, (100, 2), N: at the anchor and at the top."""
    result = simulate(
        chain(case, model, heave), t_end=RUNS * PERIOD, dt_out=PERIOD / OUTPUTS, integrator="dopri5",
        channels=["line_tension"],
    )  # fmt: skip
    return heavy_line_tension(result, line="chain")[-OUTPUTS - 1 : -1]


def chain(case: Case, model: Model, heave: float) -> Scene:
    """From the anchor to a fairlead at the surface that heaves along a guide, elastic segments between."""
    scene = Scene(name=f"chain at {case.depth:g} m", gravity=G)
    scene.add_body(name="fairlead", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(case.span, 0.0, 0.0))
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="fairlead", point=(case.span, 0.0, 0.0),
        axis=(0.0, 0.0, 1.0),
    )  # fmt: skip
    times = np.linspace(0.0, RUNS * PERIOD, RUNS * 200 + 1)
    share = np.minimum(times / (RISE * PERIOD), 1.0)
    rise = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    heaved = heave * rise * np.sin(2.0 * np.pi * times / PERIOD)
    scene.add_driver(joint="guide", curve=spline_curve(times=times, values=heaved))
    stiffness = PRESSURE * DIAMETER * model.stiffer
    bed = {
        "depth": case.depth - model.raised, "stiffness": stiffness, "friction": model.friction,
        "damping_ratio": 0.5 * DASHPOT * DIAMETER / np.sqrt(stiffness * MASS),
    }  # fmt: skip
    scene.add_line(
        "chain", "ground", "fairlead", first_point=(0.0, 0.0, -case.depth), second_point=(0.0, 0.0, 0.0),
        wire={"segments": case.segments * model.finer, "mass_per_length": MASS, "medium": "sea",
        "density": RHO, "diameter": DIAMETER, "drag_coefficient": ACROSS,
        "drag_coefficient_along": model.along, "added_mass_coefficient": ADDED,
        "seabed": bed},
        EA=EA, length=case.length, damping_ratio=0.1,
    )  # fmt: skip
    return scene
