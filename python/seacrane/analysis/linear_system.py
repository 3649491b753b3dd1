"""A scene linearised about a state at rest: x' = A x + B f in minimal coordinates, memory states included."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from seacrane import _core
from seacrane.analysis.frequency_memory import (
    FrequencyMemory,
    Resolvent,
    block_diagonal,
    frequency_memories,
    state_without_memory,
    without_memory,
)
from seacrane.analysis.line_dynamics import with_lengths_of
from seacrane.analysis.reduced_coordinates import NEUTRAL, ReducedCoordinates, Terms, at_rest
from seacrane.analysis.rest_state import equilibrium, held, state_values
from seacrane.arrays import Array, Complex
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.loads import lines_of
from seacrane.errors import SceneError
from seacrane.inputs.brief import brief
from seacrane.inputs.checked import shaped_of
from seacrane.inputs.frames import rotation_about_z, rotation_matrix
from seacrane.inputs.keywords import named
from seacrane.one_thread import one_thread

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

REST = 1e-6  # m/s2, m/s and the like: what may be left of motion at a state that is given
CORRECTIONS = 4  # of the lengths of lines: each squares what is left


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearModel:
    """x' = a x + b f, with x = (coordinates, speeds, memory states) of small motions about rest.

    A displacement of all bodies is ``basis @ coordinates``: per body a translation (m) of its state point
    (the centre of mass; the reference point of a vessel) and a rotation vector (rad), inertial axes.

    Attributes
    ----------
    scene : As described (its waves and references included).
    state : At rest; the time is that of the held references.
    vessel : Body on which the waves act, or None.
    a : (n, n), n = 2 degrees of freedom + memory states; 1/s.
    b : ndarray, shape (n, 6)
        Per wave load on the vessel about its origin, in axes that follow its yaw; N and N m.
    basis : (6 bodies, degrees of freedom), orthonormal.
    mass : ndarray, shape (6 bodies, 6 bodies)
        Of all bodies about their state points, added mass at infinite frequency included; kg, kg m2.
    neutral : ndarray, shape (degrees of freedom, k)
        Directions in which nothing brings the system back.
    memories : tuple of FrequencyMemory
        Memory that depends on the frequency and is in `response`, not in `a`: that of convolutions, or of a
        database. `at_frequency` puts its matrices of one frequency into `a`.
    drag_damping : mapping of str to ndarray, shape (3, 3)
        N s/m of what is in water, inertial axes, as `drag_in_sea` put it into `a`; empty without.
    """

    scene: Description
    state: _core.State
    bodies: tuple[str, ...]
    vessel: str | None
    a: Array
    b: Array
    basis: Array
    mass: Array
    neutral: Array
    memories: tuple[FrequencyMemory, ...]
    _terms: Terms
    drag_damping: Mapping[str, Array] = field(default_factory=dict)

    __repr__ = brief

    @property
    def model(self) -> _core.Model:
        """Of the scene with its references held."""
        return self._terms.model

    @property
    def degrees_of_freedom(self) -> int:
        """Number of coordinates."""
        return int(self.basis.shape[1])

    @property
    def memory_states(self) -> int:
        """Number of memory states."""
        return int(len(self.a) - 2 * self.degrees_of_freedom)

    @property
    def speed(self) -> float:
        """Forward speed (m/s) of the matrices in `memories` of the vessel on which the waves act."""
        return next((each.speed for each in self.memories if each.body == self.vessel), 0.0)

    def output(self, *, body: str, point: ArrayLike = (0.0, 0.0, 0.0)) -> Array:
        """C (6, n): translation (m) of a point of a body and rotation vector (rad) of the body from x.

        Parameters
        ----------
        point : array_like, shape (3,)
            Body coordinates, from the body origin, m.

        Returns
        -------
        ndarray, shape (6, n)
            Inertial axes.

        Raises
        ------
        SceneError
            For a body that does not exist, or a point that is not three finite numbers.
        """
        if body not in self.bodies:
            raise SceneError(f"body {body!r} does not exist; this scene has {', '.join(self.bodies)}")
        place = shaped_of(f"body {body!r}: point", point, (3,))
        if not np.all(np.isfinite(place)):
            raise SceneError(f"body {body!r}: point is {place.tolist()}; give finite numbers")
        k = self.bodies.index(body)
        rows = self.basis[6 * k : 6 * k + 6]
        floating = {vessel.body for vessel in self.scene.vessels.values()}
        start = np.zeros(3) if body in floating else np.asarray(self.scene.bodies[body].center_of_mass)
        at = self.model.pose_index(k)
        lever = rotation_matrix(np.array(self.state.values)[at + 3 : at + 7]) @ (place - start)
        out = np.zeros((6, len(self.a)))
        # dr + dtheta x lever
        out[:3, : self.degrees_of_freedom] = rows[:3] + np.cross(rows[3:].T, lever).T
        out[3:, : self.degrees_of_freedom] = rows[3:]
        return out

    @one_thread
    def response(self, *, omega: ArrayLike, force: ArrayLike) -> Complex:
        """Complex amplitudes of x under loads Re force exp(i omega t) on the vessel, in the steady state.

        Shapes: omega (k,), rad/s; force (k, 6), N and N m; x (k, n).

        Raises
        ------
        SceneError
            Without a vessel, for values that are not finite, or at the frequency of an undamped mode.
        """
        if self.vessel is None:
            raise SceneError(f"scene {self.scene.name!r}: has no vessel on which waves act; add one")
        w, f = np.asarray(omega, dtype=float), np.asarray(force, dtype=complex)
        if w.ndim != 1 or f.shape != (w.size, 6) or not (np.all(np.isfinite(w)) and np.all(np.isfinite(f))):
            raise SceneError(
                f"omega has shape {w.shape}, force {f.shape}; give (k,) and (k, 6) finite numbers"
            )
        return self.response_to_rates(w, f @ self.b.T)

    @one_thread
    def response_to_rates(self, omega: Array, rates: Array | Complex) -> Complex:
        """Complex amplitudes of x (k, n) under rates of x, Re rates exp(i omega t), in the steady state.

        Raises SceneError at the frequency of an undamped mode.
        """
        w, resolvent = omega, Resolvent(self.a, self.scene.name)
        x = resolvent.response(w, rates)
        if not self.memories:
            return x
        load, motion = self._memory_loads()
        by_load = np.stack([resolvent.response(w, np.broadcast_to(each, x.shape)) for each in load.T], axis=2)
        impedance = block_diagonal([memory.impedance(w) for memory in self.memories])
        # x = x_0 - by_load Z y of the motions y of the vessels with memory, y = motion x.
        closed = np.eye(len(motion)) + motion @ by_load @ impedance
        y = np.linalg.solve(closed, (x @ motion.T)[..., None])
        return np.asarray(x - (by_load @ (impedance @ y))[..., 0])

    def _memory_loads(self) -> tuple[Array, Array]:
        """Rates of x by loads on the vessels of `memories` (n, 6 m), and their motions by x (6 m, n)."""
        dof = self.degrees_of_freedom
        load = np.zeros((len(self.a), 6 * len(self.memories)))
        load[dof : 2 * dof] = np.hstack([self._accelerations(each.body) for each in self.memories])
        return load, np.concatenate([self.motion_of(each.body) for each in self.memories])

    def _accelerations(self, vessel: str) -> Array:
        """Of the coordinates per wave load on a vessel, (degrees of freedom, 6)."""
        reduced = self.basis.T @ self.mass @ self.basis
        return np.asarray(np.linalg.solve(reduced, self._along(vessel).T))

    def _along(self, vessel: str) -> Array:
        """Motion of a vessel in axes that follow its yaw per coordinate, (6, degrees of freedom)."""
        k = self.bodies.index(vessel)
        return np.asarray(self._yaw_axes(vessel).T @ self.basis[6 * k : 6 * k + 6])

    def _yaw_axes(self, vessel: str) -> Array:
        """(6, 6) from axes that follow a vessel's yaw to inertial ones; the paper's loads are inertial."""
        at = self.model.pose_index(self.bodies.index(vessel))
        r = rotation_matrix(np.array(self.state.values)[at + 3 : at + 7])
        yaw = 0.0 if self.model.paper_kinematics else float(np.arctan2(r[1, 0], r[0, 0]))
        return np.asarray(np.kron(np.eye(2), rotation_about_z(yaw)))

    def yaw_axes(self) -> Array:
        """(6, 6) from the axes of wave loads, which follow the vessel's yaw, to inertial ones."""
        assert self.vessel is not None
        return self._yaw_axes(self.vessel)

    def motion_of(self, vessel: str) -> Array:
        """C (6, n): motion (m) of a vessel's origin and its rotation vector from x, in its yaw axes."""
        out = np.zeros((6, len(self.a)))
        out[:, : self.degrees_of_freedom] = self._along(vessel)
        return out

    @one_thread
    def at_frequency(self, omega: float) -> LinearModel:
        """The same model with the matrices that `memories` have at one frequency (rad/s), for all of them."""
        if not self.memories:
            return self
        dof = self.degrees_of_freedom
        load, motion = self._memory_loads()
        speeds, moved = load[dof : 2 * dof], motion[:, :dof]
        a, b, mass = self.a.copy(), self.b.copy(), self.mass.copy()
        added = np.zeros((len(moved), len(moved)))
        for i, memory in enumerate(self.memories):
            at = slice(6 * i, 6 * i + 6)
            added[at, at], damping, stiffness = (x[0] for x in memory.matrices(np.array([omega])))
            a[dof : 2 * dof, :dof] -= speeds[:, at] @ stiffness @ moved[at]
            a[dof : 2 * dof, dof : 2 * dof] -= speeds[:, at] @ damping @ moved[at]
            k = self.bodies.index(memory.body)
            axes = self._yaw_axes(memory.body)
            mass[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] += axes @ added[at, at] @ axes.T
        heavier = np.eye(dof) + speeds @ added @ moved
        a[dof : 2 * dof] = np.linalg.solve(heavier, a[dof : 2 * dof])
        b[dof : 2 * dof] = np.linalg.solve(heavier, b[dof : 2 * dof])
        return replace(self, a=a, b=b, mass=mass, memories=())

    @one_thread
    def excited(self, vessel: str) -> LinearModel:
        """The same model with waves on another vessel, by its body; raises SceneError if there is none."""
        name = _wave_body(self.scene, vessel)
        assert name is not None
        b, dof = np.zeros_like(self.b), self.degrees_of_freedom
        b[dof : 2 * dof] = self._accelerations(name)
        return replace(self, vessel=name, b=b)

    def full_state(self, x: ArrayLike) -> _core.State:
        """State of the scene for small x (n,), on the constraints; a run may start from it.

        Its lines that are taut at rest are as long as x makes them to first order: what bodies do beyond it
        strains no line.

        Raises
        ------
        SceneError
            For an x of another shape, or with `memories`, whose past x does not hold.
        """
        if self.memories:
            raise SceneError(
                f"scene {self.scene.name!r}: its linear model has memory by frequency, whose past is not in "
                "x; start from a linear model with memory='by-motion' or 'per-pair' on the vessel"
            )
        values = np.asarray(x, dtype=float)
        if values.shape != (len(self.a),):
            raise SceneError(f"x has shape {values.shape}; give ({len(self.a)},)")
        dof, terms = self.degrees_of_freedom, self._terms
        rest = np.array(self.state.values)
        displacement, twist = self.basis @ values[:dof], self.basis @ values[dof : 2 * dof]
        y = terms.moved(rest, displacement=displacement, twist=twist)
        y[terms.memory] += values[2 * dof :]
        project = _core.Evaluator(terms.model).project  # of its own: threads may share the model
        y = project(terms.time, y)
        for _ in range(CORRECTIONS if lines_of(self.scene.loads) else 0):
            nearer, faster = with_lengths_of(self.scene, terms.model, rest, y, displacement, twist)
            y = project(terms.time, terms.moved(y, displacement=nearer, twist=faster))
        return _core.State(time=terms.time, values=y, inputs=np.zeros(terms.model.slots))


