"""Why a W-method that knows the stiff lines alone is no way out: trials on a pendulum and on case 2."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from seacrane.analysis import Evaluator

from .section import Section
from .stiff_lines import DT_OUT, TIGHT, lifted, path_of, power_of_ten

Array = NDArray[np.float64]
Rate = Callable[[float, Array], Array]

STIFFNESSES = (1e9, 1e10)  # N

# ROS34PW2, as cpp/seacrane/integrate/tableaus/rang_angermann34.hpp has it.
GAMMA = 4.3586652150845900e-01
STAGE = np.array(
    [
        [0.0, 0.0, 0.0],
        [8.7173304301691801e-01, 0.0, 0.0],
        [8.4457060015369423e-01, -1.1299064236484185e-01, 0.0],
        [0.0, 0.0, 1.0],
    ]
)
COUPLING = np.array(
    [
        [0.0, 0.0, 0.0],
        [-8.7173304301691801e-01, 0.0, 0.0],
        [-9.0338057013044082e-01, 5.4180672388095326e-02, 0.0],
        [2.4212380706095346e-01, -1.2232505839045147e00, 5.4526025533510214e-01],
    ]
)
WEIGHTS = np.array([2.4212380706095346e-01, -1.2232505839045147e00, 1.5452602553351020e00, GAMMA])
EMBEDDED = np.array([3.7810903145819369e-01, -9.6042292212423178e-02, 0.5, 2.1793326075422950e-01])

T_END = 30.0  # s of case 2
STIFF_CASE = 1e10  # N
MASS, LENGTH, GRAVITY, SWING, SWINGING = 1e4, 8.0, 9.80665, 0.2, 10.0  # kg, m, m/s2, rad, s


def w_step(rate: Rate, t: float, y: Array, h: float, matrix: Array) -> tuple[Array, Array]:
    """One step and its estimated error."""
    factors = lu_factor(np.eye(y.size) - h * GAMMA * matrix)
    k = np.zeros((4, y.size))
    for s in range(4):
        coupled = COUPLING[s] @ k[:3] / GAMMA
        right = rate(t + h * STAGE[s].sum(), y + h * STAGE[s] @ k[:3]) + coupled
        k[s] = lu_solve(factors, right) - coupled
    return y + h * WEIGHTS @ k, h * (WEIGHTS - EMBEDDED) @ k


class Pendulum:
    """A point on an elastic line, 2 % damped, in coordinates x, z or in length and angle."""

    def __init__(self, stiffness: float, *, polar: bool) -> None:
        self.k = stiffness / LENGTH
        self.c = 0.04 * np.sqrt(self.k * MASS)
        self.polar = polar
        length = LENGTH + MASS * GRAVITY * np.cos(SWING) / self.k
        place = np.array([length, SWING])
        self.start = np.concatenate([place if polar else _cartesian(place), np.zeros(2)])

    def rate(self, _t: float, y: Array) -> Array:
        q, v = y[:2], y[2:]
        if self.polar:
            pull = (self.k * (q[0] - LENGTH) + self.c * v[0]) / MASS
            radial = q[0] * v[1] ** 2 + GRAVITY * np.cos(q[1]) - pull
            return np.array([*v, radial, (-GRAVITY * np.sin(q[1]) - 2.0 * v[0] * v[1]) / q[0]])
        along = q / np.linalg.norm(q)
        pull = (self.k * (np.linalg.norm(q) - LENGTH) + self.c * along @ v) / MASS
        return np.concatenate([v, -pull * along - np.array([0.0, GRAVITY])])

    def matrix(self, y: Array, *, full: bool) -> Array:
        """The Jacobian, or the part of it that the line's stretch makes, with q' = v."""
        if full:
            step = 1e-6
            return np.stack(
                [
                    (self.rate(0.0, y + step * d) - self.rate(0.0, y - step * d)) / (2.0 * step)
                    for d in np.eye(4)
                ],
                axis=1,
            )
        out = np.zeros((4, 4))
        out[:2, 2:] = np.eye(2)
        along = np.array([1.0, 0.0]) if self.polar else y[:2] / np.linalg.norm(y[:2])
        out[2:, :2] = -self.k / MASS * np.outer(along, along)
        out[2:, 2:] = -self.c / MASS * np.outer(along, along)
        return out

    def end(self, step: float, *, full: bool) -> Array:
        """Its place after the method's equal steps, as x and z."""
        y = self.start
        for _ in range(round(SWINGING / step)):
            y, _error = w_step(self.rate, 0.0, y, step, self.matrix(y, full=full))
        return _cartesian(y[:2]) if self.polar else y[:2]


def _cartesian(place: Array) -> Array:
    return np.asarray(place[0] * np.array([np.sin(place[1]), -np.cos(place[1])]))


