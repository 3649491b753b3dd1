"""Contact: rebounds, sticking and sliding against closed forms; ledger, momentum, restarts, formulations."""

from __future__ import annotations

from typing import Any

import contact_scenes as made
import numpy as np
import pytest
from contact_scenes import FEET, GRAVITY, MASS, REBOUNDS, STIFFNESS
from element_runs import FORMULATIONS, goes_on

from seacrane import Curve, Result, Scene, SceneError, Stage, Until, equilibrium, shipped_database, simulate
from seacrane.answers import contact_hits
from seacrane.warnings import ContactStartWarning, SeabedWarning


def lost(result: Result) -> Any:
    return np.asarray(result.select("load_state", state_name="feet.friction_loss"))


def kinds(result: Result, point: str) -> list[str]:
    return [event.kind for event in result.events if event.name == point]


@pytest.mark.parametrize(("loss", "restitution", "deepest"), REBOUNDS)
def test_a_ball_rebounds_as_the_law_of_the_surface_says(
    loss: float, restitution: float, deepest: float
) -> None:
    speed = 2.0
    result = simulate(made.ball(speed, loss / speed), t_end=0.2, dt_out=2e-4, rtol=1e-10)
    assert [(e.name, e.kind) for e in result.events] == [("wall.1", "contact"), ("wall.1", "release")]
    assert result.events[0].time == pytest.approx(0.1 / speed, abs=1e-9)
    assert result.events[0].speed == pytest.approx(speed, rel=1e-9)
    away = float(result.select("velocity", body="ball", axis="z")[-1])
    assert away / speed == pytest.approx(restitution, abs=2e-8)
    least = -float(result["contact_gap"].min())
    assert least / (speed * np.sqrt(MASS / STIFFNESS)) == pytest.approx(deepest, rel=2e-5)
    assert float(result["contact_press"].min()) >= 0.0
    assert np.abs(result["energy_balance"]).max() < 1e-6 * 0.5 * MASS * speed**2


@pytest.mark.warns("UnitWarning")
def test_a_block_slides_on_a_shaken_plate_as_in_closed_form() -> None:
    mu, omega = 0.3, np.pi
    share = mu * GRAVITY / omega**2
    slipped = 2.0 * np.sqrt(1.0 - (np.pi * share / 2.0) ** 2)
    of_cycle = []
    for hold in (4e-7, 1e-7):
        result = simulate(made.shaken(hold=hold), t_end=4.0, dt_out=1.0, rtol=1e-9)
        of_cycle.append((lost(result)[4] - lost(result)[2]) / MASS)
        assert kinds(result, "feet.1").count("slip") == 4  # at each turn of the plate
    exact = 2.0 * slipped * mu * GRAVITY
    errors = [one / exact - 1.0 for one in of_cycle]
    # the spring turns within a time that goes with the root of what it gives
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.02)
    assert 2.0 * of_cycle[1] - of_cycle[0] == pytest.approx(exact, rel=2e-6)


@pytest.mark.parametrize(("roll_deg", "slides"), [(12.82, False), (12.84, True)])
def test_a_block_slides_on_a_rolling_deck_beyond_its_angle(roll_deg: float, slides: bool) -> None:
    """The closed form is 12.831052 deg."""
    result = simulate(made.rolling(roll_deg), t_end=47.0, dt_out=0.05, rtol=1e-8)
    for foot in range(1, 5):
        assert ("slip" in kinds(result, f"feet.{foot}")) == slides
    assert (float(result["contact_slip"].max()) > 0.0) == slides


def test_a_block_sticks_for_an_hour_without_creep() -> None:
    result = simulate(made.slope(10.0), t_end=3600.0, dt_out=60.0, rtol=1e-6, integrator="cvode-bdf")
    place = np.asarray(result["position"])[:, 0]
    settled = result.time >= 60.0
    assert np.abs(place[settled] - place[settled][0]).max() < 1e-12
    names = [name for name in result.coords["state_name"] if "anchor" in name]
    anchors = np.stack([np.asarray(result.select("load_state", state_name=name)) for name in names])
    assert np.array_equal(anchors[:, 0], anchors[:, -1])
    assert not result.events


