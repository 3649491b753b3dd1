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


@pytest.mark.slow("real ships")
def test_good_data_are_silent(shared: Path) -> None:
    with silence():
        for folder in (shared / "veres" / "supply", shared / "wamit"):
            load_database(folder)
        vessel_parameters(shipped_database())
        scene = Scene(name="afloat")
        scene.add_vessel(shipped_database())
        tanker = load_database(shared / "wamit")
        for kind in ("by-motion", "per-pair", "passive"):
            model = fit_memory(database=tanker, kind=kind)
            vessel_parameters(
                dataclasses.replace(tanker, linear_damping=np.diag([0, 0, 0, 1e8, 0, 0])), memory=model
            )


# --- added mass at infinite frequency


def test_infinite_frequency_added_mass_that_is_not_there() -> None:
    database = hull(infinite_frequency_added_mass=None)
    with pytest.warns(
        InfiniteFrequencyWarning, match=r"up to 3.1 rad/s.*a wrong mass in every acceleration"
    ) as told:
        fit_memory(database=database, kind="per-pair", r2=0.9)
    assert told[0].filename == __file__
    with pytest.raises(
        ValueError, match="no infinite-frequency added mass; pass infinite_frequency='estimated'"
    ):
        fit_memory(database=database, infinite_frequency="known")
    with silence():
        fit_memory(database=hull(), kind="per-pair", r2=0.9)


# --- damping


def negative_radiation() -> HydroDatabase:
    damping = shipped_database().damping.copy()
    damping[12, 2, 2] *= -1.0
    return hull(damping=damping)


def coupled_too_strongly() -> HydroDatabase:
    """Every diagonal positive, and yet one combination of heave and pitch gains energy."""
    damping = shipped_database().damping.copy()
    bound = np.sqrt(damping[:, 2, 2] * damping[:, 4, 4])
    damping[:, 2, 4] = damping[:, 4, 2] = 1.3 * bound
    return hull(damping=damping)


@pytest.mark.warns(sometimes=["MemoryMismatchWarning", "RollDampingWarning"])
@pytest.mark.parametrize(
    ("build", "message"),
    [
        (negative_radiation, r"radiation damping at 0\.7 rad/s has a negative eigenvalue"),
        (coupled_too_strongly, "radiation damping at .* has a negative eigenvalue"),
        (
            lambda: hull(linear_damping=np.diag([0, 0, 0, -1e7, 0, 0])),
            "linear_damping has a negative eigenvalue",
        ),
        (lambda: hull(linear_damping=np.eye(6)[::-1] * 1e6), "linear_damping has a negative eigenvalue"),
        (lambda: hull(quadratic_damping=np.array([0, 0, 0, -1e7, 0, 0])), r"-1e\+07, below zero"),
        (
            lambda: hull(
                roll_damping=RollDamping(
                    linear=np.full(61, -1.0), quadratic=np.zeros(61), linearised=np.zeros((37, 61))
                )
            ),
            "-1, below zero",
        ),
    ],
)
def test_negative_damping_is_named(build: Any, message: str, tmp_path: Path) -> None:
    database = build()
    with pytest.warns(DampingWarning, match=message) as told:
        saved(database, tmp_path)
    assert all("gains energy from still water" in str(warning.message) for warning in told)
    model = shipped_database().memory
    with pytest.warns(DampingWarning, match=message) as told:
        vessel_parameters(database, memory=model)
    assert not any(
        warning.category is NonPassiveMemoryWarning for warning in told
    )  # the memory is not to blame


def test_noise_outside_the_trusted_band_is_no_fault(tmp_path: Path) -> None:
    damping = shipped_database().damping.copy()
    damping[-3, 2, 2] *= -1.0
    with silence():
        saved(hull(damping=damping), tmp_path)


# --- headings


