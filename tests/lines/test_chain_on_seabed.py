"""Lines with mass on a seabed: rest, bearing, friction, energy, and how they are described."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from test_jacobian import largest_error, moving

from seacrane import Curve, Scene, SceneError, _core, simulate
from seacrane.description.forces import add_load
from seacrane.result import heavy_line_tension
from seacrane.run import Run
from seacrane.scene.chain_shape import Chain

Array = NDArray[np.float64]
FORMS = ("recursive", "redundant")
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-10}
WEIGHT, EA = 3324.385, 1.674e9  # N/m in water, N: 390 kg/m that displaces a circle of 0.252 m, g 9.81
# m: across, up, length; N at the upper end; m on the seabed: elastic catenary without friction
CATENARIES = (
    (400.0, 50.0, 410.0, 835_867.155, 552_558.152, 243.7864),
    (700.0, 200.0, 760.0, 1_406_617.851, 1_519_756.431, 302.8459),
)
BED = {"depth": 10.0, "stiffness": 2e4, "friction": 0.5}


def moored(
    segments: int, *, span: float = 400.0, depth: float = 50.0, length: float = 410.0, **bed: Any
) -> Scene:
    """A chain from an anchor to a point at the surface that stays."""
    scene = Scene(name="moored", gravity=9.81)
    scene.add_body(name="end", mass=1e3, inertia=(1e3,) * 3, position=(span, 0.0, 0.0))
    scene.add_joint(kind="weld", name="bolts", first="ground", second="end")
    scene.add_line(
        "chain", "ground", "end", first_point=(0.0, 0.0, -depth), second_point=(0.0, 0.0, 0.0),
        rung="with mass", EA=EA, length=length, mass_per_length=390.0, segments=segments, diameter=0.252,
        medium="sea", density=1025.0, seabed={"depth": depth, "stiffness": 1e6, "friction": 0.0} | bed,
    )  # fmt: skip
    return scene


def dropped(*, friction: float = 0.5, segments: int = 6, **given: Any) -> Scene:
    """A line that falls askew on a seabed 10 m below, a load at its end that slides there."""
    scene = Scene(name="dropped")
    scene.add_body(
        name="load", mass=300.0, inertia=(90.0, 80.0, 70.0), position=(14.0, 2.0, -8.5),
        velocity=(1.0, 2.0, -0.5), angular_velocity=(0.2, -0.1, 0.3),
    )  # fmt: skip
    scene.add_line(
        "line", "ground", "load", first_point=(0.0, 0.0, -4.0), second_point=(0.1, -0.2, 0.1),
        rung="with mass", EA=2e5, length=16.0, mass_per_length=40.0, segments=segments,
        damping_ratio=0.1, seabed=BED | {"friction": friction}, **given,
    )  # fmt: skip
    return scene


def block(
    *, gravity: float = 10.0, velocity: Any = (0.0, 0.0, 0.0), place: Any = (0.0, 0.0, -10.1), **bed: Any
) -> Scene:
    """100 kg on a point of the seabed, which bears 1000 N by 0.1 m."""
    scene = Scene(name="block", gravity=gravity)
    scene.add_body(name="block", mass=100.0, inertia=(10.0,) * 3, position=place, velocity=velocity)
    known = {"depth": 10.0, "stiffness": 1e4, "damping": 0.0, "friction": 0.3, "load": 1e3, "give": 1e-3}
    add_load(scene, _core.SeabedNode(name="bed", body="block", anchor=place, **known | bed))
    return scene


# --- at rest --------------------------------------------------------------------------------------------


def shape(n: int, span: float, up: float, length: float, *, stiffness: float) -> tuple[float, float, Array]:
    """H and V (N) at the upper end, V with half a segment's weight, and heights of the masses (m)."""
    step = length / n
    chain = Chain(
        span=np.array([span, 0.0, up]), segment=step, stiffness=EA, weights=np.full(n - 1, WEIGHT * step),
        bed=0.0, bed_stiffness=stiffness * step,
    )  # fmt: skip
    forces = chain.forces()
    assert forces is not None
    return forces[-1, 0], forces[-1, 2] + 0.5 * WEIGHT * step, chain.points(forces)[:, 2]