def test_momentum_goes_through_a_contact() -> None:
    result = simulate(made.spun(), t_end=1.0, dt_out=0.01, rtol=1e-11)
    assert kinds(result, "touch.1")[:1] == ["contact"]
    scene = made.spun()
    linear, angular = np.zeros((len(result.time), 3)), np.zeros((len(result.time), 3))
    for i, body in enumerate(scene.bodies.values()):
        v, x, w = (np.asarray(result[key])[:, i] for key in ("velocity", "position", "angular_velocity"))
        linear += body.mass * v
        angular += np.cross(x, body.mass * v) + w * body.inertia[0, 0]  # balls
    for momentum in (linear, angular):
        assert np.abs(momentum - momentum[0]).max() < 1e-9 * np.abs(momentum).max()
    assert result.select("load_state", state_name="touch.friction_loss")[-1] > 1.0


@pytest.mark.parametrize(
    ("how", "within"),
    [
        ({"formulation": "recursive", "rtol": 1e-9}, 1e-6),
        ({"integrator": "dopri5-stiff", "rtol": 1e-9}, 1e-6),
        ({"integrator": "rosenbrock", "rtol": 1e-8}, 1e-6),
        ({"integrator": "generalized-alpha", "dt": 2.5e-4}, 1e-3),
    ],
)
def test_formulations_and_methods_agree(how: dict[str, Any], within: float) -> None:
    """Feet touch, slide, stick and lift off some forty times on the way."""
    truth = simulate(made.thrown(), t_end=1.0, dt_out=1.0, rtol=1e-10, formulation="redundant")
    other = simulate(made.thrown(), t_end=1.0, dt_out=1.0, **how)
    np.testing.assert_allclose(other["position"][-1], truth["position"][-1], atol=within)
    assert len(truth.events) > 30


def test_a_thrown_load_lands_closes_its_ledger_and_goes_on_bit_for_bit() -> None:
    for formulation in FORMULATIONS:
        result = simulate(made.thrown(), t_end=4.0, dt_out=0.02, rtol=1e-9, formulation=formulation)
        fallen = MASS * GRAVITY * 0.5
        assert np.abs(result["energy_balance"]).max() < 1e-6 * fallen
        assert lost(result)[-1] > 0.1 * fallen
        assert {event.name for event in result.events} == {f"feet.{i}" for i in range(1, 5)}
        assert result["contact_press"][-1].sum() == pytest.approx(MASS * GRAVITY, rel=1e-3)
    for at in (0.2, 0.45, 1.0):
        goes_on(made.thrown, 2.0, at, dt_out=0.05)


@pytest.mark.parametrize(
    ("given", "told"),
    [
        ({"friction": 0.3, "stiffness": 0.0}, "friction 0.3 and a stiffness of 0"),
        ({"surface": "pipe", "size": (2.0, 2.02, 3.0), "edge": 0.05}, "0.01 m where it is thinnest"),
        ({"on": "load"}, "body and on 'load'"),
        ({"stiffness": 1e5, "table": [(0.0, 0.0), (0.1, 1e3)]}, "a stiffness and a table"),
        ({"table": [(0.1, 0.0), (0.2, 1e3)]}, "both from 0"),
        ({"place": (0.0, 0.0, 9.3)}, "point 1 of 'load' starts 0.3 m inside 'ground'"),
    ],
)  # fmt: skip
def test_bad_contacts_are_refused_by_name(given: dict[str, Any], told: str) -> None:
    scene = Scene(name="bad")
    scene.add_body(name="load", mass=MASS, inertia=(1e3,) * 3, position=(0.0, 0.0, 9.0))
    with pytest.raises(SceneError, match=f"contact '.*{told}"):
        scene.add_contact("load", **{"points": FEET, "on": "ground"} | given)
        scene.compile()


