"""Lines with mass on a seabed: rest, bearing, friction, and how they are described."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from contact_scenes import REBOUNDS
from heavy_line_scenes import BED
from line_scenes import add_led

from seacrane import Curve, Scene, SceneError, _core, simulate
from seacrane.arrays import Array
from seacrane.description.elements import add_load
from seacrane.result import heavy_line_tension
from seacrane.scene.heavy_line import Chain

EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-10}
WEIGHT, EA = 3324.385, 1.674e9  # N/m in water, N: 390 kg/m that displaces a circle of 0.252 m, g 9.81
# m: across, up, length; N at the upper end; m on the seabed: elastic catenary without friction
CATENARIES = (
    (400.0, 50.0, 410.0, 835_867.155, 552_558.152, 243.7864),
    (700.0, 200.0, 760.0, 1_406_617.851, 1_519_756.431, 302.8459),
)


def block(
    *, gravity: float = 10.0, velocity: Any = (0.0, 0.0, 0.0), place: Any = (0.0, 0.0, -10.1), **bed: Any
) -> Scene:
    """100 kg on a point of the seabed, which bears 1000 N by 0.1 m."""
    scene = Scene(name="block", gravity=gravity)
    scene.add_body(name="block", mass=100.0, inertia=(10.0,) * 3, position=place, velocity=velocity)
    known = {"depth": 10.0, "stiffness": 1e4, "damping": 0.0, "friction": 0.3, "load": 1e3, "give": 1e-3}
    add_load(scene, _core.SeabedNode(name="bed", body="block", anchor=place, **known | bed))
    return scene


def shape(n: int, span: float, up: float, length: float, *, stiffness: float) -> tuple[float, float, Array]:
    """H and V (N) at the upper end, V with half a segment's weight, and heights of the masses (m)."""
    step = length / n
    chain = Chain(span=np.array([span, 0.0, up]), segment=step, stiffness=EA,
                  weights=np.full(n - 1, WEIGHT * step), bed=0.0, bed_stiffness=stiffness * step)  # fmt: skip
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


def test_a_chain_stays_where_it_is_described(formulation: str) -> None:
    """From an anchor to a point at the surface."""
    scene = Scene(name="moored", gravity=9.81)
    scene.add_body(name="end", mass=1e3, inertia=(1e3,) * 3, position=(400.0, 0.0, 0.0))
    scene.add_joint(kind="weld", name="bolts", first="ground", second="end")
    bed = {"depth": 50.0, "stiffness": 1e6, "friction": 0.6}
    wet = {"medium": "sea", "density": 1025.0, "diameter": 0.252, "seabed": bed}
    scene.add_line("chain", "ground", "end", first_point=(0.0, 0.0, -50.0), second_point=(0.0, 0.0, 0.0),
                   EA=EA, length=410.0, wire={"mass_per_length": 390.0, "segments": 41, **wet})  # fmt: skip
    result = simulate(scene, t_end=2.0, dt_out=0.5, rtol=1e-8, formulation=formulation)
    assert np.ptp(np.asarray(result["position"]), axis=0).max() < 1e-6
    anchor, top = heavy_line_tension(result, line="chain")[-1]
    assert [anchor, top] == pytest.approx([835_867.0, 1_001_995.0], rel=3e-3)


def test_what_the_line_does_not_carry_lies_on_the_seabed() -> None:
    """`start="rest"`: what the seabed bears and the pull of the ground are the weight of what is free."""
    scene = Scene(name="landed", gravity=10.0)
    scene.add_body(name="load", mass=200.0, inertia=(90.0,) * 3, position=(6.0, 0.0, -9.9))
    scene.add_line("line", "ground", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0),
                   EA=2e5, length=15.0, wire={"mass_per_length": 40.0, "segments": 6,
                   "seabed": BED})  # fmt: skip
    result = simulate(scene, t_end=1.0, dt_out=0.5, start="rest", rtol=1e-8)
    assert np.abs(result["velocity"]).max() < 1e-6
    place = {name: np.asarray(result.select("position", body=name))[-1] for name in scene.bodies}
    under = [BED["stiffness"] * 2.5 * max(-10.0 - place[f"line.{i}"][2], 0.0) for i in range(1, 6)]
    under.append(BED["stiffness"] * 1.25 * max(-10.0 - place["load"][2], 0.0))
    assert sum(force > 0.0 for force in under) >= 2
    tension = float(np.asarray(result.select("line_tension", line="line.1"))[-1])
    lifted = -tension * place["line.1"][2] / float(np.linalg.norm(place["line.1"]))
    assert sum(under) + lifted == pytest.approx((200.0 + 40.0 * (15.0 - 1.25)) * 10.0, rel=1e-6)


@pytest.mark.parametrize(("damped", "rebound", "deepest"), REBOUNDS[::5])
def test_a_blow_rebounds_as_hunt_and_crossley_say(damped: float, rebound: float, deepest: float) -> None:
    away = {"gravity": 0.0, "velocity": (0.0, 0.0, -1.0), "place": (0.0, 0.0, -9.9)}
    scene = block(**away, damping=damped, friction=0.0)
    result = simulate(scene, t_end=0.8, dt_out=0.001, **EXACT)
    assert result["velocity"][-1, 0, 2] == pytest.approx(rebound, rel=1e-7)
    depth = -10.0 - result["position"][:, 0, 2]
    assert depth.max() == pytest.approx(deepest * np.sqrt(100.0 / 1e4), rel=1e-4)


