"""PhaseSheet: allowable seas by phase and load case, which prints as the sheet that is handed on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.operability.allowable_table import AllowableHs, letters
from seacrane.operability.alpha import AlphaFactor
from seacrane.operability.phase import Phase, Span, legs_of
from seacrane.plotting.table import Answer, Column, Table

if TYPE_CHECKING:
    import xarray

CELL = ("case", "phase", "tp", "direction_deg")
TAKEN = {  # from the table of each phase, and their units
    "allowable_hs": "m", "low": "m", "high": "m", "forecast_hs": "m", "again_hs": "m", "capped": "",
    "governing": "", "domain": "", "reason": "", "runs": "",
}  # fmt: skip
LEAST = 1e-9  # m, by which heights differ


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class PhaseSheet(Answer):
    """Allowable seas by phase. Made by `phase_sheet`; prints as a table.

    Attributes
    ----------
    name : str
        Of the scene.
    phases : tuple of Phase
    cases : tuple of str
        Load cases; one without a name where there was one scene.
    tables : mapping of (str, str) to AllowableHs
        By load case and phase; `alpha` and `hours` of each are those of its reference period.
    alpha : AlphaFactor
    lead_hours : float
        From the issue of the forecast to the start, h.
    """

    name: str
    phases: tuple[Phase, ...]
    cases: tuple[str, ...]
    tables: Mapping[tuple[str, str], AllowableHs]
    alpha: AlphaFactor
    lead_hours: float

    def table(self, phase: str, *, case: str | None = None) -> AllowableHs:
        """Of a phase in a load case, which may be left out where there is one.

        Raises
        ------
        SceneError
            For a name that there is not.
        """
        found = (self.case_of(case), phase)
        if found not in self.tables:
            known = ", ".join(one.name for one in self.phases)
            raise SceneError(f"phase {shown(phase)} is not in the sheet; choose from {known}")
        return self.tables[found]

    def case_of(self, case: str | None) -> str:
        """The load case of a name, or the only one; SceneError for another."""
        if case is None and len(self.cases) == 1:
            return self.cases[0]
        if case not in self.cases:
            raise SceneError(f"case is {shown(case)}; choose from {', '.join(self.cases)}")
        return case

    @property
    def legs(self) -> list[list[Span]]:
        """Phases in series with their hours, up to each point of safe return."""
        return legs_of(self.phases)

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """Over `case`, `phase`, `tp` (s) and `direction_deg` what the table of each phase has.

        Over the phases also `hours`, `reference_hours` from the issue of the forecast, and whether it is a
        `passage`. Without `phase`: `operation_hs` (m), the least `forecast_hs`, and the `governing_phase`.
        """
        import xarray

        first = self.tables[self.cases[0], self.phases[0].name].dataset
        stacked = {name: self._stacked(name) for name in TAKEN}
        ends = [self.lead_hours + span.end for leg in self.legs for span in leg]
        forecast = stacked["forecast_hs"]
        names = np.array([one.name for one in self.phases])
        capped = stacked["capped"].all(axis=1)
        governing = np.where(capped, "", names[np.argmin(np.nan_to_num(forecast, nan=-np.inf), axis=1)])
        data: dict[str, Any] = {
            name: (CELL, values, {"units": TAKEN[name]} if TAKEN[name] else {})
            for name, values in stacked.items()
        }
        cell, phase = (CELL[0], *CELL[2:]), ("phase",)
        data |= {
            "operation_hs": (cell, forecast.min(axis=1), {"units": "m"}),
            "governing_phase": (cell, governing.astype(str)),
            "hours": (phase, [one.hours for one in self.phases], {"units": "h"}),
            "reference_hours": (phase, ends, {"units": "h"}),
            "passage": (phase, [one.passage for one in self.phases]),
        }
        coords = {"case": list(self.cases), "phase": names, **{name: first[name] for name in CELL[2:]}}
        return xarray.Dataset(data, coords, {"scene": self.name, "alpha_factor": self.alpha.source})

    def _stacked(self, name: str) -> Array:
        return np.stack([
            np.stack([self.tables[case, one.name].dataset[name].to_numpy() for one in self.phases])
            for case in self.cases
        ])  # fmt: skip

    def __repr__(self) -> str:
        return f"<PhaseSheet of {self.name!r}: {len(self.cases)} cases, {len(self.phases)} phases>"

    def not_monotone(self, phase: str, *, case: str | None = None) -> str:
        """Where the limit of a phase does not change one way over Tp or Hs, in words; empty where it does."""
        data = self.table(phase, case=case).dataset
        tp, directions = (data[name].to_numpy() for name in ("tp", "direction_deg"))
        told: dict[str, list[str]] = {}  # what is alike stands once, with where it is
        for direction, column in zip(directions, data["allowable_hs"].to_numpy().T, strict=True):
            if turns := _turns(tp, column):
                told.setdefault(f"in Tp, {', '.join(turns)}: at ", []).append(f"{direction:g} deg")
        again = data["again_hs"].to_numpy()
        for i, j in np.argwhere(np.isfinite(again)):
            where = f"{tp[i]:g} s and {directions[j]:g} deg"
            told.setdefault(f"in Hs, kept again at {again[i, j]:g} m: at ", []).append(where)
        return "; ".join(what + ", ".join(at) for what, at in told.items())

    def _data(self) -> Table:
        return Table(data=self.dataset)

    def _shown(self) -> Table:
        rows = [self._row(case, one) for case in self.cases for one in self.phases]
        heads = ("kind", "hours", "allowable Hs", "at", "governs", "alpha", "forecast Hs")
        units = ("", "h", "m", "", "", "", "m")
        columns = [
            Column(head=head, values=values, read=(unit, values), form="g")
            for head, unit, values in zip(
                heads, units, (list(one) for one in zip(*rows, strict=True)), strict=True
            )
        ]
        axes = [Column(name="phase", values=[one.name for one in self.phases])]
        if len(self.cases) > 1:
            axes.insert(0, Column(name="case", values=list(self.cases)))
        return Table(
            axes=axes, columns=columns, title=f"{self.name}: allowable seas by phase, least over all periods "
            "and directions", remarks=self._remarks(), below=[self._by_sea(case) for case in self.cases],
            data=self.dataset,
        )  # fmt: skip

    def _row(self, case: str, phase: Phase) -> tuple[str, ...]:
        """What the sheet prints of a phase: its worst sea by forecast."""
        data = self.tables[case, phase.name].dataset
        forecast = np.nan_to_num(data["forecast_hs"].to_numpy(), nan=-np.inf)
        i, j = np.unravel_index(np.argmin(forecast), forecast.shape)
        at = {name: data[name].to_numpy()[i, j] for name in TAKEN}
        hs, low, high = (float(at[name]) for name in ("allowable_hs", "low", "high"))
        known = np.isfinite(hs)
        within = f" ({low:.2f} to {high:.2f})" if low < high < np.inf else ""
        kind = f"passage, P90 of {at['runs']} seeds" if phase.passage else "stationary"
        span = next(one for leg in self.legs for one in leg if one.phase is phase)
        alpha = (
            f"{at['forecast_hs'] / hs:.3f} of {self.lead_hours + span.end:g} h" if known and hs > 0.0 else "-"
        )
        return (
            kind, f"{phase.hours:g} + {phase.contingency_hours:g}",
            f"{'>' if at['capped'] else ''}{hs:.2f}{within}" if known else "not known",
            f"{data['tp'].to_numpy()[i]:g} s, {data['direction_deg'].to_numpy()[j]:g} deg",
            str(at["governing"]) or "none", alpha, f"{at['forecast_hs']:.2f}" if known else "-",
        )  # fmt: skip

    def _remarks(self) -> list[str]:
        lines = []
        for case in self.cases:
            data = self.dataset.sel(case=case)
            values = np.nan_to_num(data["operation_hs"].to_numpy(), nan=-np.inf)
            i, j = np.unravel_index(np.argmin(values), values.shape)
            governs = str(data["governing_phase"].to_numpy()[i, j])
            height = f"{values[i, j]:.2f} m" if np.isfinite(values[i, j]) else "not known"
            lines.append(
                f"{case + ': ' if case else ''}"
                + (f"{governs!r} governs, forecast Hs {height}" if governs else "no phase governs")
            )
        lines.append(
            f"alpha factor by hours from the issue of the forecast, {self.lead_hours:g} h before the start, "
            f"to the end of the phase (source: {self.alpha.source})"
        )
        safe = [repr(one.name) for one in self.phases[:-1] if one.safe]
        lines.append(f"safe to wait for another forecast: after {', '.join([*safe, 'the last phase'])}")
        for case, name in self.tables:
            if told := self.not_monotone(name, case=case):
                lines.append(f"{' '.join(filter(None, (case, name)))}: not monotone {told}")
            failed = len(self.tables[case, name].failures)
            if failed:
                lines.append(f"{' '.join(filter(None, (case, name)))}: {failed} runs failed")
        return lines

    def _by_sea(self, case: str) -> Table:
        """Forecast Hs of the operation over the seas, with the letter of the phase that governs."""
        data = self.dataset.sel(case=case)
        values, governs = data["operation_hs"].to_numpy(), data["governing_phase"].to_numpy()
        letter = {"": ""} | {one.name: at for at, one in zip(letters(), self.phases, strict=False)}
        texts = [
            [
                f"{'' if name else '>'}{value:.2f} {letter[str(name)]}".rstrip()
                for value, name in zip(*row, strict=True)
            ]
            for row in zip(values, governs, strict=True)
        ]
        columns = [
            Column(head=f"{one:g} deg", values=values[:, j], read=("", [row[j] for row in texts]))
            for j, one in enumerate(data["direction_deg"].to_numpy())
        ]
        told = "; ".join(f"{letter[one.name]}: {one.name}" for one in self.phases)
        return Table(
            axes=[Column(head="Tp", values=data["tp"].to_numpy(), unit="s", form="g")], columns=columns,
            title=f"{case + ': ' if case else ''}forecast Hs [m] of the whole operation in one sea ({told})",
        )  # fmt: skip


def _turns(tp: Array, heights: Array) -> list[str]:
    """Where heights (m) over periods (s) that are known turn round, in words."""
    known = np.isfinite(heights)
    periods, steps = tp[known], np.diff(heights[known])
    changes = np.flatnonzero(np.abs(steps) > LEAST)
    return [
        f"{'least' if steps[before] < 0.0 else 'largest'} at {periods[before + 1]:g} s"
        for before, after in pairwise(changes) if steps[before] * steps[after] < 0.0
    ]  # fmt: skip
