"""Water on parts of a body: added mass as a mass, slam with its loss, buoyancy, drag; waves, current."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import wet_scenes as wet
from element_runs import both_forms, goes_on
from marks import needs_lanes
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from wet_scenes import EXACT, RHO, G

from seacrane import Scene, SceneError, _core, simulate
from seacrane.arrays import Array
from seacrane.description.elements import add_load
from seacrane.hydro import BoxPart, CylinderPart, PlatePart, SpherePart, circle_added_mass, perforation_factor
from seacrane.hydro.parts.parts import Part
from seacrane.run import Run
from seacrane.scene import Waves
from seacrane.sea import Current

SLICE: dict[str, Any] = {"length": 1.0, "diameter": 1.0, "drag": 0.0, "ends": ("joined", "joined")}


def dropped(part: Part, *, mass: float, depth: float = 0.0, speed: float = 3.0) -> Scene:
    """A body whose point 0.5 m below its centre is at a depth below the surface, that sinks at a speed."""
    scene, place = Scene(name="drop", gravity=G), (0.0, 0.0, 0.5 - depth)
    scene.add_body("load", mass=mass, inertia=(mass,) * 3, position=place, velocity=(0.0, 0.0, -speed))
    scene.add_immersed("load", parts=[part], density=RHO)
    return scene


def run(scene: Scene, t_end: float, dt_out: float, formulation: str = "recursive") -> Any:
    return simulate(scene, t_end=t_end, dt_out=dt_out, formulation=formulation, **EXACT)


def heights(result: Any) -> list[Array]:
    """z and its rate."""
    return [np.asarray(result.select(one, body="load", axis="z")) for one in ("position", "velocity")]


def test_the_added_mass_of_a_circle_is_that_of_greenhow_and_li_and_of_images_below() -> None:
    depth = [0.02, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0]
    expected = [0.059807, 0.275874, 0.617909, 1.054786, 1.570796, 1.792282, 2.0261]
    assert circle_added_mass(depth) == pytest.approx(expected, abs=6e-7 * 50)
    assert circle_added_mass([1.0, 2.0]) == pytest.approx([np.pi / 2, np.pi**3 / 6 - np.pi], rel=1e-12)
    gained = np.diff(circle_added_mass([2.0, 2.0 + 1e-4]))  # the slope as the crown goes under
    assert gained == pytest.approx(1e-4 * 4 * (np.pi**3 / 36 - np.pi / 6), rel=1e-3)
    far = 60.0
    assert circle_added_mass([far + 1.0])[0] == pytest.approx(np.pi * (1.0 - 0.5 / far**2), rel=1e-6)


def test_perforation_takes_from_the_added_mass_and_its_two_branches_meet() -> None:
    shares = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5]
    expected = [1.0, 1.0, 0.9685, 0.7551, 0.4979, 0.3425, 0.2397]
    assert [perforation_factor(p) for p in shares] == pytest.approx(expected, abs=6e-5)
    across = [perforation_factor(p) for p in np.linspace(0.3, 0.4, 201)]
    assert np.all(np.diff(across) < 0.0)
    assert 0.4244 < perforation_factor(0.34) < 0.4315


def test_the_ramp_of_a_flat_bottom_follows_from_its_slam_coefficient() -> None:
    side = 2.0
    piece = next(BoxPart(size=(side, side, 3.0)).pieces(RHO))
    up = np.asarray(piece.added_masses)[:, 2]
    first = 0.5 * 0.579 * np.pi / 4.0 * RHO * side**3
    delta = 0.0909 * side
    after = (piece.depths > 1.25 * delta) & (piece.depths < 3.0)
    assert up[after] == pytest.approx(first, rel=1e-4)
    early = piece.depths < 0.7 * delta
    slope = np.diff(up[early]) / np.diff(piece.depths[early])
    assert slope == pytest.approx(0.5 * RHO * 5.0 * side**2, rel=1e-9)


@pytest.mark.parametrize(
    "part",
    [BoxPart(size=(3.0, 2.0, 1.5), strips=(3, 2)),
     PlatePart(size=(4.0, 2.5), thickness=0.05, perforation=0.2, strips=(2, 2)),
     CylinderPart(length=7.0, diameter=1.2, ends=("joined", "joined"))],
    ids=lambda part: part.kind,
)  # fmt: skip
def test_strips_share_all_that_a_part_has(part: Part) -> None:
    """And their points are those whose mean is the part's."""
    strips = list(part.pieces(RHO))
    one = {"strips": 1 if part.kind == "cylinder" else (1, 1)}
    (whole,) = type(part)(**part.__dict__ | one).pieces(RHO)
    assert len(strips) > 1
    assert sum(p.added_masses[-1] for p in strips) == pytest.approx(whole.added_masses[-1], rel=1e-12)
    assert sum(p.drag for p in strips) == pytest.approx(whole.drag, rel=1e-12)
    assert sum(np.prod(p.size) for p in strips) == pytest.approx(np.prod(whole.size), rel=1e-12)
    assert np.mean([p.offset for p in strips], axis=0) == pytest.approx(np.zeros(3), abs=1e-12)


