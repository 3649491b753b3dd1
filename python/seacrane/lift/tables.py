"""The tables of a lift file: each is a call of the API, in the order in which the calls are made."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from seacrane import _core
from seacrane.crane.load_crane import shipped_cranes
from seacrane.crane.parts import Payload
from seacrane.description import elements
from seacrane.description.hydraulic_cylinders import VALUES
from seacrane.hydro import Compartment, Opening
from seacrane.inputs.values import entries_of
from seacrane.lift.answer_keys import ANSWERS
from seacrane.lift.inner_keys import (
    CHANNEL_UNITS,
    CHOSEN,
    COORDINATE,
    DIRECTION,
    EACH,
    LENGTH,
    NUMBER,
    PISTON,
    POINT,
    ROW,
    STAGE,
    STUDY,
    TANK,
    TIME,
    control_keys,
    part_keys,
    sea_keys,
    vessel_keys,
)
from seacrane.lift.keys import Key, field_keys, keys_of, parameter_texts
from seacrane.lift.sheet_keys import SHEET
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.scene import (
    bodies,
    heave,
    hoist,
    hydraulics,
    immersed,
    lift_factors,
    limits,
    lines,
    recorded,
    rigging,
    roles,
    sea,
    springs,
    vessel,
    wind_current,
)
from seacrane.scene.add_crane import add_crane
from seacrane.scene.ballast import add_ballast
from seacrane.scene.hung_load import Slings
from seacrane.scene.line_fluid import Seabed, Wire
from seacrane.scene.scene import Scene
from seacrane.simulation import simulate

LEFT = ("left",)  # of a heel or trim: as it comes
START: dict[str, Any] = {
    "type": "text",
    "choices": ("rest",),
    "text": '"rest" finds the state at rest; default: as described.',
}
LIMITED = {"unit": CHANNEL_UNITS}
FRAME = {"type": "table", "keys": field_keys(_core.Frame.FIELDS)}


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table of a lift file."""

    name: str
    text: str  # what it is, for people
    keys: tuple[Key, ...]
    several: bool = True  # whether there may be more than one, each as ``[[name]]``
    add: Callable[..., Any] | None = None  # is called with the scene and the keywords; None: several calls


def _call(
    name: str, add: Callable[..., Any], *classes: type, several: bool = True, without: Collection[str] = (),
    only: Collection[str] | None = None, described: Any = None, **more: Mapping[str, Any],
) -> Table:  # fmt: skip
    """A table that is one call, as of a method of `Scene`."""
    keys = keys_of(add, *classes, more=CHOSEN | more, without=without, only=only, described=described)
    return Table(name=name, text=_summary(add), keys=keys, add=add, several=several)


def _values(element: type, kinds: Mapping[str, type], **more: Mapping[str, Any]) -> dict[str, Any]:
    """Keywords that are values of entries of an element, as tables within its own."""
    return {
        word: {"type": "table", "keys": keys_of(kind, element, entries=entries_of(word, kind), more=more)}
        for word, kind in kinds.items()
    }


def _summary(call: Any) -> str:
    return " ".join((call.__doc__ or "").split("\n\n")[0].split())


def _joint_keys() -> tuple[Key, ...]:
    """The keys of `add_joint`, and the parameters of all kinds of joints."""
    places = {key: POINT for key in ("point", "second_point")} | {
        key: DIRECTION for key in ("axis", "second_axis")
    }
    keys = keys_of(elements.add_joint, more=CHOSEN | places | {"first_frame": FRAME, "second_frame": FRAME})
    parameters = [field for kind in _core.joint_kinds().values() for field in kind.parameters]
    return (*keys, *(replace(key, required=False) for key in field_keys(parameters)))


def _flow(name: str, add: Callable[..., Any]) -> Table:
    """Wind or current."""
    more = {"angle": ROW | {"unit": "rad"}, "x": ROW, "y": ROW, "yaw": ROW}
    inside = {"type": "table", "keys": keys_of(wind_current.FlowCoefficients, more=more)}
    draught = LENGTH | {"text": parameter_texts(add).get("draught", "")}
    wind = wind_current.add_wind
    return _call(name, add, _core.FlowForce, described=wind, coefficients=inside, draught=draught)


