"""What bodies look like, about the centre of mass: tubes, boxes, meshes, hulls, parts in water; colours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.revolved import revolved
from seacrane.description.wet_parts import immersed_parts
from seacrane.hydro import Hull
from seacrane.hydro.data.hydro_group_data import USUAL_RADII

BLOCK = 0.7  # usual share of length x breadth x draught that displaces water
DENSITY = 1025.0  # kg/m3
DRAUGHTS = (0.1, 0.6)  # of the breadth, within which a schematic hull's draught stays
BOW = 0.18  # of the length, that narrows in a schematic hull
LEVEL = 1e-6  # of the length: edges that near to the waterline lie on it
STATIONS = 40
AROUND, DOWN = 16, 8  # faces of a sphere
THINNEST = 0.01  # m, that is drawn of a plate
BODIES = {
    "crane": "#f0a818", "tower": "#e8e4da", "barrel": "#5b6670", "rod": "#c9d1d6", "payload": "#b5432f",
    "sheave": "#5b6670", "hub": "#c9d1d6", "drum": "#2f4a6b", "mark": "#ffe14d",
}  # fmt: skip
PLAIN = ("#7c6aa6", "#3f8f8a", "#b0793a", "#5578a8", "#8a8f3c", "#a65a7c")  # bodies of no other kind, in turn
HULL = {"above": "#2f5f86", "deck": "#93a58e", "below": "#8c3b32"}
WIRES = {"link": "#1b1f24", "wire": "#1b1f24", "spring": "#6a4fa0", "barrel": BODIES["barrel"],
         "rod": BODIES["rod"]}  # fmt: skip
SLACK = "#e0701a"
TRACKS = {"tip": "#ffffff", "payload": "#ffe14d"}


@dataclass(frozen=True, kw_only=True, eq=False)
class TubeShape:
    """A round bar between two points, m."""

    start: Array
    end: Array
    radius: float
    colour: str = ""

    @property
    def points(self) -> Array:
        """(2, 3)."""
        return np.array([self.start, self.end])

    def data(self) -> dict[str, Any]:
        """For the page."""
        ends = [*plain(self.start), *plain(self.end)]
        return {"kind": "tube", "ends": ends, "radius": float(f"{self.radius:.4g}"), "colour": self.colour}


@dataclass(frozen=True, kw_only=True, eq=False)
class BoxShape:
    """A box of edges `size` (3,) along the columns of `axes` (3, 3) about `centre`, m."""

    centre: Array
    axes: Array
    size: Array
    colour: str = ""

    @property
    def points(self) -> Array:
        """(8, 3), its corners."""
        signs = np.array(np.meshgrid(*[(-0.5, 0.5)] * 3)).reshape(3, 8).T
        return np.asarray(self.centre + (signs * self.size) @ self.axes.T)

    def data(self) -> dict[str, Any]:
        """For the page."""
        numbers = {"centre": self.centre, "axes": np.asarray(self.axes).T, "size": self.size}
        return {"kind": "box", "colour": self.colour} | {key: plain(value) for key, value in numbers.items()}


@dataclass(frozen=True, kw_only=True, eq=False)
class MeshShape:
    """Triangles `faces` (m, 3) of `vertices` (n, 3), m, of one colour."""

    vertices: Array
    faces: NDArray[np.int64]
    colour: str = ""

    @property
    def points(self) -> Array:
        """(n, 3)."""
        return self.vertices


@dataclass(frozen=True, kw_only=True, eq=False)
class HullShape(MeshShape):
    """With the still waterline at height `waterline`, m, and the colours of a hull."""

    waterline: float


Shape = TubeShape | BoxShape | MeshShape


def plain(values: Any) -> list[float]:
    """Numbers to a tenth of a millimetre."""
    return [round(float(value), 4) + 0.0 for value in np.ravel(values)]


def equivalent_box(mass: float, inertia: Array) -> BoxShape:
    """The uniform box with this mass (kg) and inertia (3, 3), kg m2, about its centre."""
    moments, axes = _principal(np.asarray(inertia, dtype=float))
    squares = 6.0 / mass * (moments.sum() - 2.0 * moments) if mass > 0.0 else np.zeros(3)
    return BoxShape(centre=np.zeros(3), axes=axes, size=np.sqrt(np.maximum(squares, 0.0)))


def _principal(inertia: Array) -> tuple[Array, Array]:
    """Moments and right-handed axes (columns); the body's own axes where the inertia is diagonal."""
    diagonal = np.diag(np.diag(inertia))
    if np.allclose(inertia, diagonal, rtol=0.0, atol=1e-9 * float(np.abs(inertia).max(initial=0.0))):
        return np.diag(inertia).copy(), np.eye(3)
    moments, axes = np.linalg.eigh(inertia)
    return moments, axes * np.array([1.0, 1.0, np.sign(np.linalg.det(axes))])


def framework(points: Array, radius: float) -> list[TubeShape]:
    """Tubes that join points (n, 3) by the shortest total length."""
    joined, left, tubes = [0], list(range(1, len(points))), []
    while left:
        gaps = np.linalg.norm(points[joined][:, None] - points[left][None], axis=-1)
        a, b = np.unravel_index(int(np.argmin(gaps)), gaps.shape)
        start, end = joined[int(a)], left.pop(int(b))
        tubes.append(TubeShape(start=points[start], end=points[end], radius=radius))
        joined.append(end)
    return tubes


def distinct(points: Sequence[Any], apart: float = 1e-3) -> Array:
    """Points (n, 3) without those nearer than `apart` (m) to an earlier one."""
    kept: list[Array] = []
    for point in points:
        array = np.asarray(point, dtype=float).reshape(3)
        if all(float(np.linalg.norm(array - other)) > apart for other in kept):
            kept.append(array)
    return np.array(kept).reshape(-1, 3)


