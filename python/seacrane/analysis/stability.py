"""Whether a scene stays at a state of rest: what grows from there, how fast, and what moves most."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis.left_range import LARGEST_HEEL
from seacrane.analysis.reduced_coordinates import NEUTRAL, ReducedCoordinates, Terms
from seacrane.analysis.taut_lines import slack_lines
from seacrane.arrays import Array, Complex
from seacrane.description.compilation import compile_scene
from seacrane.description.description import Description
from seacrane.description.given import given_vessels
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import lines_of
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.frames import MOTIONS
from seacrane.warnings import CreepingRestWarning, LargeHeelWarning, UnstableRestWarning

LEAST_GROWTH = 1e-3  # 1/s: what takes ten minutes to double is not told
LEAST_CREEP = 1e-6  # m/s
CHAMBERS = ("pressure", "pressure_rod")
LEAST_SHARE = 1e-6  # of |eigenvalue|, of an oscillation that grows: less is rounding
STILL = 1e-6  # m/s2 and rad/s2: what accelerates less is not what keeps the scene from rest


@dataclass(frozen=True, kw_only=True)
class Growing:
    """A mode that grows: its eigenvalue (1/s), and what it moves most, as "vessel roll"."""

    value: complex
    label: str

    @property
    def words(self) -> str:
        """As "grows, doubling in 87 s"."""
        return growth_in_words(self.value)


def growth_in_words(value: complex) -> str:
    """Words for an eigenvalue (1/s) that grows, as "grows, doubling in 87 s"."""
    doubling = f"grows, doubling in {np.log(2.0) / value.real:.3g} s"
    if value.imag == 0.0:
        return doubling
    return f"swings with {2.0 * np.pi / abs(value.imag):.3g} s and {doubling}"


def grows(values: Array | Complex) -> NDArray[np.bool_]:
    """Which of these eigenvalues (1/s) grow; of a pair the one with the positive imaginary part."""
    least = np.maximum(LEAST_GROWTH, LEAST_SHARE * np.abs(values))
    return np.asarray((values.real > least) & (values.imag >= 0.0))


def tips_over(stiffness: Array) -> bool:
    """Whether d(acceleration) / d(coordinates) pushes away from rest in some direction."""
    squares = np.linalg.eigvals(stiffness)
    pushes = (squares.real > LEAST_GROWTH**2) & (np.abs(squares.imag) <= NEUTRAL * np.abs(squares))
    return bool(np.any(pushes))


def growing(scene: Description, model: _core.Model, state: _core.State) -> list[Growing]:
    """What grows at a state of rest of a held scene, the fastest first.

    Without winches and compensators only what tips over can grow, which the stiffness tells; with them an
    oscillation can too. Those that valves feed are left to `UnsteadyOilWarning`: a valve has two slopes.
    """
    terms = Terms(model, time=state.time)
    coordinates = ReducedCoordinates.quickly_at(terms, np.asarray(state.values))
    matrix = coordinates.static_matrix()
    if not np.all(np.isfinite(matrix)):
        return []
    if not len(terms.load_scales) and not tips_over(matrix):
        return []
    values, vectors = _modes(coordinates)
    told = grows(values) & ((values.imag == 0.0) | (not hydraulic_cylinders(scene)))
    found, out = np.flatnonzero(told), []
    for i in found[np.argsort(-values.real[found])]:
        mass = np.asarray(terms.evaluator.terms(terms.time, coordinates.values)["mass"])
        motion = coordinates.basis @ vectors[: coordinates.size, i]
        energy = np.real(motion.conj() * (mass @ motion))
        out.append(Growing(value=complex(values[i]), label=label_of(model.bodies, energy)))
    return out


def _modes(coordinates: ReducedCoordinates) -> tuple[Complex, Complex]:
    """Eigenvalues and vectors of coordinates, speeds and states of loads, the fluid's memory among them."""
    dof, rows = coordinates.size, coordinates.state_rows()
    scale = np.array(coordinates.terms.model.scale)[coordinates.terms.memory]
    scale = np.where(np.isfinite(scale), scale, 1.0)
    rows[dof:] /= scale[:, None]
    rows[:, 2 * dof :] *= scale
    matrix = np.vstack([np.eye(dof, 2 * dof + len(scale), dof), rows])
    values, vectors = np.linalg.eig(matrix)
    return np.asarray(values, dtype=complex), np.asarray(vectors, dtype=complex)


def label_of(bodies: Sequence[str], energy: Array) -> str:
    """Body and motion with most of a kinetic energy (6 n,), as "vessel roll"."""
    body, way = divmod(int(np.argmax(energy)), 6)
    return f"{bodies[body]} {MOTIONS[way]}"


