"""Cranes of bodies and joints, from data files and URDF: statics by hand, Pinocchio, what a bad file says."""

from __future__ import annotations

import json
import math
import re
from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest

import seacrane
from seacrane import Curve, Scene, SceneError, simulate
from seacrane.crane import Crane, Payload, load_crane
from seacrane.crane.load_crane import SHIPPED, parse_crane
from seacrane.errors import FileFormatError
from seacrane.inputs.frames import rotation_matrix
from seacrane.scene.file import scene_digest
from seacrane.warnings import UrdfWarning

G = 9.80665
LATTICE = (SHIPPED / "lattice_boom_100t.toml").read_text(encoding="utf-8")
A_FRAME = (SHIPPED / "a_frame_40t.toml").read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def lattice() -> Crane:
    return load_crane("lattice_boom_100t")


def fixed(crane: Crane, payload: Payload | None = None, **coordinates: float) -> Scene:
    scene = Scene(name="fixed base")
    scene.add_crane(
        crane, base="ground", foot=(0, 0, 0), coordinates=coordinates, payload=payload, held=True,
        damping=False,
    )  # fmt: skip
    return scene


def test_tip_of_the_lattice_boom_in_closed_form(lattice: Crane) -> None:
    for boom, slew in ((0.0, 0.0), (0.6, -0.4), (1.3, 2.0)):
        out, up = 2.0 + 48.0 * math.cos(boom), 15.0 + 48.0 * math.sin(boom)
        expected = (-out * math.cos(slew), -out * math.sin(slew), up)
        assert np.allclose(lattice.tip(slew=slew, boom=boom), expected, atol=1e-12)


@pytest.mark.parametrize(("degrees", "load"), [(5.0, 5e3), (60.0, 80e3)])
def test_luffing_rope_force_by_moments_about_the_hinge(lattice: Crane, degrees: float, load: float) -> None:
    """Boom and load turn about the hinge; twelve falls pull at the boom's head with their lever arm."""
    scene = fixed(lattice, Payload(mass=load, size=(3.0, 3.0, 3.0)), boom=math.radians(degrees))
    told = seacrane.statics(scene, coordinates={"boom": 0.0})["rope tension boom"]
    angle = math.radians(degrees)
    along, up = np.array([-math.cos(angle), math.sin(angle)]), np.array([math.sin(angle), math.cos(angle)])
    boom = next(body for body in lattice.data.bodies if body.name == "boom")
    x, _, z = boom.properties.center_of_mass
    center = -x * along + z * up
    head, mast = 48.0 * along, np.array([8.0, 13.0])
    moment = G * (boom.properties.mass * -center[0] + load * -head[0])
    pull = (mast - head) / np.linalg.norm(mast - head)
    arm = abs(head[0] * pull[1] - head[1] * pull[0])
    assert float(told) == pytest.approx(moment / arm / 12.0, rel=1e-9)


def test_an_elastic_luffing_rope_takes_the_place_of_the_driver(lattice: Crane) -> None:
    scene = fixed(lattice, Payload(mass=50e3, size=(3.0, 3.0, 3.0)), boom=1.0)
    by_moment = float(seacrane.statics(scene, coordinates={"boom": 0.0})["rope tension boom"])
    rope = scene.add_winch("luffing rope")
    assert list(scene.drivers) == ["slew.angle"]
    assert len(rope.bodies) == 13
    for formulation in ("recursive", "redundant"):
        result = simulate(scene, t_end=3.0, formulation=formulation)
        tension = result["line_tension"][:, 0]
        assert np.allclose(tension, by_moment, rtol=1e-5)
        assert np.ptp(result["position"][:, -1, 2]) < 1e-5
    hauled = fixed(lattice, boom=0.5)
    hauled.add_point(name="head", body="boom", point=(-48.0, 0.0, 0.0))
    hauled.add_winch(
        "luffing rope", rate=-0.3
    )  # blocks come nearer by what is wound over the falls, stretch aside
    head = simulate(hauled, t_end=10.0, channels=["point_position"])["point_position"][:, 0]
    shrunk = np.ptp(np.linalg.norm(head - [6.0, 0.0, 28.0], axis=1))
    assert shrunk == pytest.approx(3.0 / 12.0, rel=5e-3) and head[-1, 2] > head[0, 2]
    posed = seacrane.statics(scene, coordinates={"boom": 0.0})
    assert float(posed["rope tension boom"]) == pytest.approx(by_moment, rel=1e-9)


