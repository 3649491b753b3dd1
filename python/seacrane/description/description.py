"""The bare description of a scene: its elements by name, and its sea."""

from __future__ import annotations

from collections.abc import Mapping
from copy import deepcopy
from dataclasses import dataclass, field, replace
from typing import Any, NoReturn, Protocol, TypeVar

from seacrane import _core
from seacrane.description.limit_state import LimitState, Range
from seacrane.description.provenance import VesselProvenance
from seacrane.description.roles import CraneRoles
from seacrane.description.vessel_hydrodynamics import VesselHydrodynamics
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of
from seacrane.inputs.shown import listed

GROUND = "ground"
STANDARD_GRAVITY = 9.80665
Some = TypeVar("Some", bound="Description")
COMPILED: Mapping[str, str] = {  # what the elements of each table are called
    "bodies": "body", "joints": "joint", "drivers": "driver", "actuators": "actuator",
    "point_forces": "point force", "springs": "spring", "force_tables": "force table",
    "function_forces": "function force", "loads": "load", "vessels": "vessel", "groups": "group",
    "points": "point",
}  # fmt: skip
KINDS: Mapping[str, str] = {
    **COMPILED, "recorded": "recorded coordinate", "ranges": "range", "roles": "crane",
    "provenance": "provenance", "limit_states": "limit state", "clearances": "clearance",
    "channels": "channel", "ratings": "rating", "lift_factors": "lift factors",
    "meshes": "mesh",
}  # fmt: skip
ELEMENTS = tuple(COMPILED)
SETTINGS = ("gravity", "baumgarte", "length_scale")
LOADS = tuple(key for key, kind in COMPILED.items() if kind in (*_core.LOAD_KINDS, "load"))
ANSWERS = "_answers"  # attribute: what was worked out of a scene, see `once`
Element = TypeVar("Element")


class Named(Protocol):
    """An element of a scene."""

    @property
    def name(self) -> str: ...


AnyNamed = TypeVar("AnyNamed", bound=Named)


@dataclass(kw_only=True, eq=False, repr=False)
class Description:
    """What a scene holds. `seacrane.Scene` is this with a method for everything that may be added.

    Parameters, elements and waves are as of `Scene`.

    Attributes
    ----------
    recorded : dict of str to (str, str)
        Joint and coordinate that are recorded under a name.
    ranges, limit_states, clearances, channels : dict of str to Range, LimitState and so on
        What `Scene.add_channel` and `add_limit_state` added.
    ratings, lift_factors : dict of str to Rating, LiftFactors
        What lines and slings break at; by loads, what their lifts are calculated with beside the scene.
    roles : dict of str to CraneRoles
        By the prefix of each crane's names.
    provenance : dict of str to VesselProvenance
        Where the hydrodynamics of each vessel come from; that of the sea is `waves.provenance`.
    meshes : dict of str to Mesh
        That bodies are drawn by; nothing that moves reads them.
    notes : dict
        The user's, plain data; files and results keep them, nothing reads them.
    """

    name: str = "scene"
    gravity: float = STANDARD_GRAVITY
    orientation: str = "quaternion"
    baumgarte: float = 0.0
    length_scale: float = 1.0
    bodies: dict[str, _core.Body] = field(default_factory=dict)
    joints: dict[str, _core.Joint] = field(default_factory=dict)
    drivers: dict[str, _core.Driver] = field(default_factory=dict)
    actuators: dict[str, _core.Actuator] = field(default_factory=dict)
    point_forces: dict[str, _core.PointForce] = field(default_factory=dict)
    springs: dict[str, _core.Spring] = field(default_factory=dict)
    force_tables: dict[str, _core.ForceTable] = field(default_factory=dict)
    function_forces: dict[str, _core.FunctionForce] = field(default_factory=dict)
    loads: dict[str, Any] = field(default_factory=dict)
    vessels: dict[str, VesselHydrodynamics] = field(default_factory=dict)
    groups: dict[str, _core.GroupHydrodynamics] = field(default_factory=dict)
    points: dict[str, _core.Point] = field(default_factory=dict)
    waves: Waves | None = None
    recorded: dict[str, tuple[str, str]] = field(default_factory=dict)
    ranges: dict[str, Range] = field(default_factory=dict)
    limit_states: dict[str, LimitState] = field(default_factory=dict)
    clearances: dict[str, Any] = field(default_factory=dict)
    channels: dict[str, Any] = field(default_factory=dict)
    ratings: dict[str, Any] = field(default_factory=dict)
    lift_factors: dict[str, Any] = field(default_factory=dict)
    roles: dict[str, CraneRoles] = field(default_factory=dict)
    provenance: dict[str, VesselProvenance] = field(default_factory=dict)
    meshes: dict[str, Any] = field(default_factory=dict)
    notes: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        held = vars(self)
        for key, kind in KINDS.items():  # a table belongs to one scene
            held[key] = table = Table(held[key])
            table.kind = kind
        self.notes = deepcopy(dict(self.notes)) if self.notes else {}
        self.warned = dict[str, None](held.get("warned", ()))  # messages, while it was described

    def __repr__(self) -> str:
        held = [
            f"{len(getattr(self, key))} {key.replace('_', ' ')}" for key in ELEMENTS if getattr(self, key)
        ]
        sea = ["waves"] if self.waves is not None else []
        return f"<{type(self).__name__} {self.name!r}: {', '.join([*held, *sea]) or 'empty'}>"

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name != ANSWERS}

    def __copy__(self: Some) -> Some:
        return self.copy()

    def copy(self: Some, **changes: Any) -> Some:
        """A scene with the same elements, which may be changed without touching this one.

        Parameters
        ----------
        **changes
            Fields that differ, such as ``name=`` or ``gravity=``.
        """
        if not changes.keys() <= self.__dict__.keys():
            return replace(self, **changes)  # which names what is no field
        out = object.__new__(type(self))
        out.__dict__.update(self.__dict__ | changes)
        out.__post_init__()
        return out


