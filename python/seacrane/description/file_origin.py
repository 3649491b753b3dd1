"""Roles and provenance in a scene file."""

from __future__ import annotations

from dataclasses import fields
from typing import Any

from seacrane.description.crane_parts import add_roles
from seacrane.description.description import Description
from seacrane.description.luffing_rope import LuffingRope
from seacrane.description.provenance import SEA_KINDS, SeaProvenance, VesselProvenance
from seacrane.description.roles import CraneRoles, Vector
from seacrane.errors import FileFormatError
from seacrane.inputs.node import Node
from seacrane.inputs.plain_data import notes_from_node, plain_data
from seacrane.inputs.shown import shown

_TEXTS = ("link", "line", "payload", "structure")  # roles that are there or not
_ROLES = (
    "prefix", "slew", "cylinders", "tip", "capacity", "areas", "luffs", "ropes", "held", "design_factor",
    *_TEXTS,
)  # fmt: skip
_VESSEL = tuple(one.name for one in fields(VesselProvenance))


def roles_to_data(roles: CraneRoles) -> dict[str, Any]:
    """As plain data."""
    slew, tip = roles.slew, roles.tip
    return {
        "prefix": roles.prefix,
        "slew": None if slew is None else {"joint": slew[0], "coordinate": slew[1]},
        "cylinders": [{"name": name, "joint": joint} for name, joint in roles.cylinders.items()],
        "tip": None if tip is None else {"body": tip[0], "point": list(tip[1])},
        "capacity": [list(row) for row in roles.capacity],
        "areas": [{"name": name, "areas": list(pair)} for name, pair in roles.areas.items()],
        "luffs": [
            {"name": name, "joint": joint, "coordinate": coordinate}
            for name, (joint, coordinate) in roles.luffs.items()
        ],
        "ropes": [{"luff": label, **_rope_to_data(rope)} for label, rope in roles.ropes.items()],
        "held": roles.held,
        "design_factor": roles.design_factor,
        **{key: getattr(roles, key) for key in _TEXTS},
    }


def roles_from_node(node: Node, scene: Description) -> None:
    """Give a scene the roles that `roles_to_data` wrote; raises FileFormatError."""
    for entry in node.items():
        entry.expect(_ROLES)
        found: dict[str, Any] = {"prefix": entry.at("prefix").text(), "cylinders": _cylinders(entry)}
        found |= {key: part.text() for key in _TEXTS if (part := _optional(entry, key)) is not None}
        if (slew := _optional(entry, "slew")) is not None:
            found["slew"] = tuple(_texts(slew, "joint", "coordinate"))
        if (tip := _optional(entry, "tip")) is not None:
            tip.expect(("body", "point"))
            found["tip"] = (tip.at("body").text(), tip.at("point").array((3,)))
        if entry.at("capacity").values():
            found["capacity"] = entry.at("capacity").array((-1, 2))
        rows = [_texts(one, "name", "joint", "coordinate") for one in entry.at("luffs").items()]
        found["luffs"] = {name: (joint, coordinate) for name, joint, coordinate in rows}
        found["areas"] = _areas(entry)
        found["ropes"] = dict(_rope_from_node(one) for one in entry.at("ropes").items())
        found["design_factor"] = entry.at("design_factor").number()
        found["held"] = entry.at("held").flag()
        with entry.scene_errors():
            add_roles(scene, **found)


def _optional(node: Node, key: str) -> Node | None:
    return None if node.at(key).value is None else node.at(key)


def _texts(node: Node, *keys: str) -> list[str]:
    node.expect(keys)
    return [node.at(key).text() for key in keys]


def _cylinders(node: Node) -> dict[str, str]:
    return {
        name: joint for name, joint in (_texts(one, "name", "joint") for one in node.at("cylinders").items())
    }


def _areas(node: Node) -> dict[str, Any]:
    found = {}
    for one in node.at("areas").items():
        one.expect(("name", "areas"))
        found[one.at("name").text()] = one.at("areas").array((2,))
    return found


def _rope_to_data(rope: LuffingRope) -> dict[str, Any]:
    ends = {key: {"body": body, "point": list(point)} for key, (body, point) in _ends(rope).items()}
    return {"name": rope.name, "falls": rope.falls, "EA": rope.EA} | ends


def _ends(rope: LuffingRope) -> dict[str, tuple[str, Vector]]:
    return {"first": rope.first, "second": rope.second}


def _rope_from_node(node: Node) -> tuple[str, LuffingRope]:
    """The hinge's label, and the rope."""
    node.expect(("luff", "name", "falls", "EA", "first", "second"))
    ends = {}
    for key in ("first", "second"):
        node.at(key).expect(("body", "point"))
        x, y, z = node.at(key).at("point").array((3,)).tolist()
        ends[key] = (node.at(key).at("body").text(), (x, y, z))
    falls, axial = (node.at(key).number() for key in ("falls", "EA"))
    rope = LuffingRope(name=node.at("name").text(), falls=int(falls), EA=axial, **ends)
    return node.at("luff").text(), rope


def provenance_from_node(node: Node, scene: Description) -> None:
    """Give a scene's vessels the provenance that a file holds; raises FileFormatError."""
    for entry in node.items():
        entry.expect(("name", *_VESSEL))
        known: dict[str, Any] = {}
        for key, count in (("omega", 2), ("size", 3), ("free_surface", 3), ("slack_tanks", 2)):
            row = _optional(entry, key)
            known[key] = None if row is None else tuple(row.array((count,)).tolist())
        for key in ("database", "memory", "motion", "record"):
            text = _optional(entry, key)
            known[key] = None if text is None else text.text()
        for key in ("ramp", "duration", "memory_error"):
            number = _optional(entry, key)
            known[key] = None if number is None else number.number()
        scene.provenance[entry.at("name").text()] = VesselProvenance(**known)


def sea_to_data(provenance: SeaProvenance) -> dict[str, Any]:
    """What is known, as plain data."""
    return dict(plain_data("waves: provenance", {**provenance.settings(), **provenance.stats()}))


def sea_from_node(node: Node) -> SeaProvenance:
    """What `sea_to_data` wrote; raises FileFormatError."""
    found = notes_from_node(node)
    for key, value in found.items():
        if key not in SEA_KINDS:
            raise FileFormatError(
                f"{node.path}: has an unknown entry {shown(key)}; known are {', '.join(SEA_KINDS)}"
            )
        kind, told = SEA_KINDS[key]
        if not isinstance(value, kind) or isinstance(value, bool):
            node.at(key).fail(f"give {told}")
    return SeaProvenance(**found)
