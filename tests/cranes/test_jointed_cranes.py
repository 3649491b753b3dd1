"""Cranes of bodies and joints: lattice boom, A-frame, their statics by hand and what a bad file says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import seacrane
from seacrane import Scene, SceneError, simulate
from seacrane.crane import JointedCrane, Payload, load_crane
from seacrane.crane.jointed_file import parse
from seacrane.crane.load_crane import SHIPPED
from seacrane.errors import FileFormatError
from seacrane.inputs.frames import rotation_matrix

G = 9.80665
LATTICE = (SHIPPED / "lattice_boom_100t.toml").read_text(encoding="utf-8")
A_FRAME = (SHIPPED / "a_frame_40t.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def lattice() -> JointedCrane:
    return load_crane("lattice_boom_100t")


@pytest.fixture(scope="module")
def a_frame() -> JointedCrane:
    return load_crane("a_frame_40t")


def fixed(crane: JointedCrane, payload: Payload | None = None, **coordinates: float) -> Scene:
    scene = Scene(name="fixed base")
    scene.add_crane(
        crane, base="ground", foot=(0, 0, 0), coordinates=coordinates, payload=payload, held=True,
        damping=False,
    )  # fmt: skip
    return scene


def test_tip_of_the_lattice_boom_in_closed_form(lattice: JointedCrane) -> None:
    for boom, slew in ((0.0, 0.0), (0.6, -0.4), (1.3, 2.0)):
        out, up = 2.0 + 48.0 * math.cos(boom), 15.0 + 48.0 * math.sin(boom)
        expected = (-out * math.cos(slew), -out * math.sin(slew), up)
        assert np.allclose(lattice.tip(coordinates={"slew": slew, "boom": boom}), expected, atol=1e-12)


@pytest.mark.parametrize("degrees", [5.0, 60.0])
@pytest.mark.parametrize("load", [5e3, 80e3])
def test_luffing_rope_force_by_moments_about_the_hinge(
    lattice: JointedCrane, degrees: float, load: float
) -> None:
    """Boom and load turn about the hinge; twelve falls pull at the boom's head with their lever arm."""
    scene = fixed(lattice, Payload(mass=load, size=(3.0, 3.0, 3.0)), boom=math.radians(degrees))
    told = seacrane.statics(scene, coordinates={"boom": 0.0})["rope tension boom"]
    angle = math.radians(degrees)
    along, up = np.array([-math.cos(angle), math.sin(angle)]), np.array([math.sin(angle), math.cos(angle)])
    boom = next(body for body in lattice.data.bodies if body.name == "boom")
    x, _, z = boom.properties.center_of_mass - np.array([-2.0, 0.0, 15.0])
    center = -x * along + z * up
    head, mast = 48.0 * along, np.array([8.0, 13.0])
    moment = G * (boom.properties.mass * -center[0] + load * -head[0])
    pull = (mast - head) / np.linalg.norm(mast - head)
    arm = abs(head[0] * pull[1] - head[1] * pull[0])
    assert float(told) == pytest.approx(moment / arm / 12.0, rel=1e-9)


def test_an_elastic_luffing_rope_takes_the_place_of_the_driver(lattice: JointedCrane) -> None:
    scene = fixed(lattice, Payload(mass=50e3, size=(3.0, 3.0, 3.0)), boom=1.0)
    by_moment = float(seacrane.statics(scene, coordinates={"boom": 0.0})["rope tension boom"])
    rope = scene.add_luffing_rope()
    assert list(scene.drivers) == ["slew.angle"]
    assert len(rope.bodies) == 13
    for formulation in ("recursive", "redundant"):
        result = simulate(scene, t_end=3.0, formulation=formulation)
        tension = result["line_tension"][:, 0]
        assert np.allclose(tension, by_moment, rtol=1e-5)
        assert np.ptp(result["position"][:, -1, 2]) < 1e-5
    hauled = fixed(lattice, boom=0.5)
    hauled.add_point(name="head", body="boom", point=(-48.0, 0.0, 0.0))
    hauled.add_luffing_rope(rate=-0.3)  # blocks come nearer by what is wound over the falls, stretch aside
    head = simulate(hauled, t_end=10.0, channels=["point_position"])["point_position"][:, 0]
    shrunk = np.ptp(np.linalg.norm(head - [6.0, 0.0, 28.0], axis=1))
    assert shrunk == pytest.approx(3.0 / 12.0, rel=5e-3) and head[-1, 2] > head[0, 2]
    posed = seacrane.statics(scene, coordinates={"boom": 0.0})
    assert float(posed["rope tension boom"]) == pytest.approx(by_moment, rel=1e-9)


def test_a_frame_cylinder_force_by_virtual_work(a_frame: JointedCrane) -> None:
    """F ds = dV of all weights, by central differences of the crane's own kinematics."""
    payload = Payload(mass=20e3, size=(2.0, 2.0, 2.0), link_length=3.0)

    def potential(stroke: float) -> float:
        parts = a_frame.parts(foot=(0, 0, 0), coordinates={"tilt": stroke})
        height = sum(
            body.mass * (body.position + rotation_matrix(body.quaternion) @ body.center_of_mass)[2]
            for body in parts.bodies
        )
        return G * (height + payload.mass * parts.tip[1][2])

    for stroke in (-1.0, 0.5, 2.0):
        scene = fixed(a_frame, payload, tilt=stroke)
        told = float(seacrane.statics(scene, coordinates={"tilt": 0.0})["cylinder force tilt"])
        h = 1e-5
        work = (potential(stroke + h) - potential(stroke - h)) / (2.0 * h)
        assert told == pytest.approx(work, rel=1e-6, abs=1.0)


