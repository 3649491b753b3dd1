"""Lines over sheaves: geometry, tension and friction against closed forms, energy, both formulations."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from multibody_runs import record
from numpy.testing import assert_allclose
from numpy.typing import NDArray
from reeving_scenes import (
    HEIGHT,
    MASS,
    RADIUS,
    STIFFNESS,
    G,
    belt,
    capstan,
    four_legs,
    path_of_tackle,
    slewing,
    tackle,
)
from scipy.interpolate import PchipInterpolator

from seacrane import Run, Scene, SceneError, SimulationError, State, equilibrium, simulate
from seacrane.analysis import Evaluator
from seacrane.description.line_path import described_poses, laid, path_length
from seacrane.pictures.wires import wires_of
from seacrane.warnings import FleetAngleWarning, LineTableWarning

Array = NDArray[np.float64]


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
    path = laid(line, described_poses(scene))
    assert_allclose(out["sheave_wrap"], path.wraps[1:-1], rtol=1e-13)
    assert out["sheave_wrap"][1] > np.pi


@pytest.mark.parametrize("falls", [2, 4, 6])
def test_falls_over_sheaves_share_the_load(falls: int) -> None:
    """The mechanical advantage, in both forms of the equations; the arcs are half turns."""
    for formulation in ("redundant", "recursive"):
        out = record(tackle(falls=falls), 0.2, formulation=formulation)
        assert_allclose(falls * out["line_tension"], MASS * G, rtol=1e-9)
        assert_allclose(out["section_tension"], MASS * G / falls, rtol=1e-9)
        assert_allclose(out["sheave_wrap"], np.pi, rtol=1e-12)
        assert_allclose(out["line_length"], path_of_tackle(falls), rtol=1e-12)
        assert_allclose(out["position"][:, 0, 2], -HEIGHT, rtol=1e-10)


def test_a_load_on_falls_over_sheaves_swings_by_their_stiffness() -> None:
    """n^2 EA / l0 at the hook, as of falls through points."""
    scene = tackle(falls=4, damping_ratio=0.0)
    scene.replace("hook", velocity=(0.0, 0.0, 0.01))
    out = record(scene, 2.0, rtol=1e-10)
    l0 = path_of_tackle(4) / (1.0 + MASS * G / (4 * STIFFNESS))
    omega = np.sqrt(16 * STIFFNESS / l0 / MASS)
    heave = out["position"][:, 0, 2] + HEIGHT
    assert_allclose(heave, 0.01 / omega * np.sin(omega * out["time"]), atol=1e-9)


@pytest.mark.parametrize("rate", [-0.5, 0.5])
def test_the_efficiencies_of_six_falls_multiply(rate: float) -> None:
    """Far above the speed of slip: six falls carry 0.951 of six times the winch's tension."""
    scene = tackle(efficiencies=[1.0, *[0.98] * 5, 1.0], damping_ratio=0.2, slip_speed=0.005)
    scene.add_winch(line="hoist", rate=rate, lag=0.3)
    out = record(scene, 4.0, dt_out=1.0)
    tensions = out["section_tension"][-1]
    ratio = 0.98 if rate < 0.0 else 1.0 / 0.98
    assert_allclose(tensions[1:] / tensions[:-1], ratio, rtol=1e-9)
    assert MASS * G / (6.0 * tensions[0]) == pytest.approx(np.mean(ratio ** np.arange(6)), rel=1e-4)
    if rate < 0.0:
        assert MASS * G / (6.0 * tensions[0]) == pytest.approx(0.951, abs=5e-4)
    assert np.all(out["sheave_friction_power"] <= 0.0)


@pytest.mark.parametrize("turns", [0.0, 2.0])
def test_a_capstan_holds_by_euler_and_eytelwein(turns: float) -> None:
    out = record(capstan(turns=turns), 3.0, dt_out=1.0)
    wrap = 0.5 * np.pi + 2.0 * np.pi * turns
    assert_allclose(out["sheave_wrap"], wrap, rtol=1e-12)
    tensions = out["section_tension"][-1]
    assert tensions[0] / tensions[1] == pytest.approx(np.exp(0.1 * wrap), rel=1e-12)


