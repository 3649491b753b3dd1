"""Lines over sheaves: geometry, tension and friction against closed forms, energy, both formulations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from line_scenes import below
from multibody_runs import record
from numpy.testing import assert_allclose
from reeving_scenes import HEIGHT, MASS, RADIUS, G, belt, capstan, path_of_tackle, slewing, stiff, tackle
from scipy.interpolate import PchipInterpolator

from seacrane import Scene, SceneError, SimulationError, equilibrium, simulate
from seacrane.description.line_path import described_poses, laid
from seacrane.pictures.wheels import wires_of
from seacrane.warnings import FleetAngleWarning, LineTableWarning


def start(scene: Scene) -> dict[str, Any]:
    """Channels at the start."""
    out = record(scene, 1e-3, dt_out=1e-3)
    return {name: values[0] for name, values in out.items() if isinstance(values, np.ndarray)}


@pytest.mark.parametrize("crossed", [False, True])
def test_a_belt_has_its_closed_length(crossed: bool) -> None:
    """Open and crossed tangents, wraps beyond half a turn."""
    scene, length = belt(crossed=crossed)
    out = start(scene)
    assert out["line_length"][0] == pytest.approx(length, rel=1e-14)
    line: Any = scene.loads["belt"]
    assert_allclose(out["sheave_wrap"], laid(line, described_poses(scene)).wraps[1:-1], rtol=1e-13)


@pytest.mark.parametrize("falls", [2, 6])
def test_falls_over_sheaves_share_the_load(falls: int) -> None:
    """The mechanical advantage, in both forms of the equations; the arcs are half turns."""
    for formulation in ("redundant", "recursive"):
        out = record(tackle(falls=falls), 0.2, formulation=formulation)
        assert_allclose(falls * out["line_tension"], MASS * G, rtol=1e-9)
        assert_allclose(out["section_tension"], MASS * G / falls, rtol=1e-9)
        assert_allclose(out["sheave_wrap"], np.pi, rtol=1e-12)
        assert_allclose(out["line_length"], path_of_tackle(falls), rtol=1e-12)
        assert_allclose(out["position"][:, 0, 2], -HEIGHT, rtol=1e-10)


@pytest.mark.parametrize("rate", [-0.5, 0.5])
def test_the_efficiencies_of_six_falls_multiply(rate: float) -> None:
    """Far above the speed of slip."""
    scene = tackle(efficiencies=[1.0, *[0.98] * 5, 1.0], damping_ratio=0.2, slip_speed=0.005)
    scene.add_winch(line="hoist", rate=rate, lag=0.3)
    out = record(scene, 4.0, dt_out=1.0)
    tensions = out["section_tension"][-1]
    ratio = 0.98 if rate < 0.0 else 1.0 / 0.98
    assert_allclose(tensions[1:] / tensions[:-1], ratio, rtol=1e-9)
    assert MASS * G / (6.0 * tensions[0]) == pytest.approx(np.mean(ratio ** np.arange(6)), rel=1e-4)
    assert np.all(out["sheave_friction_power"] <= 0.0)


@pytest.mark.parametrize("turns", [0.0, 2.0])
def test_a_capstan_holds_by_euler_and_eytelwein(turns: float) -> None:
    out = record(capstan(turns=turns), 3.0, dt_out=1.0)
    wrap = 0.5 * np.pi + 2.0 * np.pi * turns
    assert_allclose(out["sheave_wrap"], wrap, rtol=1e-12)
    tensions = out["section_tension"][-1]
    assert tensions[0] / tensions[1] == pytest.approx(np.exp(0.1 * wrap), rel=1e-12)


def test_forces_are_the_gradient_of_the_length_out_of_plane() -> None:
    """Without friction and damping the energy is kept while the line leans far out of its sheaves' planes."""
    scene = slewing({"efficiencies": [], "frictions": []}, damping_ratio=0.0)
    scene.replace("hoist", winch=False, rate=0.0, lag=0.0)
    scene.remove("cord")
    scene.replace("load", velocity=(0.0, 1.5, 0.0))
    out = record(scene, 4.0, rtol=1e-10)
    assert np.max(out["sheave_fleet_angle"]) > np.radians(8.0)
    assert np.max(np.abs(out["energy_balance"])) < 1e-7 * MASS


def test_a_quasi_static_stretch_takes_sheaves_and_friction(formulation: str) -> None:
    """Places are the elastic line's to less than its stretch, the tensions its once both have settled."""
    stiffness = 3e8
    ours, exact = (
        record(stiff(stiffness, kind, damping_ratio=0.7), 1.5, rtol=1e-8, formulation=formulation)
        for kind in ("quasi-static", "elastic")
    )
    stretch = 8e3 / stiffness * exact["line_length"][0, 0]
    assert np.max(np.abs(ours["position"] - exact["position"])) < stretch
    ratio = ours["section_tension"] / exact["section_tension"]
    assert_allclose(ratio[ours["time"] > 1.0], 1.0, atol=2e-3)
    assert np.max(np.abs(ours["energy_balance"])) < 1e-6 * ours["absolute_work"][-1]
    assert np.min(ours["sheave_friction_power"]) < -1.0


def corded(strain: float, *, last: float = 0.8) -> Scene:
    """A load on a shock cord of 4 m."""
    table = {"strains": [0.0, 0.1, 0.3, last], "tensions": [0.0, 300.0, 700.0, 3000.0]}
    place = (0.0, 0.0, -4.0 * (1.0 + strain))
    return below(place, mass=60.0, length=4.0, damping_ratio=0.0, **table)