def test_a_frame_cylinder_force_by_virtual_work() -> None:
    """F ds = dV of all weights, by central differences of the crane's own kinematics."""
    a_frame, payload = load_crane("a_frame_40t"), Payload(mass=20e3, size=(2.0, 2.0, 2.0), link_length=3.0)

    def potential(stroke: float) -> float:
        parts = a_frame.parts(tilt=stroke)
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


def test_statics_find_radii_by_luffing_and_a_heavier_boom(lattice: Crane) -> None:
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
    (LATTICE, "range_deg = [0.0", "range_dge = [0.0", r"unknown key joints\[1\] \(boom hinge\).range_dge"),
    (LATTICE, "total_mass = 171000.0", "total_mass = 171.0", "bodies add up to 171000 kg"),
    (LATTICE, "total_mass =", "total_mass_t = 171\ntotal_mass =", "total_mass_t and total_mass; write one"),
    (LATTICE, "total_mass =", "total_mass_kN =", "total_mass is missing, and total_mass_kN is in no"),
    (LATTICE, "range_deg = [0.0", "range_m = [0.0", "range_m is of a revolute joint; write range_rad"),
    (A_FRAME, "range_m = [-1.6", "range_deg = [-1.6", "range_deg is of a prismatic joint; write range_m"),
    (LATTICE, "range_deg = [0.0", "range_m = [0, 1]\nrange_deg = [0.0", "range_m and range_deg; write one"),
    (LATTICE, '"house"\nsecond = "boom"', '"boom"\nsecond = "house"', "nothing carries its first"),
    (A_FRAME, "[[closing_joints]]", "[[joints]]", r"'rod head' closes a loop.*\[\[closing"),
]  # fmt: skip


def in_units(text: str) -> str:
    """The same file with masses in t, lengths in mm and stiffness in kN."""
    lengths = "outer_diameter|inner_diameter|width|depth|wall|start|end|point"
    for keys, unit, size in (("total_mass|mass", "t", "1e3"), (lengths, "mm", "1e-3"), ("EA", "kN", "1e3")):

        def typed(found: re.Match[str], unit: str = unit, size: Decimal = Decimal(size)) -> str:
            numbers = re.sub(r"-?\d[\d.e+]*", lambda one: str(float(Decimal(one[0]) / size)), found[2])
            return f"{found[1]}_{unit} = {numbers}"

        text = re.sub(rf"^({keys}) = ([^#\n]*)", typed, text, flags=re.MULTILINE)
    return text


@pytest.mark.parametrize("text", [LATTICE, A_FRAME])
def test_a_file_in_an_engineers_units_is_the_same_crane(text: str) -> None:
    other = in_units(text)
    assert not re.search(r"^(mass|point|end) =", other, re.MULTILINE)
    assert scene_digest(fixed(parse_crane(other))) == scene_digest(fixed(parse_crane(text)))


@pytest.mark.parametrize(("text", "old", "new", "says"), BAD)
def test_a_bad_file_names_the_item(tmp_path: Path, text: str, old: str, new: str, says: str) -> None:
    assert text.count(old) == 1
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(old, new), encoding="utf-8")
    with pytest.raises(FileFormatError, match=f"mine.toml.*{says}"):
        load_crane(path)