def test_the_winch_pays_for_the_friction() -> None:
    """Hoisting at a steady rate: it pulls the tension before the sheave, which keeps its share as heat."""
    out = record(capstan(), 4.0, dt_out=0.5, rtol=1e-9)
    pulled, carried = out["section_tension"][-1]
    passes = 0.5 * out["line_length"][-1, 0] / out["line_unstretched_length"][-1, 0]
    lost = -out["sheave_friction_power"][-1, 0]
    assert lost == pytest.approx((pulled - carried) * passes, rel=1e-3)
    assert lost == pytest.approx(carried * passes * (np.exp(0.05 * np.pi) - 1.0), rel=1e-3)


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_the_energy_balance_closes(formulation: str) -> None:
    """Sheaves that lean, friction, a winch and a table together."""
    out = record(slewing(), 5.0, rtol=1e-8, formulation=formulation)
    assert out["absolute_work"][-1] > 1e3
    assert np.max(np.abs(out["energy_balance"])) < 1e-6 * out["absolute_work"][-1]
    assert np.all(out["sheave_friction_power"] <= 0.0)
    assert np.min(out["sheave_friction_power"]) < -1.0
    assert np.ptp(out["sheave_fleet_angle"]) > 0.01


def test_forces_are_the_gradient_of_the_length_out_of_plane() -> None:
    """Without friction and damping the energy is kept while the line leans far out of its sheaves' planes."""
    scene = slewing(efficiencies=[], frictions=[], damping_ratio=0.0)
    scene.replace("hoist", winch=False, rate=0.0, lag=0.0)
    scene.remove("cord")
    scene.replace("load", velocity=(0.0, 1.5, 0.0))
    out = record(scene, 4.0, rtol=1e-10)
    assert np.max(out["sheave_fleet_angle"]) > np.radians(8.0)
    energy = out["energy_balance"]
    assert np.max(np.abs(energy)) < 1e-7 * MASS


def test_both_formulations_and_merged_bodies_agree() -> None:
    scene = slewing()
    runs = [record(scene, 3.0, rtol=1e-10, formulation=name) for name in ("redundant", "recursive")]
    unmerged = Run(scene, t_end=3.0, dt_out=0.05, rtol=1e-10, model=scene.compile(merge=False))
    unmerged.advance(3.0)
    runs.append(dict(unmerged.core.channels()))
    for other in runs[1:]:
        assert_allclose(other["position"], runs[0]["position"], atol=1e-7)
        assert_allclose(other["section_tension"], runs[0]["section_tension"], atol=2e-1)


def test_the_engines_path_is_that_of_the_pictures() -> None:
    """Two programs of the same tangents."""
    scene = slewing()
    line: Any = scene.loads["hoist"]
    out = start(scene)
    assert out["line_length"][0] == pytest.approx(path_length(scene, line), rel=1e-12)
    assert_allclose(out["sheave_wrap"], laid(line, described_poses(scene)).wraps[1:-1], rtol=1e-10)


def check_jacobian(scene: Scene, time: float) -> None:
    """That of the redundant form against differences, after a while of motion."""
    model = scene.compile(merge=False)
    run = Run(scene, t_end=time, dt_out=0.1, rtol=1e-8, model=model)
    run.advance(time)
    y = np.array(run.core.state.values)
    at = Evaluator(model)
    exact = np.asarray(at.jacobian(time, y))
    states = [place for _, _, place, *_ in model.load_states]
    for j in [*states, 0, 5, 7, 11, 14, 17, model.twist_index(0), model.twist_index(2) + 4]:
        step = np.zeros_like(y)
        step[j] = 1e-5
        near, far = ((at.derivative(time, y + k * step) - at.derivative(time, y - k * step)) / (2e-5 * k)
                     for k in (1.0, 2.0))  # fmt: skip
        expected = (4.0 * near - far) / 3.0
        assert_allclose(exact[:, j], expected, atol=1e-6 * np.max(np.abs(exact)), rtol=1e-6)


def test_the_exact_jacobian_is_that_of_differences() -> None:
    check_jacobian(slewing(), 0.9)


def test_a_run_goes_on_bit_for_bit(tmp_path: Path) -> None:
    whole = Run(slewing(), t_end=1.0, dt_out=0.05, rtol=1e-7)
    whole.advance(0.53)
    whole.core.state.save(tmp_path / "half.state")
    whole.advance(1.0)
    half = State.load(tmp_path / "half.state", scene=slewing())
    rest = Run(slewing(), t_end=1.0, dt_out=0.05, rtol=1e-7, start=half)
    rest.advance(1.0)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)


