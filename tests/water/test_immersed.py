"""Water on parts of a body: added mass as a mass, slam with its loss, buoyancy, drag, in still water."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from seacrane import Scene, SceneError, _core, simulate
from seacrane.run import Run
from seacrane.run.lanes import module_of
from seacrane.water import (
    BoxPart,
    CylinderPart,
    PlatePart,
    SpherePart,
    TablePart,
    circle_added_mass,
    perforation_factor,
)
from seacrane.water.parts import Part

Array = NDArray[np.float64]
G, RHO = 9.80665, 1025.0
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11}
FORMS = ("recursive", "redundant")
SLICE: dict[str, Any] = {"length": 1.0, "diameter": 1.0, "drag": 0.0, "ends": ("joined", "joined")}


def dropped(
    *parts: Part, mass: float, depth: float = 0.0, speed: float = 3.0, half: float = 0.5, **more: Any
) -> Scene:
    """A body with its lowest point at a depth below the surface, that sinks at a speed."""
    scene = Scene(name="drop", gravity=G)
    scene.add_body(
        name="load", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, half - depth),
        velocity=(0.0, 0.0, -speed), **more,
    )  # fmt: skip
    scene.add_immersed("load", parts=parts, density=RHO)
    return scene


def run(scene: Scene, t_end: float, dt_out: float, formulation: str = "recursive") -> Any:
    channels = ["position", "velocity", "load_state", "energy_balance", "absolute_work"]
    return simulate(scene, t_end=t_end, dt_out=dt_out, channels=channels, formulation=formulation, **EXACT)


def heights(result: Any, body: str = "load") -> tuple[Array, Array]:
    """z and its rate."""
    z = result.select("position", body=body, axis="z")
    rate = result.select("velocity", body=body, axis="z")
    return np.asarray(z), np.asarray(rate)


# --- coefficients ---------------------------------------------------------------------------------------


def test_the_added_mass_of_a_circle_is_that_of_greenhow_and_li_and_of_images_below() -> None:
    depth = [0.02, 0.1, 0.25, 0.5, 1.0, 1.5, 2.0]
    expected = [0.059807, 0.275874, 0.617909, 1.054786, 1.570796, 1.792282, 2.0261]
    assert circle_added_mass(depth) == pytest.approx(expected, abs=6e-7 * 50)
    assert circle_added_mass([1.0, 2.0])[0] == pytest.approx(np.pi / 2, rel=1e-12)
    assert circle_added_mass([2.0])[0] == pytest.approx(np.pi**3 / 6 - np.pi, rel=1e-12)
    assert circle_added_mass([2.0 + 1e-4])[0] - circle_added_mass([2.0])[0] == pytest.approx(
        1e-4 * 4 * (np.pi**3 / 36 - np.pi / 6), rel=1e-3
    )  # the slope of Greenhow and Li as the crown goes under
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
    assert np.diff(up[early]) / np.diff(piece.depths[early]) == pytest.approx(
        0.5 * RHO * 5.0 * side**2, rel=1e-9
    )
    stronger = next(BoxPart(size=(side, side, 3.0), slam=10.0).pieces(RHO))
    assert np.interp(3.0, stronger.depths, stronger.added_masses[:, 2]) == pytest.approx(first, rel=1e-4)


@pytest.mark.parametrize(
    "part",
    [
        BoxPart(size=(3.0, 2.0, 1.5), strips=(3, 2)),
        PlatePart(size=(4.0, 2.5), thickness=0.05, perforation=0.2, strips=(2, 2)),
        CylinderPart(length=7.0, diameter=1.2, ends=("joined", "joined")),
    ],
    ids=lambda part: part.kind,
)
def test_strips_share_all_that_a_part_has(part: Part) -> None:
    """And their points are those whose mean is the part's."""
    strips = list(part.pieces(RHO))
    whole = list(
        type(part)(**{**part.__dict__, "strips": 1 if part.kind == "cylinder" else (1, 1)}).pieces(RHO)
    )
    assert len(strips) > 1
    assert len(whole) == 1
    assert sum(p.added_masses[-1] for p in strips) == pytest.approx(whole[0].added_masses[-1], rel=1e-12)
    assert sum(p.drag for p in strips) == pytest.approx(whole[0].drag, rel=1e-12)
    assert sum(np.prod(p.size) for p in strips) == pytest.approx(np.prod(whole[0].size), rel=1e-12)
    assert np.mean([p.offset for p in strips], axis=0) == pytest.approx(np.zeros(3), abs=1e-12)


