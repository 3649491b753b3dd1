"""Moorings by one argument: a period, a matrix or springs, and those that databases hold already."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Lift, Scene, SceneError, linear_model
from seacrane.arrays import Array
from seacrane.description.outline import outline_of
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.scene import MooringSpring, mooring_matrix
from seacrane.warnings import OwnMooringWarning

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
    c, s = np.cos(heading), np.sin(heading)
    turn = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    both = np.kron(np.eye(2), turn)
    return np.asarray(both @ fixed @ both.T)


@pytest.mark.parametrize("heading", [0.0, 130.0])
def test_springs_and_a_matrix_with_all_its_couplings_act_as_given(heading: float) -> None:
    """The matrix is of a symmetric mooring, beside what it adds to heave, roll and pitch."""
    pose: dict[str, Any] = {"position": (30.0, -20.0, 0.0), "heading_deg": heading}
    free = stiffness(vessel(mooring=None, **pose))
    for springs in (FOUR, SYMMETRIC):
        wanted = mooring_matrix(springs)
        held = stiffness(vessel(mooring=springs, **pose)) - free
        assert np.abs(held - wanted).max() <= 1e-5 * np.abs(wanted).max()
    for (i, j), value in {(2, 2): 2e4, (2, 4): 1e5, (4, 2): 1e5, (4, 4): 3e7}.items():
        wanted[i, j] += value
    scene = vessel(mooring=wanted, **pose)
    size = np.sqrt(np.outer(np.diagonal(wanted), np.diagonal(wanted)))
    assert np.all(np.abs(stiffness(scene) - free - wanted) <= 1e-5 * size)
    assert len(scene.springs) == 2


def test_a_matrix_that_couples_nothing_needs_no_springs_and_damping_is_a_share_of_critical() -> None:
    held = vessel(mooring=np.diag([1e5, 2e5, 3e4, 0.0, 1e6, 4e8]))
    water = vessel().vessels["vessel"].restoring
    assert not held.springs
    assert np.array_equal(held.vessels["vessel"].mooring_stiffness, [1e5, 2e5, 4e8])
    assert np.allclose(held.vessels["vessel"].restoring - water, np.diag([0, 0, 3e4, 0, 1e6, 0]), rtol=1e-9)
    assert vessel(mooring=200.0) == vessel()
    wanted = mooring_matrix(SYMMETRIC)
    period = vessel(mooring_damping=0.2).vessels["vessel"]
    damped = vessel(mooring=wanted, mooring_damping=0.2).vessels["vessel"]
    critical = period.mooring_damping / (0.2 * np.sqrt(period.mooring_stiffness))
    assert np.allclose(damped.mooring_damping, 0.2 * critical * np.sqrt(np.diagonal(wanted)[[0, 1, 5]]))


def with_own(database: HydroDatabase, matrix: Array) -> HydroDatabase:
    return replace(database, restoring=database.restoring + matrix)


@pytest.mark.warns("NonPassiveMemoryWarning")
def test_the_mooring_of_a_database_is_used_once() -> None:
    database, own = shipped_database(), mooring_matrix(SYMMETRIC)
    bare = stiffness(vessel(database, mooring=None))
    with pytest.warns(OwnMooringWarning, match="C11 = "):
        scene = vessel(with_own(database, own))
    assert np.abs(stiffness(scene) - bare - own).max() <= 1e-9 * own.max()
    moored = with_own(database, np.diag([1e5, 2e5, 0, 0, 0, 3e8]))
    assert np.array_equal(moored.without_mooring().restoring, database.restoring)
    with pytest.raises(SceneError, match=r"holds a mooring already.*without_mooring"):
        vessel(moored, mooring=FOUR)
    assert vessel(moored.without_mooring(), mooring=FOUR) == vessel(database, mooring=FOUR)
    rounding = vessel(with_own(database, np.diag([1e-6, 0, 0, 0, 0, 0])).without_mooring())
    usual = vessel().vessels["vessel"].mooring_stiffness
    assert np.array_equal(rounding.vessels["vessel"].mooring_stiffness, usual)
    odd = np.zeros((6, 6))
    odd[0, 4] = odd[4, 0] = 1e5  # a coupling without its spring is no mooring
    scene = vessel(with_own(database, odd))
    with pytest.raises(SceneError, match=r"restoring\(0, 4\)"):
        scene.compile()
    assert not scene.springs


def test_what_is_no_mooring_is_refused() -> None:
    twist = np.diag([1e5, 1e5, 0, 1e7, 1e7, 1e8])
    twist[0, 3] = twist[3, 0] = 1e5
    for mooring, words in (
        (-5.0, "period of -5"), (np.diag([1e5, -2e5, 0, 0, 0, 1e8]), "negative stiffness"),
        (np.eye(6) + np.eye(6, k=1), "symmetric"), (twist, "C14"),
    ):  # fmt: skip
        with pytest.raises(SceneError, match=words):
            vessel(mooring=mooring)


def test_files_hold_matrices_and_springs(tmp_path: Path) -> None:
    scene = vessel(mooring=FOUR)
    assert outline_of(scene)["links"] == []  # drawings leave the far ends out
    rows = ", ".join(str(row) for row in mooring_matrix(SYMMETRIC).tolist())
    entry = "{{ point_m = {}, direction_deg = {}, stiffness_N_per_m = {} }}"
    springs = ", ".join(entry.format(list(s.point), s.direction_deg, s.stiffness) for s in FOUR)
    head = 'format = "seacrane lift"\nversion = 2\n[vessel]\ndatabase = "hull_115"\nmemory = "none"\n'
    for key, mooring in (("mooring", mooring_matrix(SYMMETRIC)), ("mooring_springs", FOUR)):
        value = rows if key == "mooring" else springs
        (tmp_path / "lift.toml").write_text(f"{head}{key} = [{value}]\n")
        assert Lift.load(tmp_path / "lift.toml").scene().springs == vessel(mooring=mooring).springs
