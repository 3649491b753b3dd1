"""Cranes from URDF files: against Pinocchio's own reader, by hand, and what a bad file says."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, simulate
from seacrane.crane import JointedCrane, load_crane
from seacrane.crane.load_crane import SHIPPED
from seacrane.errors import FileFormatError
from seacrane.warnings import UrdfWarning

URDF = (SHIPPED / "service_arm_5t.urdf").read_text(encoding="utf-8")
BESIDE = (SHIPPED / "service_arm_5t.toml").read_text(encoding="utf-8")
RECORDED = Path(__file__).parents[2] / "benchmarks" / "peers" / "references" / "service_arm.json"
REFERENCE = json.loads(RECORDED.read_text(encoding="utf-8"))


def arm() -> JointedCrane:
    crane = load_crane("service_arm_5t")
    assert isinstance(crane, JointedCrane)
    return crane


def opened(crane: JointedCrane) -> JointedCrane:
    """Without its loop, every joint a coordinate."""
    kinds = {joint.name: joint.kind for joint in crane.data.joints}
    hinges = {name: name for name, kind in kinds.items() if kind == "revolute" and name != "slew"}
    slides = {name: name for name, kind in kinds.items() if kind == "prismatic"}
    joints = tuple(replace(joint, range=None) for joint in crane.data.joints)
    return JointedCrane(replace(crane.data, joints=joints, closing_joints=(), luffs=hinges, cylinders=slides))


@pytest.mark.parametrize("state", REFERENCE["states"])
@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
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
    assert [body.name for body in crane.data.bodies] == [
        "pedestal", "column", "jib", "stinger", "trunnion", "barrel", "rod",
    ]  # fmt: skip
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
        tip = crane.tip(coordinates={"jib": stroke})
        assert np.allclose(tip, (0.3 + 6.5 * math.cos(angle), 0.0, 3.8 + 6.5 * math.sin(angle)), atol=1e-9)


def written(folder: Path, urdf: str = URDF, beside: str = BESIDE) -> Path:
    (folder / "service_arm_5t.urdf").write_text(urdf, encoding="utf-8")
    path = folder / "arm.toml"
    path.write_text(beside, encoding="utf-8")
    return path


def test_inertia_is_turned_by_the_frames_of_link_and_inertial(tmp_path: Path) -> None:
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


def test_a_mesh_in_millimetres_is_refused_by_name(tmp_path: Path) -> None:
    stl = "solid x\n" + "".join(
        f"facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex {a} 200 0\nvertex {a} 0 300\nendloop\n"
        "endfacet\n"
        for a in (100, 600)
    )
    (tmp_path / "jib.stl").write_text(stl + "endsolid x\n", encoding="utf-8")
    shape = '<cylinder radius="0.25" length="6"/>'
    path = written(tmp_path, URDF.replace(shape, '<mesh filename="package://jib.stl"/>'))
    with pytest.raises(
        SceneError, match=r"mesh 'jib': spans 600 m, and the joints of its crane .* in mm: give"
    ):
        Scene(name="x").add_crane(load_crane(path), base="ground")
    scaled = '<mesh filename="jib.stl" scale="0.001 0.001 0.001"/>'
    scene = Scene(name="y")
    scene.add_crane(load_crane(written(tmp_path, URDF.replace(shape, scaled))), base="ground")
    assert np.ptp(scene.meshes["jib"].vertices, axis=0).max() == pytest.approx(0.6)


SLEWING = '<axis xyz="0 0 1"/>\n  </joint>\n  <link name="jib">'
SLIDING = '    <axis xyz="1 0 0"/>\n    <limit lower="0" upper="3"'
TELESCOPE = 'type="prismatic">\n    <parent link="jib"/>'
KINDS = "seacrane reads revolute, continuous, prismatic, fixed"
LOOP = '<joint name="rod_head" type="continuous"><parent link="rod"/><child link="jib"/></joint></robot>'
BAD = [
    ('<parent link="jib"/>', '<parent link="jibb"/>', "'telescope' names link 'jibb'; there are deck"),
    (TELESCOPE, TELESCOPE.replace("prismatic", "floating"), f"joint 'telescope' is 'floating'; {KINDS}"),
    ('<mass value="1400"/>', '<mass value="-1400"/>', "'jib' has mass -1400 kg; give one above zero"),
    ('<mass value="1400"/>', "", "link 'jib' has no value; give it"),
    (SLEWING, SLEWING.replace("0 0 1", "0 0 0"), "joint 'slew' has an axis of zeros"),
    ('lower="-0.2" upper="1.2"', 'lower="1.2" upper="-0.2"', "'jib_hinge' has limits 1.2 to -0.2"),
    ('xyz="4.5 0 0"', 'xyz="4.5 0"', "<origin> of telescope: xyz is '4.5 0'; write three numbers"),
    ('xyz="4.5 0 0"', 'xyz="4.5 nan 0"', "is 'nan'; write a finite number"),
    ("<robot name", "<mujoco name", "not valid XML"),
    ('<?xml version="1.0"?>', '<!DOCTYPE x [<!ENTITY a "b">]>', "has a document type of its own"),
    (SLIDING, '    <mimic joint="slew"/>\n' + SLIDING, "joint 'telescope' mimics another"),
    ('<cylinder radius="0.25" length="6"/>', "<capsule/>", "visual 'jib' is a <capsule>"),
    ('<inertia ixx="4221.88"', '<inertia ixx="42218.8"', "none above the sum of the others"),
    ("</robot>", LOOP, "'jib' is carried by joints 'jib_hinge' and 'rod_head': a loop"),
]


@pytest.mark.parametrize(("old", "new", "says"), BAD)
def test_a_bad_urdf_names_the_item(tmp_path: Path, old: str, new: str, says: str) -> None:
    assert old in URDF
    with pytest.raises(FileFormatError, match=r"service_arm_5t\.urdf") as caught:
        load_crane(written(tmp_path, URDF.replace(old, new, 1)))
    assert says in str(caught.value)


def test_what_is_not_taken_over_or_missing_is_told(tmp_path: Path) -> None:
    rubbing = URDF.replace('<axis xyz="1 0 0"/>', '<axis xyz="1 0 0"/><dynamics damping="50"/>', 1)
    dae = URDF.replace('<cylinder radius="0.25" length="6"/>', '<mesh filename="jib.dae"/>')
    for text, words in ((rubbing, "'telescope' has damping or friction"), (dae, "'jib.dae', .* not drawn")):
        with pytest.warns(UrdfWarning, match=words):
            load_crane(written(tmp_path, text))
    (tmp_path / "service_arm_5t.urdf").unlink()
    with pytest.raises(FileFormatError, match=r"URDF file .*service_arm_5t.urdf cannot be read"):
        load_crane(tmp_path / "arm.toml")
