"""Reader of STL files, ASCII and binary: the triangles of a surface.

The format is two pages long, so the package reads it itself: a mesh library would be one
dependency more at run time.
"""

from __future__ import annotations

from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import FileFormatError
from seacrane.inputs.whole_file import read_whole

FloatArray = NDArray[np.float64]

HEADER, RECORD = 84, 50  # bytes
FACET = np.dtype([("normal", "<f4", 3), ("vertices", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(path: str | PathLike[str], *, most: int | None = None) -> FloatArray:
    """Triangles of an STL file, in the file's own unit and axes.

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
    seacrane.errors.FileFormatError : missing, empty, truncated or malformed; names the line of an ASCII file.
    """
    source = Path(path)
    try:
        announced = _announced(source)
        if most is not None and announced > most:
            raise too_many(source, announced, most)
        content = read_whole(source, fix="export a coarser surface")
    except OSError as error:
        raise FileFormatError(f"{source}: cannot be read ({error}); give the path of an STL file") from error
    if not _is_binary(content):
        facets = content.lower().count(b"endfacet")
        if most is not None and facets > most:
            raise too_many(source, facets, most)
    triangles = _binary(content) if _is_binary(content) else _ascii(source, content)
    if len(triangles) == 0:
        raise FileFormatError(f"{source}: holds no triangles; export the surface again")
    if not np.all(np.isfinite(triangles)):
        bad = int(np.flatnonzero(~np.isfinite(triangles).all(axis=(1, 2)))[0])
        raise FileFormatError(f"{source}: triangle {bad + 1} has a coordinate that is not finite; repair it")
    return triangles


def too_many(source: Path, count: int, most: int) -> FileFormatError:
    """What is said of a file of more triangles than are drawn."""
    return FileFormatError(
        f"{source}: has {count} triangles, above {most}; decimate the mesh in the program that made it"
    )


def _announced(source: Path) -> int:
    """Triangles of a binary file by its size and its header, before it is read; 0 of other files."""
    size = source.stat().st_size
    if not source.is_file() or size < HEADER:
        return 0
    with source.open("rb") as file:
        count = int.from_bytes(file.read(HEADER)[80:84], "little")
    return count if size == HEADER + RECORD * count else 0


def _is_binary(content: bytes) -> bool:
    """Whether the size is the one that the count announces; some binary headers begin with "solid" too."""
    if len(content) < HEADER:
        return False
    count = int.from_bytes(content[80:84], "little")
    return len(content) == HEADER + RECORD * count


def _binary(content: bytes) -> FloatArray:
    return np.frombuffer(content, dtype=FACET, offset=HEADER)["vertices"].astype(float)


def _ascii(source: Path, content: bytes) -> FloatArray:
    if content.lstrip()[:5].lower() != b"solid":
        announced = int.from_bytes(content[80:84], "little") if len(content) >= HEADER else 0
        raise FileFormatError(
            f"{source}: {len(content)} bytes are neither ASCII STL (which begins with 'solid') nor binary "
            f"STL (whose header announces {announced} triangles, {HEADER + RECORD * announced} bytes); the "
            "file is truncated or of another kind"
        )
    vertices: list[list[float]] = []
    in_loop, ended = 0, False
    for number, line in enumerate(content.decode("latin-1").splitlines(), start=1):
        words = line.split()
        keyword = words[0].lower() if words else ""
        if keyword == "vertex":
            vertices.append(_vertex(source, number, words))
            in_loop += 1
        elif keyword == "endfacet":
            if in_loop != 3:
                raise FileFormatError(f"{source}: line {number}: a facet of {in_loop} vertices; it needs 3")
            in_loop = 0
        ended = ended or keyword == "endsolid"
    if in_loop or not ended:
        raise FileFormatError(f"{source}: ends before 'endsolid'; the file is truncated")
    return np.array(vertices, dtype=float).reshape(-1, 3, 3)


def _vertex(source: Path, number: int, words: list[str]) -> list[float]:
    try:
        if len(words) != 4:
            raise ValueError
        return [float(word) for word in words[1:]]
    except ValueError:
        raise FileFormatError(
            f"{source}: line {number}: {' '.join(words)[:80]!r} is not 'vertex x y z' with three numbers"
        ) from None