@pytest.mark.warns("LiftedStartWarning")
def test_a_shock_cord_follows_its_table() -> None:
    """A monotone cubic spline, as SciPy's; with its tangent beyond, and its integral as potential."""
    table = PchipInterpolator([0.0, 0.1, 0.3, 0.8], [0.0, 300.0, 700.0, 3000.0])
    for strain in (0.03, 0.1, 0.17, 0.45, 0.79):
        assert start(corded(strain))["line_tension"][0] == pytest.approx(float(table(strain)), rel=1e-10)
    beyond = float(table(0.8)) + 0.1 * float(table.derivative()(0.8))
    assert start(corded(0.9))["line_tension"][0] == pytest.approx(beyond, rel=1e-10)
    out = record(corded(0.6), 4.0, rtol=1e-9)
    assert np.min(out["line_stretch"]) < 0.0  # it goes slack too
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * 60.0 * G * 4.0


@pytest.mark.warns("LiftedStartWarning", "LineLengthWarning", "FleetAngleWarning", "WinchLimitWarning")
def test_a_cord_beyond_its_table_and_a_line_out_of_its_groove_are_told() -> None:
    with pytest.warns(LineTableWarning, match=r"'hoist'.* 0\.6 at t = 0 s, .* ends at 0\.5"):
        simulate(corded(0.6, last=0.5), 0.1, dt_out=0.1)
    with pytest.warns(FleetAngleWarning, match=r"'hoist 3'.* degrees at t ="):
        simulate(slewing(), 0.5, dt_out=0.1)


def test_slings_share_a_load_by_their_stiffness() -> None:
    """Four legs are one too many: opposite ones of twice the stiffness take twice the tension."""
    scene = Scene(name="slung")
    scene.add_body(name="load", mass=8e3, inertia=(2e4, 2e4, 3e4), position=(0.0, 0.0, -4.0))
    corners = [(2.0, 2.0, 0.0), (-2.0, 2.0, 0.0), (-2.0, -2.0, 0.0), (2.0, -2.0, 0.0)]
    for i, corner in enumerate(corners):
        ends = {"bodies": ["ground", "load"], "points": [(0, 0, 0), corner]}
        scene.add_line(f"sling {i}", EA=(8e6, 4e6)[i % 2], **ends)
    rest = equilibrium(scene)
    tensions = simulate(scene, 0.01, start=rest, dt_out=0.01)["line_tension"][0]
    assert_allclose(tensions[[0, 1]], tensions[[2, 3]], rtol=1e-6)
    upright = 4.0 / np.sqrt(24.0)
    by_hand = 8e3 * G / (2.0 * upright) * np.array([2.0, 1.0]) / 3.0
    assert_allclose(tensions[:2], by_hand, rtol=2e-3)


def test_a_line_that_leaves_its_sheave_ends_the_run_by_name() -> None:
    scene = capstan(friction=0.0)
    scene.remove("guide")
    scene.replace("hoist", winch=False, rate=0.0, lag=0.0)
    scene.replace("load", velocity=(14.0, 0.0, 0.0))
    with pytest.raises(SimulationError, match=r"line 'hoist': leaves the sheave at its point 1: its wrap"):
        simulate(scene, 5.0)


def test_arcs_are_drawn() -> None:
    scene = tackle(falls=2)
    wires = wires_of(scene, list(scene.bodies))
    assert [wire["name"] for wire in wires[:2]] == ["hoist 1", "hoist 2"]
    arc = np.array([wire["from"][1:] for wire in wires[2:]] + [wires[-1]["to"][1:]])
    assert len(arc) > 10
    assert_allclose(np.linalg.norm(arc, axis=1), RADIUS, atol=1e-4)
    assert_allclose(arc[[0, -1]], [(-RADIUS, 0, 0), (RADIUS, 0, 0)], atol=1e-12)
    assert arc[:, 2].min() == pytest.approx(-RADIUS, rel=1e-2)


@pytest.mark.parametrize(
    ("change", "message"),
    [({"radii": [0.0, 0.3]}, "3 points and 2 radii"), ({"axes": []}, "sheaves and no axes"),
     ({"axes": np.zeros((3, 3))}, "axes are zero at point 1"),
     ({"turns": [0, 0.5, 0]}, "turns are 0.5 at point 1"),
     ({"radii": [], "frictions": [0, 0.1, 0]}, "friction or turns at point 1"),
     ({"efficiencies": [0.9, 1, 1]}, "sheave at point 0, where it ends"),
     ({"points": [(0.1, 0, 0), (0, 0, 0), (0, 0, 0)]}, "points 0 and 1 of body 'ground' within a rim"),
     ({"rung": "quasi-static", "strains": [0, 1], "tensions": [0, 1]}, "takes EA, no table"),
     ({"strains": [0.1, 1.0], "tensions": [0.0, 5.0]}, "starts with strain 0.1"),
     ({"strains": [0, 0.1, 0.2], "tensions": [0, 5, 4]}, "not increase at strain 0.2")],
)  # fmt: skip
def test_what_makes_no_path_is_told(change: dict[str, Any], message: str) -> None:
    scene = capstan()
    scene.replace("hoist", **change)
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        scene.compile()
