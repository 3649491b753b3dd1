"""What hangs from a crane's tip: winch, line of n falls, block, slings and load, in one call."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.crane.parts import BOX_DRAG, SWING_RATIO
from seacrane.description.description import KINDS, Description
from seacrane.description.loads import changed
from seacrane.description.places import place_of
from seacrane.description.roles import CraneRoles
from seacrane.description.rungs import ELASTIC, QUASI_STATIC, RIGID, Rung
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, name_of, not_negative_of, positive_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.inputs.values import made_of
from seacrane.scene.hung_load import Slings, add_block, add_load_below, sling
from seacrane.scene.lift_factors import note_rating, rating_of
from seacrane.scene.line_fluid import Wire
from seacrane.scene.lines import add_line, hung_from
from seacrane.scene.recorded import add_point
from seacrane.scene.rigging import add_winch
from seacrane.scene.wind_current import damp_load

Place = tuple[str, Any]  # a body, and a point in its coordinates, m
FEET_KEYS = ("points", "stiffness", "damping", "table", "friction", "hold", "edge", "name")


def add_hoist(
    scene: Description, name: str = "hoist", *, crane: CraneRoles | str | None = None, load: str = "load",
    mass: float | None = None, size: ArrayLike | None = None, length: float | None = None,
    height: float | None = None, on: str | None = None, feet: Mapping[str, Any] | bool = False,
    slack: float = 0.0, falls: int = 1, EA: float | None = None, stiffness: float | None = None,
    rung: Rung = "elastic", wire: Wire | Mapping[str, Any] | None = None, block_mass: float = 0.0,
    slings: Slings | Mapping[str, Any] | None = None, winch: Mapping[str, Any] | bool = False,
    damping: bool = True, breaking_load: float | None = None, safety_factor: float | None = None,
) -> CraneRoles:  # fmt: skip
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
    stand, drive = _keywords_of(what, "feet", feet, FEET_KEYS), _keywords_of(what, "winch", winch)
    if stand is not None and on is None:
        raise SceneError(f"{what}: has feet and no deck; give on=, the body that they stand on")
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
            add_load_below(scene, what, roles, text_of(f"{what}: load", load), (mass, size), tip, rig,
                      (length, height, on), stand)  # fmt: skip
        elif not all(one is None for one in (mass, size, length, height, on)):
            raise SceneError(
                f"{what}: body {load!r} is there already; leave out mass, size, length, height and on"
            )
        hook: Place = (load, hung_from(scene, load))
        if block_mass > 0.0:
            hook = (add_block(scene, what, name, load, block_mass, rig), (0.0, 0.0, 0.0))
        weight = scene.gravity * (block_mass + (0.0 if on else scene.bodies[load].mass))
        _tie(scene, what, name, roles.tip, hook, falls, weight,
             {"EA": EA, "stiffness": stiffness}, rung, heavy, slack)  # fmt: skip
        if roles.structure is not None:
            spring = scene.springs[roles.structure]  # the crane stands as described under the weight
            rest = spring.natural_length - weight / spring.stiffness
            scene.springs[roles.structure] = changed(spring, natural_length=rest)
        note_rating(scene, rating_of(name, breaking_load, safety_factor))
        if drive is not None:
            named(add_winch, owners=1)(scene, name, **drive)
        if rig is not None:
            sling(scene, name, hook[0], load, rig, standing=on is not None)
        if flag_of(f"{what}: damping", damping):
            damp_load(scene, load, scene.bodies[load].size, roles.tip, ratio=SWING_RATIO, drag=BOX_DRAG)
        for label, (body, point) in {"tip": roles.tip, "hook": hook}.items():
            if f"{roles.prefix}{label}" not in scene.points:
                add_point(scene, f"{roles.prefix}{label}", body=body, point=point)
        link = name if rung == RIGID else None
        hung = replace(roles, payload=load, link=link, line=None if link else name)
        scene.roles[roles.prefix] = hung
    return hung


def _keywords_of(what: str, word: str, given: Any, known: Sequence[str] = ()) -> dict[str, Any] | None:
    """Of a call that a hoist makes, some of those known; None where it makes none."""
    if isinstance(given, bool):
        return {} if given else None
    if not isinstance(given, Mapping):
        raise SceneError.of(f"{what}: {word}", f"is {shown(given)}; give its keywords, or True")
    unknown = [key for key in given if known and key not in known]
    if unknown:
        raise SceneError.of(f"{what}: {word}", f"has {unknown[0]!r}; give some of {', '.join(known)}")
    return dict(given)


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
