"""What tests of loads in water share: a load that swings, and checks that any wet scene stands."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from seacrane import Scene, _core
from seacrane.arrays import Array
from seacrane.hydro import BoxPart, CylinderPart, PlatePart, SpherePart, TablePart
from seacrane.hydro.parts.parts import Part
from seacrane.run.lanes import module_of

G, RHO = 9.80665, 1025.0
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11}
ALIKE = {"position": 1e-7, "load_state": (1e-3, 1e-5)}  # in both formulations
SWINGS = {"mass": 4000.0, "angular_velocity": (0.3, -0.2, 0.4), "velocity": (0.62, 0.97, 0.02)}


def quaternion(turn: Rotation) -> tuple[float, ...]:
    """Scalar first."""
    x, y, z, w = turn.as_quat()
    return w, x, y, z


def random_parts(rng: np.random.Generator) -> Iterator[Part]:
    """Of all kinds."""

    def place() -> dict[str, Any]:
        turn = Rotation.random(random_state=int(rng.integers(1 << 30))).as_matrix()
        return {"point": rng.uniform(-1.0, 1.0, 3), "axes": turn}

    yield BoxPart(size=rng.uniform(0.5, 2.0, 3), strips=(2, 1), perforation=0.15, fill=0.6, **place())
    yield CylinderPart(length=3.0, diameter=0.7, end_drag=0.8, slam=5.15, **place())
    yield SpherePart(diameter=1.3, **place())
    yield PlatePart(size=(2.0, 1.5), thickness=0.1, **place())
    yield TablePart(
        height=1.0, depths=(0.0, 0.4, 1.0, 2.0), volumes=(0.0, 0.3, 0.8, 0.8), drag_area=(1.0, 2.0, 3.0),
        added_masses=((0.0, 0.0, 0.0), (50.0, 60.0, 200.0), (110.0, 150.0, 350.0), (120.0, 180.0, 400.0)),
        source="this test", **place(),
    )  # fmt: skip


def hung_on_links(hook: float = 4.0, **load: Any) -> Scene:
    """A load without water yet that swings on two links."""
    scene = Scene(name="hanging", gravity=G)
    scene.add_body(name="hook", mass=300.0, inertia=(50.0, 60.0, 70.0), position=(0.5, 0.2, hook))
    scene.add_body(name="load", inertia=(3000.0, 4000.0, 5000.0), position=(1.0, 0.0, 0.3), **SWINGS | load)
    scene.add_joint(kind="distance", name="rope", first="ground", second="hook", point=(0.0, 0.0, 10.0),
                    second_point=(0.5, 0.2, hook))  # fmt: skip
    eye = (0.6, 0.2, hook - 1.0)
    scene.add_joint(kind="spherical", name="eye", first="hook", second="load", point=eye)
    return scene


def has_the_jacobian_of_differences(
    scene: Scene, time: float, error: float, change: Callable[[Any, Array], None] | None = None
) -> None:
    """That of the redundant form, by central differences of two steps."""
    model = scene.compile()
    evaluator = _core.Evaluator(model, "redundant")
    y = np.asarray(evaluator.project(time, model.initial_state))
    if change is not None:
        change(model, y)
    found, expected = np.asarray(evaluator.jacobian(time, y)), np.empty((len(y), len(y)))
    for i, e in enumerate(np.eye(len(y))):
        wide, near = (
            (np.array(evaluator.derivative(time, y + h * e)) - evaluator.derivative(time, y - h * e))
            / (2.0 * h)
            for h in (2e-5, 1e-5)
        )
        expected[:, i] = (4.0 * near - wide) / 3.0
    scale = np.max(np.abs(expected), axis=1, keepdims=True) + 1.0
    assert np.max(np.abs(found - expected) / scale) < error


def lanes_are_as_alone(scenes: list[Scene], time: float) -> Array:
    """To rounding; derivatives of each alone."""
    evaluator = _core.LaneEvaluator(module_of(4), [scene.compile() for scene in scenes])
    state = evaluator.start() + 1e-3 * np.random.default_rng(1).normal(size=evaluator.start().shape)
    alone = np.asarray(evaluator.scalar_derivative(time, state))
    apart = np.abs(evaluator.derivative(time, state) - alone) / np.abs(alone).max(axis=1)[:, None]
    assert apart.max() < 1e-11
    return alone


def masses(scene: Scene, mass: float, inertia: tuple[float, ...], turn: Rotation) -> tuple[Array, Array]:
    """Mass matrix of the one body of a scene, and that without water."""
    model = scene.compile()
    found = np.asarray(_core.Evaluator(model, "redundant").terms(0.0, model.initial_state)["mass"])
    expected = np.zeros((6, 6))
    r = turn.as_matrix()
    expected[:3, :3], expected[3:, 3:] = mass * np.eye(3), r @ np.diag(inertia) @ r.T
    return found, expected


def shifted(matrix: Array, lever: Array) -> Array:
    """Six by six of a mass (3, 3) at a lever."""
    a = lever
    skew = np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])
    shift = np.hstack([np.eye(3), -skew])
    return np.asarray(shift.T @ matrix @ shift)