def stiff_direction() -> Section:
    """Errors of a W-method on a stiff pendulum in two kinds of coordinates."""
    rows = []
    for stiffness in STIFFNESSES:
        truth = Pendulum(stiffness, polar=True).end(1e-3, full=True)
        for polar in (False, True):
            for full in (True, False):
                errors = [
                    1e3 * float(np.linalg.norm(Pendulum(stiffness, polar=polar).end(h, full=full) - truth))
                    for h in (0.05, 0.025, 0.0125)
                ]
                coordinates = "length, angle" if polar else "x, z"
                rows.append([power_of_ten(stiffness), coordinates,
                             "Jacobian" if full else "line only", *errors])  # fmt: skip
    return Section(
        title="Stiff direction within a step",
        text=(
            f"ROS34PW2 with equal steps on a pendulum of {MASS / 1e3:g} t on {LENGTH:g} m, let go at "
            f"{SWING:g} rad on a line of EA, 2 % damped: error of its place after {SWINGING:g} s. The line's "
            "direction turns within a step in x and z, and not in length and angle. `line only`: the matrix "
            "holds the stretch and the kinematics."
        ),
        head=["EA, N", "coordinates", "matrix", "h 0.05 s, mm", "h 0.025 s, mm", "h 0.0125 s, mm"],
        rows=rows,
    )


class Trial:
    """The method on case 2 with a line of EA, in maximal coordinates, by the engine's derivative."""

    def __init__(self, stiffness: float, *, full: bool, project: bool) -> None:
        scene = lifted(stiffness, "elastic")
        self.model = scene.compile()
        self.with_line = Evaluator(self.model)
        scene.remove("link")
        self.without = Evaluator(scene.compile())
        self.full, self.projects = full, project
        bodies = len(scene.bodies)
        self.place = slice(7 * list(scene.bodies).index("payload"), None)
        self.poses, self.twists = 7 * bodies, 13 * bodies
        self.start = np.array(self.model.initial_state)
        scale = np.array(self.model.scale)
        self.counted = np.isfinite(scale)
        self.scale = scale[self.counted]
        self.evaluations = 0

    def rate(self, t: float, y: Array) -> Array:
        self.evaluations += 1
        return self.with_line.derivative(t, y)

    def matrix(self, t: float, y: Array) -> Array:
        """The Jacobian; or the kinematics, and of accelerations what the line changes."""
        whole = self.with_line.jacobian(t, y)
        if self.full:
            return whole
        out = whole - self.without.jacobian(t, y)
        out[: self.poses] = whole[: self.poses]
        out[self.twists :] = 0.0
        return out

    def _after(self, t: float, y: Array) -> Array:
        return self.with_line.project(t, y) if self.projects else y

    def payload(self, y: Array) -> Array:
        return y[self.place][:3]

    def equal_steps(self, h: float) -> Array:
        """The payload's places at the outputs."""
        y, places = self.start, []
        per_output = round(DT_OUT / h)
        for i in range(round(T_END / h)):
            y = self._after((i + 1) * h, w_step(self.rate, i * h, y, h, self.matrix(i * h, y))[0])
            if (i + 1) % per_output == 0:
                places.append(self.payload(y))
        return np.array(places)

    def step_control(self, rtol: float) -> Array:
        """The same with steps chosen by the estimated error."""
        t, y, h, places = 0.0, self.start, 0.01, []
        for output in range(1, round(T_END / DT_OUT) + 1):
            while t < output * DT_OUT - 1e-9:
                matrix = self.matrix(t, y)
                while True:
                    step = min(h, output * DT_OUT - t)
                    new, error = w_step(self.rate, t, y, step, matrix)
                    size = float(np.sqrt(np.mean((error[self.counted] / (rtol * self.scale)) ** 2)))
                    wish = step * min(5.0, max(0.2, 0.9 * max(size, 1e-9) ** (-1.0 / 3.0)))
                    if size <= 1.0:
                        break
                    h = wish
                t, y = t + step, self._after(t + step, new)
                h = max(h, wish) if step < h else wish
            places.append(self.payload(y))
        return np.array(places)


def w_method() -> Section:
    """Errors of the payload on case 2: equal steps, projection, matrix, step control."""
    rows: list[list[Any]] = []
    for stiffness in (*STIFFNESSES, 1e11):
        truth = path_of(stiffness, T_END)

        def row(
            setting: str, places: Array, trial: Trial, stiffness: float = stiffness, truth: Array = truth
        ) -> None:
            apart = 1e3 * np.linalg.norm(places - truth[1:], axis=1)
            ten = round(10.0 / DT_OUT)
            rows.append([power_of_ten(stiffness), "Jacobian" if trial.full else "line only",
                         "yes" if trial.projects else "no", setting, trial.evaluations,
                         float(apart[:ten].max()), float(apart.max())])  # fmt: skip

        if stiffness == STIFF_CASE:
            for full in (False, True):
                for project in (False, True):
                    trial = Trial(stiffness, full=full, project=project)
                    row("h 0.05 s", trial.equal_steps(0.05), trial)
            for h in (0.025, 0.0125):
                trial = Trial(stiffness, full=False, project=True)
                row(f"h {h:g} s", trial.equal_steps(h), trial)
        for rtol in (1e-3, 1e-4):
            trial = Trial(stiffness, full=False, project=True)
            row(f"rtol {rtol:g}", trial.step_control(rtol), trial)
    return Section(
        title="W-method with stiff lines only",
        text=(
            f"{T_END:g} s of case 2 with a line of EA for its link, by ROS34PW2 in maximal coordinates. "
            "The table has the largest error of the payload's place until 10 s and until the end, against "
            f"the elastic line solved tightly (`{TIGHT.integrator}`, {TIGHT.rtol:g}). `line only`: the "
            "matrix holds the line's part of the Jacobian and the kinematics. Matrices are made "
            "anew in every step, and are not counted."
        ),
        head=["EA, N", "matrix", "projected", "setting", "evaluations", "to 10 s, mm", "to the end, mm"],
        rows=rows,
    )
