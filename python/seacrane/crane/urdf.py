"""Reads the bodies and joints of a URDF file.

Source: the specification of the Unified Robot Description Format, wiki.ros.org/urdf/XML (link, joint).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import Element, ParseError, fromstring

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.data import HOME, BodyData, JointData, MeshData, Placed
from seacrane.crane.mass_properties import MassProperties
from seacrane.description.revolved import revolved
from seacrane.errors import FileFormatError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import listed, shown
from seacrane.inputs.whole_file import read_whole
from seacrane.warnings import UrdfWarning

Array = NDArray[np.float64]
LARGEST_FILE = 2**24  # bytes
KINDS = {"revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic", "fixed": "weld"}
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
LARGEST = 1e12
Faces = NDArray[np.int64]
AROUND = 24  # corners of a circle
READABLE = (".stl", ".glb", ".gltf")


def name_of(source: str, element: Element) -> str:
    """The name of a link or a joint; FileFormatError for none."""
    name = element.get("name", "")
    if not name:
        raise FileFormatError(f"{source}: a <{element.tag}> has no name; give each one its own.")
    return name


def number_in(source: str, what: str, text: str) -> float:
    """A finite number of a text."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not abs(value) <= LARGEST:
        raise FileFormatError(f"{source}: {what} is {shown(text)}; write a finite number.")
    return value


def value_of(
    source: str, what: str, element: Element | None, key: str, default: float | None = None
) -> float:
    """An attribute that is a number."""
    text = None if element is None else element.get(key)
    if text is None:
        if default is None:
            raise FileFormatError(f"{source}: {what} has no {key}; give it.")
        return default
    return number_in(source, f"{what}: {key}", text)


def row_of(source: str, what: str, element: Element, key: str) -> Array:
    """An attribute of three numbers; zeros where there is none."""
    text = element.get(key, "0 0 0")
    row = [number_in(source, f"{what}: {key}", part) for part in text.split()]
    if len(row) != 3:
        raise FileFormatError(f"{source}: {what}: {key} is {shown(text)}; write three numbers.")
    return np.array(row)


def origin_of(source: str, element: Element) -> Placed:
    """The frame of an <origin>, m: rotations about the fixed axes x, y, z."""
    origin = element.find("origin")
    if origin is None:
        return HOME
    what = f"<origin> of {element.get('name') or '<' + element.tag + '>'}"
    roll, pitch, yaw = row_of(source, what, origin, "rpy")
    return Placed(fixed_axes(roll, pitch, yaw), row_of(source, what, origin, "xyz"))


def fixed_axes(roll: float, pitch: float, yaw: float) -> Array:
    """Rz(yaw) Ry(pitch) Rx(roll), (3, 3)."""
    (cr, sr), (cp, sp), (cy, sy) = ((math.cos(a), math.sin(a)) for a in (roll, pitch, yaw))
    about_x = np.array([[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]])
    about_y = np.array([[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]])
    about_z = np.array([[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]])
    return np.asarray(about_z @ about_y @ about_x)


@dataclass(frozen=True, kw_only=True, eq=False)
class UrdfTree:
    """What a URDF file describes.

    Attributes
    ----------
    root : The link that no joint carries.
    bodies : Links with mass.
    joints : From the root outwards.
    placed : Frames of all links, at zero of all joints; the root's is that of the crane foot.
    owner : Body whose part each link is.
    """

    root: str
    bodies: tuple[BodyData, ...]
    joints: tuple[JointData, ...]
    placed: Mapping[str, Placed]
    owner: Mapping[str, str]