# --- entry, exit, re-entry ------------------------------------------------------------------------------

TIMES = [0.02, 0.05, 0.1, 0.2, 0.3]
DROPS = {
    np.pi / 8.0 * 1000.0: (
        [0.05613199, 0.13205636, 0.24880057, 0.46540700, 0.66281087],
        [2.66020873, 2.43127598, 2.26115090, 2.07820865, 1.85283545],
        [311.8423, 592.3188, 876.3676, 1162.2450, 1270.2809],
    ),
    np.pi / 2.0 * 1000.0: (
        [None, None, None, 0.65747572, None],
        [None, None, None, 3.63974621, None],
        [None] * 3 + [2271.4190],
    ),
}


@pytest.mark.parametrize("formulation", FORMS)
@pytest.mark.parametrize("mass", DROPS)
def test_a_cylinder_that_is_dropped_falls_as_its_equation_says(mass: float, formulation: str) -> None:
    result = run(dropped(CylinderPart(**SLICE), mass=mass), 0.3, 0.01, formulation)
    z, rate = heights(result)
    loss = np.asarray(result["load_state"]).reshape(-1)
    at = [int(np.argmin(np.abs(np.asarray(result.time) - t))) for t in TIMES]
    for found, expected, scale in zip((0.5 - z, -rate, loss), DROPS[mass], (1.0, 1.0, 1000.0), strict=True):
        for i, value in zip(at, expected, strict=False):
            if value is not None:
                assert found[i] == pytest.approx(value, abs=1e-7 * scale * 1.5)
    assert np.max(np.abs(result["energy_balance"])) < 3e-8 * np.max(result["absolute_work"])


def sunk_and_risen() -> Scene:
    """A light cylinder that goes in, comes out and falls in again."""
    return dropped(CylinderPart(**SLICE), mass=150.0, depth=-0.2, speed=6.0)


@pytest.mark.parametrize("formulation", FORMS)
def test_momentum_closes_through_entry_exit_and_entry(formulation: str) -> None:
    """m v + A v, what is left behind on exit, and the impulse of weight and buoyancy: by quadrature of the
    recorded motion, in stretches between the events."""
    result = run(sunk_and_risen(), 3.0, 0.0005, formulation)
    z, rate = heights(result)
    time, depth = np.asarray(result.time), 0.5 - z
    ups = np.flatnonzero(np.diff(np.sign(depth)) != 0)
    assert len(ups) >= 3, "in, out and in again"
    radius = 0.5
    theta = 2.0 * np.arccos(np.clip(1.0 - depth / radius, -1.0, 1.0))
    volume = 0.5 * radius**2 * (theta - np.sin(theta))
    added = RHO * radius**2 * circle_added_mass(depth / radius)
    force = RHO * G * volume - 150.0 * G
    impulse = np.concatenate([[0.0], np.cumsum(0.5 * (force[1:] + force[:-1]) * np.diff(time))])
    middle = 0.5 * (rate[1:] + rate[:-1])
    gained = np.diff(added)
    left = np.concatenate([[0.0], np.cumsum(np.where(gained < 0.0, -gained * middle, 0.0))])
    balance = (150.0 + added) * rate + left - impulse
    assert np.ptp(balance) < 2e-5 * np.max(np.abs((150.0 + added) * rate))  # of the quadrature
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


