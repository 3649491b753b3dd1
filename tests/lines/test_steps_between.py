"""No step goes over what it meets and leaves again: surfaces, lines that snatch, stops, tables, the water."""

from __future__ import annotations

from itertools import islice
from typing import Any

import numpy as np
import pytest
from dropped import GRAVITY, METHODS, drops
from marks import needs_lanes

from seacrane import Run, Scene, SimulationError, Stage, Until, simulate
from seacrane.run.lanes import advance_side_by_side

FORMULATIONS = ("recursive", "redundant")
FEET = [(x, y, -1.0) for x in (-1.5, 1.5) for y in (-1.0, 1.0)]


def over_deck(height: float, thickness: float, speed: float = 0.0) -> Scene:
    """A load on four feet, `height` above a deck of the ground, whose top is z = 0."""
    scene = Scene(name="dropped", gravity=GRAVITY)
    scene.add_body("load", mass=5e3, size=(3, 2, 2), position=(0, 0, 1.0 + height), velocity=(0, 0, -speed))
    scene.add_contact("load", on="ground", points=FEET, surface="box", size=(20, 20, thickness),
                      place=(0, 0, -0.5 * thickness), name="deck")  # fmt: skip
    return scene


@pytest.mark.parametrize(
    ("seed", "count"), [(1, 100), pytest.param(2, 10_000, marks=pytest.mark.slow("ten thousand drops"))]
)
def test_nothing_passes_through_a_surface_of_any_shape(seed: int, count: int) -> None:
    assert not [(one.scene.name, one.how, told) for one in drops(seed, count) if (told := one.misses())]


def test_ida_sees_what_it_met_and_left_within_a_step() -> None:
    """A ball that turns over dips into a plane for 0.26 s of a step of 1.5 s."""
    (drop,) = islice(drops(2, 10_000), 470, 471)
    assert drop.how["integrator"] == "ida" and drop.thick == np.inf
    assert drop.misses() == ""


@pytest.mark.parametrize(
    ("method", "formulation"),
    [(method, one) for method in METHODS for one in FORMULATIONS if (method, one) != ("ida", "recursive")],
)
def test_a_load_dropped_onto_a_deck_hits_it_as_it_falls(method: str, formulation: str) -> None:
    """It meets the deck after sqrt(2 h / g), with sqrt(2 g h), and the ledger closes over the hit."""
    height = 5.0
    result = simulate(over_deck(height, 1.0), 4.0, rtol=1e-6, dt_out=0.01, integrator=method,
                      formulation=formulation)  # fmt: skip
    hit = next(event for event in result.events if event.kind == "contact")
    assert hit.time == pytest.approx(np.sqrt(2.0 * height / GRAVITY), abs=1e-4)
    assert hit.speed == pytest.approx(np.sqrt(2.0 * GRAVITY * height), abs=1e-3)
    assert result["position"][-1, 0, 2] == pytest.approx(1.0, abs=0.1)
    assert np.abs(result["energy_balance"]).max() < 1e-3 * 5e3 * GRAVITY * height


@pytest.mark.parametrize("method", ["rk4", "generalized-alpha"])
def test_a_given_step_that_leads_through_a_deck_is_refused_and_a_short_one_holds(method: str) -> None:
    given: dict[str, Any] = {"integrator": method, "formulation": "redundant", "dt_out": 0.1}
    told = r"contact 'deck': a step of .* pass through it; give a dt of at most 0\.01[23]"
    with pytest.raises(SimulationError, match=told):
        simulate(over_deck(5.0, 0.5), 4.0, dt=0.1, **given)
    assert simulate(over_deck(5.0, 0.5), 2.0, dt=0.002, **given)["position"][:, 0, 2].min() > 0.75


@needs_lanes
def test_a_tip_that_turns_about_a_standing_middle_is_met_at_each_half_turn(formulation: str) -> None:
    height, reach, spin = 1.995, 2.0, 2.0  # it dips for 0.07 s, and steps are as long as the run
    scene = Scene(name="propeller", gravity=GRAVITY)
    middle = (0.0, 0.0, height)
    scene.add_body("bar", mass=1e3, size=(4, 1, 0.5), position=middle, angular_velocity=(0, spin, 0))
    scene.add_joint("shaft", kind="revolute", first="ground", second="bar", point=middle, axis=(0, 1, 0))
    scene.add_contact("bar", on="ground", points=[(reach, 0, 0), (-reach, 0, 0)], stiffness=1e4, name="tips")
    result = simulate(scene, 10.0, dt_out=10.0, formulation=formulation)
    touches = [event.time for event in result.events if event.kind == "contact"]
    assert len(touches) == 6
    assert touches[0] == pytest.approx((0.5 * np.pi - np.arccos(height / reach)) / spin, abs=1e-6)


