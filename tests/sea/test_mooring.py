"""Moorings by one argument: a period, a matrix or springs, and those that databases hold already."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Lift, Scene, SceneError, linear_model, simulate
from seacrane.description.outline import outline_of
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.scene import MooringSpring, mooring_matrix
from seacrane.warnings import OwnMooringWarning

Array = NDArray[np.float64]
FOUR = [
    MooringSpring(point=(x, y, z), direction_deg=angle, stiffness=k)
    for x, y, z, angle, k in (
        (50.0, 10.0, 4.0, 40.0, 6e4), (52.0, -10.0, 4.0, -35.0, 5e4),
        (-50.0, 10.0, 3.0, 150.0, 4e4), (-48.0, -10.0, 3.0, -140.0, 7e4),
    )
]  # fmt: skip
SYMMETRIC = [
    MooringSpring(point=(x, side * 10.0, 4.0), direction_deg=side * angle, stiffness=6e4)
    for x, angle in ((50.0, 40.0), (-45.0, 140.0)) for side in (1, -1)
]  # fmt: skip


def vessel(database: HydroDatabase | None = None, **options: Any) -> Scene:
    scene = Scene(name="moored")
    database = shipped_database() if database is None else database
    scene.add_vessel(database, memory="none", **options)
    return scene


def stiffness(scene: Scene) -> Array:
    """(6, 6) of the vessel at the start, in its own axes, weight and buoyancy included."""
    model = linear_model(scene)
    n, basis = model.degrees_of_freedom, model.basis
    inertia = basis.T @ model.mass @ basis
    fixed = -basis @ inertia @ model.a[n : 2 * n, :n] @ basis.T
    heading = 2.0 * np.arctan2(*np.asarray(scene.bodies["vessel"].quaternion)[[3, 0]])
    turn = np.array(
        [[np.cos(heading), np.sin(heading), 0], [-np.sin(heading), np.cos(heading), 0], [0, 0, 1]]
    )
    both = np.kron(np.eye(2), turn)
    return np.asarray(both @ fixed @ both.T)


@pytest.mark.parametrize("springs", [FOUR, SYMMETRIC], ids=["four", "symmetric"])
@pytest.mark.parametrize("heading", [0.0, 130.0])
def test_springs_have_the_assembled_matrix(springs: list[MooringSpring], heading: float) -> None:
    pose: dict[str, Any] = {"position": (30.0, -20.0, 0.0), "heading_deg": heading}
    free = vessel(mooring_period=None, **pose)
    held = stiffness(vessel(mooring=springs, **pose)) - stiffness(free)
    wanted = mooring_matrix(springs)
    assert np.abs(held - wanted).max() <= 1e-5 * np.abs(wanted).max()


@pytest.mark.parametrize("heading", [0.0, 130.0])
def test_a_matrix_acts_as_it_is_given(heading: float) -> None:
    """Of a symmetric mooring, with all its couplings, beside what it adds to heave, roll and pitch."""
    pose: dict[str, Any] = {"position": (30.0, -20.0, 0.0), "heading_deg": heading}
    wanted = mooring_matrix(SYMMETRIC)
    wanted[2, 2] += 2e4
    wanted[2, 4] += 1e5
    wanted[4, 2] += 1e5
    wanted[4, 4] += 3e7
    scene = vessel(mooring=wanted, **pose)
    held = stiffness(scene) - stiffness(vessel(mooring_period=None, **pose))
    size = np.sqrt(np.outer(np.diagonal(wanted), np.diagonal(wanted)))
    assert np.all(np.abs(held - wanted) <= 1e-5 * size)
    assert len(scene.springs) == 2


def test_a_matrix_that_couples_nothing_needs_no_springs() -> None:
    scene = vessel(mooring=np.diag([1e5, 2e5, 3e4, 0.0, 1e6, 4e8]))
    water = vessel().vessels["vessel"].restoring
    held = scene.vessels["vessel"]
    assert not scene.springs
    assert np.array_equal(held.mooring_stiffness, [1e5, 2e5, 4e8])
    assert np.allclose(held.restoring - water, np.diag([0, 0, 3e4, 0, 1e6, 0]), rtol=1e-9)


def test_a_number_is_a_period() -> None:
    assert vessel(mooring=90.0) == vessel(mooring_period=90.0)


def test_springs_and_their_matrix_move_the_vessel_alike() -> None:
    """A drifting vessel, 40 s: second order in the motion apart."""
    runs = []
    for mooring in (SYMMETRIC, mooring_matrix(SYMMETRIC)):
        scene = vessel(mooring=mooring)
        scene.replace("vessel", kind="body", velocity=(0.3, 0.2, 0.0), angular_velocity=(0, 0, 0.002))
        runs.append(simulate(scene, t_end=40.0, dt_out=1.0)["vessel_motion"])
    scale = np.abs(runs[0]).max(axis=0)
    assert np.all(np.abs(runs[1] - runs[0]).max(axis=0)[[0, 1, 5]] < 0.02 * scale[[0, 1, 5]])


def test_damping_is_a_share_of_critical() -> None:
    wanted = mooring_matrix(SYMMETRIC)
    period = vessel(mooring_damping=0.2).vessels["vessel"]
    held = vessel(mooring=wanted, mooring_damping=0.2).vessels["vessel"]
    critical = period.mooring_damping / (0.2 * np.sqrt(period.mooring_stiffness))
    assert np.allclose(held.mooring_damping, 0.2 * critical * np.sqrt(np.diagonal(wanted)[[0, 1, 5]]))


def with_own(database: HydroDatabase, matrix: Array) -> HydroDatabase:
    return replace(database, restoring=database.restoring + matrix)


@pytest.mark.warns("NonPassiveMemoryWarning")
def test_the_mooring_of_a_database_is_used_once() -> None:
    database, own = shipped_database(), mooring_matrix(SYMMETRIC)
    bare = stiffness(vessel(database, mooring_period=None))
    with pytest.warns(OwnMooringWarning, match="C11 = "):
        scene = vessel(with_own(database, own))
    assert np.abs(stiffness(scene) - bare - own).max() <= 1e-9 * own.max()


@pytest.mark.warns("NonPassiveMemoryWarning")
@pytest.mark.parametrize("second", [{"mooring": 100.0}, {"mooring": FOUR}, {"mooring_period": 90.0}])
def test_a_second_mooring_is_refused(second: dict[str, Any]) -> None:
    database = with_own(shipped_database(), np.diag([1e5, 2e5, 0, 0, 0, 3e8]))
    with pytest.raises(SceneError, match=r"holds a mooring already.*without_mooring"):
        vessel(database, **second)
    plain = vessel(database.without_mooring(), **second)
    assert plain == vessel(replace(database, restoring=shipped_database().restoring), **second)


@pytest.mark.warns("NonPassiveMemoryWarning")
def test_a_coupling_without_its_spring_is_no_mooring() -> None:
    odd = np.zeros((6, 6))
    odd[0, 4] = odd[4, 0] = 1e5
    scene = vessel(with_own(shipped_database(), odd))
    with pytest.raises(SceneError, match=r"restoring\(0, 4\)"):
        scene.compile()
    assert not scene.springs


def test_rounding_is_no_mooring() -> None:
    scene = vessel(with_own(shipped_database(), np.diag([1e-6, 0, 0, 0, 0, 0])).without_mooring())
    assert np.array_equal(
        scene.vessels["vessel"].mooring_stiffness, vessel().vessels["vessel"].mooring_stiffness
    )


def test_without_mooring_gives_the_water_back() -> None:
    database = shipped_database()
    moored = with_own(database, np.diag([1e5, 2e5, 0, 0, 0, 3e8]))
    assert np.array_equal(moored.without_mooring().restoring, database.restoring)


@pytest.mark.parametrize(
    ("mooring", "words"),
    [
        ("soft", "natural period"),
        (-5.0, "period of -5"),
        (np.ones((3, 3)), "shape"),
        (np.diag([1e5, -2e5, 0, 0, 0, 1e8]), "negative stiffness"),
        (np.eye(6) + np.eye(6, k=1), "symmetric"),
        ([1.0, 2.0], "natural period"),
    ],
)
def test_what_is_no_mooring_is_refused(mooring: Any, words: str) -> None:
    with pytest.raises(SceneError, match=words):
        vessel(mooring=mooring)


def test_a_twist_is_refused() -> None:
    matrix = np.diag([1e5, 1e5, 0, 1e7, 1e7, 1e8])
    matrix[0, 3] = matrix[3, 0] = 1e5
    with pytest.raises(SceneError, match="C14"):
        vessel(mooring=matrix)


def test_two_arguments_for_one_mooring_are_refused() -> None:
    with pytest.raises(SceneError, match="both given"):
        vessel(mooring=FOUR, mooring_period=90.0)


def test_a_spring_has_a_stiffness() -> None:
    with pytest.raises(SceneError, match="stiffness is 0"):
        MooringSpring(point=(0, 0, 0), direction_deg=0.0, stiffness=0.0)


def test_a_scene_with_springs_is_saved(tmp_path: Any) -> None:
    scene = vessel(mooring=FOUR)
    scene.save(tmp_path / "moored.json")
    assert Scene.load(tmp_path / "moored.json") == scene


def test_drawings_leave_the_far_ends_out() -> None:
    assert outline_of(vessel(mooring=FOUR))["links"] == []


def test_lift_files_hold_matrices_and_springs(tmp_path: Any) -> None:
    rows = ", ".join(str(row) for row in mooring_matrix(SYMMETRIC).tolist())
    springs = ", ".join(
        f"{{ point_m = {list(s.point)}, direction_deg = {s.direction_deg}, "
        f"stiffness_N_per_m = {s.stiffness} }}"
        for s in FOUR
    )
    for key, mooring in (
        (f"mooring = [{rows}]", mooring_matrix(SYMMETRIC)),
        (f"mooring_springs = [{springs}]", FOUR),
    ):
        file = tmp_path / "lift.toml"
        file.write_text(
            'format = "seacrane lift"\nversion = 2\n[vessel]\ndatabase = "hull_115"\nmemory = "none"\n'
            f"{key}\n"
        )
        assert Lift.load(file).scene().springs == vessel(mooring=mooring).springs