def test_a_cylinder_that_is_dropped_falls_as_its_equation_says(formulation: str) -> None:
    """Half as heavy as water: depth, speed, and what slam took."""
    result = run(dropped(CylinderPart(**SLICE), mass=np.pi / 8.0 * 1000.0), 0.3, 0.01, formulation)
    z, rate = heights(result)
    at = np.searchsorted(result.time, np.array([0.02, 0.05, 0.1, 0.2, 0.3]) - 1e-6)
    depth = [0.05613199, 0.13205636, 0.24880057, 0.46540700, 0.66281087]
    assert 0.5 - z[at] == pytest.approx(depth, abs=1.5e-7)
    speed = [2.66020873, 2.43127598, 2.26115090, 2.07820865, 1.85283545]
    assert -rate[at] == pytest.approx(speed, abs=1.5e-7)
    loss = [311.8423, 592.3188, 876.3676, 1162.2450, 1270.2809]
    assert result["load_state"][at].ravel() == pytest.approx(loss, abs=1.5e-4)
    assert np.max(np.abs(result["energy_balance"])) < 3e-8 * np.max(result["absolute_work"])


def sunk_and_risen() -> Scene:
    """A light cylinder that goes in, comes out and falls in again."""
    return dropped(CylinderPart(**SLICE), mass=150.0, depth=-0.2, speed=6.0)


def test_touch_and_awash_are_events() -> None:
    scene = dropped(CylinderPart(length=1.0, diameter=1.0), mass=2000.0, depth=-0.1, speed=2.0)
    result = simulate(scene, t_end=1.5, integrator="dopri5", rtol=1e-9)
    told = [event for event in result.events if event.name.startswith("load.1")]
    assert [event.name for event in told] == ["load.1.touch", "load.1.awash"]
    assert told[0].time == pytest.approx((np.sqrt(4.0 + 2.0 * G * 0.1) - 2.0) / G, abs=1e-9)


@pytest.mark.parametrize(
    ("part", "share"),
    [(SpherePart(diameter=2.0, drag=0.0), 0.5), (CylinderPart(length=2.0, diameter=1.0, drag=0.0), 1.0)],
    ids=["sphere", "cylinder"],
)
def test_a_deep_body_moves_as_its_mass_and_added_mass(part: Part, share: float, formulation: str) -> None:
    volume = np.pi * 4.0 / 3.0 if part.kind == "sphere" else np.pi / 2.0
    mass = 1500.0
    result = run(dropped(part, mass=mass, depth=200.0, speed=0.0), 2.0, 0.5, formulation)
    z, _ = heights(result)
    a = G * (RHO * volume - mass) / (mass + share * RHO * volume)
    assert z - z[0] == pytest.approx(0.5 * a * np.asarray(result.time) ** 2, abs=1e-9)


