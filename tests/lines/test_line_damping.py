"""The damping that lines work out themselves: 2 % of the bounce, whichever way their path is written."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, hung

from seacrane import Scene, equilibrium, natural_modes, simulate
from seacrane.crane import Payload, load_crane
from seacrane.hydro import shipped_database
from seacrane.water import BoxPart


def below_a_ship(order: int) -> Scene:
    scene = Scene(name="order")
    scene.add_vessel(shipped_database())
    scene.add_body(name="load", mass=MASS, inertia=(MASS, MASS, MASS), position=(0, 40, 5))
    scene.add_line(
        name="hoist", bodies=["vessel", "load"][::order], points=[(0, 40, 25), (0, 0, 0)][::order],
        EA=2e7, tension_at_start=0.8 * MASS * G,
    )  # fmt: skip
    return scene


def bounce(scene: Scene, name: str = "hoist") -> tuple[float, float, float]:
    """Mass (kg), frequency (rad/s) and ratio."""
    return scene.compile().line_bounces[name]


def test_the_order_of_the_ends_does_not_matter() -> None:
    there, back = (bounce(below_a_ship(order)) for order in (1, -1))
    assert there == pytest.approx(back, rel=1e-12)
    assert 0.8 * MASS < there[0] < MASS and there[2] == pytest.approx(0.02)
    left = []
    for order in (1, -1):
        result = simulate(below_a_ship(order), 8.0, dt_out=0.01, rtol=1e-7)
        left.append(np.ptp(result["line_tension"][600:, 0]))
    assert left[0] == pytest.approx(left[1], rel=1e-3)


@pytest.mark.parametrize("falls", [1, 2, 3])
def test_falls_count(falls: int) -> None:
    scene = hung(falls=falls, damping=0.02)
    scene.replace("hoist", mass=0.0)
    mass, omega, ratio = bounce(scene)
    assert mass == pytest.approx(MASS / falls**2, rel=1e-9)
    assert omega == pytest.approx(np.sqrt(STIFFNESS / MASS), rel=1e-9)
    assert ratio == pytest.approx(0.02)
    modes = natural_modes(scene, state=equilibrium(scene))
    assert np.max(modes.damping_ratio) == pytest.approx(0.02, rel=1e-2)


def test_a_load_below_the_ground_is_to_the_bit_what_it_was() -> None:
    default, given = (hung(damping=0.05, stretch=0.02) for _ in range(2))
    default.replace("hoist", mass=0.0)
    given.replace("hoist", mass=MASS)
    runs = [simulate(scene, 1.0, dt_out=0.1)["line_tension"] for scene in (default, given)]
    assert np.array_equal(*runs)


def on_slings(**line: Any) -> Scene:
    """20 t on four stiff slings below a hook of 500 kg on a soft hoist."""
    scene = Scene(name="slings")
    scene.add_body(name="hook", mass=500.0, inertia=(50.0, 50.0, 50.0), position=(0, 0, -20.0))
    scene.add_body(name="box", mass=MASS, inertia=(4e4, 4e4, 6e4), position=(0, 0, -25.0))
    scene.add_bridle(
        name="sling", hook="hook", load="box", EA=2e8,
        points=[(2, 1, 1), (-2, 1, 1), (-2, -1, 1), (2, -1, 1)],
    )  # fmt: skip
    scene.add_line(
        name="hoist", bodies=["ground", "hook"], points=np.zeros((2, 3)), EA=3e7,
        tension_at_start=(MASS + 500.0) * G, **line,
    )  # fmt: skip
    return scene


def test_all_that_hangs_on_a_hook_counts() -> None:
    mass, _, ratio = bounce(on_slings())
    assert mass == pytest.approx(MASS + 500.0, rel=0.05)
    assert ratio == pytest.approx(0.02, rel=0.05)
    modes = natural_modes(on_slings(), state=equilibrium(on_slings()))
    period = 2.0 * np.pi * np.sqrt((MASS + 500.0) * 20.0 / 3e7)
    heave = int(np.argmin(np.abs(modes.natural_period / period - 1.0)))
    assert modes.damping_ratio[heave] == pytest.approx(0.02, rel=0.05)


def test_a_boom_on_its_luffing_rope_is_damped_by_two_percent() -> None:
    scene = Scene(name="boom on its rope")
    scene.add_crane(
        load_crane("lattice_boom_100t"), base="ground", foot=(0, 0, 0), coordinates={"boom": 1.0},
        payload=Payload(mass=50e3, link_length=20.0), held=True, damping=False,
    )  # fmt: skip
    rope = scene.add_luffing_rope(lag=0.3).name
    modes = natural_modes(scene, state=equilibrium(scene))
    fastest = int(np.argmin(modes.natural_period))
    assert modes.damping_ratio[fastest] == pytest.approx(0.02, rel=0.1)
    assert bounce(scene, rope)[2] == pytest.approx(0.02)
    assert 2.0 * np.pi / bounce(scene, rope)[1] == pytest.approx(modes.natural_period[fastest], rel=0.05)


def test_a_mass_that_is_given_is_taken_and_its_ratio_told() -> None:
    scene = hung(damping=0.02)
    scene.replace("hoist", mass=100.0 * MASS)
    assert bounce(scene)[2] == pytest.approx(0.2)
    told = dict(scene.report()["lines"])["hoist"]
    assert told == "bounces in 0.513 s, damped by 20 % of critical, as 2e+04 kg on it"


def test_what_hangs_on_a_seat_counts_as_lifted() -> None:
    scene = Scene(name="deck")
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0))
    scene.add_joint(kind="weld", name="deck", first="ground", second="load")
    scene.add_seat(joint="deck")
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=5e7)
    assert bounce(scene)[0] == pytest.approx(MASS, rel=1e-9)


def in_the_surface(seed: int | None) -> Scene:
    scene = Scene(name="in the surface")
    scene.add_body(name="load", mass=MASS, inertia=(MASS, MASS, MASS))
    scene.add_immersed("load", parts=[BoxPart(size=(4.0, 3.0, 2.0), strips=(2, 2), fill=0.2)])
    scene.add_line(name="hoist", bodies=["ground", "load"], points=[(0, 0, 30), (0, 0, 0)], EA=2e7,
                   tension_at_start=0.5 * MASS * G)  # fmt: skip
    if seed is not None:
        scene.add_sea(vessel=None, hs=3.0, tp=8.0, seed=seed)
    return scene


def test_what_is_wet_in_a_wave_at_the_start_does_not_count() -> None:
    still, *seas = (bounce(in_the_surface(seed)) for seed in (None, 1, 2, 3))
    assert still[0] > 1.1 * MASS
    assert seas == [still] * 3
