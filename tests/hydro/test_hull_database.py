"""`hydro_from_hull`: limits that hydrostatics gives, every consumer of a database, refusals, warnings."""

from __future__ import annotations

import sys
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from hull_shapes import box, joined, moved, sphere, wigley_offsets

from seacrane import Scene, linear_model, simulate
from seacrane.analysis import response_summed
from seacrane.hydro import (
    Hull,
    HydroDatabase,
    OffsetTable,
    ParametricHull,
    fit_memory,
    hydro_from_hull,
    natural_frequency,
)
from seacrane.warnings import FloatingPositionWarning, SubmergedPartWarning

SHIP = (100.0, 16.0, 6.0)
RHO, G = 1025.0, 9.81


@cache
def ship() -> Hull:
    return Hull.from_offsets(wigley_offsets(*SHIP, 16)).at_centre_of_buoyancy()


@cache
def ship_database() -> HydroDatabase:
    return hydro_from_hull(ship(), center_of_gravity=[0.0, 0.0, -1.0], roll_damping_fraction=0.05)


def barge(name: str = "barge") -> Hull:
    table = OffsetTable(x=[-20.0, 20.0], sections=([[5.0, 2.0], [5.0, -4.0]],) * 2, name=name)
    return Hull.from_offsets(table)


def test_mass_restoring_and_main_dimensions() -> None:
    database, statics = ship_database(), ship().hydrostatics
    mass = RHO * statics.volume
    assert database.mass_matrix[0, 0] == pytest.approx(mass)
    assert database.mass_matrix[3, 3] == pytest.approx(mass * (0.36 * 16.0) ** 2 + mass * 1.0)
    assert database.mass_matrix[0, 4] == pytest.approx(-mass)
    assert database.restoring[3, 3] == pytest.approx(mass * G * statics.metacentric_height(-1.0))
    assert (database.length, database.breadth, database.draught) == pytest.approx(SHIP)
    for text in ("strip theory, 41 stations", "wigley", "GM_T", "roll damping of 0.05"):
        assert text in database.source
    assert all(natural_frequency(database, motion) is not None for motion in (2, 3, 4))  # by the default grid
    assert 2.0 * np.pi * G / database.omega[-1] ** 2 == pytest.approx(5.0)
    assert len(database.heading) == 37


def test_long_waves_lift_and_tilt_the_hull_as_hydrostatics_says() -> None:
    """F3 tends to C33 a, F5 to C55 times the slope: pressure over sections against the panels' waterplane."""
    omega, hull = np.array([0.02, 0.03]), ship().moved(6.0)
    grid = {"omega": omega, "heading": np.radians([0.0, 90.0])}
    database = hydro_from_hull(hull, center_of_gravity=[6.0, 0.0, -1.0], **grid)
    k, statics, force = omega[0] ** 2 / G, hull.hydrostatics, database.force[:, 0]
    assert force[0, 2].real == pytest.approx(RHO * G * statics.waterplane_area, rel=5e-3)
    assert force[0, 4].real == pytest.approx(-RHO * G * statics.waterplane_moment_x, rel=1e-2)
    # Beam sea to port: slope -i k about x times the hydrostatic stiffness with the weight at the origin, and
    # the water's acceleration i k g on the added mass.
    lever = statics.waterplane_inertia_roll + statics.volume * statics.center_of_buoyancy[2]
    beam = 1j * k * G * (database.added_mass[0, 3, 1] - RHO * lever)
    assert force[1, 3] == pytest.approx(beam, rel=1e-2)
    # Following sea: surge of the displaced water, m g times the slope.
    assert force[0, 0] == pytest.approx(1j * k * RHO * G * statics.volume, rel=1e-2)


def test_port_starboard_symmetry_and_missing_surge() -> None:
    database, memory = ship_database(), fit_memory(database=ship_database(), kind="per-pair")
    for matrix in (database.added_mass, database.damping, database.infinite_frequency_added_mass):
        assert np.all(matrix[..., ::2, 1::2] == 0.0) and np.all(matrix[..., 0, :] == 0.0)
        np.testing.assert_array_equal(matrix, matrix.swapaxes(-1, -2))
    assert np.all(database.force[[0, -1], :, 1::2] == 0.0)
    rows = {row.check: row for row in replace(database, memory=memory).check()}
    assert rows["surge_terms_missing"].value == 1.0
    names = ["symmetry_added_mass", "symmetry_damping", "damping_smallest_eigenvalue"]
    for name in names + [f"kramers_kronig_{motion}" for motion in ("sway", "heave", "roll", "pitch", "yaw")]:
        assert rows[name].verdict == "pass", rows[name]
    pairs = {(row.output, row.input) for row in memory.rows}
    assert {(1, 1), (2, 2), (3, 3), (4, 4), (5, 5)} <= pairs and all(0 not in pair for pair in pairs)
    assert all(row.r2_added_mass > 0.98 and row.r2_damping > 0.98 for row in memory.rows), memory.rows


