"""trade(): what every setting costs and what error it brings, for the scene at hand."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.errors import SceneError
from seacrane.files.atomic import atomic_write
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.inputs.checked import number_of
from seacrane.trading import rungs
from seacrane.trading.diagram import Measured, work_precision
from seacrane.trading.measure import Reference, Span, frequency_domain, measure, measure_variant, reference
from seacrane.trading.quantities import Quantity, limits_of, quantities_of
from seacrane.trading.rows import Row, RowFile, front, write_csv
from seacrane.trading.settings_grid import PHYSICS, settings
from seacrane.version import __version__

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

    from seacrane.scene.scene import Scene

REPEATS = 3  # runs of each setting; the quickest counts


@dataclass(frozen=True, kw_only=True, eq=False)
class Trade:
    """Measured cost and error of the settings of one scene. Made by `trade`.

    Attributes
    ----------
    rows : tuple of Row
        Numerical settings on the full scene first, then the scene with less physics.
    quantities : mapping of str to Quantity
        What errors are measured in; the first one decides on `pareto`.
    reference : Reference
        The tight runs and, per quantity, how far they differ: no error below that can be told.
    metadata : mapping
        Scene, version, times, machine independent.
    """

    rows: tuple[Row, ...]
    quantities: Mapping[str, Quantity]
    reference: Reference
    metadata: Mapping[str, Any]

    @property
    def table(self) -> xarray.Dataset:
        """All rows as a dataset over `row` and `quantity`; `error` is the largest over time."""
        import xarray

        names = list(self.quantities)
        data: dict[str, Any] = {
            name: ("row", np.array([getattr(row, name) for row in self.rows]))
            for name in ("formulation", "integrator", "setting", "rtol", "dt", "memory", "waves", "rung",
                         "wall_s", "simulated_s", "evaluations", "drift", "energy", "stable", "reason")
        }  # fmt: skip
        for name, part in (("error", "largest"), ("rms_error", "rms"), ("std_error", "std")):
            values = [
                [getattr(row.errors[q], part) if q in row.errors else np.nan for q in names]
                for row in self.rows
            ]
            data[name] = (
                ("row", "quantity"),
                np.array(values, dtype=float).reshape(len(self.rows), len(names)),
            )
        data["wall_per_simulated_s"] = ("row", data["wall_s"][1] / data["simulated_s"][1])
        data["pareto"] = ("row", np.array(front(self.rows, names[0])))
        data["uncertainty"] = ("quantity", np.array([self.reference.uncertainty[name] for name in names]))
        data["unit"] = ("quantity", [self.quantities[name].unit for name in names])
        return xarray.Dataset(data, {"quantity": names}, dict(self.metadata))

    @property
    def pareto(self) -> list[Row]:
        """Rows that no other beats in both wall time and error of the first quantity, cheapest first."""
        return self.front(next(iter(self.quantities)))

    def front(self, quantity: str) -> list[Row]:
        """As `pareto`, for any quantity."""
        limits_of(self.quantities, {quantity: 1.0})
        kept = [row for row, on in zip(self.rows, front(self.rows, quantity), strict=True) if on]
        return sorted(kept, key=lambda row: row.wall_s)

    def cheapest(self, **accuracy: float) -> dict[str, Any]:
        """Settings of the cheapest run of the full scene whose largest errors stay within the limits.

        Parameters
        ----------
        **accuracy : float
            Largest error by quantity, in its unit, such as ``payload_position=0.01``.

        Returns
        -------
        dict
            For ``simulate(scene, **settings)``.

        Raises
        ------
        SceneError
            If no setting meets them: it names the smallest error reached and what sets it.
        """
        limits = limits_of(self.quantities, accuracy)
        for name, limit in limits.items():
            self._check_reach(name, limit)
        passing = [
            row
            for row in self._of_full_scene()
            if row.stable and all(row.error(name) <= limit for name, limit in limits.items())
        ]
        if not passing:
            raise SceneError(f"accuracy: each of {limits} is reached by some setting, but none reaches all")
        best = min(passing, key=lambda row: row.wall_s)
        size = {"rtol": best.rtol} if best.rtol else {"dt": best.dt}
        return {"formulation": best.formulation, "integrator": best.integrator, **size}

    def _check_reach(self, name: str, limit: float) -> None:
        unit, known = self.quantities[name].unit, self.reference.uncertainty[name]
        if limit < known:
            raise SceneError(
                f"accuracy: {name} of {limit:g} {unit} cannot be reached: the limit is {known:.3g} {unit}, "
                "set by rounding: by that much the tight reference runs differ among themselves"
            )
        rows = [row for row in self._of_full_scene() if row.stable]
        best = min(rows, key=lambda row: row.error(name), default=None)
        if best is None or best.error(name) > limit:
            least = "none" if best is None else f"{best.error(name):.3g} {unit}"
            by = "" if best is None else f" ({best.formulation}, {best.integrator}, {best.setting})"
            raise SceneError(
                f"accuracy: {name} of {limit:g} {unit} is beyond this grid: its smallest error is "
                f"{least}{by}, set by the local error of the time integration; simulate(accuracy=...) tries "
                "finer tolerances"
            )

    def _of_full_scene(self) -> list[Row]:
        memory, waves = self.metadata["memory"], self.metadata["waves"]
        return [row for row in self.rows if (row.memory, row.waves, row.rung) == (memory, waves, rungs.FULL)]

    def plot(self) -> Figure:
        """Work-precision diagrams: error of each quantity over the wall time per simulated second."""
        measured = [
            Measured(
                quantity=name,
                unit=quantity.unit,
                front=self.front(name),
                uncertainty=self.reference.uncertainty[name],
            )
            for name, quantity in self.quantities.items()
        ]
        return work_precision(self.rows, measured, self.metadata)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Write trade.csv and trade.png into a folder."""
        units = {name: quantity.unit for name, quantity in self.quantities.items()}
        on_front = front(self.rows, next(iter(self.quantities)))
        write_csv(Path(folder) / "trade.csv", self.rows, units, on_front)
        with atomic_write(Path(folder) / "trade.png") as draft:
            self.plot().savefig(draft, format="png", dpi=110)


