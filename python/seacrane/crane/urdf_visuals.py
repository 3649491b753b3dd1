"""What the links of a URDF file are drawn by: meshes, boxes, cylinders and spheres."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.data import MeshData, Placed
from seacrane.crane.urdf_values import name_of, origin_of, row_of, value_of
from seacrane.description.revolved import revolved
from seacrane.errors import FileFormatError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import shown
from seacrane.warnings import UrdfWarning

Array = NDArray[np.float64]
Faces = NDArray[np.int64]
AROUND = 24  # corners of a circle
READABLE = (".stl", ".glb", ".gltf")


def meshes_of(source: str, folder: Path, link: Element, frame: Placed) -> Iterator[MeshData]:
    """The meshes of a link, placed in the crane-foot frame at home."""
    name = name_of(source, link)
    for i, visual in enumerate(link.findall("visual")):
        geometry = visual.find("geometry")
        shape = None if geometry is None else next(iter(geometry), None)
        if shape is None:
            continue
        place = frame.inner(origin_of(source, visual))
        label = name if i == 0 else f"{name} {i + 1}"
        mesh = _mesh(source, folder, label, shape, place)
        if mesh is not None:
            yield mesh


def _mesh(source: str, folder: Path, name: str, shape: Element, place: Placed) -> MeshData | None:
    what = f"visual {name!r}"
    where: dict[str, Any] = {"name": name, "frame": place}
    match shape.tag:
        case "mesh":
            return _file(source, folder, what, shape, where)
        case "box":
            vertices, faces = _box(row_of(source, what, shape, "size"))
        case "cylinder":
            radius, length = (value_of(source, what, shape, key) for key in ("radius", "length"))
            profile = np.array([[0.0, -0.5], [1.0, -0.5], [1.0, 0.5], [0.0, 0.5]]) * [radius, length]
            vertices, faces = revolved(profile, AROUND)
        case "sphere":
            angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, AROUND // 2 + 1)
            radius = value_of(source, what, shape, "radius")
            vertices, faces = revolved(radius * np.column_stack([np.cos(angle), np.sin(angle)]), AROUND)
        case _:
            raise FileFormatError(
                f"{source}: {what} is a <{shape.tag[:40]}>; write mesh, box, cylinder or sphere."
            )
    if not np.all(np.ptp(vertices, axis=0) > 0.0):
        raise FileFormatError(f"{source}: {what} has no extent; give sizes above zero.")
    return MeshData(vertices=vertices, faces=faces, **where)


def _file(source: str, folder: Path, what: str, shape: Element, where: dict[str, Any]) -> MeshData | None:
    given = shape.get("filename", "")
    path = folder / given.removeprefix("file://").removeprefix("package://")
    scale = row_of(source, what, shape, "scale") if shape.get("scale") else np.ones(3)
    if not (scale[0] == scale[1] == scale[2] and scale[0] > 0.0):
        raise FileFormatError(f"{source}: {what} has scale {scale.tolist()}; give three equal numbers.")
    if path.suffix.lower() not in READABLE:
        warn_caller(
            f"{source}: {what} is {shown(given)}, which is not drawn; convert it to {', '.join(READABLE)}",
            UrdfWarning,
        )
        return None
    return MeshData(file=path, scale=float(scale[0]), **where)


def _box(size: Array) -> tuple[Array, Faces]:
    corners = 0.5 * size * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])
