"""The first and last pose of a run in three dimensions, as lines carried by the bodies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.inputs.frames import rotation_matrix
from seacrane.plotting.panel import COLOURS, MOST_NAMED, Picture, new_figure, plain, save_figure, save_table
from seacrane.result import Result

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Skeleton = Mapping[str, Sequence[Array]]
"""Lines of each body, each of shape (k, 3), m, in the body's frame, relative to its centre of mass."""

HULL = "vessel"  # body that is drawn as a ship where the result does not tell its ships
LONG = 3.0  # edge over the next one from which a box is drawn as a line
VIEW = {"elev": 20, "azim": 120}  # from port and a little aft


def hull_lines(
    *, length: float = 115.0, beam: float = 25.0, bottom: float = -6.4, deck: float = 10.0
) -> list[Array]:
    """Deck and bottom outline of a ship with a pointed bow, about {0} on the waterline amidships, m."""
    half, side, bow = length / 2, beam / 2, 0.15 * length
    plan = np.array([(-half, -side), (half - bow, -side), (half, 0), (half - bow, side), (-half, side)])
    closed = np.vstack([plan, plan[:1]])
    outlines = [np.column_stack([closed, np.full(len(closed), level)]) for level in (deck, bottom)]
    uprights = [np.array([(x, y, bottom), (x, y, deck)]) for x, y in plan]
    return [*outlines, *uprights]


def outlined_skeleton(result: Result) -> dict[str, list[Array]]:
    """Lines of every body by what the run noted of its scene; empty where it noted nothing, or no poses."""
    if not {"position", "quaternion"} <= set(result.channels):
        return {}
    bodies = result.about.outline.get("bodies", {})
    found = {name: _outlined(bodies[name]) for name in bodies if name in result.coords["body"]}
    return {name: lines for name, lines in found.items() if lines}


def _outlined(about: Mapping[str, Any]) -> list[Array]:
    if "ship" in about:
        length, breadth = about["ship"]["length"], about["ship"]["breadth"]
        hull = hull_lines(length=length, beam=breadth, bottom=-0.25 * breadth, deck=0.4 * breadth)
        return [line + np.array(about["ship"]["origin"]) for line in hull]
    points, box = np.array(about["points"], dtype=float).reshape(-1, 3), np.array(about["box"], dtype=float)
    if len(points) > 1:
        middle = points - points.mean(axis=0)
        along = np.linalg.svd(middle, full_matrices=False)[2][0]
        return [points[np.argsort(middle @ along, kind="stable")]]
    arms = [np.array([point, np.zeros(3)]) for point in points if point.any()]
    edges = np.sort(box)
    if edges[2] > LONG * edges[1]:
        end = np.where(np.arange(3) == box.argmax(), 0.5 * box, 0.0)
        return [np.array([-end, end]), *arms]
    if not edges[1] > 0:
        return arms
    corners = 0.5 * box * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)])[:, [0, 1, 1]]
    top, bottom = corners.copy(), corners.copy()
    top[:, 2], bottom[:, 2] = 0.5 * box[2], -0.5 * box[2]
    return [top, bottom, *(np.array([top[i], bottom[i]]) for i in range(4)), *arms]


def _pose(result: Result, body: str, index: int) -> tuple[Array, Array]:
    turn = rotation_matrix(result.select("quaternion", body=body)[index])
    return turn, result.select("position", body=body)[index]


def posed_lines(result: Result, skeleton: Skeleton, index: int) -> Iterator[tuple[str, int, Array]]:
    """Body, number of its line, and the line's points (k, 3), m, in inertial axes at one output."""
    for body, lines in skeleton.items():
        turn, centre = _pose(result, body, index)
        for number, line in enumerate(lines):
            yield body, number, centre + line @ turn.T


def link_lines(result: Result, index: int) -> list[Array]:
    """Links, wires and springs (2, 3) at one output, between the points that the run noted, inertial axes."""

    def place(body: str, point: Sequence[float]) -> Array:
        if body not in result.coords["body"]:
            return np.asarray(point, dtype=float)
        turn, centre = _pose(result, body, index)
        return np.asarray(centre + turn @ np.asarray(point, dtype=float))

    links = result.about.outline.get("links", [])
    return [np.array([place(first, start), place(second, end)]) for first, start, second, end in links]


