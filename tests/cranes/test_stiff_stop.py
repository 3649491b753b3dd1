"""A load that falls on a stiff stop: no method may pass through it, whatever its error estimate sees."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Scene, _core, simulate

Array = NDArray[np.float64]
DROP, MASS, G = 1.0, 1e4, 9.80665


def falling(stiffness: float) -> Scene:
    """A load 1 m above a spring that only pushes: a table of force over its length from far above."""
    scene = Scene(name="stop")
    scene.add_body(name="load", mass=MASS, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, DROP))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="load", point=(0, 0, DROP))
    far = 100.0
    scene.add_spring(
        name="stop", first="ground", second="load", first_point=(0.0, 0.0, -far),
        lengths=[far - 50.0, far, far + 50.0], forces=[-50.0 * stiffness, 0.0, 0.0],
    )  # fmt: skip
    return scene


@cache
def exact(stiffness: float) -> Array:
    """Height at every 0.02 s: parabolas, and half a swing on the spring about its static deflection."""
    speed, omega = np.sqrt(2.0 * G * DROP), np.sqrt(stiffness / MASS)
    sag = G / omega**2
    contact = (2.0 / omega) * (np.pi - np.arctan2(speed, sag * omega))
    flight = 2.0 * speed / G
    t = np.arange(0.0, 2.0 + 1e-9, 0.02)
    since = np.mod(t - 0.5 * flight, contact + flight)
    on = since < contact
    swing = -sag + sag * np.cos(omega * since) - speed / omega * np.sin(omega * since)
    airborne = since - contact
    return np.asarray(
        np.where(t < 0.5 * flight, DROP - 0.5 * G * t**2,
                 np.where(on, swing, speed * airborne - 0.5 * G * airborne**2))
    )  # fmt: skip


def deepest(stiffness: float) -> float:
    """All of the fall's energy in the spring, m."""
    sag = MASS * G / stiffness
    return float(sag + np.sqrt(sag**2 + 2.0 * sag * DROP))


@pytest.mark.warns("UnitWarning")
@pytest.mark.parametrize("stiffness", [1e6, 1e8, 1e10])
@pytest.mark.parametrize(
    "integrator", [m.name for m in _core.integrators() if m.setting == "rtol" and not m.restarts]
)
def test_a_method_does_not_leap_through_a_stop(integrator: str, stiffness: float) -> None:
    for rtol in (1e-3, 1e-5, 1e-7):
        result = simulate(
            falling(stiffness),
            t_end=2.0,
            dt_out=0.02,
            rtol=rtol,
            integrator=integrator,
            channels=["position"],
        )
        height = result["position"][:, 0, 2]
        assert height.min() > -1.1 * deepest(stiffness)
        error = np.abs(height - exact(stiffness)).max()
        assert error < 0.3, (rtol, error)
    assert error < 1e-2


@pytest.mark.warns(sometimes=["UnitWarning"])
@pytest.mark.parametrize("stiffness", [1e5, 1e7, 1e9])
def test_a_jacobian_of_the_stop_does_not_hold_the_flight_still(stiffness: float) -> None:
    """Tighter tolerances are more accurate: no step is believed whose Jacobian is of the past."""
    errors = []
    for rtol in (1e-4, 1e-6, 1e-8):
        result = simulate(
            falling(stiffness), t_end=2.0, dt_out=0.02, rtol=rtol, integrator="rosenbrock",
            channels=["position"],
        )  # fmt: skip
        errors.append(np.abs(result["position"][:, 0, 2] - exact(stiffness)).max())
    assert errors[1] < 0.1 * errors[0]
    assert errors[2] < 0.1 * errors[1]
