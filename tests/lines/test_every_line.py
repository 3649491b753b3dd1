"""What every line, winch and compensator owes: formulations, merged bodies, ledger, restarts, Jacobians."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from element_runs import FORMULATIONS, both_forms, goes_on
from heave_scenes import moving_crane
from heavy_line_scenes import KINDS, dropped, in_waves, wet
from line_scenes import busy, reeved, settled, swinging, taut
from reeving_scenes import slewing, stiff
from test_jacobian import largest_error, moving

from seacrane import Curve, Run, Scene

EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-9, "dt_out": 0.1}
WITH_MASS = {"position": 1e-7, "load_state": 1e-6}
USUAL = {"position": 1e-7, "load_state": 1e-7}
TENSE = USUAL | {"line_tension": 0.2}
LYING, ROUGH = ({"position": bound, "load_state": bound} for bound in (1e-6, 1e-5))


IMPLICIT: dict[str, Any] = {"integrator": "rosenbrock", "rtol": 1e-5}
FIXED: dict[str, Any] = {"integrator": "rk4", "dt": 2e-3}


class Case:
    """A scene, for how long it runs, what agrees, and states to go on from and to linearise at."""

    def __init__(
        self, make: Callable[[], Scene], t_end: float, within: dict[str, float], how: Any = None, *,
        methods: tuple[dict[str, Any], ...] = ({"integrator": "dopri5"},), at: float | None = None,
        taut: bool = True,
    ) -> None:  # fmt: skip
        self.make, self.t_end, self.within, self.how = make, t_end, within, how or {"rtol": 1e-10}
        self.methods, self.at = methods, at  # s, where its Jacobian is asked for; else near the start
        self.taut = taut  # else its quasi-static line goes slack: no runs


def wound() -> Scene:
    return in_waves(Curve.quintic(start_time=-1.0, end_time=4.0, start=10.5, end=14.0))


CASES: dict[str, Case] = {
    "on a winch": Case(swinging, 4.0, TENSE, at=0.9),
    "over blocks": Case(reeved, 4.0, TENSE, methods=({"rtol": 1e-7}, FIXED, IMPLICIT), at=0.9),
    "on a drum with brake": Case(busy, 4.0, USUAL, methods=({"rtol": 1e-7}, IMPLICIT), at=2.1),
    "over sheaves": Case(slewing, 2.0, USUAL | {"section_tension": 0.2}, at=0.9),
    "quasi-static over sheaves": Case(lambda: stiff(3e7, "quasi-static"), 1.5, USUAL, at=0.5),
    "quasi-static on a winch": Case(lambda: settled(swinging(), settling=0.1), 4.0, USUAL, at=0.9),
    "two quasi-static ones": Case(taut, 4.0, USUAL, {"rtol": 1e-9}, at=0.9),
    "heave compensators": Case(moving_crane, 4.0, ROUGH, {"rtol": 1e-8}, methods=({"rtol": 1e-6}, IMPLICIT),
                               at=0.9),
    "on a seabed": Case(lambda: dropped(segments=3), 3.0, LYING, EXACT),
    "on a seabed in water": Case(lambda: dropped(medium="sea", diameter=0.1), 3.0, LYING, EXACT),
    "paid out by a curve": Case(wound, 2.0, {"position": 1e-8}, EXACT),
    "with mass, quasi-static": Case(lambda: wet(rung="quasi-static", compensated=True), 2.0, WITH_MASS, EXACT,
                                    taut=False),
} | {
    f"with mass, {kind}": Case(lambda kind=kind: wet(compensated=True, **KINDS[kind]), 2.0, WITH_MASS, EXACT)
    for kind in KINDS
}  # fmt: skip
RUNS = {name: case for name, case in CASES.items() if case.taut}
pytestmark = pytest.mark.warns(
    sometimes=["LiftedStartWarning", "QuasiStaticLineWarning", "WinchLimitWarning", "LineLengthWarning"]
)


@pytest.mark.parametrize("name", RUNS)
def test_formulations_agree_and_the_ledger_closes(name: str) -> None:
    case = CASES[name]
    out = both_forms(case.make(), case.t_end, case.within, merge=True, **case.how)
    assert out["absolute_work"][-1] > 1e3
    assert np.ptp(out["position"], axis=0).max() > 0.1
    if "sheave_friction_power" in out:
        assert np.min(out["sheave_friction_power"]) < -1.0 and np.max(out["sheave_friction_power"]) <= 0.0
    if "drum_brake_power" in out and name == "on a drum with brake":
        assert np.min(out["drum_brake_power"]) < -100.0 and np.max(out["drum_brake_power"]) < 1e-6


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize(
    ("name", "method"), [(name, i) for name, case in RUNS.items() for i in range(len(case.methods))]
)
def test_a_run_goes_on_bit_for_bit(name: str, method: int, formulation: str, tmp_path: Path) -> None:
    case = CASES[name]
    goes_on(case.make, 1.5, 0.73, tmp_path, dt_out=0.05, formulation=formulation, **case.methods[method])


@pytest.mark.parametrize("name", CASES)
def test_the_exact_jacobian_is_that_of_differences(name: str) -> None:
    case = CASES[name]
    model = case.make().compile(merge=False)
    if case.at is None:
        for seed in (1, 4):
            assert largest_error(model, 0.7, moving(model, seed), step=3e-4, kinks=True) < 1e-6
        return
    run = Run(case.make(), t_end=case.at, dt_out=0.1, rtol=1e-8, model=model)
    run.advance(case.at)
    assert largest_error(model, case.at, np.array(run.core.state.values), step=3e-4, kinks=True) < 1e-6
