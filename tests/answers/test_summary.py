"""The summary of a run: numbers by hand, units, static loads, what limits them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from line_scenes import hung
from test_result import crane_run

from seacrane import Frame, Result, Scene, SceneError, cases, simulate, statics, summary
from seacrane.pictures import plot_summary
from seacrane.plotting.table import Column, Table
from seacrane.result import About

G = 9.80665
MASS, LENGTH = 2000.0, 5.0


def pendulum(*, angle: float = 0.3) -> Scene:
    """A load on a rod from the ground, let go at an angle from straight down."""
    scene = Scene(name="pendulum", gravity=G)
    place = (LENGTH * np.sin(angle), 0.0, -LENGTH * np.cos(angle))
    scene.add_body(name="load", mass=MASS, inertia=1e-3 * MASS * np.eye(3), position=place)
    frames = {"first_frame": Frame(), "second_frame": Frame()}
    scene.add_joint("rope", kind="distance", first="ground", second="load", length=LENGTH, **frames)
    scene.add_roles(link="rope")
    return scene


@pytest.fixture(scope="module")
def swinging() -> Result:
    return simulate(pendulum(), t_end=20.0, dt_out=0.02)


def test_a_swinging_load_in_closed_form(swinging: Result) -> None:
    """T = m g (3 cos phi - 2 cos phi0): m g cos phi0 at the ends, m g (3 - 2 cos phi0) at the bottom."""
    told, weight = summary(swinging), MASS * G
    tension = told["hoist tension"]
    assert tension.unit == "N" and tension.static_known
    assert tension.static == pytest.approx(weight, rel=1e-12)
    assert tension.maximum == pytest.approx(weight * (3.0 - 2.0 * np.cos(0.3)), rel=1e-4)
    assert tension.minimum == pytest.approx(weight * np.cos(0.3), rel=1e-4)
    assert tension.factor == pytest.approx(3.0 - 2.0 * np.cos(0.3), rel=1e-4)
    swing = told["load swing"]
    assert swing.unit == "rad" and swing.maximum == pytest.approx(0.3, rel=1e-6)
    assert swing.factor is None and not swing.static_known and swing.static == pytest.approx(0.3)
    assert told["load offset x"].minimum == pytest.approx(-LENGTH * np.sin(0.3), rel=1e-4)
    assert "load offset y" not in {row.name for row in told}  # nothing moves along y


def test_numbers_are_those_of_the_part_asked_for(swinging: Result, tmp_path: Path) -> None:
    part = (swinging.time >= 3.05) & (swinging.time <= 11.0)
    values, told = swinging["link_tension"][part], summary(swinging, after=3.05, before=11.0)
    row = told["hoist tension"]
    assert (row.mean, row.std) == pytest.approx((values.mean(), values.std()), rel=1e-12)
    least, largest = swinging.reached("link_tension", part=swinging.part(after=3.05))
    inside = swinging.time[swinging.part(after=3.05)] <= 11.0
    assert (row.minimum, row.maximum) == (least[inside].min(), largest[inside].max())
    assert (row.minimum, row.maximum) == pytest.approx((values.min(), values.max()), rel=1e-4)
    assert row.maximum_at == swinging.time[part][values.argmax()]
    offset = told["load offset x"]
    assert not offset.static_known
    assert offset.static == pytest.approx(swinging["position"][part][0, 0, 0], rel=1e-9)
    swinging.save(tmp_path / "swing.nc")
    assert summary(Result.load(tmp_path / "swing.nc")) == summary(swinging)


def bar(*rods: tuple[str, float]) -> Scene:
    scene = Scene(name="bar")
    scene.add_body(name="bar", mass=1e4, inertia=1e4 * np.eye(3), position=(0.0, 0.0, -5.0))
    for name, x in rods:
        scene.add_joint(
            name=name, kind="distance", first="ground", second="bar", point=(x, 0.0, 0.0),
            second_point=(x, 0.0, -5.0), length=5.0,
        )  # fmt: skip
    return scene


def test_what_two_rods_share_has_the_static_load_of_the_scene_at_rest() -> None:
    """A bar of 10 t, its rods at -1 and 3 m of its centre: 3/4 and 1/4 of its weight."""
    told = summary(simulate(bar(("left", -1.0), ("right", 3.0)), t_end=0.5))
    assert told["tension left"].static == pytest.approx(7.5e3 * G, rel=1e-9)
    assert told["tension right"].static == pytest.approx(2.5e3 * G, rel=1e-9)
    assert told["tension left"].static_known and told["tension left"].factor == pytest.approx(1.0, rel=1e-6)


def test_block_slings_and_taglines_have_their_factors_by_themselves() -> None:
    """With constant-tension taglines nothing hangs alone: static loads are those of the scene at rest."""
    scene = Scene(name="rigged")
    scene.add_crane(base="ground", s1=1.5, s2=1.0)
    scene.add_hoist(mass=20e3, size=(4, 4, 3), EA=3e7, block_mass=1e3, slings={"angle_deg": 60, "EA": 5e7})
    x, y, z = scene.bodies["load"].position
    for name, side in (("port", 15.0), ("starboard", -15.0)):
        scene.add_line(
            name, "ground", "load", EA=1e6, first_point=(x, y + side, z), second_point=(0, side / 7.5, 0)
        )
        scene.add_winch(name, tension=5e3, tension_gain=1e-4, maximum_rate=1.0)
    rested = simulate(scene, 2.0, start="rest")
    told = summary(rested)
    load = told["hook load"]
    assert load.static_known and load.static == pytest.approx(21e3 * G, rel=2e-3)
    assert load.factor == pytest.approx(1.0, rel=1e-3)
    for name in ("line tension hoist sling 1", "line tension port"):
        assert told[name].static_known and told[name].factor == pytest.approx(1.0, rel=1e-2), name
    rows = [row.name for row in told]
    assert not [name for name in rows if name.startswith("hook load ")], "a sling's load is its tension"
    assert load.static == pytest.approx(summary(rested, static=statics(scene))["hook load"].static)


def test_a_load_of_all_falls_is_no_tension_of_one() -> None:
    """A run that kept hook loads alone has no row of the line; with its tension that is half the load."""
    scene = Scene(name="two falls")
    scene.add_crane(base="ground", s1=1.5, s2=1.0)
    scene.add_hoist(mass=20e3, size=(4, 4, 3), length=10.0, falls=2, EA=3e7)
    alone = summary(simulate(scene, 1.0, channels=["hook_load"]))
    both = {
        row.name: row.mean for row in summary(simulate(scene, 1.0, channels=["hook_load", "line_tension"]))
    }
    assert not [row for row in alone if "tension" in row.name]
    assert both["hoist tension"] == pytest.approx(both["hook load"] / 2, rel=1e-3)


def test_no_static_load_is_made_up() -> None:
    """A bar on three rods in a row is statically indeterminate: how they share it is not known."""
    with pytest.warns(UserWarning, match="redundant"):
        result = simulate(bar(("left", -1.0), ("middle", 0.0), ("right", 1.0)), t_end=0.5)
    told = summary(result)
    row = told["tension left"]
    assert not row.static_known and row.factor is None and row.mean == pytest.approx(1e4 / 3 * G, rel=1e-6)


def test_a_table_prints_and_becomes_data_in_si(tmp_path: Path) -> None:
    pull, lift = Column(name="pull", values=[1e3, None], unit="N"), Column(name="lift", values=[np.nan, 1.0])
    table = Table(axes=[Column(name="row", head="", values=["<a>", "b"])], columns=[pull, lift])
    assert str(table).splitlines() == ["     pull [kN]  lift", "<a>          1     -", "b                  1"]
    assert '<td>&lt;a&gt;</td><td class="number">1</td>' in table.html()
    assert table.to_csv(tmp_path / "t.csv").read_text() == "row,pull [N],lift\n<a>,1000.0,\nb,,1.0\n"


def test_it_prints_as_a_table_becomes_data_and_is_drawn(swinging: Result) -> None:
    told = summary(swinging)
    assert str(told).splitlines()[2].split()[:4] == ["hook", "load", "t", "2"]
    assert float(told.to_xarray()["maximum"].sel(row="hoist tension")) == told["hoist tension"].maximum
    labels = [axes.get_ylabel() for axes in plot_summary(swinging).axes]
    assert sorted(labels) == ["hoist tension [kN]", "hook load [t]", "load offset [m]", "load swing [deg]"]
    with pytest.raises(SceneError, match="0 to 20 s"):
        summary(swinging, after=3.0, before=2.0)


def test_a_record_too_short_and_a_transient_are_told() -> None:
    run = crane_run() | {"time": np.linspace(0.0, 60.0, 601)}
    steady = 1e5 + 5e3 * np.sin(2.0 * np.pi * run["time"] / 8.0)
    run["arrays"] = {"link_tension": steady.copy()}
    run["about"] = About(settings={"tp": 8.0, "hs": 2.0})
    (short,) = summary(Result.from_arrays(**run)).remarks
    assert "60 s are 8 peak periods" in short and "800 s" in short
    run["arrays"] = {"link_tension": steady + 4e4 * np.exp(-run["time"] / 5.0)}
    result = Result.from_arrays(**run)
    assert any("transient or a move is inside: link tension" in text for text in summary(result).remarks)
    assert not any("transient" in text for text in summary(result, after=25.0).remarks)


def test_static_values_come_from_statics() -> None:
    """The pose of the run's end: cylinder forces have a factor then, and the ship its heel."""
    scene = cases.case2()
    result = simulate(scene, t_end=55.0)
    pose = {"slew": -np.pi / 2, "coordinates": {"main": 2.0, "knuckle": 2.0}}
    known = statics(scene, **pose)
    told = summary(result, after=50.0, static=known)
    main = told["cylinder force main"]
    assert main.static_known and main.static == pytest.approx(known["cylinder force main"].item())
    assert main.factor == pytest.approx(main.maximum / main.static) and 1.0 < main.factor < 1.3
    assert told["roll"].static == pytest.approx(known["heel"].item()) and told["roll"].static_known
    assert not told["heave"].static_known
    with pytest.raises(SceneError, match="static is of 2 poses; give statics of one"):
        summary(result, static=statics(scene, slew=[0.0, 1.0]))


@pytest.mark.filterwarnings("ignore::seacrane.warnings.LargeSwingWarning")
def test_lines_and_leads_are_told() -> None:
    told = summary(simulate(hung(stretch=0.05), t_end=5.0))
    assert told["hoist tension hoist"].maximum > told["hoist tension hoist"].minimum > 0.0
    crane = summary(simulate(cases.case2(), t_end=60.0))
    swing, side = crane["payload swing"].maximum, crane["sidelead"]
    assert "offlead" in {row.name for row in crane.rows}
    assert max(abs(side.minimum), side.maximum) == pytest.approx(swing, rel=0.2)
