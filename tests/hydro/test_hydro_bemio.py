"""BEMIO reader: files that we write after the format's description, whole and damaged."""

from __future__ import annotations

from collections.abc import Callable
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
    low = base.at((0.0, 0.0, HEIGHT))
    rho, g = base.rho, base.g
    k = wavenumber(base.omega, g=g, depth=base.depth)
    force = low.force * np.exp(-1j * along * np.outer(np.cos(base.heading), k))[:, :, None]
    backwards = slice(None, None, -1)  # periods rise in a file
    parts = force[:, backwards].transpose(2, 0, 1) / (rho * g)
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
        f"{BODY}/radiation_damping/all": (low.damping / base.omega[:, None, None])[backwards].transpose(
            1, 2, 0
        )
        / rho,
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


def test_motions_are_those_of_the_database_it_was_written_from(tmp_path: Path) -> None:
    base = shipped_part()
    path = written(bemio_values(base), tmp_path / "ship.h5")
    found = read_bemio(path, mass_matrix=base.at((0.0, 0.0, HEIGHT)).mass_matrix)
    assert np.abs(found.mass_matrix - base.mass_matrix).max() <= 1e-9 * np.abs(base.mass_matrix).max()


def test_water_of_a_depth(tmp_path: Path) -> None:
    base = shipped_part()
    values = bemio_values(base) | {"simulation_parameters/water_depth": 40.0}
    with pytest.warns(AssumedInertiaWarning):
        assert read_bemio(written(values, tmp_path / "ship.h5")).depth == 40.0


@pytest.mark.parametrize(
    ("damage", "message"),
    [
        (lambda v: v.pop("simulation_parameters/rho"), "simulation_parameters/rho is missing"),
        (lambda v: v.pop(f"{BODY}/added_mass/all"), "added_mass/all is missing"),
        (lambda v: v.update({"body2/properties/dof": 6}), "holds body1, body2; one body is read"),
        (lambda v: v.update({"simulation_parameters/scaled": 1.0}), "scaled is set"),
        (lambda v: v.update({"simulation_parameters/rho": -1.0}), "rho is -1 kg/m3"),
        (lambda v: v.update({"simulation_parameters/g": np.ones(2)}), "g has 2 values"),
        (lambda v: v.update({"simulation_parameters/water_depth": b"deep"}), "water_depth is b'deep'"),
        (lambda v: v.update({"simulation_parameters/w": np.ones(3)}), r"added_mass/all has shape \(6, 6, "),
        (lambda v: v.update({f"{BODY}/excitation/re": np.ones((6, 1, 1))}), r"re has shape \(6, 1, 1\)"),
        (lambda v: v.update({f"{BODY}/added_mass/inf_freq": np.full((6, 6), np.nan)}), "nan"),
    ],
)
def test_damage_is_named(damage: Callable[[dict[str, Any]], Any], message: str, tmp_path: Path) -> None:
    values = bemio_values(shipped_part())
    damage(values)
    mass = shipped_part().mass_matrix
    with pytest.raises(FileFormatError, match=rf"ship\.h5: .*{message}"):
        read_bemio(written(values, tmp_path / "ship.h5"), mass_matrix=mass)


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=r"none\.h5: no such file"):
        read_bemio(tmp_path / "none.h5")
    whole = written(bemio_values(shipped_part()), tmp_path / "ship.h5").read_bytes()
    for part in (0.0, 0.3, 0.9):
        (tmp_path / "cut.h5").write_bytes(whole[: int(part * len(whole))])
        with pytest.raises(FileFormatError, match=r"cut\.h5"):
            read_bemio(tmp_path / "cut.h5")
        with pytest.raises(FileFormatError, match=r"cut\.h5"):
            load_database(tmp_path / "cut.h5")