def all_loads(scene: Description) -> list[Any]:
    """Loads of all kinds."""
    return [element for key in LOADS for element in getattr(scene, key).values()]


def insert(kind: str, table: dict[str, Any], element: AnyNamed) -> AnyNamed:
    """Put an element into its table and return it; SceneError where the name is taken."""
    if element.name in table:
        held = table[element.name]
        has = next((of for of, one in _core.LOAD_KINDS.items() if isinstance(held, one)), kind)
        raise SceneError(
            f"{kind} {element.name!r}: the name is used twice: {has} {element.name!r} has it; give this one "
            "another, or remove that one first (Scene.remove); a cell that is run twice adds it twice: "
            "run it from Scene() on"
        )
    table[element.name] = element
    return element


def require(
    scene: Description, what: str, key: str, name: str, table: str = "bodies", *, ground: bool = False
) -> str:
    """The name that a keyword gives to an element of a table, or "ground" where it may be that.

    Raises SceneError where the scene has no such element.
    """
    held = getattr(scene, table)
    if text_of(f"{what}: {key}", name) not in held and not (ground and name == GROUND):
        known = listed([*held]) or "none"
        raise SceneError(f"{what}: there is no {KINDS[table]} {name!r}; add it first, the scene has {known}")
    return name


def coordinate_of(scene: Description, kind: str, joint: str, coordinate: str | None) -> str:
    """A coordinate of a joint, by default its usual one; SceneError where there is no such joint."""
    require(scene, kind, "joint", joint, "joints")
    about = _core.joint_kinds().get(scene.joints[joint].kind)
    usual = about.usual if about and about.usual else "displacement"
    return text_of(f"{kind} of joint {joint!r}: coordinate", coordinate, usual)


class Table(dict[str, Element]):
    """Elements of one kind, such as "point force", by name, in the order in which they were added; a name
    that is not there says so."""

    __slots__ = ("kind",)
    kind: str

    def __missing__(self, name: object) -> NoReturn:
        known = ", ".join(map(repr, self)) or "none"
        raise KeyError(f"there is no {self.kind} {name!r}; the scene has {known}")
