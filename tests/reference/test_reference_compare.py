"""The comparison finds what differs, and only that."""

from __future__ import annotations

import json

import numpy as np
import pytest

from . import ten_body
from .compare import differences
from .simulate import simulate
from .system import System


def test_differences_match_names_and_ignore_the_sign_of_quaternions() -> None:
    system = System.from_records(ten_body.records(vessel=False, case=2))
    run = simulate(system, 0.2, [0.1, 0.2], rtol=1e-6)
    names = run["names"]["body"]
    order = list(reversed(range(len(names))))
    other = {"time": run["time"]}
    for key in ("position", "velocity", "angular_velocity"):
        other[key] = run[key][:, order].copy()
    other["quaternion"] = -run["quaternion"][:, order]
    other["reaction_force"] = run["reaction_force"].copy()
    bodies, joints = [names[k] for k in order], run["names"]["joint"]
    assert set(differences(run, other, bodies=bodies, joints=joints).values()) == {0.0}
    turn = np.array([np.cos(0.005), np.sin(0.005), 0.0, 0.0])
    other["quaternion"][0, 2] = -turn * np.sign(run["quaternion"][0, order[2], 0])
    other["position"][1, 0, 2] += 0.25
    found = differences(run, other, bodies=bodies, joints=joints)
    assert found["position"] == pytest.approx(0.25)
    assert found["velocity"] == 0.0
    before = run["quaternion"][0, order[2]]
    assert found["attitude"] == pytest.approx(2.0 * np.arccos(min(1.0, abs(float(before @ turn)))), abs=1e-6)


def test_differences_refuse_other_times() -> None:
    system = System.from_records(ten_body.records(vessel=False, case=2))
    run = simulate(system, 0.2, [0.1, 0.2], rtol=1e-4)
    with pytest.raises(ValueError, match="different times"):
        differences(run, {"time": [0.1]}, bodies=run["names"]["body"])


def test_a_scene_survives_its_json_form() -> None:
    scene = ten_body.records(case=3)
    again = json.loads(json.dumps(scene))
    runs = [simulate(System.from_records(r), 0.3, [0.3], rtol=1e-6) for r in (scene, again)]
    found = differences(runs[0], runs[1], bodies=runs[1]["names"]["body"], joints=runs[1]["names"]["joint"])
    assert set(found.values()) == {0.0}
