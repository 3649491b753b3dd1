"""What follows a load follows water: rest, statics, modes, linear models, stages, summaries of wet loads."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from seacrane import (
    Curve,
    Kept,
    Lift,
    Scene,
    SceneError,
    Stage,
    Until,
    _core,
    ensemble,
    equilibrium,
    linear_model,
    motion_rao,
    natural_modes,
    response_statistics,
    simulate,
    simulate_stages,
    statics,
    summary,
)
from seacrane.analysis import drag_in_sea, response_summed
from seacrane.analysis.drag_in_sea import drag_in_components, mean_slope
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.ensembles import LatinHypercube
from seacrane.pictures.page_sea import sea_words, without_sea
from seacrane.sea import Current, jonswap
from seacrane.water import BoxPart, CylinderPart, PlatePart, SpherePart, TablePart
from seacrane.water.parts import Part

Array = NDArray[np.float64]
G, RHO = 9.80665, 1025.0
SIZE, FILL, MASS, EA = (4.0, 3.0, 2.0), 0.5, 40e3, 2e8  # m, -, kg, N
DRY, LIFT = MASS * G, RHO * G * FILL * 24.0  # N: weight, and buoyancy of all of it
HOOK = 10.0  # m, height of what it hangs from


def hung(depth: float, *parts: Part, sea: dict[str, Any] | None = None) -> Scene:
    """A load on a wire from above, its top at a depth (m)."""
    scene = Scene(name="wet", gravity=G)
    middle = -depth - 0.5 * SIZE[2]
    scene.add_body("load", mass=MASS, size=SIZE, position=(0.0, 0.0, middle))
    scene.add_line(
        "wire", first="ground", second="load", first_point=(0.0, 0.0, HOOK), second_point=(0.0, 0.0, 1.0),
        EA=EA, tension_at_start=DRY - LIFT, damping_ratio=0.0,
    )  # fmt: skip
    if sea is not None:
        scene.add_sea(vessel=None, **sea)
    scene.add_immersed("load", parts=parts or (BoxPart(size=SIZE, fill=FILL),), density=RHO)
    return scene


# --- rest, statics, modes -------------------------------------------------------------------------------


def test_at_rest_the_wire_carries_what_the_water_does_not() -> None:
    scene = hung(30.0)
    told = statics(scene)
    assert told["hoist tension wire"] == pytest.approx(DRY - LIFT, rel=1e-9)
    result = simulate(scene, t_end=2.0, dt_out=0.5, start="rest")
    assert result.select("line_tension", line="wire") == pytest.approx(DRY - LIFT, rel=1e-7)


def test_a_box_that_is_half_under_rests_where_water_and_wire_share_its_weight() -> None:
    """Two springs side by side: the wire, and the plane of the water."""
    scene = hung(-1.0)
    state = equilibrium(scene)
    wire = scene.loads["wire"]
    length = float(wire.length.evaluate([0.0])[0, 0])
    z = float(np.array(state.values)[2])
    under = 1.0 - z  # m of its height of 2
    pull = EA / length * (HOOK - 1.0 - z - length)
    assert 0.0 < under < 2.0
    assert pull + LIFT * under / 2.0 == pytest.approx(DRY, rel=1e-9)
    assert statics(scene)["hoist tension wire"] == pytest.approx(pull, rel=1e-8)


def added(scene: Scene) -> Array:
    """Added mass along its axes of the one part of a scene, deep down."""
    (part,) = (load for load in scene.loads.values() if isinstance(load, _core.ImmersedPart))
    return np.asarray(part.added_masses[-1])


@pytest.mark.parametrize("depth", [30.0, 300.0])
def test_a_load_on_a_wire_heaves_with_the_mass_of_the_water(depth: float) -> None:
    scene = hung(depth)
    stiffness = EA / float(scene.loads["wire"].length.evaluate([0.0])[0, 0])
    expected = 2.0 * np.pi * np.sqrt((MASS + added(scene)[2]) / stiffness)
    modes = natural_modes(scene)
    assert modes.natural_period[modes.find("load heave")] == pytest.approx(expected, rel=1e-9)


def test_a_pendulum_under_water_swings_by_its_weight_there() -> None:
    """Double pendulum of wire and box, with the added mass of the box and its weight in water."""
    scene = hung(30.0)
    across, inertia = MASS + added(scene)[0], MASS / 12.0 * (SIZE[0] ** 2 + SIZE[2] ** 2)
    length = HOOK + 30.0
    mass = np.array([[across * length**2, across * length], [across * length, across + inertia]])
    stiff = np.diag([(DRY - LIFT) * length, DRY - LIFT])
    slowest = float(np.sqrt(np.linalg.eigvals(np.linalg.solve(mass, stiff)).real.min()))
    modes = natural_modes(scene)
    found = np.min(np.abs(modes.natural_period - 2.0 * np.pi / slowest))
    assert found < 2e-3 * 2.0 * np.pi / slowest


def test_a_box_that_floats_heaves_on_the_plane_of_the_water() -> None:
    """Without a wire, half under: the added mass is that of its depth."""
    scene = Scene(name="float", gravity=G)
    scene.add_body("load", mass=RHO * 12.0, size=SIZE, position=(0.0, 0.0, 0.0))
    scene.add_immersed("load", parts=[BoxPart(size=SIZE, strips=(2, 2))], density=RHO)
    modes = natural_modes(scene)
    piece = next(BoxPart(size=SIZE).pieces(RHO))
    mass = RHO * 12.0 + float(np.interp(1.0, piece.depths, piece.added_masses[:, 2]))
    expected = 2.0 * np.pi * np.sqrt(mass / (RHO * G * 12.0))
    assert modes.natural_period[modes.find("load heave")] == pytest.approx(expected, rel=1e-3)


# --- waves ----------------------------------------------------------------------------------------------

TILTED = np.linalg.qr(np.array([[1.0, 0.3, 0.2], [-0.2, 1.0, 0.1], [0.3, -0.1, 1.0]]))[0]
TILTED = TILTED * np.sign(np.linalg.det(TILTED))


@pytest.mark.parametrize("depth", [np.inf, 25.0])
@pytest.mark.parametrize(
    "part",
    [
        BoxPart(size=(5.0, 2.0, 1.0), point=(0.3, 0.2, -0.1), axes=TILTED, strips=(2, 1)),
        CylinderPart(length=5.0, diameter=1.0, axes=TILTED, strips=2),
        SpherePart(diameter=2.0, point=(1.0, -0.5, 0.0)),
    ],
    ids=lambda part: part.kind,
)
def test_waves_on_parts_are_those_of_the_engine(part: Part, depth: float) -> None:
    """Accelerations at rest in small waves, by the linear model and by the engine itself."""
    scene = hung(1.5, part, sea={"hs": 1e-3, "tp": 5.0, "direction_deg": 30.0, "seed": 3})
    assert scene.waves is not None
    scene.waves = replace(scene.waves, depth=depth)
    linear = linear_model(scene)
    parts = PartsInWaves(linear)
    waves = scene.waves
    assert waves is not None
    components = waves.components()
    amplitude = np.array(components.amplitude) * np.exp(1j * np.array(components.phase))
    plane = parts.waves(np.array(components.omega), np.array(components.direction), depth)
    rates = amplitude[:, None] * parts.rates(plane.omega, parts.flow(plane))
    dof = linear.degrees_of_freedom
    model = scene.compile()
    evaluator = _core.Evaluator(model)
    values = np.array(linear.state.values)
    still = np.array(_core.Evaluator(linear.model).derivative(0.0, values))
    for time in (0.0, 3.7):
        moved = np.array(evaluator.derivative(time, values)) - still
        found = linear.basis.T @ moved[model.twist_index(0) : model.twist_index(0) + 6]
        expected = (np.exp(1j * time * plane.omega) @ rates).real[dof : 2 * dof]
        assert found == pytest.approx(expected, abs=2e-3 * np.max(np.abs(expected)))


@pytest.mark.parametrize(("size", "factor"), [(1, np.sqrt(8.0 / np.pi)), (2, 1.5 * np.sqrt(np.pi / 2.0)),
                                              (3, 4.0 / 3.0 * np.sqrt(8.0 / np.pi))])  # fmt: skip
def test_the_mean_slope_of_drag_in_all_directions_alike(size: int, factor: float) -> None:
    """sqrt(8 / pi) sigma of one axis; of a common speed by the mean of a chi distribution."""
    shape = {1: "box", 2: "cylinder", 3: "sphere"}[size]
    found = mean_slope(np.array([3.0, 3.0, 3.0]), 0.49 * np.eye(3), shape=shape)
    assert np.diag(found)[-1] == pytest.approx(3.0 * 0.7 * factor, rel=1e-6)
    assert found == pytest.approx(np.diag(np.diag(found)), abs=1e-9)


def test_the_mean_slope_of_drag_errs_least_of_all_matrices() -> None:
    """By regression on a sample of a velocity that has a direction."""
    rng = np.random.default_rng(5)
    root = rng.normal(size=(3, 3))
    v = rng.normal(size=(400_000, 3)) @ root.T
    force = np.linalg.norm(v, axis=1, keepdims=True) * v
    best = np.linalg.lstsq(v, force, rcond=None)[0].T
    found = mean_slope(np.ones(3), root @ root.T, shape="sphere")
    assert found == pytest.approx(best, abs=0.02 * np.max(best))


DIRECTION = 0.5  # rad


def heave_by_hand(scene: Scene, spectrum: _core.Spectrum, omega: Array) -> tuple[float, float]:
    """Damping (N s/m) and standard deviation (m) of the heave of a box on a wire in deep water, by itself."""
    line, element = scene.loads["wire"], scene.loads["load.1"]
    stiffness, damping = EA / float(line.length.evaluate([0.0])[0, 0]), 0.0
    k, z = omega**2 / G, float(scene.bodies["load"].position[2])
    mean = np.sinh(0.5 * k * SIZE[2]) / (0.5 * k * SIZE[2])
    for share in 0.5 * k * SIZE[0] * np.cos(DIRECTION), 0.5 * k * SIZE[1] * np.sin(DIRECTION):
        mean *= np.where(share < np.pi, np.sin(share) / share, 0.0)
    water = 1j * omega * mean * np.exp(k * z)  # up, per metre of amplitude
    mass = MASS + added(scene)[2]
    steps = np.diff(omega)
    density = 0.5 * (np.append(steps, 0.0) + np.append(0.0, steps)) * spectrum.density(omega)
    for _ in range(500):
        push = ((RHO * FILL * 24.0 + added(scene)[2]) * 1j * omega + damping) * water
        heave = push / (stiffness - omega**2 * mass + 1j * omega * damping)
        over = 1j * omega * heave - water
        sigma = np.sqrt(np.sum(density * np.abs(over) ** 2))
        damping = 0.5 * damping + 0.5 * np.sqrt(8.0 / np.pi) * sigma * float(element.drag[2])
    return float(damping), float(np.sqrt(np.sum(density * np.abs(heave) ** 2)))


def test_drag_of_a_box_becomes_the_damping_of_its_sea() -> None:
    scene = hung(4.0)
    spectrum = jonswap(hs=3.0, tp=8.0)
    linear = drag_in_sea(linear_model(scene), spectrum=spectrum, direction=DIRECTION)
    omega = np.linspace(*spectrum.default_range, 4000)
    damping, heave = heave_by_hand(scene, spectrum, omega)
    assert linear.drag_damping["load.1"][2, 2] == pytest.approx(damping, rel=1e-3)
    told = response_statistics(scene, spectrum=spectrum, direction=DIRECTION, body="load")
    assert told.std[2] == pytest.approx(heave, rel=1e-3)


def test_drag_in_the_components_of_a_sea_is_that_in_its_spectrum() -> None:
    sea = {"hs": 3.0, "tp": 8.0, "direction_deg": np.degrees(DIRECTION), "seed": 2, "count": 400}
    scene = hung(4.0, sea=sea)
    linear = linear_model(scene)
    assert scene.waves is not None
    found = drag_in_components(linear, scene.waves).drag_damping["load.1"]
    expected = drag_in_sea(linear, spectrum=jonswap(hs=3.0, tp=8.0), direction=DIRECTION)
    assert found == pytest.approx(expected.drag_damping["load.1"], rel=0.03, abs=1.0)


def test_a_run_in_the_sea_heaves_as_the_linear_model_says() -> None:
    """A neutral sphere on a spring, along a rail, at its resonance: without drag it would heave far more."""
    scene = Scene(name="float", gravity=G)
    volume = np.pi / 6.0 * 27.0
    scene.add_body("load", mass=RHO * volume, size=(2.0, 2.0, 2.0), position=(0.0, 0.0, -8.0))
    stiffness = 1.5 * RHO * volume * (2.0 * np.pi / 8.0) ** 2
    scene.add_joint(
        kind="prismatic",
        name="rail",
        first="ground",
        second="load",
        point=(0.0, 0.0, -8.0),
        axis=(0.0, 0.0, 1.0),
    )
    scene.add_spring(
        "spring", first="ground", second="load", first_point=(0.0, 0.0, -108.0), stiffness=stiffness,
        natural_length=100.0,
    )  # fmt: skip
    scene.add_sea(vessel=None, hs=2.0, tp=8.0, direction_deg=0.0, seed=4, stretching="none")
    scene.add_immersed("load", parts=[SpherePart(diameter=3.0, drag=4.0)], density=RHO)
    spectrum = jonswap(hs=2.0, tp=8.0)
    told = response_statistics(scene, spectrum=spectrum, direction=0.0, body="load")
    with pytest.warns(UserWarning, match="variance of its resonance"):
        free = response_statistics(linear_model(scene), spectrum=spectrum, direction=0.0, body="load")
    result = simulate(scene, t_end=1500.0, dt_out=0.5, channels=["position"], rtol=1e-4)
    found = result.select("position", body="load", axis="z")[200:].std()
    assert found == pytest.approx(told.std[2], rel=0.08)
    assert free.std[2] > 1.5 * found


def test_the_response_to_a_realised_sea_is_that_of_a_run_in_small_waves() -> None:
    scene = hung(2.0, sea={"hs": 0.01, "tp": 6.0, "direction_deg": 20.0, "seed": 2, "stretching": "none"})
    linear = linear_model(scene)
    summed = response_summed(linear, body="load")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=20.0, dt_out=0.5, start=start, channels=["position"])
    rest = np.array(linear.state.values)[:3]
    expected = rest + summed.at(result.time)[:, :3]
    moved = float(np.abs(expected - rest).max())
    assert result.select("position", body="load") == pytest.approx(expected, abs=0.03 * moved)


def test_a_transfer_function_without_a_ship_is_of_the_parts_alone() -> None:
    scene = hung(6.0)
    rao = motion_rao(scene, omega=[0.8], direction=0.0, body="load")
    k, z = 0.64 / G, -7.0
    mean = np.sin(2.0 * k) / (2.0 * k) * np.sinh(k) / k
    water = -0.64 * mean * np.exp(k * z)  # acceleration upwards, per metre of amplitude
    stiffness = EA / float(scene.loads["wire"].length.evaluate([0.0])[0, 0])
    mass = RHO * FILL * 24.0 + added(scene)[2]
    expected = mass * water / (stiffness - 0.64 * (MASS + added(scene)[2]))
    assert rao[0, 2] == pytest.approx(expected, rel=1e-9)


def with_wire(depth: float, sea: dict[str, Any] | None = None, *, drag: float = 1.2) -> Scene:
    """A small weight below a wire with mass whose lower part is in water."""
    scene = Scene(name="wire", gravity=G)
    scene.add_body("load", mass=4e3, size=(1.0, 1.0, 1.0), position=(0.0, 0.0, -depth))
    scene.add_line(
        "wire", "ground", "load", first_point=(0.0, 0.0, 5.0), EA=5e6, rung="with mass", medium="sea",
        segments=4, mass_per_length=40.0, diameter=0.2, length=0.992 * (depth + 4.5), drag_coefficient=drag,
    )  # fmt: skip
    if sea is not None:
        scene.add_sea(vessel=None, **sea)
    return scene


def test_waves_on_a_line_in_a_linear_model_are_those_of_a_run_in_small_waves() -> None:
    sea = {"hs": 0.02, "tp": 7.0, "direction_deg": 30.0, "seed": 3, "stretching": "none"}
    scene = with_wire(25.0, sea, drag=0.0)
    linear = linear_model(scene)
    summed = response_summed(linear, body="load")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=15.0, dt_out=0.5, start=start, channels=["position"], rtol=1e-7)
    expected = result.select("position", body="load")[0] - summed.at(0.0)[:3] + summed.at(result.time)[:, :3]
    moved = float(np.abs(expected - expected.mean(axis=0)).max())
    assert moved > 1e-4
    assert result.select("position", body="load") == pytest.approx(expected, abs=2e-3 * moved)


def test_halves_of_spans_have_the_mass_and_the_drag_of_the_engine() -> None:
    """The added mass of all bodies less their own: by the model; what is dry has none."""
    linear = linear_model(with_wire(25.0))
    halves = PartsInWaves(linear).parts
    assert 1 < len(halves) < 8, "the upper end is on the ground, and one half at least is in air"
    scene = linear.scene
    mass = np.zeros_like(linear.mass)
    for body in scene.bodies.values():
        at = 6 * linear.bodies.index(body.name)
        mass[at : at + 3, at : at + 3] += body.mass * np.eye(3)
    for half in halves:
        at = 6 * linear.bodies.index(half.body)
        span = scene.loads[half.name.rpartition(".")[0]]
        ratio = span.added_mass_coefficient / (1.0 + span.added_mass_coefficient)
        across = half.axes[:, 1:] @ half.axes[:, 1:].T
        mass[at : at + 3, at : at + 3] += ratio * half.axes[:, 1] @ half.inertia @ half.axes[:, 1] * across
    translations = np.concatenate([6 * i + np.arange(3) for i in range(len(linear.bodies))])
    block = np.ix_(translations, translations)
    assert mass[block] == pytest.approx(linear.mass[block], rel=1e-9, abs=1e-6)


def test_drag_of_a_line_damps_in_its_sea() -> None:
    spectrum = jonswap(hs=2.0, tp=7.0)
    told = [
        response_statistics(with_wire(25.0, drag=drag), spectrum=spectrum, direction=0.3, body="load").std
        for drag in (1.2, 12.0)
    ]
    free = linear_model(with_wire(25.0))
    damped = drag_in_sea(free, spectrum=spectrum, direction=0.3)
    assert len(damped.drag_damping) == len(PartsInWaves(free).parts)
    rates = [np.linalg.eigvals(one.a).real.sum() for one in (free, damped)]
    assert rates[1] < rates[0] - 1e-3
    assert np.abs(told[1] / told[0] - 1.0).max() > 0.02


def test_a_line_in_a_current_is_refused_by_name() -> None:
    scene = with_wire(25.0)
    scene.add_sea(vessel=None, hs=0.0, current=Current(depth=0.0, speed=0.3, direction_deg=0.0))
    with pytest.raises(SceneError, match=r"immersed span 'wire.*': is in a current"):
        PartsInWaves(linear_model(scene))


def test_waves_on_what_crosses_the_surface_are_refused_by_name() -> None:
    with pytest.raises(
        SceneError, match=r"immersed part 'load.1': crosses the surface at rest, 1.* m deep of 2 m"
    ):
        motion_rao(hung(-1.0), omega=[0.8], direction=0.0, body="load")


@pytest.mark.filterwarnings("ignore::seacrane.warnings.UnstableRestWarning")  # it turns broadside
def test_a_current_and_compartments_are_refused_by_name() -> None:
    scene = hung(4.0)
    scene.add_sea(vessel=None, hs=0.0, current=Current(depth=0.0, speed=0.5, direction_deg=0.0))
    with pytest.raises(SceneError, match=r"'load\.1': is in a current"):
        motion_rao(scene, omega=[0.8], direction=0.0, body="load")
    scene = hung(4.0)
    scene.add_entrapped_water(
        "load",
        area=1.0,
        height=1.0,
        openings=[{"point": (0.0, 0.0, 0.0), "area": 0.1}],
        initial=1.0,
        air="free",
    )
    with pytest.raises(SceneError, match="entrapped water 'water in load': flows by the root of a head"):
        motion_rao(scene, omega=[0.8], direction=0.0, body="load")


# --- summaries, margins ---------------------------------------------------------------------------------


def test_the_static_load_of_what_hangs_in_water_is_that_of_the_scene_at_rest() -> None:
    result = simulate(
        hung(30.0), t_end=1.0, dt_out=0.5, start="rest", channels=["line_tension", "slack_margin"]
    )
    row = summary(result)["hoist tension wire"]
    assert row.static == pytest.approx(DRY - LIFT, rel=1e-6)
    assert row.factor == pytest.approx(1.0, abs=1e-5)
    assert result["slack_margin"] == pytest.approx(1.0, abs=1e-6)


def test_in_air_the_margin_is_over_the_weight_under_water() -> None:
    result = simulate(hung(-6.0), t_end=0.1, dt_out=0.1, start="rest", channels=["slack_margin"])
    assert result["slack_margin"][0] == pytest.approx(DRY / (DRY - LIFT), rel=1e-6)


def test_what_floats_has_no_margin() -> None:
    scene = hung(30.0, BoxPart(size=(6.0, 4.0, 2.0)))
    with pytest.raises(SceneError, match="channel 'slack_margin' is unknown to this scene"):
        simulate(scene, t_end=0.1, channels=["slack_margin"])


# --- stages ---------------------------------------------------------------------------------------------


def lowered(until: Any, **more: Any) -> Any:
    leg = CylinderPart(length=2.0, diameter=1.0, point=(0.0, 0.0, -1.5), axes=TILTED, strips=1)
    scene = hung(-4.0, BoxPart(size=SIZE, fill=FILL, point=(0.0, 0.0, 0.5)), leg)
    scene.add_winch("wire", lag=0.1)
    stages = [
        Stage(name="lower", until=until, maximum_duration=60.0, commands={"wire.rate": 0.5}),
        Stage(name="stop", duration=1.0, commands={"wire.rate": 0.0}),
    ]
    return simulate_stages(scene, stages, dt_out=0.1, start="rest", **more)


@pytest.mark.parametrize("name", ["load", "load.1"])
def test_a_stage_ends_at_the_depth_of_a_lowest_point(name: str) -> None:
    result = lowered(Until.depth(name, minimum=3.0), channels=["position", "quaternion", "immersed_depth"])
    found = result.select("immersed_depth", immersed=name)
    points = np.array(list(np.ndindex(2, 2, 2))) * SIZE - 0.5 * np.array(SIZE) + [0.0, 0.0, 0.5]
    if name == "load":  # both rims of the cylinder too
        angle = np.linspace(0.0, 2.0 * np.pi, 2001)
        rims = [[end, 0.5 * np.cos(one), 0.5 * np.sin(one)] for end in (-1.0, 1.0) for one in angle]
        points = np.concatenate([points, np.array(rims) @ TILTED.T + [0.0, 0.0, -1.5]])
    turns = Rotation.from_quat(np.asarray(result.select("quaternion", body="load")), scalar_first=True)
    lowest = [np.min(turn.apply(points)[:, 2]) for turn in turns]
    z = result.select("position", body="load", axis="z")
    assert found == pytest.approx(-(z + lowest), abs=1e-5)
    assert found[result.stage("lower")][-1] == pytest.approx(3.0, abs=1e-6)


def test_a_depth_of_nothing_wet_is_refused_by_name() -> None:
    with pytest.raises(SceneError, match=r"waits for immersed 'hook', .* there are load, load\.1, load\.2"):
        lowered(Until.depth("hook", minimum=3.0))


# --- scatter of coefficients ------------------------------------------------------------------------------

HEAVE, OMEGA, DEEP = 0.6, 0.9, np.array([20e3, 30e3, 50e3])  # m, rad/s, kg


def heaved(added_mass: float, drag: float) -> Scene:
    """On a stiff wire below a tip that heaves; coefficients times these."""
    scene = hung(
        4.0, BoxPart(size=SIZE, fill=FILL, added_mass=added_mass * DEEP, drag=2.5 * drag, source="tank")
    )
    scene.add_body("tip", mass=1e4, size=(1.0, 1.0, 1.0), position=(0.0, 0.0, HOOK))
    scene.add_joint(
        kind="prismatic", name="up", first="ground", second="tip", point=(0.0, 0.0, HOOK), axis=(0, 0, 1)
    )
    scene.add_driver(joint="up", curve=Curve.harmonic(amplitude=HEAVE, omega=OMEGA, phase=-0.5 * np.pi))
    del scene.loads["wire"]
    scene.add_line(
        "wire", first="tip", second="load", second_point=(0.0, 0.0, 1.0), EA=2e9, tension_at_start=DRY - LIFT
    )  # fmt: skip
    return scene


def test_scatter_of_coefficients_goes_into_the_least_pull_as_by_hand() -> None:
    """T = W + (M + A) z'' + b z' |z'|, at eight places of a Latin hypercube."""
    least = Kept(channel="line_tension", what="minimum", names={"line": "wire"}, after=12.0)
    over = LatinHypercube(ranges={"added_mass": (0.6, 1.4), "drag": (0.5, 1.5)}, count=8, seed=1)
    found = ensemble(heaved, over=over, keep={"least": least}, t_end=22.0, dt_out=0.05).dataset
    time = np.linspace(0.0, 2.0 * np.pi / OMEGA, 2001)
    speed, rate = HEAVE * OMEGA * np.sin(OMEGA * time), HEAVE * OMEGA**2 * np.cos(OMEGA * time)
    expected = [
        np.min(DRY - LIFT + (MASS + a * DEEP[2]) * rate + d * 0.5 * RHO * 2.5 * 12.0 * speed * np.abs(speed))
        for a, d in zip(found.added_mass.values, found.drag.values, strict=True)
    ]
    assert found.least.values == pytest.approx(expected, rel=0.03)
    assert np.ptp(found.least.values) > 0.05 * (DRY - LIFT)


# --- lift files, reports, pages --------------------------------------------------------------------------

EVERY_PART = """
[[body]]
name = "load"
mass_kg = 1000
inertia_kg_m2 = [1, 1, 1]

