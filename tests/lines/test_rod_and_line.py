"""What a rod has, a line has: every row of the table in docs/lines.md, asked of every lift by a run."""

from __future__ import annotations

import json
import warnings
from collections.abc import Callable
from functools import cached_property, lru_cache
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Lift, Result, Scene, Stage, ensemble, report, shipped_database, simulate, view
from seacrane.answers import load_chart, statics, summary
from seacrane.crane import Payload
from seacrane.description.suspension import hung_loads
from seacrane.lift.study_run import run_study
from seacrane.operability import Criterion, allowable_hs
from seacrane.pictures.drawn_bodies import looks
from seacrane.warnings import BallastWarning, LoadInHullWarning, MassUnitWarning

DOCUMENT = Path(__file__).resolve().parents[2] / "docs" / "lines.md"
G, MASS, SIZE, LENGTH = 9.80665, 40e3, (6.0, 6.0, 4.0), 8.0  # of the rod's usual load
ROPE = {"EA": 4e7}
LIFTS: dict[str, dict[str, Any]] = {
    "rod": {},
    "rigid": {"rung": "rigid"},
    "quasi-static": {"rung": "quasi-static", **ROPE},
    "elastic": {"rung": "elastic", **ROPE},
    "auto": {"rung": "auto", **ROPE},
    "with mass": {"rung": "with mass", "mass_per_length": 20.0, **ROPE},
    "four falls, block, slings": {
        "falls": 4, "block_mass": 2e3, "slings": {"angle_deg": 60.0, "EA": 8e7}, **ROPE,
    },
}  # fmt: skip
STAGES = [Stage(name="hang", duration=0.04), Stage(name="up", duration=0.04)]
HOW: dict[str, Any] = {"dt_out": 0.02, "integrator": "rk4", "dt": 5e-4}


class Hung:
    """One of the lifts, and what is told of it."""

    def __init__(self, by: str) -> None:
        self.by = by

    @property
    def hook(self) -> str:
        """Its hook load in the stage that lifts."""
        (load,) = hung_loads(self.scene())
        return f"hook_load[{load.suspension.channel}, stage=up]"

    def scene(
        self, *, mass: float = MASS, length: float = LENGTH, base: str = "vessel", slew: float = -0.5 * np.pi
    ) -> Scene:
        scene = Scene(name=self.by)
        if base == "vessel":
            scene.add_vessel(shipped_database(), memory="none")
        payload = Payload(mass=mass, size=SIZE, link_length=length) if self.by == "rod" else None
        scene.add_crane(base=base, slew=slew, payload=payload)
        if payload is None:
            scene.add_hoist(load="payload", mass=mass, size=SIZE, length=length, **LIFTS[self.by])
        return scene

    def at_sea(self) -> Scene:
        scene = self.scene()
        scene.add_limit_state(channel="offlead", maximum=0.5)
        scene.add_sea(hs=1.0, tp=8.0, seed=3, direction_deg=60.0)
        return scene

    @cached_property
    def run(self) -> Result:
        return simulate(self.at_sea(), 0.5, **HOW)

    @cached_property
    def page(self) -> str:
        return report(self.run).html

    def warned(self, category: type[Warning], *, runs: bool = True, **given: Any) -> bool:
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            scene = self.scene(**given)
            if runs:
                simulate(scene, 0.01, **HOW)
        return category in {one.category for one in caught}

    def lift_file(self, path: Path) -> None:
        """The lift on the ground, in stages."""
        told: dict[str, Any] = {
            "scene": {"name": "hung"}, "method": {"integrator": "rk4", "dt_s": 5e-4},
            "outputs": {"dt_out_s": 0.02}, "crane": [{"base": "ground"}],
            "stage": [{"name": one.name, "duration_s": 0.1} for one in STAGES],
        }  # fmt: skip
        if self.by == "rod":
            told["crane"][0]["payload_mass_kg"] = MASS
        else:
            shape = {"load": "payload", "mass_kg": MASS, "size_m": list(SIZE)}
            told["hoist"] = shape | in_file(LIFTS[self.by])
        Lift(told).save(path)


UNITS = {"EA": "EA_N", "mass_per_length": "mass_per_length_kg_per_m", "block_mass": "block_mass_kg"}
STUDY = """format = "seacrane study"
version = 2
lift = "lift.toml"

[over]
"stages.up.duration" = [0.1, 0.2]

[[keep]]
name = "peak"
channel = "hook_load[stage=up]"
what = "maximum"
"""


def in_file(given: dict[str, Any]) -> dict[str, Any]:
    return {UNITS.get(key, key): in_file(one) if isinstance(one, dict) else one for key, one in given.items()}


def weight(hung: Hung) -> float:
    return (MASS + LIFTS[hung.by].get("block_mass", 0.0)) * G


def prints(*names: str) -> Callable[[Hung], bool]:
    """Each of these rows, in the summary and in the report."""

    def check(hung: Hung) -> bool:
        return all(name in {row.name for row in summary(hung.run)} and name in hung.page for name in names)

    return check


def prints_its_factor(hung: Hung) -> bool:
    row = summary(hung.run)["hook load"]
    factor = row.maximum / row.static
    known = row.static_known and abs(row.static - weight(hung)) < 0.01 * weight(hung)
    return known and row.factor == pytest.approx(factor, rel=1e-6) and f"{factor:.2f}" in hung.page


