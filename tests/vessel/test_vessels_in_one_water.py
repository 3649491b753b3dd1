"""Vessels that feel each other's motions: against single ones, each other, and the frequency domain."""

from __future__ import annotations

import warnings
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Scene, SceneError, linear_model, motion_rao, natural_modes, simulate
from seacrane.analysis import response_summed
from seacrane.analysis.hull_range import gap_between, relative_findings
from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroDatabase,
    HydroGroup,
    fit_memory,
    passivity_certificate,
    shipped_database,
    two_barges,
)
from seacrane.hydro.data.memory_model import MODEL_MATRICES, MemoryBlock, MemoryModel
from seacrane.hydro.memory.certificate import independent_blocks
from seacrane.inputs.frames import rotation_matrix
from seacrane.warnings import RelativePlaceWarning

MIRROR = np.diag([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])  # about the plane between two hulls side by side
FAR = 60.0  # m
STEPS: dict[str, Any] = {"integrator": "rk4", "dt": 0.1}
SEA: dict[str, Any] = {"hs": 2.0, "tp": 9.0, "count": 15, "seed": 4, "direction_deg": 130.0}


@lru_cache(maxsize=1)
def hull() -> HydroDatabase:
    database = replace(shipped_database(), additional=(), roll_damping=None)
    return replace(database, memory=fit_memory(database=database, kind="by-motion"))


def of_two(memory: MemoryModel) -> MemoryModel:
    """The memory of two hulls alike that do not feel each other."""
    blocks = [replace(b, outputs=b.outputs + i, inputs=b.inputs + i) for i in (0, 6) for b in memory.blocks]
    whole = {key: np.kron(np.eye(2), getattr(memory, key)) for key in MODEL_MATRICES}
    return replace(memory, blocks=tuple(blocks), motion=None, rows=(), **whole)


@lru_cache(maxsize=1)
def apart() -> HydroGroup:
    """Two hulls that do not feel each other, the second turned."""
    group = HydroGroup.from_databases(
        databases={"a": hull(), "b": hull()},
        positions={"a": (0.0, 0.5 * FAR, 0.0), "b": (10.0, -0.5 * FAR, 0.0)},
    )
    return replace(group, memory=of_two(hull().memory))


def mixed(share: float = 0.2) -> HydroGroup:
    """The same whose hulls take a share of each other's mirrored motions along in the water.

    With T = I + share P the added mass is T^T A T, the damping and the memory alike: passive as before.
    """
    whole = apart()
    mix = np.eye(12) + share * np.kron([[0.0, 1.0], [1.0, 0.0]], MIRROR)
    memory = of_two(hull().memory)
    blocks = []
    for block in memory.blocks:
        b, c = np.zeros((len(block.A), 12)), np.zeros((12, len(block.A)))
        b[:, block.inputs], c[block.outputs] = block.B, block.C
        every = np.arange(12)
        blocks.append(
            replace(block, inputs=every, outputs=every, B=b @ mix, C=mix.T @ c, D=np.zeros((12, 12)))
        )
    matrices = {key: mix.T @ getattr(memory, key) @ mix for key in MODEL_MATRICES}
    coupled = replace(memory, blocks=tuple(blocks), **matrices)
    tables = {key: mix.T @ getattr(whole, key) @ mix for key in ("added_mass", "damping")}
    limit = whole.infinite_frequency_added_mass
    return replace(whole, **tables, memory=coupled, infinite_frequency_added_mass=mix.T @ limit @ mix)


def afloat(group: HydroGroup, *, sea: dict[str, Any] | None = None, **more: Any) -> Scene:
    scene = Scene(name="pair")
    scene.add_vessel(group, **more)
    for name in scene.vessels if sea is not None else ():
        scene.add_sea(vessel=name, **(sea or {}))
    return scene


def linear(group: HydroGroup) -> HydroGroup:
    """Without what is quadratic in speeds."""
    return replace(group, bodies=tuple(replace(body, quadratic_damping=np.zeros(6)) for body in group.bodies))


def motion(scene: Scene, name: str, t_end: float = 20.0, **method: Any) -> Array:
    with warnings.catch_warnings(action="ignore"):
        result = simulate(scene, t_end=t_end, dt_out=0.5, channels=["vessel_motion"], **method)
    return np.asarray(result["vessel_motion"])[:, list(scene.vessels).index(name)]


def test_without_coupling_it_is_two_single_vessels() -> None:
    together = afloat(apart(), sea=SEA, position=(3.0, -2.0, 0.0), heading_deg=25.0)
    single = Scene(name="single")
    for body in ("a", "b"):
        start = together.bodies[body]
        single.add_vessel(hull(), name=body, position=start.position, heading_deg=25.0)
        single.add_sea(vessel=body, **SEA)
    for body in ("a", "b"):
        found, expected = motion(together, body, **STEPS), motion(single, body, **STEPS)
        assert np.abs(expected).max() > 0.1
        np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-10)


