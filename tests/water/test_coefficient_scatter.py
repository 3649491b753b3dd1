"""What the scatter of added mass and drag does to numbers of a lift."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from test_water_follows import DEEP, DRY, HEAVE, LIFT, MASS, OMEGA, RHO, G, heaved, hung

from seacrane import Scene, SceneError, simulate
from seacrane.ensembles import coefficient_scatter
from seacrane.ensembles.coefficient_scatter import SHARES
from seacrane.water import SpherePart
from seacrane.water.added_mass import sphere_table

LEAST = {"least": "line_tension[wire, after=12].min"}


def least_pull(added: float, drag: float) -> float:
    """Of the heaved box, by hand: W + (M + A) z'' + b z' |z'|."""
    time = np.linspace(0.0, 2.0 * np.pi / OMEGA, 2001)
    speed, rate = HEAVE * OMEGA * np.sin(OMEGA * time), HEAVE * OMEGA**2 * np.cos(OMEGA * time)
    push = drag * 0.5 * RHO * 2.5 * 12.0 * speed * np.abs(speed)
    return float(np.min(DRY - LIFT + (MASS + added * DEEP[2]) * rate + push))


def test_each_coefficient_is_varied_by_its_share_as_by_hand() -> None:
    with ThreadPoolExecutor(2) as pool:
        found = coefficient_scatter(heaved(1.0, 1.0), keep=LEAST, t_end=22.0, dt_out=0.05, executor=pool)
    assert list(found.values) == [
        "as described", "less added mass", "more added mass", "less drag", "more drag",
    ]  # fmt: skip
    less, more = 1.0 - SHARES["box"]["added_mass"], 1.0 + SHARES["box"]["added_mass"]
    few, much = 1.0 - SHARES["box"]["drag"], 1.0 + SHARES["box"]["drag"]
    by_hand = [least_pull(*one) for one in ((1, 1), (less, 1), (more, 1), (1, few), (1, much))]
    assert [row["least"] for row in found.values.values()] == pytest.approx(by_hand, rel=0.03)
    changes = found.changes("least")
    assert changes["more added mass"] == pytest.approx(by_hand[2] - by_hand[0], rel=0.05)
    assert "box: added mass 30 %, drag 50 %, usual, unverified" in str(found)
    assert f"({changes['more drag']:+.2g})" in str(found)


def test_shares_of_ones_own_take_the_place_of_the_defaults() -> None:
    shares = {"box": {"added_mass": 0.1}, "sphere": {"drag": 0.1}}
    found = coefficient_scatter(heaved(1.0, 1.0), keep=LEAST, shares=shares, t_end=13.0)
    assert found.shares == {"box": {"added_mass": 0.1, "drag": SHARES["box"]["drag"]}}
    assert found.sources == {"box": "given"}


def floating() -> Scene:
    """A half-wet sphere let go above its rest."""
    scene = Scene(name="buoy", gravity=G)
    mass = RHO * np.pi / 12.0 * 8.0
    scene.add_body("buoy", mass=mass, inertia=(mass,) * 3, position=(0.0, 0.0, 0.05))
    scene.add_immersed("buoy", parts=[SpherePart(diameter=2.0, drag=0.0)], density=RHO)
    return scene


def test_a_hemisphere_that_heaves_slowly_has_the_added_mass_of_hulme() -> None:
    """0.8310 in place of 0.5: its period grows by the root of 1.831 over 1.5."""

    def crossing(scene: Scene) -> float:
        result = simulate(scene, t_end=2.0, dt_out=0.002, rtol=1e-8, channels=["position"])
        z = np.asarray(result.select("position", body="buoy", axis="z"))
        first = int(np.flatnonzero(z < 0.0)[0])
        return float(result.time[first])

    depths, fast = sphere_table()
    slow = sphere_table(slow=True)[1]
    assert np.interp(1.0, depths, fast) == pytest.approx(0.5)
    assert np.interp(1.0, depths, slow) == pytest.approx(0.8310)
    assert slow[1] / fast[1] == pytest.approx(2.0, rel=2e-3), "a piston in a wall over a disc"
    assert slow[-2] == pytest.approx(1.0, abs=1e-3)
    kept = {"quarter": lambda result: float(
        result.time[np.flatnonzero(result.select("position", body="buoy", axis="z") < 0.0)[0]]
    )}  # fmt: skip
    found = coefficient_scatter(floating(), keep=kept, t_end=2.0, dt_out=0.002, rtol=1e-8)
    ratio = found.values["added mass at zero frequency"]["quarter"] / crossing(floating())
    assert ratio == pytest.approx(np.sqrt(1.831 / 1.5), rel=0.02)


def test_what_cannot_be_is_refused_by_name() -> None:
    dry = Scene(name="dry")
    dry.add_body("load", mass=1.0, inertia=(1.0, 1.0, 1.0))
    with pytest.raises(SceneError, match="scene 'dry': has nothing in water"):
        coefficient_scatter(dry, keep=LEAST)
    wet = hung(4.0)
    for shares, message in (
        ({"pyramid": {"drag": 0.1}}, "'pyramid' has"),
        ({"box": {"slam": 0.1}}, "'box' has"),
        ({"box": {"drag": 1.5}}, "box: drag is 1.5; give a share from 0 to 1"),
        (0.3, "shares is 0.3"),
    ):
        with pytest.raises(SceneError, match=message):
            coefficient_scatter(wet, keep=LEAST, shares=shares)
    with pytest.raises(SceneError, match="'tension' is several numbers"):
        coefficient_scatter(wet, keep={"tension": "line_tension"}, t_end=0.2)
