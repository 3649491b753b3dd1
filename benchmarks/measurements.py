"""What tanks and other programs say of us: ``benchmarks/measurements.py [set ...]`` checks all, or these.

A set is a module of `benchmarks/measured` with its `SOURCE` and `rows(folder)`; its data lie in the folder of
its name in ``measured`` of the folder that SEACRANE_SHARED names, or of ``../shared``, unless its module
quotes them. `benchmarks/run.py --only measurements` writes the table and the pictures. A difference a fifth
beyond the published one ends the call.
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from measure.table import read
from measured_row import MeasuredRow

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parents[1]
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))
MODULES = ROOT / "benchmarks" / "measured"
SETS = tuple(sorted(path.stem for path in MODULES.glob("[a-z]*.py")))
RESULTS = ROOT / "benchmarks" / "results"
TABLE = "measurements.csv"
FIGURES = ROOT / "docs" / "figures"
SOURCE_HEAD = ("set", "what", "repository", "commit", "licence")
SLACK = 1.2  # of the published difference
LEAST = 0.005  # a difference below it counts as this one
COLOURS = ("tab:blue", "tab:orange", "tab:green", "tab:red")


def data_of(name: str) -> Path | None:
    """Folder of a set's data, or of its module where that quotes them; None where it is absent."""
    if module_of(name).SOURCE.quoted:
        return MODULES
    named = os.environ.get("SEACRANE_SHARED")
    folder = (Path(named) if named else ROOT.parent / "shared") / "measured" / name
    return folder if folder.is_dir() else None


def module_of(name: str) -> Any:
    return importlib.import_module(f"measured.{name}")


def published() -> dict[tuple[str, ...], float]:
    """Largest differences by set, what was compared, and by what."""
    if not (RESULTS / TABLE).is_file():
        return {}
    head, rows = read(RESULTS / TABLE)
    return {tuple(row[:3]): float(row[head.index("largest, %")]) / 100.0 for row in rows}


def bound_of(name: str, row: MeasuredRow) -> float | None:
    """Largest size that its difference may have; None for a row that was not published yet."""
    told = published().get((name, row.compared, row.by))
    return None if told is None else SLACK * max(abs(told), LEAST)


def pictures(rows: Iterable[MeasuredRow]) -> dict[str, Figure]:
    """Figures by name: a panel for each quantity, measured points with their spread, what was computed."""
    found: dict[str, dict[str, list[MeasuredRow]]] = {}
    for row in rows:
        found.setdefault(row.picture, {}).setdefault(row.panel, []).append(row)
    return {name: _figure(panels) for name, panels in found.items()}


def _figure(panels: dict[str, list[MeasuredRow]]) -> Figure:
    from matplotlib.figure import Figure

    across = min(2, len(panels))
    down = -(-len(panels) // across)
    figure = Figure(figsize=(5.2 * across if across > 1 else 9.0, 3.9 * down), layout="constrained")
    every = figure.subplots(down, across, squeeze=False).ravel()
    for axes in every[len(panels) :]:
        axes.set_visible(False)
    for axes, (title, rows) in zip(every, panels.items(), strict=False):
        _panel(axes, title, rows, columns=3 if across == 1 else 1)
    return figure


def _panel(axes: Any, title: str, rows: list[MeasuredRow], *, columns: int) -> None:
    first = rows[0]
    for name, curve in first.others.items():
        axes.plot(*curve, linewidth=0.9, alpha=0.8, label=name)
    x, y = first.points
    if first.spread is None:
        axes.plot(x, y, "k.", markersize=5, label=first.told)
    else:
        low, high = first.spread
        axes.vlines(x, low, high, color="black", linewidth=1.5)
        axes.plot(x, y, "k.", markersize=5, label=f"{first.told}, and its spread")
    for row, colour in zip({row.by: row for row in rows}.values(), COLOURS, strict=False):
        way = "-" if row.joined else "x"
        axes.plot(*row.line, way, color=colour, linewidth=1.6, label=row.by)
    axes.set_yscale("log" if first.logarithmic else "linear")
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(first.x)
    axes.set_ylabel(first.y)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=7, ncols=columns, loc="upper center", bbox_to_anchor=(0.5, -0.18), frameon=False)


def checked(name: str, row: MeasuredRow) -> MeasuredRow:
    """The row, unless it is further away than what is published allows."""
    print("; ".join(row.cells(name)), flush=True)
    bound = bound_of(name, row)
    if bound is not None and not abs(row.largest) <= bound:
        raise SystemExit(f"{name}: {row.compared} by {row.by}: {row.largest:+.2%} exceeds {bound:.2%}")
    return row


def every_row(sets: Sequence[str] = SETS, *, check: bool = False) -> Iterator[tuple[str, ...]]:
    """Cells of every set, its pictures drawn; of those whose data are absent, as they were."""
    kept = [] if not (RESULTS / TABLE).is_file() else read(RESULTS / TABLE)[1]
    for name in SETS:
        folder = data_of(name)
        if folder is None or name not in sets:
            why = "not asked for" if folder else "its data are absent, set SEACRANE_SHARED"
            print(f"{name}: {why}; its rows stay as they were", flush=True)
            yield from (tuple(row) for row in kept if row[0] == name)
            continue
        rows = list(module_of(name).rows(folder))
        yield from (checked(name, row).cells(name) if check else row.cells(name) for row in rows)
        if not check:
            for picture, figure in pictures(rows).items():
                figure.savefig(FIGURES / f"{picture}.png", dpi=110)


def main() -> None:
    """Compare and check."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("sets", nargs="*", metavar="set", help=f"default: {' '.join(SETS)}")
    for _ in every_row(parser.parse_args().sets or SETS, check=True):
        pass


def sources() -> list[tuple[str, ...]]:
    """Where a reader finds each set."""
    return [_told(name) for name in SETS]


def _told(name: str) -> tuple[str, ...]:
    source = module_of(name).SOURCE
    return (name, source.about, source.repository, f"`{source.commit}`", source.licence)


if __name__ == "__main__":
    main()
