"""stability_atlas(): where each formulation and method is stable, far beyond use."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seacrane import SceneError, __version__
from seacrane.accuracy.row import Row, RowFile
from stability_atlas import committed
from stability_atlas.axes import AXES
from stability_atlas.axis import Axis
from stability_atlas.methods import DEFAULT, QUICK, every
from stability_atlas.step_limit import StepLimit, step_limits, write_step_limits
from stability_atlas.table import write_csv
from stability_atlas.workers import Group, run_all

STEP = "step"
QUICK_LIMIT_S = 1.0  # wall time of one run in a quick atlas


@dataclass(frozen=True, kw_only=True, eq=False)
class Atlas:
    """What every setting does along every axis. Made by `stability_atlas`.

    Attributes
    ----------
    rows : tuple of Row
        By axis, value and method.
    step_limits : tuple of StepLimit
        Longest stable steps, found and predicted; empty where they were not asked for.
    broken : tuple of str
        Promises of the committed list that these rows break, each with what happened instead.
    """

    rows: tuple[Row, ...]
    step_limits: tuple[StepLimit, ...]
    broken: tuple[str, ...]


def stability_atlas(
    *,
    out: str | os.PathLike[str],
    quick: bool = False,
    axes: Sequence[str] | None = None,
    jobs: int | None = None,
    figures: bool = True,
    progress: bool = True,
) -> Atlas:
    """Run every axis of the atlas and write its rows, figures and verdicts.

    Parameters
    ----------
    out : path
        Existing folder: extremes_rows.jsonl keeps rows as they are measured, and a later call continues from
        there; extremes.csv, extremes_step.csv and extremes_<axis>.png are written at the end.
    quick : bool
        Few values and methods, besides all that the committed list names.
    axes : sequence of str, optional
        Names of `AXES`, and "step" for the longest stable steps; default: all.
    jobs : int, optional
        Processes at a time; default: as many as this one may use processors, at most 2.
    figures : bool
        Draw the heat maps.
    progress : bool
        Show a progress bar.

    Raises
    ------
    SceneError
        For an unknown axis, or a folder that does not exist.
    """
    folder = Path(out)
    if not folder.is_dir():
        raise SceneError(f"out {str(folder)!r} is no folder; create it first")
    chosen = _chosen(axes)
    experiment = {"study": "stability atlas", "seacrane_version": __version__}
    file = RowFile(folder / "extremes_rows.jsonl", experiment)
    wanted = [group for axis in chosen for group in _groups(axis, quick=quick)]
    rows = _measure(wanted, file, jobs or min(2, _processors()), progress)
    limits = list(_step_limits(quick, progress)) if axes is None or STEP in axes else []
    atlas = Atlas(
        rows=tuple(rows), step_limits=tuple(limits),
        broken=tuple(committed.broken(rows, [axis.name for axis in chosen])),
    )  # fmt: skip
    write_csv(folder / "extremes.csv", atlas.rows)
    if limits:
        write_step_limits(folder / "extremes_step.csv", limits)
    if figures:
        from stability_atlas.heat_map import save_heat_maps

        save_heat_maps(folder, atlas.rows, limits)
    return atlas


def _processors() -> int:
    """Those that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def _step_limits(quick: bool, progress: bool) -> Iterator[StepLimit]:
    from tqdm.auto import tqdm

    trials = step_limits(quick=quick)
    yield from tqdm(trials, desc="longest stable steps", unit="method", disable=not progress)


def _chosen(names: Sequence[str] | None) -> list[Axis]:
    unknown = [name for name in names or () if name not in AXES and name != STEP]
    if unknown:
        raise SceneError(f"axis {unknown[0]!r} is unknown; choose {', '.join([*AXES, STEP])}")
    return [axis for axis in AXES.values() if names is None or axis.name in names]


def _groups(axis: Axis, *, quick: bool) -> Iterator[Group]:
    """What to run of one axis: its values by its methods, and the default at every committed value."""
    values, methods = (axis.quick, QUICK) if quick else (axis.values, tuple(every()))
    limit_s = QUICK_LIMIT_S if quick else axis.limit_s
    for value in values:
        yield Group(axis=axis.name, value=value, methods=methods, limit_s=limit_s)
    alone = [value for value in committed.values(axis.name) if value not in (*values, *axis.long)]
    for value in [*alone, *(() if quick else axis.long)]:
        yield Group(axis=axis.name, value=value, methods=(DEFAULT,), limit_s=axis.long_limit_s,
                    with_reference=False)  # fmt: skip


def _measure(wanted: list[Group], file: RowFile, jobs: int, progress: bool) -> list[Row]:
    """All rows in their order; what the file holds is not measured again."""
    from tqdm.auto import tqdm

    keys = list(dict.fromkeys(group.empty(method).key for group in wanted for method in group.methods))
    missing = [
        replace(group, methods=methods)
        for group in wanted
        if (methods := tuple(m for m in group.methods if group.empty(m).key not in file.rows))
    ]
    left = sum(key not in file.rows for key in keys)
    found = run_all(missing, jobs) if missing else ()
    for row in tqdm(found, total=left, desc="extremes", unit="row", disable=not progress):
        file.add(row.key, row)
    return [file.rows[key] for key in keys]