def draws_pull_and_track(hung: Hung) -> bool:
    drawn = json.loads(view(hung.run).html.split('id="data">')[1].split("</script>")[0])
    arrows = {one["group"] for one in drawn["arrows"]}
    tracks = {(one["kind"], one["name"]) for one in drawn["tracks"]}
    return "link" in arrows and ("payload", "payload") in tracks


def draws_its_jib(hung: Hung) -> bool:
    scene = hung.scene()
    jib, tip = scene.roles[""].tip or ("", ())
    points = looks(scene)[jib].points + scene.bodies[jib].center_of_mass
    return bool(np.all(points.min(axis=0) - 0.5 < tip) and np.all(tip < points.max(axis=0) + 0.5))


def is_damped(hung: Hung) -> bool:
    kinds = {type(load).__name__ for load in hung.scene().loads.values()}
    return {"PendulumDamping", "FlowForce"} <= kinds


def has_a_chart(hung: Hung) -> bool:
    chart = load_chart(hung.scene(base="ground"), radii=[14.0, 18.0], limits={"cylinder force main": 9e6})
    (near, far) = chart.allowable.ravel()
    return bool(near > far > MASS)


def has_statics(hung: Hung) -> bool:
    told = statics(hung.scene())
    pulls = float(told["hook load"]) == pytest.approx(weight(hung), rel=0.01)
    return pulls and "hoist tension" in told.columns


def keeps_limit_states(hung: Hung) -> bool:
    (state,) = hung.run.utilisation
    return state.name == "offlead" and state.kept is True


def same(hung: Hung, **given: Any) -> Any:
    return ensemble(hung.at_sea(), stages=STAGES, keep={"peak": f"{hung.hook}.max"}, **given, **HOW)


def runs_in_ensembles(hung: Hung) -> bool:
    told = same(hung, over={"seed": [1, 2]})
    return not told.failures and bool(np.isfinite(told.dataset.peak).all())


def runs_until(hung: Hung) -> bool:
    told = same(hung, over={"seed": range(20)}, until={"peak.mean": 0.5})
    return not told.failures and told.certainty[0].seeds == 20


def has_allowable_hs(hung: Hung) -> bool:
    criterion = Criterion(channel=hung.hook, maximum=3.0 * weight(hung), statistic="p90")
    told = allowable_hs(
        hung.at_sea(), criteria=[criterion], tp=[8.0], direction_deg=[60.0], hs=(1.0,), seeds=range(1, 4),
        stages=STAGES, **HOW,
    )  # fmt: skip
    return told.dataset.domain.item() == "time" and told.dataset.reason.item() == "a lift in stages"


ROWS: dict[str, Callable[[Hung], bool]] = {
    "swing, offlead, sidelead and offset": prints(
        "payload swing", "offlead", "sidelead", "payload offset x", "payload offset y"
    ),
    "dynamic factor by itself, in summary and report": prints_its_factor,
    "hook load at a glance": lambda hung: "Largest hook load" in hung.page and "Least hook load" in hung.page,
    "arrow of tension and track in the page": draws_pull_and_track,
    "jib drawn to its tip": draws_its_jib,
    "`MassUnitWarning`": lambda hung: hung.warned(MassUnitWarning, runs=False, mass=40.0),
    "`BallastWarning`": lambda hung: hung.warned(BallastWarning, mass=400e3),
    "`LoadInHullWarning`": lambda hung: hung.warned(LoadInHullWarning, length=18.0, slew=0.0),
    "damping by default": is_damped,
    "load chart": has_a_chart,
    "columns of statics": has_statics,
    "limit states": keeps_limit_states,
    "stages in `ensemble`": runs_in_ensembles,
    "stages with `until=`": runs_until,
    "stages in `allowable_hs`": has_allowable_hs,
}


MANY_RUNS = [("with mass", "stages with `until=`")]
hung = lru_cache(Hung)


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    ("by", "row"),
    [
        pytest.param(*one, marks=[pytest.mark.slow("many runs")] if one in MANY_RUNS else [])
        for one in product(LIFTS, ROWS)
    ],
)
def test_whatever_it_hangs_on_has_it(by: str, row: str) -> None:
    assert ROWS[row](hung(by))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("by", LIFTS)
def test_a_study_file_of_its_stages_runs(by: str, tmp_path: Path) -> None:
    hung(by).lift_file(tmp_path / "lift.toml")
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    told = run_study(tmp_path / "study.toml", tmp_path / "out")
    assert not told.failures and np.isfinite(told.dataset.peak).all()


def test_the_document_shows_what_is_asked_for_here() -> None:
    lines = [f"| | {' | '.join(LIFTS)} |", "|---|" + "---|" * len(LIFTS)]
    lines += [f"| {row} |" + " yes |" * len(LIFTS) for row in [*ROWS, "stages in study files"]]
    assert "\n".join(lines) in DOCUMENT.read_text(encoding="utf-8")


@pytest.mark.filterwarnings("ignore")
def test_a_lift_off_makes_auto_elastic() -> None:
    """A seat that lets go makes an impact, which the quasi-static stretch does not know."""
    hanging = {"length": 8.0}, "rest", "quasi-static"
    for given, start, rung in (({"on": "ground", "winch": {"lag": 0.2}}, None, "elastic"), hanging):
        scene = Scene(name="on deck")
        scene.add_crane(base="ground", s1=1.5, s2=1.0)
        scene.add_hoist(mass=MASS, size=SIZE, EA=1e9, rung="auto", **given)
        assert f"hoist: {rung}" in simulate(scene, 1.0, start=start).stats["line_rungs"]
