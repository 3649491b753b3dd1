"""What hangs from a crane's tip: winch, line of n falls, block, slings and load, in one call."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.crane.parts import BOX_DRAG, SWING_RATIO
from seacrane.description.description import GROUND, KINDS, Description
from seacrane.description.elements import add_joint
from seacrane.description.loads import changed
from seacrane.description.places import ORIGIN, place_of
from seacrane.description.roles import CraneRoles
from seacrane.description.rungs import ELASTIC, QUASI_STATIC, RIGID, Rung, StretchingRung
from seacrane.errors import SceneError
from seacrane.inputs.checked import (
    flag_of,
    name_of,
    not_negative_of,
    number_of,
    positive_of,
    shaped_of,
    text_of,
)
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.inputs.plausible import warn_of_density
from seacrane.inputs.shown import shown
from seacrane.inputs.values import made_of
from seacrane.scene.bodies import add_body
from seacrane.scene.lift_factors import note_rating, rating_of
from seacrane.scene.limits import add_contact, add_stop
from seacrane.scene.line_fluid import Wire
from seacrane.scene.lines import add_line, hung_from
from seacrane.scene.recorded import add_point
from seacrane.scene.rigging import add_winch
from seacrane.scene.wind_current import damp_load

Array = NDArray[np.float64]
BLOCK_DENSITY = 2000.0  # kg/m3 over its outline: plates, sheaves and gaps; gives a block its size alone
UPRIGHT = (1.0, 0.0, 0.0, 0.0)
Place = tuple[str, Any]  # a body, and a point in its coordinates, m
FEET_KEYS = ("points", "stiffness", "damping", "table", "friction", "hold", "edge", "name")


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


def add_hoist(
    scene: Description,
    name: str = "hoist",
    *,
    crane: CraneRoles | str | None = None,
    load: str = "load",
    mass: float | None = None,
    size: ArrayLike | None = None,
    length: float | None = None,
    height: float | None = None,
    on: str | None = None,
    feet: Mapping[str, Any] | bool = False,
    slack: float = 0.0,
    falls: int = 1,
    EA: float | None = None,
    stiffness: float | None = None,
    rung: Rung = "elastic",
    wire: Wire | Mapping[str, Any] | None = None,
    block_mass: float = 0.0,
    slings: Slings | Mapping[str, Any] | None = None,
    winch: Mapping[str, Any] | bool = False,
    damping: bool = True,
    breaking_load: float | None = None,
    safety_factor: float | None = None,
) -> CraneRoles:
    """Hang a load on a line from a crane's tip: line of n falls, block, slings, winch and load, at rest.

    The load hangs straight below the tip as described, upright; its line carries its weight from the start.
    It may stand on a deck instead, its line just straight, with the block's weight alone: on a seat, a weld
    that holds until it is lifted off, or on feet. The paper's rod, which pushes too, is a `Payload` of
    `add_crane`.

    Parameters
    ----------
    name : str
        Of the line; its winch has inputs and states by this name, such as "hoist.rate".
    crane : CraneRoles or str, optional
        What `add_crane` returned, or the prefix of its names. Default: the scene's only crane.
    load : str
        Name of the body that is made, or of one that is there already: that stays where it is described.
    mass : float
        Of the load that is made, kg.
    size : array_like, shape (3,)
        Its edges along body x, y, z, m: a uniform box, whose inertia follows.
    length : float, optional
        From the tip down to the block, or to the top of the load where there is none, m. Default: 8.
    height : float, optional
        In its place, of the load's underside over z = 0 of the inertial frame; with `on`, over the origin of
        that body, m.
    on : str, optional
        Body on whose deck the load stands, below the tip; "ground" is one too.
    feet : mapping or bool
        In place of the seat, on a deck that moves: a contact, on which the load may slide and come down
        again. Keywords of `add_contact`, such as ``{"friction": 0.4}``, or True for its defaults; `points`
        are by default the four lower corners of the load's size.
    slack : float
        Of the line to a load on a deck, m of each fall: for an elastic line without a block.
    falls : int
        Between tip and block; the line runs over them without friction.
    EA : float
        Axial stiffness of the rope, N.
    stiffness : float
        In its place, of all falls together at the hook as described, N/m.
    rung : {"rigid", "quasi-static", "elastic", "auto"}
        Of the line, as in `add_line`. "rigid" takes no EA and no winch, and has one fall.
    wire : Wire or mapping, optional
        Of a line with mass, which has one fall too, as in `add_line`, such as ``{"mass_per_length": 25,
        "segments": 10, "medium": "sea", "diameter": 0.06}``.
    block_mass : float
        Hook block, kg; slings need one.
    slings : Slings or mapping, optional
        From block to load, such as ``{"angle_deg": 60, "EA": 5e7}``. Default: the line, or the block, is tied
        to the top of the load.
    winch : mapping or bool
        Keywords of `add_winch`, or True for one without bounds. Default: none.
    damping : bool
        Whether the load has the small damping of a `Payload`: of its swing, and drag in still air.
    breaking_load, safety_factor : float, optional
        Of the rope, as in `add_line`: of one fall.

    Returns
    -------
    CraneRoles
        Of the crane: they know the line, the load and the tip from now on. The points "tip" and "hook", after
        the crane's prefix, are recorded.

    Raises
    ------
    SceneError
        For no crane, one without a tip or with a load; fewer than one fall; slings that are too short; a
        place above the tip; slack of a line that a weight keeps taut; and what `add_line` and `add_winch`
        refuse.

    Warns
    -----
    MassUnitWarning
        Lighter than foam: tonnes given for kg.
    """
    what = f"hoist {name_of('hoist', name)!r}"
    roles = _crane(scene, what, crane)
    if not isinstance(falls, int) or isinstance(falls, bool) or falls < 1:
        raise SceneError.of(f"{what}: falls", f"is {shown(falls)}; give a whole number from 1 on")
    if falls > 1 and (rung == RIGID or wire is not None):
        raise SceneError(f"{what}: a rigid line or one with mass has one fall, and falls is {falls}")
    if not_negative_of(f"{what}: slack", slack) and (
        on is None or block_mass > 0.0 or rung != ELASTIC or wire
    ):
        raise SceneError.of(
            f"{what}: slack",
            f"is {slack:g} m, and a line is slack by its length where it is elastic and has no "
            "block, and its load stands on a deck; leave slack out, or give on= and rung 'elastic'",
        )
    stand, drive = _keywords_of(what, "feet", feet), _keywords_of(what, "winch", winch)
    if stand is not None and on is None:
        raise SceneError(f"{what}: has feet and no deck; give on=, the body that they stand on")
    _require_keys(what, "feet", stand, FEET_KEYS)
    heavy = None if wire is None else made_of(what, "wire", Wire, wire)
    if (rung == QUASI_STATIC or heavy) and drive is not None and not drive.get("lag"):
        raise SceneError(
            f"{what}: its line needs a smooth length, and its winch has no lag; give one, such as "
            "winch={\"lag\": 0.1}, or rung 'elastic'"
        )
    rig = None if slings is None else made_of(what, "slings", Slings, slings)
    not_negative_of(f"{what}: block_mass", block_mass)
    if rig is not None and block_mass == 0.0:
        raise SceneError(f"{what}: slings hang on a block, and block_mass is 0; give its mass in kg")
    with _whole_or_nothing(scene):
        assert roles.tip is not None
        tip = place_of(scene, body=roles.tip[0], point=roles.tip[1])
        new = load not in scene.bodies
        if new:
            _add_load(scene, what, roles, text_of(f"{what}: load", load), (mass, size), tip, rig,
                      (length, height, on), stand)  # fmt: skip
        elif not all(one is None for one in (mass, size, length, height, on)):
            raise SceneError(
                f"{what}: body {load!r} is there already; leave out mass, size, length, height and on"
            )
        hook: Place = (load, hung_from(scene, load))
        if block_mass > 0.0:
            hook = (_add_block(scene, what, name, load, block_mass, rig), (0.0, 0.0, 0.0))
        weight = scene.gravity * (block_mass + (0.0 if on else scene.bodies[load].mass))
        _tie(scene, what, name, roles.tip, hook, falls, weight,
             {"EA": EA, "stiffness": stiffness}, rung, heavy, slack)  # fmt: skip
        if roles.structure is not None:
            _preload(scene, roles.structure, weight)
        note_rating(scene, rating_of(name, breaking_load, safety_factor))
        if drive is not None:
            named(add_winch, owners=1)(scene, name, **drive)
        if rig is not None:
            _sling(scene, name, hook[0], load, rig, standing=on is not None)
        if flag_of(f"{what}: damping", damping):
            damp_load(scene, load, scene.bodies[load].size, roles.tip, ratio=SWING_RATIO, drag=BOX_DRAG)
        for label, (body, point) in {"tip": roles.tip, "hook": hook}.items():
            if f"{roles.prefix}{label}" not in scene.points:
                add_point(scene, f"{roles.prefix}{label}", body=body, point=point)
        link = name if rung == RIGID else None
        hung = replace(roles, payload=load, link=link, line=None if link else name)
        scene.roles[roles.prefix] = hung
    return hung


def _keywords_of(what: str, word: str, given: Any) -> dict[str, Any] | None:
    """Of a call that a hoist makes; None where it makes none."""
    if isinstance(given, bool):
        return {} if given else None
    if not isinstance(given, Mapping):
        raise SceneError.of(f"{what}: {word}", f"is {shown(given)}; give its keywords, or True")
    return dict(given)


def _require_keys(what: str, word: str, given: Mapping[str, Any] | None, known: Iterable[str]) -> None:
    unknown = [key for key in given or () if key not in known]
    if unknown:
        raise SceneError.of(f"{what}: {word}", f"has {unknown[0]!r}; give some of {', '.join(known)}")


def _crane(scene: Description, what: str, crane: CraneRoles | str | None) -> CraneRoles:
    """The crane that is meant, which has a tip and nothing on it yet."""
    known = ", ".join(map(repr, scene.roles)) or "none: add_crane first"
    if crane is None and len(scene.roles) != 1:
        raise SceneError(f"{what}: its crane is not said, and the prefixes of the scene's cranes are {known}")
    prefix = (
        crane.prefix if isinstance(crane, CraneRoles) else next(iter(scene.roles)) if crane is None else crane
    )
    if prefix not in scene.roles:
        raise SceneError.of(
            f"{what}: crane", f"is {shown(prefix)}; the prefixes of the scene's cranes are {known}"
        )
    roles = scene.roles[prefix]
    if roles.tip is None:
        raise SceneError(f"{what}: crane {prefix!r} has no tip; give it one by add_roles")
    if roles.payload is None:
        return roles
    which = f"crane {prefix!r}" if prefix else "the crane"
    fix = "give this one to another crane. A cell that is run twice adds it twice: run it from Scene() on"
    if roles.line is None and f"{prefix}hook" not in scene.points:  # no hoist, but a Payload
        fix = "add the crane without payload"
    raise SceneError(f"{what}: body {roles.payload!r} hangs on {which} already; {fix}")


@contextmanager
def _whole_or_nothing(scene: Description) -> Iterator[None]:
    """A hoist that is refused leaves the scene as it was."""
    before = {key: dict(getattr(scene, key)) for key in KINDS}
    try:
        yield
    except BaseException:
        for key, held in before.items():
            table = getattr(scene, key)
            table.clear()
            table.update(held)
        raise


def _add_load(
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


def _add_block(scene: Description, what: str, name: str, load: str, mass: float, rig: Slings | None) -> str:
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


def _tie(
    scene: Description, what: str, name: str, tip: Place, hook: Place, falls: int, weight: float,
    given: Mapping[str, float | None], rung: Rung, wire: Wire | None, slack: float,
) -> None:  # fmt: skip
    """The line over its falls, which carries a weight (N) from the start, or is slack."""
    ends = [tip, hook]
    path = [ends[i % 2] for i in range(falls + 1)]
    bodies, points = [body for body, _ in path], [point for _, point in path]
    if rung == RIGID:
        if any(value is not None for value in given.values()):
            raise SceneError(f"{what}: rung 'rigid' has no stretch; leave out EA and stiffness")
        add_line(scene, name, bodies=bodies, points=points, rung=rung)
        return
    drop = float(np.linalg.norm(np.subtract(*(place_of(scene, body=body, point=at) for body, at in ends))))
    if (given["EA"] is None) == (given["stiffness"] is None):
        raise SceneError(
            f"{what}: give the EA of its rope (N) or the stiffness at the hook (N/m), one of them"
        )
    axial = given["EA"]
    if axial is None:
        axial = positive_of(f"{what}: stiffness", given["stiffness"]) * drop / falls
    pull = weight / falls
    if wire is not None:
        own = not_negative_of(f"{what}: mass_per_length", wire.mass_per_length) * scene.gravity * drop
        length = drop / (1.0 + (pull + 0.5 * own) / positive_of(f"{what}: EA", axial))
        add_line(scene, name, bodies=bodies, points=points, rung=rung, EA=axial, length=length, wire=wire)
        return
    add_line(
        scene, name, bodies=bodies, points=points, rung=rung, EA=axial,
        length=falls * (drop + slack) if slack else None, tension_at_start=None if slack else pull,
    )  # fmt: skip


def _sling(scene: Description, name: str, block: str, load: str, rig: Slings, *, standing: bool) -> None:
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


def _preload(scene: Description, structure: str, weight: float) -> None:
    """The crane stands as described under a weight at its tip, N."""
    spring = scene.springs[structure]
    length = spring.natural_length - weight / spring.stiffness
    scene.springs[structure] = changed(spring, natural_length=length)