def read_urdf(path: Path) -> UrdfTree:
    """Read links and joints; the frame of the root link is that of the crane foot.

    Links without mass on fixed joints are frames of what they are fixed to. Collision shapes, materials,
    transmissions and extensions are not read.

    Raises
    ------
    FileFormatError
        The file cannot be read, is no URDF, or says something of a link or a joint that cannot be.

    Warns
    -----
    UrdfWarning
        For what is left out of it and would matter.
    """
    source = path.name
    robot = _robot(path)
    links = {name_of(source, link): link for link in robot.findall("link")}
    if not links:
        raise FileFormatError(f"{source}: has no links; give a URDF of a crane.")
    joints = robot.findall("joint")
    carried = _carried(source, joints, links)
    root = _root(source, links, carried)
    ordered = _outwards(source, root, joints)
    placed: dict[str, Placed] = {root: HOME}
    for joint in ordered:
        parent, child = _ends(joint)
        placed[child] = placed[parent].inner(origin_of(source, joint))
    owner = _owners(source, root, ordered, links)
    parts: dict[str, list[str]] = {}
    for name, holder in owner.items():
        parts.setdefault(holder, []).append(name)
    bodies = tuple(
        BodyData(
            name=name,
            properties=_properties(source, link, placed[name]),
            meshes=tuple(
                mesh
                for other in parts[name]
                for mesh in meshes_of(source, path.parent, links[other], placed[other])
            ),
        )
        for name, link in links.items()
        if _massive(link)
    )
    found = tuple(
        _joint(source, joint, placed, owner) for joint in ordered if owner[_ends(joint)[1]] == _ends(joint)[1]
    )
    return UrdfTree(root=root, bodies=bodies, joints=found, placed=placed, owner=owner)


def _robot(path: Path) -> Element:
    try:
        text = read_whole(path, LARGEST_FILE, "no URDF file is").decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise FileFormatError(f"URDF file {path} cannot be read ({error}); check the path.") from error
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise FileFormatError(f"{path.name}: has a document type of its own; take <!DOCTYPE ...> out.")
    try:
        robot = fromstring(text)
    except (ParseError, RecursionError, ValueError) as error:
        raise FileFormatError(
            f"{path.name}: not valid XML: {str(error)[:200]}; correct that line."
        ) from error
    if robot.tag != "robot":
        raise FileFormatError(
            f"{path.name}: begins with <{robot.tag[:40]}>; a URDF begins with <robot> (run xacro first)."
        )
    return robot


def _ends(joint: Element) -> tuple[str, str]:
    """Names of its parent link and its child link."""
    parent, child = (joint.find(tag) for tag in ("parent", "child"))
    return (
        "" if parent is None else parent.get("link", ""),
        "" if child is None else child.get("link", ""),
    )


def _carried(source: str, joints: list[Element], links: Mapping[str, Element]) -> dict[str, str]:
    """Joint that carries each link; FileFormatError for a loop."""
    found: dict[str, str] = {}
    for joint in joints:
        name = name_of(source, joint)
        for link in _ends(joint):
            if link not in links:
                raise FileFormatError(
                    f"{source}: joint {name!r} names link {shown(link)}; there are {listed([*links])}."
                )
        child = _ends(joint)[1]
        if child in found:
            raise FileFormatError(
                f"{source}: link {child!r} is carried by joints {found[child]!r} and {name!r}: a loop. Take "
                f"joint {name!r} out, and write it as one of [[closing_joints]] in the table beside the URDF."
            )
        found[child] = name
    return found


def _root(source: str, links: Mapping[str, Element], carried: Mapping[str, str]) -> str:
    roots = [name for name in links if name not in carried]
    if len(roots) != 1:
        which = f"links {listed(roots)} have no parent" if roots else "every link has a parent: a loop"
        raise FileFormatError(f"{source}: {which}; one link must stand on the base, and no other.")
    return roots[0]


def _outwards(source: str, root: str, joints: list[Element]) -> list[Element]:
    """As far from the root one after another; those as far as each other as the file has them."""
    carries: dict[str, list[int]] = {}
    for place, joint in enumerate(joints):
        carries.setdefault(_ends(joint)[0], []).append(place)
    found: list[int] = []
    ready = carries.get(root, [])
    while ready:
        found += ready
        reached = [_ends(joints[place])[1] for place in ready]
        ready = sorted(place for link in reached for place in carries.get(link, ()))
    if len(found) < len(joints):
        name = name_of(source, joints[min({*range(len(joints))} - {*found})])
        raise FileFormatError(
            f"{source}: joint {name!r} is in a ring of links that nothing carries; join it to the root."
        )
    return [joints[place] for place in found]


