"""Cutting a part into several changes nothing that is an integral over it."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from seacrane import Scene, simulate
from seacrane.description.loads import changed
from seacrane.scene import Waves
from seacrane.water import BoxPart, CylinderPart
from seacrane.water.parts import Part

Array = NDArray[np.float64]
G, RHO = 9.80665, 1025.0
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11}


def pairs(rng: np.random.Generator) -> dict[str, tuple[list[Part], list[Part]]]:
    """A random part whole and cut: by strips of its own, or as parts that stand side by side."""
    size, cut = rng.uniform(0.8, 3.0, 3), tuple(int(n) for n in rng.integers(2, 4, 2))
    length, diameter = rng.uniform(1.0, 3.0, 2)
    plain: dict[str, Any] = {"drag": 0.0, "added_mass": (0.0, 0.0, 0.0), "source": "none", "fill": 0.7}
    half = size * (1.0, 1.0, 0.5)
    levels = [BoxPart(size=half, point=(0.0, 0.0, z), **plain) for z in (-0.25 * size[2], 0.25 * size[2])]
    return {
        "box": ([BoxPart(size=size, **plain)], [BoxPart(size=size, strips=cut, **plain)]),
        "levels": ([BoxPart(size=size, **plain)], list(levels)),
        "cylinder": tuple(  # type: ignore[dict-item]
            [CylinderPart(length=length, diameter=diameter, drag=0.0, strips=n)] for n in (1, cut[0])
        ),
    }


def load_on(parts: list[Part], center: float, turn: Rotation, waves: Waves | None = None) -> Array:
    """Force (N) and moment (N m) of the pressure about the body's origin, at rest, (6,)."""
    scene = Scene(name="cut", gravity=G, waves=waves)
    x, y, z, w = turn.as_quat()
    scene.add_body(
        "load", mass=1e7, inertia=(1e7, 1e7, 1e7), position=(0.0, 0.0, center), quaternion=(w, x, y, z),
        gravity=False,
    )  # fmt: skip
    for piece in scene.add_immersed("load", parts=parts, density=RHO):
        scene.loads[piece.name] = changed(piece, added_masses=0.0 * np.asarray(piece.added_masses))
    result = simulate(scene, t_end=0.1, dt_out=0.1, channels=["load_force", "load_moment"])
    rows = [np.asarray(result[name])[0].reshape(-1, 3).sum(axis=0) for name in ("load_force", "load_moment")]
    return np.concatenate(rows)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", ["box", "levels", "cylinder"])
def test_buoyancy_and_its_moment_are_those_of_the_whole_at_any_attitude(kind: str, seed: int) -> None:
    """Edges are round by a thousandth of each piece."""
    rng = np.random.default_rng(seed)
    whole, cut = pairs(rng)[kind]
    turn, center = Rotation.random(random_state=seed), float(rng.uniform(-0.6, 0.6))
    one, other = load_on(whole, center, turn), load_on(cut, center, turn)
    assert other == pytest.approx(one, rel=2e-3, abs=2e-3 * np.abs(one).max())


def wave(length: float, time_of_crest: float) -> Waves:
    """Of 0.1 m, long crests along a skew direction."""
    one, omega = np.ones(1), float(np.sqrt(2.0 * np.pi * G / length))
    return Waves(
        omega=omega * one, amplitude=0.1 * one, phase=omega * time_of_crest * one, direction=0.7 * one,
        hulls={}, stretching="none",
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("kind", ["box", "levels", "cylinder"])
def test_the_force_of_a_long_wave_is_that_on_the_whole(kind: str, seed: int) -> None:
    """Where the wave hardly changes over the part, so that no mean over it is left out: of second order in
    size over length. Strips only see the wave where they are."""
    rng = np.random.default_rng(seed)
    whole, cut = pairs(rng)[kind]
    turn, errors = Rotation.random(random_state=seed), []
    for length in (200.0, 400.0):
        at = wave(length, 1.3)
        still = load_on(whole, -6.0, turn)[:3]
        one, other = (load_on(parts, -6.0, turn, at)[:3] for parts in (whole, cut))
        errors.append(float(np.linalg.norm(other - one) / np.linalg.norm(one - still)))
    assert errors[0] < 1e-3
    assert errors[1] < 0.5 * errors[0] + 1e-9


@pytest.mark.parametrize("formulation", ["recursive", "redundant"])
def test_a_level_cylinder_falls_into_the_water_as_its_strips_do(formulation: str) -> None:
    """Coefficients are per length: added mass, drag and slam are shared. Along it nothing turns it."""
    runs = []
    for strips in (1, 5):
        scene = Scene(name="fall", gravity=G)
        scene.add_body(
            "load", mass=1500.0, inertia=(900.0,) * 3, position=(0.0, 0.0, 0.5), velocity=(0.0, 0.4, -3.0)
        )
        scene.add_immersed("load", parts=[CylinderPart(length=3.0, diameter=1.0, strips=strips)], density=RHO)
        runs.append(simulate(scene, 2.0, dt_out=0.1, formulation=formulation, **EXACT))
    one, other = runs
    assert other["position"] == pytest.approx(one["position"], abs=1e-7)
    lost = [run["load_state"].sum(axis=1) for run in runs]
    assert lost[1] == pytest.approx(lost[0], rel=1e-6, abs=1e-3)
    assert lost[0][-1] > 1e3
