"""What follows a load follows water: rest, statics, modes, linear models, stages, summaries of wet loads."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from dataclasses import fields, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import add_led
from scipy.spatial.transform import Rotation

from seacrane import (
    Curve,
    Lift,
    Result,
    Scene,
    SceneError,
    _core,
    ensemble,
    motion_rao,
    response_statistics,
    simulate,
)
from seacrane.accuracy.simpler_scenes import CASES, DESCRIBED, SHARES, SLOW, scattered
from seacrane.analysis import drag_in_sea, equilibrium, linear_model, natural_modes, response_summed
from seacrane.analysis.drag_in_sea import drag_in_components, mean_slope
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.answers import statics, summary
from seacrane.arrays import Array
from seacrane.description.wet_parts import immersed_parts
from seacrane.hydro import BoxPart, Compartment, CylinderPart, PlatePart, SpherePart, TablePart
from seacrane.hydro.parts.added_mass import sphere_table
from seacrane.hydro.parts.parts import Part
from seacrane.run import Stage, Until
from seacrane.sea import Current, jonswap

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


def test_at_rest_the_wire_carries_what_the_water_does_not() -> None:
    scene = hung(30.0)
    assert statics(scene)["hoist tension wire"] == pytest.approx(DRY - LIFT, rel=1e-9)
    result = simulate(scene, t_end=2.0, dt_out=0.5, start="rest", channels=["line_tension", "slack_margin"])
    assert result.select("line_tension", line="wire") == pytest.approx(DRY - LIFT, rel=1e-7)
    row = summary(result)["hoist tension wire"]
    assert row.static == pytest.approx(DRY - LIFT, rel=1e-6) and row.factor == pytest.approx(1.0, abs=1e-5)
    assert result["slack_margin"] == pytest.approx(1.0, abs=1e-6)
    dry = simulate(hung(-6.0), t_end=0.1, dt_out=0.1, start="rest", channels=["slack_margin"])
    assert dry["slack_margin"][0] == pytest.approx(DRY / (DRY - LIFT), rel=1e-6)


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


def test_a_load_on_a_wire_heaves_with_the_mass_of_the_water() -> None:
    scene = hung(30.0)
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
    found = natural_modes(scene).natural_period * slowest / (2.0 * np.pi)
    assert np.min(np.abs(found - 1.0)) < 2e-3


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


TILTED = np.linalg.qr(np.array([[1.0, 0.3, 0.2], [-0.2, 1.0, 0.1], [0.3, -0.1, 1.0]]))[0]
TILTED = TILTED * np.sign(np.linalg.det(TILTED))


@pytest.mark.parametrize("depth", [np.inf, 25.0])
@pytest.mark.parametrize(
    "part",
    [BoxPart(size=(5.0, 2.0, 1.0), point=(0.3, 0.2, -0.1), axes=TILTED, strips=(2, 1)),
     CylinderPart(length=5.0, diameter=1.0, axes=TILTED, strips=2),
     SpherePart(diameter=2.0, point=(1.0, -0.5, 0.0))],
    ids=lambda part: part.kind,
)  # fmt: skip
def test_waves_on_parts_are_those_of_the_engine(part: Part, depth: float) -> None:
    """Accelerations at rest in small waves, by the linear model and by the engine itself."""
    scene = hung(1.5, part, sea={"hs": 1e-3, "tp": 5.0, "direction_deg": 30.0, "seed": 3})
    scene.waves = replace(scene.waves, depth=depth)
    linear = linear_model(scene)
    parts, components = PartsInWaves(linear), scene.waves.components()
    amplitude = np.array(components.amplitude) * np.exp(1j * np.array(components.phase))
    plane = parts.waves(np.array(components.omega), np.array(components.direction), depth)
    rates = amplitude[:, None] * parts.rates(plane.omega, parts.flow(plane))
    dof, model, values = linear.degrees_of_freedom, scene.compile(), np.array(linear.state.values)
    evaluator, at = _core.Evaluator(model), model.twist_index(0)
    still = np.array(_core.Evaluator(linear.model).derivative(0.0, values))
    for time in (0.0, 3.7):
        moved = np.array(evaluator.derivative(time, values)) - still
        expected = (np.exp(1j * time * plane.omega) @ rates).real[dof : 2 * dof]
        found = linear.basis.T @ moved[at : at + 6]
        assert found == pytest.approx(expected, abs=2e-3 * np.max(np.abs(expected)))


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
    sea = {"hs": 3.0, "tp": 8.0, "direction_deg": np.degrees(DIRECTION), "seed": 2, "count": 400}
    wavy = hung(4.0, sea=sea)
    found = drag_in_components(linear_model(wavy), wavy.waves).drag_damping["load.1"]
    assert found == pytest.approx(linear.drag_damping["load.1"], rel=0.03, abs=1.0)


def with_wire(depth: float, sea: dict[str, Any] | None = None, *, drag: float = 1.2) -> Scene:
    """A small weight below a wire with mass whose lower part is in water."""
    scene = Scene(name="wire", gravity=G)
    scene.add_body("load", mass=4e3, size=(1.0, 1.0, 1.0), position=(0.0, 0.0, -depth))
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 5.0), EA=5e6, wire={"medium": "sea",
                   "segments": 4, "mass_per_length": 40.0, "diameter": 0.2, "drag_coefficient": drag},
                   length=0.992 * (depth + 4.5))  # fmt: skip
    if sea is not None:
        scene.add_sea(vessel=None, **sea)
    return scene


def test_waves_on_a_line_in_a_linear_model_are_those_of_a_run_in_small_waves() -> None:
    sea = {"hs": 0.02, "tp": 7.0, "direction_deg": 30.0, "seed": 3, "stretching": "none"}
    scene = with_wire(25.0, sea, drag=0.0)
    linear = linear_model(scene)
    summed = response_summed(linear, body="load")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=15.0, dt_out=0.5, start=start, rtol=1e-7)
    expected = result.select("position", body="load")[0] - summed.at(0.0)[:3] + summed.at(result.time)[:, :3]
    moved = float(np.abs(expected - expected.mean(axis=0)).max())
    assert moved > 1e-4
    assert result.select("position", body="load") == pytest.approx(expected, abs=2e-3 * moved)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.UnstableRestWarning")  # it turns broadside
def test_what_has_no_linear_model_is_refused_by_name() -> None:
    current = {"hs": 0.0, "current": Current(depth=0.0, speed=0.5, direction_deg=0.0)}
    filled = hung(4.0)
    hole = {"point": (0.0, 0.0, 0.0), "area": 0.1}
    water = Compartment(area=1.0, height=1.0, openings=[hole], initial=1.0, air="free")
    filled.add_immersed("load", inside=water)
    for scene, message in (
        (hung(-1.0), "'load.1': crosses the surface at rest, 1.* m deep of 2 m"),
        (hung(4.0, sea=current), "'load.1': is in a current"), (with_wire(25.0, current), "is in a current"),
        (filled, "'water in load': flows by the root"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=message):
            motion_rao(scene, omega=[0.8], direction=0.0, body="load")


def test_a_stage_ends_at_the_depth_of_the_lowest_point_of_all_parts() -> None:
    """Corners of the box, and both rims of the cylinder."""
    leg = CylinderPart(length=2.0, diameter=1.0, point=(0.0, 0.0, -1.5), axes=TILTED, strips=1)
    scene = hung(-4.0, BoxPart(size=SIZE, fill=FILL, point=(0.0, 0.0, 0.5)), leg)
    scene.add_winch("wire", lag=0.1)
    stage = Stage(name="lower", until=Until.depth("load", minimum=3.0), maximum_duration=60.0,
                  commands={"wire.rate": 0.5})  # fmt: skip
    channels = ["position", "quaternion", "immersed_depth"]
    result = simulate(scene, [stage], dt_out=0.1, start="rest", channels=channels)
    found = result.select("immersed_depth", immersed="load")
    corners = np.array(list(np.ndindex(2, 2, 2))) * SIZE - 0.5 * np.array(SIZE) + [0.0, 0.0, 0.5]
    angle = np.linspace(0.0, 2.0 * np.pi, 2001)
    rims = [[end, 0.5 * np.cos(one), 0.5 * np.sin(one)] for end in (-1.0, 1.0) for one in angle]
    points = np.concatenate([corners, np.array(rims) @ TILTED.T + [0.0, 0.0, -1.5]])
    turns = Rotation.from_quat(np.asarray(result.select("quaternion", body="load")), scalar_first=True)
    lowest = [np.min(turn.apply(points)[:, 2]) for turn in turns]
    z = result.select("position", body="load", axis="z")
    assert found == pytest.approx(-(z + lowest), abs=1e-5)
    assert found[result.stage("lower")][-1] == pytest.approx(3.0, abs=1e-6)


EVERY_WORD: dict[type[Part], dict[str, Any]] = {
    BoxPart: {
        "size": (1, 2, 0.5), "strips": (2, 1), "slam": 6, "drag": 2, "perforation": 0.2, "fill": 0.5,
        "added_mass": (10, 20, 30), "source": "a tank", "point": (0.1, 0.2, 0.3),
        "axes": ((0, -1, 0), (1, 0, 0), (0, 0, 1)),
    },
    PlatePart: {
        "size": (1, 2), "thickness": 0.1, "strips": (1, 2), "slam": 5.5, "drag": 3, "perforation": 0.1,
        "added_mass": (0, 0, 30), "source": "another tank",
    },
    CylinderPart: {
        "length": 3, "diameter": 0.5, "strips": 4, "slam": 4, "drag": 0.9, "end_drag": 0.8, "wall": 0.02,
        "ends": ("open", "closed"), "flooded": True,
    },
    SpherePart: {"diameter": 0.4, "drag": 0.4},
    TablePart: {
        "height": 1, "depths": (0, 1, 2), "volumes": (0, 0.5, 0.5), "drag_area": (0.1, 0.2, 0.3),
        "added_masses": ((0, 0, 0), (1, 2, 3), (2, 3, 4)), "source": "a third",
    },
}  # fmt: skip
UNITS = {
    "m": "size point thickness length diameter height wall depths", "m2": "drag_area", "m3": "volumes",
    "kg": "added_mass added_masses",
}  # fmt: skip
IN_FILES = {word: f"{word}_{unit}" for unit, words in UNITS.items() for word in words.split()}


def test_every_word_of_parts_goes_through_lift_and_scene_files(tmp_path: Path) -> None:
    def listed(value: Any) -> Any:
        return [listed(one) for one in value] if isinstance(value, tuple) else value

    for kind, words in EVERY_WORD.items():
        unsaid = set() if kind is BoxPart else {"point", "axes", "source"}
        assert {one.name for one in fields(kind)} - unsaid <= set(words)
    parts = [
        {"kind": kind.kind} | {IN_FILES.get(word, word): listed(value) for word, value in words.items()}
        for kind, words in EVERY_WORD.items()
    ]
    lift = Lift({
        "scene": {"name": "every part"},
        "body": [{"name": "load", "mass_kg": 1000, "inertia_kg_m2": [1, 1, 1]}],
        "immersed": [{"body": "load", "name": "wet", "density_kg_per_m3": 1000, "parts": parts}],
        "stage": [{"name": "down", "until": [{"depth": "load", "minimum_m": 5}], "maximum_duration_s": 10}],
    })  # fmt: skip
    scene = Scene(name="every part")
    scene.add_body("load", mass=1000.0, inertia=(1.0, 1.0, 1.0))
    made = [kind(**words) for kind, words in EVERY_WORD.items()]
    scene.add_immersed("load", name="wet", parts=made, density=1000.0)
    assert lift.scene() == scene
    assert [stage.until for stage in lift.stages] == [(Until.depth("load", minimum=5.0),)]
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene


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


LEAST = {"least": "line_tension[wire, after=12].min"}
HEAVE, OMEGA, DEEP = 0.6, 0.9, np.array([20e3, 30e3, 50e3])  # m, rad/s, kg


def heaved(added_mass: float, drag: float) -> Scene:
    """On a stiff wire below a tip that heaves; coefficients times these."""
    scene = hung(
        4.0, BoxPart(size=SIZE, fill=FILL, added_mass=added_mass * DEEP, drag=2.5 * drag, source="tank")
    )
    wave = Curve.harmonic(amplitude=HEAVE, omega=OMEGA, phase=-0.5 * np.pi)
    add_led(scene, "tip", wave, place=(0.0, 0.0, HOOK))
    del scene.loads["wire"]
    scene.add_line(
        "wire", first="tip", second="load", second_point=(0.0, 0.0, 1.0), EA=2e9, tension_at_start=DRY - LIFT
    )
    return scene


def least_pull(added: float, drag: float) -> float:
    """Of the heaved box, by hand: W + (M + A) z'' + b z' |z'|."""
    time = np.linspace(0.0, 2.0 * np.pi / OMEGA, 2001)
    speed, rate = HEAVE * OMEGA * np.sin(OMEGA * time), HEAVE * OMEGA**2 * np.cos(OMEGA * time)
    push = drag * 0.5 * RHO * 2.5 * 12.0 * speed * np.abs(speed)
    return float(np.min(DRY - LIFT + (MASS + added * DEEP[2]) * rate + push))


def test_each_coefficient_is_varied_by_its_share_as_by_hand() -> None:
    cases = [DESCRIBED, *CASES]
    with ThreadPoolExecutor(2) as pool:
        found = ensemble(
            partial(scattered, heaved(1.0, 1.0)), over={"case": cases}, keep=LEAST, t_end=22.0, dt_out=0.05,
            executor=pool,
        ).dataset.least  # fmt: skip
    less, heavy = 1.0 - SHARES["box"]["added_mass"], 1.0 + SHARES["box"]["added_mass"]
    few, much = 1.0 - SHARES["box"]["drag"], 1.0 + SHARES["box"]["drag"]
    by_hand = [least_pull(*one) for one in ((1, 1), (less, 1), (heavy, 1), (1, few), (1, much))]
    assert found.to_numpy() == pytest.approx(by_hand, rel=0.03)
    assert float(found[2] - found[0]) == pytest.approx(by_hand[2] - by_hand[0], rel=0.05)
    described = heaved(1.0, 1.0)
    more = scattered(described, "more added mass", shares={"box": {"added_mass": 0.1}})
    (own,) = immersed_parts(more).values()
    (part,) = immersed_parts(described).values()
    assert own.added_masses == pytest.approx(1.1 * np.asarray(part.added_masses))


def test_a_hemisphere_that_heaves_slowly_has_the_added_mass_of_hulme() -> None:
    """A half-wet sphere let go above its rest: with 0.8310 in place of 0.5 its period grows by the root of
    1.831 over 1.5."""

    def crossing(result: Result) -> float:
        return float(result.time[np.flatnonzero(result.select("position", body="buoy", axis="z") < 0.0)[0]])

    depths, fast = sphere_table()
    slow = sphere_table(slow=True)[1]
    assert [np.interp(1.0, depths, one) for one in (fast, slow)] == pytest.approx([0.5, 0.8310])
    assert slow[1] / fast[1] == pytest.approx(2.0, rel=2e-3), "a piston in a wall over a disc"
    assert slow[-2] == pytest.approx(1.0, abs=1e-3)
    scene, mass = Scene(name="buoy", gravity=G), RHO * np.pi / 12.0 * 8.0
    scene.add_body("buoy", mass=mass, inertia=(mass,) * 3, position=(0.0, 0.0, 0.05))
    scene.add_immersed("buoy", parts=[SpherePart(diameter=2.0, drag=0.0)], density=RHO)
    fast_one, slow_one = (
        crossing(simulate(scattered(scene, case), 2.0, dt_out=0.002, rtol=1e-8)) for case in (DESCRIBED, SLOW)
    )
    ratio = slow_one / fast_one
    assert ratio == pytest.approx(np.sqrt(1.831 / 1.5), rel=0.02)
