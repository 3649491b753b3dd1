"""BEMIO reader: files that we write after the format's description, whole and damaged."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroDatabase, load_database, read_bemio, shipped_database
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import AssumedInertiaWarning

HEIGHT = 1.9  # m, of the centre of gravity
BODY = "body1/hydro_coeffs"


def shipped_part() -> HydroDatabase:
    """Some frequencies and headings of the shipped hull, at rest in 40 m of water, without its memory."""
    return shipped_database().select(every=6, every_heading=3)


def bemio_values(base: HydroDatabase, along: float = 0.0) -> dict[str, Any]:
    """Entries of a BEMIO file of a vessel whose centre of gravity is ``along`` m from the waves' origin."""
    low, rho, g = base.at((0.0, 0.0, HEIGHT)), base.rho, base.g
    k = wavenumber(base.omega, g=g, depth=base.depth)
    force = low.force * np.exp(-1j * along * np.outer(np.cos(base.heading), k))[:, :, None]
    backwards = slice(None, None, -1)  # periods rise in a file
    parts = force[:, backwards].transpose(2, 0, 1) / (rho * g)
    damping = low.damping / base.omega[:, None, None] / rho
    return {
        "simulation_parameters/rho": rho,
        "simulation_parameters/g": g,
        "simulation_parameters/scaled": 0.0,
        "simulation_parameters/water_depth": b"infinite",
        "simulation_parameters/w": base.omega[backwards],
        "simulation_parameters/wave_dir": np.degrees(base.heading),
        "body1/properties/cg": np.array([along, 0.0, HEIGHT]),
        "body1/properties/disp_vol": base.mass_matrix[0, 0] / rho,
        f"{BODY}/added_mass/all": low.added_mass[backwards].transpose(1, 2, 0) / rho,
        f"{BODY}/added_mass/inf_freq": low.infinite_frequency_added_mass / rho,
        f"{BODY}/radiation_damping/all": damping[backwards].transpose(1, 2, 0),
        f"{BODY}/linear_restoring_stiffness": low.restoring / (rho * g),
        f"{BODY}/excitation/re": parts.real,
        f"{BODY}/excitation/im": parts.imag,
    }


def written(values: dict[str, Any], path: Path) -> Path:
    """A file of these entries."""
    with h5py.File(path, "w") as file:
        for name, value in values.items():
            file[name] = value
    return path


@pytest.mark.parametrize("along", [0.0, 12.5])
def test_what_was_written_comes_back(along: float, tmp_path: Path) -> None:
    """Scales, order, phases of an origin elsewhere, from the centre of gravity to the waterline."""
    base = shipped_part()
    path = written(bemio_values(base, along), tmp_path / "ship.h5")
    with pytest.warns(AssumedInertiaWarning, match="BEMIO file holds no mass matrix, pass mass_matrix"):
        found = load_database(path)
    for name in ("omega", "heading", "added_mass", "damping", "infinite_frequency_added_mass", "restoring"):
        mine, theirs = getattr(found, name), getattr(base, name)
        assert np.abs(mine - theirs).max() <= 1e-12 * np.abs(theirs).max(), name
    assert np.abs(found.force - base.force).max() <= 1e-11 * np.abs(base.force).max()
    assert (found.rho, found.g, found.depth) == (base.rho, base.g, np.inf)
    assert found.port_starboard_symmetric
    assert found.mass_matrix[0, 0] == pytest.approx(base.mass_matrix[0, 0])
    assert found.mass_matrix[0, 4] == pytest.approx(HEIGHT * base.mass_matrix[0, 0])
    values = bemio_values(base, along) | {"simulation_parameters/water_depth": 40.0}
    mass = base.at((0.0, 0.0, HEIGHT)).mass_matrix
    found = read_bemio(written(values, path), mass_matrix=mass)
    assert np.abs(found.mass_matrix - base.mass_matrix).max() <= 1e-9 * np.abs(base.mass_matrix).max()
    assert found.depth == 40.0


def test_damage_is_named(tmp_path: Path) -> None:
    base, path, of = shipped_part(), tmp_path / "ship.h5", "simulation_parameters"
    sound = bemio_values(base)
    for name, value, message in (
        (f"{of}/rho", None, "simulation_parameters/rho is missing"), (f"{of}/scaled", 1.0, "scaled is set"),
        ("body2/properties/dof", 6, "body1, body2; one body"), (f"{of}/water_depth", b"deep", "b'deep'"),
        (f"{of}/w", np.ones(3), r"shape \(6, 6, "),
    ):  # fmt: skip
        values = {key: one for key, one in (sound | {name: value}).items() if one is not None}
        with pytest.raises(FileFormatError, match=rf"ship\.h5: .*{message}"):
            read_bemio(written(values, path), mass_matrix=base.mass_matrix)