SLINGS = keys_of(
    Slings,
    more={
        "EA": {"unit": "N"},
        "length": LENGTH,
        "angle_deg": {"unit": "deg"},
        "breaking_load": {"unit": "N"},
        "points": ROW | {"unit": "m", "shapes": ((-1, 3),)},
        "rung": {"choices": lines.STRETCHING},
    },
)
SEABED = keys_of(Seabed, more={"depth": LENGTH, "stiffness": {"unit": "N/m2"}, "give": LENGTH})
WIRE: dict[str, Any] = {
    "type": "table",
    "keys": keys_of(Wire, more={
        "mass_per_length": {"unit": "kg/m"}, "diameter": LENGTH, "density": {"unit": "kg/m3"},
        "flow": {"type": "array", "unit": "m/s", "shapes": ((3,),)},
        "seabed": {"type": "table", "keys": SEABED},
    }),
}  # fmt: skip
CONTACT: dict[str, Any] = {
    "points": ROW | {"unit": "m", "shapes": ((-1, 3),)},
    "surface": {"type": "text", "choices": limits.SURFACES},
    "place": POINT, "axis": DIRECTION, "size": ROW | {"unit": "m", "shapes": ((-1,),)}, "edge": LENGTH,
    "stiffness": {"unit": "N/m"}, "depth": LENGTH,
    "table": {"type": "array", "unit": "m, N", "shapes": ((-1, 2),)},
}  # fmt: skip
FEET = keys_of(
    limits.add_contact, _core.Contact, only=hoist.FEET_KEYS,
    more={key: CONTACT.get(key, {}) | {"required": False} for key in hoist.FEET_KEYS},
)  # fmt: skip
OPENINGS = keys_of(Opening, more={"point": POINT, "area": {"unit": "m2"}})
INSIDE = keys_of(Compartment, _core.EntrappedWater, more={
    "air": {"choices": ("free", "vented", "shut")},
    "openings": {"type": "tables", "keys": OPENINGS, "text": "Holes in its wall, 12 at most."},
})  # fmt: skip
PAYLOAD = keys_of(Payload, more={"mass": {"unit": "kg"}, "size": POINT, "link_length": LENGTH})
POSE: dict[str, dict[str, Any]] = {
    "slew": {"unit": "rad"}, "s1": LENGTH, "s2": LENGTH,
    "coordinates": {"type": "tables", "keys": COORDINATE},
}  # fmt: skip
RAM = _call(
    "hydraulic_cylinder", hydraulics.add_hydraulic_cylinder, _core.HydraulicCylinder,
    **_values(_core.HydraulicCylinder, VALUES),
)  # fmt: skip
PLACED = ("name", "first", "second", "first_point", "second_point", "retracted_length", "stroke")
OIL = tuple(replace(key, required=False) for key in RAM.keys if key.name not in PLACED)
HYDRAULICS = tuple(Key(label, "table", keys=OIL) for label in ("main", "knuckle"))
CRANE = keys_of(
    add_crane,
    more=POSE
    | {
        "crane": {"type": "file", "choices": tuple(shipped_cranes())},
        "foot": POINT,
        "payload": {"type": "table", "keys": PAYLOAD},
        "payload_mass": {"unit": "kg"},
        "stiffness": {"unit": "N/m"},
        "hydraulics": {"type": "table", "keys": HYDRAULICS},
    },
)
CONTROL = control_keys(tuple(key for key in CRANE if key.name in (*POSE, "payload")))
COMMAND = keys_of(elements.add_actuator, _core.Actuator, only=("joint", "name", "coordinate", "reference"))


def _of_kinds() -> Iterator[Table]:
    """Of loads that are the one call of their kind, whose keywords are all entries of `FIELDS`."""
    for kind, type_ in _core.LOAD_KINDS.items():
        word = kind.replace(" ", "_")
        add = getattr(Scene, f"add_{word}", None)
        known = {"scene", *(field.name for field in type_.FIELDS)}
        if add and known.issuperset(inspect.signature(add).parameters):
            yield _call(word, add, type_)


