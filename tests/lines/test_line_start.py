"""What lines and winches tell before a run: starts that lift too much, motors that hold too little."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, G, below, hung

from seacrane import Scene, SceneError, equilibrium, simulate
from seacrane.warnings import LiftedStartWarning


def told(scene: Scene, t_end: float = 0.2) -> list[str]:
    """Warnings of a run, by class and beginning."""
    with warnings.catch_warnings(record=True, action="always") as caught:
        simulate(scene, t_end, dt_out=0.1)
    return [f"{one.category.__name__}: {one.message}" for one in caught]


@pytest.mark.warns("LineLengthWarning")
def test_a_start_that_lifts_far_more_than_the_weight_is_told() -> None:
    with pytest.warns(LiftedStartWarning, match=r"'load': its lines start by lifting it with .*, 2\.\d+"):
        simulate(hung(stretch=2.6 * MASS * G / 3e6, falls=3), 0.05, dt_out=0.05)
    assert told(hung(stretch=1.4 * MASS * G / 3e6)) == []
    rest = equilibrium(hung(stretch=0.15))
    with warnings.catch_warnings(action="error", category=LiftedStartWarning):
        simulate(hung(stretch=0.15), 0.05, dt_out=0.05, start=rest)


DRUM: dict[str, float] = {"lag": 0.1, "drum_inertia": 500.0, "drum_radius": 0.5}


def on_drum(**winch: Any) -> Scene:
    scene = hung(damping=0.1)
    if "length" in winch:
        scene.replace("hoist", length=winch.pop("length"))
    scene.add_winch(line="hoist", **DRUM | winch)
    return scene


@pytest.mark.parametrize(
    ("winch", "words"),
    [({"maximum_tension": 300.0}, "its motor and brake hold 300 N at the start, less than the 1.961e+05"),
     ({"brake": 1.0, "brake_capacity": 300.0}, "its motor and brake hold 300 N at the start"),
     ({"brake_capacity": 300.0}, "its brake holds 300 N, less than"),
     ({"brake": 1.0, "brake_capacity": 4e5, "maximum_tension": 300.0}, "its motor holds 300 N, less than"),
     ({"rate": -0.5, "maximum_power": 1e3}, "its winch reached its maximum_power, 1000 W, at t = "),
     ({"brake": 1.0, "brake_capacity": 1.05 * MASS * G, "length": 9.99}, "reached its brake_capacity, "),
     ({"maximum_tension": 3e5, "brake_capacity": 4e5}, "")],
)  # fmt: skip
def test_a_winch_that_holds_too_little_or_reached_its_bound_is_told(winch: Any, words: str) -> None:
    found = [one for one in told(on_drum(**winch), 0.5) if one.startswith("WinchLimitWarning")]
    assert any(f"line 'hoist': {words}" in one or f"its winch {words}" in one for one in found) == bool(words)
    assert bool(found) == bool(words)


DROP, SOFT = 30.0, 1e7  # m, N: the load stretches the line by 1.96 %
TABLE = {"strains": [0.0, 0.05, 0.12, 0.3], "tensions": [0.0, 6e4, 2.5e5, 9e5]}


def tied(**line: Any) -> Scene:
    return below((0.0, 0.0, -DROP), **{"EA": SOFT} | line)


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_line_that_starts_with_the_weight_rests(rung: str) -> None:
    result = simulate(tied(tension_at_start=MASS * G, rung=rung), t_end=2.0, dt_out=0.1)
    assert result["line_tension"] == pytest.approx(MASS * G, rel=1e-6)
    assert result["line_unstretched_length"][0] == pytest.approx(DROP / (1.0 + MASS * G / SOFT), rel=1e-12)
    assert np.abs(result["velocity"]).max() < 1e-6


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("tension", [0.0, 1.5e5, 1.2e6])
def test_a_cord_starts_with_the_tension_of_its_table(tension: float) -> None:
    scene = tied(EA=None, tension_at_start=tension, **TABLE)
    assert simulate(scene, t_end=0.01)["line_tension"][0] == pytest.approx([tension], rel=1e-9, abs=1e-4)


@pytest.mark.parametrize(("longer", "warned"), [(0.0, False), (0.005, False), (0.02, True), (-0.04, True)])
def test_a_soft_wire_at_rest_is_no_contradiction(longer: float, warned: bool) -> None:
    """Stretched by its load's weight over EA, and by a share of its length beyond."""
    length = DROP / (1.0 + MASS * G / SOFT + longer)
    assert any("LineLengthWarning" in one for one in told(tied(length=length))) == warned


def test_the_length_is_that_of_the_path_and_falls_carry_half_each() -> None:
    """Over a block: the weight on n falls stretches the line by W / (n EA)."""
    scene = Scene(name="falls")
    scene.add_body(name="load", mass=2.0 * MASS, inertia=MASS * np.eye(3), position=(0, 0, -4.0))
    block = {"bodies": ["ground", "load", "ground"], "points": [(-3, 0, 0), (0, 0, 0), (3, 0, 0)]}
    free = scene.add_line(name="free", EA=SOFT, **block)
    assert free.length.evaluate([0.0])[0, 0] == pytest.approx(10.0, rel=1e-12)
    pulled = scene.add_line(name="pulled", EA=SOFT, tension_at_start=MASS * G, **block)
    assert pulled.length.evaluate([0.0])[0, 0] == pytest.approx(10.0 / (1.0 + MASS * G / SOFT), rel=1e-12)


def test_a_line_is_tied_above_the_center_of_a_body_with_a_size_else_to_its_origin() -> None:
    scene = below((0.0, 0.0, -10.0), size=(2.0, 2.0, 4.0))
    scene.replace("load", center_of_mass=(0.1, 0.2, -0.3))
    scene.add_body(name="hook", mass=100.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, -3.0))
    lower = scene.add_line(name="lower", first="hook", second="load", EA=1e7)
    assert np.array_equal(lower.points, [(0.0, 0.0, 0.0), (0.1, 0.2, 1.7)])
    upper = scene.add_line(
        name="upper", first="ground", second="hook", EA=1e7, first_point=(0, 0, 1), second_point=(0, 0, 0.5)
    )
    assert np.array_equal(upper.points, [(0.0, 0.0, 1.0), (0.0, 0.0, 0.5)])


BETWEEN = {"name": "hoist", "first": "ground", "second": "load"}


THREE = {"first": None, "second": None, "bodies": ["ground", "load", "ground"], "points": np.zeros((3, 3))}

REFUSED: list[tuple[dict[str, Any], str]] = [
    ({"rung": "rigid", "EA": 1e7}, "takes no EA"), (THREE | {"rung": "rigid"}, "between two bodies"),
    ({"rung": "rigid", "wire": {"mass_per_length": 5.0}}, "no wire"), ({"EA": 1e7, "joint": "a"}, "no joint"),
    ({"wire": {"mass_per_length": 0.0}, "EA": 1e7}, "mass_per_length is 0.0"),
    ({"EA": 1e7, "bodies": ["ground", "load"]}, "other words for its path"),
    ({"EA": 1e7, "length": 29.0, "tension_at_start": 1e5}, "a length and a tension"), ({}, "has no EA"),
]  # fmt: skip


@pytest.mark.parametrize(("given", "message"), REFUSED)
def test_what_a_rung_does_not_take_is_refused_by_name(given: dict[str, Any], message: str) -> None:
    scene = below((0.0, 0.0, -10.0))
    words = {key: value for key, value in (BETWEEN | given).items() if value is not None}
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        scene.add_line(**words)
    assert not scene.loads and list(scene.bodies) == ["load"]
