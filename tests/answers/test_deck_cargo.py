"""Deck cargo: gravity once in the axes of a rolling deck, and fastenings by hand."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, simulate
from seacrane.answers import Cargo, deck_cargo
from seacrane.warnings import MassUnitWarning

G = 9.80665


def test_cargo_on_a_rolling_deck_feels_gravity_once() -> None:
    """f_y = g sin(phi) - h phi'', f_z = g cos(phi) - h phi'^2 at a height h over the axis of roll."""
    height, amplitude, omega = 6.0, 0.1, 0.8
    scene = Scene(name="rolling deck", gravity=G)
    scene.add_body("deck", mass=1e5, inertia=(1e6,) * 3, angular_velocity=(amplitude * omega, 0.0, 0.0))
    scene.add_joint(name="roll", kind="revolute", first="ground", second="deck", axis=(1.0, 0.0, 0.0))
    curve = Curve.harmonic(amplitude=amplitude, omega=omega, phase=-0.5 * np.pi)
    scene.add_driver(joint="roll", curve=curve)
    scene.add_point(name="module", body="deck", point=(0.0, 0.0, height))
    scene.add_body("barge", mass=1e5, inertia=(1e6,) * 3)
    scene.add_point(name="beside", body="barge", point=(0.0, 0.0, 0.0))
    result = simulate(scene, t_end=20.0, dt_out=0.1, rtol=1e-8, channels=["point_acceleration", "quaternion"])
    found = deck_cargo(result, cargo=[Cargo(point="module", mass=1e4)], after=2.0)
    turn = omega * found.time
    angle, rate, second = (
        amplitude * one for one in (np.sin(turn), omega * np.cos(turn), -(omega**2) * np.sin(turn))
    )
    felt = found.accelerations["module"]
    assert felt[:, 1] == pytest.approx(G * np.sin(angle) - height * second, abs=1e-4)
    assert felt[:, 2] == pytest.approx(G * np.cos(angle) - height * rate**2, abs=1e-4)
    together = found.together("module")
    largest = int(np.argmax(felt[:, 1]))
    assert together[2, 1:] == pytest.approx(felt[largest]) and "what occurs together" in str(found)
    cargo = Cargo(point="module", mass=1e4)
    assert not found.coarse
    few = simulate(scene, t_end=21.0, dt_out=7.0, channels=["point_acceleration", "quaternion"])
    assert deck_cargo(few, cargo=[cargo]).coarse == ("module",)
    assert "Peaks between the outputs: module; shorten dt_out" in str(deck_cargo(few, cargo=[cargo]))
    with pytest.raises(SceneError, match="'module' is on deck, which turns on barge"):
        deck_cargo(result, cargo=[cargo], deck="barge")
    with pytest.raises(SceneError, match="stands on barge, deck"):
        deck_cargo(result, cargo=[cargo, Cargo(point="beside", mass=1.0)])
    for listed, after, answer in (
        ([cargo, Cargo(point="module", mass=2e4)], 0.0, "'module' is there twice"),
        ([], 0.0, "give a list of Cargo"), ([cargo], 30.0, "past the last output, 20 s"),
        ([cargo], np.nan, "after is nan s"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=answer):
            deck_cargo(result, cargo=listed, deck="deck", after=after)


def test_fastenings_share_force_and_overturning() -> None:
    """Four corners 2 m to either side, 1.5 m below: m a / 4 each, and m a h / (4 b) up and down."""
    corners = [(x, y, -1.5) for x in (-3.0, 3.0) for y in (-2.0, 2.0)]
    cargo = Cargo(point="module", mass=1e4, fastenings=corners)
    found = cargo.forces(np.array([[0.0, 2.0, G]]))[0]
    assert found[:, 1] == pytest.approx(1e4 * 2.0 / 4.0)
    sideways = 1e4 * 2.0 * 1.5 / (4.0 * 2.0)
    total = found.sum(axis=0)
    moment = np.cross(corners, found).sum(axis=0)
    assert total == pytest.approx([0.0, 2e4, 1e4 * G]) and moment == pytest.approx([0.0] * 3, abs=1e-6)
    assert np.abs(found[:, 2] - 1e4 * G / 4.0) == pytest.approx(sideways)
    with pytest.warns(MassUnitWarning, match="10 kg within fastenings about 72 m3.*give 10000"):
        Cargo(point="module", mass=10.0, fastenings=corners)
    for nowhere in (np.nan, np.inf):
        with pytest.raises(SceneError, match="finite numbers"):
            Cargo(point="module", mass=1.0, fastenings=[*corners, (0.0, 0.0, nowhere)])
        with pytest.raises(SceneError, match="zero or more, finite"):
            Cargo(point="module", mass=1.0, fastenings=corners, stiffness=[(1.0, 1.0, nowhere)] * 4)
    with pytest.raises(SceneError, match="let it move"):
        Cargo(point="module", mass=1.0, fastenings=[(0, 0, 0), (1, 0, 0)])
