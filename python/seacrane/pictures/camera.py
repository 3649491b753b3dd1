"""Where a camera may stand, so that a box of things just fits into the picture; as the page's bookmarks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_about_z, rotation_matrix
from seacrane.inputs.shown import shown
from seacrane.pictures.drawing import Drawing

Array = NDArray[np.float64]

WHOLE = {
    "overview": (0.72, 0.95, 0.42),
    "port": (0.0, 1.0, 0.16),
    "starboard": (0.0, -1.0, 0.16),
    "bow": (1.0, 0.0, 0.16),
    "stern": (-1.0, 0.0, 0.22),
    "top": (0.0, -0.001, 1.0),
}
CLOSE = (0.6, 0.75, 0.3)
OPENING = 38.0  # deg, of the picture's height
MARGIN = 0.9  # corners of the box are empty
NEAR = (4.0, 0.45)  # a close camera's distance: over the body's size, and over the radius of everything


@dataclass(frozen=True, kw_only=True, eq=False)
class Camera:
    """Place, target (3,), m, and the body that it follows, by its number; -1: none."""

    place: Array
    target: Array
    follows: int = -1

    def at(self, position: Array) -> tuple[Array, Array]:
        """Place and target where the bodies are at these positions (bodies, 3), m."""
        moved = position[self.follows] if self.follows >= 0 else np.zeros(3)
        return self.place + moved, self.target + moved


def camera_of(drawing: Drawing, name: str, aspect: float) -> Camera:
    """The camera of that name: a view of everything, or a payload's name, which it follows.

    Raises
    ------
    SceneError
        For another name.
    """
    payloads = [body for body, look in drawing.looks.items() if look.role == "payload"]
    if name not in (*WHOLE, *payloads):
        raise SceneError(f"camera is {shown(name)}; choose {', '.join((*WHOLE, *payloads))}")
    heading, side = _ahead(drawing, payloads)
    turn = rotation_about_z(heading)
    if name in payloads:
        number = drawing.motion.bodies.index(name)
        size = float(np.linalg.norm(np.ptp(drawing.looks[name].points, axis=0)))
        far = max(NEAR[0] * size, NEAR[1] * drawing.radius)
        out = _unit(turn @ np.array([CLOSE[0], side * CLOSE[1], CLOSE[2]]))
        return Camera(place=far * out, target=np.zeros(3), follows=number)
    x, y, z = WHOLE[name]
    out = _unit(turn @ np.array([x, y * side if name == "overview" else y, z]))
    centre = drawing.box.mean(axis=0)
    return Camera(place=centre + MARGIN * _distance(drawing.box, out, aspect) * out, target=centre)


def _ahead(drawing: Drawing, payloads: list[str]) -> tuple[float, float]:
    """Heading of the first vessel at the start, rad, and the side on which the payload ends: 1 is port."""
    motion = drawing.motion
    vessels = [i for i, body in enumerate(motion.bodies) if drawing.looks[body].role == "vessel"]
    ahead = rotation_matrix(motion.quaternion[0, vessels[0]])[:, 0] if vessels else np.array([1.0, 0.0, 0.0])
    centre = drawing.box.mean(axis=0)
    last = motion.position[-1, motion.bodies.index(payloads[0])] if payloads else centre
    across = np.array([-ahead[1], ahead[0], 0.0])
    return float(np.arctan2(ahead[1], ahead[0])), 1.0 if across @ (last - centre) >= 0.0 else -1.0


def _distance(box: Array, out: Array, aspect: float) -> float:
    """How far from the box's centre every corner lies within the opening."""
    up = float(np.tan(np.radians(0.5 * OPENING)))
    right = _unit(np.cross([0.0, 0.0, 1.0], out))
    top = np.cross(out, right)
    corners = np.array([[x, y, z] for x in box[:, 0] for y in box[:, 1] for z in box[:, 2]]) - box.mean(
        axis=0
    )
    wide = np.maximum(np.abs(corners @ right) / (up * aspect), np.abs(corners @ top) / up)
    return float((corners @ out + wide).max())


def _unit(vector: Array) -> Array:
    return np.asarray(vector / np.linalg.norm(vector))
