"""Figures 3 to 10 of Landsverk, Zhou and Hovland, from five runs, in our axes.

The paper's axes are x aft, y starboard, z up about {0}, the vessel's reference point: ours turned by half
a turn about z. What it prints of surge, sway, roll and pitch has the opposite sign; heave and yaw have not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.crane import FOOT, BodyRecord, Crane, load_crane
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.pose import Skeleton, save_pose_figure
from seacrane.plotting.panel import Line, Panel, Picture, Sheet, save_sheet
from seacrane.result import MOTIONS, Result

# Joint points that each body's lines run through; the tip is the crane's end of the payload's link.
THROUGH_JOINTS: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "tower": (("deck", "A"),),
    "king": (("A", "C", "B", "A"),),
    "main_jib": (("C", "F"), ("C", "D", "E", "F")),
    "knuckle_jib": (("F", "link"), ("F", "G", "link")),
}
# Each cylinder's ends, and the shares of its retracted length that barrel and rod cover.
CYLINDERS = {"main": ("B", "D"), "knuckle": ("E", "G")}
BARREL, ROD = (0.0, 0.95), (1.0, 0.1)
BARRELS = tuple(f"{cylinder}_barrel" for cylinder in CYLINDERS)  # drawn thick
Array = NDArray[np.float64]
TRANSLATIONS, ROTATIONS = MOTIONS[:3], MOTIONS[3:]


@dataclass(frozen=True, kw_only=True)
class PaperRuns:
    """The five runs that the paper's figures compare; all with the same output times."""

    vessel: Result
    vessel_without_memory: Result
    case1: Result
    case2: Result
    case3: Result


def motion_of(result: Result, motion: str) -> Array:
    """One vessel motion in the units of the figures.

    Parameters
    ----------
    result : Result
        A run with a vessel.
    motion : str
        surge, sway, heave, roll, pitch or yaw.

    Returns
    -------
    ndarray, shape (n,)
        m for surge, sway and heave; degrees for roll, pitch and yaw.
    """
    values = result.select("vessel_motion", motion=motion)
    return np.rad2deg(values) if motion in ROTATIONS else values


def motion_panel(motion: str, runs: Sequence[tuple[str, Result]]) -> Panel:
    """One motion of several labelled runs."""
    styles = ("-", "--", "-.", ":")
    lines = tuple(
        Line(label=label, values=motion_of(run, motion), colour=i, style=styles[i % len(styles)])
        for i, (label, run) in enumerate(runs)
    )
    return Panel(quantity=motion, unit="deg" if motion in ROTATIONS else "m", lines=lines)


def _motions(
    number: int, title: str, text: str, motions: Sequence[str], runs: Sequence[tuple[str, Result]]
) -> Sheet:
    return Sheet(
        title=f"Figure {number}: {title}",
        caption=text,
        abscissa=runs[0][1].time,
        panels=tuple(motion_panel(motion, runs) for motion in motions),
        columns=2 if len(motions) == 6 else 1,
    )


def figure_3(runs: PaperRuns) -> Sheet:
    """Six motions of the vessel alone, with and without fluid memory."""
    pair = [("with memory", runs.vessel), ("without memory", runs.vessel_without_memory)]
    text = "The vessel alone in the same waves, with and without the memory term mu of the radiated waves."
    return _motions(3, "vessel alone, with and without fluid memory", text, MOTIONS, pair)


def figure_5(runs: PaperRuns) -> Sheet:
    """Surge, sway and heave of cases 1 and 2."""
    pair = [("case 1, no payload", runs.case1), ("case 2, payload", runs.case2)]
    text = "Vessel with the crane swinging out, without and with the payload."
    return _motions(5, "surge, sway and heave, cases 1 and 2", text, TRANSLATIONS, pair)


def figure_6(runs: PaperRuns) -> Sheet:
    """Roll, pitch and yaw of cases 1 and 2."""
    pair = [("case 1, no payload", runs.case1), ("case 2, payload", runs.case2)]
    text = "Vessel with the crane swinging out, without and with the payload."
    return _motions(6, "roll, pitch and yaw, cases 1 and 2", text, ROTATIONS, pair)


def figure_7(runs: PaperRuns) -> Sheet:
    """Both strokes and the slew angle of case 3."""
    case3 = runs.case3
    panels = [
        Panel(
            quantity=f"stroke {number}",
            unit="m",
            lines=(Line(label="", values=case3.select("stroke", cylinder=name)),),
        )
        for number, name in enumerate(case3.coords["cylinder"], 1)
    ]
    slew = Line(label="", values=np.rad2deg(case3["slew_angle"]))
    panels.append(Panel(quantity="slew angle", unit="deg", lines=(slew,)))
    return Sheet(
        title="Figure 7: cylinder strokes and slew angle, case 3",
        caption="Strokes of the main (1) and knuckle (2) cylinder, and the slew angle of king against tower, "
        "the paper's difference of phi_z between bodies 2 and 1.",
        abscissa=case3.time,
        panels=tuple(panels),
    )