def save_pose_figure(*, result: Result, folder: Path, stem: str = "figure_04") -> Picture:
    """Figure 4: the first and last pose of a run as `stem`.png, and every point drawn as `stem`.csv."""
    title = "Figure 4: initial and final pose, case 2"
    image = save_figure(_draw_poses(result, title), folder / f"{stem}.png")
    rows = []
    for name, index in (("initial", 0), ("final", -1)):
        drawn = list(posed_lines(result, outlined_skeleton(result), index))
        drawn += [("link", number, link) for number, link in enumerate(link_lines(result, index))]
        for body, number, points in drawn:
            rows += [[name, body, number, i, *point] for i, point in enumerate(points.tolist())]
    names = ["pose", "body", "line", "point", "x [m]", "y [m]", "z [m]"]
    caption = f"First ({result.time[0]:g} s) and last ({result.time[-1]:g} s) pose of case 2."
    data = save_table(names, rows, folder / f"{stem}.csv")
    return Picture(title=title, caption=caption, image=image, data=data)


def _draw_poses(result: Result, title: str) -> Figure:
    """First and last pose side by side, in equal scales and limits, seen from port and a little aft."""
    skeleton = outlined_skeleton(result)
    if not skeleton:
        raise ValueError(
            f"the result of {result.stats['scene']!r} holds no poses or no outline to draw; record position "
            "and quaternion"
        )
    figure = new_figure(figsize=(13.0, 5.6))
    bodies = result.about.outline.get("bodies", {})
    ships = [name for name, about in bodies.items() if "ship" in about] or [HULL]
    payloads = str(result.stats.get("payload", "")).splitlines()
    own = {**dict.fromkeys(ships, "0.45"), **dict.fromkeys(payloads, "#8B0000")}
    drawn = {index: list(posed_lines(result, skeleton, index)) for index in (0, -1)}
    links = {index: link_lines(result, index) for index in (0, -1)}
    points = np.vstack([line for i in (0, -1) for line in [*(one[2] for one in drawn[i]), *links[i]]])
    low, high = points.min(axis=0), points.max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    half = np.maximum(half, 0.2 * half.max() if half.max() > 0 else 1.0)  # no side is thinner than a fifth
    low, high = middle - half, middle + half
    for place, (name, index) in enumerate((("start", 0), ("end", -1))):
        box = (0.01 + 0.5 * place, 0.04, 0.44, 0.94)
        axes: Any = figure.add_axes(box, projection="3d", proj_type="ortho")
        for body, number, line in drawn[index]:
            width = 0.8 if body in ships else 2.0
            colour = own.get(body, COLOURS[list(skeleton).index(body) % len(COLOURS)])
            label = plain(body) if number == 0 else None
            axes.plot(*line.T, color=colour, linewidth=width, label=label, solid_capstyle="butt")
        for number, link in enumerate(links[index]):
            axes.plot(*link.T, color="black", linewidth=1.0, label=None if number else "link")
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
        axes.set_box_aspect(high - low, zoom=1.05 if high[2] - low[2] < 0.5 * np.ptp(points) else 0.9)
        axes.view_init(**VIEW)
        axes.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        axes.tick_params(labelsize=7)
        for axis in "xyz":
            axes.locator_params(axis=axis, nbins=5)
        figure.text(box[0] + box[2] / 2, 0.9, f"{name}, {result.time[index]:g} s", ha="center")
    handles, labels = axes.get_legend_handles_labels()
    if len(handles) <= MOST_NAMED:
        figure.legend(handles, labels, loc="lower center", ncols=6, fontsize=8, frameon=False)
    figure.suptitle(plain(title), fontsize=11)
    return figure


def plot_scene(result: Result) -> Figure:
    """Draw the first and the last pose of any run: bodies as lines through their joints, ships and boxes.

    Ships have the length and breadth of their radii of gyration, boxes the inertia of their bodies.

    Raises
    ------
    ValueError
        If the result holds no poses, or no outline of its bodies.
    """
    return _draw_poses(result, str(result.stats["scene"]))
