"""Hydrodynamic data that contradict themselves, each other or the scene: an exception or a named warning."""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Scene
from seacrane.hydro import (
    AdditionalMatrices,
    HydroDatabase,
    MemoryModel,
    RollDamping,
    fit_memory,
    load_database,
    shipped_database,
    vessel_parameters,
)
from seacrane.hydro.data.data_warnings import warn_of_water
from seacrane.warnings import (
    DampingWarning,
    HeadingGapWarning,
    InfiniteFrequencyWarning,
    MemoryMismatchWarning,
    NonPassiveMemoryWarning,
    RollDampingWarning,
    WaterMismatchWarning,
)


@contextmanager
def silence() -> Iterator[None]:
    """Any warning fails the test."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def hull(**changes: Any) -> HydroDatabase:
    """The shipped hull with changes, without its memory unless given."""
    return dataclasses.replace(shipped_database(), **({"memory": None} | changes))


def saved(database: HydroDatabase, folder: Path) -> HydroDatabase:
    """The database by way of a file, as `load_database` sees it."""
    database.save(folder / "hull.nc")
    return load_database(folder / "hull.nc")


def test_infinite_frequency_added_mass_that_is_not_there() -> None:
    database = hull(infinite_frequency_added_mass=None)
    with pytest.warns(InfiniteFrequencyWarning, match=r"3.1 rad/s"):
        fit_memory(database=database, kind="per-pair", r2=0.9)
    with pytest.raises(ValueError, match="infinite_frequency='estimated'"):
        fit_memory(database=database, infinite_frequency="known")


def damped(at: Any = slice(None), **entries: float) -> np.ndarray:
    """The hull's damping with entries multiplied, given as shares of what their diagonals bound."""
    damping = shipped_database().damping.copy()
    for pair, share in entries.items():
        j, k = (int(one) - 1 for one in pair[1:])
        bound = np.sqrt(damping[at, j, j] * damping[at, k, k])
        damping[at, j, k] = damping[at, k, j] = share * bound
    return damping


ROLL = RollDamping(linear=np.full(61, -1.0), quadratic=np.zeros(61), linearised=np.zeros((37, 61)))


@pytest.mark.warns(sometimes=["MemoryMismatchWarning", "RollDampingWarning"])
@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"damping": damped(12, b33=-1.0)}, r"radiation damping at 0\.7 rad/s"),
        ({"damping": damped(b35=1.3)}, "radiation damping at"),  # heave and pitch together gain energy
        ({"linear_damping": np.eye(6)[::-1] * 1e6}, "linear_damping has a negative eigenvalue"),
        ({"quadratic_damping": np.array([0, 0, 0, -1e7, 0, 0])}, r"-1e\+07, below zero"),
        ({"roll_damping": ROLL}, "-1, below zero"),
    ],
)
def test_negative_damping_is_named(changes: dict[str, Any], message: str, tmp_path: Path) -> None:
    database = hull(**changes)
    with pytest.warns(DampingWarning, match=message):
        saved(database, tmp_path)
    with pytest.warns(DampingWarning, match=message) as told:
        vessel_parameters(database, memory=shipped_database().memory)
    assert not any(one.category is NonPassiveMemoryWarning for one in told)  # the memory is not to blame
    with silence():  # noise outside the trusted band is no fault
        saved(hull(damping=damped(-3, b33=-1.0)), tmp_path)


def test_gaps_between_headings_are_told(tmp_path: Path) -> None:
    base = shipped_database()
    degrees = np.degrees(base.heading)
    kept, edge = (list(map(int, np.flatnonzero((degrees < 61) | (degrees > most)))) for most in (119, 104))
    for database, message, at in (
        (hull(port_starboard_symmetric=False), "a gap of 180 deg from 180 deg.*not symmetric", -60.0),
        (base.select(heading=kept), "a gap of 60 deg from 60 deg", 90.0),
    ):
        with pytest.warns(HeadingGapWarning, match=message):
            found = saved(database, tmp_path)
        with pytest.raises(ValueError, match=f"heading {at:g} deg is not among the stored ones"):
            found.force_at(1.0, np.radians(at))
    with silence():
        saved(hull().at((0.0, 2.0, 0.0)), tmp_path)
        saved(base.select(heading=edge), tmp_path)  # 45 deg can be bridged


