"""What the engine's tests do not tell by agreeing with the reference: its convolution, its comparison."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .compare import differences
from .convolution import kernel_of_damping, memory_force


def test_differences_match_names_and_ignore_the_sign_of_quaternions() -> None:
    random = np.random.default_rng(1)
    run: dict[str, Any] = {"time": np.array([0.0, 0.1]), "names": {"body": ["a", "b"], "joint": ["J", "K"]}}
    run |= {name: random.normal(size=(2, 2, 3)) for name in ("position", "reaction_force")}
    run["quaternion"] = np.tile([0.6, 0.8, 0.0, 0.0], (2, 2, 1))
    other = {name: run[name][:, ::-1].copy() for name in ("position", "reaction_force", "quaternion")}
    other |= {"time": run["time"], "quaternion": -other["quaternion"]}
    names = {"bodies": ["b", "a"], "joints": ["K", "J"]}
    assert differences(run, other, **names) == {"position": 0.0, "reaction_force": 0.0, "attitude": 0.0}
    other["position"][1, 0, 2] += 0.25
    turned = np.arctan2(0.8, 0.6) + 0.005
    other["quaternion"][0, 1] = np.cos(turned), np.sin(turned), 0.0, 0.0
    found = differences(run, other, **names)
    assert found["position"] == pytest.approx(0.25) and found["attitude"] == pytest.approx(0.01)


def test_convolution_is_fourth_order() -> None:
    errors = []
    for count in (50, 100):
        step = 10.0 / count
        t = step * np.arange(count + 1)
        kernel, u = np.zeros((count + 1, 6, 6)), np.zeros((count + 1, 6))
        kernel[:, 2, 2], u[:, 2] = np.exp(-0.5 * t), np.sin(t)
        exact = (0.5 * np.sin(t) - np.cos(t) + np.exp(-0.5 * t)) / 1.25
        errors.append(np.max(np.abs(memory_force(u, kernel, step)[10:, 2] - exact[10:])))
    assert errors[0] / errors[1] > 12.0


def test_kernel_of_linear_damping_is_exact_on_a_coarse_grid() -> None:
    """B = w up to 1 rad/s in a single interval: K = 2/pi (sin t / t + (cos t - 1) / t^2)."""
    damping = np.zeros((2, 6, 6))
    damping[1, 2, 2] = 1.0
    times = np.array([1e-6, 0.02, 0.7, 3.0, 40.0])
    exact = 2.0 / np.pi * (np.sin(times) / times - 0.5 * np.sinc(0.5 * times / np.pi) ** 2)
    np.testing.assert_allclose(kernel_of_damping(times, [0.0, 1.0], damping)[:, 2, 2], exact, rtol=1e-9)
