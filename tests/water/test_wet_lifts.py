"""Loads in water on cranes: overload, ballast, pictures, meshes in files; water that is described twice."""

from __future__ import annotations

import re
import warnings
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import Any

import mesh_shapes
import numpy as np
import pytest
from hull_shapes import stl

from seacrane import Curve, Lift, Scene, SceneError, balance, equilibrium, shipped_database, simulate
from seacrane.errors import FileFormatError
from seacrane.hydro import BoxPart, CylinderPart, Opening, PlatePart, SpherePart, TablePart, part_from_mesh
from seacrane.inputs.frames import heel_and_trim
from seacrane.pictures.drawn_bodies import looks
from seacrane.sea import SeaState, WaveSystem, jonswap
from seacrane.warnings import LineRungWarning, OverloadWarning

G, RHO = 9.80665, 1025.0
MASS, BLOCK, SIZE, FILL = 40e3, 2e3, (6.0, 4.0, 3.0), 0.5
LIFT = RHO * G * FILL * float(np.prod(SIZE))


def lift(height: float, *, capacity: object = (), afloat: bool = True, wet: bool = True) -> Scene:
    """A load on slings over the side, its underside at a height."""
    scene = Scene(name="over the side", gravity=G)
    if afloat:
        scene.add_vessel(shipped_database())
        scene.add_crane(slew=-np.pi / 2.0, s1=1.0, s2=2.0)
    else:
        scene.add_crane(base="ground", held=True, s1=1.0, s2=2.0)
    scene.add_hoist(
        mass=MASS, size=SIZE, EA=1e8, block_mass=BLOCK, height=height, slings={"angle_deg": 60.0, "EA": 5e7}
    )
    scene.roles[""] = replace(scene.roles[""], capacity=capacity)
    if wet:
        scene.add_immersed("load", parts=[BoxPart(size=SIZE, fill=FILL)], density=RHO)
    return scene


def test_water_carries_its_share_of_a_load_above_the_table() -> None:
    left = MASS + BLOCK - LIFT / G
    for height, allowed, told in (
        (5.0, left + 10.0, "of 42 t"), (-20.0, left + 10.0, ""),
        (-20.0, left - 10.0, f"of 42 t.*water carries {LIFT / G / 1e3:.4g} t"),
    ):  # fmt: skip
        scene = lift(height, capacity=((5.0, allowed), (60.0, allowed)), afloat=False)
        with warnings.catch_warnings(record=True, action="always") as caught:
            simulate(scene, t_end=0.1, dt_out=0.1, start="rest")
        words = "".join(str(one.message) for one in caught if one.category is OverloadWarning)
        assert bool(words) == bool(told) and re.search(told, words)


@pytest.mark.parametrize(("height", "share"), [(-20.0, 1.0), (5.0, 0.0)])
def test_water_carries_its_share_of_what_a_vessel_is_balanced_for(height: float, share: float) -> None:
    wet, dry = balance(lift(height)), balance(lift(height, wet=False))
    assert wet.weight == pytest.approx(dry.weight - share * LIFT, rel=1e-9)
    at_load = np.array(lift(height).bodies["load"].position)[:2]
    moment = dry.weight * dry.weight_center[:2] - share * LIFT * at_load
    assert wet.weight_center[:2] == pytest.approx(moment / wet.weight, rel=1e-6)
    assert wet.vessel_wrench[2] == pytest.approx(wet.weight, rel=1e-9)
    assert wet.vessel_wrench[3] == pytest.approx(wet.weight * wet.weight_center[1], rel=1e-6)


@pytest.mark.parametrize("height", [-1.5, -20.0])
def test_with_its_ballast_a_vessel_floats_level_with_a_load_in_the_water(height: float) -> None:
    """At its draught too, where the load is half under; water in a compartment weighs on it."""
    scene = lift(height)
    holes = [Opening(point=(0.0, 0.0, z), area=0.1) for z in (-1.0, 1.0)]
    inside = {"area": 6.0, "height": 2.0, "point": (0.0, 0.0, -1.0), "openings": holes}
    scene.add_immersed("load", inside=inside, density=RHO)
    found = scene.add_ballast()
    dry = balance(lift(height, wet=False)).weight
    if height < -3.0:
        assert -found.weight == pytest.approx(dry - LIFT + RHO * G * 12.0, rel=1e-8)
    model = scene.compile()
    at = model.pose_index(list(model.bodies).index("vessel"))
    pose = np.asarray(equilibrium(scene).values)[at : at + 7]
    assert pose[2] == pytest.approx(scene.bodies["vessel"].position[2], abs=1e-5)
    assert heel_and_trim(pose[3:]) == pytest.approx((0.0, 0.0), abs=1e-8)


