"""What follows a load follows water: rest, statics, modes, linear models, stages, summaries of wet loads."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import (
    Scene,
    SceneError,
    Stage,
    Until,
    _core,
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
from seacrane.analysis.drag_in_sea import mean_slope
from seacrane.analysis.parts_in_waves import PartsInWaves
from seacrane.sea import jonswap
from seacrane.water import BoxPart, CylinderPart, SpherePart
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
        EA=EA, tension_at_start=DRY - LIFT,
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
    sea = {"hs": 1e-3, "tp": 5.0, "direction_deg": 30.0, "seed": 3, "depth": depth, "minimum_energy": 0.0}
    del sea["minimum_energy"]
    scene = hung(1.5, part, sea=sea)
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