[[immersed]]
body = "load"
name = "wet"
density_kg_per_m3 = 1000

[[immersed.parts]]
kind = "box"
size_m = [1, 2, 0.5]
strips = [2, 1]
slam = 6
drag = 2
perforation = 0.2
fill = 0.5
added_mass_kg = [10, 20, 30]
source = "a tank"
point_m = [0.1, 0.2, 0.3]
axes = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]

[[immersed.parts]]
kind = "plate"
size_m = [1, 2]
thickness_m = 0.1
strips = [1, 2]
slam = 5.5
drag = 3
perforation = 0.1
added_mass_kg = [0, 0, 30]
source = "another tank"

[[immersed.parts]]
kind = "cylinder"
length_m = 3
diameter_m = 0.5
ends = ["open", "closed"]
wall_m = 0.02
flooded = true
strips = [4]
slam = 4
drag = 0.9
end_drag = 0.8

[[immersed.parts]]
kind = "sphere"
diameter_m = 0.4
drag = 0.4

[[immersed.parts]]
kind = "table"
height_m = 1
depths_m = [0, 1, 2]
volumes_m3 = [0, 0.5, 0.5]
added_masses_kg = [[0, 0, 0], [1, 2, 3], [2, 3, 4]]
drag_area_m2 = [0.1, 0.2, 0.3]
source = "a third"

