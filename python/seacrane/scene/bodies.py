"""Bodies of a scene, and meshes that they are drawn by: looks alone, nothing that moves reads them."""

from __future__ import annotations

import base64
import binascii
import os
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description, insert, require
from seacrane.description.places import on_body, placed
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import name_of, number_of, numbers_of, shaped_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.mesh_files import MOST_TRIANGLES, READERS
from seacrane.inputs.node import Node
from seacrane.inputs.plausible import warn_of_density
from seacrane.inputs.shown import shown
from seacrane.inputs.values import told_by

Faces = NDArray[np.int64]
LARGEST, FARTHEST = 1000.0, 1e5  # m: of a mesh, and from the body's origin


@told_by(_core.Body)
def add_body(
    scene: Description, name: str, *, mass: float, inertia: Any = None,
    center_of_mass: Any = (0.0, 0.0, 0.0), position: Any = (0.0, 0.0, 0.0),
    quaternion: Any = (1.0, 0.0, 0.0, 0.0), velocity: Any = (0.0, 0.0, 0.0),
    angular_velocity: Any = (0.0, 0.0, 0.0), gravity: bool = True, size: Any = None,
    below: str | None = None, drop: float = 0.0,
) -> _core.Body:  # fmt: skip
    """Add a rigid body.

    Parameters
    ----------
    inertia : array_like, shape (3,) or (3, 3), optional
        About the centre of mass in body axes, kg m2; three values are the diagonal. Default: that of a solid
        box of `size`, ``mass / 12 * (y**2 + z**2, z**2 + x**2, x**2 + y**2)``.
    gravity : bool
        Whether weight acts on it. The body of a vessel never gets weight: its restoring carries it.
    below : str, optional
        In place of a position, a point such as "tip", as `place_of` takes it: the top of the box, or the
        origin of a body without a size, is straight below it.
    drop : float
        From there down, m.

    Raises
    ------
    SceneError
        For a duplicate name, a value that is not of that shape, neither inertia nor size, or a place given
        twice; other values are checked at compile().

    Warns
    -----
    MassUnitWarning
        A box lighter than foam, or heavier than any metal.
    """
    given = {key: one for key, one in locals().items() if key not in ("scene", "below", "drop")}
    what = f"body {name_of('body', name)!r}"
    edges = np.zeros(3) if size is None else shaped_of(f"{what}: size", size, (3,))
    if below is not None:
        middle = shaped_of(f"{what}: center_of_mass", center_of_mass, (3,))
        top = np.add(middle, (0.0, 0.0, 0.5 * edges[2])) if edges.any() else edges
        if np.any(np.asarray(position)):
            raise SceneError(f"{what}: has a position and below; give one of them")
        turned = rotation_matrix(shaped_of(f"{what}: quaternion", quaternion, (4,)))
        under = placed(scene, *on_body(scene, f"{what}: below", below, (0.0, 0.0, 0.0)))
        given["position"] = under - (0.0, 0.0, number_of(f"{what}: drop", drop)) - turned @ top
    elif drop:
        raise SceneError.of(f"{what}: drop", f"is {drop:g} m, below nothing; give below=, or leave drop out")
    given |= {
        "size": edges,
        "inertia": _box(what, mass, edges) if inertia is None else _tensor(what, inertia),
    }
    body = insert("body", scene.bodies, _core.Body(**given))
    if edges.any():
        warn_of_density(what, body.mass, float(np.prod(edges)))
    return body


def _tensor(what: str, inertia: Any) -> Array:
    """Shape (3, 3), of a tensor or of its diagonal."""
    tensor = numbers_of(f"{what}: inertia", inertia)
    if tensor.shape not in ((3,), (3, 3)):
        raise SceneError.of(
            f"{what}: inertia",
            f"has shape {tensor.shape}; give its diagonal, shape (3,), or all of it, (3, 3)",
        )
    return np.diag(tensor) if tensor.shape == (3,) else tensor