def test_parts_in_water_are_drawn_where_they_are() -> None:
    scene = Scene(name="drawn")
    scene.add_body("load", mass=1e3, size=(2.0, 2.0, 2.0), center_of_mass=(0.0, 0.0, 0.5))
    turned = ((0.0, 0.0, 1.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))  # its x is the body's y
    rod = CylinderPart(length=4.0, diameter=0.5, strips=1, point=(1.0, 0.0, 0.0), axes=turned)
    ball = SpherePart(diameter=1.0, point=(0.0, 0.0, 3.0))
    plate = PlatePart(size=(3.0, 1.0), strips=(2, 1), point=(0.0, 0.0, -1.0))
    scene.add_immersed("load", parts=[rod, ball, plate])
    _, rod, ball, *strips = looks(scene)["load"].shapes
    assert np.sort(rod.points[:, 1]) == pytest.approx([-2.0, 2.0])
    assert rod.points[:, [0, 2]] == pytest.approx(np.array([[1.0, -0.5], [1.0, -0.5]]))
    assert ball.vertices.mean(axis=0) == pytest.approx([0.0, 0.0, 2.5], abs=1e-12)
    assert np.ptp(np.concatenate([one.points for one in strips]), axis=0) == pytest.approx([3.0, 1.0, 0.01])


MESHED = """format = "seacrane lift"
version = 2
run = { t_end_s = 1 }
body = [{ name = "load", mass_kg = 4000, size_m = [2, 1, 1.5] }]
[[immersed]]
body = "load"
[[immersed.parts]]
kind = "mesh"
mesh = "shapes/load.stl"
scale = 1e-3
draughts_m = [0.3, 0.75, 1.5]
panels = 60
wetting = 1.2
perforation = 0.1
drag_area_m2 = [1, 2, 3]
point_m = [0, 0, 0.1]
source = "drawn"
"""


@pytest.mark.filterwarnings("ignore::seacrane.warnings.MeshConvergenceWarning")
def test_a_mesh_in_a_lift_file_is_that_of_a_script(tmp_path: Path) -> None:
    pytest.importorskip("capytaine", reason="pip install 'seacrane[hydro]'")
    for folder in ("shapes", "elsewhere"):
        (tmp_path / folder).mkdir()
    mesh = stl(tmp_path / "shapes" / "load.stl", 1e3 * mesh_shapes.box((2.0, 1.0, 1.5)))
    path, again = tmp_path / "lift.toml", tmp_path / "elsewhere" / "again.toml"
    path.write_text(MESHED, encoding="utf-8")
    lifted, scene = Lift.load(path), Scene(name="lift")
    scene.add_body("load", mass=4000.0, size=(2.0, 1.0, 1.5))
    part = part_from_mesh(mesh, scale=1e-3, draughts=(0.3, 0.75, 1.5), panels=60, wetting=1.2,
                          perforation=0.1, drag_area=(1.0, 2.0, 3.0), point=(0.0, 0.0, 0.1),
                          source="drawn")  # fmt: skip
    (expected,) = scene.add_immersed("load", parts=[part])
    assert lifted.scene().loads["load.1"] == expected
    lifted.save(again)
    assert Lift.load(again).scene().loads["load.1"] == expected
    path.write_text(MESHED.replace("scale = 1e-3", ""), encoding="utf-8")
    with pytest.raises(FileFormatError, match=r"lift\.toml line \d+.*scale=0\.001"):
        Lift.load(path).scene()


def test_what_a_hull_that_floats_displaces_is_not_counted_twice() -> None:
    """Parts without volume, and in the air, are taken."""
    scene = Scene(name="afloat", gravity=G)
    scene.add_vessel(shipped_database())
    scene.add_immersed("vessel", parts=[BoxPart(size=(40.0, 0.4, 0.4), fill=0.0)], name="bilge keel")
    scene.add_immersed("vessel", parts=[BoxPart(size=(4.0, 4.0, 2.0), point=(0.0, 0.0, 12.0))], name="hut")
    heave = simulate(scene, 5.0, dt_out=1.0).select("position", body="vessel", axis="z")
    assert np.abs(heave - heave[0]).max() < 1e-6
    scene.add_immersed("vessel", parts=[PlatePart(size=(9.0, 1.0), thickness=0.1)], name="bottom")
    with pytest.raises(SceneError, match=r"'bottom\.1': displaces .* m3 as a part of 'vessel'.*volume"):
        scene.compile()


