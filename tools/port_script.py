"""Ports scripts of earlier versions: python tools/port_script.py [--write] FILE ...

Without ``--write`` it prints what would change. A call that is gone becomes the call that does its work, in
its place in the text; what the table's note says has to be looked at by hand.
"""

from __future__ import annotations

import argparse
import ast
import difflib
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True)
class Call:
    """What takes the place of a method or a function.

    Its name; what its arguments by place are called now ("" for one that stays by place); keywords with their
    values, and those that go; those that are fields of a value now, with its keyword and class.
    """

    name: str
    places: tuple[str, ...] = ()
    words: Mapping[str, str] = field(default_factory=dict)
    dropped: tuple[str, ...] = ()
    renamed: Mapping[str, str] = field(default_factory=dict)
    values: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    note: str = ""


AGAIN = "add_sea puts the vessel into the sea anew: repeat its position, heading_deg, phase and drift there"
FUNCTION = "force is the C function itself, not its address"
LOADED = "it returns what is on disk: .load() is the Result"
BY_BODY = {"mass_matrices": "mass_matrix"}


def _values(**values: str) -> Mapping[str, tuple[str, str]]:
    """By old keyword, that of the value with its class, and the field: "Class field old=field ..."."""
    found = {}
    for word, (kind, *names) in ((word, text.split()) for word, text in values.items()):
        for name in names:
            old, _, new = name.partition("=")
            found[old] = (f"{word}={kind}", new or old)
    return found


OIL = _values(
    chamber="Chamber pressure hose_volume",
    rod_chamber="Chamber pressure_rod=pressure hose_volume_rod=hose_volume",
    oil="Oil oil_modulus=modulus hose_modulus cylinder_modulus oil_density=density air vapour_pressure"
    " refuse_void",
    valve="Valve rated_flow rated_flow_rod rated_drop laminar_drop overlap spool_lag gain rate_gain",
    pump="Pump pump_pressure=pressure tank_pressure makeup_flow pump_check=check",
    relief="Relief relief_pressure=pressure relief_pressure_rod=pressure_rod relief_flow=flow"
    " relief_override=override",
    counterbalance="Counterbalance counterbalance_pressure=pressure counterbalance_pressure_rod=pressure_rod"
    " counterbalance_flow=flow counterbalance_range=range pilot_ratio",
    accumulator="Accumulator accumulator_volume=volume accumulator_pressure=pressure accumulator_flow=flow"
    " accumulator_exponent=exponent",
    piston="Piston viscous_friction friction friction_speed internal_leakage external_leakage stop_stiffness",
    rupture="Rupture rupture_time=time rupture_area=area rod_side_ruptures=rod_side discharge_coefficient",
)
GAS = _values(
    gas="Gas area pressure volume force stiffness length exponent pushes",
    stops="Stops minimum maximum stop_stiffness=stiffness",
)
DRIVE = _values(
    drive="Drive actuator_frequency=frequency actuator_damping=damping maximum_rate maximum_stroke settling"
)
LINE = _values(
    wire="Wire mass_per_length segments diameter drag_coefficient drag_coefficient_along"
    " added_mass_coefficient density flow medium seabed",
    sheaves="Sheaves radii axes turns efficiencies frictions slip_speed",
)
INSIDE = _values(
    inside="Compartment area height openings point air exponent air_pressure discharge_coefficient"
    " initial name"
)
OF_OTHERS = {"pressure", "gain", "friction", "air", "overlap"}  # keys of dicts that may be of anything
IMPORTED = "import the values from seacrane.scene; in dicts of keywords one replaces another as a whole"
SWING = "give damping_ratio: what was left out was 0.005"
COMPARTMENT = "import Compartment from seacrane.hydro; it may go into the add_immersed of the body's parts"
WITH_MASS = "import the values from seacrane.scene; rung='with mass' goes, and segment_rung is rung"
CALLS = {
    "add_hydraulic_cylinder": Call("add_hydraulic_cylinder", values=OIL, note=IMPORTED),
    "add_line": Call("add_line", values=LINE, note=WITH_MASS),
    "add_vessel": Call("add_vessel", renamed={"mooring_period": "mooring"}),
    "add_gas_spring": Call("add_spring", values=GAS, note=IMPORTED),
    "add_pendulum_damping": Call("add_spring", renamed={"ratio": "damping_ratio"}, note=SWING),
    "add_heave_compensation": Call("add_heave_compensation", values=DRIVE, note=IMPORTED),
    "add_entrapped_water": Call("add_immersed", values=INSIDE, note=COMPARTMENT),
    "add_drift": Call("add_sea", words={"drift": "True"}, dropped=("outside",), note=AGAIN),
    "use_actual_position": Call("add_sea", words={"phase": '"actual"'}, note=AGAIN),
    "use_slow_position": Call("add_sea", words={"phase": '"slow"'}, note=AGAIN),
    "add_point_force": Call("add_force", places=("name",)),
    "add_force_table": Call("add_force", places=("name",), renamed={"loads": "force"}),
    "add_function_force": Call("add_force", places=("name",), renamed={"address": "force"}, note=FUNCTION),
    "add_end_stop": Call("add_stop"),
    "add_soft_stop": Call("add_stop"),
    "add_seat": Call("add_stop"),
    "record_coordinate": Call("add_channel", places=("joint",)),
    "add_range": Call("add_channel", places=("joint",)),
    "add_clearance": Call("add_channel"),
    "add_air_drag": Call("add_wind", places=("body",)),
    "add_luffing_rope": Call(
        "add_winch",
        words={"line": '"luffing rope"'},
        dropped=("luff",),
        note="line is the rope's name in its crane",
    ),
    "add_given_vessel": Call("add_vessel", places=("motion",)),
    "add_vessels": Call("add_vessel", renamed={"group": "what"}),
    "add_seabed": Call("add_contact", words={"on": '"seabed"'}),
    "simulate_stages": Call("simulate", renamed={"stages": "t_end"}),
    "simulate_to_file": Call("simulate", places=("", "to", ""), renamed={"path": "to"}),
    "simulate_stages_to_file": Call(
        "simulate", places=("", "", "to"), renamed={"stages": "t_end", "path": "to"}, note=LOADED
    ),
    "read_bemio_group": Call("read_bemio", renamed=BY_BODY),
    "read_capytaine_group": Call(
        "read_capytaine",
        renamed=BY_BODY | {"restorings": "restoring", "rotation_centres": "rotation_centre"},
    ),
    "read_nemoh_group": Call("read_nemoh", renamed=BY_BODY | {"restorings": "restoring"}),
    "read_wamit_group": Call("read_wamit", renamed=BY_BODY),
}
FFT = re.compile(r"""\bevaluation=(["'])fft\1""")  # which was the table, made in another way
ROOMS = {"needs": "answers", "water": "hydro"}
ROOM = re.compile(r"\b(seacrane|sc)\.(needs|water)\b(\.from_mesh\b)?")
PASSIVE = re.compile(r"""\b(memory|kind)=(["'])passive\2""")  # a kind of fluid memory that is gone
READERS = {"read_bemio", "read_nemoh", "read_wamit", "load_database"}
ASKS = "a vessel of a file without a mass asks for mass_matrix="

