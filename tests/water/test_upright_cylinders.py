"""Piles, columns, tubes: added mass of strips at any inclination, ends shut or open, Morison's sum."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import wet_scenes as wet
from element_runs import both_forms
from scipy.spatial.transform import Rotation
from wet_scenes import EXACT, RHO, G

from seacrane import Scene, simulate
from seacrane.arrays import Array
from seacrane.hydro import CylinderPart, circle_added_mass

D, LENGTH = 8.0, 60.0
R = 0.5 * D
AREA, DISC = np.pi * R**2, 4.0 / 3.0 * R**3
UP = ((0.0, 0.0, -1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0))  # its x is up: the first end is below


def pile(draught: float, *, lean: float = 0.0, heading: float = 0.0, axes: Any = UP, **part: Any) -> Scene:
    """Its centre line meets the surface at the origin; leans towards a heading, rad."""
    turn = Rotation.from_euler("ZY", [heading, lean])
    scene = Scene(name="pile", gravity=G)
    scene.add_body("pile", mass=1e6, inertia=(3e8, 3e8, 1e7), quaternion=wet.quaternion(turn),
                   position=turn.apply((0.0, 0.0, 0.5 * LENGTH - draught)))  # fmt: skip
    part = {"length": LENGTH, "diameter": D, "axes": axes} | part
    scene.add_immersed("pile", parts=[CylinderPart(**part)], density=RHO)
    return scene


def added(scene: Scene) -> Array:
    """Of all parts over the density, in axes of the body, m3, (3, 3)."""
    w, x, y, z = scene.bodies["pile"].quaternion
    turn = Rotation.from_quat((x, y, z, w))
    found, dry = wet.masses(scene, 1e6, (3e8, 3e8, 1e7), turn)
    r = turn.as_matrix()
    return np.asarray(r.T @ (found - dry)[:3, :3] @ r) / RHO


@pytest.mark.parametrize("strips", [1, 15, 200])
@pytest.mark.parametrize("draught", [3.3, 30.0, 59.99, 70.0, 500.0])
def test_an_upright_pile_has_that_of_morison_and_a_disc_at_each_wet_end(strips: int, draught: float) -> None:
    across, ends = AREA * min(draught, LENGTH), 1 + (draught > LENGTH)
    found = added(pile(draught, strips=strips))
    assert found == pytest.approx(np.diag([across, across, ends * DISC]), rel=1e-6, abs=1e-6)


@pytest.mark.parametrize("lean", [0.0, 30.0, 89.0, 90.0])
def test_a_leaning_pile_has_that_of_each_circle_in_its_own_plane_in_all_strips(lean: float) -> None:
    angle = np.radians(lean)
    scenes = [pile(20.0, lean=angle, heading=0.7, strips=n, ends=("joined", "joined")) for n in (1, 15, 200)]
    few, some, many = (added(scene) for scene in scenes)
    assert few == pytest.approx(many, rel=1e-7, abs=1e-7 * AREA * LENGTH)
    assert some == pytest.approx(many, rel=1e-7, abs=1e-7 * AREA * LENGTH)
    along = np.linspace(-20.0, LENGTH - 20.0, 20_001)  # of its centre line from the surface on, up
    depth = -along * np.cos(angle)
    plane = depth / np.sin(angle) if lean else np.where(depth > 0.0, np.inf, -np.inf)
    each = np.pi * np.ones_like(plane) * (plane > 0.0)
    near = np.abs(plane) < 39.0 * R
    each[near] = circle_added_mass(1.0 + plane[near] / R)
    expected = R**2 * np.trapezoid(each, along)
    assert many[0, 0] == pytest.approx(expected, rel=2e-3)  # its table's last knots: 40 radii down
    assert many[1, 1] == pytest.approx(many[0, 0], rel=1e-12)
    assert abs(many[2, 2]) < 1e-9 * expected


@pytest.mark.parametrize("ends", [("closed", "open"), ("open", "closed"), ("joined", "closed")])
def test_ends_are_told_apart_and_the_whole_may_be_turned_over(ends: tuple[str, str]) -> None:
    tube: dict[str, Any] = {"wall": 0.5, "flooded": False, "strips": 4}
    one = added(pile(30.0, ends=ends, **tube))
    over = Rotation.from_euler("y", np.pi).as_matrix() @ np.asarray(UP)
    assert added(pile(30.0, ends=ends[::-1], axes=over, **tube)) == pytest.approx(one, rel=1e-12, abs=1e-9)
    ring = np.pi / 8.0 * 0.5**2 * np.pi * 7.5
    assert one[2, 2] == pytest.approx({"closed": DISC, "open": ring, "joined": 0.0}[ends[0]], rel=1e-6)


def test_a_flooded_tube_carries_its_water_across_always_and_along_where_an_end_is_shut() -> None:
    wall = 0.1
    inside = np.pi * (R - wall) ** 2
    for ends, along in ((("open", "open"), 0.0), (("open", "closed"), 1.0), (("closed", "open"), 1.0)):
        scene = pile(30.0, ends=ends, wall=wall, flooded=True, strips=15)
        found = added(scene)
        assert found[0, 0] == pytest.approx((AREA + inside) * 30.0, rel=1e-6)
        end = DISC if ends[0] == "closed" else np.pi / 8.0 * wall**2 * 2.0 * np.pi * (R - 0.5 * wall)
        assert found[2, 2] == pytest.approx(along * inside * 30.0 + end, rel=1e-6)
        lifted = simulate(scene, 0.01, dt_out=0.01, channels=["load_force"])["load_force"][0]
        assert lifted.sum(axis=0)[2] == pytest.approx(RHO * G * (AREA - inside) * 30.0, rel=1e-6)


def test_a_disc_is_struck_over_the_depth_of_its_slam_and_gains_the_rest_as_it_goes_under() -> None:
    """C_S of 5 facing down; facing up no faster than the layer of water above it."""
    struck, layer = 2.0 * DISC / (5.0 * AREA), DISC / AREA
    down = [added(pile(x * struck, strips=1))[2, 2] / DISC for x in (0.5, 0.9, 1.5)]
    assert down == pytest.approx([0.25, 0.65, 1.0], abs=0.12)
    assert np.diff(down) == pytest.approx([0.4, 0.35], abs=0.1)
    up = [added(pile(LENGTH + x * layer, strips=1))[2, 2] / DISC - 1.0 for x in (0.0, 0.2, 0.7, 1.2)]
    assert up == pytest.approx([0.0, 0.1, 0.6, 1.0], abs=1e-5)


def thrown(*, lean: float, **part: Any) -> Scene:
    """A light pile that falls through the surface while it turns."""
    scene = Scene(name="thrown", gravity=G)
    scene.add_body(
        "pile", mass=4e3, inertia=(9e3, 9e3, 1e3), position=(0.0, 0.0, 2.5), velocity=(1.5, 0.4, -4.0),
        quaternion=wet.quaternion(Rotation.from_euler("xy", [0.1, lean])), angular_velocity=(0.3, 0.4, 0.2),
    )  # fmt: skip
    part = {"length": 5.0, "diameter": 1.0, "strips": 5} | part
    scene.add_immersed("pile", parts=[CylinderPart(axes=UP, **part)], density=RHO)
    return scene


TUBE: dict[str, Any] = {"ends": ("open", "closed"), "wall": 0.05, "flooded": True}


@pytest.mark.parametrize(
    ("lean", "part"), [(0.0, {}), (np.pi / 2.0, {}), (0.3, TUBE), (2.5, TUBE), (0.4, {"strips": 1})]
)
def test_the_ledger_closes_and_both_formulations_agree(lean: float, part: dict[str, Any]) -> None:
    run = both_forms(thrown(lean=lean, **part), 3.0, wet.ALIKE, ledger=1e-7, **EXACT | {"rtol": 1e-10})
    assert np.all(np.diff(run["load_state"], axis=0) > -1e-6), "slam never gives back"


@pytest.mark.parametrize(("period", "strips"), [(6.0, 15), (9.0, 60), (14.0, 200)])
def test_the_inertia_load_is_morisons_sum(period: float, strips: int, formulation: str) -> None:
    """2 rho A a dz over what is wet, a being the mean over the width that strips take."""
    draught = 30.0
    scene = pile(draught, strips=strips)
    scene.add_joint(kind="revolute", name="fix", first="ground", second="pile", axis=(0, 0, 1))  # untwisted
    scene.add_sea(vessel=None, hs=0.2, tp=period, direction_deg=0.0, seed=1)
    run = simulate(scene, 20.0, dt_out=1.0, channels=["immersed_force"], formulation=formulation, rtol=1e-3)
    force = run["immersed_force"][:, :, list(run.coords["cause"]).index("waves"), 0].sum(axis=1)
    level = np.linspace(-draught, 0.0, 121)
    nodes, weights = np.polynomial.legendre.leggauss(5)
    places = [(x * np.sqrt(0.75) * R, 0.0, z) for x in nodes for z in level]
    water = scene.sea_at(points={f"p{i}": place for i, place in enumerate(places)}, times=run.time)
    at = water.acceleration.values[:, :, 0].reshape(-1, len(nodes), len(level))
    hand = 2.0 * RHO * AREA * np.trapezoid(at, level, axis=2) @ (weights / 2.0)
    assert np.abs(force - hand).max() < 0.02 * np.abs(hand).max()