ONE_CALL = tuple(_of_kinds())
_ALL = (
    replace(
        _call(
            "scene", Scene, several=False, gravity={"unit": "m/s2"}, baumgarte={"unit": "1/s"},
            only=("name", "gravity", "orientation", "baumgarte", "length_scale"),
        ),
        text="Name and settings of the scene.",
    ),
    Table(
        name="vessel", keys=vessel_keys(),
        text="A vessel that floats, from a hydrodynamic database, or one whose motion is given.",
    ),
    _call("body", bodies.add_body, _core.Body, inertia={"shapes": ((3, 3), (3,))}, drop=LENGTH),
    Table(
        name="hydrodynamics", text="Hydrodynamics of a body by their matrices.",
        keys=tuple(
            replace(key, required=key.name == "body", choices=CHOSEN.get(key.name, {}).get("choices", ()))
            for key in field_keys(_core.VesselHydrodynamics.FIELDS, without=("memory",))
        ),
        add=vessel.add_vessel,
    ),
    Table(name="sea", text=_summary(sea.add_sea), keys=sea_keys()),
    Table(name="crane", text=_summary(add_crane), keys=CRANE),
    Table(name="joint", text=_summary(elements.add_joint), keys=_joint_keys(), add=elements.add_joint),
    _call("driver", elements.add_driver, _core.Driver),
    _call(
        "force", elements.add_force, _core.ForceTable, _core.PointForce, without=("parameters",),
        force={"shapes": ((3,), (-1, 6))},
    ),
    _call(
        "line", lines.add_line, _core.Line,
        tension_at_start={"unit": "N"}, first_point=POINT, second_point=POINT,
        sticking_speed={"unit": "m/s"}, breaking_load={"unit": "N"}, rung={"choices": lines.RUNGS},
        wire=WIRE, sheaves={"type": "table", "keys": keys_of(lines.Sheaves, _core.Line)},
    ),
    _call(
        "roles", roles.add_roles, without=("ropes",),
        cylinders={"type": "names"}, luffs={"type": "names"},
        tip={"type": "table", "keys": (Key("body", "text", required=True),
                                       Key("point", required=True, **POINT))},
        capacity={"type": "array", "unit": "m, kg", "shapes": ((-1, 2),)},
        areas={"type": "tables", "keys": PISTON},
    ),
    _call(
        "hoist", hoist.add_hoist,
        mass={"unit": "kg"}, size=POINT, length=LENGTH, height=LENGTH, slack=LENGTH, EA={"unit": "N"},
        crane={"type": "text"}, stiffness={"unit": "N/m"},
        block_mass={"unit": "kg"}, breaking_load={"unit": "N"},
        rung={"choices": lines.RUNGS}, slings={"type": "table", "keys": SLINGS},
        winch={"type": "table", "keys": keys_of(rigging.add_winch, _core.Line, without=("line",))},
        feet={"type": "table", "keys": FEET},
        wire=WIRE,
    ),
    _call("winch", rigging.add_winch, _core.Line),
    _call(
        "spring", springs.add_spring, _core.GasSpring, _core.PendulumDamping, _core.Spring,
        damping_ratio={"bounds": {"minimum": 0.0}},
        **_values(_core.GasSpring, springs.VALUES, force={"unit": "N"}, stiffness={"unit": "N/m"}),
    ),
    RAM,
    _call("hold_pressures", hydraulics.hold_pressures, several=False),
    _call(
        "immersed", immersed.add_immersed, _core.ImmersedPart,
        parts={"type": "tables", "keys": part_keys()}, inside={"type": "table", "keys": INSIDE},
    ),
    *ONE_CALL,
    _flow("wind", wind_current.add_wind),
    _flow("current", wind_current.add_current),
    _call("stop", limits.add_stop, _core.SoftStop, _core.Limit),
    _call("contact", limits.add_contact, _core.Contact, **CONTACT),
    _call("point", recorded.add_point, _core.Point),
    _call(
        "channel", recorded.add_channel, points={"type": "texts"}, center=POINT, size=POINT,
        minimum={"unit": "m or rad"}, maximum={"unit": "m or rad"},
    ),
    _call(
        "lift_factors", lift_factors.add_lift_factors,
        center_of_gravity=POINT, skew_load=EACH, shackle_breaking_load={"unit": "N"},
        sources={"type": "names"},
    ),
    _call(
        "limit_state", recorded.add_limit_state,
        maximum=NUMBER | LIMITED, minimum=NUMBER | LIMITED, names={"type": "names"},
    ),
    _call(
        "mesh", bodies.add_mesh, without=("vertices", "faces"), file={"type": "file", "required": True},
        frame=FRAME,
    ),
    Table(
        name="balance", several=False,
        text="A constant force on a vessel that carries the weight of all else at the start: its ballast.",
        keys=(Key("vessel", "text", required=True, text="Its body."),),
    ),
    _call(
        "ballast", add_ballast,
        heel_deg={"unit": "deg", "choices": LEFT}, trim_deg={"unit": "deg", "choices": LEFT},
        tanks={"type": "tables", "keys": TANK, "text": "Without them one force."},
    ),
    Table(name="control", several=False, text="How commanded coordinates are controlled.", keys=CONTROL),
    Table(
        name="command", keys=COMMAND,
        text="A joint coordinate that follows a reference: an actuator with gains and loads by [control].",
    ),
    _call(
        "heave_compensation", heave.add_heave_compensation, _core.HeaveCompensator, direction=DIRECTION,
        **_values(_core.HeaveCompensator, heave.VALUES),
    ),
    Table(name="stage", text=_summary(Stage), keys=STAGE),
    Table(
        name="run", several=False, text="How long a run takes, and where it begins.",
        keys=keys_of(
            simulate, more={"t_end": TIME, "start": START, "accuracy": {"type": "limits"}},
            only=("t_end", "start", "accuracy"),
        ),
    ),
    _call("method", Method, several=False, dt=TIME, maximum_step=TIME),
    _call("outputs", Outputs, several=False, dt_out=TIME, channels={"type": "texts"}),
    Table(
        name="study", several=False, keys=STUDY,
        text="Many runs of the lift: what varies, what each leaves, and when it is enough.",
    ),
    Table(
        name="sheet", several=False, keys=SHEET,
        text="The seas that each phase of the lift allows, held against a forecast and a hindcast.",
    ),
    *(Table(name=name, text=_summary(one.make), keys=one.keys) for name, one in ANSWERS.items()),
    Table(
        name="notes", several=False, text="Notes of the user: texts, numbers and lists under any names.",
        keys=(Key("*", "notes"),),
    ),
)  # fmt: skip
ASIDE = ("run", "method", "outputs", "stage", "study", "sheet", *ANSWERS)  # of no scene, beside notes
TABLES: Mapping[str, Table] = MappingProxyType({table.name: table for table in _ALL})
