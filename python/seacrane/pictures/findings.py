"""Figures 3 to 10 of Landsverk, Zhou and Hovland from five runs, in our axes, and their findings as numbers.

The paper's axes are x aft, y starboard, z up about {0}, the vessel's reference point: ours turned by half
a turn about z. What it prints of surge, sway, roll and pitch has the opposite sign; heave and yaw have not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from seacrane.arrays import Array
from seacrane.pictures.pose import save_pose_figure
from seacrane.plotting.panel import Line, Panel, Picture, Sheet, save_sheet
from seacrane.result import MOTIONS, Result

OSCILLATION_START, OSCILLATION_PERIOD = 50.0, 5.0
CLEAR_CHANGE = 0.1  # share of a motion's own size from which a change counts as clear
TRANSLATIONS, ROTATIONS = MOTIONS[:3], MOTIONS[3:]
ANGLES = (*ROTATIONS, "slew angle")
STYLES = ("-", "--")  # of the lines of a panel
MEMORY = {"with memory": "vessel", "without memory": "vessel_without_memory"}
PAYLOAD = {"case 1, no payload": "case1", "case 2, payload": "case2"}
OSCILLATION = {"case 1": "case1", "case 3, cylinders oscillate": "case3"}
ALONE = "The vessel alone in the same waves, with and without the memory term mu of the radiated waves."
SWING = "Vessel with the crane swinging out, without and with the payload."
CYLINDERS = "Crane that comes to rest against one whose cylinders oscillate with a 5 s period from 50 s on."
# Title, caption, motions and runs of each figure of motions.
OF_MOTIONS: Mapping[int, tuple[str, str, Sequence[str], Mapping[str, str]]] = {
    3: ("vessel alone, with and without fluid memory", ALONE, MOTIONS, MEMORY),
    5: ("surge, sway and heave, cases 1 and 2", SWING, TRANSLATIONS, PAYLOAD),
    6: ("roll, pitch and yaw, cases 1 and 2", SWING, ROTATIONS, PAYLOAD),
    8: ("surge, sway and heave, cases 1 and 3", CYLINDERS, TRANSLATIONS, OSCILLATION),
    9: ("roll, pitch and yaw, cases 1 and 3", CYLINDERS, ROTATIONS, OSCILLATION),
}


@dataclass(frozen=True, kw_only=True)
class PaperRuns:
    """The five runs that the paper's figures compare; ValueError unless all have the same output times."""

    vessel: Result
    vessel_without_memory: Result
    case1: Result
    case2: Result
    case3: Result

    def __post_init__(self) -> None:
        first = self.vessel
        for other in (self.vessel_without_memory, self.case1, self.case2, self.case3):
            if not np.array_equal(first.time, other.time):
                raise ValueError(
                    f"runs {first.stats['scene']!r} and {other.stats['scene']!r} were recorded at different "
                    f"times: {first.time.size} outputs to {first.time[-1]:g} s, {other.time.size} outputs to "
                    f"{other.time[-1]:g} s; give both the same t_end and dt_out"
                )


def motion_of(result: Result, motion: str) -> Array:
    """One of the vessel's six motions (n,) in the units of the figures, m or degrees."""
    values = result.select("vessel_motion", motion=motion)
    return np.rad2deg(values) if motion in ROTATIONS else values


def _motions(number: int, runs: PaperRuns) -> Sheet:
    """A figure of the vessel's motions in several runs."""
    title, caption, motions, pairs = OF_MOTIONS[number]
    of = {label: getattr(runs, name) for label, name in pairs.items()}
    curves = {motion: {label: motion_of(run, motion) for label, run in of.items()} for motion in motions}
    return _sheet(f"Figure {number}: {title}", caption, runs, curves)


def _sheet(title: str, caption: str, runs: PaperRuns, curves: Mapping[str, Mapping[str, Array]]) -> Sheet:
    """Labelled curves by what they are; angles are those that end in a rotation."""
    panels = []
    for quantity, by_label in curves.items():
        lines = tuple(
            Line(label=label, values=values, colour=i, style=STYLES[i])
            for i, (label, values) in enumerate(by_label.items())
        )
        panels.append(Panel(quantity=quantity, unit="deg" if quantity in ANGLES else "m", lines=lines))
    columns, time = 2 if len(panels) == 6 else 1, runs.vessel.time
    return Sheet(title=title, caption=caption, abscissa=time, panels=tuple(panels), columns=columns)