GONE = {
    "KnuckleBoomCrane": "KnuckleBoomCrane.load() is load_crane(), crane.geometry.tip(...) is crane.tip(...); "
    "bodies and joints are those of crane.parts(...)",
    "add_bridle": "slings are lines: add_line for each, or slings=Slings(...) of add_hoist",
    "add_relative": 'it is add_channel(name, expression="<point>.z in <body> - <to>.z in <body>")',
    "add_slack_tank": "it is add_vessel(..., slack_moment=...), of all tanks together",
    "BodyRecord": "crane.parts(...).bodies are Body, as in Scene.bodies",
    "JointRecord": "crane.parts(...).joints are JointData",
    "RigidPart": "no part is taken out of a vessel's mass: give vessel_parameters a database without it",
    "JointedCrane": "JointedCrane is Crane, as of load_crane; crane.tip(coordinates=x) is crane.tip(**x)",
    "AssumedInertiaWarning": ASKS,
    "coefficient_scatter": "it is ensemble of partial(answers.scattered, scene), over={'case': [...]}",
}


def ported(text: str) -> tuple[str, list[str]]:
    """The script with the calls of today, and notes with their lines."""
    notes = [
        (text.count("\n", 0, found.start()) + 1, "memory by motion takes a limit, and no r2")
        for found in PASSIVE.finditer(text)
    ]
    text = ROOM.sub(_in_new_room, text)
    text = FFT.sub(r"evaluation=\1table\1", PASSIVE.sub(r"\1=\2by-motion\2", text))
    starts = [0]
    for line in text.encode().splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    data = text.encode()
    for node, new_text, note in sorted(_changes(ast.parse(text)), key=_place, reverse=True):
        assert node.end_lineno and node.end_col_offset is not None
        begin = starts[node.lineno - 1] + node.col_offset
        end = starts[node.end_lineno - 1] + node.end_col_offset
        if b"#" in data[begin:end]:
            note = f"{note}; comments inside it are lost" if note else "comments inside it are lost"
        data = data[:begin] + new_text.encode() + data[end:]
        notes += [(node.lineno, note)] if note else []
    return data.decode(), [f"line {line}: {note}" for line, note in sorted(notes)]