def test_loops_of_a_frame_close_and_keep_the_triangle(a_frame: JointedCrane) -> None:
    """Law of cosines at the hinge: deck pivot, rod head and cylinder's length."""
    a, b = math.hypot(5.0, 0.0), 5.2
    for stroke in (-1.5, 0.0, 1.0, 2.5):
        length = math.hypot(5.0, 5.2) + stroke
        opening = math.acos((a**2 + b**2 - length**2) / (2.0 * a * b))
        lean = opening - 0.5 * math.pi
        tip = np.array([0.0, 0.0, 0.8]) + 12.0 * np.array([-math.sin(lean), 0.0, math.cos(lean)])
        assert np.allclose(a_frame.tip(coordinates={"tilt": stroke}), tip, atol=1e-8)


def test_statics_find_radii_by_luffing_and_a_heavier_boom(lattice: JointedCrane) -> None:
    """A heavier boom takes more moment, by its weight's lever arm."""
    scene = fixed(lattice, Payload(mass=20e3, size=(2.0, 2.0, 2.0)), boom=1.0)
    found = seacrane.statics(scene, radius=[20.0, 40.0], slew=[0.0, 0.3])
    assert np.allclose(found["tip radius"], [[20.0, 40.0]] * 2, atol=1e-6)
    assert found.pose_units == {"slew": "rad", "radius": "m"}
    told = []
    for mass in (20e3, 30e3):
        scene.replace("boom", mass=mass)
        told.append(float(seacrane.statics(scene, coordinates={"boom": 0.0})["luff moment boom"]))
    center = lattice.mass_properties["boom"].center_of_mass
    arm = math.hypot(center[0], center[2]) * math.cos(1.0 + math.atan2(center[2], -center[0]))
    assert told[1] - told[0] == pytest.approx(G * 10e3 * arm, rel=1e-6)


BAD = [
    (LATTICE, 'kind = "jointed"', 'kind = "lattice"', "kind is 'lattice'"),
    (LATTICE, 'second = "boom"\npoint', 'second = "bom"\npoint', "its second body is 'bom'"),
    (LATTICE, 'kind = "revolute"\nfirst = "house"', 'kind = "gear"\nfirst = "house"', "kind is 'gear'"),
    (LATTICE, "axis = [0.0, 1.0, 0.0]", "axis = [0.0, 0.0, 0.0]", "is all zero"),
    (LATTICE, "range_deg = [0.0, 82.0]", "range_deg = [82.0, 0.0]", "the lower end first"),
    (LATTICE, "range_deg = [0.0", "range_dge = [0.0", r"unknown key joints\[1\] \(boom hinge\).range_dge"),
    (LATTICE, 'luffs = { boom = "boom hinge" }', 'luffs = { boom = "slw" }', "no revolute joint"),
    (LATTICE, 'luff = "boom"', 'luff = "jib"', "holds luff 'jib'"),
    (LATTICE, "falls = 12", "falls = 2.5", "a whole number"),
    (LATTICE, "EA = 60.0e6", "EA = -1.0", "EA is -1"),
    (LATTICE, "total_mass = 171000.0", "total_mass = 171.0", "bodies add up to 171000 kg"),
    (
        LATTICE, 'first = { body = "house", point', 'first = { body = "boom", point',
        "first body must be before",
    ),
    (LATTICE, '"house"\nsecond = "boom"', '"boom"\nsecond = "house"', "nothing carries its first"),
    (A_FRAME, "[[closing_joints]]", "[[joints]]", r"'rod head' closes a loop.*\[\[closing"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "old", "new", "says"), BAD)
def test_a_bad_file_names_the_item(tmp_path: Path, text: str, old: str, new: str, says: str) -> None:
    assert text.count(old) == 1
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(FileFormatError, match=f"mine.toml.*{says}"):
        load_crane(path)


def test_what_a_crane_of_joints_cannot_do_is_told(lattice: JointedCrane, a_frame: JointedCrane) -> None:
    size, scene = (2.0, 2.0, 2.0), Scene(name="x")
    framed, roped, moved = fixed(a_frame, Payload(size=size)), fixed(lattice, boom=1.0), fixed(lattice)
    moved.remove("boom hinge.angle")
    moved.add_driver(joint="boom hinge", curve=seacrane.Curve.table([0, 9], [0, 0.1]))
    wide = JointedCrane(parse(A_FRAME.replace("range_m = [-1.6, 2.6]", "range_m = [-1.6, 9.0]")))
    limits = {"cylinder force tilt": 500.0}
    for call, words in (
        (lambda: fixed(lattice, boom=1.5), "boom is 1.5 rad, outside its range"),
        (lambda: fixed(lattice, bom=0.5), "no coordinate 'bom'; it has 'slew', 'boom'"),
        (lambda: scene.add_crane(lattice, base="ground", slew=0.5), "give coordinates"),
        (lambda: scene.add_crane(base="ground", coordinates={"slew": 0.5}), "slew, s1, s2"),
        (lambda: wide.tip(coordinates={"tilt": 8.5}), "its loops stay open by"),
        (lambda: seacrane.load_chart(framed, radii=[5.0], limits=limits), "crane '' has no slew drive"),
        (lambda: roped.add_luffing_rope(luff="jib"), "luff is 'jib'"),
        (moved.add_luffing_rope, "'boom hinge.angle' leads its hinge"),
    ):
        with pytest.raises(SceneError, match=words):
            call()
