"""A trade within a budget: settings one after the other, what is nearest the front first."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass

from seacrane.run.method import Method
from seacrane.trading.ladders import Ladders
from seacrane.trading.row import Row

METHODS = 0.6  # of the budget, before physics is left out
LEAST = 0.5  # runs, that any row may take
LONGEST = 3.0  # runs, that no row may take more than
Measure = Callable[[float], Row]  # of the processor time that it may take, s


@dataclass(kw_only=True)
class Spending:
    """Processor time that is left, s, in runs of the default setting.

    Attributes
    ----------
    unit_s : Of one such run with all around it, s.
    runs : Of them that may be spent; infinite: any.
    spent_s : By now, s.
    """

    unit_s: float
    runs: float
    spent_s: float = 0.0

    def left(self, share: float = 1.0) -> float:
        """Seconds of a share of the budget."""
        return share * self.runs * self.unit_s - self.spent_s

    def spend(self, row: Row, around_s: float = 0.0) -> None:
        """What a row took, with all around its run."""
        self.spent_s += max(row.cpu_s if row.cpu_s > 0.0 else 0.0, around_s)


def within_budget(
    spending: Spending,
    ladders: Ladders,
    method_row: Callable[[Method], tuple[str, Measure]],
    physics: Mapping[str, Measure],
) -> Iterator[tuple[str, Row]]:
    """Rows by their keys, until the budget ends or nothing can change the front."""
    yield from _settings(spending, ladders, method_row, METHODS)
    for key, measure in physics.items():
        if spending.left() < LEAST * spending.unit_s:
            break
        yield key, _row(spending, measure)
    yield from _settings(spending, ladders, method_row, 1.0)


def _settings(
    spending: Spending,
    ladders: Ladders,
    method_row: Callable[[Method], tuple[str, Measure]],
    share: float,
) -> Iterator[tuple[str, Row]]:
    while spending.left(share) > LEAST * spending.unit_s and (method := ladders.next()) is not None:
        key, measure = method_row(method)
        row = _row(spending, measure)
        ladders.add(method, row)
        yield key, row


def _row(spending: Spending, measure: Measure) -> Row:
    begun = time.process_time()
    row = measure(LONGEST * spending.unit_s)
    spending.spend(row, time.process_time() - begun)
    return row


def with_bar(
    rows: Iterable[tuple[str, Row]], spending: Spending, *, progress: bool
) -> Iterator[tuple[str, Row]]:
    """The rows as they come, with a bar of the runs that they take of a budget."""
    from tqdm import tqdm

    with tqdm(total=round(spending.runs), desc="trade", unit="run", disable=not progress) as bar:
        for row in rows:
            bar.update(min(round(spending.spent_s / spending.unit_s), bar.total) - bar.n)
            yield row
