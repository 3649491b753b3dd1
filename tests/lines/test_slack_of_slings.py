"""The slack criterion: each line and sling over its least static load, in air or under water."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.spatial.transform import Rotation

from seacrane import Scene, SceneError, simulate
from seacrane.analysis.least_pulls import least_pulls
from seacrane.arrays import Array
from seacrane.hydro import BoxPart, Compartment, Opening

G, RHO, EA = 9.80665, 1025.0, 5e7
MASS, BLOCK, SIZE = 40e3, 1e3, (6.0, 4.0, 3.0)  # kg, kg, m
VOLUME = (3.0, 2.0, 2.0)  # m, of the box that keeps water out
STEEP = np.radians(60.0)
REACH = 0.5 * float(np.hypot(*SIZE[:2]))
CORNERS = np.array([(x, y, 1.5) for x, y in ((3, 2), (3, -2), (-3, -2), (-3, 2))], dtype=float)
THREE = np.array([(3.0, 2.0, 1.5), (3.0, -2.0, 1.5), (-3.0, 0.0, 1.5)])
DRY, LIFT = MASS * G, RHO * G * float(np.prod(VOLUME))


def rigged(depth: float, *, at: Any = (0.0, 0.0, 0.0), points: Array = CORNERS, block: bool = True) -> Scene:
    """A load on slings, its centre at a depth; below a block on a wire, or below the ground."""
    scene = Scene(name="rig", gravity=G)
    scene.add_body("load", mass=MASS, size=SIZE, position=(0.0, 0.0, -depth))
    top = -depth + 1.5 + REACH * np.tan(STEEP)
    hook = {"first": "ground", "first_point": (0.0, 0.0, top)}
    if block:
        scene.add_body("block", mass=BLOCK, size=(0.5, 0.5, 0.5), position=(0.0, 0.0, top))
        scene.add_line("wire", first="ground", second="block", first_point=(0.0, 0.0, top + 10.0), EA=1e8,
                       tension_at_start=DRY + BLOCK * G)  # fmt: skip
        hook = {"first": "block", "first_point": (0.0, 0.0, 0.0)}
    for i, point in enumerate(points):
        scene.add_line(f"sling {i + 1}", second="load", second_point=point, EA=EA, **hook)
    scene.add_immersed("load", parts=[BoxPart(size=VOLUME, point=at)], density=RHO)
    return scene


def by_energy(points: Array, lift: float, at: Any) -> Array:
    """Tensions of slings from one point where the energy of a load that hangs on them is least, N."""
    top = np.array([0.0, 0.0, 1.5 + REACH * np.tan(STEEP)])
    lengths = np.linalg.norm(points - top, axis=1)

    def pulls(x: Array) -> tuple[Array, Array, Rotation]:
        turn = Rotation.from_rotvec(x[3:])
        stretch = np.linalg.norm(x[:3] + turn.apply(points) - top, axis=1) / lengths - 1.0
        return EA * np.maximum(stretch, 0.0), stretch, turn

    def energy(x: Array) -> float:
        tension, stretch, turn = pulls(x)
        stored = 0.5 * float(np.sum(tension * np.maximum(stretch, 0.0) * lengths))
        return (stored + DRY * x[2] - lift * (x[2] + float(turn.apply(at)[2]))) / DRY

    found = np.zeros(6)
    for _ in range(4):
        found = minimize(energy, found, method="BFGS", options={"gtol": 1e-9}).x
    return np.asarray(pulls(found)[0])


@pytest.mark.parametrize("block", [True, False])
@pytest.mark.parametrize(("points", "at"), [(THREE, (0.6, 0.4, 0.3)), (CORNERS, (1.0, 0.5, 0.0))])
def test_slings_beside_the_centre_of_buoyancy_carry_what_least_energy_says(
    points: Array, at: Any, block: bool
) -> None:
    """The lesser in air and under water, of three slings by statics alone and of four by their stretch."""
    least = least_pulls(rigged(-8.0, points=points, at=at, block=block))
    expected = np.minimum(by_energy(points, 0.0, at), by_energy(points, LIFT, at))
    found = [least[f"sling {i + 1}"] for i in range(len(points))]
    assert found == pytest.approx(expected.tolist(), rel=2e-4)
    assert np.ptp(found) > 0.1 * np.mean(found)


@pytest.mark.parametrize(("depth", "filled"), [(-8.0, False), (60.0, False), (-8.0, True)])
def test_each_of_four_slings_carries_a_quarter_of_what_the_water_does_not(depth: float, filled: bool) -> None:
    """Wherever the load is described; what runs into a compartment weighs under water."""
    scene, inside = rigged(depth), 0.0
    if filled:
        holes = [Opening(point=(0.0, 0.0, side), area=0.2) for side in (-1.0, 1.0)]
        water = Compartment(area=3.0, height=2.0, point=(0.0, 0.0, -1.0), openings=holes)
        scene.add_immersed("load", inside=water, density=RHO)
        inside = RHO * G * 6.0
    least = least_pulls(scene)
    assert least["wire"] == pytest.approx(DRY + BLOCK * G - LIFT + inside, rel=1e-12)
    quarter = (DRY - LIFT + inside) / 4.0 / np.sin(STEEP)
    assert [least[f"sling {i}"] for i in (1, 2, 3, 4)] == pytest.approx([quarter] * 4, rel=1e-3)


def test_the_margin_is_one_at_rest_and_none_of_a_slack_sling() -> None:
    """Under water, with the fourth sling a tenth longer than its path, and on two places."""
    scene = rigged(30.0)
    scene.add_limit_state("slack[sling 2]")
    scene.add_limit_state("slack_margin", minimum=1.2, name="too much")
    result = simulate(scene, t_end=0.5, dt_out=0.1, start="rest")
    assert result.coords["weighed"] == ("wire", "sling 1", "sling 2", "sling 3", "sling 4")
    assert result["slack_margin"] == pytest.approx(1.0, abs=1e-4)
    one, other = result.utilisation
    assert one.kept and one.utilisation == pytest.approx(0.1, rel=1e-3) and not other.kept
    loose = rigged(-8.0)
    loose.replace("sling 4", length=1.1 * loose.loads["sling 4"].length.evaluate([0.0])[0, 0])
    loose.add_limit_state("slack")
    result = simulate(loose, t_end=0.1, dt_out=0.1, start="rest")
    assert np.all(result.select("slack_margin", weighed="sling 4") == 0.0)
    (state,) = result.utilisation
    assert not state.kept and state.curve == "sling 4"
    tagged = rigged(30.0, block=False)
    tagged.add_body("post", mass=1e3, size=(1.0, 1.0, 1.0), position=(30.0, 0.0, -30.0))
    tagged.add_joint("foot", kind="weld", first="ground", second="post", point=(30.0, 0.0, -30.0))
    tagged.add_line("tag", first="post", second="load", EA=1e6, tension_at_start=1e3)
    with pytest.raises(SceneError, match="'slack_margin' is unknown to this scene"):
        simulate(tagged, t_end=0.1, channels=["slack_margin"])
