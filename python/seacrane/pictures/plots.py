"""One picture of a run by one call: overview, histories, spectra, tracks, reactions; RAOs of a scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.analysis.frequency_domain import excitation_of, linear_of, motion_rao
from seacrane.errors import SceneError
from seacrane.inputs.frames import AXES_NOTE, MOTIONS
from seacrane.inputs.keywords import named
from seacrane.plotting.panel import (
    COLOURS,
    MOST_NAMED,
    Line,
    Panel,
    Sheet,
    draw,
    new_figure,
    plain,
    write_note,
)
from seacrane.result import Result
from seacrane.result.history import axes_note, marks_of, panels_of, title_of, wanted_traces
from seacrane.result.traces import Trace, beyond_rounding, shown_unit, traces

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from seacrane.analysis.linear_system import LinearModel
    from seacrane.scene.scene import Scene

FEWEST_OUTPUTS = 64  # of a spectrum
SEGMENTS = 8  # of a long record, half overlapping, that a spectrum is averaged over
RESOLVED = 100.0  # s: shorter segments are not taken where the record is longer
SHOWN = 0.999  # of the variance of every curve is drawn
VIEWS = ((0, 1, "from above"), (0, 2, "from starboard"), (1, 2, "from ahead"))
HEADINGS_DEG = (0.0, 45.0, 90.0, 135.0, 180.0)
Panels = list[tuple[str, list[Trace]]]


def resultants(result: Result, channel: str) -> list[Trace]:
    """Magnitudes of a channel's vectors, by what they belong to."""
    size = np.linalg.norm(result[channel], axis=-1)
    names = result.coords[result.dims[channel][1]]
    units = {"reaction_force": "N", "reaction_moment": "N m"}
    factor, unit = shown_unit(units[channel], [size])
    return [
        Trace(channel=channel, names=(name,), unit=unit, values=factor * size[:, i])
        for i, name in enumerate(names)
    ]


def payload_bodies(result: Result) -> list[str]:
    """What hangs on a link or wire, as the run noted it."""
    bodies = str(result.stats.get("payload", "")).splitlines()
    return [body for body in bodies if body in result.coords.get("body", ())]


def _vessels(result: Result) -> Panels:
    names = result.coords.get("vessel", ())
    several = [(name, traces(result, "vessel_motion", vessel=name)) for name in names]
    return several or [("vessel", traces(result, "vessel_motion"))]


def _channel(name: str) -> Callable[[Result], Panels]:
    return lambda result: [(name.replace("_", " "), traces(result, name))]


# Which channel brings which panels; a channel the run has not is left out of the picture.
PANELS: dict[str, Callable[[Result], Panels]] = {
    "vessel_motion": _vessels,
    "wave_elevation": _channel("wave_elevation"),
    "position": lambda result: [
        (f"{body} position", traces(result, "position", body=body)) for body in payload_bodies(result)
    ],
    **{
        name: _channel(name)
        for name in ("slew_angle", "stroke", "cylinder_force", "link_tension", "line_tension", "limit_force")
    },
    "reaction_force": lambda result: [("joint force", resultants(result, "reaction_force"))],
    "energy_balance": _channel("energy_balance"),
}


OWNERS = {"vessel_motion": "vessel", "position": "body"}  # dimensions that a panel's title names


def overview_sheet(result: Result) -> Sheet:
    """The panels of `plot_overview` with their numbers."""
    panels = _panels(result, beyond_rounding) or _panels(result, list)
    if not panels:
        held = ", ".join(result.channels) or "no channels"
        raise ValueError(f"a result with {held} has nothing to plot")
    return Sheet(
        title=title_of(result),
        caption=f"What was recorded; triangles mark the largest and the smallest value. {AXES_NOTE}",
        abscissa=result.time, panels=tuple(panels), columns=2 if len(panels) > 3 else 1,
        marks=marks_of(result), extremes=True,
    )  # fmt: skip


def _panels(result: Result, chosen: Callable[[list[Trace]], list[Trace]]) -> list[Panel]:
    return [
        panel
        for name, make in PANELS.items()
        if name in result.channels
        for quantity, found in make(result)
        for panel in panels_of(quantity, chosen(found), skip=int(OWNERS.get(name) in result.dims[name]))
    ]