def test_what_starts_inside_a_surface_is_told_and_refused_of_a_stage() -> None:
    scene, place = Scene(name="deck", gravity=GRAVITY), (0.0, 0.0, 2.0)
    scene.add_body("load", mass=MASS, size=(8, 6, 4), position=place)
    scene.add_contact(
        "load", on="ground", points=[(0, 0, -2)], place=(0, 0, 0.01), name="deck", stiffness=3e6
    )
    with pytest.warns(ContactStartWarning, match=r"point 1 of 'load' starts 0\.01 m inside"):
        simulate(scene, 0.01)
    stages = [Stage(name="fall", duration=1.0), Stage(name="on", duration=1.0, connect=["deck"])]
    with pytest.raises(SceneError, match=r"stage 'on': contact 'deck' .* point 1 .* inside 'ground'"):
        simulate(scene, stages)


def test_feet_sink_by_what_they_bear_in_a_seabed_or_under_what_is_welded_to_them() -> None:
    scene = Scene(name="welded", gravity=GRAVITY)
    scene.add_body("frame", mass=MASS, inertia=(1e3,) * 3, position=(0.0, 0.0, 0.005))
    scene.add_body("module", mass=9.0 * MASS, inertia=(1e3,) * 3, position=(0.0, 0.0, 1.0))
    scene.add_joint(kind="weld", name="bolts", first="frame", second="module")
    scene.add_contact("frame", points=FEET, on="ground", name="feet")
    assert simulate(scene, 10.0, dt_out=1.0)["contact_gap"][-1] == pytest.approx(-0.01, rel=1e-3)
    scene = Scene(name="seabed", gravity=GRAVITY)
    scene.add_body(name="load", mass=MASS, inertia=(1e3,) * 3, position=(0.0, 0.0, -39.99))
    for wrong in (
        {"on": "seabed"},
        {"on": "ground", "depth": 3.0},
        {"on": "seabed", "depth": 3.0, "place": FEET[0]},
    ):
        with pytest.raises(SceneError, match=r"load on .*(depth|place)"):
            scene.add_contact("load", points=FEET, **wrong)
    with pytest.warns(SeabedWarning, match="'load on seabed'"):
        made = scene.add_contact("load", on="seabed", points=FEET, depth=40.0)
    assert made.stiffness == pytest.approx(MASS * GRAVITY / 4.0 / 0.01)
    gap = simulate(scene, t_end=5.0, dt_out=0.5)["contact_gap"]
    assert float(gap[-1].mean()) == pytest.approx(-0.01, abs=1e-4)


@pytest.mark.parametrize("rammed", [False, True])
def test_a_hit_sideways_bears_no_weight_and_counts_the_mass_that_moves(rammed: bool) -> None:
    """Of a ship whose motion is given the points are on a light body that stands for it."""
    mass, speed, stiffness = 50e3, 0.3, 2e6
    scene = Scene(name="bumper", gravity=GRAVITY)
    if rammed:
        scene.add_vessel(motion="rest", name="ship", position=(-20.0, 0.0, 0.0))
    scene.add_body("module", mass=mass, size=(8, 6, 4), velocity=(-speed if rammed else speed, 0, 0))
    scene.add_joint(kind="prismatic", name="rail", first="ground", second="module", axis=(1, 0, 0))
    how: dict[str, Any] = {"stiffness": stiffness, "damping": 0.0, "name": "side"}
    if rammed:
        scene.add_contact(
            "ship", on="module", points=[(15.0, 0, 0)], place=(-4, 0, 0), axis=(-1, 0, 0), **how
        )
    else:
        how |= {"surface": "post", "place": (4.5, 0, 0), "size": (0.5, 6)}
        scene.add_contact("module", on="ground", points=[(4, 0, 0)], **how)
    hit = contact_hits(simulate(scene, 5.0, dt_out=0.001), "side")[0]
    assert hit.undamped == pytest.approx(speed * np.sqrt(stiffness * mass), rel=1e-6)
    assert hit.peak == pytest.approx(hit.undamped, rel=1e-3)


LOAD, WIRE = 40e3, 2.0e8