def _massive(link: Element) -> bool:
    return link.find("inertial") is not None


def _owners(source: str, root: str, joints: list[Element], links: Mapping[str, Element]) -> dict[str, str]:
    """The body whose part each link is: itself, or what it is fixed to without a mass of its own."""
    owner = {root: root}
    for joint in joints:
        parent, child = _ends(joint)
        if _massive(links[child]):
            owner[child] = child
        elif joint.get("type") == "fixed":
            owner[child] = owner[parent]
        else:
            raise FileFormatError(
                f"{source}: link {child!r} moves on joint {name_of(source, joint)!r} and has no <inertial>; "
                "give its mass and inertia."
            )
    return owner


def _properties(source: str, link: Element, frame: Placed) -> MassProperties:
    what = f"link {name_of(source, link)!r}"
    inertial = link.find("inertial")
    assert inertial is not None
    inner = frame.inner(origin_of(source, inertial))
    mass = value_of(source, what, inertial.find("mass"), "value")
    if not mass > 0.0:
        raise FileFormatError(f"{source}: {what} has mass {mass:g} kg; give one above zero.")
    xx, xy, xz, yy, yz, zz = (value_of(source, what, inertial.find("inertia"), key) for key in MOMENTS)
    own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    moments = np.linalg.eigvalsh(own)
    if not (moments[0] > 0.0 and moments[0] + moments[1] >= moments[2] * (1.0 - 1e-6)):
        raise FileFormatError(
            f"{source}: {what} has principal moments {', '.join(f'{m:g}' for m in moments)} kg m2; "
            "each is above zero, and none above the sum of the others, about the centre of mass."
        )
    return MassProperties(mass, inner.origin, inner.axes @ own @ inner.axes.T)


def _joint(source: str, joint: Element, placed: Mapping[str, Placed], owner: Mapping[str, str]) -> JointData:
    name, kind = name_of(source, joint), str(joint.get("type"))
    what = f"joint {name!r}"
    if kind not in KINDS:
        raise FileFormatError(f"{source}: {what} is {shown(kind)}; seacrane reads {', '.join(KINDS)}.")
    if joint.find("mimic") is not None:
        raise FileFormatError(
            f"{source}: {what} mimics another, which seacrane does not read; take <mimic> out, and close the "
            "mechanism by [[closing_joints]]."
        )
    _warn_of_dynamics(source, what, joint)
    parent, child = _ends(joint)
    frame = placed[child]
    axis = None
    if KINDS[kind] != "weld":
        given = joint.find("axis")
        row = np.array([1.0, 0.0, 0.0]) if given is None else row_of(source, what, given, "xyz")
        length = float(np.linalg.norm(row))
        if length == 0.0:
            raise FileFormatError(f"{source}: {what} has an axis of zeros; give a direction.")
        axis = frame.axes @ (row / length)
    return JointData(
        name=name, kind=KINDS[kind], first=owner[parent], second=child, point=frame.origin, axis=axis,
        range=_range(source, what, joint) if kind in ("revolute", "prismatic") else None,
    )  # fmt: skip


def _range(source: str, what: str, joint: Element) -> tuple[float, float] | None:
    limit = joint.find("limit")
    if limit is None:
        return None
    low, high = (float(value_of(source, what, limit, key, default=0.0)) for key in ("lower", "upper"))
    if low == high == 0.0:
        return None
    if not low < high:
        raise FileFormatError(
            f"{source}: {what} has limits {low:g} to {high:g}; the lower is below the upper."
        )
    return low, high


def _warn_of_dynamics(source: str, what: str, joint: Element) -> None:
    dynamics = joint.find("dynamics")
    if dynamics is None:
        return
    losses = [value_of(source, what, dynamics, key, default=0.0) for key in ("damping", "friction")]
    if any(not math.isclose(loss, 0.0) for loss in losses):
        warn_caller(
            f"{source}: {what} has damping or friction, which is not taken over; add it by "
            "Scene.add_friction",
            UrdfWarning,
        )


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
