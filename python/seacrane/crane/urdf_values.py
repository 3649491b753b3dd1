"""Numbers, names and origins in a URDF file."""

from __future__ import annotations

import math
from xml.etree.ElementTree import Element

import numpy as np
from numpy.typing import NDArray

from seacrane.crane.data import HOME, Placed
from seacrane.errors import FileFormatError
from seacrane.inputs.shown import shown

Array = NDArray[np.float64]
LARGEST = 1e12


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