def test_a_vessel_without_symmetry_needs_all_headings(tmp_path: Path) -> None:
    one_side = hull(port_starboard_symmetric=False)
    with pytest.warns(HeadingGapWarning, match="a gap of 180 deg from 180 deg.*refused.*not symmetric"):
        found = saved(one_side, tmp_path)
    with pytest.raises(
        ValueError, match="heading -60 deg is not among the stored ones, whose largest gap is 180"
    ):
        found.force_at(1.0, np.radians(-60.0))
    with silence():
        saved(hull().at((0.0, 2.0, 0.0)), tmp_path)


def test_a_gap_on_the_circle(tmp_path: Path) -> None:
    base = shipped_database()
    keep = [
        int(i) for i in np.flatnonzero((np.degrees(base.heading) < 61) | (np.degrees(base.heading) > 119))
    ]
    with pytest.warns(HeadingGapWarning, match="a gap of 60 deg from 60 deg"):
        found = saved(base.select(heading=keep), tmp_path)
    with pytest.raises(ValueError, match="heading 90 deg is not among the stored ones"):
        found.force_at(1.0, np.pi / 2.0)
    edge = [
        int(i) for i in np.flatnonzero((np.degrees(base.heading) < 61) | (np.degrees(base.heading) > 104))
    ]
    with silence():
        saved(base.select(heading=edge), tmp_path)  # 45 deg can be bridged


def test_frequencies_and_headings_are_never_extrapolated() -> None:
    base = shipped_database()
    for omega in (base.omega[0] - 1e-6, base.omega[-1] + 1e-6):
        with pytest.raises(ValueError, match=r"is outside 0\.1 to 3\.1 rad/s"):
            base.force_at(omega, 0.0)
    phase = np.exp(1j * np.outer(np.cos(base.heading), 20.0 * base.omega))[:, :, None]
    turning = hull(
        force=1e6 * phase * np.ones(6)
    )  # magnitudes or phases alone would give other values between
    w, b = 0.725, np.radians(42.5)
    exact = 1e6 * np.exp(20j * w * np.cos(b))
    assert np.abs(turning.force_at(w, b)[2] - exact) < 0.02e6


# --- water


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"rho": 1.025}, r"its mass needs 742\.3 times the box .* at rho = 1\.025 kg/m3"),
        ({"g": 1.62}, r"its C33 needs 5\.082 times the box"),
        ({"length": 11.5}, r"its mass needs 7\.423 times"),
    ],
)
def test_units_and_water_that_do_not_fit(changes: dict[str, float], message: str, tmp_path: Path) -> None:
    with pytest.warns(WaterMismatchWarning, match=message):
        saved(hull(**changes), tmp_path)


def test_gravity_of_scene_and_database() -> None:
    with silence():  # 9.80665 and 9.81
        Scene(name="earth").add_vessel(shipped_database())
    moon = Scene(name="moon", gravity=1.62)
    with pytest.warns(
        WaterMismatchWarning, match=r"g is 9\.81 m/s2, that of the scene 1\.62.*heel and trim"
    ) as told:
        moon.add_vessel(shipped_database())
    assert told[0].filename == __file__


def test_depth_of_sea_and_database() -> None:
    omega = np.array([0.3, 0.8, 2.0])
    shallow = hull(depth=30.0)
    with silence():
        warn_of_water(shallow, gravity=9.81, depth=30.0, omega=omega)
        warn_of_water(shallow, gravity=9.81, depth=np.inf, omega=omega[1:] * 1.5)  # deep for these waves
        warn_of_water(hull(), gravity=9.80665, depth=np.inf, omega=omega)
    with pytest.warns(
        WaterMismatchWarning, match="computed for a depth of 30 m, the sea has inf m: at 0.3 rad/s"
    ):
        warn_of_water(shallow, gravity=9.81, depth=np.inf, omega=omega, what="the sea")


# --- memory of other data


@pytest.fixture(scope="module")
def passive() -> MemoryModel:
    """A passive memory of the shipped hull."""
    return fit_memory(database=shipped_database(), kind="passive", r2=0.95)


