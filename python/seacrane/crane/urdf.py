"""Reads the bodies and joints of a URDF file, and what its links are drawn by.

Source: the specification of the Unified Robot Description Format, wiki.ros.org/urdf/XML (link, joint).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn
from xml.etree.ElementTree import Element, ParseError, fromstring

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.crane.data import HOME, BodyData, JointData, MeshData, Placed, placed
from seacrane.crane.file_table import LARGEST, Frames
from seacrane.crane.mass_properties import MassProperties
from seacrane.description.revolved import revolved
from seacrane.errors import FileFormatError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.shown import listed, shown
from seacrane.inputs.whole_file import read_whole
from seacrane.warnings import UrdfWarning

LARGEST_FILE = 2**24  # bytes
KINDS = {"revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic", "fixed": "weld"}
MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
AROUND = 24  # corners of a circle
READABLE = (".stl", ".glb", ".gltf")


@dataclass(frozen=True, eq=False)
class Tag:
    """An element of the file, if it is there, and what messages call it."""

    source: str
    what: str
    element: Element | None

    def fail(self, says: str) -> NoReturn:
        """Raise a FileFormatError of this element."""
        raise FileFormatError(f"{self.source}: {self.what} {says}.")

    def wrong(self, key: str, text: str, fix: str) -> NoReturn:
        """Raise a FileFormatError of an attribute."""
        raise FileFormatError(f"{self.source}: {self.what}: {key} is {shown(text)}; {fix}.")

    def find(self, tag: str) -> Tag:
        """What is within it, of which messages speak as of it."""
        return Tag(self.source, self.what, None if self.element is None else self.element.find(tag))

    def get(self, key: str, usual: str = "") -> str:
        """An attribute."""
        return usual if self.element is None else self.element.get(key, usual)

    def number(self, key: str, default: float | None = None) -> float:
        """An attribute that is a finite number."""
        text = None if self.element is None else self.element.get(key)
        if text is None and default is None:
            self.fail(f"has no {key}; give it")
        return float(default or 0.0) if text is None else self._number(key, text)

    def row(self, key: str, usual: str = "0 0 0") -> Array:
        """An attribute of three finite numbers."""
        text = self.get(key, usual)
        row = [self._number(key, one) for one in text.split()]
        if len(row) != 3:
            self.wrong(key, text, "write three numbers")
        return np.array(row)

    def _number(self, key: str, text: str) -> float:
        try:
            found = float(text)
        except ValueError:
            found = math.nan
        if not abs(found) <= LARGEST:
            self.wrong(key, text, "write a finite number")
        return found

    def origin(self) -> Placed:
        """The frame of its <origin>, m: rotations about the fixed axes x, y, z."""
        origin = self.find("origin").element
        if origin is None or self.element is None:
            return HOME
        name = self.element.get("name") or f"<{self.element.tag}>"
        here = Tag(self.source, f"<origin> of {name}", origin)
        return placed(here.row("xyz"), here.row("rpy"))


@dataclass(frozen=True, eq=False)
class _Joint(Tag):
    """A joint, and the names of its parent link and its child link."""

    name: str
    parent: str
    child: str


def read_urdf(path: Path) -> tuple[str, tuple[BodyData, ...], tuple[JointData, ...], Frames]:
    """Read links and joints: the root link, whose frame is that of the crane foot, bodies, joints, frames.

    Joints are in order from the root outwards. Links without mass on fixed joints are frames of what they are
    fixed to. Collision shapes, materials, transmissions and extensions are not read; an UrdfWarning names
    what is left out and would matter. FileFormatError for what is no URDF, or says something that cannot be.
    """
    source, robot = path.name, _robot(path)
    named = {_name(source, link): link for link in robot.findall("link")}
    links = {name: Tag(source, f"link {name!r}", link) for name, link in named.items()}
    if not links:
        raise FileFormatError(f"{source}: has no links; give a URDF of a crane.")
    joints = []
    for one in robot.findall("joint"):
        name, ends = _name(source, one), (one.find(tag) for tag in ("parent", "child"))
        parent, child = ("" if end is None else end.get("link", "") for end in ends)
        joints.append(_Joint(source, f"joint {name!r}", one, name, parent, child))
    root, ordered = _outwards(source, joints, links)
    frames: dict[str, Placed] = {root: HOME}
    owner, parts = {root: root}, {root: [root]}  # the body whose part each link is; and its parts
    for joint in ordered:
        frames[joint.child] = frames[joint.parent].inner(joint.origin())
        massive = links[joint.child].find("inertial").element is not None
        if not massive and joint.get("type") != "fixed":
            links[joint.child].fail(f"moves on {joint.what} and has no <inertial>; give its mass and inertia")
        owner[joint.child] = joint.child if massive else owner[joint.parent]
        parts.setdefault(owner[joint.child], []).append(joint.child)
    bodies = tuple(
        BodyData(
            name=name,
            properties=_properties(link, frames[name]),
            meshes=tuple(
                mesh for part in parts[name] for mesh in _meshes(path.parent, part, links[part], frames[part])
            ),
        )
        for name, link in links.items()
        if link.find("inertial").element is not None
    )
    found = tuple(_joint(one, frames[one.child], owner) for one in ordered if owner[one.child] == one.child)
    return root, bodies, found, {name: (owner[name], frame) for name, frame in frames.items()}


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


def _name(source: str, element: Element) -> str:
    name = element.get("name", "")
    if not name:
        raise FileFormatError(f"{source}: a <{element.tag}> has no name; give each one its own.")
    return name


def _outwards(source: str, joints: list[_Joint], links: Mapping[str, Tag]) -> tuple[str, list[_Joint]]:
    """The root, and joints by their distance from it, those as far as each other as the file has them.

    FileFormatError for a loop, a ring or several roots.
    """
    carried: dict[str, str] = {}
    carries: dict[str, list[int]] = {}
    for place, joint in enumerate(joints):
        for link in (joint.parent, joint.child):
            if link not in links:
                joint.fail(f"names link {shown(link)}; there are {listed([*links])}")
        if joint.child in carried:
            raise FileFormatError(
                f"{source}: link {joint.child!r} is carried by joints {carried[joint.child]!r} and "
                f"{joint.name!r}: a loop. Take {joint.what} out, and write it as one of [[closing_joints]] "
                "in the table beside the URDF."
            )
        carried[joint.child] = joint.name
        carries.setdefault(joint.parent, []).append(place)
    roots = [name for name in links if name not in carried]
    if len(roots) != 1:
        which = f"links {listed(roots)} have no parent" if roots else "every link has a parent: a loop"
        raise FileFormatError(f"{source}: {which}; one link must stand on the base, and no other.")
    found: list[int] = []
    ready = carries.get(roots[0], [])
    while ready:
        found += ready
        ready = sorted(one for place in ready for one in carries.get(joints[place].child, ()))
    if len(found) < len(joints):
        lost = joints[min({*range(len(joints))} - {*found})]
        lost.fail("is in a ring of links that nothing carries; join it to the root")
    return roots[0], [joints[place] for place in found]


def _properties(link: Tag, frame: Placed) -> MassProperties:
    inertial = link.find("inertial")
    inner = frame.inner(inertial.origin())
    mass = inertial.find("mass").number("value")
    if not mass > 0.0:
        link.fail(f"has mass {mass:g} kg; give one above zero")
    xx, xy, xz, yy, yz, zz = (inertial.find("inertia").number(key) for key in MOMENTS)
    own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    moments = np.linalg.eigvalsh(own)
    if not (moments[0] > 0.0 and moments[0] + moments[1] >= moments[2] * (1.0 - 1e-6)):
        link.fail(
            f"has principal moments {', '.join(f'{m:g}' for m in moments)} kg m2; each is above zero, and "
            "none above the sum of the others, about the centre of mass"
        )
    return MassProperties(mass, inner.origin, inner.axes @ own @ inner.axes.T)


def _joint(joint: _Joint, frame: Placed, owner: Mapping[str, str]) -> JointData:
    kind = joint.get("type", "None")
    if kind not in KINDS:
        joint.fail(f"is {shown(kind)}; seacrane reads {', '.join(KINDS)}")
    if joint.find("mimic").element is not None:
        joint.fail(
            "mimics another, which seacrane does not read; take <mimic> out, and close the mechanism by "
            "[[closing_joints]]"
        )
    losses = [joint.find("dynamics").number(key, 0.0) for key in ("damping", "friction")]
    if any(not math.isclose(loss, 0.0) for loss in losses):
        warn_caller(
            f"{joint.source}: {joint.what} has damping or friction, which is not taken over; add it by "
            "Scene.add_friction",
            UrdfWarning,
        )
    axis = None
    if KINDS[kind] != "weld":
        given = joint.find("axis")
        row = given.row("xyz", "1 0 0" if given.element is None else "0 0 0")
        length = float(np.linalg.norm(row))
        if length == 0.0:
            joint.fail("has an axis of zeros; give a direction")
        axis = frame.axes @ (row / length)
    return JointData(
        name=joint.name, kind=KINDS[kind], first=owner[joint.parent], second=joint.child, point=frame.origin,
        axis=axis, range=_range(joint) if kind in ("revolute", "prismatic") else None,
    )  # fmt: skip


def _range(joint: _Joint) -> tuple[float, float] | None:
    low, high = (joint.find("limit").number(key, 0.0) for key in ("lower", "upper"))
    if low == high == 0.0:
        return None
    if not low < high:
        joint.fail(f"has limits {low:g} to {high:g}; the lower is below the upper")
    return low, high


def _meshes(folder: Path, name: str, link: Tag, frame: Placed) -> Iterator[MeshData]:
    """The meshes of a link, placed in the crane-foot frame at home."""
    assert link.element is not None
    for i, visual in enumerate(link.element.findall("visual")):
        geometry = visual.find("geometry")
        shape = None if geometry is None else next(iter(geometry), None)
        if shape is not None:
            label = name if i == 0 else f"{name} {i + 1}"
            place = frame.inner(Tag(link.source, link.what, visual).origin())
            given = _shape(folder, Tag(link.source, f"visual {label!r}", shape), shape.tag)
            if given:
                yield MeshData(name=label, frame=place, **given)


def _shape(folder: Path, shape: Tag, kind: str) -> dict[str, Any]:
    """A file and its scale, or triangles; nothing where a file is of a kind that is not drawn."""
    match kind:
        case "mesh":
            return _file(folder, shape)
        case "box":
            vertices, faces = _box(shape.row("size"))
        case "cylinder":
            profile = np.array([[0.0, -0.5], [1.0, -0.5], [1.0, 0.5], [0.0, 0.5]])
            vertices, faces = revolved(profile * [shape.number(key) for key in ("radius", "length")], AROUND)
        case "sphere":
            angle = np.linspace(-0.5 * np.pi, 0.5 * np.pi, AROUND // 2 + 1)
            arc = np.column_stack([np.cos(angle), np.sin(angle)])
            vertices, faces = revolved(shape.number("radius") * arc, AROUND)
        case _:
            shape.fail(f"is a <{kind[:40]}>; write mesh, box, cylinder or sphere")
    if not np.all(np.ptp(vertices, axis=0) > 0.0):
        shape.fail("has no extent; give sizes above zero")
    return {"vertices": vertices, "faces": faces}


def _file(folder: Path, shape: Tag) -> dict[str, Any]:
    given = shape.get("filename")
    path = folder / given.removeprefix("file://").removeprefix("package://")
    scale = shape.row("scale") if shape.get("scale") else np.ones(3)
    if not (scale[0] == scale[1] == scale[2] and scale[0] > 0.0):
        shape.fail(f"has scale {scale.tolist()}; give three equal numbers")
    if path.suffix.lower() in READABLE:
        return {"file": path, "scale": float(scale[0])}
    warn_caller(
        f"{shape.source}: {shape.what} is {shown(given)}, which is not drawn; convert it to "
        f"{', '.join(READABLE)}",
        UrdfWarning,
    )
    return {}


def _box(size: Array) -> tuple[Array, NDArray[np.int64]]:
    corners = 0.5 * size * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners, np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])