def hull_shape(hull: Hull, deck: float, center_of_mass: Array) -> HullShape:
    """The panels of a hull (axes from the body's origin), straight sides up to a deck at height `deck`, m."""
    panels = np.asarray(hull.panels)
    x, half = _waterline(panels)
    soup = np.concatenate([_halved(panels), _topsides(x, half, deck)]) - center_of_mass
    return _hull_of(soup, -float(center_of_mass[2]))


def box_hull(
    length: float, breadth: float, draught: float, deck: float | None, center_of_mass: Array
) -> HullShape:
    """A box with a bow, of that size in m; the deck at height `deck`, m, or half a draught above water."""
    deck = 0.5 * draught if deck is None else deck
    x = length * np.concatenate([[-0.5], np.linspace(0.5 - BOW, 0.5, 8)])
    half = 0.5 * breadth * np.concatenate([[1.0], 1.0 - np.linspace(0.0, 1.0, 8) ** 2])
    soup = np.concatenate([_topsides(x, half, deck), _sides(x, half, -draught, 0.0), _lid(x, half, -draught)])
    return _hull_of(soup - center_of_mass, -float(center_of_mass[2]))


def schematic_size(mass: float, inertia: Array) -> tuple[float, float, float]:
    """Length, breadth and draught, m: in the usual ratio to the radii of gyration, to displace the mass."""
    roll, pitch = np.sqrt(np.maximum(np.diag(inertia)[:2], 0.0) / mass)
    length, breadth = float(pitch / USUAL_RADII[1]), float(roll / USUAL_RADII[0])
    if not (length > 0.0 and breadth > 0.0):
        length = breadth = float(np.cbrt(mass / DENSITY / BLOCK))
    draught = mass / (DENSITY * BLOCK * length * breadth)
    return length, breadth, float(np.clip(draught, DRAUGHTS[0] * breadth, DRAUGHTS[1] * breadth))


def _waterline(panels: Array) -> tuple[Array, Array]:
    """Stations and half breadths of the waterline, from the panels' highest vertices."""
    points = panels.reshape(-1, 3)
    x_all, y_all = points[points[:, 2] > -LEVEL * float(np.ptp(points[:, 0]))][:, :2].T
    x = np.unique(np.round(x_all, 6))
    half = np.array([np.abs(y_all[np.abs(x_all - station) < 1e-5]).max() for station in x])
    if len(x) > 2 * STATIONS:
        even = np.linspace(x[0], x[-1], STATIONS)
        x, half = even, np.interp(even, x, half)
    return x, half


def _topsides(x: Array, half: Array, deck: float) -> Array:
    """Sides from the water to the deck, and the deck."""
    return np.concatenate([_sides(x, half, 0.0, deck), _lid(x, half, deck)])


def _sides(x: Array, half: Array, low: float, high: float) -> Array:
    """Upright walls along both sides and across the stern, triangles (n, 3, 3)."""
    port = np.column_stack([x, half])
    outline = np.concatenate([port, port[::-1] * np.array([1.0, -1.0])])
    a, b = outline, np.roll(outline, -1, axis=0)
    around = ((a, low), (b, low), (b, high), (a, high))
    corners = [np.column_stack([p, np.full(len(p), z)]) for p, z in around]
    return _halved(np.stack(corners, axis=1))


def _lid(x: Array, half: Array, level: float) -> Array:
    """Flat across both sides."""
    port, starboard = (np.column_stack([x, side * half, np.full(len(x), level)]) for side in (1.0, -1.0))
    return _halved(np.stack([port[:-1], starboard[:-1], starboard[1:], port[1:]], axis=1))


def _halved(quads: Array) -> Array:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _hull_of(triangles: Array, waterline: float) -> HullShape:
    vertices, faces = np.unique(np.round(triangles.reshape(-1, 3), 4), axis=0, return_inverse=True)
    indices = faces.reshape(-1, 3)
    flat = (indices == np.roll(indices, -1, axis=1)).any(axis=1)
    return HullShape(vertices=vertices, faces=indices[~flat], waterline=waterline)


def wet_shapes(scene: Description, body: str) -> list[Shape]:
    """Of all its parts, relative to its centre of mass, body axes, m."""
    centre = np.asarray(scene.bodies[body].center_of_mass, dtype=float)
    parts = [part for part in immersed_parts(scene).values() if part.body == body and part.shape != "disc"]
    return [_wet_shape(part, centre) for part in parts]


def _wet_shape(part: _core.ImmersedPart, centre: Array) -> Shape:
    at, axes, size = np.asarray(part.point) - centre, np.asarray(part.axes), np.asarray(part.size)
    if part.shape == "cylinder":
        half = 0.5 * size[0] * axes[:, 0]
        return TubeShape(start=at - half, end=at + half, radius=0.5 * float(size[1]))
    if part.shape == "sphere":
        polar = np.linspace(-0.5 * np.pi, 0.5 * np.pi, DOWN + 1)
        points, faces = revolved(0.5 * size[0] * np.column_stack([np.cos(polar), np.sin(polar)]), AROUND)
        return MeshShape(vertices=at + points, faces=faces)
    return BoxShape(centre=at, axes=axes, size=np.maximum(size, THINNEST))


def body_colour(part: str, role: str, number: int) -> str:
    """The colour of a part, else of its body's role, else one of the plain ones by the body's number."""
    return BODIES.get(part) or BODIES.get(role) or PLAIN[number % len(PLAIN)]


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green, blue of "#rrggbb", 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return red, green, blue
