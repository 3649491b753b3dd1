"""trade(): its rows, front, choice and file; less physics, and lines on other rungs."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import G, reeved
from numpy.testing import assert_allclose
from trade_scenes import a_run_each, pendulum

import seacrane as sc
from seacrane import Scene, SceneError, cases, simulate, trade
from seacrane._core import Integrator, integrators
from seacrane.accuracy import Trade, methods, simpler_scenes, trade_study
from seacrane.accuracy.case import Case
from seacrane.accuracy.measured import Reference
from seacrane.accuracy.quantities import ErrorMeasures, compare, quantities_of
from seacrane.accuracy.row import Row, RowFile
from seacrane.accuracy.simpler_scenes import LINE_RUNGS, RIGID_LINES, line_variants, with_rigid_lines
from seacrane.accuracy.trade_study import Spending
from seacrane.inputs.checked import curve_of

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
    names = [case["memory"] for case, _ in simpler_scenes.variants(case2, quick=False)]
    names = [name for name in names if name.startswith("by-m")]
    assert names == [f"by-motion limit={limit:g}" for limit in simpler_scenes.FITTED["by-motion"][1]]
    scenes = [simpler_scenes.with_memory(case2, "by-motion", level=limit) for limit in (0.05, 0.01)]
    few, more = (scene.compile().memory_states for scene in scenes)
    assert few < more
    assert simpler_scenes.full_memory_name(scenes[1], "by-motion limit=0.01") == f"by-motion:{more}"
    built = cases.case2(memory="by-motion")
    changed = simpler_scenes.with_memory(case2, "by-motion")
    ship = built.vessels["vessel"]
    mooring = {name: getattr(ship, name) for name in ("mooring_stiffness", "mooring_damping")}
    changed.replace("vessel", kind="vessel", **mooring)
    one, other = (sc.simulate(scene, t_end=T_END, **TIGHT) for scene in (built, changed))
    assert np.abs(one["position"] - other["position"]).max() < 1e-10  # feed-forward loads differ by rounding
    assert case2.provenance["vessel"].memory == "per-pair"


def test_a_weight_in_place_of_the_payload_hangs_as_the_payload_in_calm_water() -> None:
    scene = cases.case2(hs=0.0)
    for name, drive in list(scene.actuators.items()):
        start = curve_of("start", drive.feed_forward.evaluate([0.0])[0, 0])
        scene.replace(name, kind="actuator", feed_forward=start, reference=curve_of("start", 0.0))
    quantities = quantities_of(scene, scene.compile(), None)
    run = sc.simulate(scene, t_end=5.0, dt_out=0.1, **TIGHT)
    truth = {name: quantity.values(run) for name, quantity in quantities.items()}
    case = Case(scene=scene, t_end=5.0, dt_out=0.1)
    bench = trade_study.Bench(case=case, quantities=quantities, truth=Reference(values=truth), repeats=1)
    method = sc.Method(integrator="dop853", rtol=1e-9)
    row = Row(case={"memory": "none", "rung": simpler_scenes.WEIGHT}, method=method)
    done = trade_study.measure(bench, row, lambda: simpler_scenes.payload_as_weight(scene))
    assert done.stable, done.message
    assert done.error("payload_position") < 1e-6 and done.error("hook_load") < 1.0
    assert done.error("cylinder_force") < 1.0 and set(done.errors) == set(quantities)


def row_of(method: sc.Method, cost: float, **errors: float) -> Row:
    measures = {name: ErrorMeasures(largest=value, rms=value, std=value) for name, value in errors.items()}
    case = {"memory": "none", "waves": "none", "rung": "full"}
    return Row(case=case, method=method, verdict="completed", errors=measures, cpu_s=cost, wall_s=cost)


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
        metadata={"memory": "none", "waves": "none", "default quantities": 1},
    )
    assert found.cheapest(payload_position=0.01).integrator == "tsit5"
    assert found.cheapest(others=1e-4, payload_position=0.01).integrator == "dop853"


def test_a_budget_ends_a_trade(monkeypatch: Any) -> None:
    def counted(bench: object, row: Row, *given: object) -> Row:
        return replace(row, verdict="completed", cpu_s=1.0, wall_s=1.0)

    monkeypatch.setattr(trade_study, "measure", counted)
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


def hung(rung: str) -> Scene:
    """2 t that swing on 8 m of stiff line below an arm that is not at the origin."""
    scene = Scene(name="pendulum")
    scene.add_body(name="arm", mass=5e3, inertia=(50, 50, 50), position=(1, 2, 3), quaternion=(0, 0, 0, 1))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="arm", point=(1, 2, 3))
    scene.add_actuator(joint="guide", stiffness=1e6, damping=5e4)
    place = np.array([1.0, 2.0, 3.0]) + 8.0 * np.array([np.sin(0.3), 0.0, -np.cos(0.3)]) + (0.5, 0, 0)
    scene.add_body(name="load", mass=2e3, inertia=(300.0, 400.0, 500.0), position=place)
    length, ends = 8.0 / (1.0 + 2e3 * G * np.cos(0.3) / 1e10), [(-0.5, 0, 0), (0, 0, 0)]
    scene.add_line("hoist", bodies=["arm", "load"], points=ends, EA=1e10, length=length, rung=rung)
    return scene


def test_the_rungs_that_a_scene_does_not_have_are_tried() -> None:
    kept = (RIGID_LINES, LINE_RUNGS[2])
    for rung, others in (("elastic", LINE_RUNGS[:2]), ("auto", LINE_RUNGS[:2]), ("quasi-static", kept)):
        made = {name: build() for name, build in line_variants(hung(rung))}
        assert tuple(made) == others
        assert not made[RIGID_LINES].loads.keys() & {"hoist"}
        assert made[RIGID_LINES].joints["hoist"].length == pytest.approx(8.0, rel=1e-12)
        assert f"lines {made[others[1]].loads['hoist'].rung}" == others[1]
    assert not list(line_variants(Scene(name="without")))
    runs = [simulate(one, 2.0, dt_out=0.1) for one in (hung("elastic"), with_rigid_lines(hung("elastic")))]
    assert_allclose(runs[0]["position"], runs[1]["position"], atol=2e-3)  # a rigid link as the stiff line


def test_each_rung_is_a_line_with_its_cost_and_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Spending, "spend", a_run_each)
    found = trade(hung("elastic"), t_end=2.0, progress=False)
    rows = {name: [row for row in found.rows if row.case["rung"] == name] for name in LINE_RUNGS}
    assert [len(rows[name]) for name in LINE_RUNGS] == [2, 2, 0]
    elastic = min(row.evaluations for row in found.rows if row.stable and row.case["rung"] == "full")
    for name in LINE_RUNGS[:2]:
        assert all(row.stable for row in rows[name])
        assert rows[name][-1].error("position") < 2e-3
        assert rows[name][0].evaluations < elastic


def test_what_has_no_rigid_rung_is_a_row_with_its_reason() -> None:
    with pytest.raises(SceneError, match="'hoist': runs over 4 points"):
        with_rigid_lines(reeved())
    scene = hung("elastic")
    scene.add_winch(line="hoist", lag=0.2)
    found = trade(scene, t_end=0.5, progress=False)
    (row, _) = [row for row in found.rows if row.case["rung"] == RIGID_LINES]
    assert row.verdict == "refused" and "its length changes" in row.message