def figure_8(runs: PaperRuns) -> Sheet:
    """Surge, sway and heave of cases 1 and 3."""
    pair = [("case 1", runs.case1), ("case 3, cylinders oscillate", runs.case3)]
    text = "Crane that comes to rest against one whose cylinders oscillate with a 5 s period from 50 s on."
    return _motions(8, "surge, sway and heave, cases 1 and 3", text, TRANSLATIONS, pair)


def figure_9(runs: PaperRuns) -> Sheet:
    """Roll, pitch and yaw of cases 1 and 3."""
    pair = [("case 1", runs.case1), ("case 3, cylinders oscillate", runs.case3)]
    text = "Crane that comes to rest against one whose cylinders oscillate with a 5 s period from 50 s on."
    return _motions(9, "roll, pitch and yaw, cases 1 and 3", text, ROTATIONS, pair)


def figure_10(runs: PaperRuns) -> Sheet:
    """Heave of case 3 minus heave of case 1."""
    require_same_times(runs.case3, runs.case1)
    difference = motion_of(runs.case3, "heave") - motion_of(runs.case1, "heave")
    line = Line(label="", values=difference)
    return Sheet(
        title="Figure 10: heave of case 3 minus heave of case 1",
        caption="What the oscillating cylinders add to the heave.",
        abscissa=runs.case1.time,
        panels=(Panel(quantity="heave, case 3 - case 1", unit="m", lines=(line,)),),
    )


def require_same_times(first: Result, second: Result) -> None:
    """Raise ValueError unless two runs were recorded at the same times."""
    if not np.array_equal(first.time, second.time):
        raise ValueError(
            f"runs {first.stats['scene']!r} and {second.stats['scene']!r} were recorded at different times: "
            f"{first.time.size} outputs to {first.time[-1]:g} s, "
            f"{second.time.size} outputs to {second.time[-1]:g} s; "
            "give both the same t_end and dt_out"
        )


TIME_FIGURES: dict[int, Callable[[PaperRuns], Sheet]] = {
    3: figure_3,
    5: figure_5,
    6: figure_6,
    7: figure_7,
    8: figure_8,
    9: figure_9,
    10: figure_10,
}


def save_paper_figures(
    *, runs: PaperRuns, folder: Path, skeleton: Skeleton | None = None
) -> dict[int, Picture]:
    """Write ``figure_03.png`` to ``figure_10.png``, and the data behind them as ``figure_NN.csv``.

    Parameters
    ----------
    runs : PaperRuns
        Five runs of equal output times.
    folder : Path
        Existing folder.
    skeleton : mapping of str to sequence of ndarray, optional
        Lines of each body for figure 4, see `seacrane.pictures.pose`; the shipped crane's if None.

    Returns
    -------
    dict of int to Picture
        By figure number, in order.

    Raises
    ------
    ValueError
        If the runs were not recorded at the same times.
    """
    for other in (runs.vessel_without_memory, runs.case1, runs.case2, runs.case3):
        require_same_times(runs.vessel, other)
    pictures = {
        number: save_sheet(sheet(runs), folder, f"figure_{number:02d}")
        for number, sheet in TIME_FIGURES.items()
    }
    lines = crane_skeleton() if skeleton is None else skeleton
    pictures[4] = save_pose_figure(result=runs.case2, folder=folder, skeleton=lines, thick=BARRELS)
    return dict(sorted(pictures.items()))


def crane_skeleton(
    crane: Crane | None = None, *, foot: tuple[float, float, float] | None = None
) -> dict[str, list[Array]]:
    """Lines of the eight crane bodies for `seacrane.pictures.pose`.

    Parameters
    ----------
    crane : The shipped crane if None.
    foot : (float, float, float), optional
        Crane foot in the vessel frame, m; the shipped place if None.

    Returns
    -------
    dict of str to list of ndarray (k, 3)
        m, in each body's frame, relative to its centre of mass; the first line of `knuckle_jib` ends at the
        crane's tip.
    """
    parts = (crane or load_crane()).parts(foot=foot or FOOT)
    records = {record.name: record for record in parts.bodies}
    points = {joint.name: joint.point for joint in parts.joints} | {"link": parts.tip[1]}
    lines = {
        body: [_in_body(records[body], np.array([points[joint] for joint in path])) for path in paths]
        for body, paths in THROUGH_JOINTS.items()
    }
    for cylinder, (start, end) in CYLINDERS.items():
        for part, shares in (("barrel", BARREL), ("rod", ROD)):
            ends = points[start] + np.outer(shares, points[end] - points[start])
            lines[f"{cylinder}_{part}"] = [_in_body(records[f"{cylinder}_{part}"], ends)]
    return lines


def _in_body(record: BodyRecord, points: Array) -> Array:
    """Points of the vessel frame at the described pose, relative to the centre of mass, body axes."""
    relative: Array = (points - record.position) @ rotation_matrix(record.quaternion)
    return relative - record.center_of_mass
