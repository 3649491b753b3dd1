"""Lines that start with a tension, and those that what hangs on them has stretched."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Lift, Scene, simulate
from seacrane.errors import SceneError
from seacrane.warnings import LineLengthWarning

MASS, G, DROP = 20e3, 9.80665, 30.0
SOFT = 1e7  # N: the load stretches the line by 1.96 %
TABLE = {"strains": [0.0, 0.05, 0.12, 0.3], "tensions": [0.0, 6e4, 2.5e5, 9e5]}


def hung(load_at: float = DROP, **line: Any) -> Scene:
    scene = Scene(name="hung")
    scene.add_body(name="load", mass=MASS, inertia=MASS * np.eye(3), position=(0, 0, -load_at))
    given = {"EA": SOFT} | line
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), **given)
    return scene


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_line_that_starts_with_the_weight_rests(rung: str) -> None:
    result = simulate(hung(tension_at_start=MASS * G, rung=rung), t_end=2.0, dt_out=0.1)
    assert result["line_tension"] == pytest.approx(MASS * G, rel=1e-6)
    assert result["line_unstretched_length"][0] == pytest.approx(DROP / (1.0 + MASS * G / SOFT), rel=1e-12)
    assert np.abs(result["velocity"]).max() < 1e-6


@pytest.mark.parametrize("tension", [0.0, 3e4, 1.5e5, 9e5, 1.2e6])
def test_a_cord_starts_with_the_tension_of_its_table(tension: float) -> None:
    scene = hung(EA=None, tension_at_start=tension, **TABLE)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert simulate(scene, t_end=0.01)["line_tension"][0] == pytest.approx([tension], rel=1e-9, abs=1e-4)


def test_without_a_length_it_is_that_of_the_path() -> None:
    scene = Scene(name="block")
    scene.add_body(name="load", mass=MASS, inertia=MASS * np.eye(3), position=(0, 0, -4.0))
    line = scene.add_line(
        name="hoist", bodies=["ground", "load", "ground"], points=[[-3, 0, 0], [0, 0, 0], [3, 0, 0]],
        EA=SOFT,
    )  # fmt: skip
    assert line.length.evaluate([0.0])[0, 0] == pytest.approx(10.0, rel=1e-12)
    assert scene == with_length(scene, 10.0)


def with_length(scene: Scene, length: float) -> Scene:
    other = scene.copy()
    other.replace("hoist", length=length)
    return other


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"length": 29.0, "tension_at_start": 1e5}, "has a length and a tension_at_start; give one"),
        ({"length": Curve.constant(value=29.0), "tension_at_start": 0.0}, "give one of them"),
        ({"tension_at_start": -1.0}, r"tension_at_start is -1.0 N; give zero or more"),
        ({"tension_at_start": np.nan}, "tension_at_start is nan"),
        ({"tension_at_start": "much"}, "tension_at_start"),
    ],
)
def test_what_makes_no_start_is_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(SceneError, match=words):
        hung(**given)


def test_a_lift_file_tells_both() -> None:
    place = {"inertia_kg_m2": [1e5, 1e5, 1e5], "position_m": [0, 0, -DROP]}
    lift = Lift(
        {
            "crane": {"base": "ground", "held": True},
            "body": [{"name": "load", "mass_kg": MASS, **place}],
            "line": [
                {"name": "hoist", "bodies": ["ground", "load"], "points_m": [[0, 0, 0], [0, 0, 0]],
                 "EA_N": SOFT, "tension_at_start_N": MASS * G}
            ],
        }
    )  # fmt: skip
    scene = lift.scene()
    assert len(scene.drivers) == 3
    start = scene.loads["hoist"].length.evaluate([0.0])[0, 0]
    assert start == pytest.approx(DROP / (1.0 + MASS * G / SOFT), rel=1e-12)


def test_a_path_over_a_body_that_is_not_there_has_no_length() -> None:
    with pytest.raises(SceneError, match=r"line 'hoist'.*body 'load' is not in the scene; add it first"):
        Scene().add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=SOFT)


@pytest.mark.parametrize(("longer", "warned"), [(0.0, False), (0.005, False), (0.02, True), (-0.04, True)])
def test_a_soft_wire_at_rest_is_no_contradiction(longer: float, warned: bool) -> None:
    """Stretched by its load's weight over EA, and by a share of its length beyond."""
    length = DROP / (1.0 + MASS * G / SOFT + longer)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        simulate(hung(length=length), t_end=0.1)
    told = [str(one.message) for one in caught if issubclass(one.category, LineLengthWarning)]
    assert bool(told) == warned


def test_two_falls_carry_half_each() -> None:
    """Over a block: the weight on n falls stretches the line by W / (n EA)."""
    scene = Scene(name="falls")
    scene.add_body(name="load", mass=2.0 * MASS, inertia=MASS * np.eye(3), position=(0, 0, -DROP))
    scene.add_line(
        name="hoist", bodies=["ground", "load", "ground"], points=[[-1, 0, 0], [0, 0, 0], [1, 0, 0]],
        EA=SOFT, tension_at_start=MASS * G,
    )  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        simulate(scene, t_end=0.1)
