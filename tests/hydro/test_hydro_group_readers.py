"""Files of two bodies: what was written comes back, and damage, order and places are told by name."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from group_cases import bemio_file, capytaine_dataset, capytaine_file, nemoh_folder, wamit_files, written_pair

from seacrane.errors import FileFormatError
from seacrane.hydro import (
    HydroGroup,
    load_database,
    load_hull,
    read_bemio_group,
    read_capytaine,
    read_capytaine_group,
    read_nemoh_group,
    read_wamit,
    read_wamit_group,
)
from seacrane.warnings import AssumedInertiaWarning, AssumedReferenceWarning, RoundedPhaseWarning

pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.RoughDataWarning")

Reader = Callable[..., HydroGroup]
FORMATS: dict[str, tuple[Callable[[HydroGroup, Path], Path], Reader]] = {
    "capytaine": (capytaine_file, read_capytaine_group),
    "wamit": (wamit_files, read_wamit_group),
    "nemoh": (nemoh_folder, read_nemoh_group),
    "bemio": (bemio_file, read_bemio_group),
}


@pytest.fixture(scope="module")
def pair() -> HydroGroup:
    return written_pair()


def masses(group: HydroGroup) -> dict[str, np.ndarray]:
    return {body.name: body.mass_matrix for body in group.bodies}


def assert_same(found: HydroGroup, group: HydroGroup, tolerance: float = 1e-9) -> None:
    """Numbers by each motion's own size; bodies by name, place and heading."""
    assert found.names == group.names
    scale = np.sqrt(np.abs(np.diagonal(group.added_mass, axis1=1, axis2=2)).max(axis=0))
    both = np.outer(scale, scale)
    assert found.omega == pytest.approx(group.omega, rel=1e-9)
    assert found.heading == pytest.approx(group.heading, abs=1e-9)
    for name in ("added_mass", "damping"):
        assert np.abs((getattr(found, name) - getattr(group, name)) / both).max() < tolerance
    largest = np.abs(group.force).max(axis=(0, 1))
    assert np.abs((found.force - group.force) / largest).max() < tolerance
    for mine, its in zip(found.bodies, group.bodies, strict=True):
        assert mine.position == pytest.approx(its.position, abs=1e-9)
        assert mine.heading == pytest.approx(its.heading, abs=1e-9)
        assert np.abs(mine.restoring - its.restoring).max() <= 1e-9 * np.abs(its.restoring).max()
        assert np.abs(mine.mass_matrix - its.mass_matrix).max() <= 1e-9 * np.abs(its.mass_matrix).max()


@pytest.mark.filterwarnings("ignore::seacrane.warnings.AssumedInertiaWarning")
@pytest.mark.parametrize("name", FORMATS)
def test_what_was_written_comes_back(name: str, pair: HydroGroup, tmp_path: Path) -> None:
    """Names, order, places, phases and which index is the load: coupling blocks are not symmetric here."""
    write, read = FORMATS[name]
    path = write(pair, tmp_path)
    given = {} if name == "capytaine" else {"mass_matrices": masses(pair)}
    assert_same(read(path, **given), pair)
    found = load_database(path)
    assert isinstance(found, HydroGroup) and found.names == pair.names
    with pytest.raises(FileFormatError, match="crane, feeder, and one hull"):
        load_hull(path)


def test_wamit_turned_and_by_its_listing_alone(pair: HydroGroup, tmp_path: Path) -> None:
    """PHIBODY: matrices and forces are in the body's own axes, phases stay at the global origin."""
    turned = written_pair(heading=np.pi)
    assert_same(read_wamit_group(wamit_files(turned, tmp_path), mass_matrices=masses(turned)), turned)
    for file in tmp_path.iterdir():
        file.unlink()
    path = wamit_files(pair, tmp_path, numbers=False)
    with pytest.warns(RoundedPhaseWarning, match="degrees"):
        found = read_wamit_group(path, mass_matrices=masses(pair))
    assert_same(replace(found, force=pair.force), pair)
    off = np.abs(found.force - pair.force) / np.maximum(np.abs(pair.force), 1e-300)
    assert 1e-4 < off.max() <= np.radians(0.5) + 1e-6


