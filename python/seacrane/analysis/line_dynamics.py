"""Elastic lines at an instant: how they are stretched, and how fast the bodies as joined let them ring."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.loads import length_at, lines_of, on_winch, path_of, states_of, winch_of
from seacrane.inputs.frames import rotation_matrix
from seacrane.one_thread import one_thread

DEPENDENT = 1e-10  # of the largest singular value: rows, or lines, that depend on each other
COUPLED = 1e-9  # of the largest eigenvalue: strains that move no body


@dataclass(frozen=True, kw_only=True)
class LineDynamics:
    """An elastic line at an instant: tension (N; negative where a slack line would push), and what it moves.

    Attributes
    ----------
    ringing : Amplitude (N) of the oscillation of its tension that starts there.
    mass : kg, that its tension accelerates along the line, as the bodies are joined.
    omega : rad/s; slower motion strains the line by (frequency / omega)^2 of what bends a rigid one. That of
        a single line: sqrt(EA / (length mass)).
    fastest : rad/s, of it alone: others only slow what it makes of a mode.
    swing : rad/s, of what hangs on it, and of the lower of two loads that it joins.
    loss : Of its damping at `omega`: c omega over the stiffness.
    coupled : Lines whose tension moves it, itself among them.
    direction : (6 bodies,) Rate of the path's length for each speed of the bodies.
    """

    tension: float
    ringing: float
    mass: float
    omega: float
    fastest: float
    swing: float
    loss: float
    coupled: frozenset[str]
    direction: Array

    def shaken(self, accelerations: Array) -> float:
        """Amplitude (N) that a jump of the bodies' accelerations (bodies, 6) makes."""
        return self.mass * abs(float(self.direction @ accelerations.ravel()))


@one_thread
def line_dynamics(
    scene: Description, model: _core.Model, values: Array, time: float
) -> dict[str, LineDynamics]:
    """The dynamics of all lines of a scene; its model has elastic lines, quaternions, and merges nothing."""
    evaluator = _core.Evaluator(model)
    terms = evaluator.terms(time, values)
    accelerations = np.asarray(evaluator.accelerations(time, values))
    lines = lines_of(scene.loads)
    paths = {name: _Path(scene, model, line, values, accelerations) for name, line in lines.items()}
    directions = np.stack([path.direction for path in paths.values()], axis=1)
    yielding = directions.T @ _response(terms, directions)
    lengths = {name: length_at(line, time, {}) for name, line in lines.items()}
    stiffness = np.array([line.EA / lengths[name] for name, line in lines.items()])
    pulls = [line.EA * max(paths[n].length / lengths[n] - 1.0, 0.0) for n, line in lines.items()]
    omegas = _omegas(yielding, stiffness, np.array(pulls))
    states = states_of(model, values)
    groups = _coupled(list(lines), yielding)
    out = {}
    for i, (name, line) in enumerate(lines.items()):
        path, mass = paths[name], 1.0 / max(float(yielding[i, i]), 1e-300)
        bounced = model.line_bounces[name][0] if name in model.line_bounces else mass
        l0, rate, bend = _unstretched(lines, line, time, states)
        strain_rate = (path.rate - rate * path.length / l0) / l0
        damping = 2.0 * line.damping_ratio * np.sqrt(line.EA * (line.mass or bounced) / l0)
        straining = path.bend - path.length / l0 * bend - 2.0 * rate * strain_rate
        out[name] = LineDynamics(
            tension=float(line.EA * (path.length / l0 - 1.0) + damping * l0 * strain_rate),
            ringing=float(mass * np.hypot(straining, omegas[i] * strain_rate * l0)),
            mass=mass, omega=float(omegas[i]), fastest=float(np.sqrt(stiffness[i] / mass)),
            swing=_swing(scene, line, path.longest), loss=float(damping * omegas[i] / stiffness[i]),
            coupled=groups[name], direction=path.direction,
        )  # fmt: skip
    return out


def _coupled(names: list[str], yielding: Array) -> dict[str, frozenset[str]]:
    """The lines that feel each other, through others too."""
    own = np.maximum(np.diag(yielding), 1e-300)
    near = yielding**2 > COUPLED * np.outer(own, own)
    np.fill_diagonal(near, val=True)
    for _ in range(max(len(names) - 1, 0).bit_length()):
        near = near @ near
    return {name: frozenset(np.array(names)[row].tolist()) for name, row in zip(names, near, strict=True)}


def _swing(scene: Description, line: _core.Line, longest: float) -> float:
    """A load on a line of that length, faster where what it hangs on is as free as itself."""
    held = {end for joint in scene.joints.values() for end in (joint.first, joint.second)}
    held |= {vessel.body for vessel in scene.vessels.values()}
    ends = [body for body in dict.fromkeys(line.bodies) if body in scene.bodies and body not in held]
    free = [scene.bodies[body].mass for body in ends]
    ratio = min(free) / max(free) if len(free) > 1 else 0.0
    return float(np.sqrt(scene.gravity * (1.0 + ratio) / max(longest, 1e-300)))


