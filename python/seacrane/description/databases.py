"""The databases of a scene's vessels: asked for, held against another one, in a scene file."""

from __future__ import annotations

import base64
import binascii
import hashlib
import zlib
from functools import lru_cache
from typing import Any, TypeVar

from seacrane.description.description import Description
from seacrane.description.loads import changed
from seacrane.description.provenance import VesselProvenance
from seacrane.description.vessel_hydrodynamics import Source, VesselHydrodynamics, alike
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.hydro.data.packed import NOT_PACKED, digest_of, packed, unpacked
from seacrane.inputs.node import Node
from seacrane.inputs.shown import shown

LARGEST = 256 * 2**20  # bytes; 1,000 frequencies x 72 headings take 20 MiB
LETTERS = 12  # of a digest in a message
Some = TypeVar("Some", bound=Description)


def source_of(scene: Description, body: str | None) -> Source | None:
    """By what a sea loads or moves the vessel of a body; None where the scene does not know."""
    return next((one.database for one in scene.vessels.values() if one.body == body), None)


def database_of(
    scene: Description, body: str, what: str, given: HydroDatabase | None = None
) -> HydroDatabase:
    """The database of the vessel of a body, or the one given: the same ship at a forward speed. SceneError
    where there is none, with what needs it, or where the one given is another one of zero speed."""
    vessel = next((one for one in scene.vessels.values() if one.body == body), None)
    if given is not None:
        if not isinstance(given, HydroDatabase):
            raise SceneError.of(
                "database", f"is {shown(given)}; give a HydroDatabase, as load_database reads"
            )
        if vessel is not None and given.speed == 0.0:
            require_alike(scene, vessel, given)
        return given
    if vessel is not None and isinstance(vessel.database, HydroDatabase):
        return vessel.database
    name = body if vessel is None else vessel.name
    raise SceneError(
        f"vessel {body!r} has no database, which {what} needs; add it by scene.add_vessel(database), or give "
        f"it the one that it was added from: scene.replace({name!r}, kind='vessel', database=database)"
    )


def require_alike(scene: Description, vessel: VesselHydrodynamics, given: Source) -> None:
    """Refuse a database for a vessel that is from another one."""
    if not isinstance(given, Source):
        return  # the vessel says so
    held, known = vessel.database, scene.provenance.get(vessel.name, VesselProvenance())
    if held is not None and not alike(held, given):
        raise SceneError(
            f"vessel {vessel.name!r} is from database {_told(held)}, and {_told(given)} is another; leave it "
            "out, or remove the vessel and add it from that one"
        )
    band = (float(given.omega[0]), float(given.omega[-1]))
    if held is None and known.database is not None and (given.name, band) != (known.database, known.omega):
        raise SceneError(
            f"vessel {vessel.name!r} is from database {known.database!r} of {known.omega} rad/s, and "
            f"{_told(given)} of {band} rad/s is another; give the one that the vessel was added from"
        )


def _told(source: Source) -> str:
    return f"{source.name!r} (digest {digest_of(source)[:LETTERS]})"


def without_databases(scene: Some) -> Some:
    """A copy of the scene that takes less to send to other processes; it moves alike."""
    out = scene.copy()
    for name, vessel in scene.vessels.items():
        out.vessels[name] = changed(vessel, database=None)
    return out


def databases_to_data(scene: Description) -> list[dict[str, Any]]:
    """Each once, however many vessels are from it."""
    found: dict[str, dict[str, Any]] = {}
    for name, vessel in scene.vessels.items():
        if vessel.database is not None:
            digest = digest_of(vessel.database)
            entry = {"digest": digest, "vessels": [], "data": _text_of(vessel.database)}
            found.setdefault(digest, entry)["vessels"].append(name)
    return list(found.values())


@lru_cache(maxsize=8)
def _text_of(source: Source) -> str:
    return base64.b64encode(zlib.compress(packed(source), 1)).decode("ascii")


def databases_from_node(node: Node, scene: Description) -> None:
    """Give the vessels of a scene the databases that a file holds; raises FileFormatError."""
    for entry in node.items():
        entry.expect(("digest", "vessels", "data"))
        source = _source(entry)
        for one in entry.at("vessels").items():
            name = one.text()
            if name not in scene.vessels:
                known = ", ".join(map(repr, scene.vessels))
                one.fail(f"give a vessel of the scene: {known or 'it has none'}")
            scene.vessels[name] = changed(scene.vessels[name], database=source)


def _source(entry: Node) -> Source:
    path = entry.at("data").path
    try:
        unpacker = zlib.decompressobj()
        data = unpacker.decompress(base64.b64decode(entry.at("data").text(), validate=True), LARGEST)
    except (binascii.Error, ValueError, zlib.error) as error:
        raise FileFormatError(f"{path}: is damaged ({error}); save the scene again") from error
    if not unpacker.eof or hashlib.sha256(data).hexdigest() != entry.at("digest").text():
        raise FileFormatError(f"{path}: is damaged, or not of its digest; save the scene again")
    try:
        made: Source = unpacked(data, (HydroDatabase, MotionRaos))
    except NOT_PACKED as error:
        raise FileFormatError(f"{path}: is no database that this seacrane reads ({error})") from error
    return made