def test_lanes_step_over_no_deck() -> None:
    given: dict[str, Any] = {"t_end": 3.0, "rtol": 1e-3, "formulation": "recursive", "dt_out": 0.1}
    runs = [Run(over_deck(4.0, 1.0, speed), **given) for speed in (0.0, 1.0, 3.0, 6.0)]
    assert advance_side_by_side(runs, 4, lambda _: None)
    assert all("kept_apart" not in run.lanes for run in runs)
    for run in runs:
        assert run.result()["position"][:, 0, 2].min() > 0.5


def test_a_load_that_a_stage_lets_go_hits_the_deck_and_ends_the_stage_there() -> None:
    scene = over_deck(5.0, 0.5)
    scene.add_line("w", first="ground", first_point=(0, 0, 30), second="load", EA=1e7,
                   tension_at_start=5e3 * GRAVITY)  # fmt: skip
    hold = Stage(name="hold", duration=2.0)
    until = {"until": Until.contact("deck"), "maximum_duration": 9.0}
    ended = simulate(scene, [hold, Stage(name="lost", release=["w"], **until)])
    assert ended.stages[-1].end == pytest.approx(2.0 + np.sqrt(2.0 * 5.0 / GRAVITY), abs=2e-3)
    result = simulate(scene, [hold, Stage(name="lost", duration=4.0, release=["w"])])
    hit = next(event for event in result.events if event.kind == "contact")
    assert hit.speed == pytest.approx(np.sqrt(2.0 * GRAVITY * 5.0), rel=1e-3)
    assert result["position"][-1, 0, 2] > 0.9


@pytest.mark.warns(sometimes=["LineLengthWarning"])
@pytest.mark.parametrize(("speed", "held_by"), [(10.0, "leash"), (9.0, "leash"), (10.0, "stop")])
def test_what_holds_for_a_moment_is_met_within_one_step(speed: float, held_by: str, formulation: str) -> None:
    """A bob thrown up beyond the length of its line or onto a stop is held, and less high it is free."""
    scene = Scene(name="thrown up", gravity=GRAVITY)
    scene.add_body("bob", mass=100.0, inertia=(10.0,) * 3, velocity=(0.0, 0.0, speed))
    if held_by == "leash":
        ends: dict[str, Any] = {"first": "ground", "second": "bob", "first_point": (0.0, 0.0, -1.0)}
        scene.add_line("leash", length=5.9, EA=1e6, **ends)
    else:
        scene.add_joint(kind="prismatic", name="mast", first="ground", second="bob", axis=(0.0, 0.0, 1.0))
        scene.add_stop(joint="mast", maximum=4.9, stiffness=1e6)
    result = simulate(scene, 2.0, formulation=formulation, rtol=1e-2, dt_out=0.01)
    highest, free = result["position"][:, 0, 2].max(), 0.5 * speed**2 / GRAVITY
    if held_by == "leash":
        beyond = max(speed**2 - 2.0 * GRAVITY * 4.9, 0.0)
        assert (result["line_tension"].max() > 0.0) == (beyond > 0.0)
        assert highest == pytest.approx(min(free, 4.9) + np.sqrt(beyond * 100.0 * 5.9 / 1e6), abs=0.01)
    else:
        assert highest < 4.95 and result["position"][-1, 0, 2] < 0.2  # free: 5.099 m, and 0.387 m in the end


@pytest.mark.warns("ContactStartWarning")
def test_a_point_that_is_torn_off_gives_its_energy_to_the_ledger(formulation: str) -> None:
    """It leaves faster than 1 / damping: what the surface held, k p^2 / 2, is lost in it."""
    scene = Scene(name="torn off", gravity=0.0)
    scene.add_body("b", mass=1e3, inertia=(1e3,) * 3, position=(0, 0, -0.05), velocity=(0, 0, 2.0))
    scene.add_contact("b", on="ground", points=[(0, 0, 0)], stiffness=4e6, name="c")
    result = simulate(scene, 0.2, rtol=1e-8, dt_out=0.005, formulation=formulation)
    stored = 0.5 * 4e6 * 0.05**2
    assert result["velocity"][-1, 0, 2] == pytest.approx(2.0, rel=1e-9)
    assert np.abs(result["energy_balance"]).max() < 1e-6 * stored
