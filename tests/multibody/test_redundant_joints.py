"""Redundant joints, and rows that come to depend on each other: warnings, motion, shortest reactions."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
import pytest
from multibody_runs import ramp, record
from named import pendulum
from reference_problems import bricard, pendulums

from seacrane import Result, Scene, simulate
from seacrane.analysis import Evaluator
from seacrane.warnings import NearSingularWarning

G = 9.80665


def door(hinges: list[float]) -> Scene:
    """A door of 30 kg, 1 m wide, on hinges at these heights on a leaning post, which makes it swing."""
    scene = Scene(name="door")
    scene.add_body(name="door", mass=30.0, inertia=(10.0, 12.0, 3.0), position=(0.5, 0.0, 0.0))
    for i, height in enumerate(hinges):
        pin = {"first": "ground", "second": "door", "point": (0.0, 0.0, height), "axis": (0.0, 0.0, 1.0)}
        scene.add_joint(kind="revolute", name=f"hinge {i}", **pin)
    scene.add_force("door", name="draught", point=(0.5, 0.0, 0.0), force=(0.0, 20.0, 0.0), body_axes=True)
    scene.add_channel(joint="hinge 0", coordinate="angle")
    return scene


def test_two_hinges_warn_and_move_like_one(formulation: str) -> None:
    two = door([-0.8, 0.8])
    with pytest.warns(UserWarning, match=r"hinge 0, hinge 1 are redundant \(5 more than needed\)"):
        out = record(two, 2.0, rtol=1e-9, formulation=formulation)
    one = record(door([0.0]), 2.0, rtol=1e-9)
    assert np.ptp(one["coordinate"]) > 1.0
    for name in ("position", "velocity", "quaternion", "coordinate"):
        np.testing.assert_allclose(out[name], one[name], atol=1e-7)
    # Both hinges together carry what the one hinge carries.
    np.testing.assert_allclose(out["reaction_force"].sum(axis=1), one["reaction_force"][:, 0], atol=1e-6)
    # Alike hinges at the same distance from the middle share the weight.
    np.testing.assert_allclose(out["reaction_force"][:, :, 2], 15.0 * G, rtol=1e-7)


def test_reactions_of_redundant_joints_are_marked() -> None:
    scene = door([-0.8, 0.8])
    scene.add_body(name="knob", mass=0.2, inertia=(1e-3, 1e-3, 1e-3), position=(0.9, 0.0, 0.0))
    scene.add_joint(kind="weld", name="screw", first="door", second="knob", point=(0.9, 0.0, 0.0))
    with pytest.warns(UserWarning, match="hinge 0, hinge 1 are"):
        model = scene.compile()
    unique = {name: mark for name, _, _, mark in model.elements}
    assert unique == {"hinge 0": False, "hinge 1": False, "screw": True}
    assert model.redundant == ["hinge 0", "hinge 1"]
    assert (model.constraints, model.assembly["rank"], model.degrees_of_freedom) == (16, 11, 1)


def test_multipliers_are_the_shortest_of_all_that_balance() -> None:
    with pytest.warns(UserWarning, match="redundant"):
        model = door([-0.8, 0.3]).compile()
    terms = Evaluator(model).terms(0.0, np.array(model.initial_state))
    needed = terms["mass"] @ terms["acceleration"] - terms["load"]
    jacobian = terms["jacobian"]
    assert np.linalg.matrix_rank(jacobian, tol=1e-9) == 5
    shortest = np.linalg.pinv(jacobian.T, rcond=1e-9) @ needed
    np.testing.assert_allclose(jacobian.T @ terms["multipliers"], needed, atol=1e-9 * np.abs(needed).max())
    np.testing.assert_allclose(terms["multipliers"], shortest, atol=1e-9 * np.abs(shortest).max())


def bars(count: int, *, spatial: bool = False) -> Scene:
    """A parallelogram in the x-z plane; `spatial` joints hold each motion once (for two cranks)."""
    scene = Scene(name="parallelogram")
    up = np.array([0.3, 0.0, 0.8])
    scene.add_body(name="coupler", mass=2.0, inertia=(0.1, 0.7, 0.7), position=np.array([1.0, 0.0, 0.0]) + up)
    for i in range(count):
        foot = np.array([2.0 * i / (count - 1), 0.0, 0.0])
        scene.add_body(
            name=f"crank {i}", mass=1.0 if i < 2 else 1e-9, position=foot + 0.5 * up,
            inertia=np.full(3, 0.06 if i < 2 else 1e-10)
        )  # fmt: skip
        kinds = ("cylindrical", "spherical") if spatial and i == count - 1 else ("revolute", "revolute")
        for kind, name, first, second, point in (
            (kinds[0], f"foot {i}", "ground", f"crank {i}", foot),
            (kinds[1], f"head {i}", f"crank {i}", "coupler", foot + up),
        ):
            extra = {} if kind == "spherical" else {"axis": (0.0, 1.0, 0.0)}
            scene.add_joint(kind=kind, name=name, first=first, second=second, point=point, **extra)
    return scene


def test_a_planar_parallelogram_moves_like_its_spatial_twin(formulation: str) -> None:
    """And with a bar between the middles, massless to rounding, which changes no motion."""
    twin_scene = bars(2, spatial=True)
    assert not twin_scene.compile().redundant
    twin = record(twin_scene, 1.0, rtol=1e-9, formulation=formulation)  # flat, and singular, at 0.62 s
    assert np.max(np.abs(twin["angular_velocity"])) > 1.0
    barred = bars(2)
    barred.add_joint(
        kind="distance", name="bar", first="ground", second="coupler", point=(1.0, 0.0, 0.0),
        second_point=(1.3, 0.0, 0.8),
    )  # fmt: skip
    cases = ((bars(2), r"foot 0, head 0, foot 1, head 1 .* \(3 more"), (barred, r"bar .* \(4 more"))
    for scene, words in cases:
        with pytest.warns(UserWarning, match=words):
            planar = record(scene, 1.0, rtol=1e-9, formulation=formulation)
        for name in ("position", "velocity", "quaternion"):
            np.testing.assert_allclose(planar[name], twin[name], atol=1e-7)
        assert np.max(planar["constraint_error"]) < 1e-9


@pytest.mark.parametrize("ratio", [1e-10, pytest.param(1e-12, marks=pytest.mark.slow("short steps"))])
def test_a_light_rod_is_not_taken_for_redundancy(ratio: float, formulation: str) -> None:
    scene = bars(2, spatial=True)
    rod = scene.bodies.pop("crank 1")
    scene.add_body(name="crank 1", mass=2.0 * ratio, position=rod.position, inertia=np.full(3, 0.1 * ratio))
    model = scene.compile()
    assert not model.redundant
    terms = Evaluator(model).terms(0.0, np.array(model.initial_state))
    reactions = terms["jacobian"].T @ terms["multipliers"]
    residual = terms["mass"] @ terms["acceleration"] - terms["load"] - reactions
    assert np.abs(residual).max() < 1e-12 * np.abs(terms["load"]).max()
    assert np.abs(terms["jacobian"] @ terms["acceleration"] - terms["gamma"]).max() < 1e-12
    record(scene, 0.3, formulation=formulation)


def folding(start: float, *, pins: int = 1, rate: float | None = None) -> Scene:
    """A crank, and a link as long from its tip to a slider: they fold together where the crank is at 90 deg.

    Every pin but the first is redundant. Without a driver's `rate` the crank turns freely, at 1 rad/s.
    """
    scene = Scene(name="folding", gravity=0.0)
    tip, end = (np.cos(start), 0.0, np.sin(start)), (2.0 * np.cos(start), 0.0, 0.0)
    turning = 1.0 if rate is None else 0.0
    speed = (-2.0 * turning * np.sin(start), 0, 0)
    scene.add_body(name="crank", mass=1.0, inertia=[1, 1, 1], angular_velocity=(0, -turning, 0))
    scene.add_body(name="slider", mass=1.0, inertia=[1, 1, 1], position=end, velocity=speed)
    for i in range(pins):
        pin = {"first": "ground", "second": "crank", "point": (0, 0.2 * i, 0), "axis": (0, -1, 0)}
        scene.add_joint(kind="revolute", name=f"pin {i}", **pin)
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="slider", point=end, axis=(1, 0, 0)
    )
    scene.add_joint(kind="distance", name="link", first="crank", second="slider", point=tip, second_point=end)
    if rate is not None:
        scene.add_driver(name="turn", joint="pin 0", curve=ramp(rate))
    return scene


def told(scene: Scene, formulation: str = "auto", **settings: Any) -> tuple[Result, list[str]]:
    """A run, and its warnings of what is near singular; those of redundant joints are left out."""
    with warnings.catch_warnings(record=True, action="always") as caught:
        result = simulate(scene, formulation=formulation, **settings)
    near = [str(one.message) for one in caught if "are redundant" not in str(one.message)]
    assert all(issubclass(one.category, NearSingularWarning) for one in caught if str(one.message) in near)
    return result, near


def test_rank_is_watched_beside_redundant_joints(formulation: str) -> None:
    """Ten times nearer to the fold the singular value is ten times smaller, and the link is named."""
    found = []
    for gap in (0.1, 0.01):
        t_end = (0.5 * np.pi - 0.5 - gap) / 0.2
        result, near = told(folding(0.5, pins=2, rate=0.2), formulation, t_end=t_end, maximum_step=0.05)
        assert not near
        assert result.stats["smallest_pivot_joint"] == "link"
        assert result.stats["smallest_pivot_at_s"] == pytest.approx(t_end, abs=0.1)
        assert result.stats["rank_changed"] == 0
        found.append(float(result.stats["smallest_singular_value"]))
    assert found[0] / found[1] == pytest.approx(10.0, rel=0.1)


@pytest.mark.parametrize(
    ("scene", "settings", "words"),
    [
        # With redundant joints into a singular position.
        (folding(0.5, pins=2, rate=0.2), {"t_end": (0.5 * np.pi - 0.5 - 1e-5) / 0.2, "maximum_step": 0.05},
         r"joint 'link'.*at t = 5.35"),
        # What looks like a redundant joint is a fold that the crank turns out of.
        (folding(0.5 * np.pi), {"t_end": 0.5}, "at t = 0 s"),
        # A sliding hinge lets Bricard's loop branch at 0.89 s, where no output is.
        (bricard.scene(last="cylindrical"), {"t_end": 1.4, "dt_out": 0.7, "rtol": 1e-8},
         r"joint 'hinge \d'.*at t = 0\.8[89]"),
        (bricard.scene(), {"t_end": 1.0, "rtol": 1e-8}, None),  # redundant joints that stay so
    ],
    ids=["fold", "start", "bifurcation", "redundant"],
)  # fmt: skip
def test_a_singular_position_is_told(
    scene: Scene, settings: dict[str, Any], words: str | None, formulation: str
) -> None:
    result, near = told(scene, formulation, **settings)
    if words is None:
        assert not near
        assert 0.01 < float(result.stats["smallest_singular_value"]) < 1.0
        assert result.stats["rank_changed"] == 0
        return
    assert any(re.search(words, one) for one in near), near
    if words == "at t = 0 s":
        assert result.stats["rank_changed"] == 1
    if "dt_out" in settings:  # what the warning is about
        assert np.abs(result["energy_balance"]).max() > 1e-4


def chain(links: int, *, lean: float = 0.0) -> Scene:
    """A beam on a hinge, and links of 1 m and 20 kg from it, leaning by `lean` rad."""
    scene = Scene(name="chain", gravity=G)
    scene.add_body(name="beam", mass=50.0, inertia=[5.0] * 3)

    def pin(name: str, first: str, second: str, point: Any) -> None:
        scene.add_joint(kind="revolute", name=name, first=first, second=second, point=point, axis=(0, 1, 0))

    pin("hinge", "ground", "beam", (0, 0, 0))
    along = np.array([np.sin(lean), 0.0, -np.cos(lean)])
    for i in range(links):
        scene.add_body(
            name=f"link {i}", mass=20.0, inertia=[0.02, 1.7, 1.7], position=(i + 0.5) * along,
            quaternion=(np.cos(0.5 * lean), 0, -np.sin(0.5 * lean), 0)
        )  # fmt: skip
        pin(f"pin {i}", f"link {i - 1}" if i else "beam", f"link {i}", i * along)
    return scene


def test_a_long_chain_at_rest_is_not_singular(formulation: str) -> None:
    """Its smallest singular value falls as n^-2, and none of its rows depends on others."""
    result, near = told(chain(40), formulation, t_end=0.1)
    assert not near
    assert float(result.stats["smallest_singular_value"]) < 1e-4
    assert result.stats["rank_changed"] == 0


@pytest.mark.parametrize("inertia", [1e-4, 1e-20])
def test_a_body_of_next_to_no_inertia_hangs_on_a_hinge_that_is_not_redundant(
    inertia: float, formulation: str
) -> None:
    result, near = told(pendulum(inertia=inertia), formulation, t_end=2.0, rtol=1e-10)
    assert not near
    slower = np.sqrt(G / pendulums.GRAVITY / (1.0 + inertia))
    ((x, z),) = pendulums.place([2.0 * slower])  # let go on the other side
    assert np.abs(result["position"][-1, 0] - (-x, 0.0, z)).max() < 1e-8
    assert np.abs(result["constraint_error"]).max() < 1e-12
    assert np.abs(result["energy_balance"]).max() < 1e-8
