"""What a user sees of an object at a prompt: never an address, never pages of numbers."""

from __future__ import annotations

import dataclasses

import numpy as np
from test_scene_file import every_kind

import seacrane
from seacrane import Scene, _core, cases, linear_model, natural_modes
from seacrane.hydro import shipped_database


def test_what_a_user_holds_tells_what_it_is_in_one_line() -> None:
    classes = [member for member in vars(_core).values() if isinstance(member, type)]
    assert len(classes) > 20
    assert [kind.__name__ for kind in classes if "__repr__" not in vars(kind)] == []
    scene, case = every_kind(), cases.case2()
    tables = ("bodies", "joints", "drivers", "actuators", "point_forces", "springs", "force_tables", "loads")
    things = [scene, case.waves, case.compile(), shipped_database(), linear_model(case), natural_modes(case)]
    things += [thing for table in (*tables, "vessels") for thing in getattr(scene, table).values()]
    for thing in things:
        text = repr(thing)
        assert text.startswith(f"<{type(thing).__name__}") and text.endswith(">") and 10 < len(text) < 400
        assert " object at 0x" not in text and "array(" not in text and "\n" not in text
        assert str(getattr(thing, "name", "")) in text


def test_tables_escape_names() -> None:
    nasty = "<script>alert(1)</script>"
    scene = Scene(name=nasty)
    scene.add_body(name=nasty, mass=1.0, inertia=np.eye(3))
    database = dataclasses.replace(shipped_database(), name=nasty, source=nasty)
    for thing in (scene, seacrane.simulate(scene, t_end=0.1), database):
        html = thing._repr_html_()
        assert nasty not in html and "&lt;script&gt;" in html
