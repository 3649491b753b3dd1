"""Triangles of STL files and glTF models. trimesh reads them, once it is known how large they get."""

from __future__ import annotations

import json
import re
import struct
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole

STL_HEADER, STL_RECORD, MOST_SOLIDS = 84, 50, 1000  # bytes
MOST_TRIANGLES = 200_000  # of all meshes of a body together: pages stay a few MB
VERTEX = re.compile(rb"vertex(?:[ \t]+\S+){3}[ \t\r]*\n")
MAGIC = b"glTF"
TRIANGLES, FAN = 4, 6  # modes
Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # of glTF's y up


def read_stl(path: str | PathLike[str], *, most: int | None = None) -> Array:
    """Triangles of an STL file, ASCII or binary, in its own unit and axes; needs trimesh (`seacrane[mesh]`).

    The stored normals are not read: the order of the vertices (anticlockwise from outside) says as much.

    Parameters
    ----------
    path : path-like
    most : int, optional
        Triangles that the file may have; default: as many as fit the largest file that is read.

    Returns
    -------
    (n, 3, 3) triangle, vertex, xyz.

    Raises
    ------
    seacrane.errors.FileFormatError : missing, empty, truncated or malformed; or without trimesh.
    """
    source, content = _content(path, "export a coarser surface")
    count = int.from_bytes(content[80:STL_HEADER], "little")
    if len(content) != STL_HEADER + STL_RECORD * count:  # ASCII; some binary headers begin with "solid" too
        text = content.lower()
        facets = text.split(b"endfacet")[:-1]
        count = len(facets)
        if text.lstrip()[:5] != b"solid" or b"endsolid" not in text or text.count(b"endsolid") > MOST_SOLIDS:
            raise FileFormatError(
                f"{source}: {len(content)} bytes are neither ASCII STL, of 'solid' to 'endsolid', up to "
                f"{MOST_SOLIDS} times, nor binary STL; it is truncated or of another kind: export it again"
            )
        if any(not 3 == len(VERTEX.findall(one)) == one.count(b"vertex") for one in facets):
            raise FileFormatError(f"{source}: has a facet without three 'vertex x y z'; export it again")
    _require_few(source, count, most)
    with _refusing(source):
        from trimesh.exchange import stl

        with warnings.catch_warnings(
            action="error", category=DeprecationWarning
        ):  # of text that is no number
            loaded = stl.load_stl(BytesIO(content))
        solids = loaded["geometry"].values() if "geometry" in loaded else [loaded]
        soup = [np.asarray(one["vertices"], dtype=float).reshape(-1, 3, 3) for one in solids]
        if sum(map(len, soup)) != count:
            raise ValueError(f"{sum(map(len, soup))} of {count} facets are read")
    return _checked(source, soup)


def read_gltf(path: str | PathLike[str], *, most: int) -> Array:
    """Triangles of a glTF model (.glb, or .gltf with its buffers inside), in m, z up: x stays, y becomes z.

    FileFormatError for what is missing, truncated, malformed, of more than `most` triangles, or has parts
    that are not read; or without trimesh.
    """
    source, content = _content(path, "decimate the mesh in the program that made it")
    with _refusing(source):
        from trimesh.exchange import gltf

        begin, end = 0, len(content)
        if content.startswith(MAGIC):
            version, size, text_size = struct.unpack_from("<III", content, 4)
            if (version, size) != (2, len(content)):
                raise ValueError(f"version {version}, {size} bytes, of which {len(content)} are there")
            begin, end = 20, 20 + text_size
        _require_plain(source, json.loads(content[begin:end]))
        load = gltf.load_glb if begin else gltf.load_gltf
        parts = list(_placed(load(BytesIO(content), skip_materials=True)))
        _require_few(source, sum(len(faces) for _, _, faces in parts), most)
        with np.errstate(over="ignore", invalid="ignore"):
            soup = [(points @ turn[:3, :3].T + turn[:3, 3])[faces] @ Z_UP.T for turn, points, faces in parts]
    return _checked(source, soup)


def _content(path: str | PathLike[str], fix: str) -> tuple[Path, bytes]:
    source = Path(path)
    try:
        return source, read_whole(source, fix=fix)
    except OSError as error:
        raise FileFormatError(f"{source}: cannot be read ({error}); give the path of a mesh") from error


@contextmanager
def _refusing(source: Path) -> Iterator[None]:
    """What a damaged file leads to names the file and the fix."""
    try:
        yield
    except FileFormatError:
        raise
    except ImportError:
        raise FileFormatError(
            f"{source}: meshes need trimesh; install it with pip install 'seacrane[mesh]'"
        ) from None
    except Exception as error:
        raise FileFormatError(
            f"{source}: is damaged or truncated: {shown(error)}; export it again"
        ) from error


def _require_few(source: Path, count: int, most: int | None) -> None:
    if most is not None and count > most:
        raise FileFormatError(
            f"{source}: has {count} triangles, above {most}; decimate the mesh in the program that made it"
        )


def _checked(source: Path, soup: list[Array]) -> Array:
    """The triangles of all parts, where there are any and all are finite."""
    if not sum(map(len, soup)):
        raise FileFormatError(f"{source}: holds no triangles; export it again")
    triangles = np.concatenate(soup)
    bad = np.flatnonzero(~np.isfinite(triangles).all(axis=(1, 2)))
    if bad.size:
        raise FileFormatError(
            f"{source}: triangle {bad[0] + 1} has a coordinate that is not finite; repair it"
        )
    return triangles


def _require_plain(source: Path, document: Any) -> None:
    """Refuse what trimesh would pass over, or take for something else."""
    if document.get("extensionsRequired"):
        needed = shown(document["extensionsRequired"])
        raise FileFormatError(f"{source}: needs the extensions {needed}; export it without compression")
    if not all(one.get("uri", "data:").startswith("data:") for one in document["buffers"]):
        raise FileFormatError(f"{source}: has a buffer in another file; export it as .glb")
    if any("sparse" in one or "bufferView" not in one for one in document["accessors"]):
        raise FileFormatError(f"{source}: has numbers that are sparse; export it without morphing")
    surfaces = [one for mesh in document["meshes"] for one in mesh["primitives"]]
    if any(one.get("mode", TRIANGLES) == FAN for one in surfaces):
        raise FileFormatError(f"{source}: has a fan; export separate triangles")


def _placed(loaded: dict[str, Any]) -> Iterator[tuple[Array, Array, NDArray[np.intp]]]:
    """Matrix, points and triangles of each surface; parents come before their children."""
    place = {loaded["base_frame"]: np.eye(4)}
    for node in loaded["graph"]:
        place[node["frame_to"]] = place[node["frame_from"]] @ node["matrix"]
        surface = loaded["geometry"].get(node.get("geometry"), {})
        if "faces" in surface:  # else lines or points
            yield place[node["frame_to"]], surface["vertices"].astype(float), surface["faces"]


READERS = {".stl": read_stl, ".glb": read_gltf, ".gltf": read_gltf}
