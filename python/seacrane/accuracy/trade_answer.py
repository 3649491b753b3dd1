"""What trade() measured, as an answer: rows, front, the cheapest setting, table and picture."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane._core import integrators
from seacrane.accuracy.measured import Reference
from seacrane.accuracy.quantities import Quantity, limits_of
from seacrane.accuracy.row import Row, front
from seacrane.errors import SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.checked import positive_of
from seacrane.inputs.shown import shown
from seacrane.plotting.panel import new_figure, plain
from seacrane.plotting.table import Answer, Column, Table
from seacrane.run.method import DEFAULT_INTEGRATOR, DEFAULT_TOLERANCE, Method

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

MEASURED = ("wall_s", "simulated_s", "evaluations", "drift", "energy", "stable")
ERRORS = {"error": "largest", "rms": "rms", "std": "std"}
OTHERS = 0.01  # of its motion, that a default quantity may err by which nobody names
ORDER = next(one.order for one in integrators() if one.name == DEFAULT_INTEGRATOR)
ALIKE = 1.15  # times the least cost, which is no more than that
MARKERS = "ovs^Dp*hXP"
OTHER = "0.72"  # the grey of methods that some other beats everywhere
HEIGHT, WIDTH = 4.0, 7.5  # inches, of a panel
ROOM = 3.0  # times the largest cost: room for names on the right
COSTS = {
    "wall_s": "wall time per simulated second [ms]",
    "cpu_s": "CPU time per simulated second [ms]",
}


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trade(Answer):
    """Measured cost and error of the settings of one scene. Made by `trade`.

    Attributes
    ----------
    rows : tuple of Row
        One for each setting.
    quantities : mapping of str to Quantity
        What errors are measured in; the first one decides on `pareto`.
    reference : Reference
        The tight runs and, per quantity, how far they differ: no error below that can be told.
    metadata : mapping
        Scene, version, times, machine independent.
    told_s, took_s : float
        Processor time as told beforehand, and as it was, s.
    not_measured : int
        Settings that might still change the front when the budget ended; 0: none could.
    """

    rows: tuple[Row, ...]
    quantities: Mapping[str, Quantity]
    reference: Reference
    metadata: Mapping[str, Any]
    told_s: float = np.nan
    took_s: float = np.nan
    not_measured: int = 0

    def _data(self) -> Table:
        """All rows: settings, cost, and of each quantity `error_`, `rms_` and `std_` with its name."""
        rows, names = self.rows, list(self.quantities)
        asked = ("integrator", "setting", "rtol", "dt")
        columns: dict[str, list[Any]] = {
            "formulation": [row.formulation for row in rows],
            **{key: [getattr(row.method, key) for row in rows] for key in asked},
            **{name: [getattr(row, name) for row in rows] for name in MEASURED},
            "wall_per_simulated_s": [row.wall_s / row.simulated_s for row in rows],
            "reason": [row.message for row in rows],
            "pareto": front(rows, names[0]),
        }
        errors = [
            Column(
                name=f"{kind}_{name}", unit=self.quantities[name].unit,
                values=[getattr(row.errors[name], part) if name in row.errors else None for row in rows],
            )
            for kind, part in ERRORS.items() for name in names
        ]  # fmt: skip
        known = {f"uncertainty_{name}": value for name, value in self.reference.uncertainty.items()}
        return Table(
            axes=[Column(name="row", values=range(len(rows)))],
            columns=[*(Column(name=name, values=values) for name, values in columns.items()), *errors],
            attributes={**self.metadata, **known},
        )

    @property
    def pareto(self) -> list[Row]:
        """Rows that no other beats in both CPU time and error of the first quantity, cheapest first."""
        return self.front(next(iter(self.quantities)))

    def front(self, quantity: str) -> list[Row]:
        """As `pareto`, for any quantity."""
        limits_of(self.quantities, {quantity: 1.0})
        kept = [row for row, on in zip(self.rows, front(self.rows, quantity), strict=True) if on]
        return sorted(kept, key=lambda row: row.cpu_s)

    def cheapest(self, *, others: float | None = OTHERS, **accuracy: float) -> Method:
        """The method of the cheapest run whose largest errors stay within the limits.

        Of settings that cost about the same, one that controls its error is taken before a fixed step, and
        then the most accurate.

        Parameters
        ----------
        others : float or None
            Largest error of every default quantity that is not named, over its motion (0.01); what the
            reference itself does not know is not asked. None: they may err by anything.
        **accuracy : float
            Largest error by quantity, in its unit, such as ``payload_position=0.01``.

        Returns
        -------
        Method
            For ``simulate(scene, method=...)``.

        Raises
        ------
        SceneError
            If no setting meets them: it names the smallest error reached and what sets it.
        """
        limits = limits_of(self.quantities, accuracy)
        for name, limit in limits.items():
            self._check_reach(name, limit)
        limits = {**self._of_others(others), **limits}
        passing = [
            row
            for row in self.rows
            if row.stable and all(row.error(name) <= limit for name, limit in limits.items())
        ]
        if not passing:
            raise SceneError(
                f"accuracy: no setting that was measured reaches all of {limits}; give others=None, which "
                "holds the quantities that are named alone, or a larger budget"
            )
        least = min(row.cpu_s for row in passing)
        alike = [row for row in passing if row.cpu_s <= ALIKE * least]

        def worst(row: Row) -> float:
            return max(row.error(name) / limit if limit > 0.0 else 0.0 for name, limit in limits.items())

        best = min(alike, key=lambda row: (row.method.dt is not None, worst(row)))
        return replace(best.method, formulation=best.formulation)

    def _of_others(self, share: float | None) -> dict[str, float]:
        """The largest errors of the default quantities."""
        if share is None or not self.metadata["default quantities"]:
            return {}
        share = positive_of("cheapest: others", share)
        motion, known = self.reference.motion, self.reference.uncertainty
        return {name: max(share * motion[name], known[name]) for name in self.quantities}

    def _check_reach(self, name: str, limit: float) -> None:
        unit, known = self.quantities[name].unit, self.reference.uncertainty[name]
        if limit < known:
            raise SceneError(
                f"accuracy: {name} of {limit:g} {unit} cannot be reached: the limit is {known:.3g} {unit}, "
                "set by rounding: by that much the tight reference runs differ among themselves"
            )
        rows = [row for row in self.rows if row.stable]
        best = min(rows, key=lambda row: row.error(name), default=None)
        if best is None or best.error(name) > limit:
            least = "none"
            if best is not None:
                by = f"{best.formulation}, {best.method.integrator}, {best.method.setting}"
                least = f"{best.error(name):.3g} {unit} ({by})"
            raise SceneError(
                f"accuracy: {name} of {limit:g} {unit} is beyond this grid: its smallest error is "
                f"{least}, set by the local error of the time integration; simulate(accuracy=...) tries "
                "finer tolerances"
            )

    def __repr__(self) -> str:
        stable = sum(row.stable for row in self.rows)
        return (
            f"<Trade of {self.metadata['scene']!r}, {self.metadata['t_end']:g} s: {len(self.rows)} rows, "
            f"{stable} of them stable, errors in {', '.join(self.quantities)}>"
        )

    @property
    def default(self) -> str:
        """What the default setting costs and errs by, and what half of each error costs."""
        rows = [row for row in self.rows if row.stable]
        row = next((row for row in rows if row.method.integrator == DEFAULT_INTEGRATOR and row.method.rtol
                    == DEFAULT_TOLERANCE), None)  # fmt: skip
        if row is None:
            return "the default was not measured"
        wrong = ", ".join(f"{name} {row.error(name):.2g} {one.unit}" for name, one in self.quantities.items())
        told = (
            f"the default ({row.method.integrator} {row.method.setting}) takes {_ms(row)} and errs by {wrong}"
        )
        better = [one for one in rows if all(2.0 * one.error(q) <= row.error(q) for q in self.quantities)]
        if not better:
            more = 100.0 * (2.0 ** (1.0 / ORDER) - 1.0)
            return f"{told}; half of each costs about {more:.0f} % more by its order, and was not measured"
        half = min(better, key=lambda one: one.cpu_s)
        return f"{told}; half of each or less: {half.method.integrator} {half.method.setting}, {_ms(half)}"

    @property
    def price(self) -> str:
        """What it cost, what was told beforehand, and whether the budget ended it."""
        told = f"took {self.took_s:.2g} s of CPU; told {self.told_s:.2g} s"
        if self.not_measured:
            return f"{told}. The budget ended before {self.not_measured} settings that may change the front"
        return f"{told}. No setting that was left out is expected to change the front"

    def _shown(self) -> Table:
        said = ["errors are those of the extremes of each stage"] if self.metadata.get("stages") else []
        known = self.reference.uncertainty
        told = ", ".join(f"{name} {known[name]:.1g} {one.unit}" for name, one in self.quantities.items())
        unstable = sum(not row.stable for row in self.rows)
        title = (
            f"reference known within {told}\n{len(self.rows)} rows, {unstable} of them not stable; Pareto "
            f"front in {next(iter(self.quantities))}:"
        )
        best = self.pareto
        first, *texts = [
            Column(head="formulation", values=[row.formulation for row in best]),
            Column(head="integrator", values=[row.method.integrator for row in best]),
            Column(head="setting", values=[row.method.setting for row in best]),
        ]
        cost = Column(head="CPU [ms]", values=[1e3 * row.cpu_s for row in best], form=".3g")
        errors = [
            Column(head=f"{name} [{one.unit}]", values=[row.error(name) for row in best], form=".2g")
            for name, one in self.quantities.items()
        ]
        said = [*said, self.default, self.price]
        return Table(axes=[first], columns=[*texts, cost, *errors], title=title, remarks=said)

    def plot(self, *, over: str = "cpu_s") -> Figure:
        """Work-precision diagrams: error of each quantity over cost.

        A line for each integrator, through those of its settings that none of its own beats; in colour where
        it is on the Pareto front of some quantity. The grey band is the reference's uncertainty.

        Parameters
        ----------
        over : str
            "cpu_s": CPU time per simulated second. "wall_s": wall time, which depends on what else the
            machine does.

        Raises
        ------
        SceneError
            If `over` is neither.
        """
        if over not in COSTS:
            raise SceneError(f"plot: over is {shown(over)}; give {' or '.join(COSTS)}")
        return _work_precision(self, over)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write trade.csv and trade.png into a folder."""
        self.to_csv(Path(folder) / "trade.csv")
        with atomic_write(Path(folder) / "trade.png") as draft:
            self.plot().savefig(draft, format="png", dpi=110)


