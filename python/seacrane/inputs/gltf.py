"""Reader of glTF 2.0 models, binary (.glb) and text with its buffers inside: the triangles, for drawing.

The format's core is small, so the package reads it itself: numbers are found by offsets that are checked
before they are followed. Compressed meshes, sparse numbers and buffers in other files are refused.
"""

from __future__ import annotations

import base64
import binascii
import json
import struct
from collections.abc import Iterator
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.inputs.node import Node
from seacrane.inputs.stl import too_many
from seacrane.inputs.whole_file import read_whole

FloatArray = NDArray[np.float64]

MAGIC, JSON_CHUNK, BIN_CHUNK = b"glTF", b"JSON", b"BIN\0"
LARGEST_JSON = 8 * 2**20  # bytes; with buffers inside, LARGEST_TEXT
LARGEST_TEXT = 32 * 2**20
INDEX = {5121: "<u1", 5123: "<u2", 5125: "<u4"}
TRIANGLES, OTHER_SURFACES = 4, (5, 6)
DEEPEST, MOST_NODES = 64, 20_000
Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])  # of glTF's y up


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
        Missing, truncated, malformed, too large, or with parts that are not read; names the entry.
    """
    source = Path(path)
    try:
        content = read_whole(source, fix="decimate the mesh in the program that made it")
    except OSError as error:
        raise FileFormatError(f"{source}: cannot be read ({error}); give the path of a glTF model") from error
    root, binary = _binary(source, content) if content.startswith(MAGIC) else (_parsed(source, content), b"")
    try:
        return _Model(source, root, binary).triangles(most)
    except RecursionError as error:
        raise FileFormatError(f"{source}: nodes are nested too deeply; flatten them") from error


def _binary(source: Path, content: bytes) -> tuple[Any, bytes]:
    """The document and the numbers of a .glb file."""
    chunks: dict[bytes, bytes] = {}
    if len(content) < 20 or struct.unpack_from("<II", content, 4) != (2, len(content)):
        raise FileFormatError(
            f"{source}: is not a whole glTF 2.0 file of {len(content)} bytes; truncated or damaged"
        )
    at = 12
    while at + 8 <= len(content):
        size, kind = struct.unpack_from("<I4s", content, at)
        if size > len(content) - at - 8:
            raise FileFormatError(f"{source}: a chunk of {size} bytes leads beyond its end; it is damaged")
        chunks.setdefault(kind, content[at + 8 : at + 8 + size])
        at += 8 + size
    if JSON_CHUNK not in chunks:
        raise FileFormatError(f"{source}: holds no JSON chunk; export it again")
    if len(chunks[JSON_CHUNK]) > LARGEST_JSON:
        raise FileFormatError(f"{source}: its JSON has more than {LARGEST_JSON} bytes; export the mesh alone")
    return _parsed(source, chunks[JSON_CHUNK]), chunks.get(BIN_CHUNK, b"")


def _parsed(source: Path, text: bytes) -> Any:
    if len(text) > LARGEST_TEXT:
        raise FileFormatError(f"{source}: has more than {LARGEST_TEXT} bytes of text; export it as .glb")
    try:
        document = json.loads(text.decode("utf-8"))
    except (ValueError, RecursionError) as error:
        raise FileFormatError(
            f"{source}: is no glTF model: {str(error)[:200]}; give a .glb, or a .gltf with its buffers inside"
        ) from error
    version = document.get("asset") if isinstance(document, dict) else None
    told = version.get("version") if isinstance(version, dict) else None
    if not isinstance(told, str) or not told.startswith("2."):
        raise FileFormatError(f"{source}: is no glTF 2.0 model; export it as one")
    return document


class _Model:
    """A document and its numbers."""

    def __init__(self, source: Path, document: Any, binary: bytes) -> None:
        self.source, self.binary = source, binary
        self.root = Node(document, f"{source.name}: model")
        self.inside: dict[int, bytes] = {}
        self.visited = 0
        needed = document.get("extensionsRequired", [])
        if needed:
            names = ", ".join(str(name)[:40] for name in needed[:3]) if isinstance(needed, list) else "one"
            raise FileFormatError(f"{source}: needs the extension {names}; export it without compression")

    def triangles(self, most: int) -> FloatArray:
        """The triangles of all nodes of the scene, z up; of all meshes where there is no scene."""
        found: list[FloatArray] = []
        count = 0
        for mesh, turn in self._instances():
            for primitive in self._list(self._entry("meshes", mesh), "primitives"):
                indices = self._faces(primitive, most - count)
                if indices is None:
                    continue
                points, faces = indices
                count += len(faces)
                if not np.isfinite(points[np.unique(faces)]).all():
                    raise FileFormatError(f"{primitive.path}: has a coordinate that is not finite; repair it")
                found.append((points @ turn[:3, :3].T + turn[:3, 3])[faces] @ Z_UP.T)
        if not count:
            raise FileFormatError(f"{self.source}: holds no triangles; export the mesh again")
        triangles = np.concatenate(found)
        if not np.isfinite(triangles).all():
            raise FileFormatError(f"{self.source}: its nodes turn the mesh into no finite one; repair them")
        return triangles

    def _instances(self) -> Iterator[tuple[int, FloatArray]]:
        """Meshes with their matrices."""
        if "scenes" not in self.root.value:
            yield from ((i, np.eye(4)) for i, _ in enumerate(self._list(self.root, "meshes")))
            return
        scene = self._entry("scenes", self._whole(self.root, "scene", 0))
        for node in self._list(scene, "nodes"):
            yield from self._below(node.whole(), np.eye(4), DEEPEST)

    def _below(self, number: int, parent: FloatArray, deep: int) -> Iterator[tuple[int, FloatArray]]:
        self.visited += 1
        if deep == 0 or self.visited > MOST_NODES:
            raise FileFormatError(
                f"{self.source}: has more than {MOST_NODES} nodes, or nodes {DEEPEST} deep in each other; "
                "export the mesh alone"
            )
        node = self._entry("nodes", number)
        turn = parent @ self._matrix(node)
        if "mesh" in node.value:
            yield node.at("mesh").whole(), turn
        for child in self._list(node, "children"):
            yield from self._below(child.whole(), turn, deep - 1)

    def _matrix(self, node: Node) -> FloatArray:
        """The matrix of a node over its parent."""
        if "matrix" in node.value:
            return node.at("matrix").array((16,)).reshape(4, 4).T
        turn = np.eye(4)
        x, y, z, w = self._array(node, "rotation", (0.0, 0.0, 0.0, 1.0))
        turn[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        turn[:3, :3] *= self._array(node, "scale", (1.0, 1.0, 1.0))
        turn[:3, 3] = self._array(node, "translation", (0.0, 0.0, 0.0))
        return turn

    def _faces(self, primitive: Node, most: int) -> tuple[FloatArray, NDArray[np.int64]] | None:
        """Points and triangles of a primitive; None of lines and points."""
        mode = self._whole(primitive, "mode", TRIANGLES)
        if mode in OTHER_SURFACES:
            raise FileFormatError(f"{primitive.path}: is a strip or fan; export separate triangles")
        if mode != TRIANGLES:
            return None
        place = primitive.at("attributes").at("POSITION").whole()
        indexed = "indices" in primitive.value
        corners = self._entry("accessors", primitive.at("indices").whole() if indexed else place)
        count = corners.at("count").whole()
        if count // 3 > most:
            raise too_many(self.source, count // 3, most)
        points = self._numbers(place, {5126: "<f4"}, "VEC3").astype(float)
        if not indexed:
            faces = np.arange(len(points))
        else:
            faces = self._numbers(primitive.at("indices").whole(), INDEX, "SCALAR")[:, 0].astype(np.int64)
        if len(faces) % 3 or (len(faces) and int(faces.max()) >= len(points)):
            raise FileFormatError(
                f"{primitive.path}: its indices are no triangles of its vertices; repair it"
            )
        return points, faces.reshape(-1, 3)

    def _numbers(self, number: int, kinds: dict[int, str], type_: str) -> NDArray[Any]:
        """What an accessor points at, (count, 1 or 3)."""
        accessor = self._entry("accessors", number)
        component = accessor.at("componentType").whole()
        if component not in kinds or accessor.at("type").text() != type_ or "sparse" in accessor.value:
            accessor.fail(f"give plain {type_} numbers of the component types {', '.join(map(str, kinds))}")
        kind, width = np.dtype(kinds[component]), 3 if type_ == "VEC3" else 1
        view = self._entry("bufferViews", accessor.at("bufferView").whole())
        data = self._buffer(view.at("buffer").whole())
        count, stride = (
            accessor.at("count").whole(),
            self._whole(view, "byteStride", 0) or kind.itemsize * width,
        )
        begin, within = self._whole(view, "byteOffset", 0), self._whole(accessor, "byteOffset", 0)
        length = view.at("byteLength").whole()
        last = within + (count - 1) * stride + kind.itemsize * width
        if min(count, begin, within, length, stride - kind.itemsize * width) < 0 or (
            count and (last > length or begin + length > len(data))
        ):
            accessor.fail(f"it leads beyond the {len(data)} bytes of its buffer; truncated or damaged")
        return np.ndarray((count, width), kind, data, begin + within, (stride, kind.itemsize))

    def _buffer(self, number: int) -> bytes:
        """The bytes of a buffer: of the file, or of a text inside."""
        buffer = self._entry("buffers", number)
        if "uri" not in buffer.value:
            return self.binary if number == 0 else b""
        if number not in self.inside:
            kind, _, text = buffer.at("uri").text().partition(";base64,")
            if not kind.startswith("data:"):
                raise FileFormatError(f"{self.source}: has a buffer in another file; export it as .glb")
            try:
                self.inside[number] = base64.b64decode(text, validate=True)
            except (binascii.Error, ValueError) as error:
                raise FileFormatError(f"{buffer.path}.uri: {str(error)[:100]}; export it as .glb") from error
        return self.inside[number]

    def _entry(self, key: str, number: int) -> Node:
        """A member of a list of the document."""
        values = self.root.at(key).values()
        if not 0 <= number < len(values):
            raise FileFormatError(f"{self.source}: there is no {key}[{number}], of {len(values)}; repair it")
        node = Node(values[number], f"{self.source.name}: {key}[{number}]")
        if not isinstance(node.value, dict):
            node.fail("give an object")
        return node

    @staticmethod
    def _list(node: Node, key: str) -> Iterator[Node]:
        return node.at(key).items() if _holds(node, key) else iter(())

    @staticmethod
    def _whole(node: Node, key: str, usual: int) -> int:
        return node.at(key).whole() if _holds(node, key) else usual

    @staticmethod
    def _array(node: Node, key: str, usual: tuple[float, ...]) -> FloatArray:
        return node.at(key).array((len(usual),)) if _holds(node, key) else np.array(usual)


def _holds(node: Node, key: str) -> bool:
    """Whether an object has an entry."""
    if not isinstance(node.value, dict):
        node.fail("give an object")
    return key in node.value
