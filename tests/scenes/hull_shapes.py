"""Surfaces with closed-form hydrostatics, as meshes and as offset tables."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.hydro import OffsetTable

Mesh = tuple[Array, NDArray[np.int64]]


def box(*, length: float, breadth: float, bottom: float, top: float) -> Mesh:
    """Closed box with quadrilateral faces, outward."""
    x, y = 0.5 * length, 0.5 * breadth
    ring = [(-x, -y), (x, -y), (x, y), (-x, y)]
    vertices = np.array([(*p, bottom) for p in ring] + [(*p, top) for p in ring])
    sides = [(i, (i + 1) % 4, 4 + (i + 1) % 4, 4 + i) for i in range(4)]
    return vertices, np.array([*sides, (3, 2, 1, 0), (4, 5, 6, 7)])


def joined(*meshes: Mesh) -> Mesh:
    """Several meshes as one."""
    start = np.cumsum([0, *[len(vertices) for vertices, _ in meshes[:-1]]])
    vertices = np.concatenate([mesh[0] for mesh in meshes])
    return vertices, np.concatenate([mesh[1] + s for mesh, s in zip(meshes, start, strict=True)])


def moved(mesh: Mesh, *by: float) -> Mesh:
    return mesh[0] + np.array(by), mesh[1]


def revolved(radius: Array, height: Array, count: int) -> Mesh:
    """Body of revolution about the z axis from its meridian, bottom to top, in quadrilaterals."""
    angle = np.arange(count) * 2.0 * np.pi / count
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    vertices = np.concatenate([np.column_stack([r * ring, np.full(count, h)]) for r,
                               h in zip(radius, height, strict=True)])  # fmt: skip
    faces = []
    for i in range(len(radius) - 1):
        for j in range(count):
            k = (j + 1) % count
            faces.append((i * count + j, i * count + k, (i + 1) * count + k, (i + 1) * count + j))
    return vertices, np.array(faces)


def sphere(radius: float, count: int) -> Mesh:
    """Sphere about the origin, ``count`` panels around and half as many from pole to pole."""
    angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, count // 2 + 1)
    return revolved(radius * np.cos(angle), radius * np.sin(angle), count)


def wigley(length: float, breadth: float, draught: float) -> Callable[[Array, Array], Array]:
    """Half breadth of Wigley's parabolic hull, y = B/2 (1 - (2x/L)^2) (1 - (z/T)^2)."""

    def half_breadth(x: Array, z: Array) -> Array:
        return 0.5 * breadth * (1.0 - (2.0 * x / length) ** 2) * (1.0 - (z / draught) ** 2)

    return half_breadth


def wigley_offsets(length: float, breadth: float, draught: float, count: int) -> OffsetTable:
    """Its table, ``2 count`` stations and ``count`` waterlines below the still one."""
    shape = wigley(length, breadth, draught)
    x = np.linspace(-0.5 * length, 0.5 * length, 2 * count + 1)
    z = np.linspace(0.0, -draught, count + 1)
    sections = tuple(np.column_stack([shape(np.full_like(z, v), z), z]) for v in x)
    return OffsetTable(x=x, sections=sections, name="wigley")


def wigley_mesh(length: float, breadth: float, draught: float, count: int) -> Mesh:
    """Triangles of both sides in another pattern than the table's, wall-sided above the waterline."""
    shape = wigley(length, breadth, draught)
    x = -0.5 * length * np.cos(np.linspace(0.0, np.pi, 2 * count + 1))
    z = np.append(-draught * np.cos(np.linspace(0.0, 0.5 * np.pi, count + 1)), 0.2 * draught)
    side = []
    for sign in (1.0, -1.0):
        grid = np.stack([np.broadcast_to(v, (len(x), len(z))) for v in (x[:, None], 0.0, z)], axis=-1).copy()
        grid[..., 1] = sign * shape(x[:, None], np.minimum(z, 0.0)[None, :])
        side.append(grid.reshape(-1, 3))
    i, j = np.meshgrid(np.arange(len(x) - 1), np.arange(len(z) - 1), indexing="ij")
    a = (i * len(z) + j).ravel()
    b, c, d = a + len(z), a + len(z) + 1, a + 1
    port = np.concatenate([np.column_stack([a, d, c]), np.column_stack([a, c, b])])
    starboard = port[:, ::-1] + len(x) * len(z)
    return np.concatenate(side), np.concatenate([port, starboard])


def stl(path: Path, triangles: Array, header: bytes = b"binary") -> Path:
    """A binary STL file of triangles (n, 3, 3)."""
    record = np.zeros(len(triangles), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
    record["v"] = triangles
    path.write_bytes(header.ljust(80, b" ") + np.uint32(len(triangles)).tobytes() + record.tobytes())
    return path


def ascii_stl(triangles: Array) -> str:
    """The text of an ASCII STL file."""
    lines = ["solid hull"]
    for triangle in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(f"{v:.9e}" for v in vertex) for vertex in triangle]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid hull", ""])
