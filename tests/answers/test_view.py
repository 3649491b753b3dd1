"""`view`: the numbers of its pages are those of results and scenes."""

from __future__ import annotations

import base64
import gzip
import json
import pickle
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hydraulic_scenes import BORE, RETRACTED, ROD, START, raised
from view_scenes import HTML_NAME, alone, angle_between, case2, pair

from seacrane import Scene, SceneError, cases, simulate, view
from seacrane.crane import load_crane
from seacrane.hydro import shipped_database
from seacrane.hydro.hull.hull import VOLUME, shipped_hull
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.caption import sea_components
from seacrane.pictures.drawing import drawing_of
from seacrane.pictures.drawn_bodies import looks
from seacrane.pictures.pose_curves import LARGEST_ERROR, STEPS, motion_of
from seacrane.pictures.shapes import BoxShape, equivalent_box, schematic_size
from seacrane.pictures.wheels import wires_of
from seacrane.scene.file import scene_digest


class Page:
    """What a browser makes of a page: its elements, and the text of its scripts."""

    def __init__(self, html: str) -> None:
        found = re.findall(r"<script([^>]*)>(.*?)</script>", html, re.DOTALL)
        self.scripts = {re.sub(r'.*id="?(\w+).*', r"\1", told): text for told, text in found}
        self.elements = re.findall(
            r"<(\w+)", re.sub(r"(<script)[^>]*>.*?</script>", r"\1", html, flags=re.DOTALL)
        )

    @property
    def data(self) -> dict[str, Any]:
        """What the page's script reads."""
        return dict(json.loads(self.scripts["data"]))

    def series(self, told: dict[str, Any]) -> np.ndarray:
        """A series as packing.py describes it, written independently of it."""
        blob = gzip.decompress(base64.b64decode(self.scripts["blob"]))
        rows, frames = told["shape"]
        planes = np.frombuffer(blob, np.uint8, 4 * rows * frames, told["at"]).reshape(4, -1).astype(np.int64)
        folded = planes[0] + (planes[1] << 8) + (planes[2] << 16) + (planes[3] << 24)
        second = np.where(folded % 2, -(folded + 1) // 2, folded // 2).reshape(rows, frames)
        return np.cumsum(np.cumsum(second, axis=1), axis=1) * told["step"]


def test_a_pose_at_any_output_is_that_of_the_run() -> None:
    result, motion = case2(), view(case2()).motion
    position, quaternion = motion.at(result.time)
    distance = np.linalg.norm(position - result["position"], axis=-1).max()
    assert distance <= motion.error[0] + 1e-12 <= LARGEST_ERROR[0]
    assert angle_between(quaternion, result["quaternion"]) <= LARGEST_ERROR[1]
    assert motion.interval == pytest.approx(0.2) and motion.error[0] < 1e-3


def test_the_page_is_small_and_holds_the_poses_that_the_view_tells() -> None:
    shown = view(case2())
    page = Page(shown.html)
    told = page.data["motion"]
    for name, step in STEPS.items():
        expected = getattr(shown.motion, name)
        found = page.series(told[name]).T.reshape(expected.shape)
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-6 * step)
    assert [body["name"] for body in page.data["bodies"]] == list(case2().coords["body"])
    assert case2().scene is not None and scene_digest(case2().scene)[:12] in shown.html
    assert len(shown.html.encode()) < 1.5e6


def test_a_snatch_asks_for_more_frames_and_outputs_bound_them() -> None:
    """Between outputs of 0.05 s, a payload that stops within one needs the finer interval."""
    scene = Scene(name="bounce")
    scene.add_body("ball", mass=1, inertia=(0.1, 0.1, 0.1), position=(0, 0, -0.5), velocity=(0, 1, 3))
    scene.add_joint(kind="distance", name="wire", first="ground", second="ball", point=(0, 0, 0),
                    second_point=(0, 0, -0.5), length=1.0)  # fmt: skip
    scene.add_line(joint="wire", rung="rigid", restitution=0.5)
    coarse = motion_of(simulate(scene, 3.0, dt_out=0.05))
    assert coarse.interval == pytest.approx(0.1) and coarse.error[0] > 0.0
    motion = motion_of(simulate(cases.vessel(), 10.0, dt_out=0.5))
    assert (motion.interval, motion.end) == pytest.approx((0.5, 10.0))