def stiff(stiffness: float, rung: str, **change: Any) -> Scene:
    """`slewing` with a taut line of that EA, which starts with 8 kN."""
    scene = slewing(EA=stiffness, rung=rung, **change)
    line: Any = scene.loads["hoist"]
    scene.replace("hoist", length=path_length(scene, line) / (1.0 + 8e3 / stiffness))
    return scene


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
@pytest.mark.parametrize("stiffness", [3e7, 3e8])
def test_a_quasi_static_stretch_takes_sheaves_and_friction(stiffness: float, formulation: str) -> None:
    """Places are the elastic line's to less than its stretch, the tensions its once both have settled."""
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


def test_the_exact_jacobian_of_a_quasi_static_stretch_is_that_of_differences() -> None:
    check_jacobian(stiff(3e7, "quasi-static"), 0.5)


def corded(strain: float, *, last: float = 0.8) -> Scene:
    """A load on a shock cord of 4 m."""
    scene = Scene(name="cord")
    scene.add_body(
        name="load", mass=60.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, -4.0 * (1.0 + strain))
    )
    scene.add_line(
        name="cord", bodies=["ground", "load"], points=np.zeros((2, 3)), length=4.0, damping_ratio=0.0,
        strains=[0.0, 0.1, 0.3, last], tensions=[0.0, 300.0, 700.0, 3000.0],
    )  # fmt: skip
    return scene


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
    low = out["position"][:, 0, 2].min()
    assert low == pytest.approx(-6.4, abs=1e-3)


@pytest.mark.warns("LiftedStartWarning", "LineLengthWarning")
def test_a_cord_beyond_its_table_is_told() -> None:
    with pytest.warns(
        LineTableWarning, match=r"line 'cord': is strained by 0\.6 at t = 0 s, .* ends at 0\.5"
    ):
        simulate(corded(0.6, last=0.5), 0.1, dt_out=0.1)


def test_slings_share_a_load_by_their_stiffness() -> None:
    """Four legs are one too many: opposite ones of twice the stiffness take twice the tension."""
    scene = four_legs(stiffnesses=(8e6, 4e6, 8e6, 4e6))
    assert list(scene.loads) == ["sling 1", "sling 2", "sling 3", "sling 4"]
    rest = equilibrium(scene)
    tensions = simulate(scene, 0.01, start=rest, dt_out=0.01)["line_tension"][0]
    assert_allclose(tensions[[0, 1]], tensions[[2, 3]], rtol=1e-6)
    assert tensions[0] / tensions[1] == pytest.approx(2.0, rel=1e-4)
    upright = 4.0 / np.sqrt(24.0)
    by_hand = 8e3 * G / (2.0 * upright) * np.array([2.0, 1.0]) / 3.0
    assert_allclose(tensions[:2], by_hand, rtol=2e-3)


def test_two_slings_share_a_load_by_statics() -> None:
    scene = Scene(name="two")
    scene.add_body(name="load", mass=2e3, inertia=(100.0, 100.0, 100.0), position=(0.0, 0.0, -3.0))
    scene.add_bridle(name="sling", hook="ground", load="load", points=[(1.5, 0, 0.2), (-1.5, 0, 0.2)], EA=5e7)
    tensions = simulate(scene, 0.01, start=equilibrium(scene), dt_out=0.01)["line_tension"][0]
    assert_allclose(tensions, 2e3 * G / 2.0 / (2.8 / np.hypot(1.5, 2.8)), rtol=1e-3)


def test_a_line_that_leaves_its_sheave_ends_the_run_by_name() -> None:
    scene = capstan(friction=0.0)
    scene.remove("guide")
    scene.replace("hoist", winch=False, rate=0.0, lag=0.0)
    scene.replace("load", velocity=(14.0, 0.0, 0.0))
    with pytest.raises(SimulationError, match=r"line 'hoist': leaves the sheave at its point 1: its wrap"):
        simulate(scene, 5.0)


@pytest.mark.warns("FleetAngleWarning", "WinchLimitWarning")
def test_a_line_that_leans_out_of_its_groove_is_told() -> None:
    scene = slewing()
    with pytest.warns(
        FleetAngleWarning, match=r"line at sheave 'hoist 3': leaves the plane .* degrees at t ="
    ):
        simulate(scene, 0.5, dt_out=0.1)


