"""The paper's kinematics, equations (17)-(31), against numerical derivatives and against the default."""

from __future__ import annotations

import numpy as np
import pytest
from reference.rotation import quaternions_from_matrices
from scipy.spatial.transform import Rotation

from seacrane import Scene, cases, simulate
from seacrane.analysis import Evaluator
from seacrane.arrays import Array
from seacrane.hydro import shipped_database, vessel_parameters
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix

PHI = np.array([0.21, -0.17, 0.4])
RATE = np.array([0.11, 0.07, -0.13])
ORIGIN_RATE = np.array([0.8, -0.5, 0.3])


def euler_matrix(phi: Array) -> Array:
    """Rx Ry Rz, body to inertial."""
    return Rotation.from_euler("XYZ", phi).as_matrix()


def numerical_rate_matrix(phi: Array) -> Array:
    """T^-1: columns are omega for unit rates, from S(omega) = dR/dphi R^T by central differences."""
    rotation, out, step = euler_matrix(phi), np.empty((3, 3)), 1e-5
    for i, direction in enumerate(np.eye(3)):
        change = (euler_matrix(phi + step * direction) - euler_matrix(phi - step * direction)) / (2.0 * step)
        spin = change @ rotation.T
        out[:, i] = spin[2, 1], spin[0, 2], spin[1, 0]
    return out


def equation_20(phi: Array, corner: float = 1.0) -> Array:
    """omega = T^-1 phidot; as printed, entry (1, 3) is 0 where sin(phi_y) belongs: `corner` 0."""
    cx, sx, cy, sy = np.cos(phi[0]), np.sin(phi[0]), np.cos(phi[1]), np.sin(phi[1])
    return np.array([[1.0, 0.0, corner * sy], [0.0, cx, -sx * cy], [0.0, sx, cx * cy]])


def equation_22(phi: Array, rate: Array, corner: float, step: float = 1e-6) -> Array:
    """d(T^-1)/dt along phidot."""
    ahead, behind = (equation_20(phi + sign * step * rate, corner) for sign in (1.0, -1.0))
    return np.asarray((ahead - behind) / (2.0 * step))


def test_equation_20_against_a_numerical_derivative() -> None:
    """The corrected matrix is right, the printed one is not."""
    exact = numerical_rate_matrix(PHI)
    np.testing.assert_allclose(equation_20(PHI), exact, atol=1e-9)
    assert np.max(np.abs(equation_20(PHI, 0.0) - exact)) == pytest.approx(abs(np.sin(PHI[1])), rel=1e-6)


def test_engines_euler_angle_rates_use_the_corrected_matrix() -> None:
    scene = Scene(orientation="euler_xyz", gravity=0.0)
    scene.add_body(name="body", mass=1.0, inertia=(1.0, 2.0, 3.0))
    model = scene.compile()
    y, at, twist = np.array(model.initial_state), model.pose_index(0), model.twist_index(0)
    omega = np.array([0.3, -0.2, 0.5])
    y[at + 3 : at + 6], y[twist + 3 : twist + 6] = PHI, omega
    rate = Evaluator(model).derivative(0.0, y)[at + 3 : at + 6]
    np.testing.assert_allclose(numerical_rate_matrix(PHI) @ rate, omega, atol=1e-9)


def paper_acceleration(position: Array, memory_load: Array, corner: float = 1.0) -> Array:
    """[rddot; omegadot] of the vessel alone from equations (17)-(31)."""
    p, vessel = vessel_parameters(shipped_database()), cases.vessel(kinematics="paper").vessels["vessel"]
    to_rates = np.linalg.inv(equation_20(PHI, corner))
    eta_rate = np.concatenate([ORIGIN_RATE, RATE])
    total = rigid_mass_matrix(p.mass, p.center_of_mass, p.inertia) + p.added_mass
    wide = np.zeros((6, 6))
    wide[:3, :3], wide[3:, 3:] = np.eye(3), to_rates
    turning = to_rates @ equation_22(PHI, RATE, corner) @ RATE
    b0 = total @ np.concatenate([np.zeros(3), turning])
    eta = np.concatenate([position, PHI])
    load = -p.linear_damping @ eta_rate - p.restoring @ eta - memory_load
    load -= p.quadratic_damping * np.abs(eta_rate) * eta_rate
    for k, i in enumerate((0, 1, 5)):
        load[i] -= vessel.mooring_stiffness[k] * eta[i] + vessel.mooring_damping[k] * eta_rate[i]
    return np.asarray(np.linalg.solve(total @ wide, load + b0))


def engine_rates(memory: str) -> tuple[Array, Array, Array]:
    """Position, derivative of the twist, and the memory load at one state far from rest."""
    model = cases.vessel(kinematics="paper", hs=0.0, memory=memory).compile()
    y = np.array(model.initial_state)
    at, twist = model.pose_index(0), model.twist_index(0)
    position = np.array([1.2, -0.7, 0.4])
    y[at : at + 7] = [*position, *quaternions_from_matrices(euler_matrix(PHI))]
    y[twist : twist + 6] = [*ORIGIN_RATE, *(equation_20(PHI) @ RATE)]
    load, offset = np.zeros(6), twist + 6
    if memory != "none":
        states = np.sin(np.arange(model.memory_states)) * model.scale[offset : offset + model.memory_states]
        y[offset : offset + model.memory_states] = states
        for block in vessel_parameters(shipped_database()).memory.blocks:
            x, states = states[: len(block.A)], states[len(block.A) :]
            load[block.outputs] += block.C @ x + block.D @ np.concatenate([ORIGIN_RATE, RATE])[block.inputs]
        assert np.max(np.abs(load)) > 1e5
    return position, Evaluator(model).derivative(0.0, y)[twist : twist + 6], load


@pytest.mark.parametrize("memory", ["none", "per-pair"])
def test_engine_evaluates_the_papers_equations(memory: str) -> None:
    """Accelerations at one state by NumPy; the printed equations (20) and (22) would give others."""
    position, found, load = engine_rates(memory)
    expected = paper_acceleration(position, load)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-9)
    printed = paper_acceleration(position, load, 0.0)
    assert np.max(np.abs(printed - expected)[3:]) > 0.01 * np.max(np.abs(expected[3:]))


def test_forms_agree_at_small_amplitude_and_part_with_its_square() -> None:
    apart = []
    for hs in (0.01, 0.1, 1.0):
        default, paper = (
            simulate(cases.vessel(kinematics=kind, hs=hs), t_end=60.0, rtol=1e-9)
            for kind in ("yaw_following", "paper")
        )
        motion = default["vessel_motion"]
        apart.append(np.max(np.abs(paper["vessel_motion"] - motion), axis=0))
        assert hs > 0.01 or np.all(apart[0] < 2e-3 * np.max(np.abs(motion), axis=0))
    assert "energy_balance" in default.channels and "energy_balance" not in paper.channels  # is not defined
    order = np.diff(np.log10(apart), axis=0)
    assert np.all((order > 1.8) & (order < 2.2))
