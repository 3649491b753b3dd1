"""The shipped crane against the paper's list, and what a bad data file says."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from seacrane.crane import FOOT, KnuckleBoomCrane, Payload, Tube
from seacrane.crane.data_file import DEFAULT_PATH, load, parse
from seacrane.errors import FileFormatError

TEXT = DEFAULT_PATH.read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def crane() -> KnuckleBoomCrane:
    return KnuckleBoomCrane.load()


def body_mass(crane: KnuckleBoomCrane, name: str) -> float:
    return crane.mass_properties[name].mass


def test_bodies_sum_to_390_t(crane: KnuckleBoomCrane) -> None:
    assert len(crane.mass_properties) == 8
    assert crane.mass == 390.0e3
    assert body_mass(crane, "tower") == pytest.approx(100e3, rel=0.02)
    assert body_mass(crane, "king") == pytest.approx(115e3, rel=0.02)
    assert 75e3 <= body_mass(crane, "main_jib") <= 80e3
    assert 45e3 <= body_mass(crane, "knuckle_jib") <= 50e3


@pytest.mark.parametrize("cylinder", ["main", "knuckle"])
def test_cylinders_weigh_20_to_26_t_split_60_to_40(crane: KnuckleBoomCrane, cylinder: str) -> None:
    barrel, rod = body_mass(crane, f"{cylinder}_barrel"), body_mass(crane, f"{cylinder}_rod")
    assert 20e3 <= barrel + rod <= 26e3
    assert barrel / (barrel + rod) == pytest.approx(0.6, abs=1e-12)


def test_lengths_and_heights(crane: KnuckleBoomCrane) -> None:
    stowed = crane.geometry.points(slew=0.0, s1=0.0, s2=0.0)
    assert 22.0 <= np.linalg.norm(stowed["F"] - stowed["C"]) <= 24.0
    assert 13.0 <= np.linalg.norm(stowed["tip"] - stowed["F"]) <= 16.0
    assert 15.0 <= stowed["C"][2] <= 18.0
    assert stowed["tip"][2] >= 14.0
    assert stowed["tip"][0] < 0.0  # the jib points aft
    assert crane.geometry.largest_strokes == (5.0, 5.0)


def test_stowed_payload_hangs_clear_above_the_deck(crane: KnuckleBoomCrane) -> None:
    payload = Payload()
    body = crane.payload_body(payload)
    assert body.position[2] - payload.size[2] / 2.0 > FOOT[2] + 2.0


def test_lever_arms_stay_above_limit_over_all_strokes(crane: KnuckleBoomCrane) -> None:
    levers = np.array([crane.geometry.lever_arms(s1=s, s2=s) for s in np.linspace(0.0, 5.0, 2001)])
    assert levers.min() >= 1.2
    # No dead centre: the jib angles rise strictly with the strokes.
    angles = np.array([crane.geometry.jib_angles(s1=s, s2=s) for s in np.linspace(0.0, 5.0, 2001)])
    assert np.all(np.diff(angles, axis=0) > 0.0)


def test_outreach_at_two_metres(crane: KnuckleBoomCrane) -> None:
    assert 25.0 <= crane.geometry.outreach(s1=2.0, s2=2.0) <= 35.0
    tip = crane.geometry.tip(slew=0.7, s1=2.0, s2=2.0)
    assert math.hypot(tip[0], tip[1]) == pytest.approx(crane.geometry.outreach(s1=2.0, s2=2.0), abs=1e-12)


@pytest.mark.parametrize("s1", np.linspace(0.0, 5.0, 6))
@pytest.mark.parametrize("s2", np.linspace(0.0, 5.0, 6))
def test_payload_clears_the_side_when_slewed_out(crane: KnuckleBoomCrane, s1: float, s2: float) -> None:
    body = crane.payload_body(Payload(), slew=-math.pi / 2.0, s1=s1, s2=s2)
    assert body.position[1] - 3.0 > 12.5 + 1.0  # half the payload's width, half the beam, a margin


def test_cylinders_telescope_over_the_whole_stroke(crane: KnuckleBoomCrane) -> None:
    for cylinder in (crane.data.main_cylinder, crane.data.knuckle_cylinder):
        barrel = max(member.end[0] for member in cylinder.barrel)
        rod = -min(member.start[0] for member in cylinder.rod)
        assert barrel + rod > cylinder.retracted_length + cylinder.stroke  # still guided when extended
        assert max(barrel, rod) < cylinder.retracted_length  # fits when retracted
        bore = min(m.inner_diameter for m in cylinder.barrel if isinstance(m, Tube))
        assert max(m.outer_diameter for m in cylinder.rod if isinstance(m, Tube)) < bore


def edit(old: str, new: str) -> str:
    assert old in TEXT
    return TEXT.replace(old, new, 1)


BAD = {
    "missing key": ("height = 6.5", "", r"tower\.height is missing; add it"),
    "missing table": ("[knuckle_jib]\nlength", "[spare_jib]\nlength", r"knuckle_jib"),
    "misspelt key": ("height = 6.5", "height = 6.5\nhieght = 1.0", r"unknown key tower\.hieght"),
    "negative mass": ("mass = 80.0e3", "mass = -80.0e3", r"tower\.members\[0\] \(column\)\.mass is -80000"),
    "zero mass": ("mass = 80.0e3", "mass = 0.0", r"\(column\)\.mass is 0; it must be greater than zero"),
    "not a number": ("mass = 80.0e3", "mass = nan", r"\(column\)\.mass is nan; write a finite number"),
    "text for number": ("stroke = 5.0", 'stroke = "5 m"', r"main_cylinder\.stroke is '5 m'; write a finite"),
    "wrong total": ("mass = 80.0e3", "mass = 81.0e3", r"add up to 391000 kg, total_mass is 390000 kg"),
    "wrong schema": ("schema = 1", "schema = 7", r"schema is 7; this version reads schema 1"),
    "wrong shape": ('\nshape = "tube"', '\nshape = "cone"', r"shape is 'cone'; write \"tube\" or \"box\""),
    "point of three": ("main_jib_pivot = [1.0, 11.3]", "main_jib_pivot = [1.0, 0.0, 11.3]",
                       r"king\.main_jib_pivot .* write two numbers"),
    "thick wall": ("wall = 0.03", "wall = 1.0", r"main_jib\.members\[0\] \(girder\)\.wall is 1 m"),
    "tube inside out": ("inner_diameter = 4.4", "inner_diameter = 5.0", r"inner_diameter is 5 m, not below"),
    "no length": ("end = [0.0, 6.0]", "end = [0.0, 0.0]", r"\(column\) has length 0"),
    "unreachable stroke": ("stroke = 5.0", "stroke = 12.0",
                           r"main_cylinder cannot reach stroke 12 m: .* allow .* change retracted_length"),
    "unreachable start": ("retracted_length = 6.8", "retracted_length = 4.0",
                          r"knuckle_cylinder cannot reach stroke 0 m"),
    "dead centre": ("retracted_length = 6.8", "retracted_length = 7.3",
                    r"knuckle_cylinder has a lever arm of .* at stroke 5 m, near its dead centre"),
    "pinned at the pivot": ("main_cylinder_head = [7.3, -2.4]", "main_cylinder_head = [0.0, 0.0]",
                            r"main_cylinder is pinned at its jib's own pivot"),
    "not TOML": ("schema = 1", "schema = = 1", r"not valid TOML: .*line \d+"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_bad_data_names_item_and_fix(case: str) -> None:
    old, new, message = BAD[case]
    with pytest.raises(FileFormatError, match=message) as caught:
        parse(edit(old, new), source="my_crane.toml")
    assert str(caught.value).startswith("my_crane.toml: ")


def test_truncated_and_absent_files(tmp_path: Path) -> None:
    path = tmp_path / "crane.toml"
    path.write_text(TEXT[: TEXT.index("[knuckle_cylinder]")], encoding="utf-8")
    with pytest.raises(FileFormatError, match=r"crane\.toml: knuckle_cylinder is missing"):
        load(path)
    with pytest.raises(FileFormatError, match=r"absent\.toml cannot be read .* check the path"):
        KnuckleBoomCrane.load(tmp_path / "absent.toml")


def test_own_file_is_used(tmp_path: Path) -> None:
    path = tmp_path / "crane.toml"
    path.write_text(edit("height = 6.5", "height = 7.25"), encoding="utf-8")
    tall, shipped = KnuckleBoomCrane.load(path), KnuckleBoomCrane.load()
    rise = tall.geometry.tip(slew=0.0, s1=1.0, s2=1.0) - shipped.geometry.tip(slew=0.0, s1=1.0, s2=1.0)
    np.testing.assert_allclose(rise, [0.0, 0.0, 0.75], atol=1e-12)
