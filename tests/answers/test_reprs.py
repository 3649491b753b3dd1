"""What a user sees of an object at a prompt: never an address, never pages of numbers."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from test_scene_file import every_kind

import seacrane
from seacrane import (
    Curve,
    MotionHistory,
    MotionRaos,
    Run,
    Scene,
    _core,
    cases,
    linear_model,
    natural_modes,
    response_statistics,
)
from seacrane.accuracy import model_error
from seacrane.crane import KnuckleBoomCrane
from seacrane.hydro import DriftCoefficients, retardation_functions, shipped_database
from seacrane.hydro.hull.shipped_hull import shipped_hull
from seacrane.sea import MeasuredWaves, jonswap


def held() -> dict[str, Any]:
    """One of each thing that scripts hold, by the name of its class."""
    scene = every_kind()
    joint = next(name for name, j in scene.joints.items() if j.kind in ("prismatic", "revolute"))
    scene.add_soft_stop(joint=joint, minimum=-100.0, stiffness=1e5)
    case = cases.case2()
    model = case.compile()
    things: list[Any] = [
        scene,
        case,
        model,
        case.waves,
        Curve.constant(value=2.0),
        _core.initial_state(model),
    ]
    things += [Run(case, model=model, t_end=1.0), next(iter(scene.joints.values())).first_frame]
    tables = ("bodies", "joints", "drivers", "actuators", "point_forces", "springs", "force_tables", "loads")
    for table in (*tables, "vessels"):
        things += getattr(scene, table).values()
    return {type(thing).__name__: thing for thing in things}


HELD = held()


@pytest.mark.parametrize("kind", HELD)
def test_what_a_user_holds_tells_what_it_is(kind: str) -> None:
    text = repr(HELD[kind])
    assert text.startswith(f"<{kind}")
    assert " object at 0x" not in text and "array(" not in text
    assert 10 < len(text) < 400
    assert getattr(HELD[kind], "name", "") in text


def test_a_repr_holds_the_numbers() -> None:
    body = Scene().add_body(name="bob", mass=2500.0, inertia=np.eye(3), position=(1.0, 2.0, 3.5))
    assert "'bob'" in repr(body) and "mass 2500" in repr(body) and "position (1, 2, 3.5)" in repr(body)


def test_no_class_of_the_core_is_an_address() -> None:
    classes = [member for member in vars(_core).values() if isinstance(member, type)]
    assert len(classes) > 20
    assert [kind.__name__ for kind in classes if "__repr__" not in vars(kind)] == []


def test_notebooks_show_tables_of_what_is_held(result: seacrane.Result) -> None:
    database = shipped_database()
    shown = {thing: thing._repr_html_() for thing in (result, database)}
    for html in shown.values():
        assert html.startswith('<div class="seacrane">') and html.endswith("</table></div>")
    assert "outputs to 0.2 s" in shown[result] and "<td>link_tension</td>" in shown[result]
    assert "115, 25" in shown[database] and "<td>mass [t]</td>" in shown[database]


def with_arrays() -> dict[str, Any]:
    """What holds arrays, by the name of its class."""
    scene, database, hull = cases.case2(), shipped_database(), shipped_hull()
    memory = database.memory
    assert memory is not None
    statistics = response_statistics(scene, spectrum=jonswap(hs=2.0, tp=8.0), direction=2.0, body="vessel")
    things: list[Any] = [
        database, memory, memory.blocks[0], hull, linear_model(scene), natural_modes(scene), statistics,
        KnuckleBoomCrane.load(), retardation_functions(database=database),
        model_error(scene, body="payload", times=np.linspace(0.0, 1.0, 11)),
        DriftCoefficients(heading=np.arange(7), omega=np.arange(1.0, 9.0), coefficient=np.zeros((7, 8, 6))),
        MotionHistory(time=np.arange(99.0), motion=np.full((99, 6), 0.1)),
        MotionRaos(omega=np.arange(1.0, 9.0), heading=[0.0, np.pi], values=np.full((2, 8, 6), 0.1 + 0j)),
        MeasuredWaves(time=np.arange(99.0), elevation=np.sin(np.arange(99.0)), direction_deg=180.0),
    ]  # fmt: skip
    return {type(thing).__name__: thing for thing in things}


WITH_ARRAYS = with_arrays()


@pytest.mark.parametrize("kind", WITH_ARRAYS)
def test_what_holds_arrays_is_one_line_without_their_numbers(kind: str) -> None:
    text = repr(WITH_ARRAYS[kind])
    assert text.startswith(f"<{kind}") and text.endswith(">")
    assert "array(" not in text and "\n" not in text and " object at 0x" not in text
    assert len(text) < 400


def test_a_database_prints_its_mass_and_gm_on_a_page() -> None:
    lines = str(shipped_database()).splitlines()
    assert len(lines) < 20 and max(map(len, lines)) < 140
    assert any(line.split() == ["mass", "[t]", "14000"] for line in lines)
    assert any(line.split() == ["GM", "of", "its", "C44", "and", "mass", "[m]", "3"] for line in lines)


def test_names_in_tables_are_escaped() -> None:
    nasty = "<script>alert(1)</script>"
    scene = Scene(name=nasty)
    scene.add_body(name=nasty, mass=1.0, inertia=np.eye(3))
    database = dataclasses.replace(shipped_database(), name=nasty, source=nasty)
    for thing in (scene, seacrane.simulate(scene, t_end=0.1), database):
        html = thing._repr_html_()
        assert nasty not in html and "&lt;script&gt;" in html


MAPPING: dict[str, Callable[[seacrane.Result], Any]] = {
    "in": lambda result: "position" in result,
    "not in": lambda result: "nonsense" not in result,
    "list": lambda result: list(result) == list(result.channels),
    "len": lambda result: len(result) == len(result.channels) > 3,
    "keys": lambda result: list(result.keys()) == list(result.channels),
    "items": lambda result: all(values is result[name] for name, values in result.items()),
    "get": lambda result: result.get("nonsense") is None and result.get("position") is result["position"],
    "dict": lambda result: dict(result).keys() == result.channels.keys(),
    "itself": lambda result: bool(result) and result == result and result != dict(result) and hash(result),
}


@pytest.fixture(scope="module")
def result() -> seacrane.Result:
    return seacrane.simulate(cases.case2(), t_end=0.2)


@pytest.mark.parametrize("use", MAPPING)
def test_a_result_is_a_mapping_of_its_channels(use: str, result: seacrane.Result) -> None:
    assert MAPPING[use](result)