def test_a_slender_body_turns_broadside_by_the_moment_of_munk() -> None:
    """Kirchhoff's equations of a free neutrally buoyant cylinder, integrated in its own axes."""
    length, mass = 6.0, RHO * np.pi / 4.0 * 6.0
    turning = mass * np.mean([((i + 0.5) - 3.0) ** 2 for i in range(6)])
    inertia = mass * length**2 / 12.0
    scene = Scene(name="munk", gravity=G)
    scene.add_body(name="load", mass=mass, inertia=(100.0, inertia, inertia), position=(0.0, 0.0, -200.0),
                   velocity=(2.0, 0.3, 0.0))  # fmt: skip
    slices = CylinderPart(length=length, diameter=1.0, drag=0.0, strips=6, ends=("joined", "joined"))
    scene.add_immersed("load", parts=[slices])
    result = run(scene, 6.0, 0.5)

    def rates(_t: float, y: Array) -> list[float]:
        u, v, r, heading = y[:4]
        torque = -(u * (mass * v))  # -v x A v about z: -(u A v - v 0 u)
        return [
            r * 2.0 * v, -r * 0.5 * u, torque / (inertia + turning), r,
            u * np.cos(heading) - v * np.sin(heading), u * np.sin(heading) + v * np.cos(heading),
        ]  # fmt: skip

    start = [2.0, 0.3, 0.0, 0.0, 0.0, 0.0]
    alone = solve_ivp(rates, (0.0, 6.0), start, t_eval=np.asarray(result.time), rtol=1e-11, atol=1e-12)
    place = np.asarray(result.select("position", body="load"))[:, :2]
    assert place == pytest.approx(alone.y[4:].T, abs=1e-7)
    assert np.max(np.abs(alone.y[3])) > 0.5, "it turns"
    assert np.max(np.abs(result["energy_balance"])) < 1e-6


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("kind", ["box", "cylinder"])
def test_buoyancy_is_that_of_the_volume_below_the_surface_at_any_attitude(kind: str, seed: int) -> None:
    """Volume below z = 0, and its first moment about the centre, by a midpoint rule."""
    rng = np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed)
    if kind == "box":
        size = rng.uniform(1.0, 3.0, 3)
        part: Part = BoxPart(size=size, drag=0.0, added_mass=(0.0, 0.0, 0.0), source="none")
    else:
        length, diameter = rng.uniform(1.0, 3.0, 2)
        size = np.array([length, diameter, diameter])
        part = CylinderPart(**SLICE | {"length": length, "diameter": diameter, "strips": 1})
    center = float(rng.uniform(-0.5, 0.5))
    scene = Scene(name="float", gravity=G)
    scene.add_body(name="load", mass=1e7, inertia=(1e7, 1e7, 1e7), position=(0.0, 0.0, center), gravity=False,
                   quaternion=wet.quaternion(turn))  # fmt: skip
    scene.add_immersed("load", parts=[part], density=RHO)
    result = simulate(scene, t_end=0.1, dt_out=0.1, channels=["load_force", "load_moment"])
    n, ticks = 160, (np.arange(160) + 0.5) / 160 - 0.5
    points = np.stack(np.meshgrid(*(ticks * s for s in size), indexing="ij"), axis=-1).reshape(-1, 3)
    if kind == "cylinder":
        points = points[points[:, 1] ** 2 + points[:, 2] ** 2 < 0.25 * size[1] ** 2]
    points = points @ turn.as_matrix().T
    under = points[points[:, 2] + center < 0.0]
    cell = float(np.prod(size)) / n**3
    volume, moment = len(under) * cell, under.sum(axis=0) * cell
    force, torque = (result[name][0].reshape(3) for name in ("load_force", "load_moment"))
    assert force == pytest.approx([0.0, 0.0, RHO * G * volume], rel=3e-3, abs=1e-6)
    scale = RHO * G * np.prod(size) * np.max(size)
    assert torque[:2] == pytest.approx(RHO * G * np.array([moment[1], -moment[0]]), abs=1e-3 * scale)


def hanging(seed: int) -> Scene:
    """A load with parts of all kinds that swings on two links through the surface."""
    scene = wet.hung_on_links()
    scene.add_immersed("load", parts=list(wet.random_parts(np.random.default_rng(seed))), density=RHO)
    return scene


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_move_random_parts_alike_and_the_ledger_closes(seed: int) -> None:
    result = both_forms(hanging(seed), 3.0, wet.ALIKE, ledger=1e-7, **EXACT)
    assert np.all(np.diff(result["load_state"], axis=0) > -1e-6), "slam never gives back"