def trade(
    scene: Scene,
    *,
    quantities: Sequence[str] | None = None,
    t_end: float = 100.0,
    dt_out: float = 0.1,
    quick: bool = False,
    database: HydroDatabase | None = None,
    progress: bool = True,
    out: str | os.PathLike[str] | None = None,
) -> Trade:
    """Measure what every setting costs and what error it brings, for one scene.

    A tight reference comes first: two formulations, two methods. Then every formulation, integrator and
    tolerance or step on the full scene; then, at a tight tolerance, the scene with one part of its physics
    changed: fluid memory, evaluation of the waves, coupling of crane, payload and vessel. Numerical settings
    and physics are not crossed: their errors add. What a setting cannot do is a row that is not stable and
    says why.

    Parameters
    ----------
    scene : Scene
    quantities : sequence of str, optional
        "payload_position", "tip_velocity", "roll", "cylinder_force", "hook_tension", or any channel. Default:
        those of the named ones that the scene has, else position and velocity of all bodies.
    t_end, dt_out : float
        s; errors are taken at the outputs.
    quick : bool
        A coarse grid of few integrators.
    database : HydroDatabase, optional
        The vessel's, to fit other memory models; default: the shipped one where the scene was made from it.
        Without one, only the scene without memory is compared.
    progress : bool
        Show a progress bar.
    out : path, optional
        Existing folder: rows are kept in its trade_rows.jsonl as they are measured, and a later call for the
        same scene goes on from there; trade.csv and trade.png are written at the end.

    Returns
    -------
    Trade

    Raises
    ------
    SceneError
        For an unknown quantity, or a scene of which no two tight runs work.
    """
    model = scene.compile()
    measured = quantities_of(scene, model, quantities)
    span = Span(
        t_end=number_of("t_end", t_end), dt_out=number_of("dt_out", dt_out), repeats=1 if quick else REPEATS,
        quantities=measured,
    )  # fmt: skip
    metadata = {
        "scene": scene.name, "seacrane_version": __version__, "t_end": span.t_end, "dt_out": span.dt_out,
        "memory": rungs.memory_name(scene), "waves": rungs.waves_name(scene), "quick": int(quick),
    }  # fmt: skip
    truth = reference(scene, span)
    metadata |= {"reference": truth.runs[0], "checked_by": "; ".join(truth.runs[1:])}
    metadata |= {f"refused {name}": reason for name, reason in truth.refused.items()}
    file = None
    if out is not None:
        key = {**metadata, "quantities": list(measured), "described": _digest(scene, Path(out))}
        file = RowFile(Path(out) / "trade_rows.jsonl", key)
    rows = _measure_all(_tasks(scene, span, truth, database, metadata, quick=quick), file, progress)
    result = Trade(rows=tuple(rows), quantities=measured, reference=truth, metadata=metadata)
    if out is not None:
        result.save(out)
    return result