def _box(what: str, mass: Any, edges: Array) -> Array:
    """The inertia of a solid box, about its centre."""
    if not edges.any():
        raise SceneError(
            f"{what}: has neither inertia nor size; give size=(x, y, z), m, of the solid box that it is, or "
            "inertia=(Ixx, Iyy, Izz), kg m2, about its centre of mass"
        )
    x, y, z = edges**2
    return np.diag([y + z, z + x, x + y]) * (number_of(f"{what}: mass", mass) / 12.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Mesh:
    """Triangles that a body is drawn by; made by `Scene.add_mesh`, immutable.

    Attributes
    ----------
    vertices : (n, 3) From the body's origin, body axes, m; read-only, in single precision.
    faces : (m, 3) Vertices of each triangle, anticlockwise from outside; read-only.
    """

    name: str
    body: str
    vertices: Array
    faces: Faces

    def __post_init__(self) -> None:
        for array in (self.vertices, self.faces):
            array.setflags(write=False)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Mesh) and self._content() == other._content()

    def __hash__(self) -> int:
        return hash(self._content())

    def _content(self) -> tuple[str, str, bytes, bytes]:
        return self.name, self.body, self.vertices.tobytes(), self.faces.tobytes()

    def __reduce__(self) -> tuple[Any, ...]:  # arrays come back from a pickle writeable
        return partial(Mesh, name=self.name, body=self.body, vertices=self.vertices, faces=self.faces), ()


def add_mesh(
    scene: Description, body: str, *, file: str | os.PathLike[str] | None = None, vertices: Any = None,
    faces: Any = None, scale: float = 1.0, frame: _core.Frame | None = None, name: str | None = None,
) -> Mesh:  # fmt: skip
    """Draw a body by a mesh, in place of what is drawn otherwise; its motion does not change.

    The scene holds the triangles themselves: files of scenes and results need the mesh's file no more. A mesh
    need not be closed: nothing is computed from it. A hull whose hydrostatics count comes from
    `hydro.Hull.from_stl`, which has to be closed.

    Parameters
    ----------
    body : str
        That it is fixed to; several meshes of a body are drawn together.
    file : path-like, optional
        STL (binary or ASCII), or glTF (.glb, or .gltf with its buffers inside). glTF's y up becomes z up.
    vertices : array_like, shape (n, 3)
        In place of a file.
    faces : array_like of int, shape (m, 3)
        Vertices of each triangle, from 0; with `vertices`.
    scale : float
        By which coordinates are multiplied to be m, such as 1e-3 for a file in mm.
    frame : Frame, optional
        Where the mesh's origin and axes are in body coordinates; default: the body's own.
    name : str, optional
        Default: the body's.

    Raises
    ------
    SceneError
        For an unknown body, a name used twice, more than 200,000 triangles for a body, a mesh without extent,
        or one of more than 1 km, which most likely is in mm.
    FileFormatError
        For a file that is damaged, too large, or of another kind; without trimesh (`seacrane[mesh]`).
    """
    require(scene, "mesh", "body", body)
    what = f"mesh {name_of('mesh', name, body)!r}"
    points, triangles = _given(what, file, vertices, faces)
    factor = number_of(f"{what}: scale", scale)
    if not (np.isfinite(factor) and factor > 0.0):
        raise SceneError.of(f"{what}: scale", f"is {factor:g}; give a positive number, such as 1e-3 for mm")
    if frame is not None and not isinstance(frame, _core.Frame):
        raise SceneError.of(f"{what}: frame", f"is {shown(frame)}; give a seacrane.Frame")
    frame = _core.Frame() if frame is None else frame
    mesh = _mesh(scene, name or body, body, points, triangles, factor, frame)
    return insert("mesh", scene.meshes, mesh)