def _in_new_room(found: re.Match[str]) -> str:
    """A name of a room that another took in; `from_mesh` of a part says of what it is."""
    return f"{found[1]}.{ROOMS[found[2]]}{'.part_from_mesh' if found[3] else ''}"


Change = tuple[ast.expr | ast.stmt, str, str]


def _place(change: Change) -> tuple[int, int]:
    return change[0].lineno, change[0].col_offset


def _changes(tree: ast.AST) -> Iterator[Change]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and (old := _called(node.func)) in CALLS:
            new = CALLS[old]
            if old == new.name and not {one.arg for one in node.keywords} & {*new.values, *new.renamed}:
                continue
            yield node, _written(node, new), f"{old} is {new.name}; {new.note}".rstrip("; ")
        elif isinstance(node, ast.Dict) and (named := _oil_in(node)):
            words = [f'"{key}": {text}' for key, text in _grouped(named, OIL)]
            yield node, f"{{{', '.join(words)}}}", IMPORTED
        elif isinstance(node, ast.ImportFrom) and any(one.name in CALLS for one in node.names):
            names = [CALLS[one.name].name if one.name in CALLS else ast.unparse(one) for one in node.names]
            yield node, f"from {node.module} import {', '.join(dict.fromkeys(names))}", ""
        elif isinstance(node, ast.Call) and _called(node.func) in GONE:
            yield node.func, ast.unparse(node.func), GONE[_called(node.func)]
        elif isinstance(node, ast.Call) and _called(node.func) in READERS:
            if not {"mass_matrix", None} & {one.arg for one in node.keywords}:
                yield (
                    node.func,
                    ast.unparse(node.func),
                    ASKS,
                )
        elif isinstance(node, ast.ImportFrom) and (
            gone := [one.name for one in node.names if one.name in GONE]
        ):
            yield node, ast.unparse(node), "; ".join(GONE[name] for name in gone)


def _called(function: ast.expr) -> str:
    return function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")


def _oil_in(node: ast.Dict) -> list[tuple[str, ast.expr]]:
    """Keys and values of a dict of keywords of hydraulic cylinders; none of another."""
    keys = [one.value if isinstance(one, ast.Constant) else None for one in node.keys]
    if not {*keys} & (OIL.keys() - OF_OTHERS) or not all(isinstance(key, str) for key in keys):
        return []
    return list(zip(map(str, keys), node.values, strict=True))


def _grouped(
    given: Iterable[tuple[str, ast.expr]], values: Mapping[str, tuple[str, str]]
) -> Iterator[tuple[str, str]]:
    """Keywords and their texts; those of one value together, in the place of the first."""
    found: dict[str, list[str]] = {}
    for key, one in given:
        word, name = values.get(key, (key, ""))
        found.setdefault(word, []).append(f"{name}={ast.unparse(one)}" if name else ast.unparse(one))
    for word, texts in found.items():
        key, _, kind = word.partition("=")
        yield key, f"{kind}({', '.join(texts)})" if kind else texts[0]


def _written(node: ast.Call, new: Call) -> str:
    places = [*new.places, *[""] * len(node.args)]
    by_place = [ast.unparse(one) for one, word in zip(node.args, places, strict=False) if not word]
    words = [f"{word}={ast.unparse(one)}" for one, word in zip(node.args, places, strict=False) if word]
    kept = [one for one in node.keywords if one.arg not in new.dropped]
    named = [(new.renamed.get(one.arg, one.arg), one.value) for one in kept if one.arg]
    words += [f"{key}={text}" for key, text in _grouped(named, new.values)]
    words += [f"**{ast.unparse(one.value)}" for one in kept if not one.arg]
    words += [f"{key}={value}" for key, value in new.words.items()]
    owner = f"{ast.unparse(node.func.value)}." if isinstance(node.func, ast.Attribute) else ""
    return f"{owner}{new.name}({', '.join([*by_place, *words])})"


def main() -> int:
    """Print what changes in each file, or write it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE")
    parser.add_argument("--write", action="store_true", help="replace the files")
    args = parser.parse_args()
    for path in args.files:
        text = path.read_text(encoding="utf-8")
        new, notes = ported(text)
        if args.write and new != text:
            path.write_text(new, encoding="utf-8")
        elif new != text:
            sys.stdout.writelines(
                difflib.unified_diff(
                    text.splitlines(keepends=True), new.splitlines(keepends=True), str(path), str(path)
                )
            )
        sys.stdout.writelines(f"{path}, {note}\n" for note in notes)
    return 0


if __name__ == "__main__":
    sys.exit(main())