def figure_7(runs: PaperRuns) -> Sheet:
    """Both strokes and the slew angle of case 3."""
    case3 = runs.case3
    curves = {
        f"stroke {number}": {"": case3.select("stroke", cylinder=name)}
        for number, name in enumerate(case3.coords["cylinder"], 1)
    }
    caption = (
        "Strokes of the main (1) and knuckle (2) cylinder, and the slew angle of king against tower, "
        "the paper's difference of phi_z between bodies 2 and 1."
    )
    curves["slew angle"] = {"": np.rad2deg(case3["slew_angle"])}
    return _sheet("Figure 7: cylinder strokes and slew angle, case 3", caption, runs, curves)


def figure_10(runs: PaperRuns) -> Sheet:
    """Heave of case 3 minus heave of case 1."""
    difference = motion_of(runs.case3, "heave") - motion_of(runs.case1, "heave")
    title = "Figure 10: heave of case 3 minus heave of case 1"
    caption = "What the oscillating cylinders add to the heave."
    return _sheet(title, caption, runs, {"heave, case 3 - case 1": {"": difference}})


TIME_FIGURES: dict[int, Callable[[PaperRuns], Sheet]] = {
    **{number: partial(_motions, number) for number in OF_MOTIONS},
    7: figure_7,
    10: figure_10,
}


