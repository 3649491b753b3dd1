"""Bodies with hydrodynamics that float, and those that weigh."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane import Scene, balance, equilibrium, simulate

MASS, DEPTH, EA = 100e3, 500.0, 4e8
ADDED = np.diag([80e3] * 3 + [1e5] * 3)
DRAG = np.diag([0, 0, 2e5, 0, 0, 0])
AFLOAT = np.diag([0, 0, 2e6, 4e7, 4e7, 0])


def submerged(**hydrodynamics: object) -> Scene:
    scene = Scene(name="submerged load")
    scene.add_body(name="load", mass=MASS, inertia=(4e5, 4e5, 4e5), position=(0, 0, -DEPTH))
    scene.add_vessel(body="load", **{"added_mass": ADDED, "linear_damping": DRAG} | hydrodynamics)
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=EA, length=DEPTH)
    return scene


def test_it_accelerates_with_its_added_mass() -> None:
    scene = submerged()
    scene.remove("wire")
    fall = simulate(scene, t_end=0.1).select("velocity", body="load", axis="z")[-1]
    assert fall == pytest.approx(-0.1 * MASS * scene.gravity / (MASS + ADDED[2, 2]), rel=0.1)


@pytest.mark.parametrize("floats", [None, True, False])
def test_statics_and_balance_know_its_weight_and_files_it(floats: bool | None, tmp_path: Path) -> None:
    scene = submerged() if floats is None else submerged(floats=floats)
    weight = 0.0 if floats else MASS * scene.gravity
    rest = simulate(scene, t_end=0.01, start=equilibrium(scene))
    assert rest.select("line_tension", line="wire")[0] == pytest.approx(weight, rel=1e-6, abs=1e-3 * MASS)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json").vessels["load"].floats == bool(floats)
    scene.remove("wire")
    scene.add_joint(
        kind="distance", name="rod", first="ground", second="load", point=(0, 0, 0),
        second_point=(0, 0, -DEPTH),
    )  # fmt: skip
    if not floats:
        assert balance(scene).weight == pytest.approx(weight)


def heaved(**hydrodynamics: object) -> np.ndarray:
    scene = Scene(name="buoy")
    scene.add_body(name="buoy", mass=MASS, inertia=(4e5, 4e5, 4e5), position=(0, 0, 0.5))
    scene.add_vessel(body="buoy", **{"added_mass": ADDED, "restoring": AFLOAT} | hydrodynamics)
    return np.asarray(simulate(scene, t_end=10.0).select("position", body="buoy", axis="z"))


def test_what_heave_restores_floats_as_before() -> None:
    np.testing.assert_array_equal(heaved(), heaved(floats=True))
    assert abs(heaved()).max() <= 0.5 + 1e-6
    assert heaved(floats=False).min() < -0.5  # its weight comes on top
