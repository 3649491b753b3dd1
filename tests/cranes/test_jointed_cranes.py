"""Cranes of bodies and joints: lattice boom, A-frame, their statics by hand and what a bad file says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import seacrane
from seacrane import Scene, SceneError, simulate
from seacrane.crane import JointedCrane, KnuckleBoomCrane, Payload, load_crane, shipped_cranes
from seacrane.crane.load_crane import SHIPPED
from seacrane.errors import FileFormatError
from seacrane.inputs.frames import rotation_matrix

G = 9.80665
LATTICE = (SHIPPED / "lattice_boom_100t.toml").read_text(encoding="utf-8")
A_FRAME = (SHIPPED / "a_frame_40t.toml").read_text(encoding="utf-8")


def jointed(name: str) -> JointedCrane:
    crane = load_crane(name)
    assert isinstance(crane, JointedCrane)
    return crane


@pytest.fixture(scope="module")
def lattice() -> JointedCrane:
    return jointed("lattice_boom_100t")


@pytest.fixture(scope="module")
def a_frame() -> JointedCrane:
    return jointed("a_frame_40t")


def fixed(crane: JointedCrane, payload: Payload | None = None, **coordinates: float) -> Scene:
    scene = Scene(name="fixed base")
    scene.add_crane(
        crane,
        base="ground",
        foot=(0, 0, 0),
        coordinates=coordinates,
        payload=payload,
        held=True,
        damping=False,
    )
    return scene


def test_load_crane_reads_every_kind_that_comes_with_seacrane() -> None:
    cranes = {name: load_crane(name) for name in shipped_cranes()}
    assert {type(crane) for crane in cranes.values()} == {KnuckleBoomCrane, JointedCrane}
    assert cranes["lattice_boom_100t"].mass == pytest.approx(171e3)


def test_tip_of_the_lattice_boom_in_closed_form(lattice: JointedCrane) -> None:
    for boom, slew in ((0.0, 0.0), (0.6, -0.4), (1.3, 2.0)):
        out, up = 2.0 + 48.0 * math.cos(boom), 15.0 + 48.0 * math.sin(boom)
        expected = (-out * math.cos(slew), -out * math.sin(slew), up)
        assert np.allclose(lattice.tip(coordinates={"slew": slew, "boom": boom}), expected, atol=1e-12)


@pytest.mark.parametrize("degrees", [5.0, 35.0, 60.0, 80.0])
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
    posed = seacrane.statics(scene, coordinates={"boom": 0.0})
    assert float(posed["rope tension boom"]) == pytest.approx(by_moment, rel=1e-9)


def test_hauling_the_luffing_rope_raises_the_boom_by_its_length(lattice: JointedCrane) -> None:
    """The distance of the blocks shrinks by what is wound over the falls, stretch aside."""
    scene = fixed(lattice, boom=0.5)
    scene.add_point(name="head", body="boom", point=(-48.0, 0.0, 0.0))
    scene.add_luffing_rope(rate=-0.3)
    result = simulate(scene, t_end=10.0, channels=["point_position", "line_tension"])
    mast, head = np.array([6.0, 0.0, 28.0]), result["point_position"][:, 0]
    shrunk = np.ptp(np.linalg.norm(head - mast, axis=1))
    assert shrunk == pytest.approx(3.0 / 12.0, rel=5e-3)
    assert head[-1, 2] > head[0, 2]


def test_a_frame_cylinder_force_by_virtual_work(a_frame: JointedCrane) -> None:
    """F ds = dV of all weights, by central differences of the crane's own kinematics."""
    payload = Payload(mass=20e3, size=(2.0, 2.0, 2.0), link_length=3.0)

    def potential(stroke: float) -> float:
        parts = a_frame.parts(foot=(0, 0, 0), coordinates={"tilt": stroke})
        height = sum(
            body.mass * (body.position + _turn(body.quaternion) @ body.center_of_mass)[2]
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


def _turn(quaternion: np.ndarray) -> np.ndarray:
    return rotation_matrix(quaternion)


@pytest.mark.parametrize("name", ["lattice_boom_100t", "a_frame_40t"])
def test_scenes_go_to_files_and_back(name: str, tmp_path: Path) -> None:
    scene = fixed(jointed(name), Payload(size=(2.0, 2.0, 2.0)))
    scene.save(tmp_path / "scene.json")
    again = Scene.load(tmp_path / "scene.json")
    assert again.roles == scene.roles
    assert again.ranges == scene.ranges


def test_both_are_drawn_by_their_members(lattice: JointedCrane) -> None:
    from seacrane.pictures.drawn_bodies import crane_shapes

    scene = fixed(lattice, boom=0.7)
    shapes = crane_shapes(scene, None)
    assert {name: len(parts) for name, parts in shapes.items()} == {"pedestal": 1, "house": 6, "boom": 44}


def test_a_load_chart_of_a_frame_that_does_not_slew_is_refused_by_name(a_frame: JointedCrane) -> None:
    scene = fixed(a_frame, Payload(size=(2.0, 2.0, 2.0)))
    with pytest.raises(SceneError, match=r"crane '' has no slew drive, from whose axis radii are counted"):
        seacrane.load_chart(scene, radii=[5.0], limits={"cylinder force tilt": 500.0})


def test_a_study_varies_the_boom_of_a_crane(lattice: JointedCrane) -> None:
    """A heavier boom takes more tension, by its weight's lever arm over that of the falls."""
    scene = fixed(lattice, Payload(mass=20e3, size=(2.0, 2.0, 2.0)), boom=1.0)
    masses = [20e3, 30e3]
    told = []
    for mass in masses:
        scene.replace("boom", mass=mass)
        told.append(float(seacrane.statics(scene, coordinates={"boom": 0.0})["luff moment boom"]))
    center = lattice.mass_properties["boom"].center_of_mass
    arm = math.hypot(center[0], center[2]) * math.cos(1.0 + math.atan2(center[2], -center[0]))
    assert told[1] - told[0] == pytest.approx(G * (masses[1] - masses[0]) * arm, rel=1e-6)
    study = seacrane.ensemble(
        scene, over={"bodies.boom.mass": masses}, keep={"moment": _largest_moment}, t_end=0.2, dt_out=0.1
    )
    moments = np.asarray(study.dataset["moment"])
    assert moments[1] - moments[0] == pytest.approx((told[1] - told[0]), rel=1e-6)


def _largest_moment(result: seacrane.Result) -> float:
    return float(np.abs(result.select("driver_force", driver="boom hinge.angle")).max())


def test_radius_is_found_by_luffing(lattice: JointedCrane) -> None:
    scene = fixed(lattice, Payload(size=(2.0, 2.0, 2.0)), boom=1.0)
    told = seacrane.statics(scene, radius=[20.0, 40.0], slew=[0.0, 0.3])
    assert np.allclose(told["tip radius"], [[20.0, 40.0]] * 2, atol=1e-6)
    assert told.pose_units == {"slew": "rad", "radius": "m"}


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ('kind = "jointed"', 'kind = "lattice"', 'kind is \'lattice\'; write "knuckle-boom", "jointed" or'),
        ('second = "boom"\npoint', 'second = "bom"\npoint', "its second body is 'bom'; there are pedestal"),
        ('kind = "revolute"\nfirst = "house"', 'kind = "gear"\nfirst = "house"', "kind is 'gear'; write one"),
        ("axis = [0.0, 1.0, 0.0]", "axis = [0.0, 0.0, 0.0]", "is all zero; write a direction"),
        ("range_deg = [0.0, 82.0]", "range_deg = [82.0, 0.0]", "write the lower end first"),
        (
            "range_deg = [0.0, 82.0]",
            "range_dge = [0.0, 82.0]",
            "unknown key joints[1] (boom hinge).range_dge",
        ),
        ('luffs = { boom = "boom hinge" }', 'luffs = { boom = "slw" }', "which is no revolute joint"),
        ('luff = "boom"', 'luff = "jib"', "holds luff 'jib'; the luffs are 'boom'"),
        ("falls = 12", "falls = 2.5", "write a whole number"),
        ("EA = 60.0e6", "EA = -1.0", "EA is -1; it must be greater than zero"),
        ("total_mass = 171000.0", "total_mass = 171.0", "the bodies add up to 171000 kg"),
        (
            'first = { body = "house", point',
            'first = { body = "boom", point',
            "its first body must be before",
        ),
        ('first = "house"\nsecond = "boom"', 'first = "boom"\nsecond = "house"', "nothing carries its first"),
    ],
)
def test_a_bad_file_names_the_item(tmp_path: Path, old: str, new: str, says: str) -> None:
    assert LATTICE.count(old) == 1
    path = tmp_path / "mine.toml"
    path.write_text(LATTICE.replace(old, new), encoding="utf-8")
    with pytest.raises(FileFormatError) as caught:
        load_crane(path)
    assert says in str(caught.value)
    assert "mine.toml" in str(caught.value)