@named
def plot_overview(result: Result) -> Figure:
    """Draw what any run recorded: motions, waves, payload, crane, forces and energy balance.

    What is zero up to rounding is left out, as the sway of a ship in head seas. Events of limits are marked,
    and the largest and the smallest value of every panel. ``figure.savefig(path)`` writes it.

    Raises
    ------
    ValueError
        If the run recorded nothing that is plotted.
    """
    return draw(overview_sheet(result), note=axes_note(result, result.channels))


def plot_spectrum(result: Result, *channels: str, after: float = 0.0, **names: str) -> Figure:
    """Draw one-sided densities of channels over omega, by averaged periodograms (Welch).

    The area below a curve is the variance about the mean.

    Parameters
    ----------
    result : Result
        At least 64 outputs, evenly spaced.
    after : float
        Leave out what comes before, s.
    **names : str
        As of `Result.plot`.

    Raises
    ------
    SceneError
        For a channel or name that the result does not hold, or a record that is too short or uneven.
    """
    return draw(spectrum_sheet(result, *channels, after=after, **names))


def spectrum_sheet(result: Result, *channels: str, after: float = 0.0, **names: str) -> Sheet:
    """The panels of `plot_spectrum` with their numbers."""
    from scipy.signal import welch

    found = wanted_traces(result, channels, names)
    kept = _even_part(result, after)
    step = float(result.time[kept][1] - result.time[kept][0])
    count = kept.stop - kept.start
    length = min(count, max(2 * count // (SEGMENTS + 1), round(RESOLVED / step), FEWEST_OUTPUTS))
    spectra = {
        channel: [welch(one.values[kept], 1.0 / step, nperseg=length) for one in every]
        for channel, every in found.items()
    }
    frequency = next(iter(spectra.values()))[0][0]
    sums = [np.cumsum(density) for every in spectra.values() for _, density in every if density.sum() > 0.0]
    # One past the frequency up to which every curve has shown nearly all of its variance.
    most = max((int(np.searchsorted(one, SHOWN * one[-1])) for one in sums), default=frequency.size)
    last = min(frequency.size, most + 3 + most // 3)
    omega, panels = 2.0 * np.pi * frequency[:last], []
    for channel, every in found.items():
        units = [one.unit if one.unit.isalpha() else f"({one.unit})" for one in every]
        densities = [
            replace(one, unit=f"{unit}2 s/rad", values=density[:last] / (2.0 * np.pi), bounds=None)
            for one, unit, (_, density) in zip(every, units, spectra[channel], strict=True)
        ]
        panels += panels_of(f"S, {channel.replace('_', ' ')}", densities)
    return Sheet(
        title=f"{title_of(result)}: spectra from {result.time[kept][0]:g} s on",
        caption="One-sided densities; the area below a curve is the variance about the mean.",
        abscissa=omega, abscissa_name="omega", abscissa_unit="rad/s", panels=tuple(panels),
        columns=2 if len(panels) > 3 else 1,
    )  # fmt: skip


def _even_part(result: Result, after: float) -> slice:
    """Outputs from a time on; without the last where it is early."""
    first = int(np.searchsorted(result.time, after))
    step = np.diff(result.time[first:])
    last = result.time.size - int(step.size > 1 and abs(step[-1] - step[0]) > 1e-6 * step[0])
    even = step[: last - first - 1]
    if last - first < FEWEST_OUTPUTS or np.ptp(even) > 1e-6 * even[0]:
        raise SceneError(
            f"after is {after:g} s: a spectrum takes {FEWEST_OUTPUTS} evenly spaced outputs or more, and "
            f"{max(last - first, 0)} follow; run longer, record more often, or start earlier"
        )
    return slice(first, last)


def plot_track(result: Result, *bodies: str) -> Figure:
    """Draw where centres of mass went, seen from above, from starboard and from ahead.

    Of what hangs by default, or all bodies where nothing does. A circle marks the start, a square the end;
    both axes of a view have the same scale.

    Raises
    ------
    SceneError
        For a body that is not in the result, or a result without `position`.
    """
    figure = draw_track(result, *bodies)
    write_note(figure, AXES_NOTE)
    return figure


def draw_track(result: Result, *bodies: str) -> Figure:
    """The figure of `plot_track` for a page that says its axes itself."""
    if "position" not in result.channels:
        raise SceneError("channel 'position' is not in this result; record it to draw tracks")
    chosen = bodies or tuple(payload_bodies(result)) or result.coords["body"]
    _require_there(result, "body", chosen)
    figure = new_figure(figsize=(12.0, 4.6), layout="constrained")
    for cell, (across, up, view) in zip(figure.subplots(1, 3), VIEWS, strict=True):
        for i, body in enumerate(chosen):
            place, colour = result.select("position", body=body), COLOURS[i % len(COLOURS)]
            x, y = place[:, across], place[:, up]
            cell.plot(x, y, color=colour, linewidth=1.1, label=plain(body))
            cell.plot(x[0], y[0], "o", color=colour, markersize=5, markerfacecolor="white")
            cell.plot(x[-1], y[-1], "s", color=colour, markersize=6, markeredgecolor="black", zorder=4)
        cell.set(xlabel=f"{'xyz'[across]} [m]", ylabel=f"{'xyz'[up]} [m]", title=view)
        cell.set_aspect("equal", adjustable="datalim")
        cell.title.set_fontsize(9)
        cell.grid(True, linewidth=0.4, alpha=0.6)
    handles = cell.get_legend_handles_labels()[0]
    if len(handles) <= MOST_NAMED:
        figure.legend(handles=handles, loc="outside lower center", ncols=6, fontsize=9, frameon=False)
    figure.suptitle(plain(f"{title_of(result)}: tracks, circle at the start, square at the end"), fontsize=11)
    return figure


def plot_reactions(result: Result, *joints: str) -> Figure:
    """Draw the size of joint forces and moments over time, of all joints by default.

    Raises
    ------
    SceneError
        For a joint that is not in the result, or a result without reactions.
    """
    held = [name for name in ("reaction_force", "reaction_moment") if name in result.channels]
    if not held:
        raise SceneError("channel 'reaction_force' is not in this result; record it to draw reactions")
    _require_there(result, "joint", joints)
    panels = []
    for name in held:
        asked = [one for one in resultants(result, name) if not joints or one.names[0] in joints]
        panels += panels_of(name.replace("_", " "), asked)
    return draw(Sheet(
        title=f"{title_of(result)}: reactions", caption="Sizes of what each joint exerts on its second body.",
        abscissa=result.time, panels=tuple(panels), marks=marks_of(result), extremes=True,
    ))  # fmt: skip


def _require_there(result: Result, kind: str, names: Iterable[str]) -> None:
    for name in names:
        if name not in result.coords[kind]:
            known = ", ".join(result.coords[kind])
            raise SceneError(f"{kind} {name!r} is not in this result; it holds {known}")


def plot_rao(
    scene: Scene | LinearModel,
    *,
    body: str,
    point: Any = (0.0, 0.0, 0.0),
    directions_deg: Sequence[float] = HEADINGS_DEG,
    omega: Any = None,
) -> Figure:
    """Draw the motion of a point of any body per metre of wave amplitude, over frequency.

    ``database.plot("motion")`` draws those of the vessel alone. A ship at a forward speed comes as a
    `linear_model` of its database. Arguments and errors are as of `motion_rao`.

    Parameters
    ----------
    directions_deg : sequence of float
        Directions that the waves travel to, deg; 0 following.
    omega : array_like, shape (n,), optional
        rad/s; default: the database's.
    """
    return draw(rao_sheet(scene, body, point, directions_deg, omega))


def rao_sheet(
    scene: Scene | LinearModel, body: str, point: Any, directions_deg: Sequence[float], omega: Any
) -> Sheet:
    """The panels of `plot_rao` with their numbers."""
    linear = linear_of(scene, None)
    database = excitation_of(linear, None)
    frequency = np.asarray(database.omega if omega is None else omega, dtype=float)
    heading = np.deg2rad(np.asarray(directions_deg, dtype=float))
    motion = np.abs(motion_rao(linear, omega=frequency, direction=heading[:, None], body=body, point=point))
    motion[..., 3:] = np.rad2deg(motion[..., 3:])
    panels = []
    for i, name in enumerate(("x", "y", "z", "about x", "about y", "about z")):
        lines = tuple(
            Line(label=f"{angle:g} deg", values=motion[j, :, i], colour=j)
            for j, angle in enumerate(directions_deg)
        )
        panels.append(Panel(quantity=name, unit="m/m" if i < 3 else "deg/m", lines=lines))
    return Sheet(
        title=f"Motion of {body} per metre of wave amplitude",
        caption=f"Linear response about rest; {', '.join(MOTIONS)} of a body that heads along x. The angle "
        "is the direction the waves travel to, 0 following.",
        abscissa=frequency, abscissa_name="omega", abscissa_unit="rad/s", panels=tuple(panels), columns=2,
        shaded=database.trusted_band,
    )  # fmt: skip