def test_frequencies_and_headings_are_never_extrapolated() -> None:
    base = shipped_database()
    for omega in (base.omega[0] - 1e-6, base.omega[-1] + 1e-6):
        with pytest.raises(ValueError, match=r"is outside 0\.1 to 3\.1 rad/s"):
            base.force_at(omega, 0.0)
    # Magnitudes or phases alone would give other values between.
    phase = np.exp(1j * np.outer(np.cos(base.heading), 20.0 * base.omega))[:, :, None]
    w, b = 0.725, np.radians(42.5)
    found = hull(force=1e6 * phase * np.ones(6)).force_at(w, b)[2]
    assert np.abs(found - 1e6 * np.exp(20j * w * np.cos(b))) < 0.02e6


def test_units_and_water_that_do_not_fit(tmp_path: Path) -> None:
    for changes, message in (
        ({"rho": 1.025}, r"mass .*742\.3 times"), ({"g": 1.62}, r"C33 .*5\.082 times"),
        ({"length": 11.5}, r"mass .*7\.423 times"),
    ):  # fmt: skip
        with pytest.warns(WaterMismatchWarning, match=message):
            saved(hull(**changes), tmp_path)
    with silence():  # 9.80665 and 9.81
        Scene(name="earth").add_vessel(shipped_database())
    with pytest.warns(WaterMismatchWarning, match=r"9\.81 m/s2, .* 1\.62"):
        Scene(name="moon", gravity=1.62).add_vessel(shipped_database())
    omega, shallow = np.array([0.3, 0.8, 2.0]), hull(depth=30.0)
    with silence():
        warn_of_water(shallow, gravity=9.81, depth=30.0, omega=omega)
        warn_of_water(shallow, gravity=9.81, depth=np.inf, omega=omega[1:] * 1.5)  # deep for these waves
    with pytest.warns(WaterMismatchWarning, match="30 m, the sea has inf m: at 0.3 rad/s"):
        warn_of_water(shallow, gravity=9.81, depth=np.inf, omega=omega, what="the sea")


def test_a_memory_of_another_point_or_tanks_is_found() -> None:
    base = shipped_database()
    with silence():
        vessel_parameters(base)
        vessel_parameters(base.at((1.0, 0.0, 0.0)))
        vessel_parameters(base.mirror())
    for point in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-30.0, 0.0, 0.0)):
        with pytest.warns(MemoryMismatchWarning, match="states R2 = .* for pair"):
            vessel_parameters(base.at(point), memory=base.memory)
    tanks = np.zeros((61, 6, 6))
    tanks[:, 3, 3] = 1e6
    part = AdditionalMatrices(cause="tanks", added_mass=tanks, damping=tanks, restoring=0.0 * tanks)
    with pytest.warns(MemoryMismatchWarning, match="holds nothing of tanks"):
        vessel_parameters(dataclasses.replace(base, additional=(part,)))
    rows = (*base.memory.rows, dataclasses.replace(base.memory.rows[3], cause="tanks"))
    with pytest.warns(MemoryMismatchWarning, match="it holds tanks"):
        vessel_parameters(base, memory=dataclasses.replace(base.memory, rows=rows))


@pytest.mark.warns("MemoryMismatchWarning")
def test_a_memory_that_feeds_the_motions_is_named() -> None:
    """Blocks off the diagonal half as strong again, and heave whose memory pushes in place of damping."""
    base = shipped_database()

    def changed(factor: float, heave: float) -> MemoryModel:
        blocks = []
        for block in base.memory.blocks:
            own = list(block.inputs) == list(block.outputs)
            scale = (heave if list(block.inputs) == [2] else 1.0) if own else factor
            blocks.append(dataclasses.replace(block, C=scale * block.C))
        return dataclasses.replace(base.memory, blocks=tuple(blocks))

    forced = changed(1.5, 1.0)  # what the model states about itself is now wrong
    assert forced.passivity.minimum > -0.05
    for model, message in ((forced, "of the largest at"), (changed(1.0, -1.0), "free vessel grow with")):
        with pytest.warns(NonPassiveMemoryWarning, match=message):
            vessel_parameters(base, memory=model)


def test_roll_damping_taken_where_there_is_no_resonance() -> None:
    values = {
        "linear": np.linspace(1e6, 9e6, 61),
        "quadratic": np.zeros(61),
        "linearised": np.zeros((37, 61)),
    }
    stiff = shipped_database().restoring.copy()
    stiff[3, 3] *= 1e3
    changes = {"roll_damping": RollDamping(**values), "restoring": stiff, "memory": shipped_database().memory}
    with pytest.warns(RollDampingWarning, match="resonance lies outside 0.1 to 3.1 rad/s"):
        vessel_parameters(hull(**changes))
