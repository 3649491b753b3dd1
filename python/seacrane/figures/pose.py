"""Figure 4: the first and last pose of a run in three dimensions, as lines carried by the bodies."""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.frames import rotation_matrix
from seacrane.plotting.panel import COLOURS, Picture, plain, save_figure, save_table
from seacrane.result import Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Skeleton = Mapping[str, Sequence[Array]]
"""Lines of each body, each of shape (k, 3), m, in the body's frame, relative to its centre of mass."""

HULL = "vessel"  # body that is drawn as a ship
HALF_TURN = np.array([-1.0, -1.0, 1.0])  # our axes to the paper's: x aft, y starboard, z up


def hull_lines(
    *,
    length: float = 115.0,
    beam: float = 25.0,
    bottom: float = -6.4,
    deck: float = 10.0,
) -> list[Array]:
    """Deck and bottom outline of a ship with a pointed bow, about {0} on the waterline amidships, m."""
    half, side, bow = length / 2, beam / 2, 0.15 * length
    plan = np.array([(-half, -side), (half - bow, -side), (half, 0), (half - bow, side), (-half, side)])
    outlines = [
        np.column_stack([np.vstack([plan, plan[:1]]), np.full(len(plan) + 1, level)])
        for level in (deck, bottom)
    ]
    uprights = [np.array([(x, y, bottom), (x, y, deck)]) for x, y in plan]
    return [*outlines, *uprights]


def box_lines(size: Sequence[float]) -> list[Array]:
    """Edges of a box about its centre; `size` (3,) in m."""
    corners = 0.5 * np.array(size) * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)])[:, [0, 1, 1]]
    top, bottom = corners.copy(), corners.copy()
    top[:, 2], bottom[:, 2] = 0.5 * size[2], -0.5 * size[2]
    return [top, bottom, *(np.array([top[i], bottom[i]]) for i in range(4))]


def complete_skeleton(
    result: Result, skeleton: Skeleton | None, payload_size: Sequence[float] = (6.0, 6.0, 4.0)
) -> dict[str, list[Array]]:
    """The lines given, with the hull's outline and the payload's box where none are given for them."""
    lines = {body: [np.asarray(line, float) for line in given] for body, given in (skeleton or {}).items()}
    bodies = result.coords["body"]
    unknown = sorted(set(lines) - set(bodies))
    if unknown:
        raise ValueError(f"skeleton names {', '.join(unknown)}; the result holds {', '.join(bodies)}")
    for body, polylines in lines.items():
        for line in polylines:
            if line.ndim != 2 or line.shape[1] != 3 or len(line) < 2 or not np.isfinite(line).all():
                raise ValueError(
                    f"a line of {body!r} has shape {line.shape}; give finite points (k, 3), k >= 2"
                )
    if HULL in bodies and HULL not in lines:
        turn, centre = _pose(result, HULL, 0)
        lines[HULL] = [(line - centre) @ turn for line in hull_lines()]
    for _, payload in _hung(result):
        lines.setdefault(payload, box_lines(payload_size))
    return lines


def _hung(result: Result) -> list[tuple[str, str]]:
    """Bodies that carry a crane's tip, and what hangs there."""
    cranes = json.loads(str(result.stats.get("cranes", "[]")))
    ends = [(crane["tip"]["body"], crane["payload"]) for crane in cranes if crane["tip"] and crane["payload"]]
    return [(jib, payload) for jib, payload in ends if {jib, payload} <= set(result.coords["body"])]


def _pose(result: Result, body: str, index: int) -> tuple[Array, Array]:
    turn = rotation_matrix(result.select("quaternion", body=body)[index])
    return turn, result.select("position", body=body)[index]


def posed_lines(result: Result, skeleton: Skeleton, index: int) -> Iterator[tuple[str, int, Array]]:
    """Body, number of its line, and the line's points (k, 3), m, in the paper's axes at one output."""
    for body, lines in skeleton.items():
        turn, centre = _pose(result, body, index)
        for number, line in enumerate(lines):
            yield body, number, HALF_TURN * (centre + line @ turn.T)