def with_lengths_of(
    scene: Description, model: _core.Model, rest: Array, values: Array, displacement: Array, twist: Array
) -> tuple[Array, Array]:
    """Corrections (6 n) of poses and twists with which taut lines are as long as small motion makes them.

    Bodies that are moved from `rest` by a displacement and twist (6 n,) along straight lines strain stiff
    lines by the squares of these. Each correction is the smallest one in the mass metric.
    """
    none = np.zeros((len(model.bodies), 6))
    paths, wanted, rates = [], [], []
    for line in lines_of(scene.loads).values():
        still = _Path(scene, model, line, rest, none)
        if still.length <= length_at(line, 0.0, states_of(model, rest)):
            continue
        paths.append(_Path(scene, model, line, values, none))
        wanted.append(still.length + float(still.direction @ displacement))
        rates.append(float(still.direction @ twist))
    if not paths:
        return np.zeros_like(displacement), np.zeros_like(twist)
    directions = np.stack([path.direction for path in paths], axis=1)
    response = _response(_core.Evaluator(model).terms(0.0, values), directions)
    inverse = np.linalg.pinv(directions.T @ response, rcond=DEPENDENT, hermitian=True)
    apart = np.array([wish - path.length for wish, path in zip(wanted, paths, strict=True)])
    faster = np.array([wish - path.rate for wish, path in zip(rates, paths, strict=True)])
    return np.asarray(response @ (inverse @ apart)), np.asarray(response @ (inverse @ faster))


def _omegas(yielding: Array, stiffness: Array, pulls: Array) -> Array:
    """From what slow motion adds to each tension, the lines of a scene being strained by theirs together.

    With the flexibility of the lines 1 / k, and m the mass that they move, T changes by omega^2 m T / k.
    """
    root = np.sqrt(stiffness)
    flexible = np.linalg.pinv(root[:, None] * yielding * root, rcond=COUPLED, hermitian=True)
    strained = np.where(pulls > 0.0, pulls, 0.0) / root
    own = np.abs(np.diag(flexible))
    with np.errstate(divide="ignore", invalid="ignore"):
        squares = np.where(strained > 0.0, np.abs(flexible) @ strained / strained, own)
        return np.asarray(1.0 / np.sqrt(np.maximum(squares, own)))


def _response(terms: dict[str, Any], forces: Array) -> Array:
    """Accelerations for forces (6 bodies, n), the joints kept."""
    mass, rows = np.asarray(terms["mass"]), np.asarray(terms["jacobian"])
    free = np.linalg.solve(mass, forces)
    if not rows.size:
        return np.asarray(free)
    along = np.linalg.solve(mass, rows.T)
    yielding = rows @ along
    size = np.sqrt(np.diag(yielding))
    scale = np.where(size > 0.0, 1.0 / np.where(size > 0.0, size, 1.0), 0.0)  # a row may move nothing
    inverse = np.linalg.pinv(scale[:, None] * yielding * scale, rcond=DEPENDENT, hermitian=True)
    return np.asarray(free - along @ (scale[:, None] * (inverse @ (scale[:, None] * (rows @ free)))))


def _unstretched(
    lines: dict[str, _core.Line], line: _core.Line, time: float, states: dict[str, float]
) -> tuple[float, float, float]:
    """Unstretched length (m), its rate and acceleration."""
    wound = on_winch(lines, line)
    if wound is None:
        value, rate, bend = line.length.evaluate([time])[0]
        return float(value), float(rate), float(bend)
    length, share = length_at(line, time, states), line.share
    command = float(np.clip(wound.rate.evaluate([time])[0, 0], -wound.maximum_rate, wound.maximum_rate))
    if wound.lag == 0.0:
        return length, share * command, 0.0
    rate, bound = states.get(f"{winch_of(wound)}.rate", 0.0), wound.maximum_acceleration
    return length, share * rate, share * float(np.clip((command - rate) / wound.lag, -bound, bound))


class _Path:
    """The path of a line: its length (m), rate, acceleration, longest span, direction among all speeds."""

    def __init__(
        self, scene: Description, model: _core.Model, line: _core.Line, values: Array, accelerations: Array
    ):
        self.length = self.rate = self.bend = self.longest = 0.0
        self.direction = np.zeros(6 * len(model.bodies))
        points = [_Point(scene, model, body, np.asarray(p), values) for body, p in path_of(line)]
        for start, end in pairwise(points):
            apart, parting = end.place - start.place, end.velocity - start.velocity
            span = float(np.linalg.norm(apart))
            if span == 0.0:
                continue
            along = apart / span
            rate = float(along @ parting)
            self.length += span
            self.rate += rate
            self.longest = max(self.longest, span)
            bend = end.acceleration(accelerations) - start.acceleration(accelerations)
            self.bend += float(along @ bend) + float(parting @ parting - rate**2) / span
            for point, sign in ((end, 1.0), (start, -1.0)):
                point.add(sign * along, self.direction)


class _Point:
    """A point of a path; of the ground it rests."""

    def __init__(self, scene: Description, model: _core.Model, body: str, point: Array, values: Array):
        self.index = list(model.bodies).index(body) if body in scene.bodies else -1
        self.place, self.velocity, self.lever, self.spin = point, np.zeros(3), np.zeros(3), np.zeros(3)
        if self.index < 0:
            return
        at, speed = model.pose_index(self.index), model.twist_index(self.index)
        floating = {vessel.body for vessel in scene.vessels.values()}
        start = np.zeros(3) if body in floating else np.asarray(scene.bodies[body].center_of_mass)
        self.lever = np.asarray(rotation_matrix(values[at + 3 : at + 7]) @ (point - start))
        self.spin = values[speed + 3 : speed + 6]
        self.place = values[at : at + 3] + self.lever
        self.velocity = values[speed : speed + 3] + np.cross(self.spin, self.lever)

    def acceleration(self, accelerations: Array) -> Array:
        if self.index < 0:
            return np.zeros(3)
        own = accelerations[self.index]
        turning = np.cross(own[3:], self.lever) + np.cross(self.spin, np.cross(self.spin, self.lever))
        return np.asarray(own[:3] + turning)

    def add(self, along: Array, direction: Array) -> None:
        if self.index >= 0:
            first = 6 * self.index
            direction[first : first + 3] += along
            direction[first + 3 : first + 6] += np.cross(self.lever, along)
