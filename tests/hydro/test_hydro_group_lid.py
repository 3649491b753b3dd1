"""A damping lid put into results without one: exact where the gap is an oscillator."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from test_hydro_group_memory import HEAVE, INERTIA, MOVING, group_in, known_water

from seacrane.errors import SceneError
from seacrane.hydro import HydroGroup
from seacrane.hydro.memory.oscillators import Oscillators

LIGHT = 0.02  # damping of the gap's water, 1/s


def with_gap(rate: float) -> HydroGroup:
    """Two hulls whose gap is an oscillator at its piston frequency, moved by both and by the waves."""
    base = group_in(known_water(0.3))
    omega = np.linspace(0.15, 2.2, 200)
    bodies = (base.bodies[0], replace(base.bodies[1], position=np.array([0.0, 19.0, 0.0])))
    place = replace(base, bodies=bodies).gaps()[0].piston
    row = np.sqrt(0.05 * INERTIA) * np.array([[0.6, 1.0, -0.5, 0.8]])
    gap = Oscillators(w=np.array([place]), dampers=np.array([[rate]]), coupling=row)
    water = known_water(0.3)
    kernel = water.transfer(omega) + gap.transfer(omega)
    added_mass, damping = np.zeros((2, len(omega), 12, 12))
    at = np.ix_(range(len(omega)), MOVING, MOVING)
    assert base.infinite_frequency_added_mass is not None
    added_mass[at] = kernel.imag / omega[:, None, None]
    damping[at] = kernel.real
    pole = 1.0 / (place**2 - omega**2 + 1j * omega * rate)
    force = np.zeros((2, len(omega), 12), dtype=complex)
    force[:, :, MOVING] = 1e5 * np.exp(-omega)[None, :, None] + 2e2 * pole[None, :, None] * row
    return replace(
        base,
        bodies=bodies,
        omega=omega,
        added_mass=added_mass + base.infinite_frequency_added_mass,
        damping=damping,
        force=force,
    )


@pytest.mark.parametrize("damping", [0.01, 0.03])
def test_it_is_the_gap_with_that_damping(damping: float) -> None:
    """Matrices, forces and motions are those of the oscillator whose damping grows by damping times w0."""
    bare = with_gap(LIGHT)
    piston = bare.gaps()[0].piston
    truth = with_gap(LIGHT + damping * piston)
    found = bare.with_lid_damping(damping)
    assert found.lid_damping == damping
    for name in ("added_mass", "damping", "force", "motion_rao"):
        mine, its, before = (getattr(each, name) for each in (found, truth, bare))
        change = np.abs(its - before).max()
        assert np.abs(mine - its).max() < 0.02 * change, name


def test_more_damping_lowers_the_peak_and_the_work_stays_positive() -> None:
    bare = with_gap(LIGHT)
    peaks = [
        group.damping[:, HEAVE, HEAVE].max() for group in (bare, *map(bare.with_lid_damping, (0.01, 0.03)))
    ]
    assert peaks[0] > 1.3 * peaks[1] > 1.5 * peaks[2]
    lowest = np.linalg.eigvalsh(bare.with_lid_damping(0.03).damping[:, MOVING][:, :, MOVING])[:, 0]
    assert lowest.min() > -1e-3 * peaks[0]


def test_what_cannot_have_a_lid_is_told() -> None:
    bare = with_gap(LIGHT)
    with pytest.raises(TypeError):
        bare.with_lid_damping()  # type: ignore[call-arg]
    with pytest.raises(SceneError, match="lid damping"):
        bare.with_lid_damping(-0.01)
    with pytest.raises(ValueError, match=r"a lid of damping 0.02 already"):
        replace(bare, lid_damping=0.02).with_lid_damping(0.02)
    with pytest.raises(ValueError, match=r"no narrow peak .* a lid has nothing to damp"):
        group_in(known_water(0.3)).with_lid_damping(0.02)
    every = slice(None, None, 8)
    coarse = replace(
        bare,
        omega=bare.omega[every],
        added_mass=bare.added_mass[every],
        damping=bare.damping[every],
        force=bare.force[:, every],
    )
    with pytest.raises(ValueError, match=r"compute with a finer step|no narrow peak"):
        coarse.with_lid_damping(0.02)
