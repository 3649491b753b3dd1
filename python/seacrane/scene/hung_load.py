"""A load below a crane's tip, hanging or on a deck, the block over it, and the slings between them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.description.description import GROUND, Description
from seacrane.description.elements import add_joint
from seacrane.description.places import ORIGIN, place_of
from seacrane.description.roles import CraneRoles
from seacrane.description.rungs import StretchingRung
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of, positive_of, shaped_of, text_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import warn_of_density
from seacrane.scene.bodies import add_body
from seacrane.scene.lift_factors import rating_of
from seacrane.scene.limits import add_contact, add_stop
from seacrane.scene.lines import add_line, hung_from

BLOCK_DENSITY = 2000.0  # kg/m3 over its outline: plates, sheaves and gaps; gives a block its size alone
UPRIGHT = (1.0, 0.0, 0.0, 0.0)


@named
@dataclass(frozen=True, kw_only=True)
class Slings:
    """Slings from a block to a load, alike: from one point to points of the load.

    Attributes
    ----------
    EA : float
        Axial stiffness of each, N.
    length : float or None
        Of each as it hangs, m; give it or the angle.
    angle_deg : float or None
        Of the slings from the horizontal, deg, between 0 and 90.
    points : array_like of shape (n, 3), or None
        On the load, in its coordinates, m. Default: the four upper corners of its size.
    breaking_load : float or None
        Of each, N.
    safety_factor : float or None
        Least breaking load over largest force.
    rung : {"elastic", "quasi-static", "auto"}
        Of each, as in `add_line`.
    """

    EA: float
    length: float | None = None
    angle_deg: float | None = None
    points: Any = None
    breaking_load: float | None = None
    safety_factor: float | None = None
    rung: StretchingRung = "elastic"

    def __post_init__(self) -> None:
        positive_of("slings: EA", self.EA)
        rating_of("slings", self.breaking_load, self.safety_factor)
        if (self.length is None) == (self.angle_deg is None):
            raise SceneError(
                "slings: give their length (m) or their angle_deg from the horizontal, one of them"
            )
        if self.length is not None:
            positive_of("slings: length", self.length)
        elif not 0.0 < number_of("slings: angle_deg", self.angle_deg) < 90.0:
            raise SceneError.of(
                "slings: angle_deg",
                f"is {self.angle_deg:g}; give an angle from the horizontal between 0 and 90",
            )

    def height(self, points: Array) -> float:
        """Of the hook over the points, m; SceneError for slings that do not reach from one to the other."""
        centre = points.mean(axis=0)
        reach = float(np.linalg.norm((points - centre)[:, :2], axis=1).max())
        if self.angle_deg is not None:
            return reach * math.tan(math.radians(self.angle_deg))
        assert self.length is not None
        if self.length <= reach:
            raise SceneError.of(
                "slings: length",
                f"is {self.length:g} m, and their points are {reach:.4g} m from the middle of "
                f"the load; give more than {reach:.4g} m",
            )
        return math.sqrt(self.length**2 - reach**2)


def add_load_below(
    scene: Description, what: str, roles: CraneRoles, name: str, box: tuple[float | None, ArrayLike | None],
    tip: Array, rig: Slings | None, place: tuple[float | None, float | None, str | None],
    feet: Mapping[str, Any] | None,
) -> None:  # fmt: skip
    """A box below the tip, hanging, or standing on a seat or on feet."""
    mass, size = box
    if mass is None or size is None:
        raise SceneError(f"{what}: body {name!r} is not there, and has no mass or size to be made; give both")
    edges = np.array(shaped_of(f"{what}: size", size, (3,)))
    warn_of_density(what, positive_of(f"{what}: mass", mass), float(np.prod(edges)))
    rigging = 0.0 if rig is None else rig.height(_corners(rig, edges))
    length, height, on = place
    if on is not None:
        origin, turned = _on_deck(scene, what, on, 0.0 if height is None else height, tip)
        centre = origin + rotation_matrix(turned) @ np.array([0.0, 0.0, 0.5 * edges[2]])
        _require_below(what, float(tip[2] - centre[2] - 0.5 * edges[2] - rigging), length)
    else:
        if length is not None and height is not None:
            raise SceneError(f"{what}: has a length and a height; give one of them")
        top = tip[2] - rigging - (8.0 if length is None else positive_of(f"{what}: length", length))
        if height is not None:
            top = number_of(f"{what}: height", height) + edges[2]
        _require_below(what, float(tip[2] - rigging - top), None)
        centre = np.array([tip[0], tip[1], top - 0.5 * edges[2]])
        turned = _heading(scene, roles)
    add_body(scene, name, mass=mass, size=edges, position=centre, quaternion=turned)
    if on is not None and feet is not None:
        corners = [(x * edges[0], y * edges[1], -0.5 * edges[2]) for x in (-0.5, 0.5) for y in (-0.5, 0.5)]
        add_contact(scene, name, on=on, place=(0.0, 0.0, height or 0.0), **{"points": corners, **feet})
    elif on is not None:
        foot = centre - rotation_matrix(turned) @ np.array([0.0, 0.0, 0.5 * edges[2]])
        axis = rotation_matrix(turned) @ np.array([0.0, 0.0, 1.0])
        seat = f"{name} on {on}"
        add_joint(scene, seat, kind="weld", first=on, second=name, point=foot, axis=axis)
        add_stop(scene, seat)


def _require_below(what: str, room: float, length: float | None) -> None:
    if length is not None:
        raise SceneError(f"{what}: has a length and on; its length is the one down to the deck: leave it out")
    if room <= 0.0:
        raise SceneError(
            f"{what}: the load and its slings would reach {-room:.4g} m above the tip; lower its place, or "
            "raise the tip"
        )


def _on_deck(scene: Description, what: str, body: str, height: float, tip: Array) -> tuple[Array, Any]:
    """Where the plane at a height over a body's origin is below the tip, m, and how that body is turned."""
    number_of(f"{what}: height", height)
    origin = place_of(scene, body=text_of(f"{what}: on", body))
    turned = UPRIGHT if body == GROUND else tuple(scene.bodies[body].quaternion)
    rotation = rotation_matrix(turned)
    along = np.linalg.solve(rotation[:2, :2], (tip - origin)[:2] - rotation[:2, 2] * height)
    return origin + rotation @ np.array([*along, height]), turned