@pytest.mark.parametrize("heading", [0.7, 4.0])
def test_friction_holds_for_an_hour_without_creep(heading: float, formulation: str) -> None:
    """Pushed by two thirds of what holds, in any direction: it gives by that share, and the anchor stays."""
    scene = block()
    way = np.array([np.cos(heading), np.sin(heading), 0.0])
    scene.add_force("block", name="push", force=200.0 * way)
    how: dict[str, Any] = {"formulation": formulation, "integrator": "rosenbrock"}
    result = simulate(scene, t_end=3600.0, dt_out=300.0, **how)
    away = np.asarray(result.select("position", body="block"))[1:] @ way
    assert away == pytest.approx(np.full(12, 2.0 / 3.0 * 1e-3), rel=1e-4)
    assert np.abs(result["load_state"]).max() < 1e-15  # m: what solving leaves of nothing


def test_a_block_that_slides_comes_to_rest_by_its_friction() -> None:
    """Over v^2 / (2 mu g); and the energy that it had is lost."""
    way = np.array([np.cos(2.2), np.sin(2.2), 0.0])
    result = simulate(block(velocity=3.0 * way), t_end=3.0, dt_out=0.1, **EXACT)
    place = np.asarray(result.select("position", body="block"))
    assert place[-1] @ way == pytest.approx(1.5, rel=1e-3)
    assert np.abs(place @ np.array([-way[1], way[0], 0.0])).max() < 1e-9
    assert np.abs(result.select("velocity", body="block")[-1]).max() < 1e-9
    assert np.abs(result["energy_balance"]).max() < 1e-7 * np.max(result["absolute_work"])


def pulled(segments: int) -> float:
    """Tension (N) over that at the start, of the end of 20 m of line on the seabed, drawn by 13 mm."""
    strain, sunk = 5e-5, 500.0 / 2e4
    scene = Scene(name="pulled", gravity=10.0)
    draw = Curve.quintic(start_time=0.0, end_time=4.0, start=0.0, end=0.013)
    add_led(scene, "sled", draw, place=(20.0, 0.0, -10.0 - sunk), axis=(1, 0, 0))
    scene.add_line("line", "ground", "sled", first_point=(0.0, 0.0, -10.0 - sunk), second_point=(0.0, 0.0,
                   0.0), EA=1e6, length=20.0 / (1.0 + strain), wire={"mass_per_length": 50.0,
                   "segments": segments, "seabed": BED | {"give": 1e-3}}, damping_ratio=0.3)  # fmt: skip
    result = simulate(scene, t_end=5.0, dt_out=0.5, rtol=1e-8)
    last = np.asarray(result.select("line_tension", line=f"line.{segments}"))
    return float(last[-1] - last[0])


def test_friction_takes_up_the_pull_along_a_line_that_is_laid() -> None:
    """u = give / 2 + F^2 / (2 mu w EA): T falls by mu w for each metre that slips, and holds beyond."""
    friction = BED["friction"] * 500.0
    whole = np.sqrt(2.0 * friction * 1e6 * (0.013 - 0.5e-3))
    errors = [pulled(n) + 0.5 * friction * 20.0 / n - whole for n in (10, 20, 40)]
    assert abs(errors[-1]) < 2e-3 * whole
    assert abs(errors[0]) > 4.0 * abs(errors[-1])


@pytest.mark.parametrize(
    ("given", "message"),
    [({"seabed": BED | {"soil": "clay"}}, "no 'soil'.*it takes depth, stiffness, friction"),
     ({"seabed": BED | {"depth": 5.0}}, "'load' is 3.4 m in the seabed"),
     ({"length": Curve.table([0.0, 9.0], [16.0, 17.0])}, "length that changes and a seabed"),
     ({"medium": "sea", "diameter": 0.4}, "would not lie on its seabed")],
)  # fmt: skip
def test_what_is_no_line_on_a_seabed_is_refused_by_name(given: dict[str, Any], message: str) -> None:
    scene = Scene(name="refused")
    scene.add_body(name="load", mass=300.0, inertia=(90.0,) * 3, position=(14.0, 2.0, -8.4))
    length, wire = given.pop("length", 16.0), {"mass_per_length": 40.0, "segments": 3, "seabed": BED} | given
    ends = {"first": "ground", "second": "load", "first_point": (0.0, 0.0, -4.0)}
    with pytest.raises(SceneError, match=message):
        scene.add_line("line", **ends, EA=2e5, length=length, wire=wire)
    assert list(scene.bodies) == ["load"]


def test_a_dip_of_a_millimetre_within_a_step_is_met() -> None:
    """A block that bounces on a spring, down to 11 m: coarse steps and fine ones see the same seabed."""

    def height(depth: float, rtol: float) -> Array:
        scene = block(place=(0.0, 0.0, -9.0), depth=depth, stiffness=1e6, friction=0.0)
        scene.add_spring("spring", first="ground", second="block", stiffness=200.0, natural_length=5.0)
        return np.asarray(simulate(scene, 20.0, rtol=rtol, integrator="dop853")["position"][:, 0, 2])

    coarse, fine = height(10.999, 1e-6), height(10.999, 1e-11)
    np.testing.assert_allclose(coarse, fine, atol=1e-4)
    assert np.abs(fine - height(20.0, 1e-11)).max() > 0.01