def _ms(row: Row) -> str:
    return f"{1e3 * row.cpu_s:.3g} ms"


def _work_precision(trade: Trade, over: str) -> Figure:
    """The panels of `Trade.plot`."""
    rows = [row for row in trade.rows if row.stable and getattr(row, over) > 0]
    measured, known = trade.quantities, trade.reference.uncertainty
    fronts = {name: _own_front(rows, name, over) for name in measured}
    best = dict.fromkeys(row.method.integrator for on in fronts.values() for row in on)
    looks = {name: (f"C{n % 10}", MARKERS[n % len(MARKERS)]) for n, name in enumerate(best)}
    figure = new_figure(figsize=(WIDTH, HEIGHT * len(measured) + 1.0), layout="constrained")
    panels = figure.subplots(len(measured), squeeze=False)[:, 0]
    for axes, name in zip(panels, measured, strict=True):
        _draw_methods(axes, rows, name, looks, over)
        axes.step(
            *_points(fronts[name], name, over), where="post", color="black", linewidth=5.0, alpha=0.15,
            label="Pareto front", solid_capstyle="butt",
        )  # fmt: skip
        axes.axhspan(0.0, known[name], color="0.9")
        axes.set_ylabel(f"largest error [{measured[name].unit}]")
        axes.grid(alpha=0.3)
    handles = {
        label: handle
        for axes in panels
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
        if handle.get_color() != OTHER
    }
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=6, fontsize=8)
    about = trade.metadata
    figure.suptitle(f"{about['scene']}: {about['t_end']:g} s, errors at outputs every {about['dt_out']:g} s")
    return figure