[[entrapped_water]]
body = "load"
name = "in it"
density_kg_per_m3 = 1000
area_m2 = 0.5
height_m = 1
point_m = [0, 0, -0.5]
discharge_coefficient = 0.7
initial_m3 = 0.1
air = "shut"
exponent = 1.2
air_pressure_Pa = 2e5
openings = [{ point_m = [0, 0, -0.5], area_m2 = 0.01 }]

[[stage]]
name = "down"
until = [{ depth = "load", minimum_m = 5 }]
maximum_duration_s = 10
"""


def every_part() -> Scene:
    scene = Scene(name="every part")
    scene.add_body("load", mass=1000.0, inertia=(1.0, 1.0, 1.0))
    turned = ((0, -1, 0), (1, 0, 0), (0, 0, 1))
    tables = {
        "depths": (0, 1, 2),
        "volumes": (0, 0.5, 0.5),
        "added_masses": ((0, 0, 0), (1, 2, 3), (2, 3, 4)),
    }
    parts = [
        BoxPart(
            size=(1, 2, 0.5), strips=(2, 1), slam=6, drag=2, perforation=0.2, fill=0.5, source="a tank",
            added_mass=(10, 20, 30), point=(0.1, 0.2, 0.3), axes=turned,
        ),
        PlatePart(
            size=(1, 2), thickness=0.1, strips=(1, 2), slam=5.5, drag=3, perforation=0.1,
            added_mass=(0, 0, 30), source="another tank",
        ),
        CylinderPart(
            length=3, diameter=0.5, strips=4, slam=4, drag=0.9, end_drag=0.8, wall=0.02,
            ends=("open", "closed"), flooded=True,
        ),
        SpherePart(diameter=0.4, drag=0.4),
        TablePart(height=1, drag_area=(0.1, 0.2, 0.3), source="a third", **tables),
    ]  # fmt: skip
    scene.add_immersed("load", name="wet", parts=parts, density=1000.0)
    scene.add_entrapped_water(
        "load", name="in it", density=1000.0, area=0.5, height=1.0, point=(0, 0, -0.5), initial=0.1,
        air="shut", exponent=1.2, air_pressure=2e5, discharge_coefficient=0.7,
        openings=[{"point": (0, 0, -0.5), "area": 0.01}],
    )  # fmt: skip
    return scene


def test_every_word_of_parts_goes_through_lift_and_scene_files(tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    head = 'format = "seacrane lift"\nversion = 2\n\n[scene]\nname = "every part"\n'
    path.write_text(head + EVERY_PART, encoding="utf-8")
    lift, expected = Lift.load(path), every_part()
    assert lift.scene() == expected
    assert [stage.until for stage in lift.stages] == [(Until.depth("load", minimum=5.0),)]
    for kind in (BoxPart, PlatePart, CylinderPart, SpherePart, TablePart):
        (table,) = (line for line in EVERY_PART.split("kind = ") if line.startswith(f'"{kind.kind}"'))
        unsaid = {"point", "axes", "source"} if kind is not BoxPart else set()
        assert all(f"{one.name}" in table for one in fields(kind) if one.name not in unsaid)
    expected.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == expected


def test_the_report_of_a_scene_tells_where_coefficients_are_from() -> None:
    rows = dict(hung(4.0, BoxPart(size=SIZE, strips=(2, 2))).report()["elements"])
    (told,) = rows["coefficients in water"]
    assert told.startswith("load: ")
    assert "unverified" in told


def test_a_page_of_a_wet_load_has_water_without_ship_and_sea() -> None:
    assert not without_sea(hung(4.0))
    assert sea_words(hung(4.0)) == "calm water"
    dry = hung(4.0)
    del dry.loads["load.1"]
    assert without_sea(dry)


def test_waves_on_a_part_that_is_welded_on_a_body_load_its_carrier() -> None:
    """A light frame below the load, stepped as one with it: the same as the part on the load itself."""
    part = SpherePart(diameter=2.0, point=(0.0, 0.0, -2.0))
    one, two = hung(3.0, part), hung(3.0, part)
    del two.loads["load.1"]
    two.add_body("frame", mass=1e-2, size=(0.05, 0.05, 0.05), position=(0.0, 0.0, -6.0))
    two.add_joint(kind="weld", name="on", first="load", second="frame")
    two.add_immersed("frame", parts=[SpherePart(diameter=2.0)], density=RHO)
    found, expected = (motion_rao(scene, omega=[0.7], direction=0.4, body="load") for scene in (two, one))
    assert found == pytest.approx(expected, rel=1e-5, abs=1e-8)