def save_paper_figures(*, runs: PaperRuns, folder: Path) -> dict[int, Picture]:
    """Write ``figure_03.png`` to ``figure_10.png``, and the data behind them as ``figure_NN.csv``.

    The folder exists. Returns them by figure number, in order.
    """
    pictures = {
        number: save_sheet(sheet(runs), folder, f"figure_{number:02d}")
        for number, sheet in TIME_FIGURES.items()
    }
    pictures[4] = save_pose_figure(result=runs.case2, folder=folder)
    return dict(sorted(pictures.items()))


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One finding of the paper in our words, what our runs give for it, with units, and whether they agree.

    The verdict, taken from the condition `expected`, is "reproduced" or "not reproduced", or "measured" where
    the paper makes no statement to agree with.
    """

    finding: str
    number: str
    expected: str
    verdict: str


def _found(finding: str, number: str, expected: str, *, agrees: bool) -> Finding:
    verdict = "reproduced" if agrees else "not reproduced"
    return Finding(finding=finding, number=number, expected=expected, verdict=verdict)


def _rms(values: Array) -> float:
    return float(np.sqrt(np.mean(np.square(values))))


def mean_after(result: Result, motion: str, start: float) -> float:
    """Mean of a motion from `start` s on, m or degrees."""
    late = result.time >= start
    if not late.any():
        raise ValueError(f"run {result.stats['scene']!r} ends at {result.time[-1]:g} s, before {start:g} s")
    return float(np.mean(motion_of(result, motion)[late]))


def slew_stop(result: Result, *, share: float = 0.99) -> float:
    """Time from which the slew angle stays within 1 - `share` of its total change from its last value, s.

    The controlled angle gives way to the ship's motion by hundredths of a degree: 1 % of a quarter turn is
    above that ripple, 0.1 % is not.
    """
    angle = result["slew_angle"]
    change = angle[-1] - angle[0]
    outside = np.flatnonzero(np.abs(angle - angle[-1]) > (1 - share) * abs(change))
    return float(result.time[min(outside[-1] + 1, angle.size - 1)]) if outside.size else float(result.time[0])


def amplitude_at(time: Array, values: Array, *, period: float, start: float) -> float:
    """Amplitude of the component of one period, by least squares with a mean and a trend, from `start` s on.

    Time and values are (n,). Raises ValueError if fewer than two periods (s) follow the start.
    """
    late = time >= start
    if not late.any() or time[-1] - time[late][0] < 2 * period:
        raise ValueError(
            f"less than two periods of {period:g} s follow {start:g} s in a run to {time[-1]:g} s"
        )
    t, phase = time[late] - start, 2 * np.pi * (time[late] - start) / period
    columns = np.column_stack([np.cos(phase), np.sin(phase), np.ones_like(t), t])
    cosine, sine, _, _ = np.linalg.lstsq(columns, values[late], rcond=None)[0]
    return float(np.hypot(cosine, sine))


def memory_effect(runs: PaperRuns) -> Finding:
    """How much leaving memory out changes the vessel alone (figure 3)."""
    kept, without = ({m: motion_of(run, m) for m in MOTIONS}
                     for run in (runs.vessel, runs.vessel_without_memory))  # fmt: skip
    changes = {m: _rms(without[m] - kept[m]) / _rms(kept[m]) for m in MOTIONS if _rms(kept[m]) > 0}
    return _found(
        "Fluid memory changes the vessel's response clearly",
        "rms change over rms: " + ", ".join(f"{m} {100 * c:.0f} %" for m, c in changes.items()),
        f"largest above {100 * CLEAR_CHANGE:.0f} %",
        agrees=max(changes.values(), default=0.0) > CLEAR_CHANGE,
    )


def memory_cost(runs: PaperRuns) -> Finding:
    """What the memory states cost (the paper calls it significant)."""
    names = {"states": "states", "evaluations": "evaluations", "wall_s": "time on this machine"}
    ratio = {
        words: float(runs.vessel.stats[name]) / float(runs.vessel_without_memory.stats[name])
        for name, words in names.items()
    }
    return Finding(
        finding="Leaving memory out is cheaper",
        number="with over without memory: " + ", ".join(f"{words} x {r:.2f}" for words, r in ratio.items()),
        expected="the paper says significantly slower with memory; no number",
        verdict="measured",
    )


def roll_shows_most(before: Result, after: Result, what: str, where: str) -> Finding:
    """Which rotation of the vessel an addition changes most."""
    change = {m: _rms(motion_of(after, m) - motion_of(before, m)) for m in ("roll", "pitch", "yaw")}
    return _found(
        f"{what} shows most in roll ({where})",
        "rms change " + ", ".join(f"{motion} {value:.3g} deg" for motion, value in change.items()),
        "roll largest of the three rotations", agrees=change["roll"] == max(change.values()) > 0,
    )  # fmt: skip


def mean_heel(runs: PaperRuns) -> Finding:
    """Mean heel after the swing-out, against the vessel alone."""
    alone = mean_after(runs.vessel, "roll", OSCILLATION_START)
    heel = [mean_after(run, "roll", OSCILLATION_START) - alone for run in (runs.case1, runs.case2)]
    # The crane moves out to port: port down is a negative roll about x forward.
    return _found(
        "The swing-out changes the mean heel, with payload more than without",
        f"case 1 {heel[0]:+.3f} deg, case 2 {heel[1]:+.3f} deg, against the vessel alone",
        "to port, case 2 beyond case 1", agrees=heel[1] < heel[0] < 0,
    )  # fmt: skip


def yaw_at_slew_stop(runs: PaperRuns) -> Finding:
    """Yaw rate of case 1 over the vessel alone, late in the slew and after it has stopped."""
    time, stop = runs.case1.time, slew_stop(runs.case1)
    rate = np.gradient(motion_of(runs.case1, "yaw") - motion_of(runs.vessel, "yaw"), time)
    moving = float(np.mean(rate[(time >= 0.5 * stop) & (time <= 0.9 * stop)]))
    stopped = float(np.mean(rate[(time >= stop) & (time <= 1.4 * stop)]))
    return _found(
        "Yaw reacts when the slew stops",
        f"mean yaw rate {moving:+.4f} deg/s late in the slew, {stopped:+.4f} deg/s after {stop:.1f} s",
        "changes by more than half of its value when the slew stops",
        agrees=abs(stopped - moving) > 0.5 * max(abs(moving), abs(stopped)) > 0,
    )


def oscillation(runs: PaperRuns) -> Finding:
    """The 5 s component that case 3 adds to case 1, in each motion."""
    time, asked = runs.case1.time, {"period": OSCILLATION_PERIOD, "start": OSCILLATION_START}
    change = {m: motion_of(runs.case3, m) - motion_of(runs.case1, m) for m in MOTIONS}
    added = {motion: amplitude_at(time, values, **asked) for motion, values in change.items()}
    units = dict.fromkeys(TRANSLATIONS, "m") | dict.fromkeys(ROTATIONS, "deg")
    clear = all(added[motion] > 0 for motion in ("sway", "heave", "roll"))
    rotations = added["roll"] == max(added[motion] for motion in ROTATIONS)
    sway = added["surge"] < 0.25 * added["sway"] and added["sway"] > added["heave"]
    return _found(
        "Case 3's 5 s oscillation shows in sway, roll and heave, hardly in surge",
        "5 s amplitude " + ", ".join(f"{m} {a:.2g} {units[m]}" for m, a in added.items()),
        "surge below a quarter of sway; sway the largest translation, roll the largest rotation",
        agrees=clear and rotations and sway,
    )


FINDINGS: tuple[Callable[[PaperRuns], Finding], ...] = (
    memory_effect,
    memory_cost,
    lambda runs: roll_shows_most(runs.vessel, runs.case1, "The crane", "figures 3 and 6"),
    lambda runs: roll_shows_most(runs.case1, runs.case2, "The payload", "case 1 against 2"),
    mean_heel,
    yaw_at_slew_stop,
    oscillation,
)


def paper_findings(runs: PaperRuns) -> list[Finding]:
    """Every finding of the paper, measured on five runs; ValueError for those that end too early to judge."""
    return [measure(runs) for measure in FINDINGS]
