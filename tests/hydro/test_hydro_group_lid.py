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
    water, omega = known_water(0.3), np.linspace(0.15, 2.2, 200)
    base = group_in(water)
    bodies = (base.bodies[0], replace(base.bodies[1], position=np.array([0.0, 19.0, 0.0])))
    place = replace(base, bodies=bodies).gaps()[0].piston
    row = np.sqrt(0.05 * INERTIA) * np.array([[0.6, 1.0, -0.5, 0.8]])
    gap = Oscillators(w=np.array([place]), dampers=np.array([[rate]]), coupling=row)
    kernel = water.transfer(omega) + gap.transfer(omega)
    added_mass, damping = np.zeros((2, len(omega), 12, 12))
    at = np.ix_(range(len(omega)), MOVING, MOVING)
    added_mass[at] = kernel.imag / omega[:, None, None]
    damping[at] = kernel.real
    pole = 1.0 / (place**2 - omega**2 + 1j * omega * rate)
    force = np.zeros((2, len(omega), 12), dtype=complex)
    force[:, :, MOVING] = 1e5 * np.exp(-omega)[None, :, None] + 2e2 * pole[None, :, None] * row
    tables = {"added_mass": added_mass + base.infinite_frequency_added_mass, "damping": damping}
    return replace(base, bodies=bodies, omega=omega, force=force, **tables)


def test_it_is_the_gap_with_that_damping() -> None:
    """Matrices, forces and motions are those of the oscillator whose damping grows by damping times w0."""
    bare = with_gap(LIGHT)
    peaks = [bare.damping[:, HEAVE, HEAVE].max()]
    for damping in (0.01, 0.03):
        truth, found = with_gap(LIGHT + damping * bare.gaps()[0].piston), bare.with_lid_damping(damping)
        assert found.lid_damping == damping
        for name in ("added_mass", "damping", "force", "motion_rao"):
            mine, its, before = (getattr(each, name) for each in (found, truth, bare))
            assert np.abs(mine - its).max() < 0.02 * np.abs(its - before).max(), name
        peaks.append(found.damping[:, HEAVE, HEAVE].max())
    assert peaks[0] > 1.3 * peaks[1] > 1.5 * peaks[2]
    assert np.linalg.eigvalsh(found.damping[:, MOVING][:, :, MOVING])[:, 0].min() > -1e-3 * peaks[0]


def test_what_cannot_have_a_lid_is_told() -> None:
    bare, every = with_gap(LIGHT), slice(None, None, 8)
    with pytest.raises(TypeError):
        bare.with_lid_damping()  # type: ignore[call-arg]
    with pytest.raises(SceneError, match="lid damping"):
        bare.with_lid_damping(-0.01)
    names = ("omega", "added_mass", "damping")
    coarse = replace(bare, **{name: getattr(bare, name)[every] for name in names}, force=bare.force[:, every])
    for group, message in (
        (replace(bare, lid_damping=0.02), "damping 0.02 already"),
        (group_in(known_water(0.3)), "no narrow peak"), (coarse, r"finer step|no narrow peak"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=message):
            group.with_lid_damping(0.02)