@named
@one_thread
def linear_model(
    scene: Description,
    *,
    state: _core.State | None = None,
    vessel: str | None = None,
    memory: str = "scene",
    database: HydroDatabase | None = None,
) -> LinearModel:
    """Linearise a scene about a state at rest, its references held.

    The quaternions do not appear: poses are perturbed by translations and rotation vectors within the null
    space of the constraints, so the model has exactly 2 degrees of freedom + memory states. Loads
    proportional to u |u| have no linear part at rest and drop out; `drag_in_sea` gives one to those of what
    is in water.

    Parameters
    ----------
    state : State, optional
        At rest, its time that of the references. Default: ``equilibrium(scene)``.
    vessel : str, optional
        Body on which waves act. Default: that of the scene's waves, the only vessel, or the first of the only
        group.
    memory : str
        "scene" (default): the vessel's fitted states, or its convolution by frequency. "database": the A, B
        and additional matrices of its database by frequency in place of the vessel's memory, so that nothing
        is fitted.
    database : HydroDatabase, optional
        With ``memory="database"``: the same ship at a forward speed. Default: the vessel's own.

    Raises
    ------
    SceneError
        If something moves or accelerates at the state, the vessel is not clear, or the database is missing or
        not the vessel's.
    """
    body = _wave_body(scene, vessel) if memory == "database" else None
    memories = frequency_memories(scene, memory=memory, database=database, vessel=body)
    if memories:
        if state is not None:
            first = Terms(compile_scene(held(scene, time=state.time)), time=state.time).memory.start
            state = state_without_memory(scene, state, memories, first=first)
        scene = without_memory(scene, memories)
    rest = equilibrium(scene) if state is None else state
    values = state_values(scene.copy(orientation="quaternion") if state is None else scene, rest)
    model = compile_scene(held(scene, time=rest.time))
    terms = Terms(model, time=rest.time)
    _require_rest(terms, terms.checked(values))
    values = at_rest(model, values)
    coordinates = ReducedCoordinates.at(terms, values)
    name = _wave_body(scene, vessel)
    a, neutral = _state_matrix(coordinates)
    found = LinearModel(
        scene=scene, state=_core.State(time=rest.time, values=values, inputs=np.zeros(model.slots)),
        bodies=tuple(model.bodies), vessel=None, a=a, b=np.zeros((len(a), 6)), basis=coordinates.basis,
        mass=np.asarray(terms.evaluator.terms(terms.time, values)["mass"]), neutral=neutral,
        memories=memories, _terms=terms,
    )  # fmt: skip
    return found if name is None else found.excited(name)


