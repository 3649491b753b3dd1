"""add_ballast(): what keeps a vessel at a heel and a trim, as one force or as the contents of tanks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.analysis.implausible import warn_of_capsize
from seacrane.analysis.inverse import drive_loads, hold_vessel, path_through, places_in, posed
from seacrane.analysis.rest_state import held, rest_from, rest_states
from seacrane.analysis.tanks import Tank, fills, tanks_of
from seacrane.analysis.weight_balance import weight_of
from seacrane.arrays import Array
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.elements import add_force
from seacrane.description.given import given_vessels
from seacrane.description.outline import ship_size
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, number_of
from seacrane.inputs.frames import heel_and_trim, rotation_matrix
from seacrane.plotting.table import Answer, Column, Table
from seacrane.warnings import BallastOutsideHullWarning

EXACT = 1e-9  # rad: heel and trim for which the moment that is left would account
MOST_ROUNDS = 30
LARGEST = np.radians(20.0)  # of a heel or trim that linear restoring tells
ATTITUDE = ("roll", "pitch")
BESIDE = 0.1  # of half the hull, by which a tank is outside
FAR = 1.0  # likewise of one force, which stands for weights on both sides


@dataclass(frozen=True, kw_only=True)
class Ballast(Answer):
    """What `Scene.add_ballast` added, and how the vessel rests with it.

    Attributes
    ----------
    heel, trim : float
        At which it rests, rad; positive lifts port, and lowers the bow.
    weight : float
        That it adds to the vessel, N; negative where it takes weight off.
    center : ndarray, shape (3,)
        Of one force without tanks, body coordinates, m; NaN with tanks.
    contents : mapping of str to float
        Of each tank then, kg.
    changes : mapping of str to float
        By how much that differs from what it held, kg.
    forces : tuple of PointForce
        The elements of the scene that stand for it.
    """

    vessel: str
    heel: float
    trim: float
    weight: float
    center: Array
    contents: Mapping[str, float] = field(default_factory=dict)
    changes: Mapping[str, float] = field(default_factory=dict)
    forces: tuple[_core.PointForce, ...] = ()

    def _shown(self) -> Table:
        told = (
            f"ballast of {self.vessel!r}: {self.weight / 1e3:.4g} kN for a heel of "
            f"{np.degrees(self.heel):.4g} deg and a trim of {np.degrees(self.trim):.4g} deg"
        )
        if not self.contents:
            told += f", at {self.center[0]:.4g}, {self.center[1]:.4g} m"
        both = (self.contents, self.changes)
        contents, changes = (np.array([each[name] for name in self.contents]) for each in both)
        return Table(
            axes=[Column(name="tank", values=list(self.contents))],
            columns=[
                Column(name="content", values=contents, unit="kg", read=("t", contents / 1e3)),
                Column(name="change", values=changes, unit="kg", read=("t", changes / 1e3), form="+.4g"),
            ],
            title=told,
        )


def add_ballast(
    scene: Description, *, vessel: str | None = None, heel_deg: float | None = 0.0,
    trim_deg: float | None = 0.0, tanks: Mapping[str, Tank] | None = None, name: str = "ballast",
) -> Ballast:  # fmt: skip
    """Add the ballast with which a vessel rests at a heel and a trim, in calm water and the pose described.

    Without tanks, one upward force carries the weight of all bodies on the vessel: ballast that was taken out
    for them, so that the draught stays. With tanks, water is moved, taken in or let out, as little as it
    takes; the draught follows. Either is a constant force: the mass of the water stays that of the database.
    With a heel or trim that is not zero, start runs from `seacrane.equilibrium`.

    Parameters
    ----------
    vessel : str, optional
        Default: the only one.
    heel_deg, trim_deg : float or None
        deg; a positive heel lifts port, a positive trim lowers the bow. None ("left" in lift files): as it
        comes, as with two wing tanks, which make no trim; the answer tells it.
    tanks : mapping of str to Tank, optional
    name : str
        Of the point force; with tanks, of one for each as "<name> <tank>".

    Raises
    ------
    SceneError
        Where tanks do not suffice, naming the one that would overflow or run dry; where nothing is carried
        and there are no tanks; or where the scene does not come to rest.

    Warns
    -----
    BallastOutsideHullWarning
        For ballast that would be outside the ship.
    UnstableRestWarning
        Where the weights on the vessel outweigh its restoring.
    """
    hull = _vessel(scene, vessel)
    target = _target(heel_deg=heel_deg, trim_deg=trim_deg)
    name = name_of("ballast", name)
    kind = _Force(scene, hull, target) if tanks is None else _Tanks(scene, hull, target, tanks_of(tanks))
    found, attitude = _fitted(scene, hull, target, kind)
    forces: tuple[Any, ...] = tuple(
        add_force(scene, hull.body, name=f"{name} {key}".rstrip(), point=point, force=(0.0, 0.0, force))
        for key, (point, force) in kind.forces(found).items()
    )
    heel, trim = (float(target.get(motion, attitude[motion])) for motion in ATTITUDE)
    told = Ballast(vessel=hull.body, heel=heel, trim=trim, forces=forces, **kind.told(found))
    places: dict[str, Any] = {"the force": told.center}
    if tanks is not None:
        places = {f"tank {key!r}": tank.point for key, tank in tanks.items()}
    _warn_of_places(scene.bodies[hull.body], places, FAR if tanks is None else BESIDE)
    warn_of_capsize(scene)
    return told


def _warn_of_places(hull: _core.Body, places: Mapping[str, Any], margin: float) -> None:
    """Warn of ballast outside the hull that radii of gyration suggest."""
    half = 0.5 * np.array(ship_size(hull))
    for what, place in places.items():
        beyond = np.abs(np.asarray(place, dtype=float)[:2]) - half
        if np.any(beyond > margin * half):
            warn_caller(
                f"ballast of {hull.name!r}: {what} is at {place[0]:.4g} m forward and {place[1]:.4g} m to "
                f"port, {float(beyond.max()):.3g} m outside a hull of about {2 * half[0]:.0f} x "
                f"{2 * half[1]:.0f} m: no tank is there. Give tanks within the hull, or ask for less heel or "
                "trim",
                BallastOutsideHullWarning,
            )
            return


def _vessel(scene: Description, name: str | None) -> _core.VesselHydrodynamics:
    if (name or "vessel") in given_vessels(scene):
        raise SceneError(
            f"ballast: the motion of {name or 'vessel'!r} is given: it needs no ballast, leave it out"
        )
    floating = {vessel.body: vessel for vessel in scene.vessels.values() if vessel.floats}
    known = ", ".join(map(repr, floating)) or "none"
    if name is None and len(floating) != 1:
        raise SceneError(f"ballast: the vessels are {known}; name one as vessel")
    if name is not None and name not in floating:
        raise SceneError(f"ballast: vessel {name!r} is no vessel; the vessels are {known}")
    return floating[name] if name is not None else next(iter(floating.values()))


def _target(**given: Any) -> dict[str, float]:
    """rad, by the motions that are asked for."""
    found = {}
    for motion, (key, value) in zip(ATTITUDE, given.items(), strict=True):
        angle = 0.0 if value is None else number_of(f"ballast: {key}", value)
        if not abs(angle) <= np.degrees(LARGEST):
            raise SceneError.of(
                f"ballast: {key}",
                f"is {angle:g}; give an angle within {np.degrees(LARGEST):.0f} deg, as far as "
                "linear restoring holds",
            )
        if value is not None:
            found[motion] = float(np.radians(angle))
    if not found:
        raise SceneError("ballast: heel_deg and trim_deg are None; ask for one of them")
    return found


def _asked(target: Mapping[str, float]) -> list[int]:
    return [ATTITUDE.index(motion) for motion in target]


class _Force:
    """One upward force: the unknowns are its place, x and y."""

    def __init__(
        self, scene: Description, vessel: _core.VesselHydrodynamics, target: Mapping[str, float]
    ) -> None:
        self.weight, center = weight_of(scene)
        if self.weight == 0.0:
            raise SceneError(
                f"ballast: vessel {vessel.name!r} carries no body, so that one force has no size; give tanks"
            )
        hull = scene.bodies[vessel.body]
        self.first = rotation_matrix(hull.quaternion).T @ (center - hull.position)
        self.moments = self.weight * np.array([[0.0, 1.0], [-1.0, 0.0]])[_asked(target)]

    def solve(self, needed: Array) -> Array:
        left = needed - self.moments @ self.start()
        return np.asarray(self.start() + np.linalg.pinv(self.moments) @ left, dtype=np.float64)

    def start(self) -> Array:
        return np.asarray(self.first[:2])

    def forces(self, found: Array) -> dict[str, tuple[Any, float]]:
        return {"": ((float(found[0]), float(found[1]), 0.0), self.weight)}

    def told(self, found: Array) -> dict[str, Any]:
        return {"weight": -self.weight, "center": np.array([found[0], found[1], 0.0])}


class _Tanks:
    """The contents of tanks: the unknowns are their changes, kg."""

    def __init__(
        self,
        scene: Description,
        vessel: _core.VesselHydrodynamics,
        target: Mapping[str, float],
        tanks: Mapping[str, Tank],
    ) -> None:
        self.tanks, self.gravity = tanks, scene.gravity
        turned = np.array([target.get(motion, 0.0) for motion in ATTITUDE])
        of_each = np.array([self._moments(vessel, turned, one) for one in tanks.values()])
        self.moments = of_each.T[_asked(target)]

    def _moments(self, vessel: _core.VesselHydrodynamics, target: Array, tank: Tank) -> Array:
        """About the roll and the pitch axis, of 1 kg: its weight, and the hull that it sinks deeper."""
        (cr, cp), (sr, sp) = np.cos(target), np.sin(target)
        turn = np.array([[cp, sp * sr, sp * cr], [0.0, cr, -sr], [-sp, cp * sr, cp * cr]])
        moment = np.cross(turn @ np.asarray(tank.point), [0.0, 0.0, -self.gravity])
        restoring = np.asarray(vessel.restoring)
        sinks = -self.gravity / restoring[2, 2] if restoring[2, 2] > 0.0 else 0.0
        return np.array([moment @ turn[:, 0], moment[1]]) - restoring[3:5, 2] * sinks

    def solve(self, needed: Array) -> Array:
        return fills(self.tanks, self.moments, needed)

    def start(self) -> Array:
        return np.zeros(len(self.tanks))

    def forces(self, found: Array) -> dict[str, tuple[Any, float]]:
        changes = zip(self.tanks.items(), found, strict=True)
        return {name: (tank.point, -float(kg) * self.gravity) for (name, tank), kg in changes}

    def told(self, found: Array) -> dict[str, Any]:
        changes = dict(zip(self.tanks, found.tolist(), strict=True))
        contents = {name: tank.content + changes[name] for name, tank in self.tanks.items()}
        weight = float(np.sum(found)) * self.gravity
        return {"weight": weight, "center": np.full(3, np.nan), "contents": contents, "changes": changes}


def _fitted(
    scene: Description, vessel: _core.VesselHydrodynamics, target: Mapping[str, float], kind: _Force | _Tanks
) -> tuple[Array, dict[str, float]]:
    """The unknowns with which no moment is left at the target, and roll and pitch there, by a chord method.

    Each rest begins at the one before: a load that may rest in two ways stays in one.
    """
    restoring = np.diag(vessel.restoring)[3:5][_asked(target)]
    found, rest = kind.start(), None
    for _ in range(MOST_ROUNDS):
        left, rest, attitude = _moments_left(scene, vessel, target, kind.forces(found), rest)
        if np.all(np.abs(left) <= EXACT * restoring):
            return found, attitude
        found = kind.solve(kind.moments @ found + left)
    moments = " and ".join(
        f"{size:.3g} N m about {motion}" for size, motion in zip(left, target, strict=True)
    )
    raise SceneError.of(
        f"ballast: {moments}", "are left at the heel and trim asked for; ask for smaller angles"
    )


def _moments_left(
    scene: Description, vessel: _core.VesselHydrodynamics, target: Mapping[str, float],
    forces: Mapping[str, tuple[Any, float]], near: _core.State | None,
) -> tuple[Array, _core.State, dict[str, float]]:  # fmt: skip
    """What drives in these motions still carry at rest at the target, N m; that rest; its attitude."""
    out = posed(scene.copy(orientation="quaternion"), places_in(scene), {})
    for i, (point, force) in enumerate(forces.values()):
        add_force(out, vessel.body, name=f"trial ballast {i}", point=point, force=(0.0, 0.0, force))
    angles = {motion: ("", "angle") for motion in target}
    path, times = path_through(angles, [target])
    hold_vessel(out, vessel.body, path)
    state = next(rest_states(out, times=times.tolist())) if near is None else rest_from(out, near)
    model = compile_scene(held(out, time=state.time))
    names = [f"{vessel.body}.motion.{motion}" for motion in target]
    at = model.pose_index(list(model.bodies).index(vessel.body))
    attitude = dict(zip(ATTITUDE, heel_and_trim(np.asarray(state.values)[at + 3 : at + 7]), strict=True))
    return drive_loads(model, names, state.time, np.array(state.values)), state, attitude