def _heading(scene: Description, roles: CraneRoles) -> tuple[float, ...]:
    """That of the crane's base: a load is carried along the ship."""
    base = scene.joints[roles.slew[0]].first if roles.slew and roles.slew[0] in scene.joints else GROUND
    if base not in scene.bodies:
        return UPRIGHT
    w, x, y, z = map(float, scene.bodies[base].quaternion)
    yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return (math.cos(0.5 * yaw), 0.0, 0.0, math.sin(0.5 * yaw))


def _corners(rig: Slings, edges: Array) -> Array:
    """Points of the load that slings are tied to, in its coordinates, m."""
    if rig.points is not None:
        return np.asarray(rig.points, dtype=float)
    x, y, z = 0.5 * edges
    return np.array([[x, y, z], [x, -y, z], [-x, -y, z], [-x, y, z]])


def add_block(scene: Description, what: str, name: str, load: str, mass: float, rig: Slings | None) -> str:
    """Upright over the load: on its slings, or tied to its top."""
    block = f"{name} block"
    edge = (mass / BLOCK_DENSITY) ** (1.0 / 3.0)
    body = scene.bodies[load]
    at = place_of(scene, body=load, point=hung_from(scene, load))
    if rig is not None:
        if rig.points is None and not np.any(body.size):
            raise SceneError.of(
                f"{what}: slings", f"are tied to corners, and body {load!r} has no size; give points"
            )
        ends = _corners(rig, np.asarray(body.size, dtype=float))
        centre = np.asarray(body.position) + rotation_matrix(body.quaternion) @ ends.mean(axis=0)
        at = centre + np.array([0.0, 0.0, rig.height(ends)])
    add_body(
        scene, block, mass=mass, size=(edge, edge, edge), position=at, quaternion=body.quaternion,
        center_of_mass=(0.0, 0.0, 0.0),
    )  # fmt: skip
    if rig is None:
        add_joint(scene, f"{name} hook", kind="spherical", first=block, second=load, point=at)
    return block


def sling(scene: Description, name: str, block: str, load: str, rig: Slings, *, standing: bool) -> None:
    """Between block and load; each carries its share of the load from the start."""
    body = scene.bodies[load]
    ends = _corners(rig, np.asarray(body.size, dtype=float))
    hook = place_of(scene, body=block)
    spans = np.array([place_of(scene, body=load, point=end) for end in ends]) - hook
    lengths = np.linalg.norm(spans, axis=1)
    # Equal tensions per length carry the load where the hook is over its middle: sum T_i / l_i d_i = W.
    density = 0.0 if standing else scene.gravity * body.mass / float(-spans[:, 2].sum())
    for i, (end, length) in enumerate(zip(ends, lengths, strict=True), start=1):
        add_line(
            scene, f"{name} sling {i}", bodies=[block, load], points=[ORIGIN, end], EA=rig.EA,
            length=length / (1.0 + density * length / rig.EA), mass=body.mass / len(ends), rung=rig.rung,
            breaking_load=rig.breaking_load, safety_factor=rig.safety_factor,
        )  # fmt: skip