def wire_lines(result: Result, skeleton: Skeleton, index: int) -> list[Array]:
    """Links from tips, the last points of the first lines of what carries them, to the payloads' tops."""
    return [_wire(result, skeleton, index, *ends) for ends in _hung(result) if set(ends) <= set(skeleton)]


def _wire(result: Result, skeleton: Skeleton, index: int, jib: str, payload: str) -> Array:
    turn, centre = _pose(result, jib, index)
    tip = centre + turn @ skeleton[jib][0][-1]
    turn, centre = _pose(result, payload, index)
    height = max(float(line[:, 2].max()) for line in skeleton[payload])
    ends: Array = HALF_TURN * np.array([tip, centre + turn @ np.array([0.0, 0.0, height])])
    return ends


def save_pose_figure(
    *,
    result: Result,
    folder: Path,
    skeleton: Skeleton | None = None,
    thick: Collection[str] = (),
    stem: str = "figure_04",
) -> Picture:
    """Write the first and last pose of a run as `stem`.png, and every point drawn as `stem`.csv.

    Parameters
    ----------
    result : Result
        A run with `position` and `quaternion`.
    folder : Path
        Existing folder.
    skeleton : mapping of str to sequence of ndarray (k, 3), optional
        Lines of each body relative to its centre of mass in its own frame, m. The first line of what carries
        a crane's tip ends there. Hull and payload are added where absent.
    thick : collection of str
        Bodies that are drawn thick.
    """
    lines = complete_skeleton(result, skeleton)
    caption = (
        f"First ({result.time[0]:g} s) and last ({result.time[-1]:g} s) pose of case 2. "
        "Axes of the paper: x aft, y starboard, z up, about {0} at the start."
    )
    rows = []
    for name, index in (("initial", 0), ("final", -1)):
        drawn = list(posed_lines(result, lines, index))
        drawn += [("link", number, wire) for number, wire in enumerate(wire_lines(result, lines, index))]
        for body, number, points in drawn:
            rows += [[name, body, number, i, *point] for i, point in enumerate(points.tolist())]
    data = save_table(
        ["pose", "body", "line", "point", "x aft [m]", "y starboard [m]", "z up [m]"],
        rows,
        folder / f"{stem}.csv",
    )
    image = save_figure(draw_poses(result, lines, thick), folder / f"{stem}.png")
    title = "Figure 4: initial and final pose, case 2"
    return Picture(title=title, caption=caption, image=image, data=data)


def draw_poses(result: Result, skeleton: Skeleton, thick: Collection[str] = ()) -> Figure:
    """First and last pose side by side, in equal scales and limits, seen from port and a little aft."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(13.0, 6.4))
    own = {HULL: "0.6", **{payload: "#8B0000" for _, payload in _hung(result)}}
    points = np.vstack([line for index in (0, -1) for _, _, line in posed_lines(result, skeleton, index)])
    low, high = points.min(axis=0), points.max(axis=0)
    for place, (name, index) in enumerate((("initial", 0), ("final", -1))):
        box = (0.01 + 0.5 * place, 0.04, 0.44, 0.94)
        axes: Any = figure.add_axes(box, projection="3d", proj_type="ortho")
        for body, number, line in posed_lines(result, skeleton, index):
            width = 0.8 if body == HULL else 4.0 if body in thick else 1.6
            colour = own.get(body, COLOURS[list(skeleton).index(body) % len(COLOURS)])
            label = plain(body) if number == 0 else None
            axes.plot(*line.T, color=colour, linewidth=width, label=label, solid_capstyle="butt")
        for number, wire in enumerate(wire_lines(result, skeleton, index)):
            axes.plot(*wire.T, color="black", linewidth=1.0, label=None if number else "link")
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        axes.set_box_aspect(high - low, zoom=0.96)
        axes.view_init(elev=20, azim=-60)
        axes.set(xlabel="x aft [m]", ylabel="y starboard [m]", zlabel="z up [m]")
        axes.tick_params(labelsize=7)
        figure.text(box[0] + box[2] / 2, 0.84, f"{name}, {result.time[index]:g} s", ha="center")
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncols=6, fontsize=8, frameon=False)
    figure.suptitle("Figure 4: initial and final pose, case 2 (x aft, y starboard, z up)", fontsize=11)
    return figure