def test_the_sea_is_that_of_the_scene() -> None:
    scene = cases.vessel(hs=3.0, seed=7)
    table = sea_components(scene)
    a, w, phase, kx, ky = table.T
    t, x, y = 123.4, -31.0, 17.0
    expected = scene.waves.components().elevation(t, x=x, y=y)
    assert np.sum(a * np.cos(w * t + phase - kx * x - ky * y)) == pytest.approx(float(expected), abs=1e-9)


def test_crane_members_are_those_of_the_data_file() -> None:
    found = looks(cases.case2())
    for body in load_crane().data.bodies:
        assert found[body.name].role == "crane"
        for shape, member in zip(found[body.name].shapes, body.members, strict=True):
            middle = 0.5 * np.add(member.start, member.end) - body.properties.center_of_mass
            centre = shape.centre if isinstance(shape, BoxShape) else shape.points.mean(axis=0)
            np.testing.assert_allclose(centre, middle, atol=1e-9)
    (box,) = found["payload"].shapes
    assert isinstance(box, BoxShape)
    np.testing.assert_allclose(box.size, (6.0, 6.0, 4.0))


def test_the_equivalent_box_of_a_box_is_that_box() -> None:
    size, mass = np.array([3.0, 2.0, 0.5]), 7.0
    inertia = np.diag(mass / 12.0 * (np.sum(size**2) - size**2))
    turn = rotation_matrix((0.9, 0.1, -0.2, 0.3))
    box = equivalent_box(mass, turn @ inertia @ turn.T)
    found = box.axes @ np.diag(box.size**2) @ box.axes.T
    np.testing.assert_allclose(found, turn @ np.diag(size**2) @ turn.T, atol=1e-9)
    np.testing.assert_allclose(np.linalg.det(box.axes), 1.0)


def test_the_shipped_vessel_has_the_shipped_hull_and_another_a_schematic_one() -> None:
    result = pair()
    found = looks(result.scene)
    assert "hull_115" in found["vessel"].note and "schematic" in found[HTML_NAME].note
    (true,), (made_up,) = found["vessel"].shapes, found[HTML_NAME].shapes
    np.testing.assert_allclose(np.ptp(true.vertices, axis=0)[:2], (115.0, 25.0), rtol=1e-3)
    np.testing.assert_allclose(np.ptp(made_up.vertices, axis=0)[:2], (115.0, 25.0), rtol=1e-2)
    length, breadth, draught = schematic_size(14e6, 14e6 * np.diag([0.36 * 25, 0.25 * 115, 0.25 * 115]) ** 2)
    assert (length, breadth) == pytest.approx((115.0, 25.0))
    assert 1025.0 * 0.7 * length * breadth * draught == pytest.approx(14e6)


def test_only_wires_go_slack() -> None:
    scene = cases.case2()
    assert wires_of(scene, list(scene.bodies))[0]["length"] == 0.0
    scene.add_line(joint="link", rung="rigid")
    scene.add_spring("tugger", first="vessel", second="payload", lengths=[0, 5, 9], forces=[0, 0, 1e5])
    link, tugger = wires_of(scene, list(scene.bodies))
    assert (link["kind"], link["length"]) == ("wire", 8.0)
    assert (tugger["kind"], tugger["length"]) == ("spring", 5.0)


def test_a_cylinder_between_two_points_has_a_barrel_and_a_rod() -> None:
    scene = raised(command=0.5)
    drawn = drawing_of(simulate(scene, 1.0, dt_out=0.25))
    rod, barrel = drawn.wires
    assert (rod["kind"], barrel["kind"], rod["element"]) == ("rod", "barrel", "ram")
    assert (rod["radius"], barrel["radius"]) == pytest.approx((0.5 * ROD, 0.5 * 1.15 * BORE))
    pose = drawn.motion.position[-1:], drawn.motion.quaternion[-1:]
    top = float(pose[0][0, 0, 2])
    assert [end[0, 2] for end in drawn.ends_of(rod, *pose)] == pytest.approx([0.0, top])
    assert [end[0, 2] for end in drawn.ends_of(barrel, *pose)] == pytest.approx([0.0, RETRACTED])
    assert top > RETRACTED + START