@pytest.mark.parametrize(("span", "up", "length", "level", "upright", "lying"), CATENARIES)
def test_a_chain_at_rest_tends_to_the_catenary_on_a_seabed_with_second_order(
    span: float, up: float, length: float, level: float, upright: float, lying: float
) -> None:
    """It touches down within a segment: the error times n^2 goes to and fro within a bound."""
    worst = []
    for n in (40, 80, 160):
        near = [shape(m, span, up, length, stiffness=1e9) for m in range(n, n + n // 4, n // 20)]
        worst.append(max(max(abs(h / level - 1.0), abs(v / upright - 1.0)) for h, v, _ in near))
        on_bed = np.array([np.sum(z < 0.0) * length / (len(z) + 1) for *_, z in near])
        assert np.abs(on_bed - lying).max() < 1.5 * length / n
    assert np.log2(np.divide(worst[:-1], worst[1:])) == pytest.approx([2.0, 2.0], abs=0.6)
    assert worst[-1] < 1e-4


def test_a_stiff_seabed_is_the_limit_of_a_soft_one() -> None:
    """By the first order in its give: it changes the depth of what lies there."""
    hard = shape(164, 400.0, 50.0, 410.0, stiffness=1e9)[0]
    errors = [shape(164, 400.0, 50.0, 410.0, stiffness=k)[0] / hard - 1.0 for k in (25e3, 50e3)]
    assert errors[0] == pytest.approx(0.0041, abs=2e-4)
    assert errors[0] / errors[1] == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize("formulation", FORMS)
def test_a_chain_stays_where_it_is_described(formulation: str) -> None:
    result = simulate(
        moored(41, friction=0.6), t_end=2.0, dt_out=0.5, rtol=1e-8, formulation=formulation,
        channels=["position", "line_tension"],
    )  # fmt: skip
    assert np.ptp(np.asarray(result["position"]), axis=0).max() < 1e-6
    anchor, top = heavy_line_tension(result, line="chain")[-1]
    assert [anchor, top] == pytest.approx([835_867.0, 1_001_995.0], rel=3e-3)


def test_both_ends_may_be_above_the_seabed() -> None:
    """A line that sags to the seabed in its middle: as two halves of half the length that end there."""
    half = shape(40, 100.0, 30.0, 110.0, stiffness=1e7)
    step = 110.0 / 40
    whole = Chain(
        span=np.array([200.0, 0.0, 0.0]), segment=step, stiffness=EA, weights=np.full(79, WEIGHT * step),
        bed=-30.0, bed_stiffness=1e7 * step,
    )  # fmt: skip
    forces = whole.forces()
    assert forces is not None
    assert forces[-1, 0] == pytest.approx(half[0], rel=1e-3)
    assert forces[-1, 2] == pytest.approx(-forces[0, 2], rel=1e-9)


def test_what_the_line_does_not_carry_lies_on_the_seabed() -> None:
    """`start="rest"`: what the seabed bears and the pull of the ground are the weight of what is free."""
    scene = Scene(name="landed", gravity=10.0)
    scene.add_body(name="load", mass=200.0, inertia=(90.0,) * 3, position=(6.0, 0.0, -9.9))
    scene.add_line(
        "line", "ground", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0),
        rung="with mass", EA=2e5, length=15.0, mass_per_length=40.0, segments=6, seabed=BED,
    )  # fmt: skip
    result = simulate(
        scene, t_end=1.0, dt_out=0.5, start="rest", rtol=1e-8,
        channels=["position", "velocity", "line_tension"],
    )  # fmt: skip
    assert np.abs(result["velocity"]).max() < 1e-6
    place = {name: np.asarray(result.select("position", body=name))[-1] for name in scene.bodies}
    under = [BED["stiffness"] * 2.5 * max(-10.0 - place[f"line.{i}"][2], 0.0) for i in range(1, 6)]
    under.append(BED["stiffness"] * 1.25 * max(-10.0 - place["load"][2], 0.0))
    assert sum(force > 0.0 for force in under) >= 2
    tension = float(np.asarray(result.select("line_tension", line="line.1"))[-1])
    lifted = -tension * place["line.1"][2] / float(np.linalg.norm(place["line.1"]))
    assert sum(under) + lifted == pytest.approx((200.0 + 40.0 * (15.0 - 1.25)) * 10.0, rel=1e-6)


# --- bearing and friction -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("damped", "rebound", "deepest"),
    [(0.05, 0.96773858, 0.98380316), (0.5, 0.74843493, 0.86964311), (2.0, 0.41071969, 0.67133736)],
)
def test_a_blow_rebounds_as_hunt_and_crossley_say(damped: float, rebound: float, deepest: float) -> None:
    """d v - ln(1 + d v) is the same before and after, v with its sign; without gravity."""
    scene = block(
        gravity=0.0, velocity=(0.0, 0.0, -1.0), place=(0.0, 0.0, -9.9), damping=damped, friction=0.0
    )
    result = simulate(scene, t_end=0.8, dt_out=0.001, channels=["position", "velocity"], **EXACT)
    speed = np.asarray(result.select("velocity", body="block", axis="z"))
    assert speed[-1] == pytest.approx(rebound, rel=1e-7)
    depth = -10.0 - np.asarray(result.select("position", body="block", axis="z"))
    assert depth.max() == pytest.approx(deepest * np.sqrt(100.0 / 1e4), rel=1e-4)