@pytest.mark.parametrize(
    ("bed", "depth", "tp", "told"),
    [(14.0, np.inf, 8.0, "'bed': lies 14 m.*infinite depth"), (80.0, 14.0, 8.0, "lies 80 m.*14 m deep"),
     (40.0, np.inf, 16.0, "wavenumbers differ by"), (14.0, 14.0, 8.0, ""), (14.0, np.inf, 5.0, "")],
)  # fmt: skip
def test_a_seabed_has_the_depth_of_the_sea(bed: float, depth: float, tp: float, told: str) -> None:
    scene = Scene(name="landed", gravity=G)
    scene.add_body("load", mass=1e4, inertia=(1e4,) * 3, position=(0.0, 0.0, -bed + 3.0))
    scene.add_contact("load", on="ground", points=[(0.0, 0.0, 0.0)], place=(0.0, 0.0, -bed), name="bed")
    wind = WaveSystem(spectrum=jonswap(hs=1.5, tp=tp), direction_deg=0.0)
    scene.add_sea(sea=SeaState(systems=[wind], depth=depth), vessel=None)
    with pytest.raises(SceneError, match=told) if told else nullcontext():
        scene.compile()


def frame(height: float = 1.0) -> TablePart:
    given: dict[str, Any] = {"depths": [0, 1, 2], "volumes": [0, 0, 0], "drag_area": (1, 1, 1)}
    rows = [[0.0] * 3, [1e3] * 3, [1e3] * 3]
    return TablePart(height=height, added_masses=rows, source="mine", **given)


def test_a_table_without_volume_keeps_its_drag_and_its_ledger(formulation: str) -> None:
    scene = Scene(name="frame", gravity=G)
    scene.add_body("load", mass=1e3, inertia=(1e3,) * 3, position=(0.0, 0.0, 2.0))
    scene.add_immersed("load", parts=[frame()])
    run = simulate(scene, 20.0, dt_out=0.1, formulation=formulation, integrator="dop853", rtol=1e-9)
    assert -run["velocity"][-1, 0, 2] == pytest.approx(np.sqrt(1e3 * G / (0.5 * 1025.0)), rel=1e-6)
    assert np.abs(run["energy_balance"]).max() < 1e-6 * run["absolute_work"].max()


def test_its_drag_is_that_of_the_height_that_is_wet() -> None:
    pulls = []
    for depth in (1.0, 2.0, 4.0, 9.0):
        scene = Scene(name="towed", gravity=G)
        scene.add_body(
            "load", mass=1e3, inertia=(1e3,) * 3, position=(0.0, 0.0, 2.0 - depth), velocity=(3.0, 0.0, 0.0)
        )
        scene.add_immersed("load", parts=[frame(4.0)])
        force = simulate(scene, 0.01, dt_out=0.01, channels=["load_force"])["load_force"][0].reshape(3)
        pulls.append(-force[0] / (0.5 * 1025.0 * 9.0))
    share = np.array([0.25, 0.5, 1.0, 1.0])  # with a rounded end
    assert pulls == pytest.approx(share + share**2 - share**3, rel=1e-6)


def lowered(start: float, *, side: float = 9.0) -> Scene:
    scene, mass = Scene(name="mudmat", gravity=G), 30e3
    scene.add_body("load", mass=mass, size=(6, 4, 2), position=(0, 0, start))
    lifted = 1025.0 * side**2 * 0.1 if start < 0.0 else 0.0
    scene.add_line("w", first="ground", first_point=(0, 0, start + 31.0), second="load", EA=4e8, rung="auto",
                   tension_at_start=(mass - lifted) * G)  # fmt: skip
    scene.add_winch("w", rate=Curve.quintic(start_time=1.0, end_time=4.0, start=0.0, end=0.5), lag=0.3)
    scene.add_immersed("load", parts=[PlatePart(size=(side, side), thickness=0.1)])
    return scene


def test_what_may_be_struck_by_the_water_hangs_on_elastic_lines() -> None:
    told = simulate(lowered(2.0), 3.0).stats["line_rungs"]
    assert told.startswith("w: elastic: immersed part 'load.1' is not under water, and slam is faster than")
    assert simulate(lowered(-20.0), 3.0).stats["line_rungs"].startswith("w: quasi-static")


def test_what_came_out_and_is_struck_again_on_a_line_that_was_settled_is_told() -> None:
    scene = lowered(-0.5, side=1.0)
    down = Curve.quintic(start_time=5.0, end_time=8.0, start=-0.5, end=0.5)
    up = Curve.quintic(start_time=1.0, end_time=3.0, start=0.0, end=-0.5)
    scene.replace("w", rate=up.then(time=5.0, curve=down))
    with pytest.warns(LineRungWarning, match=r"part 'load\.1': met water at t = \d+.*'w'"):
        run = simulate(scene, 12.0, dt_out=0.1)
    assert run.stats["line_rungs"].startswith("w: quasi-static")
    assert run["position"][:, 0, 2].max() > 0.1, "it was out"
