"""trade(): its rows, front, choice and file; and the changed scenes of `answers`."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trade_scenes import a_run_each, pendulum

import seacrane as sc
from seacrane import answers, cases
from seacrane._core import Integrator, integrators
from seacrane.accuracy import Trade, methods, trade_study
from seacrane.accuracy.measured import Reference
from seacrane.accuracy.quantities import ErrorMeasures, compare, quantities_of
from seacrane.accuracy.row import Row, RowFile
from seacrane.accuracy.trade_study import Spending

T_END, BUDGET = 6.0, 40.0
TIGHT = {"integrator": "dop853", "rtol": 1e-11}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("trade")


@pytest.fixture(scope="module")
def case2() -> sc.Scene:
    return cases.case2()


@pytest.fixture(scope="module")
def measured(case2: sc.Scene, folder: Path) -> Trade:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Spending, "spend", a_run_each)
        return sc.trade(case2, t_end=T_END, budget=BUDGET, progress=False, out=folder)


def test_a_row_holds_what_its_settings_give(case2: sc.Scene, measured: Trade) -> None:
    row = next(r for r in measured.rows if r.method.integrator == "rk4" and r.formulation == "recursive")
    run = sc.simulate(case2, t_end=T_END, formulation="recursive", integrator="rk4", dt=row.method.dt)
    tight = sc.simulate(case2, t_end=T_END, integrator="verner76", rtol=1e-12)
    own, true = (one.select("position", body="payload") for one in (run, tight))
    distance = np.linalg.norm(own - true, axis=-1)
    assert row.error("payload_position") == pytest.approx(distance.max(), rel=1e-3)
    assert row.errors["payload_position"].rms == pytest.approx(np.sqrt(np.mean(distance**2)), rel=1e-3)
    assert row.evaluations == run.stats["evaluations"]


def test_the_cheapest_setting_meets_its_limit_when_run(case2: Any, measured: Trade, folder: Path) -> None:
    run = sc.simulate(case2, t_end=T_END, method=measured.cheapest(payload_position=1e-4, roll=1e-6))
    tight = sc.simulate(case2, t_end=T_END, **TIGHT)
    own, true = (one.select("position", body="payload")[:, None] for one in (run, tight))
    assert compare(true, own).largest <= 1e-4
    for accuracy, says in (({"payload_position": 1e-16}, "rounding"), ({"pitch": 1.0}, "'pitch'")):
        with pytest.raises(sc.SceneError, match=says):
            measured.cheapest(**accuracy)
    front = measured.front("roll")
    assert front
    for row in measured.rows:
        assert not any(row.cpu_s < f.cpu_s and row.error("roll") < f.error("roll") for f in front)
    error = measured.to_xarray()["error_roll"].to_numpy()
    assert error[0] == measured.rows[0].error("roll")
    with (folder / "trade.csv").open() as file:
        assert [float(row["error_roll [rad]"]) for row in csv.DictReader(file)] == pytest.approx(
            error, rel=1e-5
        )


def test_rows_of_an_earlier_call_are_kept_and_those_of_another_scene_not(measured: Any, folder: Path) -> None:
    """But for the line that an interrupted call was writing."""
    path = folder / "trade_rows.jsonl"
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:-1]) + "\n" + lines[-1][:40])
    experiment = json.loads(lines[0])
    again = RowFile(path, {name: value for name, value in experiment.items() if name != "columns"})
    assert len(again.rows) == len(lines) - 2
    assert {row.wall_s for row in again.rows.values()} <= {row.wall_s for row in measured.rows}
    assert not RowFile(path, {"scene": "another"}).rows and len(path.read_text().splitlines()) == 1


@pytest.mark.parametrize("known", integrators(), ids=lambda known: known.name)
def test_a_step_changes_what_a_method_of_fixed_step_does_and_no_other(known: Integrator) -> None:
    """The table of integrators is asked in place of the scene: it tells the truth, and the grid has all."""
    given = {"t_end": 0.2, "dt_out": 0.2, "integrator": known.name, "channels": ["position"]}
    runs = [sc.Run(pendulum(), dt=dt, **given) for dt in (0.05, 0.025)]
    assert all(run.advance(0.2) for run in runs)
    few, many = (run.core.statistics()["steps"] for run in runs)
    assert (few != many) == (known.setting == "dt") == (not runs[0].core.adaptive)
    assert known.name in {method.integrator for method in methods.measured_methods()}


def test_another_memory_is_that_of_a_case_built_with_it(case2: sc.Scene) -> None:
    scenes = [answers.with_memory(case2, "by-motion", level=limit) for limit in (0.05, 0.01)]
    few, more = (scene.compile().memory_states for scene in scenes)
    assert few < more
    built = cases.case2(memory="by-motion")
    changed = answers.with_memory(case2, "by-motion")
    ship = built.vessels["vessel"]
    mooring = {name: getattr(ship, name) for name in ("mooring_stiffness", "mooring_damping")}
    changed.replace("vessel", kind="vessel", **mooring)
    one, other = (sc.simulate(scene, t_end=T_END, **TIGHT) for scene in (built, changed))
    assert np.abs(one["position"] - other["position"]).max() < 1e-10  # feed-forward loads differ by rounding
    assert case2.provenance["vessel"].memory == "per-pair"


def row_of(method: sc.Method, cost: float, **errors: float) -> Row:
    measures = {name: ErrorMeasures(largest=value, rms=value, std=value) for name, value in errors.items()}
    return Row(case={}, method=method, verdict="completed", errors=measures, cpu_s=cost, wall_s=cost)


def test_all_default_quantities_are_held_and_error_control_is_preferred_where_costs_are_alike() -> None:
    rows = (
        row_of(
            sc.Method(integrator="semi-implicit-euler", dt=0.02), 1.0, payload_position=5e-3, hook_load=3e3
        ),
        row_of(sc.Method(integrator="rk4", dt=0.05), 1.0, payload_position=0.005, hook_load=500.0),
        row_of(sc.Method(integrator="tsit5", rtol=1e-2), 1.05, payload_position=0.008, hook_load=570.0),
        row_of(sc.Method(integrator="dop853", rtol=1e-4), 2.0, payload_position=1e-4, hook_load=1.0),
    )
    names = ("payload_position", "hook_load")
    moved = {"payload_position": np.array([[[0.0]], [[1.0]]]), "hook_load": np.array([[[0.0]], [[1e5]]])}
    found = Trade(
        rows=rows,
        quantities=quantities_of(cases.case2(), cases.case2().compile(), list(names)),
        reference=Reference(values=moved, uncertainty=dict.fromkeys(names, 1e-9)),
        metadata={"default quantities": 1},
    )
    assert found.cheapest(payload_position=0.01).integrator == "tsit5"
    assert found.cheapest(others=1e-4, payload_position=0.01).integrator == "dop853"


def test_a_budget_ends_a_trade(monkeypatch: Any) -> None:
    def counted(bench: object, method: sc.Method, *given: object) -> Row:
        return Row(case={}, method=method, verdict="completed", cpu_s=1.0, wall_s=1.0)

    monkeypatch.setattr(trade_study.Bench, "measure", counted)
    monkeypatch.setattr(trade_study, "_price", lambda case, quantities: (1.0, 1.0))
    found = sc.trade(pendulum(), t_end=1.0, budget=3.0, progress=False)
    assert len(found.rows) == 3 and found.not_measured > 0
    assert found.told_s == trade_study.REFERENCE + 3.0


def test_a_lift_in_stages_is_judged_by_the_extremes_of_its_stages() -> None:
    """And a method that does not exist is a row with its reason."""
    stages = [sc.Stage(name="first", duration=1.0), sc.Stage(name="second", duration=1.0)]
    chosen = [sc.Method(integrator="tsit5", rtol=1e-3), sc.Method(integrator="not-yet", rtol=1e-3)]
    found = sc.trade(pendulum(), stages=stages, methods=chosen, quantities=["position"], progress=False)
    row, other = found.rows
    assert found.metadata["t_end"] == 2.0 and not other.stable and "unknown integrator" in other.message
    staged = sc.simulate(pendulum(), stages, integrator="tsit5", rtol=0.001)
    tight = sc.simulate(pendulum(), stages, integrator="verner76", rtol=1e-12)
    worst = 0.0
    for one in stages:
        own, true = (run["position"][run.stage(one.name), 0] for run in (staged, tight))
        for extreme in (np.min, np.max):
            worst = max(worst, float(np.linalg.norm(extreme(own, axis=0) - extreme(true, axis=0))))
    assert row.error("position") == pytest.approx(worst, rel=1e-6)
