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

from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown
from seacrane.inputs.whole_file import read_whole

FloatArray = NDArray[np.float64]

STL_HEADER, STL_RECORD, MOST_SOLIDS = 84, 50, 1000  # bytes
MOST_TRIANGLES = 200_000  # of all meshes of a body together: pages stay a few MB
VERTEX = re.compile(rb"vertex(?:[ \t]+\S+){3}[ \t\r]*\n")
MAGIC, LARGEST_TEXT, MOST_NODES = b"glTF", 32 * 2**20, 20_000
TRIANGLES, OTHER_SURFACES = 4, (5, 6)
OF_A_NODE = ("mesh", "children", "matrix", "translation", "rotation", "scale")
SHARED = 16  # times its size that parts of a model may have together
OF_DATA = ("count", "byteOffset", "byteLength", "byteStride")
WIDTH = {5121: 1, 5123: 2, 5125: 4, 5126: 12}  # bytes of indices and of three coordinates
NOTHING = {"componentType": 5126, "type": "SCALAR", "count": 0}
Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # of glTF's y up


def read_stl(path: str | PathLike[str], *, most: int | None = None) -> FloatArray:
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


def read_gltf(path: str | PathLike[str], *, most: int) -> FloatArray:
    """Triangles of the scene of a glTF model, in m, turned from y up to z up: x stays, y becomes z.

    Parameters
    ----------
    path : path-like
        .glb, or .gltf with its buffers inside.
    most : Triangles that it may have.

    Raises
    ------
    FileFormatError
        Missing, truncated, malformed, too large, or with parts that are not read; or without trimesh.
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
        document = _needed(source, content[begin:end], most)
        if sum(one["byteLength"] for one in document["bufferViews"]) > SHARED * len(content):
            raise ValueError("too many parts share a buffer")
        text = json.dumps(document).encode()
        if begin:
            size = begin + len(text) + len(content) - end
            text = struct.pack("<4sIII4s", MAGIC, 2, size, len(text), b"JSON") + text + content[end:]
        load = gltf.load_glb if begin else gltf.load_gltf
        loaded = load(BytesIO(text), skip_materials=True)
        parts = list(_placed(loaded))
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


def _checked(source: Path, soup: list[FloatArray]) -> FloatArray:
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


def _needed(source: Path, text: bytes, most: int) -> dict[str, Any]:
    """What triangles need of a glTF document: numbers that are no more than they can be, nodes as a tree."""
    if len(text) > LARGEST_TEXT:
        raise FileFormatError(f"{source}: has more than {LARGEST_TEXT} bytes of text; export the mesh alone")
    document = json.loads(text)
    if not document["asset"]["version"].startswith("2."):
        raise FileFormatError(f"{source}: is no glTF 2.0 model; export it as one")
    if document.get("extensionsRequired"):
        needed = shown(document["extensionsRequired"])
        raise FileFormatError(f"{source}: needs the extensions {needed}; export it without compression")
    buffers, views = document["buffers"], document["bufferViews"]
    if not all(one.get("uri", "data:").startswith("data:") for one in buffers):
        raise FileFormatError(f"{source}: has a buffer in another file; export it as .glb")
    meshes = [{"primitives": list(_surfaces(source, one["primitives"]))} for one in document["meshes"]]
    surfaces = [one for mesh in meshes for one in mesh["primitives"]]
    places = [one["attributes"]["POSITION"] for one in surfaces]
    corners = [one.get("indices", place) for one, place in zip(surfaces, places, strict=True)]
    accessors, used = document["accessors"], {*places, *corners}
    for one in (*views, *(accessors[i] for i in used)):
        if min(one.get(key, 0) for key in OF_DATA) < 0 or "sparse" in one:
            raise ValueError("a number is below zero, or numbers are sparse")
    for one in (accessors[i] for i in used):
        width = WIDTH[one["componentType"]]
        if views[one["bufferView"]].get("byteStride", width) < width:
            raise ValueError("numbers overlap")
    points = sum(accessors[i]["count"] for i in used)
    _require_few(source, max(sum(accessors[i]["count"] for i in corners), points // 2) // 3, most)
    return {
        "buffers": buffers,
        "bufferViews": views,
        "accessors": [one if i in used else NOTHING for i, one in enumerate(accessors)],
        "meshes": meshes,
        **_tree(source, document, meshes),
    }


def _surfaces(source: Path, primitives: Any) -> Iterator[dict[str, Any]]:
    """Triangles without what they are painted with; lines and points are left out."""
    for one in primitives:
        mode = one.get("mode", TRIANGLES)
        if mode in OTHER_SURFACES:
            raise FileFormatError(f"{source}: has a strip or fan; export separate triangles")
        if mode == TRIANGLES:
            indices = {"indices": one["indices"]} if "indices" in one else {}
            yield {"attributes": {"POSITION": one["attributes"]["POSITION"]}, **indices}


def _tree(source: Path, document: Any, meshes: list[Any]) -> dict[str, Any]:
    """The nodes of the scene; one for each mesh where there is no scene."""
    if "scenes" not in document:
        nodes: list[Any] = [{"mesh": i} for i, _ in enumerate(meshes)]
        scene: Any = {"nodes": list(range(len(nodes)))}
    else:
        nodes = [{key: one[key] for key in OF_A_NODE if key in one} for one in document["nodes"]]
        scene = document["scenes"][document.get("scene", 0)]
    below = [*scene["nodes"], *(child for one in nodes for child in one.get("children", ()))]
    if len(nodes) > MOST_NODES or len(set(below)) < len(below):
        raise FileFormatError(
            f"{source}: has more than {MOST_NODES} nodes, or one below two others; export the mesh alone"
        )
    nodes = [
        {key: value for key, value in one.items() if key != "mesh" or meshes[value]["primitives"]}
        for one in nodes
    ]
    return {"nodes": nodes, "scenes": [{"nodes": scene["nodes"]}]}


def _placed(loaded: dict[str, Any]) -> Iterator[tuple[FloatArray, FloatArray, NDArray[np.intp]]]:
    """Matrix, points and triangles of each surface; parents come before their children."""
    place = {loaded["base_frame"]: np.eye(4)}
    for node in loaded["graph"]:
        place[node["frame_to"]] = place[node["frame_from"]] @ node["matrix"]
        if "geometry" in node:
            surface = loaded["geometry"][node["geometry"]]
            points, faces = surface["vertices"], surface["faces"]
            if points.dtype != np.float32 or points.shape[1:] != (3,) or faces.dtype.kind not in "ui":
                raise ValueError("vertices or indices have another type than glTF's")
            if len(faces) and not 0 <= faces.min() <= faces.max() < len(points):
                raise ValueError("indices are none of its vertices")
            yield place[node["frame_to"]], points.astype(float), faces


READERS = {".stl": read_stl, ".glb": read_gltf, ".gltf": read_gltf}
