"""Pictures: allowable Hs as a map or rosette, and weather windows by month."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of
from seacrane.inputs.described import described
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs, letters
from seacrane.operability.windows import MONTHS, WeatherWindows
from seacrane.plotting.figure import new_figure
from seacrane.plotting.panel import COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DARK = 0.6  # of the colour scale, above which figures on it are black
STYLES = ("-", "--", ":", "-.")


def plot_allowable_hs(table: AllowableHs, *, kind: str = "map", forecast: bool = False) -> Figure:
    """Draw allowable Hs over peak period and direction of travel.

    Parameters
    ----------
    kind : str
        "map" (default): colours and numbers, with the letter of what governs; in a frame where runs told it.
        "rosette": Hs over the direction, a curve for each period, drawn where the waves come from with the
        bow upwards.
    forecast : bool
        With the alpha factor; default without.

    Raises
    ------
    SceneError
        For something else.
    """
    if not isinstance(table, AllowableHs):
        raise SceneError(f"table is {described(table)}; give what allowable_hs() returns")
    if kind not in ("map", "rosette"):
        raise SceneError(f"kind is {shown(kind)}; choose 'map' or 'rosette'")
    with_alpha = flag_of("forecast", forecast)
    figure = new_figure(figsize=(7.2, 5.4), layout="constrained")
    name = "forecast_hs" if with_alpha else "allowable_hs"
    (_map if kind == "map" else _rosette)(figure, table, table.dataset[name].to_numpy())
    what = "allowable Hs in a forecast" if with_alpha else "allowable Hs"
    figure.suptitle(f"{table.scene}: {what}", fontsize=11)
    figure.supxlabel("\n".join(_notes(table, with_alpha, kind)), fontsize=7, ha="left", x=0.02)
    return figure


def _notes(table: AllowableHs, with_alpha: bool, kind: str) -> list[str]:
    told = table.alpha.told(hours=table.hours)
    notes = table.told_criteria()
    if kind == "map":
        notes.append("in a frame: by runs, else by the linear model; >: no criterion is reached")
    return [*notes, told if with_alpha else f"{told}: not in these numbers"]


def _map(figure: Figure, table: AllowableHs, values: Any) -> None:
    from matplotlib.patches import Rectangle

    axes = figure.subplots()
    image = axes.imshow(values, cmap="viridis", origin="lower", aspect="auto", vmin=0.0)
    figure.colorbar(image, ax=axes, label="Hs [m]")
    data = table.dataset
    _ticks(axes, data)
    top = max(float(np.max(values, initial=0.0, where=np.isfinite(values))), 1e-9)
    names = [one.name for one in table.criteria]
    for i in range(data.sizes["tp"]):
        for j in range(data.sizes["direction_deg"]):
            cell = data.isel(tp=i, direction_deg=j)
            governs = str(cell["governing"].item())
            text = (
                f"{values[i, j]:.2f} {letters()[names.index(governs)]}" if governs else f">{values[i, j]:.2f}"
            )
            text = "failed" if np.isnan(values[i, j]) else text
            colour = "black" if values[i, j] / top > DARK else "white"
            axes.text(j, i, text, ha="center", va="center", fontsize=8, color=colour)
            if cell["domain"].item() == "time":
                axes.add_patch(
                    Rectangle(
                        (j - 0.47, i - 0.46), 0.94, 0.92, fill=False, edgecolor=COLOURS[1], linewidth=1.6
                    )
                )


def _ticks(axes: Axes, data: Any) -> None:
    axes.set_xticks(
        range(data.sizes["direction_deg"]), [f"{one:g}" for one in data["direction_deg"].to_numpy()]
    )
    axes.set_yticks(range(data.sizes["tp"]), [f"{one:g}" for one in data["tp"].to_numpy()])
    axes.set(xlabel="direction of travel of the waves [deg], 180: head waves", ylabel="peak period [s]")


def _rosette(figure: Figure, table: AllowableHs, values: Any) -> None:
    axes: Any = figure.add_subplot(projection="polar")
    axes.set_theta_zero_location("S")  # head waves come from the top, where the bow points
    directions = table.dataset["direction_deg"].to_numpy()
    closed = directions[0] + 360.0 - directions[-1] <= 90.0
    angles = np.radians(np.append(directions, directions[0] + 360.0) if closed else directions)
    for k, (tp, row) in enumerate(zip(table.dataset["tp"].to_numpy(), values, strict=True)):
        curve = np.append(row, row[0]) if closed else row
        style = STYLES[k // len(COLOURS) % len(STYLES)]
        axes.plot(
            angles, curve, style, marker="o", markersize=3, color=COLOURS[k % len(COLOURS)], label=f"{tp:g} s"
        )
    axes.set_rlim(0.0, None)
    axes.set_rlabel_position(22.5)
    axes.grid(alpha=0.4)
    figure.legend(title="peak period", loc="outside right upper", fontsize=8, title_fontsize=8)


def plot_weather_windows(windows: WeatherWindows) -> Figure:
    """Draw shares of the time and waiting times by month.

    Raises
    ------
    SceneError
        For something else.
    """
    if not isinstance(windows, WeatherWindows):
        raise SceneError(f"windows is {described(windows)}; give what weather_windows() returns")
    figure = new_figure(figsize=(7.2, 5.4), layout="constrained")
    shares, waits = figure.subplots(2, sharex=True)
    data, months = windows.dataset, np.arange(12)
    for k, (name, label) in enumerate(
        (("workable_percent", "workable"), ("may_start_percent", f"{windows.hours:g} h may start"))
    ):
        shares.bar(months + 0.4 * (k - 0.5), data[name], 0.38, color=COLOURS[k], label=label)
    shares.set(ylabel="of the time [%]", ylim=(0.0, 100.0))
    for k, (name, label) in enumerate(
        (("waiting_mean", "mean"), ("waiting_p50", "P50"), ("waiting_p90", "P90"))
    ):
        waits.plot(months, data[name], "-o", markersize=4, color=COLOURS[k], label=label)
    waits.set(ylabel="waiting time [h]", ylim=(0.0, None))
    waits.set_xticks(months, MONTHS)
    for axes in (shares, waits):
        axes.grid(axis="y", alpha=0.4)
        axes.legend(fontsize=8)
    figure.suptitle(f"Windows of {windows.hours:g} h in {windows.source}", fontsize=11)
    figure.supxlabel(windows.alpha_factor, fontsize=7, ha="left", x=0.02)
    return figure
