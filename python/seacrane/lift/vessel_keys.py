"""The keys of vessels, of parts in the water, and of seas."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from seacrane.description.waves import STRETCHING
from seacrane.hydro import load_database
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.lift.inner_keys import CHOSEN, DIRECTION, EACH, LENGTH, NUMBER, POINT, ROW, TIME
from seacrane.lift.keys import Key, keys_of
from seacrane.scene import afloat, given_vessel, sea, vessel
from seacrane.scene.mooring import MooringSpring
from seacrane.scene.motion_history import MotionHistory
from seacrane.sea import Current, SeaState, WaveSystem
from seacrane.water import from_mesh
from seacrane.water.parts import PARTS

SHIPPED = ("hull_115",)  # databases that come with the package, by their names
HEIGHT_AND_PERIOD = {
    "hs": LENGTH | {"bounds": {"minimum": 0.0}}, "tp": TIME | {"bounds": {"exclusiveMinimum": 0.0}}
}  # fmt: skip
OF_MOTION = ("ramp", "duration", "size")
READING: dict[str, Any] = {"speed": {"unit": "m/s"}, "depth": {"unit": "m"}}  # of a vessel's database


def vessel_keys() -> tuple[Key, ...]:
    """The keys of `add_vessel`: a database and its reading, or a motion; what a script gives is not here."""
    mooring = "Natural period of soft station keeping in surge, sway and yaw; default 200 s; inf: no mooring."
    matrix = "Stiffness of the mooring about the reference point, vessel's axes."
    motions: dict[str, Any] = {"type": "array", "unit": "m, rad", "shapes": ((-1, 6),)}
    history = keys_of(
        MotionHistory,
        more={"time": TIME | {"type": "array", "shapes": ((-1,),)}, "motion": motions},
        without=("record",),
    )
    spring = keys_of(
        MooringSpring, more={"point": POINT, "direction_deg": {"unit": "deg"}, "stiffness": {"unit": "N/m"}}
    )
    more = CHOSEN | {
        "mooring": {"type": "array", "unit": "N/m, N m/rad", "shapes": ((6, 6),), "text": matrix},
        "mooring_period": {"unit": "s", "text": mooring},
        "position": POINT, "ramp": TIME, "duration": TIME, "size": POINT,
    }  # fmt: skip
    return (
        Key("database", "file", choices=SHIPPED,
            text="Path of a database, or hull_115, which comes with seacrane.",
        ),
        Key("motion", "text", choices=("raos", "rest"),
            text='"raos": led by the displacement RAOs of the database; "rest": without one, never moves.',
        ),
        Key("raos", "table", keys=_rao_keys(), text="Led by a table of RAOs, without a database."),
        Key("history", "table", keys=history, text="Led by a history, without a database."),
        *keys_of(afloat.add_hull, described=vessel.add_vessel, more=more, without=("database",)),
        *keys_of(given_vessel.add_given, described=vessel.add_vessel, more=more, only=OF_MOTION),
        Key("mooring_springs", "tables", keys=spring, text="Mooring by horizontal springs."),
        *keys_of(load_database, more=READING, only=tuple(READING)),
    )  # fmt: skip


def _rao_keys() -> tuple[Key, ...]:
    """The keys of `MotionRaos`, whose values are written heading by heading."""
    columns: dict[str, Any] = {"type": "array", "shapes": ((-1, 6),), "required": True}
    at_heading = (
        Key("heading", "number", unit="rad", required=True, text="Where the waves go."),
        Key(
            name="amplitude", unit="m/m, rad/m", text="Six motions at each frequency, zero or more.",
            **columns,
        ),
        Key(
            name="phase", unit="rad", text="By which each leads the crest at the reference point.", **columns
        ),
    )  # fmt: skip
    omega = {"type": "array", "unit": "rad/s", "shapes": ((-1,),)}
    table = keys_of(MotionRaos, more={"omega": omega, "depth": LENGTH}, without=("heading", "values", "g"))
    headings = Key("headings", "tables", keys=at_heading, required=True, text="Of the table.")
    return (*table, headings)


def part_keys() -> tuple[Key, ...]:
    """The keys of a part in the water: its kind, and those of all kinds."""
    more = {
        "point": POINT, "axes": {"type": "array", "shapes": ((3, 3),)}, "length": LENGTH, "diameter": LENGTH,
        "thickness": LENGTH, "height": LENGTH, "depths": ROW | {"unit": "m"}, "volumes": ROW | {"unit": "m3"},
        "size": {"type": "array", "unit": "m", "shapes": ((3,), (2,))},
        "added_mass": DIRECTION | {"unit": "kg"},
        "added_masses": {"type": "array", "unit": "kg", "shapes": ((-1, 3),)},
        "strips": {"type": "array", "shapes": ((2,), (1,), ())},
        "drag_area": {"type": "array", "unit": "m2", "shapes": ((3,),)},
        "mesh": {"type": "file", "text": "Of a mesh: an STL or glTF file."},
        "ends": {"type": "texts"}, "wall": LENGTH,
        "draughts": ROW | {"unit": "m"}, "slam": {"type": "number"}, "wetting": {"type": "number"},
    }  # fmt: skip
    of_mesh = keys_of(from_mesh, more=more, without=("density",))
    found = {key.name: key for key in of_mesh}
    found |= {key.name: key for kind in PARTS.values() for key in keys_of(kind, more=more)}
    kind = Key("kind", "text", required=True, choices=(*PARTS, "mesh"), text="What it is.")
    return (kind, *(replace(key, required=False) for key in found.values()))


def sea_keys() -> tuple[Key, ...]:
    several: dict[str, Any] = {
        "type": "tables",
        "keys": _system_keys(),
        "text": "Wave systems, in place of hs to count.",
    }
    of_state = keys_of(SeaState, more=CHOSEN | {"depth": LENGTH}, without=("systems", "seed"))
    plain = keys_of(
        sea.add_sea,
        more=CHOSEN | {
            **HEIGHT_AND_PERIOD, "spreading": NUMBER, "heading_deg": {"unit": "deg"},
            "cutoff": {"unit": "rad/s"}, "position": POINT | {"shapes": ((2,),)},
            "stretching": {"choices": STRETCHING},
            "current": {"type": "table", "keys": _current_keys()},
        },
        without=("sea",),
    )  # fmt: skip
    beside = tuple(replace(key, text=f"Beside systems. {key.text}") for key in of_state)
    return (*plain, *beside, Key(name="systems", **several))


def _current_keys() -> tuple[Key, ...]:
    units = {"depth": "m", "speed": "m/s", "direction_deg": "deg"}
    return keys_of(Current, more={name: EACH | {"unit": unit} for name, unit in units.items()})


def _system_keys() -> tuple[Key, ...]:
    frequency = {"unit": "rad/s"}
    own = keys_of(
        WaveSystem,
        more=CHOSEN | {"spreading": NUMBER, "minimum_omega": frequency, "maximum_omega": frequency},
    )
    shape = keys_of(sea.add_sea, more=HEIGHT_AND_PERIOD, only=("hs", "tp", "gamma"))
    return (*own, *(replace(key, required=key.name != "gamma") for key in shape))