def _own_front(rows: Sequence[Row], quantity: str, over: str) -> list[Row]:
    """The rows that none of them beats, the cheapest first."""
    on = front(rows, quantity, cost=over)
    return sorted((row for row, kept in zip(rows, on, strict=True) if kept), key=lambda row: _cost(row, over))


def _points(rows: Sequence[Row], quantity: str, over: str) -> tuple[list[float], list[float]]:
    return [_cost(row, over) for row in rows], [row.error(quantity) for row in rows]


def _cost(row: Row, over: str) -> float:
    return 1e3 * float(getattr(row, over)) / row.simulated_s


def _draw_methods(
    axes: Axes, rows: Sequence[Row], quantity: str, looks: Mapping[str, tuple[str, str]], over: str
) -> None:
    names = dict.fromkeys(row.method.integrator for row in rows)
    for name in sorted(names, key=lambda name: name in looks):
        own = [row for row in rows if row.method.integrator == name]
        points = _points(_own_front(own, quantity, over), quantity, over)
        if not points[0]:
            continue
        colour, marker = looks.get(name, (OTHER, "."))
        axes.loglog(*points, "-", color=colour, marker=marker, markersize=4, linewidth=1.2, label=name)
        if name not in looks:
            axes.annotate(
                name, (points[0][-1], points[1][-1]), xytext=(4, 0), textcoords="offset points",
                fontsize=7, color="0.35", va="center",
            )  # fmt: skip
    axes.set_xlabel(COSTS[over])
    axes.set_title(plain(quantity.replace("_", " ")), fontsize=10)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.set_xlim(right=ROOM * axes.get_xlim()[1])
