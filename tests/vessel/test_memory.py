"""Fluid memory in a run: states against direct convolution of the recorded velocity history."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from reference.convolution import memory_force
from reference.vessel import MemoryModel as ReferenceMemory

from seacrane import Result, Scene, cases, simulate
from seacrane.hydro import shipped_database, vessel_parameters
from seacrane.inputs.frames import rotation_matrix

Array = NDArray[np.float64]
STEP = 0.02  # s
CHANNELS = ["velocity", "angular_velocity", "quaternion", "acceleration", "angular_acceleration",
            "vessel_motion", "wave_force"]  # fmt: skip


def yaw_matrices(yaw: Array) -> Array:
    c, s, zero, one = np.cos(yaw), np.sin(yaw), np.zeros_like(yaw), np.ones_like(yaw)
    return np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]]).transpose(2, 0, 1)


def rotate_back(matrix: Array, vectors: Array) -> Array:
    return np.asarray(np.einsum("tji,tj->ti", matrix, vectors))


def run(scene: Scene, t_end: float) -> SimpleNamespace:
    """Motion, twist u and u' of the reference point in the yaw-following frame, wave load, all (n, 6), and
    `deck`: other loads on the vessel about that point in that frame."""
    lifts = "deck" in scene.joints
    channels = [*CHANNELS, "reaction_force", "reaction_moment"] if lifts else CHANNELS
    result = simulate(scene, t_end=t_end, dt_out=STEP, rtol=1e-10, channels=channels)
    rotation = rotation_matrix(result["quaternion"][:, 0])
    arm = rotation @ -scene.bodies["vessel"].center_of_mass
    w, alpha = result["angular_velocity"][:, 0], result["angular_acceleration"][:, 0]
    velocity = result["velocity"][:, 0] + np.cross(w, arm)
    acceleration = result["acceleration"][:, 0] + np.cross(alpha, arm) + np.cross(w, np.cross(w, arm))
    yaw = yaw_matrices(result["vessel_motion"][:, 5])
    twist = np.hstack([rotate_back(yaw, velocity), rotate_back(yaw, w)])
    pitch = result["vessel_motion"][:, 4]
    yaw_rate = twist[:, 5] + np.tan(pitch) * twist[:, 3]
    turn = np.column_stack([0.0 * yaw_rate, 0.0 * yaw_rate, yaw_rate])
    rate = np.hstack([rotate_back(yaw, acceleration), rotate_back(yaw, alpha)])
    rate -= np.hstack([np.cross(turn, twist[:, :3]), np.cross(turn, twist[:, 3:])])
    return SimpleNamespace(
        time=result.time, motion=result["vessel_motion"], twist=twist, twist_rate=rate, rotation=rotation,
        yaw=yaw, wave=result["wave_force"],
        deck=crane_loads(scene, result, rotation, yaw) if lifts else np.zeros_like(result["wave_force"]),
    )  # fmt: skip


def crane_loads(scene: Scene, result: Result, rotation: Array, yaw: Array) -> Array:
    """Minus the deck's reaction, and the balancing force, about the reference point, yaw frame (n, 6)."""
    reaction = result.select("reaction_force", joint="deck")
    foot = rotation @ scene.joints["deck"].first_frame.point
    balance = scene.point_forces["balance"]
    force = balance.force - reaction
    moment = np.cross(rotation @ balance.point, np.broadcast_to(balance.force, reaction.shape))
    moment -= result.select("reaction_moment", joint="deck") + np.cross(foot, reaction)
    return np.hstack([rotate_back(yaw, force), rotate_back(yaw, moment)])


def kernel_on_grid(count: int) -> Array:
    """K(t) = C exp(A t) B (count, 6, 6) of the fitted blocks, by the reference's own code."""
    from scipy.linalg import expm

    memory = ReferenceMemory.from_record({"blocks": [
        {"inputs": b.inputs, "outputs": b.outputs, "A": b.A, "B": b.B, "C": b.C, "D": b.D}
        for b in vessel_parameters(shipped_database()).memory.blocks
    ]})  # fmt: skip
    step, states = expm(memory.a * STEP), memory.b
    out = np.empty((count, 6, 6))
    for i in range(count):
        out[i] = memory.c @ states
        states = step @ states
    return out


def radiation_from_balance(waves: Any) -> Array:
    """Load -(A_inf u' + mu) on the vessel, as what the rigid-body equations leave of the recorded motion."""
    p = vessel_parameters(shipped_database())
    center = rotate_back(waves.yaw, waves.rotation @ p.center_of_mass)
    w, lever = waves.twist[:, 3:], center
    roll, pitch = waves.motion[:, 3], waves.motion[:, 4]
    c = p.restoring[2:5, 2:5]
    load = np.einsum("ij,tj->ti", c, np.column_stack([waves.motion[:, 2], roll, pitch]))
    restoring = np.zeros_like(waves.wave)
    restoring[:, 2], restoring[:, 3], restoring[:, 4] = load[:, 0], load[:, 1] / np.cos(pitch), load[:, 2]
    body = np.einsum("tji,tjk->tik", waves.yaw, waves.rotation)  # body to yaw frame
    inertia = body @ p.inertia @ body.transpose(0, 2, 1)
    turn = np.zeros_like(w)
    turn[:, 2] = w[:, 2] + np.tan(pitch) * w[:, 0]
    rate = waves.twist_rate[:, :3] + np.cross(turn, waves.twist[:, :3])
    alpha = waves.twist_rate[:, 3:] + np.cross(turn, w)
    force = p.mass * (rate + np.cross(alpha, lever) + np.cross(w, np.cross(w, lever)))
    spin = np.einsum("tij,tj->ti", inertia, w)
    moment = np.einsum("tij,tj->ti", inertia, alpha) + np.cross(w, spin) + np.cross(lever, force)
    rigid = np.hstack([force, moment])
    return np.asarray(rigid - waves.wave - waves.deck + restoring + waves.twist @ p.linear_damping.T)


def memory_error(waves: Any) -> Array:
    """Difference (6) between the memory load in a run and the convolution, over the load's largest value."""
    mu = memory_force(waves.twist, kernel_on_grid(len(waves.time)), STEP)
    added_mass = vessel_parameters(shipped_database()).added_mass
    found = -radiation_from_balance(waves) - waves.twist_rate @ added_mass.T
    return np.asarray(np.max(np.abs(found - mu), axis=0) / np.max(np.abs(mu), axis=0))


@pytest.mark.parametrize(
    ("scene", "t_end"),
    [(lambda: cases.vessel(mooring_period=None), 60.0), (lambda: cases.case2(mooring_period=None), 30.0)],
    ids=["alone", "under the crane"],
)
def test_states_equal_convolution_with_the_fitted_kernel(scene: Any, t_end: float) -> None:
    """mu(t) = int K(t - tau) u(tau) dtau, K = C exp(A t) B, of the whole recorded history; in case 2 with
    the deck's reaction and the balancing force."""
    np.testing.assert_array_less(memory_error(run(scene(), t_end)), 3e-5)