def test_a_memory_about_another_point_is_found(passive: MemoryModel) -> None:
    base = shipped_database()
    for model in (base.memory, passive):
        with silence():
            vessel_parameters(base, memory=model)
        for point in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (-30.0, 0.0, 0.0)):
            with pytest.warns(
                MemoryMismatchWarning, match="states R2 = .* for pair .*, and follows these with"
            ):
                vessel_parameters(base.at(point), memory=model)
        for same in (base.at((1.0, 0.0, 0.0)), base.mirror()):
            with silence():
                vessel_parameters(same)


def test_a_memory_of_another_ship_is_found(shared: Path, passive: MemoryModel) -> None:
    tanker = load_database(shared / "wamit")
    with pytest.warns(MemoryMismatchWarning, match="the memory model is not of these data"):
        vessel_parameters(tanker, memory=passive)


def test_a_memory_without_the_tanks_or_with_others_is_found() -> None:
    base = shipped_database()
    nothing = np.zeros((61, 6, 6))
    tanks = np.zeros((61, 6, 6))
    tanks[:, 3, 3] = 1e6
    part = AdditionalMatrices(cause="tanks", added_mass=tanks, damping=tanks, restoring=nothing)
    with pytest.warns(MemoryMismatchWarning, match="it holds nothing of tanks, of which the database has"):
        vessel_parameters(dataclasses.replace(base, additional=(part,)))
    assert base.memory is not None
    rows = (*base.memory.rows, dataclasses.replace(base.memory.rows[3], cause="tanks"))
    with pytest.warns(MemoryMismatchWarning, match="it holds tanks, of which the database has no matrices"):
        vessel_parameters(base, memory=dataclasses.replace(base.memory, rows=rows))


# --- memory that delivers energy


def louder(model: MemoryModel, factor: float) -> MemoryModel:
    """The blocks off the diagonal made ``factor`` times as strong."""
    blocks = tuple(
        block
        if np.array_equal(block.inputs, block.outputs)
        else dataclasses.replace(block, C=factor * block.C)
        for block in model.blocks
    )
    return dataclasses.replace(model, blocks=blocks)


@pytest.mark.warns("MemoryMismatchWarning")
def test_a_memory_that_feeds_the_motions_is_named() -> None:
    base = shipped_database()
    assert base.memory is not None
    forced = louder(base.memory, 1.5)  # what the model states about itself is now wrong
    assert forced.passivity.minimum > -0.05
    with pytest.warns(NonPassiveMemoryWarning, match="A motion can gain energy from still water") as told:
        vessel_parameters(base, memory=forced)
    (text,) = [str(w.message) for w in told if w.category is NonPassiveMemoryWarning]
    assert "of the largest at" in text and told[0].filename == __file__


@pytest.mark.warns("MemoryMismatchWarning")
def test_growth_of_the_free_vessel_is_named() -> None:
    """Heave whose memory pushes in place of damping."""
    base = shipped_database()
    assert base.memory is not None
    turned = tuple(
        dataclasses.replace(block, C=-block.C)
        if list(block.inputs) == [2] and list(block.outputs) == [2]
        else block
        for block in base.memory.blocks
    )
    model = dataclasses.replace(base.memory, blocks=turned)
    with pytest.warns(NonPassiveMemoryWarning, match="motions of the free vessel grow with") as told:
        vessel_parameters(base, memory=model)
    assert any(w.category is MemoryMismatchWarning for w in told)


# --- roll damping


def test_roll_damping_taken_where_there_is_no_resonance() -> None:
    table = RollDamping(
        linear=np.linspace(1e6, 9e6, 61), quadratic=np.zeros(61), linearised=np.zeros((37, 61))
    )
    stiff = shipped_database().restoring.copy()
    stiff[3, 3] *= 1e3
    with pytest.warns(RollDampingWarning, match="roll resonance lies outside 0.1 to 3.1 rad/s"):
        vessel_parameters(hull(roll_damping=table, restoring=stiff, memory=shipped_database().memory))