@pytest.mark.parametrize("formulation", FORMS)
@pytest.mark.parametrize("heading", [0.0, 0.7, 4.0])
def test_friction_holds_for_an_hour_without_creep(heading: float, formulation: str) -> None:
    """Pushed by two thirds of what holds, in any direction: it gives by that share, and the anchor stays."""
    scene = block()
    way = np.array([np.cos(heading), np.sin(heading), 0.0])
    scene.add_point_force(name="push", body="block", force=200.0 * way)
    result = simulate(
        scene,
        t_end=3600.0,
        dt_out=300.0,
        formulation=formulation,
        integrator="rosenbrock",
        channels=["position", "load_state"],
    )
    away = np.asarray(result.select("position", body="block"))[1:] @ way
    assert away == pytest.approx(np.full(12, 2.0 / 3.0 * 1e-3), rel=1e-4)
    assert not np.any(result["load_state"])


@pytest.mark.parametrize("heading", [0.0, 2.2])
def test_a_block_that_slides_comes_to_rest_by_its_friction(heading: float) -> None:
    """Over v^2 / (2 mu g), give and all within 1 %; and the energy that it had is lost."""
    way = np.array([np.cos(heading), np.sin(heading), 0.0])
    result = simulate(
        block(velocity=3.0 * way), t_end=3.0, dt_out=0.1,
        channels=["position", "velocity", "energy_balance", "absolute_work"], **EXACT,
    )  # fmt: skip
    place = np.asarray(result.select("position", body="block"))
    assert place[-1] @ way == pytest.approx(1.5, rel=1e-3)
    assert np.abs(place @ np.array([-way[1], way[0], 0.0])).max() < 1e-9
    assert np.abs(result.select("velocity", body="block")[-1]).max() < 1e-9
    assert np.abs(result["energy_balance"]).max() < 1e-7 * np.max(result["absolute_work"])


def pulled(segments: int) -> float:
    """Tension (N) over that at the start, of the end of 20 m of line on the seabed, drawn by 13 mm."""
    strain, sunk = 5e-5, 500.0 / 2e4
    scene = Scene(name="pulled", gravity=10.0)
    scene.add_body(name="sled", mass=100.0, inertia=(10.0,) * 3, position=(20.0, 0.0, -10.0 - sunk))
    scene.add_joint(
        kind="prismatic",
        name="rail",
        first="ground",
        second="sled",
        point=(20.0, 0.0, -10.0 - sunk),
        axis=(1, 0, 0),
    )
    scene.add_driver(joint="rail", curve=Curve.quintic(start_time=0.0, end_time=4.0, start=0.0, end=0.013))
    scene.add_line(
        "line", "ground", "sled", first_point=(0.0, 0.0, -10.0 - sunk), second_point=(0.0, 0.0, 0.0),
        rung="with mass", EA=1e6, length=20.0 / (1.0 + strain), mass_per_length=50.0, segments=segments,
        damping_ratio=0.3, seabed=BED | {"give": 1e-3},
    )  # fmt: skip
    result = simulate(scene, t_end=5.0, dt_out=0.5, rtol=1e-8, channels=["line_tension"])
    last = np.asarray(result.select("line_tension", line=f"line.{segments}"))
    return float(last[-1] - last[0])


def test_friction_takes_up_the_pull_along_a_line_that_is_laid() -> None:
    """u = give / 2 + F^2 / (2 mu w EA): T falls by mu w for each metre that slips, and holds beyond."""
    friction = BED["friction"] * 500.0
    whole = np.sqrt(2.0 * friction * 1e6 * (0.013 - 0.5e-3))
    errors = [pulled(n) + 0.5 * friction * 20.0 / n - whole for n in (10, 20, 40)]
    assert abs(errors[-1]) < 2e-3 * whole
    assert abs(errors[0]) > 4.0 * abs(errors[-1])


