"""A chain on the bottom of a tank whose top is led in circles (Bergdahl et al. 2016)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from measured_numbers import columns
from measured_row import Array, MeasuredRow, Source

from seacrane import Scene, simulate
from seacrane.result import heavy_line_tension
from seacrane.scene import spline_curve

SOURCE = Source(
    title="Chain whose top goes in circles",
    repository="SMI-Lab-Inha/CableDyn",
    commit="1ae79e64afa16f960da4d4a75055e3545f1e6e94",
    licence="CC BY 4.0",
    about="tank: largest tensions of a chain, its top led in circles, Bergdahl et al. (2016)",
)
G, RHO, DEPTH, ABOVE, ACROSS = 9.81, 1000.0, 3.0, 0.3, 32.554  # m/s2, kg/m3, m, m, m
LENGTH, MASS, EA = 33.0, 0.0818, 1e4  # m, kg/m, N
VOLUME, NOMINAL = 3.6541e-3, 2.2e-3  # m: the diameter of the volume, and that of the coefficients
DRAG, DRAG_ALONG = 2.5, 0.5  # over the nominal diameter
SEGMENTS, STIFFNESS = 33, 1e4  # -, N/m2 of the ground
RISE, CYCLES, OUTPUTS = 1, 3, 200  # cycles in which the circle comes up, that count, outputs in a cycle
VARIED_RADIUS, VARIED_PERIODS = 0.2, (1.25, 2.0, 3.5)  # m, s: where the choices are varied
RMS, MEAN, EACH = 1.6, 0.035, 0.1  # N, and shares: what all 30 pairs are held to


@dataclass(frozen=True, kw_only=True)
class Model:
    """What is chosen: by which name, drag along over the skin, added mass over the volume, friction."""

    by: str
    along: float = DRAG_ALONG * NOMINAL / VOLUME / np.pi
    added: float = 3.8
    friction: float = 0.3


BEST = Model(by="friction 0.3, added mass 3.8")
OTHERS = (
    Model(by="no friction", friction=0.0),
    Model(by="drag along over the skin", along=DRAG_ALONG * NOMINAL / VOLUME),
    Model(by="added mass 1", added=1.0),
)


def rows(folder: Path) -> Iterator[MeasuredRow]:
    """By period as the paper has the chain, all pairs together, and a few with each choice."""
    told = columns(folder / "maxima.csv")
    period, radius, measured = told["period_s"], told["radius_m"], told["measured_maximum_N"]
    ours = maxima(BEST, period, radius)
    judge(measured, ours)
    for one in dict.fromkeys(period):
        of = period == one
        yield MeasuredRow(
            picture="measured_circles", panel=f"period {one:g} s",
            compared=f"period {one:g} s: largest tension", by=BEST.by,
            x="radius of the circle, m", y="largest tension at the top, N", at=radius[of],
            measured=measured[of], ours=ours[of], of="value", points=(radius[of], measured[of]),
            line=(radius[of], ours[of]), expected=EACH,
        )  # fmt: skip
    yield _together("all 30 pairs", BEST, measured, ours)
    few = (radius == VARIED_RADIUS) & np.isin(period, VARIED_PERIODS)
    for model in (BEST, *OTHERS):
        found = ours[few] if model is BEST else maxima(model, period[few], radius[few])
        yield _together("large circles of three periods", model, measured[few], found)


def _together(which: str, model: Model, measured: Array, found: Array) -> MeasuredRow:
    """Several pairs in one row."""
    return MeasuredRow(
        picture="measured_circles_varied", panel=which,
        compared=f"{which}: largest tension", by=model.by, x="measured, N", y="computed, N", at=measured,
        measured=measured, ours=found, of="value", points=(measured, measured), line=(measured, found),
        joined=False,
    )  # fmt: skip


def judge(measured: Array, ours: Array) -> None:
    """Ends where all pairs together are further away than was asked."""
    off, share = ours - measured, np.abs(ours / measured - 1.0)
    found = float(np.sqrt(np.mean(off**2))), float(share.mean()), float(share.max())
    if not (found[0] <= RMS and found[1] <= MEAN and found[2] <= EACH):
        raise SystemExit(
            f"bergdahl_chain: rms {found[0]:.2f} N, mean {found[1]:.1%}, worst {found[2]:.1%}; at most "
            f"{RMS:g} N, {MEAN:.1%}, {EACH:.0%}"
        )


def maxima(model: Model, period: Array, radius: Array) -> Array:
    """Largest tension of a cycle at the top, the mean of the cycles that count, N."""
    return np.array([_maximum(model, *pair) for pair in zip(period, radius, strict=True)])


def _maximum(model: Model, period: float, radius: float) -> float:
    result = simulate(
        chain(model, period, radius), t_end=(RISE + CYCLES) * period, dt_out=period / OUTPUTS,
        integrator="dopri5", channels=["line_tension"],
    )  # fmt: skip
    top = heavy_line_tension(result, line="chain")[:, 1]
    return float(top[RISE * OUTPUTS + 1 :].reshape(CYCLES, OUTPUTS).max(axis=1).mean())


def chain(model: Model, period: float, radius: float) -> Scene:
    """From the anchor to a top that two rails lead: x = R sin wt, z = R cos wt, as the paper has it."""
    scene = Scene(name="chain in circles", gravity=G)
    top = (ACROSS, 0.0, ABOVE)
    times = np.linspace(0.0, (RISE + CYCLES) * period, (RISE + CYCLES) * OUTPUTS + 1)
    share = np.minimum(times / (RISE * period), 1.0)
    rise = radius * share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
    first, angle = "ground", 2.0 * np.pi * times / period
    for name, axis, turn in (("sled", (1.0, 0.0, 0.0), np.sin), ("top", (0.0, 0.0, 1.0), np.cos)):
        scene.add_body(name=name, mass=10.0, inertia=(1.0, 1.0, 1.0), position=top)
        scene.add_joint(
            kind="prismatic", name=f"rail of the {name}", first=first, second=name, point=top, axis=axis
        )
        scene.add_driver(
            joint=f"rail of the {name}", curve=spline_curve(times=times, values=rise * turn(angle))
        )
        first = name
    scene.add_line(
        "chain", "ground", "top", first_point=(0.0, 0.0, -DEPTH), second_point=(0.0, 0.0, 0.0),
        wire={"segments": SEGMENTS, "mass_per_length": MASS, "medium": "sea", "density": RHO,
        "diameter": VOLUME, "drag_coefficient": DRAG * NOMINAL / VOLUME,
        "drag_coefficient_along": model.along, "added_mass_coefficient": model.added,
        "seabed": {"depth": DEPTH, "stiffness": STIFFNESS, "friction": model.friction}}, EA=EA,
        length=LENGTH,
    )  # fmt: skip
    return scene
