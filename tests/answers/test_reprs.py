"""What a user sees of an object at a prompt: never an address, never pages of numbers."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
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
    scene, database = every_kind(), shipped_database()
    joint = next(name for name, j in scene.joints.items() if j.kind in ("prismatic", "revolute"))
    scene.add_soft_stop(joint=joint, minimum=-100.0, stiffness=1e5)
    case, memory = cases.case2(), database.memory
    assert memory is not None
    model = case.compile()
    tables = ("bodies", "joints", "drivers", "actuators", "point_forces", "springs", "force_tables", "loads")
    things: list[Any] = [
        scene, case, model, case.waves, Curve.constant(value=2.0), _core.initial_state(model),
        Run(case, model=model, t_end=1.0), next(iter(scene.joints.values())).first_frame,
        *(thing for table in (*tables, "vessels") for thing in getattr(scene, table).values()),
        database, memory, memory.blocks[0], shipped_hull(), linear_model(case), natural_modes(case),
        response_statistics(case, spectrum=jonswap(hs=2.0, tp=8.0), direction=2.0, body="vessel"),
        KnuckleBoomCrane.load(), retardation_functions(database=database),
        model_error(case, body="payload", times=np.linspace(0.0, 1.0, 11)),
        DriftCoefficients(heading=np.arange(7), omega=np.arange(1.0, 9.0), coefficient=np.zeros((7, 8, 6))),
        MotionHistory(time=np.arange(99.0), motion=np.full((99, 6), 0.1)),
        MotionRaos(omega=np.arange(1.0, 9.0), heading=[0.0, np.pi], values=np.full((2, 8, 6), 0.1 + 0j)),
        MeasuredWaves(time=np.arange(99.0), elevation=np.sin(np.arange(99.0)), direction_deg=180.0),
    ]  # fmt: skip
    return {type(thing).__name__: thing for thing in things}


def test_what_a_user_holds_tells_what_it_is() -> None:
    for kind, thing in held().items():
        text = repr(thing)
        assert text.startswith(f"<{kind}") and text.endswith(">")
        assert " object at 0x" not in text and "array(" not in text and "\n" not in text
        assert 10 < len(text) < 400
        assert str(getattr(thing, "name", "")) in text
    body = Scene().add_body(name="bob", mass=2500.0, inertia=np.eye(3), position=(1.0, 2.0, 3.5))
    assert "'bob'" in repr(body) and "mass 2500" in repr(body) and "position (1, 2, 3.5)" in repr(body)


def test_no_class_of_the_core_is_an_address() -> None:
    classes = [member for member in vars(_core).values() if isinstance(member, type)]
    assert len(classes) > 20
    assert [kind.__name__ for kind in classes if "__repr__" not in vars(kind)] == []


def test_tables_hold_numbers_and_escape_names() -> None:
    nasty = "<script>alert(1)</script>"
    scene = Scene(name=nasty)
    scene.add_body(name=nasty, mass=1.0, inertia=np.eye(3))
    database = dataclasses.replace(shipped_database(), name=nasty, source=nasty)
    result = seacrane.simulate(scene, t_end=0.1)
    for thing in (scene, result, database):
        html = thing._repr_html_()
        assert nasty not in html and "&lt;script&gt;" in html
        assert html.startswith('<div class="seacrane">') and html.endswith("</table></div>")
    assert "outputs to 0.1 s" in result._repr_html_() and "<td>mass [t]</td>" in database._repr_html_()
    lines = [line.split() for line in str(database).splitlines()]
    assert ["mass", "[t]", "14000"] in lines and [
        "GM",
        "of",
        "its",
        "C44",
        "and",
        "mass",
        "[m]",
        "3",
    ] in lines


def test_a_result_is_a_mapping_of_its_channels() -> None:
    result = seacrane.simulate(cases.case2(), t_end=0.2)
    assert "position" in result and "nonsense" not in result
    assert list(result) == list(result.channels) == list(result.keys()) and len(result) > 3
    assert all(values is result[name] for name, values in result.items())
    assert result.get("nonsense") is None and result.get("position") is result["position"]
    assert dict(result).keys() == result.channels.keys()
    assert result and result == result and result != dict(result) and hash(result)