def _state_matrix(coordinates: ReducedCoordinates) -> tuple[Array, Array]:
    """A, and the directions on which neither forces nor rates of states depend: zero columns of A."""
    dof, rows = coordinates.size, coordinates.state_rows()
    columns = rows[:, :dof].copy()
    columns[dof:] /= np.array(coordinates.terms.model.scale)[coordinates.terms.memory][:, None]
    _, size, vt = np.linalg.svd(columns)
    held_in, neutral = vt[size > NEUTRAL].T, vt[size <= NEUTRAL].T
    a = np.zeros((dof + len(rows), dof + len(rows)))
    a[:dof, dof : 2 * dof] = np.eye(dof)
    a[dof:] = rows
    a[dof:, :dof] = np.ascontiguousarray(rows[:, :dof]) @ held_in @ held_in.T
    return a, neutral


def _require_rest(terms: Terms, values: Array) -> None:
    acceleration, drift = (np.abs(each) for each in terms.acceleration_and_drift(values))
    if np.max(drift, initial=0.0) > REST:
        name, unit, place, *_ = terms.model.load_states[int(np.argmax(drift))]
        rate = terms.evaluator.derivative(terms.time, values)[place]
        raise SceneError(
            f"state {name!r}: changes by {rate:.3g} {unit}/s at the state to be linearised; pass it through "
            "seacrane.equilibrium first"
        )
    moving = np.abs(values[terms.twists])
    for what, unit, size in (
        ("moves", "m/s or rad/s", moving), ("accelerates", "m/s2 or rad/s2", acceleration),
    ):  # fmt: skip
        worst = int(np.argmax(size))
        if size[worst] > REST:
            name = terms.model.bodies[worst // 6]
            raise SceneError(
                f"body {name!r}: {what} by {size[worst]:.3g} {unit} at the state to be "
                "linearised; pass it through seacrane.equilibrium first"
            )


def _wave_body(scene: Description, wanted: str | None) -> str | None:
    floating = [vessel.body for vessel in scene.vessels.values()]
    if wanted is None and scene.waves is not None and len(scene.waves.hulls) == 1:
        wanted = scene.waves.body_of()
    together = [scene.vessels[name].body for group in scene.groups.values() for name in group.vessels]
    if wanted is None and (len(floating) == 1 or (len(scene.groups) == 1 and set(together) == set(floating))):
        wanted = floating[0] if len(floating) == 1 else together[0]
    if wanted is None and floating:
        raise SceneError(f"scene {scene.name!r}: has vessels {', '.join(floating)}; name one as vessel")
    if wanted is not None and wanted not in floating:
        raise SceneError(f"vessel {wanted!r} does not exist; vessels here: {', '.join(floating) or 'none'}")
    return wanted
