"""What is added to a registry reaches files, pictures and fuzzing without a list kept by hand."""

from __future__ import annotations

import inspect
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from fuzz.targets import CORPUS, TARGETS
from lift_examples import every_table
from where import ROOT, at

from seacrane import Scene, _core
from seacrane.description import elements
from seacrane.description.description import Description, all_loads
from seacrane.description.loads import LOAD_KINDS, kind_of
from seacrane.hydro.readers.load import FORMATS
from seacrane.lift.tables import TABLES
from seacrane.pictures.wheels import wires_of

IN_NO_TEXT = {"function force"}  # the address of a C function
ADDED = "python/seacrane/scene/scene.py"
STUB, SEED = "python/seacrane/_core.pyi", CORPUS / "scene" / "every-load"


def lacking(kind: str, written: set[str]) -> Iterator[str]:
    """What a kind of load has not yet, by the file and the line where it belongs."""
    name, word = LOAD_KINDS[kind].__name__, kind.replace(" ", "_")
    pages, tests = (
        "".join(path.read_text(encoding="utf-8") for path in ROOT.glob(files))
        for files in ("docs/*.md", "tests/*/test_*.py")
    )
    if f"class {name}:" not in (ROOT / STUB).read_text(encoding="utf-8"):
        yield f"{at(STUB, '__all__')}: no class {name}; `make stubs` writes it"
    if word not in TABLES and kind not in written | IN_NO_TEXT:
        yield f"{at(ADDED, 'add_load')}: no add_{word} of its entries, so no table of lift files"
    if word in TABLES and f"`[{word}]`" not in pages:
        yield f"{at('docs/lift-files.md', '`[friction]`')}: no page has `add_{word}` and `[{word}]`"
    if kind not in " ".join((ROOT / "CHANGELOG.md").read_text(encoding="utf-8").lower().split()):
        yield f"{at('CHANGELOG.md', '## ')}: no line on the {kind}"
    if word in TABLES and f"add_{word}" not in tests:
        yield f"{at('tests/multibody/test_loads.py', 'def test_')}: no test calls add_{word}"
    if kind not in IN_NO_TEXT and not re.search(f'"(a )?{kind}"', SEED.read_text(encoding="utf-8")):
        yield f"{SEED.relative_to(ROOT)}:1: no {kind}; `python tools/fuzzing/seeds.py` writes the seeds anew"


@pytest.mark.warns("SeabedWarning")
def test_every_kind_of_load_has_all_that_belongs_to_it() -> None:
    written = {kind_of(load) for load in all_loads(every_table())}
    told = "\n".join(told for kind in LOAD_KINDS for told in lacking(kind, written))
    assert not told, told


@pytest.mark.parametrize("kind", [kind for kind, type_ in LOAD_KINDS.items() if type_.DRAWN == "spring"])
def test_every_load_between_two_points_is_drawn(kind: str) -> None:
    """Unless its header says that it is not."""
    scene = Scene()
    load = LOAD_KINDS[kind].example()
    for name in (load.first, load.second):
        scene.add_body(name, mass=1.0, inertia=(1.0,) * 3)
    scene.add_load(load)
    assert load.name in {wire["element"] for wire in wires_of(scene, list(scene.bodies))}


@pytest.mark.parametrize("kind", sorted(LOAD_KINDS.keys() - IN_NO_TEXT - {"limit"}))
def test_one_line_makes_the_method_of_a_kind(kind: str) -> None:
    """`adds`, a step of the guide to a new load: its keywords are the fields, and it adds that load."""
    load = LOAD_KINDS[kind].example()
    add = elements.adds(LOAD_KINDS[kind])
    keywords = inspect.signature(add).parameters
    assert list(keywords)[1:] == [field.name for field in load.FIELDS]
    entries = {field.name: getattr(load, field.name) for field in load.FIELDS}
    scene = Description()
    assert add(scene, entries.pop("name"), **entries) == load
    assert list(all_loads(scene)) == [load]


def test_every_reader_of_hydrodynamic_files_is_fuzzed() -> None:
    fuzzed = {module for target in TARGETS.values() for module in target.modules}
    readers = {
        f"{kind.can_open.__module__.removeprefix('seacrane.').replace('.', '/')}.py" for kind in FORMATS
    }
    place = at("tests/fuzz/targets.py", "TARGETS")
    assert readers <= fuzzed, f"{place}: no target has {readers - fuzzed} among its modules"
    assert not [x for x in fuzzed if not (Path(_core.__file__).parent / x).is_file()]
