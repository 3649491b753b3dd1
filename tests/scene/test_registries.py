"""What is added to a registry reaches files, pictures and fuzzing without a list kept by hand."""

from __future__ import annotations

from pathlib import Path

import pytest
from fuzz.targets import TARGETS
from lift_examples import every_table

from seacrane import Scene, _core
from seacrane.description.loads import LOAD_KINDS, kind_of
from seacrane.hydro.readers.load import FORMATS
from seacrane.pictures.wheels import wires_of

IN_NO_TEXT = {"function force"}  # the address of a C function
ENDS = {"first", "second", "first_point", "second_point"}
SHOWN_BY_WHAT_THEY_ACT_ON = {"pendulum damping", "span drag", "immersed span", "wound span"}


@pytest.mark.warns("SeabedWarning")
def test_every_kind_of_load_is_in_a_lift_file() -> None:
    written = {kind_of(load) for load in every_table().all_loads()}
    assert set(LOAD_KINDS) - written == IN_NO_TEXT


def between_points() -> list[str]:
    return [
        name
        for name, kind in LOAD_KINDS.items()
        if {field.name for field in kind.FIELDS} >= ENDS and name not in SHOWN_BY_WHAT_THEY_ACT_ON
    ]


@pytest.mark.parametrize("kind", between_points())
def test_every_load_between_two_points_is_drawn(kind: str) -> None:
    scene = Scene()
    load = LOAD_KINDS[kind].example()
    for name in (load.first, load.second):
        scene.add_body(name, mass=1.0, inertia=(1.0,) * 3)
    scene.add_load(load)
    assert load.name in {wire["element"] for wire in wires_of(scene, list(scene.bodies))}


def test_every_reader_of_hydrodynamic_files_is_fuzzed() -> None:
    fuzzed = {module for target in TARGETS.values() for module in target.modules}
    readers = {
        f"{kind.can_open.__module__.removeprefix('seacrane.').replace('.', '/')}.py" for kind in FORMATS
    }
    assert readers <= fuzzed and not [x for x in fuzzed if not (Path(_core.__file__).parent / x).is_file()]