def hung(height: float, *, short: float = 0.0, rate: float = 0.0) -> Scene:
    """A load on a wire, its feet `height` over the ground, one of them shorter, lowered from 2 s on."""
    scene = Scene(name="landing", gravity=GRAVITY)
    scene.add_body(name="load", mass=LOAD, size=(4.0, 3.0, 2.0), position=(0.0, 0.0, height + 1.0))
    points = [(-2.0, -1.5, -1.0), (2.0, -1.5, -1.0), (2.0, 1.5, -1.0 + short), (-2.0, 1.5, -1.0)]
    scene.add_contact("load", on="ground", points=points, friction=0.3, name="feet")
    scene.add_line(name="wire", first="ground", second="load", first_point=(0.0, 0.0, height + 25.0),
                   second_point=(0.0, 0.0, 1.0), EA=WIRE, tension_at_start=LOAD * GRAVITY)  # fmt: skip
    scene.add_winch(line="wire", rate=Curve.quintic(start_time=1.0, end_time=2.0, start=0.0, end=rate))
    return scene


def test_four_feet_of_unequal_height_land_and_their_hits_are_told() -> None:
    result = simulate(hung(0.5, short=0.05, rate=0.4), t_end=12.0, dt_out=0.002)
    hits = contact_hits(result, "feet")
    first = {hit.point: hit for hit in hits if hit.number == 1}
    assert set(first) == {f"feet.{i}" for i in range(1, 5)}
    assert first["feet.3"].begin > max(first[f"feet.{i}"].begin for i in (1, 2, 4))
    for i in (1, 2, 4):
        assert first[f"feet.{i}"].speed == pytest.approx(0.4, rel=0.05)
    for i in (2, 4):  # those beside the short one carry the load
        assert first[f"feet.{i}"].peak == pytest.approx(first[f"feet.{i}"].undamped, rel=0.15)
    press = np.asarray(result["contact_press"])
    total = sum(hit.impulse for hit in hits)
    assert total == pytest.approx(float(np.trapezoid(press.sum(axis=1), result.time)), rel=1e-3)
    # the ground's and the wire's impulse against that of weight is the change of momentum, none at both ends
    tension = np.asarray(result.select("line_tension", line="wire"))
    given = total + float(np.trapezoid(tension, result.time))
    assert given == pytest.approx(LOAD * GRAVITY * 12.0, rel=1e-3)


def test_one_contact_of_64_points_is_two_of_32() -> None:
    points = [(x - 3.5, y - 3.5, -1e-3 * (8 * x + y)) for x in range(8) for y in range(8)]

    def landed(**parts: list[tuple[float, float, float]]) -> tuple[np.ndarray, list[float]]:
        scene = Scene(name="mat", gravity=GRAVITY)
        scene.add_body("mat", mass=6400.0, inertia=(4e4, 4e4, 8e4), position=(0.0, 0.0, 0.5))
        for name, own in parts.items():
            scene.add_contact("mat", on="ground", name=name, points=own, stiffness=1e6, damping=0.3)
        result = simulate(scene, t_end=1.0, dt_out=0.01, rtol=1e-9)
        return np.asarray(result["position"]), sorted(e.time for e in result.events if e.kind == "contact")

    (place, touches), (other, others) = landed(all=points), landed(low=points[:32], high=points[32:])
    assert len(touches) >= 64 and touches == pytest.approx(others, abs=1e-6)
    np.testing.assert_allclose(place, other, atol=1e-7)


def test_a_fender_gives_by_its_table() -> None:
    scene = Scene(name="fender", gravity=GRAVITY)
    weight = 1000.0 * GRAVITY
    scene.add_body(name="load", mass=1000.0, inertia=(1e3,) * 3, position=(0.0, 0.0, 0.0))
    table = [(0.0, 0.0), (0.1, 0.5 * weight), (0.2, 2.0 * weight)]
    scene.add_contact("load", on="ground", points=[(0.0, 0.0, 0.0)], table=table, damping=2.0)
    result = simulate(scene, t_end=20.0, dt_out=0.05)
    assert float(result["contact_gap"][-1, 0]) == pytest.approx(-(0.1 + 0.5 / 15.0), abs=1e-4)
    deepest = -float(result["contact_gap"].min())
    assert np.abs(result["energy_balance"]).max() < 1e-6 * weight * deepest


