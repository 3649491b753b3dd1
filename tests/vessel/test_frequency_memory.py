"""The linear model with a database's own added mass and damping, and with a convolution."""

from __future__ import annotations

import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from test_vessel import complex_amplitude, regular_wave

from seacrane import (
    Scene,
    SceneError,
    cases,
    equilibrium,
    linear_model,
    load_database,
    motion_rao,
    natural_modes,
    response_statistics,
    simulate,
)
from seacrane.description.databases import without_databases
from seacrane.hydro import (
    HydroDatabase,
    motion_response,
    retardation_functions,
    shipped_database,
    vessel_parameters,
)
from seacrane.sea import jonswap

Array = NDArray[np.float64]
BEAM = np.pi / 2.0


def rao_of_vessel(database: HydroDatabase, heading: int) -> Array:
    """Of the vessel alone without springs, at the database's frequencies."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = cases.vessel(database=database, hs=0.0, mooring_period=None, memory="convolution")
    return motion_rao(
        scene, database=database, omega=database.omega, direction=database.heading[heading], body="vessel",
        memory="database",
    )  # fmt: skip


@pytest.mark.parametrize("heading", [7, 18])
def test_the_vessel_alone_moves_as_the_databases_matrices_say(heading: int) -> None:
    database = shipped_database()
    found, expected = rao_of_vessel(database, heading), motion_response(database)[heading]
    late = database.omega > 0.3
    limit = 1e-5 * np.abs(expected[late]).max(axis=0)
    np.testing.assert_array_less(np.abs(found - expected)[late].max(axis=0), limit + 1e-12)


def test_tanks_and_masses_beyond_a_rigid_body_are_in_it(shared: Path) -> None:
    """The supply ship's roll tanks, with the roll damping of the time domain; the tanker's mass matrix."""
    supply = load_database(shared / "veres" / "supply")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        tanker = load_database(shared / "wamit")
        functions = retardation_functions(database=supply)
        linear = vessel_parameters(supply, memory=functions).linear_damping
    alike = replace(supply, roll_damping=None, linear_damping=linear)
    for database, same in ((supply, alike), (tanker, tanker)):
        expected = motion_response(same)[7]
        found = rao_of_vessel(database, 7)
        late = database.omega > 0.3
        limit = 1e-3 * np.abs(expected[late]).max(axis=0)
        np.testing.assert_array_less(np.abs(found - expected)[late][:, 2:5].max(axis=0), limit[2:5])


def test_any_fitted_memory_gives_the_same() -> None:
    """What the scene's own memory is does not matter, nor whether a state is given."""
    database, omega = shipped_database(), [0.45, 0.55, 0.9]
    options = {"database": database, "omega": omega, "direction": 2.0, "body": "vessel", "memory": "database"}
    scenes = [
        cases.vessel(hs=0.0, memory=kind, mooring_period=None) for kind in ("none", "per-pair", "convolution")
    ]
    first, *others = (motion_rao(scene, **options) for scene in scenes)
    for other in others:
        np.testing.assert_allclose(other, first, rtol=1e-5)
    state = equilibrium(scenes[1])
    np.testing.assert_allclose(motion_rao(scenes[1], state=state, **options), first, rtol=1e-5)


def test_a_run_by_convolution_is_the_linear_model_by_convolution() -> None:
    """In a regular wave, springs included; the database's own matrices are as near as the kernel is."""
    database, omega = shipped_database(), 0.9
    scene = cases.vessel(hs=0.0, mooring_period=60.0, memory="convolution")
    calm = scene.copy()
    scene.waves = regular_wave(database, omega=omega, heading_deg=120.0, amplitude=1e-4, phase=0.0)
    period = 2.0 * np.pi / omega
    run = simulate(scene, t_end=500.0, dt_out=period / 16.0, rtol=1e-9, channels=["vessel_motion"])
    found = complex_amplitude(run, omega, start=500.0 - 6.0 * period) / 1e-4
    options = {"database": database, "omega": omega, "direction": np.radians(120.0), "body": "vessel"}
    by_kernel = motion_rao(calm, **options)
    by_data = motion_rao(calm, memory="database", **options)
    np.testing.assert_allclose(found, by_kernel, rtol=2e-3)
    np.testing.assert_allclose(by_kernel, by_data, rtol=5e-3)
    assert np.abs(by_kernel / by_data - 1.0).max() > 1e-5