def test_what_a_crane_of_joints_cannot_do_is_told(lattice: Crane) -> None:
    scene, moved = Scene(name="x"), fixed(lattice)
    moved.remove("boom hinge.angle")
    moved.add_driver(joint="boom hinge", curve=seacrane.Curve.table([0, 9], [0, 0.1]))
    wide = parse_crane(A_FRAME.replace("range_m = [-1.6, 2.6]", "range_m = [-1.6, 9.0]"))
    for call, words in (
        (lambda: fixed(lattice, boom=1.5), "boom is 1.5 rad, outside its range"),
        (lambda: fixed(lattice, bom=0.5), "no coordinate 'bom'; it has 'slew', 'boom'"),
        (lambda: scene.add_crane(lattice, s1=0.5), "no coordinate 's1'"),
        (lambda: scene.add_crane(lattice, slew=0.5, coordinates={"slew": 0.5}), "give it once"),
        (lambda: scene.add_crane(coordinates={"s1": 0.5, "main": 0.5}), "under two names"),
        (lambda: wide.tip(tilt=8.5), "its loops stay open by"),
        (lambda: moved.add_winch("luffing rope"), "'boom hinge.angle' leads its hinge"),
    ):
        with pytest.raises(SceneError, match=words):
            call()


URDF = (SHIPPED / "service_arm_5t.urdf").read_text(encoding="utf-8")
BESIDE = (SHIPPED / "service_arm_5t.toml").read_text(encoding="utf-8")
RECORDED = Path(__file__).parents[2] / "benchmarks" / "peers" / "references" / "service_arm.json"
REFERENCE = json.loads(RECORDED.read_text(encoding="utf-8"))


def arm() -> Crane:
    return load_crane("service_arm_5t")


def opened(crane: Crane) -> Crane:
    """Without its loop, every joint a coordinate."""
    kinds = {joint.name: joint.kind for joint in crane.data.tree.values()}
    hinges = {name: name for name, kind in kinds.items() if kind == "revolute" and name != "slew"}
    slides = {name: name for name, kind in kinds.items() if kind == "prismatic"}
    joints = tuple(replace(joint, range=None) for joint in crane.data.tree.values())
    return Crane(replace(crane.data, joints=joints, luffs=hinges, cylinders=slides))


@pytest.mark.parametrize("state", REFERENCE["states"])
def test_accelerations_are_those_of_pinocchio(state: dict[str, dict[str, float]], formulation: str) -> None:
    """Drivers that lead all joints with its rates and accelerations have nothing to do."""
    crane = opened(arm())
    scene = Scene(name="arm")
    scene.add_crane(crane, base="ground", foot=(0, 0, 0), coordinates=state["positions"])
    for name, rate in state["rates"].items():
        motion = [0.0, rate, 0.5 * state["accelerations"][name], 0.0, 0.0, 0.0]
        scene.add_driver(joint=name, curve=Curve.pieces(starts=[0.0], coefficients=[motion]))
    result = simulate(scene, t_end=1e-3, dt_out=1e-3, formulation=formulation)
    still = Scene(name="still")
    still.add_crane(crane, base="ground", foot=(0, 0, 0), coordinates=state["positions"], held=True)
    weight = np.abs(simulate(still, t_end=1e-3, formulation=formulation)["driver_force"][0])
    assert np.abs(result["driver_force"][0]).max() < 1e-9 * weight.max()


def test_links_without_mass_are_frames_of_what_they_are_fixed_to() -> None:
    crane = arm()
    assert crane.data.root == "deck"
    assert " ".join(b.name for b in crane.data.bodies) == "pedestal column jib stinger trunnion barrel rod"
    assert crane.data.tip[0] == "stinger"
    assert np.allclose(crane.tip(), (0.3 + 4.5 + 2.0, 0.0, 3.8), atol=1e-12)
    assert crane.mass == pytest.approx(5475.0)


def test_the_cylinder_raises_the_jib_by_the_law_of_cosines() -> None:
    crane = arm()
    foot, head = np.array([0.6 - 0.3, 0.2 - 1.8]), np.array([2.0, -0.35])
    a, b = np.linalg.norm(foot), np.linalg.norm(head)
    for stroke in (-0.2, 0.0, 0.5):
        length = float(np.linalg.norm(head - foot)) + stroke
        opening = math.acos((a**2 + b**2 - length**2) / (2.0 * a * b))
        angle = opening + math.atan2(foot[1], foot[0]) - math.atan2(head[1], head[0])
        tip = crane.tip(jib=stroke)
        assert np.allclose(tip, (0.3 + 6.5 * math.cos(angle), 0.0, 3.8 + 6.5 * math.sin(angle)), atol=1e-9)