def test_the_mass_of_a_body_holds_that_of_its_parts() -> None:
    """About its centre of mass: A of each strip, moved there by its lever."""
    scene, turn = Scene(name="mass", gravity=G), Rotation.from_rotvec([0.3, -0.2, 0.5])
    scene.add_body(name="load", mass=700.0, inertia=(100.0, 200.0, 300.0), position=(0.0, 0.0, -100.0),
                   center_of_mass=(0.1, 0.2, -0.3), quaternion=wet.quaternion(turn))  # fmt: skip
    box = BoxPart(size=(2.0, 1.0, 0.5), point=(1.0, 0.0, 0.4), strips=(2, 1))
    parts = scene.add_immersed("load", parts=[box])
    found, expected = wet.masses(scene, 700.0, (100.0, 200.0, 300.0), turn)
    r = turn.as_matrix()
    for part in parts:
        lever = r @ (np.asarray(part.point) - [0.1, 0.2, -0.3])
        expected += wet.shifted(r @ np.diag(np.asarray(part.added_masses)[-1]) @ r.T, lever)
    assert found == pytest.approx(expected, rel=1e-12, abs=1e-9)


@pytest.mark.warns("AssemblyWarning")
def test_a_load_welded_on_a_body_brings_its_added_mass_and_water_to_the_carrier() -> None:
    scene = Scene(name="welded", gravity=G)
    scene.add_body(name="deck", mass=2000.0, inertia=(900.0, 800.0, 700.0), position=(0.0, 0.0, 0.6),
                   angular_velocity=(0.2, 0.3, -0.1))  # fmt: skip
    scene.add_body(name="box", mass=700.0, inertia=(200.0, 300.0, 300.0), position=(1.5, 0.5, 0.2))
    scene.add_joint(kind="weld", name="seafastening", first="deck", second="box", point=(1.0, 0.4, 0.3))
    water: dict[str, Any] = {"area": 1.0, "height": 1.2, "point": (0, 0, -0.6), "initial": 0.9, "air": "free"}
    water["openings"] = [{"point": (0.0, 0.0, -0.5), "area": 0.1}]
    scene.add_immersed("box", parts=[BoxPart(size=(2.0, 1.0, 1.5))], inside=water, density=RHO)
    scene.add_immersed("deck", parts=[SpherePart(diameter=1.8)], density=RHO)
    found = []
    for merge in (True, False):
        done = Run(scene, 2.0, model=scene.compile(merge=merge), formulation="redundant", **EXACT)
        done.advance(2.0)
        result = done.result()
        assert result.stats["compiled_coordinates"] == (6 if merge else 12)
        assert np.max(np.abs(result["energy_balance"])) < 1e-7 * np.max(result["absolute_work"])
        found.append(np.asarray(result["position"]))
    assert found[0] == pytest.approx(found[1], abs=1e-8)


@pytest.mark.parametrize(
    ("part", "given", "message"),
    [
        ({"kind": "cylinder", "length": 1.0, "diameter": 1.0, "slam": 2.5}, {}, "slam is 2.5"),
        ({"kind": "box", "size": (1, 1, 1), "added_mass": (1.0, 1.0, 1.0)}, {}, "source"),
        ({"kind": "box", "sizes": (1, 1, 1)}, {}, "sizes"),
        ({"kind": "box", "size": (1, 1, 1), "strips": 10}, {}, "strips is 10; give two whole"),
        ({"kind": "cylinder", "length": 1.0, "diameter": 1.0, "strips": 0}, {}, "strips is 0; give a whole"),
        ({"kind": "table", "height": 1.0, "depths": (0, 1, 2), "volumes": (0, 1, 1), "source": "t",
          "added_masses": ((0, 0, 0), (10, 10, 10), (5, 10, 10))}, {}, "added_masses fall between 1 and 2 m"),
        ({"kind": "sphere", "diameter": 1.0}, {"density": 1.025}, "t/m3"),
        ({"kind": "sphere", "diameter": 1.0, "point": (1200.0, 0.0, 0.0)}, {}, "10 times the size"),
    ],
)  # fmt: skip
def test_bad_parts_are_refused(part: dict[str, Any], given: dict[str, Any], message: str) -> None:
    scene = Scene(name="refused", gravity=G)
    scene.add_body(name="load", mass=1000.0, inertia=(500.0, 500.0, 500.0), position=(0.0, 0.0, -5.0))
    with pytest.raises(SceneError, match=message):
        scene.add_immersed("load", parts=[part], **given)
        scene.compile()