def test_coupling_is_felt_and_both_formulations_agree() -> None:
    scene = afloat(mixed(), sea=SEA, heading_deg=25.0)
    redundant = motion(scene, "a", formulation="redundant", **STEPS)
    recursive = motion(scene, "a", formulation="recursive", **STEPS)
    np.testing.assert_allclose(recursive, redundant, rtol=0.0, atol=1e-9)
    assert np.abs(redundant - motion(afloat(apart(), sea=SEA, heading_deg=25.0), "a", **STEPS)).max() > 0.01


def test_other_names_in_another_order_and_files_move_alike(tmp_path: Path) -> None:
    group, scenes = mixed(), {}
    one = scenes["a", "b"] = afloat(group, sea=SEA)
    scenes["ship", "barge"] = afloat(group.ordered(["b", "a"]), sea=SEA, names=["barge", "ship"])
    one.save(tmp_path / "pair.json")
    scenes["a", "b"] = Scene.load(tmp_path / "pair.json")
    assert scenes["a", "b"] == one and scenes["a", "b"].groups["group"] == one.groups["group"]
    for names, scene in scenes.items():
        for name, called in zip(("a", "b"), names, strict=True):
            found, expected = motion(scene, called, **STEPS), motion(one, name, **STEPS)
            np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-10)
    with pytest.raises(SceneError, match="group 'group'"):
        one.remove("b", kind="vessel")


def test_a_free_pair_keeps_its_energy() -> None:
    undamped = {"linear_damping": np.zeros((6, 6)), "quadratic_damping": np.zeros(6)}
    group = replace(mixed(), bodies=tuple(replace(body, **undamped) for body in apart().bodies))
    scene = Scene(name="free")
    scene.add_vessel(group, memory="none", mooring=None)
    velocities = {"a": (1.0, -0.5, 0.3), "b": (-0.4, 0.2, 0.6)}
    for name, velocity in velocities.items():
        turning = (0.02, -0.01, 0.03)
        scene.replace(name, kind="body", velocity=velocity, angular_velocity=turning)
    with warnings.catch_warnings(action="ignore"):
        result = simulate(scene, t_end=30.0, dt_out=1.0, rtol=1e-10, channels=["energy_balance"])
    speed = np.array([*velocities["a"]])
    energy = 0.5 * float(scene.bodies["a"].mass) * float(speed @ speed)
    assert np.abs(result["energy_balance"]).max() < 1e-8 * energy


@pytest.mark.parametrize("body", ["a", "b"])
def test_small_waves_move_it_as_the_coupled_frequency_domain(body: str) -> None:
    """What is of second order in the wave is taken away by a wave of twice the height."""
    found, expected = [], []
    for hs in (1e-3, 2e-3):
        wave = {"hs": hs, "tp": 8.0, "count": 1, "seed": 2, "direction_deg": 60.0}
        scene = afloat(linear(mixed()), sea=wave, heading_deg=25.0)
        model = linear_model(scene, vessel="a")
        centre = scene.bodies[body].center_of_mass
        summed = response_summed(model, body=body, point=centre)
        with warnings.catch_warnings(action="ignore"):
            result = simulate(
                scene, t_end=40.0, dt_out=1.0, rtol=1e-13, start=model.full_state(summed.state_at(0.0)),
                channels=["position", "quaternion"],
            )  # fmt: skip
        start = scene.bodies[body].position + rotation_matrix(scene.bodies[body].quaternion) @ centre
        found.append((np.asarray(result.place_of(body, point=centre)) - start) / hs)
        expected.append(summed.at(np.asarray(result.time))[:, :3] / hs)
    largest = np.abs(expected[0]).max()
    np.testing.assert_allclose(expected[1], expected[0], rtol=0.0, atol=1e-12 * largest)
    np.testing.assert_allclose(2.0 * found[0] - found[1], expected[0], rtol=0.0, atol=1e-6 * largest)
    amplitude, omega = float(scene.waves.amplitude[0]), float(scene.waves.omega[0])
    rao = motion_rao(model, omega=omega, direction=np.radians(60.0 - 25.0), body=body, point=centre)
    np.testing.assert_allclose(np.abs(rao) * amplitude, np.abs(summed.amplitude[0]), rtol=1e-9)


def scaled(factor: float) -> HydroDatabase:
    """A hull whose motions move the water by another factor."""
    memory = hull().memory
    parts = ("added_mass", "additional_added_mass", "additional_stiffness")
    blocks = tuple(replace(one, B=factor * one.B, C=factor * one.C) for one in memory.blocks)
    masses = {key: factor**2 * getattr(memory, key) for key in parts}
    return replace(hull(), memory=replace(memory, blocks=blocks, **masses))


