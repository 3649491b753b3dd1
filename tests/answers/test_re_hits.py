"""Re-hits over seeds: how high a ball flies by hand, and exact intervals by the beta distribution."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import beta

from seacrane import Scene, SceneError, ensemble, simulate
from seacrane.answers import ReHit, re_hit_probability
from seacrane.answers.re_hits import share_of

G = 9.80665


def ball(seed: float, name: str = "feet") -> Scene:
    """Leaves the ground with a speed that goes by its seed, 1, 2, 3 ... m/s, and comes back."""
    scene = Scene(name="ball", gravity=G)
    scene.add_body("ball", mass=10.0, inertia=(1.0,) * 3, position=(0, 0, 1e-3), velocity=(0, 0, float(seed)))
    scene.add_contact("ball", points=[(0, 0, 0)], on="ground", stiffness=1e5, damping=0.9, name=name)
    return scene


def test_a_contact_whose_name_begins_alike_is_another() -> None:
    """The ball is stopped by "feet.aft", which stands higher than "feet"."""
    scene = ball(3, "feet.aft")
    scene.add_contact("ball", points=[(0, 0, 0.5)], on="ground", stiffness=1e5, damping=0.9, name="feet")
    result = simulate(scene, t_end=1.2, dt_out=0.01, channels=["contact_least_gap", "contact_press"])
    assert ReHit(contact="feet.aft", margin=0.3)(result)[1] == 1.0
    without = simulate(scene, t_end=1.2, dt_out=0.01, channels=["contact_least_gap"])
    with pytest.raises(SceneError, match='no channel "contact_press"'):
        ReHit(contact="feet.aft", margin=0.3)(without)
    assert ReHit(contact="feet", margin=0.3)(result).tolist() == [1.0, 0.0, 0.0, 0.0]


def test_re_hits_are_counted_over_seeds() -> None:
    """Of 1 to 4 m/s the rise is 0.05, 0.20, 0.46 and 0.82 m: two are free by 0.3 m, and both come back."""
    done = ensemble(
        ball, over={"seed": [1, 2, 3, 4]}, t_end=1.2, keep={"hit": ReHit(contact="feet", margin=0.3)},
        dt_out=0.01, channels=["contact_least_gap", "contact_press"],
    )  # fmt: skip
    found = re_hit_probability(done.dataset["hit"]).dataset
    assert (int(found["runs"]), int(found["hits"]), int(found["never_free"])) == (2, 2, 2)
    assert float(found["low"]) == pytest.approx(0.025**0.5) and float(found["high"]) == 1.0
    assert float(found["speed"]) == pytest.approx(4.0, rel=0.01)
    assert "probability" in str(re_hit_probability(done.dataset["hit"]))


def test_the_interval_of_a_share_is_that_of_the_beta_distribution() -> None:
    found = share_of(3, 40)
    assert found.low == pytest.approx(beta.ppf(0.025, 3, 38))
    assert found.high == pytest.approx(beta.ppf(0.975, 4, 37))
    assert share_of(0, 40).low == 0.0 and np.isnan(share_of(0, 0).value)