def test_a_loop_in_the_tree_is_asked_to_be_a_closing_joint(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(A_FRAME.replace("[[closing_joints]]", "[[joints]]"), encoding="utf-8")
    with pytest.raises(FileFormatError, match=r"'rod head' closes a loop.*write it as one of \[\[closing"):
        load_crane(path)


def test_poses_out_of_range_and_labels_that_are_not_there(
    lattice: JointedCrane, a_frame: JointedCrane
) -> None:
    with pytest.raises(SceneError, match=r"boom is 1.5 rad, outside its range of 0 to 1.43117"):
        fixed(lattice, boom=1.5)
    with pytest.raises(SceneError, match="has no coordinate 'bom'; it has 'slew', 'boom'"):
        fixed(lattice, bom=0.5)
    scene = Scene(name="x")
    with pytest.raises(SceneError, match="slew are those of a knuckle boom; give coordinates"):
        scene.add_crane(lattice, base="ground", slew=0.5)
    with pytest.raises(SceneError, match="give a knuckle boom slew, s1, s2"):
        scene.add_crane(base="ground", coordinates={"slew": 0.5})
    wide = A_FRAME.replace("range_m = [-1.6, 2.6]", "range_m = [-1.6, 9.0]")
    from seacrane.crane.jointed_file import parse

    with pytest.raises(SceneError, match="its loops stay open by"):
        JointedCrane(parse(wide)).tip(coordinates={"tilt": 8.5})


def test_a_rope_cannot_push_and_a_moving_driver_stays(lattice: JointedCrane) -> None:
    scene = fixed(lattice, boom=1.0)
    with pytest.raises(SceneError, match="luff is 'jib'; the hinges with a rope are 'boom'"):
        scene.add_luffing_rope(luff="jib")
    del scene.drivers["boom hinge.angle"]
    scene.add_driver(
        joint="boom hinge", curve=seacrane.Curve.quintic(start_time=0, end_time=9, start=0, end=0.1)
    )
    with pytest.raises(
        SceneError, match=r"driver 'boom hinge.angle' leads its hinge; take the driver out first"
    ):
        scene.add_luffing_rope()


def test_a_lift_file_holds_any_crane(tmp_path: Path) -> None:
    (tmp_path / "crane.toml").write_text(LATTICE, encoding="utf-8")
    text = """
format = "seacrane lift"
version = 2

[scene]
name = "lattice"

[crane]
crane = "crane.toml"
base = "ground"
foot_m = [0.0, 0.0, 0.0]
held = true

[[crane.coordinates]]
name = "boom"
value_deg = 60.0

[crane.payload]
mass_kg = 20e3

[luffing_rope]
luff = "boom"
rate_m_per_s = 0.1

[run]
t_end_s = 0.5
"""
    (tmp_path / "lift.toml").write_text(text, encoding="utf-8")
    result = seacrane.Lift.load(tmp_path / "lift.toml").simulate()
    assert result["link_tension"][0] == pytest.approx(20e3 * G, rel=1e-2)
    assert result["line_length"][-1, 0] > result["line_length"][0, 0]
    (tmp_path / "wrong.toml").write_text(text.replace("value_deg = 60.0", "value_m = 1.0"), encoding="utf-8")
    with pytest.raises(FileFormatError, match="'boom' is of a revolute joint; give value_deg or value_rad"):
        seacrane.Lift.load(tmp_path / "wrong.toml").simulate()
