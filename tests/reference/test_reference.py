"""The comparison is not blind: names are matched, and one value that differs is told."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .compare import differences


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