@pytest.mark.parametrize("formulation", FORMS)
def test_without_weight_momentum_is_shared_on_entry_and_taken_along_on_no_exit(formulation: str) -> None:
    """(m + A) v on the way in; on the way out v stays, and A v stays behind in the water."""
    mass, part = 300.0, CylinderPart(**SLICE)
    for depth, speed, enters in ((0.0, 4.0, True), (2.5, -4.0, False)):
        scene = Scene(name="no weight", gravity=0.0)
        scene.add_body(
            name="load", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, 0.5 - depth),
            velocity=(0.0, 0.0, -speed),
        )  # fmt: skip
        (element,) = scene.add_immersed("load", parts=[part], density=RHO)
        t_end = 40.0 if enters else 1.0
        z, rate = heights(simulate(scene, t_end, formulation=formulation, **EXACT | {"rtol": 1e-13}))
        if not enters:
            assert rate[-1] == pytest.approx(-speed, rel=1e-10)
            assert z[-1] > 0.5, "it is out"
            continue
        added = RHO * 0.25 * circle_added_mass((0.5 - z) / 0.5)
        assert (mass + added) * rate == pytest.approx(
            np.full(len(z), -mass * speed), rel=5e-4
        )  # of the table
        assert 0.5 - z[-1] > element.depths[-1], "where it has all of its added mass"
        assert (mass + element.added_masses[-1, 2]) * rate[-1] == pytest.approx(-mass * speed, rel=1e-9)


def test_touch_and_awash_are_events() -> None:
    scene = dropped(CylinderPart(length=1.0, diameter=1.0), mass=2000.0, depth=-0.1, speed=2.0)
    result = simulate(scene, t_end=1.5, integrator="dopri5", rtol=1e-9)
    named = [event.name for event in result.events]
    assert [name for name in named if name.startswith("load.1")] == ["load.1.touch", "load.1.awash"]
    touch = next(event.time for event in result.events if event.name == "load.1.touch")
    assert touch == pytest.approx((np.sqrt(4.0 + 2.0 * G * 0.1) - 2.0) / G, abs=1e-9)


# --- under water ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("formulation", FORMS)
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
    length, diameter, mass = 6.0, 1.0, RHO * np.pi / 4.0 * 6.0
    across = mass
    turning = across * np.mean([((i + 0.5) - 3.0) ** 2 for i in range(6)])
    inertia = mass * length**2 / 12.0
    scene = Scene(name="munk", gravity=G)
    scene.add_body(
        name="load", mass=mass, inertia=(100.0, inertia, inertia), position=(0.0, 0.0, -200.0),
        velocity=(2.0, 0.3, 0.0),
    )  # fmt: skip
    scene.add_immersed(
        "load",
        parts=[CylinderPart(length=length, diameter=diameter, drag=0.0, strips=6, ends=("joined", "joined"))],
    )
    result = run(scene, 6.0, 0.5)

    def rates(_t: float, y: Array) -> list[float]:
        u, v, r, heading = y[:4]
        ahead, aside = mass * u, (mass + across) * v
        torque = -(u * (across * v))  # -v x A v about z: -(u A v - v 0 u)
        return [
            r * aside / mass, -r * ahead / (mass + across), torque / (inertia + turning), r,
            u * np.cos(heading) - v * np.sin(heading), u * np.sin(heading) + v * np.cos(heading),
        ]  # fmt: skip

    found = solve_ivp(
        rates,
        (0.0, 6.0),
        [2.0, 0.3, 0.0, 0.0, 0.0, 0.0],
        t_eval=np.asarray(result.time),
        rtol=1e-11,
        atol=1e-12,
    )
    assert np.asarray(result.select("position", body="load", axis="x")) == pytest.approx(found.y[4], abs=1e-7)
    assert np.asarray(result.select("position", body="load", axis="y")) == pytest.approx(found.y[5], abs=1e-7)
    assert np.max(np.abs(found.y[3])) > 0.5, "it turns"
    assert np.max(np.abs(result["energy_balance"])) < 1e-6