def test_stages_end_on_contact_and_when_all_feet_are_clear() -> None:
    down, up, long = {"wire.rate": 0.2}, {"wire.rate": -0.1}, {"maximum_duration": 20.0}
    stages = [
        Stage(name="without", duration=1.0),
        Stage(name="lower", connect=["feet"], until=Until.contact("feet"), commands=down, **long),
        Stage(name="slack", duration=2.0, commands={"wire.rate": 0.0}),
        Stage(name="lift", until=Until.release("feet"), commands=up, **long),
        Stage(name="raise", until=Until.clear("feet", minimum=0.5), **long),
    ]
    result = simulate(hung(0.5), stages)
    gap = np.asarray(result["contact_least_gap"])[:, 0]
    spans = {span.name: span for span in result.stages}
    for name, level in (("lower", 0.0), ("lift", 0.0), ("raise", 0.5)):
        assert np.interp(spans[name].end, result.time, gap) == pytest.approx(level, abs=1e-6)


def test_a_load_rests_on_the_deck_of_a_ship() -> None:
    scene = Scene(name="on deck")
    scene.add_vessel(shipped_database())
    (hull,) = scene.vessels
    scene.add_body(name="load", mass=50e3, size=(4, 3, 2), position=(10.0, 0.0, 9.0))
    deck = np.array([10.0, 0.0, 8.0]) - scene.place_of(hull)
    feet = [(x, y, -1.0) for x in (-2.0, 2.0) for y in (-1.5, 1.5)]
    scene.add_contact("load", on=hull, points=feet, place=deck, friction=0.3, name="feet")
    rest = equilibrium(scene)
    assert rest.load_states["feet.1.anchor_x"] == pytest.approx(-2.0, abs=1e-3)
    still = simulate(scene, t_end=20.0, start="rest", dt_out=1.0)
    moved = np.asarray(still.select("position", body="load"))
    assert np.abs(moved - moved[0]).max() < 1e-6
    assert not still.events
    press = np.asarray(still["contact_press"])
    assert press.sum(axis=1) == pytest.approx(50e3 * scene.gravity, rel=1e-3)


@pytest.mark.warns("UnitWarning")
def test_a_load_lifts_off_a_heaving_barge_and_hits_it_again() -> None:
    from scipy.integrate import solve_ivp
    from scipy.optimize import brentq

    heave, omega, stretch, rate = 1.0, 2.0 * np.pi / 7.0, 4.0e5, 0.1

    def pressed(t: float) -> float:
        z = heave * np.sin(omega * t)
        return MASS * (GRAVITY - omega**2 * z) - max(stretch * (rate * t - z), 0.0)

    time = np.linspace(0.0, 10.0, 10001)
    first = int(np.flatnonzero(np.array([pressed(t) for t in time]) < 0.0)[0])
    off = brentq(pressed, time[first - 1], time[first])

    def free(t: float, y: Any) -> list[float]:
        return [y[1], max(stretch * (rate * t - y[0]), 0.0) / MASS - GRAVITY]

    def hit(t: float, y: Any) -> float:
        return float(y[0] - heave * np.sin(omega * t))

    hit.terminal, hit.direction = True, -1.0  # type: ignore[attr-defined]
    start = [heave * np.sin(omega * off), heave * omega * np.cos(omega * off)]
    path = solve_ivp(free, (off + 1e-9, 20.0), start, rtol=1e-10, atol=1e-12, events=hit)
    again = float(path.t_events[0][0])
    speed = heave * omega * np.cos(omega * again) - float(path.y_events[0][0][1])

    late = []
    for stiffness in (STIFFNESS, 16.0 * STIFFNESS):
        scene = made.lifted(heave, omega, stretch, rate, stiffness)
        result = simulate(scene, t_end=again + 0.2, dt_out=0.001, rtol=1e-9)
        lift = [e for e in result.events if e.name == "feet.1" and e.kind == "release"]
        touch = [e for e in result.events if e.name == "feet.1" and e.kind == "contact"]
        late.append([lift[0].time - off, touch[0].time - again, touch[0].speed / speed - 1.0])
    late = np.abs(late)
    assert late[0].max() < 0.02
    assert np.all(late[1] < 0.5 * late[0])
    hits = [one for one in contact_hits(result, "feet") if one.point == "feet.1"]
    assert [one.number for one in hits][:2] == [0, 1]
    assert hits[1].speed == touch[0].speed
    assert hits[1].peak == pytest.approx(hits[1].undamped, rel=0.1)
