"""Hulls: the wetted panels and straight topsides above them, or a box from mass and inertia."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from seacrane.hydro import Hull
from seacrane.pictures.shapes import HullShape

Array = NDArray[np.float64]

GYRATION = (0.36, 0.25)  # usual radii of gyration over breadth, about x, and over length, about y
BLOCK = 0.7  # usual share of length x breadth x draught that displaces water
DENSITY = 1025.0  # kg/m3
DRAUGHTS = (0.1, 0.6)  # of the breadth, within which a schematic hull's draught stays
BOW = 0.18  # of the length, that narrows in a schematic hull
LEVEL = 1e-6  # of the length: edges that near to the waterline lie on it
STATIONS = 40


def hull_shape(hull: Hull, deck: float, center_of_mass: Array) -> HullShape:
    """The panels of a hull (body axes from the body's origin) and topsides straight up to a deck at height
    `deck`, m."""
    panels = np.asarray(hull.panels)
    triangles = np.concatenate([panels[:, [0, 1, 2]], panels[:, [0, 2, 3]]])
    x, half = _waterline(panels)
    soup = np.concatenate([triangles, _topsides(x, half, deck)]) - center_of_mass
    return _shape(soup, -float(center_of_mass[2]))


def schematic_hull(mass: float, inertia: Array, deck: float | None, center_of_mass: Array) -> HullShape:
    """A box with a bow whose length and breadth have the usual ratio to the radii of gyration, and whose
    draught displaces the mass; the deck at height `deck`, m, or half a draught above the water."""
    return box_hull(*schematic_size(mass, inertia), deck, center_of_mass)


def box_hull(
    length: float, breadth: float, draught: float, deck: float | None, center_of_mass: Array
) -> HullShape:
    """A box with a bow, of that size in m; the deck at height `deck`, m, or half a draught above water."""
    deck = 0.5 * draught if deck is None else deck
    x = length * np.concatenate([[-0.5], np.linspace(0.5 - BOW, 0.5, 8)])
    half = 0.5 * breadth * np.concatenate([[1.0], 1.0 - np.linspace(0.0, 1.0, 8) ** 2])
    soup = np.concatenate([_topsides(x, half, deck), _sides(x, half, -draught, 0.0), _lid(x, half, -draught)])
    return _shape(soup - center_of_mass, -float(center_of_mass[2]))


def schematic_size(mass: float, inertia: Array) -> tuple[float, float, float]:
    """Length, breadth and draught, m."""
    roll, pitch = np.sqrt(np.maximum(np.diag(inertia)[:2], 0.0) / mass)
    length, breadth = float(pitch) / GYRATION[1], float(roll) / GYRATION[0]
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
    corners = [
        np.column_stack([p, np.full(len(p), z)]) for p, z in ((a, low), (b, low), (b, high), (a, high))
    ]
    return _halved(np.stack(corners, axis=1))


def _lid(x: Array, half: Array, level: float) -> Array:
    """Flat across both sides."""
    port, starboard = (np.column_stack([x, side * half, np.full(len(x), level)]) for side in (1.0, -1.0))
    return _halved(np.stack([port[:-1], starboard[:-1], starboard[1:], port[1:]], axis=1))


def _halved(quads: Array) -> Array:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def _shape(triangles: Array, waterline: float) -> HullShape:
    vertices, faces = np.unique(np.round(triangles.reshape(-1, 3), 4), axis=0, return_inverse=True)
    indices = faces.reshape(-1, 3)
    flat = (
        (indices[:, 0] == indices[:, 1]) | (indices[:, 1] == indices[:, 2]) | (indices[:, 2] == indices[:, 0])
    )
    return HullShape(vertices=vertices, faces=indices[~flat], waterline=waterline)