def _tasks(
    scene: Scene, span: Span, truth: Reference, database: HydroDatabase | None, metadata: Mapping[str, Any],
    *, quick: bool,
) -> list[tuple[Row, Any]]:  # fmt: skip
    """Each empty row, and the function that fills it in."""
    memory, waves = str(metadata["memory"]), str(metadata["waves"])
    tasks: list[tuple[Row, Any]] = []
    for setting in settings(quick=quick):
        row = Row(formulation=setting.formulation, integrator=setting.integrator, rtol=setting.rtol,
                  dt=setting.dt, memory=memory, waves=waves, rung=rungs.FULL)  # fmt: skip
        tasks.append((row, lambda row, s=setting: measure(scene, s, span, truth.values, row)))
    start = truth.values["payload_position"][0] if "payload_position" in truth.values else np.zeros((1, 3))
    for variant in rungs.variants(scene, database or _shipped(scene), quick=quick):
        linear = variant.rung == rungs.LINEAR
        row = Row(
            formulation="linear" if linear else PHYSICS.formulation,
            integrator="none" if linear else PHYSICS.integrator,
            rtol=0.0 if linear else PHYSICS.rtol, dt=0.0,
            memory=variant.memory, waves=variant.waves, rung=variant.rung,
        )  # fmt: skip
        if linear:
            tasks.append((row, lambda row: frequency_domain(scene, span, truth.values, start, row)))
        else:
            tasks.append((row, lambda row, v=variant: measure_variant(v, PHYSICS, span, truth.values, row)))
    return tasks


def _measure_all(tasks: list[tuple[Row, Any]], file: RowFile | None, progress: bool) -> list[Row]:
    from tqdm.auto import tqdm

    rows: dict[str, Row] = {}
    for empty, fill in tqdm(tasks, desc="trade", unit="row", disable=not progress):
        known = file.rows.get(empty.key) if file is not None else None
        row = fill(empty) if known is None else known
        if file is not None and known is None:
            file.add(empty.key, row)
        rows.setdefault(row.key, row)  # two levels of a memory fit may give one model
    return list(rows.values())


def _shipped(scene: Scene) -> HydroDatabase | None:
    """The shipped database, if the scene's vessel was made from it."""
    shipped = shipped_database()
    known = [scene.provenance.get(name) for name in scene.vessels]
    return shipped if [one and one.database for one in known] == [shipped.name] else None


def _digest(scene: Scene, folder: Path) -> str:
    """Of everything that describes the scene."""
    import tempfile

    if not folder.is_dir():
        raise SceneError(f"out {str(folder)!r} is no folder; create it first")
    with tempfile.TemporaryDirectory(dir=folder) as place:
        path = Path(place) / "scene.json"
        scene.save(path)
        text = json.loads(path.read_text(encoding="utf-8"))
    return hashlib.sha256(json.dumps(text, sort_keys=True).encode()).hexdigest()