def regular(scene: Scene, *, period: float, amplitude: float = 1.0) -> float:
    """One wave without stretching in deep water; its wavenumber."""
    scene.waves = Waves(omega=[2.0 * np.pi / period], amplitude=[amplitude], phase=[0.0], direction=[0.0],
                        hulls={}, stretching="none")  # fmt: skip
    return float((2.0 * np.pi / period) ** 2 / G)


def amplitude(result: Any, axis: str) -> float:
    """Of the first harmonic of the forces of all parts over one period."""
    force = np.asarray(result.select("load_force", axis=axis)).reshape(len(result.time), -1).sum(axis=1)[:-1]
    turn = np.exp(2j * np.pi * np.arange(len(force)) / len(force))
    return float(2.0 * abs(np.mean(force * turn)))


@pytest.mark.warns("UnitWarning")  # far from any real one, so that its formula shows
@pytest.mark.parametrize("strips", [1, 4])
def test_froude_and_krylov_on_a_box_are_those_of_the_pressure_on_its_sides(strips: int) -> None:
    """12 x 6 x 4 m, 2 m under water, in a wave of 8 s and 1 m; strips change nothing."""
    scene = Scene(name="box", gravity=G)
    k = regular(scene, period=8.0)
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, -4.0))
    scene.add_joint(kind="weld", name="holds", first="ground", second="load", point=(0.0, 0.0, -4.0))
    for n in range(strips):
        add_load(scene, _core.ImmersedPart(
            name=f"strip {n}", body="load", shape="box", size=(12.0 / strips, 6.0, 4.0), density=RHO,
            point=(12.0 * ((n + 0.5) / strips - 0.5), 0.0, 0.0), depths=[0.0, 1.0],
            added_masses=np.zeros((2, 3)),
        ))  # fmt: skip
    result = simulate(scene, t_end=8.0, dt_out=0.25, channels=["load_force"], integrator="rk4", dt=0.25)
    expected = RHO * G * 6.0 * (2.0 * np.sin(6.0 * k) / k) * (np.exp(-2.0 * k) - np.exp(-6.0 * k))
    assert expected == pytest.approx(138615.297, abs=1e-3)
    assert amplitude(result, "x") == pytest.approx(expected, rel=1e-6)  # edges are round by a thousandth
    assert amplitude(result, "z") == pytest.approx(expected, rel=1e-6)


def test_a_small_neutral_sphere_moves_as_the_water() -> None:
    scene = Scene(name="particle", gravity=G)
    k, omega = regular(scene, period=6.0), 2.0 * np.pi / 6.0
    mass, flow = RHO * np.pi / 6.0 * 0.01**3, omega * np.exp(-5.0 * k)
    scene.add_body(name="load", mass=mass, inertia=mass * 1e-5 * np.ones(3), position=(0.0, 0.0, -5.0),
                   velocity=(flow, 0.0, 0.0))  # fmt: skip
    scene.add_immersed("load", parts=[SpherePart(diameter=0.01, drag=0.0)], density=RHO)

    def rate(t: float, y: Array) -> Array:
        size, angle = omega**2 * np.exp(k * y[1]), omega * t - k * y[0]
        return np.array([y[2], y[3], -size * np.sin(angle), -size * np.cos(angle)])

    result = simulate(scene, t_end=12.0, dt_out=1.0, channels=["position"], **EXACT)
    alone = solve_ivp(rate, (0.0, 12.0), [0.0, -5.0, flow, 0.0], t_eval=result.time, rtol=1e-12, atol=1e-12)
    found = np.asarray(result.select("position", body="load"))[:, [0, 2]]
    assert found == pytest.approx(alone.y[:2].T, abs=1e-6)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