# --- engine: formulations, ledger, restart, Jacobian ----------------------------------------------------


def run(scene: Scene, formulation: str) -> Any:
    channels = ["position", "velocity", "energy_balance", "absolute_work", "load_state"]
    return simulate(scene, t_end=3.0, dt_out=0.1, channels=channels, formulation=formulation, **EXACT)


@pytest.mark.parametrize("medium", ["air", "sea"])
def test_both_formulations_agree_and_the_ledger_closes(medium: Any) -> None:
    wet = {"medium": medium, "diameter": 0.1} if medium == "sea" else {}
    one, other = (run(dropped(**wet), form) for form in FORMS)
    assert np.asarray(one["position"]) == pytest.approx(np.asarray(other["position"]), abs=1e-6)
    assert np.asarray(one["load_state"]) == pytest.approx(np.asarray(other["load_state"]), abs=1e-6)
    for result in (one, other):
        assert np.max(np.abs(result["energy_balance"])) < 1e-6 * np.max(result["absolute_work"])
    height = np.asarray(one["position"])[:, :-1, 2]
    assert height.min() < -10.0, "it comes down"


@pytest.mark.parametrize("formulation", FORMS)
def test_a_run_continues_bit_for_bit(formulation: str) -> None:
    given: dict[str, Any] = {"formulation": formulation, "integrator": "dopri5", "dt_out": 0.1}
    whole = Run(dropped(), 2.0, **given)
    whole.advance(1.27)
    rest = Run(dropped(), 2.0, start=whole.state, outputs_from=0.0, **given)
    for one in (whole, rest):
        one.advance(2.0)
    assert np.array_equal(whole.state.values, rest.state.values)


@pytest.mark.parametrize("seed", [1, 2])
def test_the_exact_jacobian_is_that_of_differences(seed: int) -> None:
    model = dropped(segments=3).compile()
    assert largest_error(model, 0.7, moving(model, seed), step=3e-4, kinks=True) < 1e-7


@pytest.mark.parametrize("integrator", ["rosenbrock", "cvode-bdf"])
def test_implicit_methods_find_the_same_motion(integrator: str) -> None:
    one, other = (
        simulate(dropped(), t_end=1.5, dt_out=0.5, channels=["position"], integrator=name, rtol=1e-7)
        for name in ("dopri5", integrator)
    )
    assert np.asarray(other["position"]) == pytest.approx(np.asarray(one["position"]), abs=2e-4)


# --- how it is described --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"seabed": 50.0}, "seabed is 50.0; give depth, stiffness and friction"),
        ({"seabed": {"depth": 10.0}}, "seabed has 'depth'; it takes depth, stiffness, friction"),
        ({"seabed": BED | {"soil": "clay"}}, "it takes depth, stiffness, friction"),
        ({"seabed": BED | {"stiffness": 0.0}}, "seabed stiffness is 0.0 N/m2; give a finite"),
        ({"seabed": BED | {"friction": -0.1}}, "seabed friction is -0.1"),
        ({"seabed": BED | {"give": 0.0}}, "seabed give is 0.0 m"),
        ({"seabed": BED | {"depth": 5.0}}, "its end on 'load' is 3.4 m in the seabed"),
        ({"seabed": BED, "length": Curve.quintic(start_time=0.0, end_time=9.0, start=16.0, end=17.0)},
         "has a length that changes and a seabed"),
        ({"seabed": BED, "medium": "sea", "diameter": 0.4}, "would not lie on its seabed"),
        ({"seabed": BED, "rung": "elastic"}, "rung 'elastic' takes no seabed"),
    ],
)  # fmt: skip
def test_what_is_no_line_on_a_seabed_is_refused_by_name(given: dict[str, Any], message: str) -> None:
    scene = Scene(name="refused")
    scene.add_body(name="load", mass=300.0, inertia=(90.0,) * 3, position=(14.0, 2.0, -8.4))
    line: dict[str, Any] = {"rung": "with mass", "EA": 2e5, "length": 16.0}
    if given.get("rung") != "elastic":
        line |= {"mass_per_length": 40.0, "segments": 3}
    with pytest.raises(SceneError, match=message):
        scene.add_line("line", "ground", "load", first_point=(0.0, 0.0, -4.0), **line | given)
    assert list(scene.bodies) == ["load"]


def test_friction_without_what_it_bears_is_refused() -> None:
    with pytest.raises(SceneError, match=r"has friction with a load of 0 N and a give of 0\.001 m"):
        block(load=0.0).compile()
