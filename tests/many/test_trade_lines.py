"""The rungs of elastic lines in a trade: rigid, quasi-static and elastic, as lines of one diagram."""

from __future__ import annotations

import numpy as np
import pytest
from line_scenes import G, reeved
from numpy.testing import assert_allclose
from trade_scenes import a_run_each

from seacrane import Scene, SceneError, simulate, trade
from seacrane.trading.budget import Spending
from seacrane.trading.lines_on_rungs import LINE_RUNGS, RIGID_LINES, line_variants, with_rigid_lines


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
