"""Keys of what stands inside tables of a lift file: stages, studies, curves; and what several share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from seacrane import _core
from seacrane.analysis.tanks import Tank
from seacrane.description.channels import CHANNELS, units_of
from seacrane.description.curves import spline_curve
from seacrane.description.waves import STRETCHING
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import LatinHypercube
from seacrane.hydro import load_database, part_from_mesh
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.hydro.parts.parts import PARTS
from seacrane.lift.keys import EITHER, Key, keys_of
from seacrane.run.method import FORMULATIONS
from seacrane.run.stage import Stage
from seacrane.scene import afloat, sea, vessel
from seacrane.scene.afloat import MEMORY
from seacrane.scene.mooring import MooringSpring
from seacrane.scene.motion_history import MotionHistory
from seacrane.scene.realised_sea import SPECTRA
from seacrane.scene.wind_current import gust_curve
from seacrane.sea import Current, SeaState, WaveSystem

CHOSEN: dict[str, dict[str, Any]] = {
    "spectrum": {"type": "text", "choices": SPECTRA},
    "evaluation": {"choices": ("table", "exact")},
    "placement": {"choices": ("jittered", "uniform")},
    "memory": {"choices": MEMORY},
    "kinematics": {"choices": ("yaw_following", "paper")},
    "orientation": {"choices": ("quaternion", "euler_xyz")},
    "formulation": {"choices": FORMULATIONS},
    "integrator": {"choices": tuple(_core.integrator_names())},
    "kind": {"choices": tuple(_core.joint_kinds())},
}
POINT: dict[str, Any] = {"type": "array", "unit": "m", "shapes": ((3,),)}
DIRECTION: dict[str, Any] = {"type": "array", "shapes": ((3,),)}
EACH: dict[str, Any] = {"type": "array", "shapes": ((-1,), ())}  # or one number for all
LENGTH: dict[str, Any] = {"unit": "m"}
ROW: dict[str, Any] = {"type": "array", "shapes": ((-1,),)}
TIME: dict[str, Any] = {"unit": "s"}
NUMBER = {"type": "number"}

# Stages
CHANNEL_UNITS = EITHER.join(dict.fromkeys(unit for name in CHANNELS for unit in units_of(name)))
COMMAND_UNITS = EITHER.join(("m", "rad", "m/s", "N", "N m", "1", "m2"))
WAITS = {
    "tension": "Line whose tension ends the stage.",
    "length": "Line whose unstretched length ends it.",
    "depth": "Body with parts in water, or part, the depth of whose lowest point ends it.",
    "channel": "Channel that ends it.",
    "clear": "Contact whose points are all at least so far from the surface.",
    "contact": "Limit that takes hold, or contact that is touched.",
    "release": "Limit that lets go, or contact that is left.",
}
UNTIL = (
    *(Key(name, "text", text=text) for name, text in WAITS.items()),
    Key("minimum", "number", CHANNEL_UNITS, "Met at this value and above."),
    Key("maximum", "number", CHANNEL_UNITS, "Met at this value and below."),
    Key("names", "names", text="One name for each dimension of the channel."),
)
COMMANDS = (
    Key("name", "text", text='Such as "hoist.rate".', required=True),
    Key("to", "number", COMMAND_UNITS, "Where a move ends."),
    Key("by", "number", COMMAND_UNITS, "How far it goes."),
    Key("over", "number", "s", "How long it takes."),
    Key("value", "number", COMMAND_UNITS, "A rate, force or share, reached within 1 s; the area of a hole."),
    Key("curve", "curve", COMMAND_UNITS, "On the stage's clock, 0 where it begins."),
)
STAGE = keys_of(
    Stage,
    more={
        "duration": TIME, "maximum_duration": TIME,
        "connect": {"type": "texts"}, "release": {"type": "texts"},
        "until": {"type": "tables", "keys": UNTIL, "text": "The first that is met ends the stage."},
        "commands": {"type": "tables", "keys": COMMANDS, "text": "What moves during it."},
    },
)  # fmt: skip

# Studies
LIFTS = ("case1", "case2", "case3", "vessel")  # lifts that come with the package, by their names
KEEP = (
    Key("name", "text", text="What it is called in tables, and in until.", required=True),
    *keys_of(Kept, more={"names": {"type": "names"}, "after": TIME, "interval": TIME}),
)
RANGE = (
    Key("first", "number", text="The first value.", required=True),
    Key("last", "number", text="The last one; by default values go on by ones."),
    Key("count", "whole", text="How many, evenly spaced.", required=True, bounds={"minimum": 1}),
)
DESIGN = keys_of(LatinHypercube, more={"ranges": {"type": "ranges"}})
STUDY = (
    Key(
        "lift", "file", choices=LIFTS,
        text="Path of a lift file, or a lift that comes with seacrane, whose tables stand where this file "
        "has none of the name; of [run] its keys.",
    ),
    Key(
        "over", "values",
        text="Values by parameter, of which all combinations are run: lists, or first, last and count.",
    ),
    Key(
        "design", "table", keys=DESIGN,
        text="So many members spread evenly over the ranges of all parameters, in place of over.",
    ),
    Key("keep", "tables", text="What each run leaves.", required=True, keys=KEEP),
    Key(
        "until", "limits",
        text="Half widths of 95 % intervals as shares of the dynamic part; seeds are added until then.",
    ),
    Key(
        "exposure", "number", "s", "Of the largest values; default: that of a run.",
        bounds={"exclusiveMinimum": 0},
    ),
)  # fmt: skip

# Tanks, pistons, coordinates, control and curves
TANK = (
    Key("name", "text", text="Differs from those of the other tanks.", required=True),
    *keys_of(Tank, more={"point": POINT, "capacity": {"unit": "kg"}, "content": {"unit": "kg"}}),
)
PISTON = (
    Key("cylinder", "text", text="Its label.", required=True),
    Key("full", "number", "m2", "Area of the full side.", required=True),
    Key("rod_side", "number", "m2", "Area of the rod side.", required=True),
)
COORDINATE = (
    Key("name", "text", text="Its label, such as boom.", required=True),
    Key("value", "number", "m or rad", "From the pose as drawn.", required=True),
)
TIMES = (
    Key("until", "number", "s", "End of this part.", required=True),
    Key("every", "number", "s", "Interval within it.", required=True),
)


def control_keys(tuned_at: tuple[Key, ...]) -> tuple[Key, ...]:
    """The keys of [control]; `tuned_at` are those of a crane's pose."""
    inertia = "Of every commanded coordinate, with the inertia that its drive feels."
    pose = "Pose of the cranes, on a fixed base, at which that inertia is taken; default: the start."
    loads = "Loads that hold them at rest: along their references (default), those of the start, or none."
    times = "At which the loads along the references are computed, from 0 s on, part after part."
    return (
        Key("natural_frequency", "number", "Hz", inertia, required=True),
        Key("damping_ratio", "number", text="Of critical damping.", required=True),
        Key("tuned_at", "table", text=pose, keys=tuned_at),
        Key("feed_forward", "text", text=loads, choices=("references", "start", "none")),
        Key("times", "tables", text=times, keys=TIMES),
        Key("period", "number", "s", "Of references that swing for ever; as `feed_forward`."),
    )