def warn_of_rest(what: str, scene: Description, model: _core.Model, state: _core.State) -> None:
    """Warn of a state of rest at which the scene does not stay, that leaks, or where a ship heels too far."""
    found = growing(scene, model, state)
    if found:
        warn_caller(
            f"{what}: scene {scene.name!r} does not stay at this rest: {found[0].label} {found[0].words}. "
            "Look at natural_modes(scene, state=...); lower the weights or hold what tips over, or start the "
            "search from a state on the side to which it falls",
            UnstableRestWarning,
        )
    turned = most_turned(scene, model, np.asarray(state.values))
    if turned > LARGEST_HEEL:
        warn_caller(
            f"{what}: scene {scene.name!r} rests with a vessel that leans by {np.degrees(turned):.3g} deg, "
            f"beyond {np.degrees(LARGEST_HEEL):.0f} deg: restoring is linear, so that a ship may have no "
            "rest there, or capsize. Add ballast (Scene.add_ballast), or lower the weights",
            LargeHeelWarning,
        )
    _warn_of_leaks(what, scene, model, state)


def _warn_of_leaks(what: str, scene: Description, model: _core.Model, state: _core.State) -> None:
    """Warn of hydraulic cylinders that creep from where they rest, as they leak."""
    places = {name: place for name, _, place, *_ in model.load_states}
    for name, one in hydraulic_cylinders(scene).items():
        full, rod = (float(state.values[places[f"{name}.{chamber}"]]) for chamber in CHAMBERS)
        across = one.internal_leakage * (full - rod)
        full_side = across + one.external_leakage * (full - one.tank_pressure)
        rod_side = one.external_leakage * (rod - one.tank_pressure) - across
        speed = max(abs(full_side) / one.full_area, abs(rod_side) / one.rod_side_area)
        if speed > LEAST_CREEP:
            warn_caller(
                f"{what}: hydraulic cylinder {name!r} leaks where it rests, by up to {60e3 * speed:.3g} mm a "
                "minute: what it holds creeps, until its control makes up for it. Set its internal_leakage "
                "and external_leakage to 0, or let a run settle first",
                CreepingRestWarning,
            )


def why_none(scene: Description, model: _core.Model, time: float, values: Array) -> str:
    """What still moves where the search ended, and the line that could hold it and is slack."""
    turned = most_turned(scene, model, values)
    if turned > LARGEST_HEEL:
        return (
            f"a vessel has turned by {np.degrees(turned):.0f} deg on the way, where restoring is not linear: "
            "it capsizes, or lacks ballast. Look at seacrane.statics(scene), add ballast "
            "(Scene.add_ballast), or lower the weights"
        )
    terms = Terms(model, time=time)
    acceleration, drift = terms.acceleration_and_drift(values)
    worst = int(np.argmax(np.abs(acceleration)))
    if abs(acceleration[worst]) <= STILL and drift.size:
        name, unit, place, *_ = model.load_states[int(np.argmax(np.abs(drift)))]
        rate = terms.evaluator.derivative(time, values)[place]
        return f"state {name!r} still changes by {rate:.3g} {unit}/s; correct what drives it"
    body = model.bodies[worst // 6]
    told = f"body {body!r} still accelerates by {acceleration[worst]:.3g} (m/s2 or rad/s2)"
    slack = _slack_on(scene, body, model, values)
    if slack:
        name, left = max(slack.items(), key=lambda one: one[1])
        return (
            f"{told}, and line {name!r}, which could hold it, is slack by {left:.3g} m in the pose that is "
            "tried; give it a length at which it is taut, or start from a state nearer to rest"
        )
    return f"{told}; start from a state nearer to rest, or hold what drifts"


def most_turned(scene: Description, model: _core.Model, values: Array) -> float:
    """By how much (rad) the vessel that heels and trims most leans from upright."""
    given = given_vessels(scene)
    upright = [
        1.0 - 2.0 * float(np.sum(np.square(values[at + 4 : at + 6])))
        for vessel in scene.vessels.values()
        if vessel.body not in given and np.any(np.asarray(vessel.restoring))
        for at in [model.pose_index(list(model.bodies).index(vessel.body))]
    ]
    return float(np.arccos(np.clip(min(upright, default=1.0), -1.0, 1.0)))


def _slack_on(scene: Description, body: str, model: _core.Model, values: Array) -> dict[str, float]:
    """The slack ones of the lines on a body; of all where none of its own is slack."""
    lines = lines_of(scene.loads)
    if not lines:
        return {}
    slack = slack_lines(scene, compile_scene(scene, merge=False), values)
    own = {name: left for name, left in slack.items() if body in lines[name].bodies}
    return own or slack