def test_a_body_in_a_current_moves_as_one_that_is_towed_through_still_water(formulation: str) -> None:
    """Relativity of Galileo: added mass, its moment, slam and drag see the speed over the water alone."""
    u, runs = np.array([1.3, -0.6, 0.0]), []
    for towed in (True, False):
        scene = Scene(name="towed", gravity=G)
        scene.add_body(
            name="load", mass=2500.0, inertia=(1500.0, 2500.0, 3500.0), position=(0.0, 0.0, 1.0),
            velocity=np.array([0.5, 0.2, -2.0]) - (u if towed else 0.0), angular_velocity=(0.3, -0.4, 0.2),
        )  # fmt: skip
        scene.add_immersed("load", parts=list(wet.random_parts(np.random.default_rng(1))), density=RHO)
        if not towed:
            course = float(np.rad2deg(np.arctan2(u[1], u[0])))
            current = Current(speed=float(np.hypot(*u[:2])), direction_deg=course)
            scene.add_sea(vessel=None, hs=0.0, current=current)
        runs.append(simulate(scene, 3.0, dt_out=0.25, formulation=formulation, **EXACT))
    still, flowing = runs
    drift = np.asarray(still.time)[:, None, None] * u
    assert np.asarray(flowing["position"]) == pytest.approx(np.asarray(still["position"]) + drift, abs=1e-7)
    assert np.max(np.abs(flowing["energy_balance"])) < 1e-7 * np.max(flowing["absolute_work"])


def in_a_sea(seed: int) -> Scene:
    """A load with parts of all kinds that swings on two links through a sea with a current."""
    scene, current = hanging(7), Current(speed=0.7, direction_deg=100.0)
    scene.add_sea(vessel=None, hs=1.5, tp=6.0, seed=seed, direction_deg=30.0, current=current)
    return scene


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_agree_in_waves_and_the_ledger_closes(seed: int) -> None:
    """And the Jacobian is exact: that of the recursive form is in cpp/tests/test_jacobian.cpp."""
    result = both_forms(in_a_sea(seed), 4.0, wet.ALIKE, **EXACT)
    assert np.all(np.diff(result["load_state"], axis=0) > -1e-6), "slam never gives back"
    wet.has_the_jacobian_of_differences(in_a_sea(seed), 1.7, 5e-6)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
def test_a_run_in_waves_continues_bit_for_bit(formulation: str) -> None:
    goes_on(lambda: in_a_sea(1), 2.0, 0.97, integrator="dopri5", dt_out=0.1, formulation=formulation)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@needs_lanes
def test_lanes_see_parts_each_in_its_own_sea_with_its_own_mass() -> None:
    scenes = [in_a_sea(seed) for seed in range(4)]
    for lane, scene in enumerate(scenes):
        scene.replace("load", mass=3000.0 + 500.0 * lane)
    alone = wet.lanes_are_as_alone(scenes, 2.3)
    assert np.ptp(alone, axis=1).max() > 1e-3, "the seas differ"


def test_a_part_touches_the_wave_where_it_is() -> None:
    scene = Scene(name="touch", gravity=G)
    k = regular(scene, period=7.0, amplitude=0.8)
    scene.add_body(
        name="load", mass=9e3, inertia=(5e3, 5e3, 5e3), position=(11.0, 0.0, 3.0), velocity=(2.0, 0.0, -1.0)
    )
    upright = CylinderPart(length=2.0, diameter=1.0, axes=np.roll(np.eye(3), 1, axis=1))
    (part, *_) = scene.add_immersed("load", parts=[upright])
    result = simulate(scene, t_end=1.5, integrator="dopri5", rtol=1e-9)
    touch = next(event.time for event in result.events if event.name.endswith(".touch"))
    low = 3.0 - touch - 0.5 * G * touch**2 - (1.0 if abs(np.asarray(part.axes)[2, 0]) > 0.5 else 0.5)
    surface = 0.8 * np.cos(2.0 * np.pi / 7.0 * touch - k * (11.0 + 2.0 * touch))
    assert low == pytest.approx(surface, abs=1e-3)


@pytest.mark.warns(sometimes=["DragAxesWarning"])
def test_strips_in_a_row_feel_what_each_feels_by_itself() -> None:
    """Their sums over components go from strip to strip; alone each begins anew."""
    together = in_a_sea(1)
    apart = together.copy()
    for name, part in together.loads.items():
        if isinstance(part, _core.ImmersedPart) and part.count > 1:
            apart.replace(name, row="", place=0, count=1, step=(0.0, 0.0, 0.0))
    assert any(one.count > 1 for one in together.loads.values() if isinstance(one, _core.ImmersedPart))
    one, other = (simulate(scene, t_end=2.0, dt_out=0.5, **EXACT)["position"] for scene in (together, apart))
    assert one == pytest.approx(other, abs=1e-8)  # that of the steps, and of few components for all