def test_forces_are_those_of_the_run() -> None:
    page = Page(view(case2()).html)
    arrows = {(arrow["group"], arrow["name"]): arrow for arrow in page.data["arrows"]}
    link = page.series(arrows["link", "link"]["force"])
    np.testing.assert_allclose(np.linalg.norm(link, axis=0), case2()["link_tension"][::2], rtol=1e-3)
    wave = page.series(arrows["wave", "vessel"]["force"])
    level = np.linalg.norm(case2()["wave_force"][::2, :3], axis=1)
    np.testing.assert_allclose(np.linalg.norm(wave, axis=0), level, atol=1e-3 * level.max())
    assert {group for group, _ in arrows} == {"link", "wave", "joint"}


def test_chosen_channels_are_drawn_in_their_units() -> None:
    choice = ["link_tension", "roll", "position[payload, z]", "stroke"]
    page = Page(view(case2(), channels=choice).html)
    tension, roll, height, stroke = page.data["strip"]
    assert [panel["unit"] for panel in (tension, roll, height, stroke)] == ["kN", "deg", "m", "m"]
    assert stroke["labels"] == ["main", "knuckle"]
    expected = np.degrees(case2().select("vessel_motion", motion="roll")[::2])
    np.testing.assert_allclose(page.series(roll["values"])[0], expected, atol=2e-3)
    expected = case2().select("position", body="payload", axis="z")[::2]
    np.testing.assert_allclose(page.series(height["values"])[0], expected, atol=1e-3 * np.ptp(expected))


def test_names_appear_as_text() -> None:
    """Names with markup neither end a script nor become elements, nor leave a notebook's frame."""
    shown = view(pair(), height=500)
    page = Page(shown.html)
    assert page.elements.count("script") == 3 and not {"b", "i"} & set(page.elements)
    assert HTML_NAME in {body["name"] for body in page.data["bodies"]}
    assert shown._repr_html_().count("<") == 2


def test_a_scene_alone_stands_at_its_assembled_start() -> None:
    """And a result keeps the scene as it was run."""
    scene = cases.case2()
    shown = view(scene)
    start = simulate(scene, 0.1, dt_out=0.1)
    position, quaternion = shown.motion.at(np.zeros(1))
    np.testing.assert_allclose(position[0], start["position"][0], atol=1e-9)
    assert angle_between(quaternion[0], start["quaternion"][0]) < 1e-7
    scene.add_body(name="later", mass=1.0, inertia=(1.0, 1.0, 1.0))
    assert start.scene is not None and "later" not in start.scene.bodies


def test_a_copy_of_a_result_needs_its_scene() -> None:
    result = alone()
    twin = pickle.loads(pickle.dumps(result))
    assert twin.scene is None
    assert view(twin, scene=cases.vessel(hs=4.0, tp=10.0)).html == view(result).html
    for given, words in (({}, "scene=scene"), ({"scene": cases.case2()}, "not the one")):
        with pytest.raises(SceneError, match=words):
            view(twin, **given)


def test_an_interrupted_run_is_shown_as_far_as_it_is_finite() -> None:
    whole = alone()
    position = whole["position"].copy()
    position[150:] = np.nan
    shown = view(replace(whole, channels={**whole.channels, "position": position}, interrupted=True))
    assert shown.motion.end == pytest.approx(whole.time[149])
    assert "interrupted" in shown.html


def test_the_shipped_hull_is_that_of_the_shipped_database() -> None:
    """By its mass and waterplane; and its lines enclose the volume that they were scaled to."""
    database, statics = shipped_database(), shipped_hull().hydrostatics
    heave = database.restoring[2, 2] / (database.rho * database.g)
    assert heave == pytest.approx(statics.waterplane_area, rel=1e-12)
    assert database.mass_matrix[0, 0] == pytest.approx(database.rho * statics.volume, rel=1e-12)
    assert statics.volume == pytest.approx(VOLUME, rel=1e-11)
    assert statics.center_of_buoyancy[0] == pytest.approx(0.0, abs=1e-9)