def test_rotation_centres_that_a_file_does_not_tell(pair: HydroGroup, tmp_path: Path) -> None:
    path = tmp_path / "silent.nc"
    capytaine_dataset(pair).drop_vars("rotation_center").to_netcdf(path)
    with pytest.warns(AssumedReferenceWarning, match="crane, feeder"):
        found = read_capytaine_group(path)
    assert not np.any([body.position for body in found.bodies])
    told = {body.name: body.position for body in pair.bodies}
    assert_same(read_capytaine_group(path, rotation_centres=told), pair)
    with pytest.raises(FileFormatError, match=r"rotation_centres .* crane"):
        read_capytaine_group(path, rotation_centres={"crane": (0.0, 0.0, 0.0)})


def test_hydrostatics_in_another_order_are_named(pair: HydroGroup, tmp_path: Path) -> None:
    """The files of two unlike bodies exchanged: a long wave lifts each with its own C33 alone."""
    bodies = (pair.bodies[0], replace(pair.bodies[1], restoring=2.0 * pair.bodies[1].restoring))
    unlike = replace(pair, bodies=bodies)
    force = pair.force.copy()
    force[:, :, 6:] *= 2.0
    force[:, 0, 2::6] = np.diag(unlike.restoring)[2::6]
    unlike = replace(unlike, omega=0.1 * pair.omega, force=force)
    folder = nemoh_folder(unlike, tmp_path)
    read_nemoh_group(folder, mass_matrices=masses(unlike))
    for source, target in (("Kh_0", "spare"), ("Kh_1", "Kh_0"), ("spare", "Kh_1")):
        shutil.move(folder / "Mesh" / f"{source}.dat", folder / "Mesh" / f"{target}.dat")
    with pytest.raises(FileFormatError, match=r"restoring of crane has C33 = .* of feeder"):
        read_nemoh_group(folder, mass_matrices=masses(unlike))


@pytest.mark.warns("AssumedInertiaWarning")
def test_damage_is_named(pair: HydroGroup, tmp_path: Path) -> None:
    given: dict[str, Any] = {"mass_matrices": masses(pair)}
    for damage, message in (
        (lambda d: d.isel(influenced_dof=slice(1, None)), "influenced_dof lacks crane__"),
        (lambda d: d.assign_coords(forward_speed=2.0), "forward_speed is 2"),
        (
            lambda d: d.assign(hydrostatic_stiffness=0.0 * d.hydrostatic_stiffness),
            "body crane: restoring C33",
        ),
    ):
        damage(capytaine_dataset(pair)).to_netcdf(tmp_path / "pair.nc")
        with pytest.raises(FileFormatError, match=rf"pair\.nc: .*{message}"):
            read_capytaine_group(tmp_path / "pair.nc")
    with pytest.raises(FileFormatError, match=r"crane, feeder.*read_capytaine_group"):
        read_capytaine(capytaine_file(pair, tmp_path))
    folder = wamit_files(pair, tmp_path)
    with pytest.raises(FileFormatError, match="motion 7 is not one of 1 to 6"):
        read_wamit(folder / "pair")
    nemoh_folder(pair, folder)
    for name, old, new, message, read in (
        ("pair.out", "YBODY", "Y", "no XBODY, .* of crane", read_wamit_group),
        ("pair.1", " 12 ", " 13 ", "motion 13 .* 1 to 12", read_wamit_group),
        ("Nemoh.cal", "2 ! Number", "3 ! Number", "3 bodies .* 12", read_nemoh_group),
        ("Nemoh.cal", "38.0", "39.0", "body 2 turn about 2", read_nemoh_group),
    ):
        file = folder / name
        sound = file.read_text()
        file.write_text(sound.replace(old, new, -1 if name == "pair.out" else 1))
        with pytest.raises(FileFormatError, match=message):
            read(folder, **given)
        file.write_text(sound)
    path = bemio_file(pair, tmp_path)
    with pytest.raises(FileFormatError, match=r"mass_matrices .* crane, barge"):
        read_bemio_group(path, mass_matrices={"crane": np.eye(6), "barge": np.eye(6)})
    with pytest.warns(AssumedInertiaWarning, match="no mass matrix of feeder"):
        found = read_bemio_group(path)
    assert found.mass_matrix[6, 6] == pytest.approx(pair.mass_matrix[6, 6])
