"""Deck cargo: accelerations in deck axes with gravity's tilt, and what each fastening carries."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane.answers.fatigue import hides_peaks
from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import is_finite, name_of, positive_of, rows_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.inputs.values import listed_of
from seacrane.one_thread import one_thread
from seacrane.plotting.table import Answer, Column, Table
from seacrane.result import Result
from seacrane.warnings import MassUnitWarning

AXES = ("x", "y", "z")
STILL = 0.02  # rad, by which what stands on a deck may turn against it
LIGHTEST = 2.0  # kg/m3 within the fastenings, twice as high as the centre: of tonnes taken for kg


@named
@dataclass(frozen=True, kw_only=True)
class Cargo:
    """What stands on a deck.

    Attributes
    ----------
    point : str
        A named point of the scene, fixed to the deck: its centre of gravity.
    mass : float
        kg.
    fastenings : array_like, shape (n, 3)
        Where it is held, supports included, from its centre of gravity, in deck axes, m.
    stiffness : array_like, shape (n, 3), optional
        Of each along the deck's axes, in any unit: what share it takes, 0 for none. Default: all alike.

    Raises
    ------
    SceneError
        For values that make no sense, or fastenings that do not hold it.
    """

    point: str
    mass: float
    fastenings: Any = ()
    stiffness: Any = None

    def __post_init__(self) -> None:
        title = f"cargo {name_of('cargo', self.point)!r}"
        positive_of(f"{title}: mass", self.mass, "kg")
        places = np.reshape(rows_of(f"{title}: fastenings", self.fastenings, 3), (-1, 3))
        if not is_finite(places):
            raise SceneError(f"{title}: fastenings is {shown(self.fastenings)}; give finite numbers")
        shares = np.ones_like(places)
        if self.stiffness is not None:
            shares = np.reshape(rows_of(f"{title}: stiffness", self.stiffness, 3), (-1, 3))
        if shares.shape != places.shape or not (is_finite(shares) and np.all(shares >= 0.0)):
            raise SceneError(
                f"{title}: stiffness is {shown(self.stiffness)}; give three of zero or more, finite, for each"
            )
        object.__setattr__(self, "fastenings", places)
        object.__setattr__(self, "stiffness", shares)
        if len(places) and np.linalg.matrix_rank(self._arms * np.sqrt(shares.ravel())) < 6:
            raise SceneError(f"{title}: its fastenings let it move; give three or more that hold it")
        sides = np.ptp(places[:, :2], axis=0) if len(places) else np.zeros(2)
        within = 2.0 * abs(places[:, 2].min(initial=0.0)) * float(np.prod(sides))
        if self.mass < LIGHTEST * within:
            told = f"mass is {self.mass:g} kg within fastenings about {within:.3g} m3, as light as air"
            warn_caller(f"{title}: {told}; if these are tonnes, give {1e3 * self.mass:g}", MassUnitWarning)

    @property
    def _arms(self) -> Array:
        """From the forces of all fastenings to force and moment about the centre of gravity, (6, 3 n)."""
        found = np.zeros((6, len(self.fastenings), 3))
        found[:3] = np.eye(3)[:, None, :]
        for axis in range(3):
            found[3:, :, axis] = np.cross(self.fastenings, np.eye(3)[axis]).T
        return found.reshape(6, -1)

    @one_thread
    def forces(self, accelerations: Array) -> Array:
        """Of each fastening on the cargo, N, (k, n, 3), for accelerations (k, 3) in deck axes with gravity.

        Those of springs between a rigid cargo and a rigid deck.
        """
        arms, k = self._arms, self.stiffness.ravel()
        if not k.size:
            return np.zeros((len(accelerations), 0, 3))
        moved = np.linalg.solve((arms * k) @ arms.T, np.pad(self.mass * accelerations, ((0, 0), (0, 3))).T)
        return np.asarray((k[:, None] * (arms.T @ moved)).T.reshape(len(accelerations), -1, 3))


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class DeckCargo(Answer):
    """Accelerations and forces of deck cargo. Made by `deck_cargo`; prints as a table.

    Attributes
    ----------
    time : ndarray, shape (k,)
    accelerations : dict of str to ndarray, shape (k, 3)
        By cargo, in deck axes, m/s2: what the deck and the fastenings give it for each kg. At rest on an even
        keel it is (0, 0, g).
    forces : dict of str to ndarray, shape (k, n, 3)
        Of its fastenings on it, N.
    coarse : tuple of str
        Cargo whose accelerations have peaks between the outputs: extremes are too small.
    """

    time: Array
    accelerations: dict[str, Array]
    forces: dict[str, Array]
    coarse: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<DeckCargo: {', '.join(self.accelerations)}>"

    def together(self, cargo: str) -> Array:
        """Largest and least of x, y and z with what occurs beside each: (6, 4), time and components."""
        values = self.accelerations[cargo]
        at = [find(values[:, axis]) for axis in range(3) for find in (np.argmax, np.argmin)]
        return np.column_stack([self.time[at], values[at]])

    def _shown(self) -> Table:
        names = [f"{end} {axis}" for axis in AXES for end in ("largest", "least")]
        every = np.array([self.together(cargo) for cargo in self.accelerations])
        columns = [
            Column(name="time", values=every[..., 0], unit="s", form=".2f"),
            *(Column(name=f"a_{axis}", values=every[..., 1 + i], unit="m/s2", form=".3f")
              for i, axis in enumerate(AXES)),
        ]  # fmt: skip
        axes = [Column(name="cargo", values=list(self.accelerations)), Column(name="extreme", values=names)]
        remarks = [
            "Along the deck's axes; gravity is in it, once: at rest on an even keel z is g.",
            f"Of {np.ptp(self.time):g} s of one run: a longer one has larger extremes.",
        ]
        if self.coarse:
            remarks.append(f"Peaks between the outputs: {', '.join(self.coarse)}; shorten dt_out.")
        return Table(
            axes=axes, columns=columns, title="Deck cargo: extremes, and what occurs together",
            remarks=remarks, below=self._held(),
        )  # fmt: skip

    def _held(self) -> list[Table]:
        """Largest and least force of each fastening along each axis."""
        names = [f"{cargo} {i + 1}" for cargo, forces in self.forces.items() for i in range(forces.shape[1])]
        if not names:
            return []
        ends = np.array([
            find(forces[:, i], axis=0)
            for forces in self.forces.values() for i in range(forces.shape[1]) for find in (np.max, np.min)
        ]).reshape(-1, 2, 3)  # fmt: skip
        columns = [
            Column(name=f"{end}_{axis}", head=f"{end} {axis}", values=ends[:, j, i], unit="N")
            for i, axis in enumerate(AXES) for j, end in enumerate(("largest", "least"))
        ]  # fmt: skip
        return [Table(
            axes=[Column(name="fastening", values=names)], columns=columns,
            title="Forces of the fastenings on the cargo",
            remarks=["Supports push upwards; what pulls down is a z below zero."],
        )]  # fmt: skip


@named
def deck_cargo(
    result: Result, *, cargo: Sequence[Cargo], deck: str | None = None, after: float = 0.0
) -> DeckCargo:
    """Accelerations of deck cargo in deck axes with gravity's tilt, and forces of its fastenings.

    Parameters
    ----------
    result : Result
        With the channels "point_acceleration" and "quaternion".
    cargo : sequence of Cargo
    deck : str, optional
        The body on which it stands; default: that of the points.
    after : float
        s: earlier outputs are left out.

    Raises
    ------
    SceneError
        For a channel, body or point that is not there, cargo at one point twice, or no output after.
    """
    listed = listed_of("deck_cargo: cargo", Cargo, cargo, by="point")
    scene = result.scene
    if deck is None:
        bodies = {scene.points[one.point].body for one in listed if scene and one.point in scene.points}
        if len(bodies) > 1:
            raise SceneError(f"deck_cargo: cargo stands on {', '.join(sorted(bodies))}; ask for each alone")
        deck = bodies.pop() if bodies else "vessel"
    for channel in ("point_acceleration", "quaternion"):
        if channel not in result:
            raise SceneError(f'deck_cargo: the result has no channel "{channel}"; record it')
    part = result.part(after=after)
    if part.start == part.stop:
        raise SceneError(f"deck_cargo: after is {after} s, past the last output, {result.time[-1]:g} s")
    up = np.array([0.0, 0.0, 9.80665 if scene is None else scene.gravity])
    try:
        turned = rotation_matrix(result.select("quaternion", body=deck)[part])
        moved = {one.point: result.select("point_acceleration", point=one.point)[part] for one in listed}
    except ValueError as error:
        raise SceneError(f"deck_cargo: {error}") from error
    for one in listed:
        body = deck if scene is None else scene.points[one.point].body
        along = np.swapaxes(turned, 1, 2) @ rotation_matrix(result.select("quaternion", body=body)[part])
        if np.ptp(along, axis=0).max() > STILL:
            raise SceneError(f"deck_cargo: {one.point!r} is on {body}, which turns on {deck}; give its deck")
    felt = {name: np.einsum("kji,kj->ki", turned, values + up) for name, values in moved.items()}
    forces = {one.point: one.forces(felt[one.point]) for one in listed}
    coarse = []
    for name, values in moved.items():
        least, largest = result.reached("point_acceleration", part=part, point=name)
        along_axes = zip(values.T, least.T, largest.T, strict=True)
        coarse += [name] * any(hides_peaks(*one) for one in along_axes)
    return DeckCargo(
        time=np.asarray(result.time)[part], accelerations=felt, forces=forces, coarse=tuple(coarse)
    )
