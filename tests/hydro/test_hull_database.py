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
    MemoryModel,
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


@cache
def ship_memory(kind: str) -> MemoryModel:
    return fit_memory(database=ship_database(), kind=kind)


def barge(name: str = "barge") -> Hull:
    table = OffsetTable(x=[-20.0, 20.0], sections=([[5.0, 2.0], [5.0, -4.0]],) * 2, name=name)
    return Hull.from_offsets(table)


def test_mass_restoring_and_main_dimensions() -> None:
    database, statics = ship_database(), ship().hydrostatics
    mass = RHO * statics.volume
    assert database.mass_matrix[0, 0] == pytest.approx(mass)
    inertia = mass * (0.36 * 16.0) ** 2 + mass * 1.0
    assert database.mass_matrix[3, 3] == pytest.approx(inertia)
    assert database.mass_matrix[0, 4] == pytest.approx(-mass)
    assert database.restoring[3, 3] == pytest.approx(mass * G * statics.metacentric_height(-1.0))
    assert (database.length, database.breadth, database.draught) == pytest.approx(SHIP)
    for text in ("strip theory, 41 stations", "wigley", "GM_T", "roll damping of 0.05"):
        assert text in database.source


def test_long_waves_lift_and_tilt_the_hull_as_hydrostatics_says() -> None:
    """F3 tends to C33 a, F5 to C55 times the slope: pressure over sections against the panels' waterplane."""
    omega = np.array([0.02, 0.03])
    database = hydro_from_hull(
        ship().moved(6.0), center_of_gravity=[6.0, 0.0, -1.0], omega=omega, heading=np.radians([0.0, 90.0])
    )
    k = omega[0] ** 2 / G
    statics = ship().moved(6.0).hydrostatics
    force = database.force[:, 0]
    assert force[0, 2].real == pytest.approx(RHO * G * statics.waterplane_area, rel=5e-3)
    lift = -RHO * G * statics.waterplane_moment_x
    assert force[0, 4].real == pytest.approx(lift, rel=1e-2)
    # Beam sea to port: slope -i k about x times the hydrostatic stiffness with the weight at the origin, and
    # the water's acceleration i k g on the added mass.
    stiffness = (
        RHO * G * statics.waterplane_inertia_roll + RHO * G * statics.volume * statics.center_of_buoyancy[2]
    )
    assert force[1, 3] == pytest.approx(1j * k * (G * database.added_mass[0, 3, 1] - stiffness), rel=1e-2)
    # Following sea: surge of the displaced water, m g times the slope.
    assert force[0, 0] == pytest.approx(1j * k * RHO * G * statics.volume, rel=1e-2)


def test_port_starboard_symmetry_and_missing_surge() -> None:
    database = ship_database()
    for matrix in (database.added_mass, database.damping, database.infinite_frequency_added_mass):
        assert np.all(matrix[..., ::2, 1::2] == 0.0)
        assert np.all(matrix[..., 0, :] == 0.0)
        np.testing.assert_array_equal(matrix, matrix.swapaxes(-1, -2))
    assert np.all(database.force[[0, -1], :, 1::2] == 0.0)
    rows = {row.check: row for row in replace(database, memory=ship_memory("per-pair")).check()}
    assert rows["surge_terms_missing"].value == 1.0
    for name in ("symmetry_added_mass", "symmetry_damping", "damping_smallest_eigenvalue"):
        assert rows[name].verdict == "pass", rows[name]
    for motion in ("sway", "heave", "roll", "pitch", "yaw"):
        assert rows[f"kramers_kronig_{motion}"].verdict == "pass", rows[f"kramers_kronig_{motion}"]


@pytest.mark.parametrize(
    "kind", ["per-pair", pytest.param("passive", marks=pytest.mark.slow("fits a memory"))]
)
def test_the_memory_of_a_strip_database_has_no_surge(kind: str) -> None:
    model = ship_memory(kind)
    pairs = {(row.output, row.input) for row in model.rows}
    assert {(1, 1), (2, 2), (3, 3), (4, 4), (5, 5)} <= pairs
    assert all(0 not in pair for pair in pairs)
    assert all(row.r2_added_mass > 0.98 and row.r2_damping > 0.98 for row in model.rows), model.rows