def _given(what: str, file: Any, vertices: Any, faces: Any) -> tuple[Array, Faces]:
    """Vertices and triangles, from a file or from arrays."""
    if (file is None) == (vertices is None) or (vertices is None) != (faces is None):
        raise SceneError(f"{what}: give file, or vertices and faces")
    if file is None:
        points, corners = numbers_of(f"{what}: vertices", vertices), np.asarray(faces)
        if points.ndim != 2 or points.shape[1] != 3 or not len(points):
            raise SceneError.of(f"{what}: vertices", f"has shape {points.shape}; give (n, 3), m")
        if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
            raise SceneError.of(
                f"{what}: faces", f"has shape {corners.shape} of {corners.dtype}; give (m, 3) whole numbers"
            )
        return points, corners
    try:
        path = Path(file)
    except TypeError as error:
        raise SceneError.of(f"{what}: file", f"is {shown(file)}; give a path") from error
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise SceneError.of(f"{what}: file", f"is {shown(path.name)}; give {', '.join(READERS)}")
    soup = np.float32(reader(path, most=MOST_TRIANGLES).reshape(-1, 3))
    points, corners = np.unique(soup, axis=0, return_inverse=True)
    return points.astype(float), corners.reshape(-1, 3)


def _mesh(
    scene: Description, name: str, body: str, points: Array, faces: Any, factor: float, frame: _core.Frame
) -> Mesh:
    """The mesh in body coordinates, m, once it is one that can be drawn."""
    what = f"mesh {name!r}"
    if not np.isfinite(points).all():
        raise SceneError(f"{what}: vertices hold a coordinate that is not finite; repair it")
    with np.errstate(over="ignore"):
        size = float(factor * np.ptp(points, axis=0).max())
        points = np.asarray((factor * points) @ np.asarray(frame.axes).T + np.asarray(frame.point))
    if size > LARGEST:
        raise SceneError(
            f"{what}: is {size:.4g} m large, above {LARGEST:g} m; if it is in mm give scale="
            f"{1e-3 * factor:g}, else draw a part of it"
        )
    if np.abs(points).max() > FARTHEST:
        raise SceneError(
            f"{what}: has a vertex more than {FARTHEST:g} m from its body; check scale and frame"
        )
    faces = np.asarray(faces, dtype=np.int64)
    if not len(faces) or faces.min() < 0 or faces.max() >= len(points):
        raise SceneError(f"{what}: faces name vertices that are none of its {len(points)}; count from 0")
    there = sum(len(mesh.faces) for mesh in scene.meshes.values() if mesh.body == body)
    if there + len(faces) > MOST_TRIANGLES:
        raise SceneError(
            f"{what}: brings body {body!r} to {there + len(faces)} triangles, above {MOST_TRIANGLES}; "
            "decimate it in the program that made it"
        )
    points = np.float32(points).astype(float)
    if not np.ptp(points[np.unique(faces)], axis=0).max() > 0.0:
        raise SceneError(f"{what}: all its vertices are one point; export it again, or check scale")
    return Mesh(name=name, body=body, vertices=points, faces=faces)


def mesh_to_data(mesh: Mesh) -> dict[str, Any]:
    """As plain data: single precision and indices of 32 bits, little-endian, in base64."""
    arrays = {"vertices": mesh.vertices.astype("<f4"), "faces": mesh.faces.astype("<u4")}
    texts = {key: base64.b64encode(array.tobytes()).decode("ascii") for key, array in arrays.items()}
    return {"name": mesh.name, "body": mesh.body, **texts}


def mesh_from_node(node: Node, scene: Description) -> None:
    """Give a scene the mesh that `mesh_to_data` wrote; raises FileFormatError."""
    node.expect(("name", "body", "vertices", "faces"))
    points = np.frombuffer(_bytes(node.at("vertices")), "<f4").reshape(-1, 3).astype(float)
    faces = np.frombuffer(_bytes(node.at("faces")), "<u4").reshape(-1, 3).astype(np.int64)
    body = node.at("body").text()
    if body not in scene.bodies:
        node.at("body").fail("give a body of the scene")
    with node.scene_errors():
        name = name_of("mesh", node.at("name").text())
        insert("mesh", scene.meshes, _mesh(scene, name, body, points, faces, 1.0, _core.Frame()))


def _bytes(node: Node) -> bytes:
    """Rows of three numbers of 4 bytes."""
    try:
        data = base64.b64decode(node.text(), validate=True)
    except (binascii.Error, ValueError) as error:
        raise FileFormatError(f"{node.path}: {str(error)[:100]}; give base64") from error
    if not data or len(data) % 12:
        raise FileFormatError(f"{node.path}: has {len(data)} bytes; give rows of 12")
    return data