FROM = Key("from", "number", "s", "When it takes over from the piece before.", required=True)
SAMPLES: dict[str, dict[str, Any]] = {"times": ROW | TIME, "values": ROW}
CURVES: Mapping[str, tuple[Key, ...]] = {
    "constant": (Key("value", "number", required=True),),
    "quintic": (
        Key("start_time", "number", "s", required=True), Key("end_time", "number", "s", required=True),
        Key("start", "number", text="Value until start_time.", required=True),
        Key("end", "number", text="Value from end_time on.", required=True),
    ),
    "harmonic": (
        Key("amplitude", "number", required=True), Key("offset", "number"),
        Key("period", "number", "s", required=True), Key("start_time", "number", "s"),
        Key("phase", "number", "rad"),
    ),
    "spline": keys_of(spline_curve, more=SAMPLES),
    "table": (
        Key("times", **SAMPLES["times"], text="That increase.", required=True),
        Key("values", **SAMPLES["values"], text="At these times.", required=True),
        Key(
            "between", "text", choices=("linear", "cubic"),
            text="Straight (default), or with continuous rate and acceleration, at rest at both ends.",
        ),
    ),
    "gust": keys_of(gust_curve, more={"mean_speed": {"unit": "m/s"}, "duration": TIME, "height": LENGTH}),
}  # fmt: skip


SHIPPED = ("hull_115",)  # databases that come with the package, by their names
HEIGHT_AND_PERIOD = {
    "hs": LENGTH | {"bounds": {"minimum": 0.0}}, "tp": TIME | {"bounds": {"exclusiveMinimum": 0.0}}
}  # fmt: skip
OF_MOTION = ("ramp", "duration", "size")
READING: dict[str, Any] = {  # of a vessel's database
    "speed": {"unit": "m/s"},
    "depth": {"unit": "m"},
    "mass_matrix": {"type": "array", "unit": "kg, kg m, kg m2", "shapes": ((6, 6),)},
}


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
        "slack_moment": EACH | {"unit": "kg m"},
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
        *keys_of(vessel.add_given, described=vessel.add_vessel, more=more, only=OF_MOTION),
        Key("mooring_period", "number", "s", mooring),
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
    of_mesh = keys_of(part_from_mesh, more=more, without=("density",))
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
    units = {"depth": "m", "speed": "m/s", "direction_deg": "deg"}
    current = {name: EACH | {"unit": unit} for name, unit in units.items()}
    of_state = keys_of(SeaState, more=CHOSEN | {"depth": LENGTH}, without=("systems", "seed"))
    plain = keys_of(
        sea.add_sea,
        more=CHOSEN | {
            **HEIGHT_AND_PERIOD, "spreading": NUMBER, "heading_deg": {"unit": "deg"},
            "cutoff": {"unit": "rad/s"}, "position": POINT | {"shapes": ((2,),)},
            "stretching": {"choices": STRETCHING},
            "current": {"type": "table", "keys": keys_of(Current, more=current)},
        },
        without=("sea",),
    )  # fmt: skip
    beside = tuple(replace(key, text=f"Beside systems. {key.text}") for key in of_state)
    return (*plain, *beside, Key(name="systems", **several))


def _system_keys() -> tuple[Key, ...]:
    frequency = {"unit": "rad/s"}
    own = keys_of(
        WaveSystem,
        more=CHOSEN | {"spreading": NUMBER, "minimum_omega": frequency, "maximum_omega": frequency},
    )
    shape = keys_of(sea.add_sea, more=HEIGHT_AND_PERIOD, only=("hs", "tp", "gamma"))
    return (*own, *(replace(key, required=key.name != "gamma") for key in shape))