@pytest.mark.warns("BelowBandWarning")
@pytest.mark.slow("a long run")
def test_a_run_in_a_low_sea_follows_the_summed_response() -> None:
    scene = Scene(name="hull")
    scene.add_vessel(replace(ship_database(), memory=ship_memory("passive")), memory="passive")
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
    omega, heading = np.array([0.6, 1.0]), np.radians([90.0, 135.0])
    found = [
        hydro_from_hull(
            ship(), center_of_gravity=[0.0, 0.0, -1.0], omega=omega, heading=heading, stations=n
        ).damping[:, [1, 2, 4], [1, 2, 4]]
        for n in (9, 17, 33)
    ]
    first, second = (np.abs(found[i + 1] - found[i]).max(axis=0) for i in range(2))
    assert np.all(second < 0.5 * first)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "magic"}, "strip or capytaine"),
        ({"speed": 3.0}, "zero speed"),
        ({"roll_damping_fraction": -0.1}, "roll_damping_fraction"),
        ({"center_of_gravity": [0.0, 0.5, 0.0]}, "y = 0.5 m"),
        ({"center_of_gravity": [0.0, 0.0]}, "three finite numbers"),
        ({"center_of_gravity": [0.0, 0.0, np.nan]}, "three finite numbers"),
        ({"center_of_gravity": [0.0, 0.0, 9.0]}, "capsizes"),
        ({"radii_of_gyration": [1.0, 2.0, -3.0]}, "three positive numbers"),
        ({"mass": 0.0}, "mass is 0.0"),
        ({"rho": np.nan}, "rho is nan"),
        ({"g": -9.81}, "g is -9.81"),
        ({"omega": [0.0, 1.0]}, "above 0"),
        ({"omega": [1.0, 0.5]}, "increasing"),
        ({"omega": []}, "increasing"),
        ({"heading": [-0.5, 0.0]}, "below 2 pi"),
        ({"heading": [0.0, np.inf]}, "increasing"),
        ({"stations": 3}, "5 or more"),
        ({"trusted_band": (2.0, 1.0)}, "trusted_band"),
        ({"roll_damping_fraction": 0.05, "omega": [2.0, 3.0]}, "roll natural frequency"),
    ],
)
def test_bad_values_are_refused(options: dict[str, Any], message: str) -> None:
    small = {"center_of_gravity": [0.0, 0.0, -1.0], "omega": [0.5, 1.0], "heading": [0.0, 1.5]}
    with pytest.raises(ValueError, match=message):
        hydro_from_hull(barge(), **{**small, **options})


def test_a_hull_that_would_not_float_as_drawn_warns() -> None:
    small: dict[str, Any] = {"omega": [0.5, 1.0], "heading": [0.0, 1.5]}
    with pytest.warns(FloatingPositionWarning, match=r"\+20\.0 % off the displaced"):
        hydro_from_hull(barge(), center_of_gravity=[0, 0, -1.0], mass=1.2 * RHO * 1600.0, **small)
    with pytest.warns(FloatingPositionWarning, match=r"\+1 m forward.*trim by"):
        hydro_from_hull(barge(), center_of_gravity=[1.0, 0, -1.0], **small)


def test_a_bulb_left_out_by_strip_theory_warns() -> None:
    bulb = moved(sphere(1.5, 24), 22.0, 0.0, -2.5)
    vertices, faces = joined(box(length=40.0, breadth=10.0, bottom=-4.0, top=3.0), bulb)
    hull = Hull.from_mesh(vertices=vertices, faces=faces).at_centre_of_buoyancy()
    with pytest.warns(SubmergedPartWarning, match=r"% of the volume hangs apart"):
        hydro_from_hull(hull, center_of_gravity=[0, 0, -1.0], omega=[0.5, 1.0], heading=[0.0, 1.5])


def test_without_capytaine_the_error_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "capytaine", None)
    with pytest.raises(ImportError, match=r"seacrane\[hydro\]"):
        hydro_from_hull(barge(), center_of_gravity=[0, 0, -1.0], method="capytaine")


def test_the_default_frequencies_resolve_the_resonances() -> None:
    database = ship_database()
    for motion in (2, 3, 4):
        assert natural_frequency(database, motion) is not None
    assert 2.0 * np.pi * G / database.omega[-1] ** 2 == pytest.approx(5.0)
    assert len(database.heading) == 37
