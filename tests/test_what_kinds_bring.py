"""What a new kind of load or file needs beside its own file: a table, a drawing, a fuzz target, or a reason.

The kinds come from their registries. A kind more in a registry shows that what is missing is found.
"""

from __future__ import annotations

import inspect
import re
import sys
from collections.abc import Iterable, Mapping

from fuzz.targets import TARGETS
from test_elements import LOADS, three_bodies

from seacrane.description.loads import LOAD_KINDS
from seacrane.hydro.readers.format import Format
from seacrane.hydro.readers.load import FORMATS
from seacrane.lift.tables import TABLES
from seacrane.pictures.wires import wires_of

NO_TABLE = {
    "function force": "a C function is no data",
    "span drag": "add_line makes it, of a line with mass",
}
ON_DRAWN = "it acts on what is drawn already"
NO_DRAWING = {
    "heave compensator": "it has no force; what it moves is drawn",
    "actuator": "the joint's bodies are drawn",
    "friction": "the joint's bodies are drawn",
    "soft stop": "the joint's bodies are drawn",
    "point force": ON_DRAWN,
    "force table": ON_DRAWN,
    "function force": ON_DRAWN,
    "flow force": ON_DRAWN,
    "pendulum damping": ON_DRAWN,
    "span drag": ON_DRAWN,
}


class Unknown:
    """A kind of load that nobody has heard of."""


def without_table(kinds: Mapping[str, type]) -> set[str]:
    """Kinds of loads that no table's call returns."""
    returns = " ".join(
        str(inspect.signature(table.add).return_annotation) for table in TABLES.values() if table.add
    )
    made = set(re.findall(r"_core\.(\w+)", returns))
    return {kind for kind, type_ in kinds.items() if type_.__name__ not in made}


def not_drawn(kinds: Iterable[str]) -> set[str]:
    """Kinds of loads whose example adds nothing to the page."""
    found = set()
    for kind in kinds:
        scene = three_bodies()
        bodies = list(scene.bodies)
        bare = len(wires_of(scene, bodies))
        scene.add_load(LOADS[kind].example())
        if len(wires_of(scene, bodies)) == bare:
            found.add(kind)
    return found


def without_target(modules: Iterable[str]) -> set[str]:
    """Modules of readers that no fuzz target reaches."""
    fuzzed = {module for target in TARGETS.values() for module in target.modules}
    return {one for one in modules if one not in fuzzed}


def readers() -> set[str]:
    """The modules whose `FORMAT` is registered."""
    held = {name: getattr(module, "FORMAT", None) for name, module in sys.modules.items()}
    names = {name for name, kind in held.items() if isinstance(kind, Format) and kind in FORMATS}
    return {name.removeprefix("seacrane.").replace(".", "/") + ".py" for name in names}


def test_every_kind_of_load_has_a_table_or_a_reason() -> None:
    assert without_table(LOAD_KINDS) == set(NO_TABLE)
    assert without_table(LOAD_KINDS | {"unknown": Unknown}) - set(NO_TABLE) == {"unknown"}


def test_every_kind_of_load_is_drawn_or_has_a_reason() -> None:
    assert not_drawn(LOADS) == set(NO_DRAWING)


def test_every_format_has_a_fuzz_target() -> None:
    assert len(readers()) == len(FORMATS)
    assert without_target(readers()) == set()
    assert without_target({*readers(), "hydro/readers/unknown.py"}) == {"hydro/readers/unknown.py"}
