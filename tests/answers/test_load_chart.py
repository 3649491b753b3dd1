"""Load charts: one point in closed form, limits that hold at the load found, the crane's own table."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane import FileFormatError, Scene, SceneError, load_chart, statics
from seacrane.crane import Crane, Payload, load_crane
from seacrane.crane.load_crane import SHIPPED, parse_crane
from seacrane.hydro import shipped_database
from seacrane.pictures import plot_load_chart

G = 9.80665
MASS = 5e4
KNUCKLE = SHIPPED / "knuckle_boom_250t.toml"
TABLE = "[capacity]\nrows = [[10.0, 120e3], [20.0, 60e3], [30.0, 30e3]]\n"


def with_table(folder: Path) -> Crane:
    path = folder / "crane.toml"
    path.write_text(f"{KNUCKLE.read_text()}\n{TABLE}")
    return load_crane(path)


def quay(crane: Crane | None = None, *, mass: float = MASS) -> Scene:
    scene = Scene(name="quay")
    scene.add_crane(crane, base="ground", s1=2.0, s2=2.0, payload=Payload(mass=mass))
    return scene


def ship() -> Scene:
    scene = Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="none")
    scene.add_crane(s1=2.0, s2=2.0, payload=Payload(mass=MASS))
    scene.add_ballast()
    return scene


def test_one_point_in_closed_form() -> None:
    """On a fixed base a cylinder's force is linear in the load: F(m) = F(0) + m (F(1) - F(0))."""
    crane, limit = load_crane(), 12e6
    empty, one = (crane.static_cylinder_forces(s1=2.0, s2=2.0, payload_mass=m)[0] for m in (0.0, 1.0))
    radius = statics(quay())["tip radius"].item()
    chart = load_chart(quay(), radii=radius, limits={"cylinder force main": limit})
    assert chart.allowable[0, 0] == pytest.approx((limit - empty) / (one - empty), rel=1e-5)
    assert chart.governing[0, 0] == "cylinder force main"
    heavier = load_chart(quay(mass=9e4), radii=radius, limits={"cylinder force main": limit})
    assert heavier.allowable == pytest.approx(chart.allowable, rel=1e-5), "whatever load the scene has"


def test_at_the_load_found_the_limit_is_reached() -> None:
    limits = {"cylinder force knuckle": 6e6, "heel_deg": 6.0}
    chart = load_chart(ship(), slews=[0.0, -np.pi / 2], radii=[20.0, 25.0], limits=limits)
    assert chart.governing.tolist() == [["cylinder force knuckle"] * 2, ["heel"] * 2]
    scene = ship()
    body = scene.bodies["payload"]
    mass = chart.allowable[1, 1]
    scene.replace("payload", mass=mass, inertia=np.asarray(body.inertia) * mass / body.mass)
    told = statics(scene, slew=-np.pi / 2, radius=25.0)
    assert abs(told["heel"].item()) == pytest.approx(np.radians(6.0), rel=1e-4)
    assert abs(told["cylinder force knuckle"].item()) < 6e6


def test_the_crane_s_own_table_is_a_limit(tmp_path: Path) -> None:
    scene = quay(with_table(tmp_path))
    chart = load_chart(scene, radii=[25.0, 21.0])
    np.testing.assert_allclose(chart.allowable, [[45e3, 57e3]])
    assert chart.to_xarray()["governing"].values.tolist() == [["capacity", "capacity"]]
    load, table = plot_load_chart(chart).axes[0].lines
    assert load.get_xdata().tolist() == [21.0, 25.0]
    np.testing.assert_allclose(load.get_ydata(), table.get_ydata())
    tighter = load_chart(scene, radii=[21.0, 25.0], limits={"hook load": 50e3 * G})
    np.testing.assert_allclose(tighter.allowable, [[50e3, 45e3]], rtol=1e-6)
    assert tighter.governing.tolist() == [["hook load", "capacity"]]
    assert scene.roles[""].capacity[1] == (20.0, 60e3)


def test_no_load_and_any_load() -> None:
    """An empty hook that exceeds a limit is told from loads that nothing limits."""
    chart = load_chart(quay(), radii=27.0, limits={"cylinder force main": 10.0})
    assert np.isnan(chart.allowable[0, 0])
    free = load_chart(quay(), radii=27.0, limits={"slew torque": 10.0})
    assert np.isinf(free.allowable[0, 0])


def test_what_makes_no_chart_is_refused() -> None:
    for limits, words in (({}, "no table"), ({"roll": 5.0}, "'roll'"), ({"heel": -5}, "'heel' is -5")):
        with pytest.raises(SceneError, match=words):
            load_chart(quay(), radii=25.0, limits=limits)
    with pytest.raises(FileFormatError, match="increasing"):
        parse_crane(f"{KNUCKLE.read_text()}\n[capacity]\nrows = [[20.0, 60e3], [10.0, 1e5]]\n")