def roll_at_resonance(scene: Scene, database: HydroDatabase, **options: object) -> complex:
    omega = np.linspace(0.45, 0.62, 86)
    rao = motion_rao(scene, omega=omega, direction=BEAM, body="vessel", **options)
    return complex(rao[int(np.abs(rao[:, 3]).argmax()), 3])


def test_springs_are_what_sets_roll_apart_from_the_free_vessel() -> None:
    """A run has soft springs, motions of a database have none: their damping, over 2 zeta, is 1.5 % of roll.
    The convolution itself is off by a twentieth of that."""
    database = shipped_database()
    moored = cases.vessel(hs=0.0, memory="convolution")
    free = cases.vessel(hs=0.0, memory="convolution", mooring_period=None)
    truth = roll_at_resonance(free, database, memory="database")
    springs = abs(roll_at_resonance(moored, database, memory="database") / truth - 1.0)
    kernel = abs(roll_at_resonance(free, database) / truth - 1.0)
    assert 0.01 < springs < 0.02
    assert kernel < 0.1 * springs


def test_modes_have_the_matrices_of_their_own_frequency() -> None:
    """lambda^2 (M + A(w)) + lambda B(w) + C is singular at w = Im lambda."""
    database = shipped_database()
    scene = cases.vessel(hs=0.0, mooring_period=None)
    modes = natural_modes(scene, memory="database", database=database)
    assert {modes.label(i) for i in range(len(modes.eigenvalues))} == {
        "vessel heave", "vessel roll", "vessel pitch",
    }  # fmt: skip
    memory = linear_model(scene, memory="database", database=database).memories[0]
    element, body = scene.vessels["vessel"], scene.bodies["vessel"]
    inner = np.array(element.added_mass) + database.mass_matrix
    assert body.mass == pytest.approx(database.mass_matrix[0, 0])
    for value in modes.eigenvalues:
        added, damping, stiffness = (x[0] for x in memory.matrices(np.array([value.imag])))
        matrix = (
            value**2 * (inner + added)
            + value * (damping + np.array(element.linear_damping))
            + stiffness
            + np.array(element.restoring)
        )
        size = np.sqrt(np.abs(np.diag(inner)) * abs(value) ** 2)
        singular = np.linalg.svd(matrix / np.outer(size, size))[1]
        assert singular[-1] < 1e-6 * singular[0]


def test_modes_of_a_lift_are_all_there() -> None:
    """Modes of crane and payload hardly know of the memory; those of the springs, below the table, stay."""
    database, scene = shipped_database(), cases.case2(hs=0.0)
    fitted = natural_modes(scene)
    found = natural_modes(scene, memory="database", database=database)
    mechanical = np.count_nonzero(fitted.mechanical_share > 0.5)
    assert len(found.eigenvalues) == mechanical
    for label in ("payload surge", "payload sway", "knuckle_jib surge"):
        mine, other = (modes.natural_period[modes.find(label)] for modes in (found, fitted))
        assert mine == pytest.approx(other, rel=1e-3)


@pytest.mark.slow("a real ship")
def test_statistics_take_it_too() -> None:
    database = shipped_database()
    scene = cases.vessel(hs=0.0, memory="convolution")
    options = {"database": database, "spectrum": jonswap(hs=2.0, tp=10.0), "direction": 2.0, "body": "vessel"}
    fitted, own = (response_statistics(scene, memory=kind, **options).std for kind in ("scene", "database"))
    np.testing.assert_allclose(fitted, own, rtol=5e-3)


def test_what_does_not_fit_is_refused_by_name(shared: Path) -> None:
    scene, database = cases.vessel(hs=0.0), shipped_database()
    with pytest.raises(SceneError, match="has no database, which memory='database' needs"):
        linear_model(without_databases(scene), memory="database")
    with pytest.raises(SceneError, match="'databse' is unknown to a linear model; choose scene or database"):
        linear_model(scene, memory="databse", database=database)
    other = load_database(shared / "veres" / "supply")
    with pytest.raises(SceneError, match=r"is from database 'hull_115' .digest"):
        linear_model(scene, memory="database", database=other)
    with pytest.raises(SceneError, match=r"vessel 'vessel': has a mass of 1\.4e"):
        linear_model(scene, memory="database", database=replace(other, speed=2.0))
    linear = linear_model(scene, memory="database", database=database)
    with pytest.raises(SceneError, match="whose past is not in x"):
        linear.full_state(np.zeros(len(linear.a)))
    with pytest.raises(SceneError, match="a LinearModel has its memory already"):
        motion_rao(linear, database=database, omega=0.5, direction=0.0, body="vessel", memory="database")