# --- buoyancy -------------------------------------------------------------------------------------------


def clipped(size: Array, turn: Array, center: float, inside: Callable[[Array], Array]) -> tuple[float, Array]:
    """Volume below z = 0, and its first moment about the centre, by a midpoint rule."""
    n = 160
    ticks = (np.arange(n) + 0.5) / n - 0.5
    points = np.stack(np.meshgrid(*(ticks * s for s in size), indexing="ij"), axis=-1).reshape(-1, 3)
    points = points[inside(points)] @ turn.T
    wet = points[points[:, 2] + center < 0.0]
    cell = float(np.prod(size)) / n**3
    return len(wet) * cell, wet.sum(axis=0) * cell


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("kind", ["box", "cylinder"])
def test_buoyancy_is_that_of_the_volume_below_the_surface_at_any_attitude(kind: str, seed: int) -> None:
    rng = np.random.default_rng(seed)
    turn = Rotation.random(random_state=seed)
    if kind == "box":
        size = rng.uniform(1.0, 3.0, 3)
        part: Part = BoxPart(size=size, drag=0.0, added_mass=(0.0, 0.0, 0.0), source="none")
        inside = lambda p: np.ones(len(p), dtype=bool)  # noqa: E731
    else:
        length, diameter = rng.uniform(1.0, 3.0, 2)
        size = np.array([length, diameter, diameter])
        part = CylinderPart(**SLICE | {"length": length, "diameter": diameter, "strips": 1})
        inside = lambda p: p[:, 1] ** 2 + p[:, 2] ** 2 < 0.25 * diameter**2  # noqa: E731
    center = float(rng.uniform(-0.5, 0.5))
    x, y, z, w = turn.as_quat()
    scene = Scene(name="float", gravity=G)
    scene.add_body(
        name="load", mass=1e7, inertia=(1e7, 1e7, 1e7), position=(0.0, 0.0, center), quaternion=(w, x, y, z),
        gravity=False,
    )  # fmt: skip
    scene.add_immersed("load", parts=[part], density=RHO)
    result = simulate(scene, t_end=0.1, dt_out=0.1, channels=["load_force", "load_moment"])
    volume, moment = clipped(size, turn.as_matrix(), center, inside)
    force = np.asarray(result["load_force"])[0].reshape(3)
    torque = np.asarray(result["load_moment"])[0].reshape(3)
    assert force == pytest.approx([0.0, 0.0, RHO * G * volume], rel=3e-3, abs=1e-6)
    scale = RHO * G * np.prod(size) * np.max(size)
    assert torque[:2] == pytest.approx(RHO * G * np.array([moment[1], -moment[0]]), abs=1e-3 * scale)


def test_an_upright_box_floats_where_its_weight_is_that_of_the_water() -> None:
    mass = 0.37 * RHO * 6.0
    scene = dropped(BoxPart(size=(3.0, 2.0, 1.0), slam=6.0, drag=20.0), mass=mass, depth=0.3, speed=0.0)
    result = simulate(scene, t_end=300.0, dt_out=300.0, channels=["position"])
    assert 0.5 - np.asarray(result.select("position", body="load", axis="z"))[-1] == pytest.approx(
        0.37, abs=2e-3
    )


# --- both formulations, ledger, restart, lanes ----------------------------------------------------------