def written(folder: Path, urdf: str = URDF, beside: str = BESIDE) -> Path:
    (folder / "service_arm_5t.urdf").write_text(urdf, encoding="utf-8")
    path = folder / "arm.toml"
    path.write_text(beside, encoding="utf-8")
    return path


def test_inertia_is_turned_by_the_frames_of_link_and_inertial() -> None:
    """A rod along x of the jib, which is itself turned about y: I along the rod stays, by hand."""
    crane = arm()
    barrel = crane.mass_properties["barrel"]
    pitch = math.atan2(1.25 + 0.35 - 0.35, 1.7)
    along = np.array([math.cos(pitch), 0.0, math.sin(pitch)])
    assert along @ barrel.inertia @ along == pytest.approx(0.5 * 160.0 * 0.11**2, rel=1e-5)
    assert np.trace(barrel.inertia) == pytest.approx(
        0.5 * 160 * 0.11**2 + 160 / 6 * (3 * 0.11**2 + 1.4**2), rel=1e-5
    )
    assert np.allclose(barrel.center_of_mass, 0.7 * along, atol=1e-9)


def test_a_mesh_takes_its_scale(tmp_path: Path) -> None:
    corners = "".join(f"facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex {a} 200 0\nvertex {a} 0 300\n"
                      "endloop\nendfacet\n" for a in (100, 600))  # fmt: skip
    (tmp_path / "jib.stl").write_text(f"solid x\n{corners}endsolid x\n", encoding="utf-8")
    scaled = '<mesh filename="jib.stl" scale="0.001 0.001 0.001"/>'
    path = written(tmp_path, URDF.replace('<cylinder radius="0.25" length="6"/>', scaled))
    scene = Scene(name="y")
    scene.add_crane(load_crane(path), base="ground")
    assert np.ptp(scene.meshes["jib"].vertices, axis=0).max() == pytest.approx(0.6)


SLIDING = '    <axis xyz="1 0 0"/>\n    <limit lower="0" upper="3"'
TELESCOPE = 'type="prismatic">\n    <parent link="jib"/>'
LOOP = '<joint name="rod_head" type="continuous"><parent link="rod"/><child link="jib"/></joint></robot>'
BAD_URDF = [
    (TELESCOPE, TELESCOPE.replace("prismatic", "floating"), "joint 'telescope' is 'floating'"),
    ('xyz="4.5 0 0"', 'xyz="4.5 nan 0"', "is 'nan'; write a finite number"),
    ('<?xml version="1.0"?>', '<!DOCTYPE x [<!ENTITY a "b">]>', "has a document type of its own"),
    (SLIDING, '    <mimic joint="slew"/>\n' + SLIDING, "joint 'telescope' mimics another"),
    ('<inertia ixx="4221.88"', '<inertia ixx="42218.8"', "none above the sum of the others"),
    ("</robot>", LOOP, "'jib' is carried by joints 'jib_hinge' and 'rod_head': a loop"),
]


@pytest.mark.parametrize(("old", "new", "says"), BAD_URDF)
def test_a_bad_urdf_names_the_item(tmp_path: Path, old: str, new: str, says: str) -> None:
    assert old in URDF
    with pytest.raises(FileFormatError, match=r"service_arm_5t\.urdf") as caught:
        load_crane(written(tmp_path, URDF.replace(old, new, 1)))
    assert says in str(caught.value)


def test_what_is_not_taken_over_is_told(tmp_path: Path) -> None:
    rubbing = URDF.replace('<axis xyz="1 0 0"/>', '<axis xyz="1 0 0"/><dynamics damping="50"/>', 1)
    with pytest.warns(UrdfWarning, match="'telescope' has damping or friction"):
        load_crane(written(tmp_path, rubbing))