@pytest.mark.warns("MemoryMismatchWarning")
def test_natural_modes_are_those_of_hulls_that_move_alike_and_against_each_other() -> None:
    """T of a mirrored motion is 1 + share times it, of one against it 1 - share: two single hulls."""
    share = 0.2
    found = natural_modes(afloat(linear(mixed(share)), mooring=None)).eigenvalues
    expected = []
    for factor in (1.0 + share, 1.0 - share):
        single = Scene(name="single")
        single.add_vessel(replace(scaled(factor), quadratic_damping=np.zeros(6)), mooring=None)
        expected.append(natural_modes(single).eigenvalues)
    both = np.sort_complex(np.concatenate(expected))
    np.testing.assert_allclose(np.sort_complex(found), both, rtol=1e-6)


def test_a_vessel_tied_to_another_needs_the_redundant_form_and_what_cannot_be_is_refused() -> None:
    tied = afloat(mixed())
    tied.add_joint(kind="spherical", name="tie", first="a", second="b", point=(5.0, 0.0, 0.0))
    assert np.all(np.isfinite(motion(tied, "b", t_end=1.0)))
    first, second = apart().bodies
    higher = replace(first, position=np.add(first.position, (0.0, 0.0, 1.0)))
    for call, message in (
        (lambda: simulate(tied, t_end=1.0, formulation="recursive"), "does not float freely"),
        (lambda: afloat(replace(apart(), bodies=(higher, second))), "'a' is 1 m above"),
        (lambda: afloat(apart(), memory="convolution"), "memory 'convolution'"),
        (lambda: linear_model(afloat(mixed()), vessel="a", memory="database"), "of group 'group'"),
    ):
        with pytest.raises(SceneError, match=message):
            call()


def test_leaving_the_place_beside_each_other_is_named() -> None:
    scene = afloat(apart())
    gap = gap_between(scene, "a", "b")
    assert gap == pytest.approx(FAR - hull().breadth)
    time = np.linspace(0.0, 100.0, 201)
    together, swing = np.zeros((201, 2, 6)), np.zeros((201, 2, 6))
    together[:, :, 1] = 20.0  # both drift alike
    swing[:, 1, 1] = 0.3 * gap * np.sin(2.0 * np.pi * time / 10.0)  # with the waves, not on the average
    for moved in (together, swing):
        assert not list(relative_findings(scene, time, {"vessel_motion": moved}))
    for motion_of, size, told in ((1, 0.11 * gap, "a tenth of the gap"), (5, np.radians(2.1), "2.1 deg")):
        away = swing.copy()
        away[:, 1, motion_of] += size
        ((kind, message),) = relative_findings(scene, time, {"vessel_motion": away})
        assert kind is RelativePlaceWarning and told in message


@pytest.mark.parametrize("lid", [None, 0.03])
def test_their_memory_is_passive_and_near_their_matrices(lid: float | None) -> None:
    group = two_barges(lid_damping=lid)
    assert passivity_certificate(group.memory).passive
    assert group.memory.motion.error.worst < 0.035
    assert group.lid_damping == lid
    coupling = np.abs(group.damping[:, :6, 6:]).max()
    assert coupling == 0.0 if lid is None else coupling > 0.02 * np.abs(group.damping[:, :6, :6]).max()
    for body, volume in zip(group.bodies, (100.0 * 25.0 * 5.5, 60.0 * 18.0 * 3.5), strict=True):
        assert body.mass_matrix[0, 0] == pytest.approx(1025.0 * volume, rel=1e-12)
        assert body.restoring[2, 2] * body.draught == pytest.approx(1025.0 * 9.81 * volume, rel=1e-6)


def test_a_group_is_kept_and_a_file_of_none_refused(tmp_path: Path) -> None:
    path, group = tmp_path / "pair.hydro", two_barges(lid_damping=0.01)
    group.save(path)
    again = HydroGroup.load(path)
    assert again.digest == group.digest
    assert replace(again, rho=1000.0).digest != group.digest
    data = path.read_bytes()
    other = data.replace(b"group 1\n", b"group 2\n", 1)
    for damaged, message in ((other, "version '2'"), (data[:-20], "group of seacrane")):
        path.write_bytes(damaged)
        with pytest.raises(FileFormatError, match=f"pair.hydro.*{message}"):
            HydroGroup.load(path)


def test_blocks_whose_states_do_not_feel_each_other_make_the_same_loads() -> None:
    def transfer(block: MemoryBlock, omega: float) -> Any:
        return block.C @ np.linalg.solve(1j * omega * np.eye(len(block.A)) - block.A, block.B) + block.D

    one = two_barges(lid_damping=0.03).memory.blocks[0]
    block = replace(
        one, A=np.kron(np.eye(2), one.A), B=np.vstack([one.B, 0.5 * one.B]), C=np.hstack([one.C, one.C]),
        state_scale=np.tile(one.state_scale, 2),
    )  # fmt: skip
    parts = independent_blocks(block)
    assert [len(part.A) for part in parts] == [len(one.A)] * 2
    for omega in (0.0, 0.7, 3.0):
        whole, apart = transfer(block, omega), sum(transfer(part, omega) for part in parts)
        np.testing.assert_allclose(apart, whole, rtol=0.0, atol=1e-12 * np.abs(whole).max())