def random_parts(rng: np.random.Generator) -> Iterator[Part]:
    def place() -> dict[str, Any]:
        turn = Rotation.random(random_state=int(rng.integers(1 << 30))).as_matrix()
        return {"point": rng.uniform(-1.0, 1.0, 3), "axes": turn}

    yield BoxPart(size=rng.uniform(0.5, 2.0, 3), strips=(2, 1), perforation=0.15, fill=0.6, **place())
    yield CylinderPart(length=3.0, diameter=0.7, end_drag=0.8, slam=5.15, **place())
    yield SpherePart(diameter=1.3, **place())
    yield PlatePart(size=(2.0, 1.5), thickness=0.1, **place())
    yield TablePart(
        height=1.0, depths=(0.0, 0.4, 1.0, 2.0), volumes=(0.0, 0.3, 0.8, 0.8), drag_area=(1.0, 2.0, 3.0),
        added_masses=((0.0, 0.0, 0.0), (50.0, 60.0, 200.0), (110.0, 150.0, 350.0), (120.0, 180.0, 400.0)),
        source="this test", **place(),
    )  # fmt: skip


def hanging(seed: int) -> Scene:
    """A load with parts of all kinds that swings on two links through the surface."""
    rng = np.random.default_rng(seed)
    scene = Scene(name="hanging", gravity=G)
    scene.add_body(name="hook", mass=300.0, inertia=(50.0, 60.0, 70.0), position=(0.5, 0.2, 4.0))
    scene.add_body(
        name="load", mass=4000.0, inertia=(3000.0, 4000.0, 5000.0), position=(1.0, 0.0, 0.3),
        angular_velocity=(0.3, -0.2, 0.4), velocity=(0.62, 0.97, 0.02),
    )  # fmt: skip
    scene.add_joint(kind="distance", name="rope", first="ground", second="hook", point=(0.0, 0.0, 10.0),
                    second_point=(0.5, 0.2, 4.0))  # fmt: skip
    scene.add_joint(kind="spherical", name="eye", first="hook", second="load", point=(0.6, 0.2, 3.0))
    scene.add_immersed("load", parts=list(random_parts(rng)), density=RHO)
    return scene


@pytest.mark.warns(sometimes=["DragAxesWarning"])
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_move_random_parts_alike_and_the_ledger_closes(seed: int) -> None:
    scene = hanging(seed)
    one, other = (run(scene, 3.0, 0.1, form) for form in FORMS)
    assert np.asarray(one["position"]) == pytest.approx(np.asarray(other["position"]), abs=1e-8)
    assert np.asarray(one["load_state"]) == pytest.approx(np.asarray(other["load_state"]), rel=1e-6, abs=1e-4)
    for result in (one, other):
        assert np.max(np.abs(result["energy_balance"])) < 1e-7 * np.max(result["absolute_work"])
        assert np.all(np.diff(result["load_state"], axis=0) > -1e-6), "slam never gives back"


@pytest.mark.parametrize("formulation", FORMS)
def test_a_run_continues_bit_for_bit(formulation: str) -> None:
    scene = hanging(1)
    given: dict[str, Any] = {"formulation": formulation, "integrator": "dopri5", "dt_out": 0.1}
    whole = Run(scene, 2.0, **given)
    whole.advance(0.97)
    rest = Run(scene, 2.0, start=whole.state, outputs_from=0.0, **given)
    for one in (whole, rest):
        one.advance(2.0)
    assert np.array_equal(whole.state.values, rest.state.values)


