"""What a scene requires, as an answer: rows, the least set, and its lines of script."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from statistics import median
from typing import Any

from seacrane.answers.choices import Choice
from seacrane.plotting.table import Answer, Column, Table


@dataclass(frozen=True, kw_only=True)
class Loss:
    """One choice made simpler, beside the scene as it stands.

    Attributes
    ----------
    name, script, of : As of the `Choice`.
    shares : tuple of float
        Of the processor time, over that of the scene as it stands, in runs by turns.
    evaluations : float
        Evaluations of the equations of motion over those of the scene as it stands; NaN: not counted.
    changes : mapping of str to float
        Of each number, in its unit.
    message : Why it does not run; empty where it does.
    """

    name: str
    script: str
    of: str
    choice: Choice
    shares: tuple[float, ...] = ()
    evaluations: float = math.nan
    changes: Mapping[str, float] = field(default_factory=dict)
    message: str = ""

    @property
    def stable(self) -> bool:
        """Whether it ran."""
        return not self.message

    @property
    def share(self) -> float:
        """Median of the shares."""
        return median(self.shares) if self.shares else math.nan

    @property
    def spread(self) -> float:
        """Half of their range: how well the share is known; NaN for one run."""
        return 0.5 * (max(self.shares) - min(self.shares)) if len(self.shares) > 1 else math.nan

    def used(self, name: str, limit: float, noise: float = 0.0) -> float:
        """The share of a limit of one number that its change takes; 0 of a change within the noise."""
        change = abs(self.changes[name])
        if change <= noise:
            return 0.0
        return change / limit if limit > 0.0 else math.inf


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Requirements(Answer):
    """What each choice of a scene costs, and what is lost without it. Made by `required`; prints as a table.

    Attributes
    ----------
    full : mapping of str to float
        The numbers of the scene as it stands.
    limits : mapping of str to float
        Largest change of each that is accepted, in its unit.
    noise : mapping of str to float
        Change of each below which nothing can be told: twice what a far tighter tolerance changes. NaN: not
        known.
    cpu_s : float
        Processor time of one run of the scene as it stands, s.
    rows, missing : tuple of Loss
        What is there, made simpler; what is not there, or is known badly.
    taken : tuple of Loss
        Of the rows the set that costs least.
    least : Loss or None
        Its one run; None where nothing that saves may be left out.
    told_s, took_s : float
        Processor time as told beforehand, and as it was, s.
    """

    scene: str
    full: Mapping[str, float]
    units: Mapping[str, str]
    limits: Mapping[str, float]
    noise: Mapping[str, float]
    cpu_s: float
    rows: tuple[Loss, ...]
    missing: tuple[Loss, ...]
    least: Loss | None
    taken: tuple[Loss, ...]
    told_s: float
    took_s: float
    runs: int

    @property
    def script(self) -> str:
        """Lines of Python that make the least set of a described `scene`; empty where there is none."""
        return "" if self.least is None else self.least.script

    def row(self, name: str) -> Loss:
        """The row of a name, or of one that begins so; KeyError for none."""
        return next(one for one in (*self.rows, *self.missing) if one.name.startswith(name))

    def line(self) -> str:
        """The answer in one line."""
        if self.least is None:
            return f"nothing that saves may be left out within {self._within()}"
        worst = ", ".join(f"{name} {self._change(name, self.least)}" for name in self.full)
        return (
            f"least within {self._within()}: {'; '.join(one.name for one in self.taken)}: "
            f"{_percent(self.least)} of the cost, {worst}"
        )

    __repr__ = Answer.__str__

    def _shown(self) -> Table:
        known = ", ".join(map(self._known, self.full))
        script = [f"    {line}" for line in self.script.splitlines()]
        price = f"{self.runs} runs, {self.took_s:.3g} s of CPU; told {self.told_s:.2g} s"
        missing = self._table(
            self.missing, title="what it leaves out, or knows badly:", remarks=_not_tried(self.missing)
        )
        return self._table(
            self.rows, whole=True, below=[missing] if self.missing else [],
            title=f"what {self.scene!r} requires: a run takes {self.cpu_s:.3g} s of CPU\n"
                  f"changes known within {known}",
            remarks=[*_not_tried(self.rows), self.line(), *script, price],
        )  # fmt: skip

    def _table(self, rows: Sequence[Loss], *, whole: bool = False, **given: Any) -> Table:
        """Share of the cost and changes by choice; below the scene as it stands, with its numbers."""
        cost = [_percent(row) if row.stable else "does not run" for row in rows]
        columns = [
            Column(name="cost", values=[*([1.0] * whole), *(row.share for row in rows)],
                   read=("", [*(["100 %"] * whole), *cost]))
        ]  # fmt: skip
        for name, value in self.full.items():
            told = [self._change(name, row) if row.stable else "" for row in rows]
            changes = [*([0.0] * whole), *(row.changes.get(name) for row in rows)]
            head = f"{name} [{self.units[name]}]" if self.units[name] else name
            columns.append(
                Column(name=name, head=head, values=changes, unit=self.units[name],
                       read=("", [*([f"{value:.4g}"] * whole), *told]))
            )  # fmt: skip
        names = [*(["as it stands"] * whole), *(row.name for row in rows)]
        return Table(axes=[Column(name="choice", head="", values=names)], columns=columns, **given)

    def _change(self, name: str, row: Loss) -> str:
        """In percent of the number, or nothing that could be told."""
        change, value = row.changes[name], self.full[name]
        if change == 0.0 or abs(change) <= self.noise[name]:
            return "none"
        return f"{_few(100.0 * change / value, 2, '+')} %" if value else f"{change:+.2g}"

    def _known(self, name: str) -> str:
        noise = self.noise[name]
        return (
            f"{name} (not told)" if math.isnan(noise) else f"{name} {noise:.1g} {self.units[name]}".rstrip()
        )

    def _within(self) -> str:
        parts = [(limit, abs(self.full[name]), name) for name, limit in self.limits.items()]
        shares = {f"{limit / value:.3g}" for limit, value, _ in parts if value}
        if len(shares) == 1 and len(parts) == len(self.full):
            return f"{100.0 * float(next(iter(shares))):g} % of each"
        return ", ".join(f"{name} {limit:g} {self.units[name]}".rstrip() for limit, _, name in parts)


def _not_tried(rows: Sequence[Loss]) -> list[str]:
    return [f"not tried: {row.name}: {row.message}" for row in rows if not row.stable]


def _percent(row: Loss) -> str:
    known = "" if math.isnan(row.spread) else f" ± {_few(100.0 * row.spread, 1)}"
    return f"{100.0 * row.share:.0f}{known} %"


def _few(value: float, digits: int, sign: str = "") -> str:
    """With so many digits, and no powers of ten for large numbers."""
    return f"{value:{sign}.0f}" if abs(value) >= 10.0**digits else f"{value:{sign}.{digits}g}"