@pytest.mark.warns("BelowBandWarning")
@pytest.mark.slow("a long run")
def test_a_run_in_a_low_sea_follows_the_summed_response() -> None:
    scene = Scene(name="hull")
    memory = fit_memory(database=ship_database(), kind="passive")
    scene.add_vessel(replace(ship_database(), memory=memory), memory="passive")
    scene.add_sea(hs=0.02, tp=8.0, direction_deg=150.0, count=60)
    linear = linear_model(scene)
    summed = response_summed(linear, body="vessel")
    start = linear.full_state(summed.state_at(0.0))
    result = simulate(scene, t_end=60.0, dt_out=0.5, start=start, channels=["vessel_motion"])
    expected = summed.at(result.time)
    difference = np.std(result["vessel_motion"] - expected, axis=0) / np.std(expected, axis=0)
    np.testing.assert_array_less(difference, 0.01)
    assert np.all(np.std(expected, axis=0)[[0, 2, 4]] > 1e-5)


def test_offsets_mesh_and_parametric_hull_give_one_database() -> None:
    shape = ParametricHull(
        length=60.0, breadth=14.0, draught=4.0, entrance_length=24.0, run_length=20.0,
        transom_breadth_fraction=0.8, transom_draught_fraction=0.5, section_exponent=4.0,
    )  # fmt: skip
    parametric = Hull.from_parametric(shape, stations=48, girth=24)
    x = np.linspace(0.0, 60.0, 49)
    table = OffsetTable(x=x, sections=tuple(shape.section(float(v), 20) for v in x))
    panels = parametric.panels
    mesh = Hull.from_mesh(vertices=panels.reshape(-1, 3), faces=np.arange(4 * len(panels)).reshape(-1, 4))
    grid: dict[str, Any] = {"omega": np.linspace(0.4, 2.4, 6), "heading": np.radians([90.0, 135.0, 180.0])}
    centre = [float(parametric.hydrostatics.center_of_buoyancy[0]), 0.0, 0.0]
    one, other, third = (
        hydro_from_hull(hull, center_of_gravity=centre, **grid)
        for hull in (parametric, Hull.from_offsets(table), mesh)
    )
    for name in ("added_mass", "damping", "force", "infinite_frequency_added_mass"):
        a, b, c = (np.asarray(getattr(d, name)) for d in (one, other, third))
        scale = np.abs(a).reshape(-1, a.shape[-1]).max(axis=0)
        np.testing.assert_array_less(np.abs(c - a) / np.where(scale > 0, scale, 1.0), 1e-6)
        np.testing.assert_array_less(np.abs(b - a) / np.where(scale > 0, scale, 1.0), 0.02)


def test_stations_converge() -> None:
    """Halving the spacing changes damping a quarter as much."""
    grid: dict[str, Any] = {"omega": np.array([0.6, 1.0]), "heading": np.radians([90.0, 135.0])}
    ends = [hydro_from_hull(ship(), center_of_gravity=[0, 0, -1], stations=n, **grid) for n in (9, 17, 33)]
    found = [database.damping[:, [1, 2, 4], [1, 2, 4]] for database in ends]
    first, second = (np.abs(found[i + 1] - found[i]).max(axis=0) for i in range(2))
    assert np.all(second < 0.5 * first)


SMALL: dict[str, Any] = {"center_of_gravity": [0.0, 0.0, -1.0], "omega": [0.5, 1.0], "heading": [0.0, 1.5]}


def test_bad_values_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    table: list[tuple[dict[str, Any], str]] = [
        ({"method": "magic"}, "strip or capytaine"), ({"speed": 3.0}, "zero speed"), ({"mass": 0.0}, "mass"),
        ({"center_of_gravity": [0.0, 0.5, 0.0]}, "y = 0.5"), ({"center_of_gravity": [0, 0]}, "three finite"),
        ({"center_of_gravity": [0.0, 0.0, 9.0]}, "capsizes"), ({"radii_of_gyration": [1, 2, -3]}, "positive"),
        ({"rho": np.nan}, "rho is nan"), ({"g": -9.81}, "g is -9.81"), ({"omega": [0.0, 1.0]}, "above 0"),
        ({"omega": [1.0, 0.5]}, "increasing"), ({"omega": []}, "increas"), ({"heading": [-0.5, 0.0]}, "2 pi"),
        ({"stations": 3}, "5 or more"), ({"trusted_band": (2.0, 1.0)}, "trusted_band"),
        ({"roll_damping_fraction": -0.1}, "roll_damping_fraction"),
        ({"roll_damping_fraction": 0.05, "omega": [2.0, 3.0]}, "roll natural frequency"),
    ]  # fmt: skip
    for options, message in table:
        with pytest.raises(ValueError, match=message):
            hydro_from_hull(barge(), **(SMALL | options))
    monkeypatch.setitem(sys.modules, "capytaine", None)
    with pytest.raises(ImportError, match=r"seacrane\[hydro\]"):
        hydro_from_hull(barge(), **SMALL, method="capytaine")


def test_hulls_that_would_not_float_as_drawn_or_have_a_bulb_warn() -> None:
    with pytest.warns(FloatingPositionWarning, match=r"\+20\.0 %"):
        hydro_from_hull(barge(), mass=1.2 * RHO * 1600.0, **SMALL)
    with pytest.warns(FloatingPositionWarning, match=r"\+1 m forward.*trim"):
        hydro_from_hull(barge(), **(SMALL | {"center_of_gravity": [1.0, 0.0, -1.0]}))
    bulb = moved(sphere(1.5, 24), 22.0, 0.0, -2.5)
    vertices, faces = joined(box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0), bulb)
    hull = Hull.from_mesh(vertices=vertices, faces=faces).at_centre_of_buoyancy()
    with pytest.warns(SubmergedPartWarning, match="of the volume hangs apart"):
        hydro_from_hull(hull, **SMALL)
