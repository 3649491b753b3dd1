"""Many loops between several trees: sparse, with the rows that the others hold left out, as all rows say."""

from __future__ import annotations

import numpy as np
import pytest
from reference_problems import four_bars

from seacrane import Curve, Scene, simulate

pytestmark = pytest.mark.filterwarnings("ignore")


@pytest.mark.parametrize("planar", [pytest.param(True, marks=pytest.mark.slow("long runs")), False])
def test_ten_four_bars_go_round_as_elliptic_functions_say(planar: bool, formulation: str) -> None:
    """Through the pose, twice a turn, in which every loop could fold."""
    result = simulate(
        four_bars.scene(10, planar=planar), 4.0, formulation=formulation, rtol=1e-9, dt_out=0.05
    )
    w, _, y, _ = result.select("quaternion", body="post 0").T
    turned = 2.0 * np.arctan2(y, w)
    expected, _ = four_bars.turned(10, result.time)
    apart = np.angle(np.exp(1j * (turned - turned[0] - expected)))
    assert np.abs(apart).max() < 1e-5


def test_a_driver_of_one_post_leads_them_all() -> None:
    scene: Scene = four_bars.scene(6)
    scene.add_driver("foot 3", curve=Curve.quintic(start_time=0.0, end_time=2.0, start=0.0, end=0.6))
    for name in list(scene.bodies):
        scene.replace(name, velocity=(0.0, 0.0, 0.0), angular_velocity=(0.0, 0.0, 0.0))
    results = [simulate(scene, 2.0, formulation=form, rtol=1e-9) for form in ("recursive", "redundant")]
    for name in ("position", "driver_force"):
        one, other = (result[name] for result in results)
        assert np.abs(one - other).max() < 1e-6 * np.abs(other).max()


def test_a_rough_row_of_redundant_loops_is_closed() -> None:
    """Three of each loop's twenty rows are held by the others; Newton takes independent ones."""
    scene = four_bars.scene(12)
    for i in range(13):
        x, y, z = scene.bodies[f"post {i}"].position
        scene.replace(f"post {i}", position=(x + 0.01 * (-1) ** i, y, z - 0.005))
    model = scene.compile()
    assert model.merge["left_out"] == 36 and set(model.redundant) == set(scene.joints)
    assert model.assembly["residual_before"] > 5e-3
    assert model.assembly["residual_after"] < 1e-11
    assert model.assembly["rank"] == model.constraints - 36