def skew(a: Array) -> Array:
    """skew(a) b = a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


@pytest.mark.parametrize("seed", range(3))
def test_the_exact_jacobian_is_that_of_differences(seed: int) -> None:
    """That of the recursive form: cpp/tests/test_jacobian.cpp."""
    model = hanging(seed).compile()
    evaluator = _core.Evaluator(model, "redundant")
    y = np.asarray(evaluator.project(0.0, model.initial_state))
    found = np.asarray(evaluator.jacobian(0.0, y))
    expected = np.empty_like(found)
    for i in range(len(y)):
        h = 1e-5
        near, far = (
            sum(
                sign * np.asarray(evaluator.derivative(0.0, y + sign * k * h * np.eye(len(y))[i]))
                for sign in (1, -1)
            )
            / (2.0 * k * h)
            for k in (1, 2)
        )
        expected[:, i] = (4.0 * near - far) / 3.0
    scale = np.max(np.abs(expected), axis=1, keepdims=True) + 1.0
    assert np.max(np.abs(found - expected) / scale) < 2e-6


def test_the_mass_of_a_body_holds_that_of_its_parts() -> None:
    """About its centre of mass: A of each strip, moved there by its lever."""
    scene = Scene(name="mass", gravity=G)
    turn = Rotation.from_rotvec([0.3, -0.2, 0.5])
    x, y, z, w = turn.as_quat()
    scene.add_body(
        name="load", mass=700.0, inertia=(100.0, 200.0, 300.0), position=(0.0, 0.0, -100.0),
        center_of_mass=(0.1, 0.2, -0.3), quaternion=(w, x, y, z),
    )  # fmt: skip
    parts = scene.add_immersed(
        "load", parts=[BoxPart(size=(2.0, 1.0, 0.5), point=(1.0, 0.0, 0.4), strips=(2, 1))]
    )
    model = scene.compile()
    mass = np.asarray(_core.Evaluator(model, "redundant").terms(0.0, model.initial_state)["mass"])
    r = turn.as_matrix()
    expected = np.zeros((6, 6))
    expected[:3, :3] = 700.0 * np.eye(3)
    expected[3:, 3:] = r @ np.diag([100.0, 200.0, 300.0]) @ r.T
    for part in parts:
        a = r @ np.diag(np.asarray(part.added_masses)[-1]) @ r.T
        lever = r @ (np.asarray(part.point) - [0.1, 0.2, -0.3])
        shift = np.hstack([np.eye(3), -skew(lever)])
        expected += shift.T @ a @ shift
    assert mass == pytest.approx(expected, rel=1e-12, abs=1e-9)


@pytest.mark.skipif(module_of(4) is None, reason="no lanes on this processor, or in this build")
def test_lanes_evaluate_wet_bodies_each_by_its_own_mass() -> None:
    scenes = []
    for lane in range(4):
        scene = hanging(2)
        scene.replace("load", mass=3000.0 + 500.0 * lane)
        scenes.append(scene)
    evaluator = _core.LaneEvaluator(module_of(4), [scene.compile() for scene in scenes])
    state = evaluator.start() + 1e-3 * np.random.default_rng(1).normal(size=evaluator.start().shape)
    alone = evaluator.scalar_derivative(0.0, state)
    apart = np.abs(evaluator.derivative(0.0, state) - alone) / np.abs(alone).max(axis=1)[:, None]
    assert apart.max() < 1e-11


@pytest.mark.warns("AssemblyWarning")
def test_a_load_welded_on_a_body_brings_its_added_mass_to_the_carrier() -> None:
    def scene() -> Scene:
        out = Scene(name="welded", gravity=G)
        out.add_body(name="deck", mass=2000.0, inertia=(900.0, 800.0, 700.0), position=(0.0, 0.0, 0.6),
                     angular_velocity=(0.2, 0.3, -0.1))  # fmt: skip
        out.add_body(name="box", mass=700.0, inertia=(200.0, 300.0, 300.0), position=(1.5, 0.5, 0.2),
                     velocity=(0.0, 0.0, 0.0))  # fmt: skip
        out.add_joint(kind="weld", name="seafastening", first="deck", second="box", point=(1.0, 0.4, 0.3))
        out.add_immersed("box", parts=[BoxPart(size=(2.0, 1.0, 1.5))], density=RHO)
        out.add_immersed("deck", parts=[SpherePart(diameter=1.8)], density=RHO)
        return out

    found = []
    for merge in (True, False):
        model = scene().compile(merge=merge)
        channels = ["position", "energy_balance"]
        done = Run(scene(), 2.0, model=model, dt_out=0.2, channels=channels, formulation="redundant", **EXACT)
        done.advance(2.0)
        result = done.result()
        assert result.stats["compiled_coordinates"] == (6 if merge else 12)
        assert np.max(np.abs(result["energy_balance"])) < 1e-5
        found.append(np.asarray(result["position"]))
    assert found[0] == pytest.approx(found[1], abs=1e-8)


# --- what is refused ------------------------------------------------------------------------------------


def test_a_part_of_no_size_moves_nothing() -> None:
    bodies = []
    for parts in (
        [BoxPart(size=(0.0, 0.0, 0.0)), SpherePart(diameter=0.0), CylinderPart(length=0.0, diameter=1.0)],
        None,
    ):
        scene = Scene(name="nothing", gravity=G)
        scene.add_body(name="load", mass=10.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, 0.5))
        if parts:
            assert scene.add_immersed("load", parts=parts) == []
        bodies.append(np.asarray(simulate(scene, t_end=1.0, dt_out=0.5, channels=["position"])["position"]))
    assert np.array_equal(*bodies)


@pytest.mark.parametrize(
    ("made", "message"),
    [
        (lambda: BoxPart(size=(1.0, 1.0, 1.0), slam=4.0), "slam is 4"),
        (lambda: CylinderPart(length=1.0, diameter=1.0, slam=2.5), "slam is 2.5"),
        (lambda: BoxPart(size=(1.0, -1.0, 1.0)), "size"),
        (lambda: BoxPart(size=(1.0, 1.0, 1.0), perforation=0.7), "perforation"),
        (lambda: BoxPart(size=(1.0, 1.0, 1.0), added_mass=(1.0, 1.0, 1.0)), "source"),
        (lambda: BoxPart(size=(1.0, 1.0, 1.0), strips=(0, 1)), "strips"),
        (lambda: SpherePart(diameter=-1.0), "diameter"),
        (
            lambda: TablePart(
                height=1.0, depths=(-1.0, 1.0), volumes=(0.0, 1.0), added_masses=np.zeros((2, 3)), source="t"
            ),
            "depths",
        ),
        (
            lambda: TablePart(
                height=1.0, depths=(0.0, 1.0), volumes=(0.0, 1.0), added_masses=np.zeros((2, 3))
            ),
            "source",
        ),
    ],
)  # fmt: skip
def test_bad_parts_are_refused(made: Callable[[], Part], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        made()


def body_only() -> Scene:
    scene = Scene(name="refused", gravity=G)
    scene.add_body(name="load", mass=1000.0, inertia=(500.0, 500.0, 500.0), position=(0.0, 0.0, -5.0))
    return scene


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"parts": [SpherePart(diameter=1.0)], "density": 1.025}, "t/m3"),
        ({"parts": [SpherePart(diameter=1.0, point=(1200.0, 0.0, 0.0))]}, "more than 10 times the size"),
        ({"parts": []}, "give a list of parts"),
        ({"parts": [3.0]}, "seacrane.water"),
        ({"parts": [{"kind": "pyramid"}]}, "kind"),
        ({"parts": [{"kind": "box", "sizes": (1, 1, 1)}]}, "sizes"),
    ],
)  # fmt: skip
def test_bad_calls_are_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        body_only().add_immersed("load", **given)


def test_added_mass_that_falls_with_depth_is_refused() -> None:
    falls = TablePart(
        height=1.0, depths=(0.0, 1.0, 2.0), volumes=(0.0, 1.0, 1.0), source="t",
        added_masses=((0.0, 0.0, 0.0), (10.0, 10.0, 10.0), (5.0, 10.0, 10.0)),
    )  # fmt: skip
    scene = body_only()
    scene.add_immersed("load", parts=[falls])
    with pytest.raises(SceneError, match="added_masses fall between 1 and 2 m"):
        scene.compile()


def test_sources_say_what_nobody_verified() -> None:
    scene = body_only()
    added = scene.add_immersed(
        "load", parts=[BoxPart(size=(1.0, 1.0, 1.0)), {"kind": "sphere", "diameter": 1.0}]
    )
    assert all("unverified" in part.source for part in added)
    assert [part.name for part in added] == ["load.1", "load.2"]