def test_rest_is_found_with_sheaves() -> None:
    """From a line described a little slack."""
    scene = tackle(falls=4, strain=0.0)
    rest = equilibrium(scene)
    drop = MASS * G / (16.0 * STIFFNESS) * path_of_tackle(4)
    assert rest.values[2] == pytest.approx(-HEIGHT - drop, abs=1e-6)


def test_arcs_are_drawn() -> None:
    scene = tackle(falls=2)
    wires = wires_of(scene, list(scene.bodies))
    assert [wire["name"] for wire in wires[:2]] == ["hoist 1", "hoist 2"]
    arc = np.array([wire["from"][1:] for wire in wires[2:]] + [wires[-1]["to"][1:]])
    assert len(arc) > 10
    assert_allclose(np.linalg.norm(arc, axis=1), RADIUS, atol=1e-4)
    assert_allclose(arc[[0, -1]], [(-RADIUS, 0, 0), (RADIUS, 0, 0)], atol=1e-12)
    assert arc[:, 2].min() == pytest.approx(-RADIUS, rel=1e-2)


def test_files_hold_sheaves(tmp_path: Path) -> None:
    scene = slewing()
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"radii": [0.0, 0.3]}, "has 3 points and 2 radii; give one for each point, or none"),
        ({"radii": [0.0, -0.3, 0.0]}, r"radii\[1\] is -0.3 m; it must not be negative"),
        ({"axes": []}, "has sheaves and no axes"),
        ({"axes": np.zeros((3, 3))}, "axes are zero at point 1, which is a sheave"),
        ({"turns": [0, 0.5, 0]}, "turns are 0.5 at point 1; give a whole number"),
        ({"efficiencies": [1, 1.2, 1]}, r"efficiencies\[1\] is 1.2; give more than 0 to 1"),
        ({"frictions": [0, -0.1, 0]}, r"frictions\[1\] is -0.1; it must not be negative"),
        ({"radii": [], "frictions": [0, 0.1, 0]}, "has friction or turns at point 1, which has no radius"),
        ({"radii": [0.2, 0.3, 0.0]}, "axes are zero at point 0"),
        ({"efficiencies": [0.9, 1, 1]}, "has a sheave at point 0, where it ends; end it at a point"),
        ({"slip_speed": 0.0}, "slip_speed is 0 m/s; it must be positive"),
        ({"points": [(0.1, 0, 0), (0, 0, 0), (0, 0, 0)]}, "points 0 and 1 of body 'ground' within a rim"),
        (
            {"rung": "quasi-static", "strains": [0, 1], "tensions": [0, 1]},
            "a quasi-static stretch takes EA, no table",
        ),
        ({"strains": [0.0], "tensions": [0.0]}, "has 1 strains and 1 tensions; give as many of both"),
        ({"strains": [0.1, 1.0], "tensions": [0.0, 5.0]}, "its table starts with strain 0.1"),
        ({"strains": [0, 0.1, 0.2], "tensions": [0, 5, 4]}, "its table does not increase at strain 0.2"),
    ],
)
def test_sheaves_that_cannot_be_are_told(change: dict[str, Any], message: str) -> None:
    scene = capstan()
    scene.replace("hoist", **change)
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        scene.compile()


def test_a_line_has_ea_or_a_table() -> None:
    given: dict[str, Any] = {"bodies": ["ground", "load"], "points": np.zeros((2, 3)), "length": 1.0}
    scene = corded(0.1)
    with pytest.raises(SceneError, match="line 'a': has no EA; give it in N, or strains and tensions"):
        scene.add_line(name="a", **given)
    with pytest.raises(SceneError, match="line 'a': has EA and a table; give one of them"):
        scene.add_line(name="a", EA=1e3, strains=[0, 1], tensions=[0, 1], **given)


def test_bridles_that_cannot_be_are_told() -> None:
    scene = four_legs(stiffnesses=(1e6,))
    given: dict[str, Any] = {"name": "more", "hook": "ground", "load": "load", "EA": 1e6}
    points = [(1, 0, 0), (0, 1, 0)]
    with pytest.raises(SceneError, match="bridle 'more': has 1 points; give two or more"):
        scene.add_bridle(points=[(1, 0, 0)], **given)
    with pytest.raises(SceneError, match="bridle 'more': hook 'block' is no body of the scene"):
        scene.add_bridle(points=points, **given | {"hook": "block"})
    with pytest.raises(SceneError, match="bridle 'more': EA are 3 numbers; give one for each of 2"):
        scene.add_bridle(points=points, **given | {"EA": (1e6, 1e6, 1e6)})
