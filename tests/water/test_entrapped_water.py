"""Water in a compartment of a body: flow through openings, its mass and weight, its ledger, its bounds."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad, solve_ivp
from scipy.spatial.transform import Rotation

from seacrane import Scene, SceneError, _core, equilibrium, simulate
from seacrane.run import Run
from seacrane.run.lanes import module_of
from seacrane.scene import Waves
from seacrane.sea import Current
from seacrane.water import BoxPart, CylinderPart, Opening

Array = NDArray[np.float64]
G, RHO = 9.80665, 1025.0
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11}
FORMS = ("recursive", "redundant")
ROUNDED = 1e-3  # m, the head over which the root is rounded off
CHANNELS = ["position", "velocity", "load_state", "energy_balance", "absolute_work"]
BOTTOM = ((0.0, 0.0, 0.0), 0.05)  # place and area of an opening
AREA, HEIGHT, C_D = 3.0, 4.0, 0.62


def filled(
    scene: Scene, *openings: tuple[Any, float], shell: bool = True, **more: Any
) -> _core.EntrappedWater:  # fmt: skip
    """A compartment of a body "load", whose air is free, in a shell that keeps water out and no more."""
    given = {
        "air": "free",
        "area": AREA,
        "height": HEIGHT,
        "discharge_coefficient": C_D,
        "density": RHO,
        "name": "water",
    } | more
    holes = [Opening(point=point, area=area) for point, area in openings]
    if shell:
        wide, tall = np.sqrt(given["area"]), given["height"]
        middle = np.add(given.get("point", np.zeros(3)), (0.0, 0.0, 0.5 * tall))
        part = BoxPart(size=(wide, wide, tall), point=middle, added_mass=(0, 0, 0), drag=0.0, source="none")
        scene.add_immersed("load", parts=[part], density=RHO, name=f"shell of {given['name']}")
    return scene.add_entrapped_water("load", openings=holes, **given)


def standing(z: float, *openings: tuple[Any, float], lean: float = 0.0, **more: Any) -> Scene:
    """A compartment whose bottom is held at a height."""
    scene = Scene(name="standing", gravity=G)
    scene.add_body(
        name="load", mass=6e3, inertia=(6e3, 6e3, 6e3), position=(0.0, 0.0, z),
        quaternion=(np.cos(0.5 * lean), 0.0, np.sin(0.5 * lean), 0.0),
    )  # fmt: skip
    scene.add_joint(kind="weld", name="held", first="ground", second="load", point=(0.0, 0.0, z))
    filled(scene, *openings, **more)
    return scene


def guided(axis: tuple[float, float, float], z: float, mass: float = 4e3, **more: Any) -> Scene:
    """A body that slides along an axis."""
    scene = Scene(name="guided", gravity=G)
    scene.add_body(name="load", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, z), **more)
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="load", point=(0.0, 0.0, z), axis=axis
    )
    return scene


def run(scene: Scene, t_end: float, dt_out: float, formulation: str = "auto", **more: Any) -> Any:
    return simulate(
        scene, t_end=t_end, dt_out=dt_out, channels=CHANNELS, formulation=formulation, **EXACT | more
    )


def states(result: Any) -> tuple[Array, Array]:
    """Volume, and what is lost, of the one compartment."""
    volume, loss = (
        np.asarray(result.select("load_state", state_name=f"water.{one}")) for one in ("volume", "flow_loss")
    )
    return volume, loss


def events(result: Any) -> dict[str, list[float]]:
    """Times by name of the event, of the one compartment."""
    found: dict[str, list[float]] = {}
    for event in result.events:
        if event.name.startswith("water."):
            found.setdefault(event.name.removeprefix("water."), []).append(event.time)
    return found


def through(head: Any, area: float = 0.05) -> Any:
    """m3/s through an opening under a head."""
    rounded = np.sqrt(np.sqrt(np.square(head) + ROUNDED**2))
    return C_D * area * np.sqrt(2.0 * G) * head / rounded


# --- Torricelli -----------------------------------------------------------------------------------------


def test_in_air_it_runs_out_as_torricelli_says_and_in_his_time() -> None:
    first = 3.5
    result = run(standing(30.0, BOTTOM, initial=AREA * first), 300.0, 1.0)
    volume, loss = states(result)
    rate = C_D * 0.05 / AREA * np.sqrt(0.5 * G)
    root = np.clip(np.sqrt(first) - rate * np.asarray(result.time), 0.0, None)
    high = root**2 > 0.1
    assert high.sum() > 50
    assert volume[high] / AREA == pytest.approx(root[high] ** 2, abs=5e-6)
    told = events(result)
    assert list(told) == ["empty"]
    assert told["empty"] == pytest.approx([np.sqrt(first) / rate], rel=1e-7)
    assert np.all(np.diff(volume) < 1e-9)
    assert np.abs(volume[-1]) < 1e-9, "and it stays empty"
    assert loss[-1] == pytest.approx(RHO * G * AREA * first**2 / 2.0, rel=1e-6), "all of its head is lost"
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


def test_an_opening_in_the_wall_lets_it_run_out_to_its_own_height() -> None:
    result = run(standing(30.0, ((0.5, 0.0, 1.2), 0.05), initial=AREA * 3.0), 400.0, 1.0)
    volume, loss = states(result)
    assert volume[-1] / AREA == pytest.approx(1.2, abs=1e-6)
    assert events(result) == {}
    assert loss[-1] == pytest.approx(RHO * G * AREA * (3.0 - 1.2) ** 2 / 2.0, rel=1e-5)


def test_a_rounded_root_changes_little_and_as_stated() -> None:
    """Time to a level by quadrature of the rounded law, down to a head of twice the rounding."""
    first, last = 0.5, 2.0 * ROUNDED
    until, _ = quad(lambda s: AREA * 2.0 * s / through(s * s), np.sqrt(last), np.sqrt(first), epsabs=1e-10)
    result = run(standing(30.0, BOTTOM, initial=AREA * first), until, until)
    assert states(result)[0][-1] == pytest.approx(AREA * last, rel=1e-6)


# --- filling and bounds ---------------------------------------------------------------------------------


def test_under_water_it_fills_as_the_root_of_the_head_says_and_stays_full() -> None:
    deep = 10.0
    result = run(standing(-deep, BOTTOM), 400.0, 1.0)
    volume, _ = states(result)
    rate = C_D * 0.05 / AREA * np.sqrt(0.5 * G)
    head = np.sqrt(deep) - rate * np.asarray(result.time)
    full_at = (np.sqrt(deep) - np.sqrt(deep - HEIGHT)) / rate
    filling = np.asarray(result.time) < full_at
    assert volume[filling] / AREA == pytest.approx(deep - head[filling] ** 2, abs=1e-7)
    assert events(result)["full"] == pytest.approx([full_at], rel=1e-7)
    assert volume[~filling] == pytest.approx(AREA * HEIGHT, abs=1e-9)
    assert np.ptp(volume[~filling]) == 0.0
    assert result.stats["steps"] < 1000, "nothing chatters at the bound"
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


def test_an_opening_above_the_water_inside_fills_it_under_constant_head() -> None:
    result = run(standing(-6.0, ((0.0, 0.5, 3.9), 0.01)), 100.0, 5.0)
    volume, loss = states(result)
    flow = C_D * 0.01 * np.sqrt(2.0 * G * (6.0 - 3.9))
    filled_to = flow * np.asarray(result.time)
    assert filled_to[-1] < 3.9 * AREA
    assert volume == pytest.approx(filled_to, rel=1e-6)
    fallen = RHO * G * (6.0 * filled_to - filled_to**2 / (2.0 * AREA))
    assert loss == pytest.approx(fallen, rel=1e-6), "its fall to the level inside is lost too"


def test_an_opening_above_both_lets_nothing_through() -> None:
    result = run(standing(-1.0, ((0.0, 0.0, 1.5), 0.2), initial=2.5), 20.0, 1.0)
    assert np.all(states(result)[0] == 2.5)


def test_what_is_full_gives_where_it_takes_and_no_more() -> None:
    """A crest at one opening and a trough at the other: while it is full, only what leaves comes in."""
    holes = [((x, 0.0, 0.7), 0.2) for x in (-20.0, 20.0)]
    scene = standing(-3.7, *holes, initial=9.0 * HEIGHT, area=9.0)
    scene.waves = wave(period=8.0, amplitude=1.5)
    result = run(scene, 60.0, 0.05, rtol=1e-8)
    volume, loss = states(result)
    assert volume.max() <= 9.0 * HEIGHT * (1.0 + 1e-9)
    assert np.all(np.diff(loss) >= 0.0)
    assert loss[-1] > 1e5, "water flows through"


def wave(*, period: float, amplitude: float) -> Waves:
    one = np.ones(1)
    return Waves(
        omega=2.0 * np.pi / period * one, amplitude=amplitude * one, phase=0.0 * one, direction=0.0 * one,
        hulls={},
    )  # fmt: skip


def test_a_compartment_that_comes_out_in_troughs_keeps_its_bounds_and_its_steps() -> None:
    """Full in crests, draining in troughs, with an opening in its bottom and one in its lid."""
    scene = standing(-3.6, ((0.0, 0.0, 0.0), 0.3), ((0.0, 0.0, 4.0), 0.1))
    scene.waves = wave(period=8.0, amplitude=2.0)
    result = run(scene, 80.0, 0.05, integrator="dopri5", rtol=1e-7)
    volume, loss = states(result)
    assert volume.max() <= AREA * HEIGHT * (1.0 + 1e-7)
    assert volume.min() >= -1e-7 * AREA * HEIGHT
    full = events(result)["full"]
    assert len(full) == 8
    assert np.diff(full)[1:] == pytest.approx(8.0, abs=1e-4), "once in each wave, after it has filled"
    assert np.all(np.diff(loss) >= -1e-6)
    assert result.stats["steps"] < 4000
    assert np.max(np.abs(result["energy_balance"])) < 1e-5 * np.max(result["absolute_work"])


@pytest.mark.warns("UnitWarning")
def test_inside_the_water_follows_the_pressure_at_the_opening_which_falls_with_depth() -> None:
    period, depth = 9.0, 15.0
    scene = standing(-depth, ((0.0, 0.0, 0.0), 2.0), height=20.0, initial=AREA * depth)
    scene.waves = wave(period=period, amplitude=0.3)
    result = run(scene, 6.0 * period, period / 40.0, rtol=1e-8)
    level = states(result)[0] / AREA - depth
    last = np.asarray(result.time) > 5.0 * period - 1e-9
    k = (2.0 * np.pi / period) ** 2 / G
    amplitude = 0.5 * np.ptp(level[last])
    assert amplitude == pytest.approx(0.3 * np.exp(-k * depth), rel=0.02)


@pytest.mark.parametrize("degrees", [0.0, 20.0])
def test_at_any_heel_the_level_inside_is_that_of_the_sea(degrees: float) -> None:
    lean = np.radians(degrees)
    result = run(standing(-2.0, BOTTOM, lean=lean), 300.0, 300.0)
    assert states(result)[0][-1] / AREA * np.cos(lean) == pytest.approx(2.0, abs=1e-6)


# --- mass and weight ------------------------------------------------------------------------------------


def on_a_spring(z: float, *openings: tuple[Any, float], **more: Any) -> Scene:
    scene = guided((0.0, 0.0, 1.0), z)
    scene.add_spring(
        "rope", first="ground", second="load", first_point=(0.0, 0.0, 50.0), second_point=(0.0, 0.0, HEIGHT),
        stiffness=2e5, damping=1e5, natural_length=50.0 - z - HEIGHT,
    )  # fmt: skip
    filled(scene, *openings, **more)
    return scene


def test_at_rest_it_weighs_what_water_is_left_in_it() -> None:
    """Closed below, it keeps what it has; open below, in air it is empty and in water as full as outside."""
    described = 10.0
    keeps = equilibrium(on_a_spring(described, ((0.0, 0.0, 3.9), 0.1), initial=6.0))
    assert height_of(keeps) == pytest.approx(described - (4e3 + 6.0 * RHO) * G / 2e5, abs=1e-9)
    drained = equilibrium(on_a_spring(described, BOTTOM, initial=6.0))
    assert height_of(drained) == pytest.approx(described - 4e3 * G / 2e5, abs=1e-9)
    sunk = equilibrium(on_a_spring(-1.0, BOTTOM, initial=6.0))
    z = height_of(sunk)
    assert z == pytest.approx(-1.0 - 4e3 * G / 2e5, abs=1e-4), "the shell carries what water is in it"
    assert sunk.load_states["water.volume"] == pytest.approx(-AREA * z, abs=1e-9)
    under = equilibrium(on_a_spring(-8.0, BOTTOM))
    assert height_of(under) == pytest.approx(-8.0 - 4e3 * G / 2e5, abs=1e-9)
    assert under.load_states["water.volume"] == pytest.approx(AREA * HEIGHT, abs=1e-9)


def height_of(state: Any) -> float:
    return float(np.asarray(state.values)[2])


def test_a_run_comes_to_the_rest_that_is_found() -> None:
    scene = on_a_spring(-1.0, BOTTOM, initial=6.0)
    result = run(scene, 400.0, 400.0, integrator="dopri5", rtol=1e-8)
    rest = equilibrium(scene)
    z = float(np.asarray(result.select("position", body="load", axis="z"))[-1])
    assert z == pytest.approx(height_of(rest), abs=1e-5)


def test_a_floating_bucket_rests_where_buoyancy_carries_it_and_its_water() -> None:
    """A box that keeps water out, with a compartment in it that takes some."""
    scene = guided((0.0, 0.0, 1.0), -1.0, mass=6e3)
    scene.add_immersed(
        "load", parts=[BoxPart(size=(2.0, 2.0, 4.0), point=(0.0, 0.0, 2.0), slam=20.0)], density=RHO
    )
    filled(scene, ((0.0, 0.0, 0.5), 0.02), area=1.0, height=3.0, point=(0.0, 0.0, 0.5), shell=False)
    rest = equilibrium(scene)
    draught = (6e3 / RHO - 0.5) / 3.0  # 4 d = m / rho + (d - 0.5)
    assert -height_of(rest) == pytest.approx(draught, abs=2e-3)
    assert rest.load_states["water.volume"] == pytest.approx(-height_of(rest) - 0.5, abs=1e-9)


def test_its_inertia_is_that_of_a_rod_from_the_bottom_to_the_surface() -> None:
    turn = Rotation.from_rotvec([0.2, -0.3, 0.5])
    x, y, z, w = turn.as_quat()
    scene = Scene(name="mass", gravity=G)
    scene.add_body(
        name="load", mass=700.0, inertia=(100.0, 200.0, 300.0), position=(0.0, 0.0, 20.0),
        center_of_mass=(0.1, 0.2, -0.3), quaternion=(w, x, y, z),
    )  # fmt: skip
    bottom = np.array([0.4, -0.2, -1.0])
    filled(scene, ((0.5, 0.0, -0.9), 0.01), point=bottom, initial=7.5)
    model = scene.compile()
    found = np.asarray(_core.Evaluator(model, "redundant").terms(0.0, model.initial_state)["mass"])
    r = turn.as_matrix()
    expected = np.zeros((6, 6))
    expected[:3, :3] = 700.0 * np.eye(3)
    expected[3:, 3:] = r @ np.diag([100.0, 200.0, 300.0]) @ r.T
    slices = (np.arange(4000) + 0.5) / 4000 * 7.5 / AREA
    for s in slices:
        lever = r @ (bottom + np.array([0.0, 0.0, s]) - [0.1, 0.2, -0.3])
        shift = np.hstack([np.eye(3), -skew(lever)])
        expected += RHO * 7.5 / len(slices) * shift.T @ shift
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-3)


def skew(a: Array) -> Array:
    """skew(a) b = a x b."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


# --- momentum and energy --------------------------------------------------------------------------------


@pytest.mark.parametrize("formulation", FORMS)
def test_water_that_comes_in_has_to_be_brought_up_to_speed(formulation: str) -> None:
    """Along a level guide m v stays, and half of m' v^2 is lost; water that leaves takes its own along."""
    scene = guided((1.0, 0.0, 0.0), -6.0, velocity=(2.0, 0.0, 0.0))
    filled(scene, ((0.0, 0.5, 3.9), 0.05))
    result = run(scene, 30.0, 0.5, formulation)
    volume, loss = states(result)
    assert volume[-1] > 5.0
    rate = np.asarray(result.select("velocity", body="load", axis="x"))
    assert (4e3 + RHO * volume) * rate == pytest.approx(4e3 * 2.0 * np.ones(len(rate)), rel=1e-9)
    fallen = RHO * G * (6.0 * volume - volume**2 / (2.0 * AREA))
    taken = 0.5 * 4e3 * 4.0 - 0.5 * (4e3 + RHO * volume) * rate**2
    assert loss == pytest.approx(fallen + taken, rel=1e-6)
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


def test_water_that_leaves_pushes_nothing() -> None:
    scene = guided((1.0, 0.0, 0.0), 20.0, velocity=(2.0, 0.0, 0.0))
    filled(scene, BOTTOM, initial=10.0)
    result = run(scene, 100.0, 1.0)
    assert states(result)[0][-1] < 3.0
    rate = np.asarray(result.select("velocity", body="load", axis="x"))
    assert rate == pytest.approx(2.0 * np.ones(len(rate)), abs=1e-9)
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


def test_in_a_current_it_comes_in_with_the_speed_of_the_water() -> None:
    scene = guided((1.0, 0.0, 0.0), -6.0)
    filled(scene, ((0.0, 0.5, 3.9), 0.05))
    scene.add_sea(vessel=None, hs=0.0, current=Current(speed=1.2, direction_deg=0.0))
    result = run(scene, 25.0, 0.5)
    volume, _ = states(result)
    rate = np.asarray(result.select("velocity", body="load", axis="x"))
    assert (4e3 + RHO * volume) * rate == pytest.approx(RHO * volume * 1.2, abs=1e-6)
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


HOLES = (((0.0, 0.0, 0.1), 0.2), ((0.0, 0.0, 2.5), 0.1))


def lifted() -> Scene:
    """Pulled out of the water from below by a force that just exceeds its weight with water."""
    scene = guided((0.0, 0.0, 1.0), -7.0)
    filled(scene, *HOLES, initial=AREA * HEIGHT)
    scene.add_point_force("pull", body="load", force=(0.0, 0.0, 1.15 * (4e3 + RHO * AREA * HEIGHT) * G))
    scene.add_spring(
        "brake",
        first="ground",
        second="load",
        first_point=(0.0, 0.0, 100.0),
        damping=2e4,
        natural_length=100.0,
    )
    return scene


@pytest.mark.parametrize("formulation", FORMS)
def test_a_lift_out_of_the_water_is_that_of_the_same_equations(formulation: str) -> None:
    result = run(lifted(), 30.0, 0.25, formulation)

    def rates(_t: float, y: Array) -> list[float]:
        z, v, volume = y
        level = z + volume / AREA
        heads = [max(-(z + at[2]), 0.0) - max(level - (z + at[2]), 0.0) for at, _ in HOLES]
        flows = [float(through(head, area)) for head, (_, area) in zip(heads, HOLES, strict=True)]
        flow = sum(flows)
        taken = sum(max(one, 0.0) for one in flows)
        if volume >= AREA * HEIGHT and flow > 0.0:
            flow, taken = 0.0, -sum(min(one, 0.0) for one in flows)
        mass = 4e3 + RHO * volume
        pull = 1.15 * (4e3 + RHO * AREA * HEIGHT) * G
        pull += RHO * G * AREA * np.clip(-z, 0.0, HEIGHT)
        return [v, (pull - mass * G - RHO * taken * v - 2e4 * v) / mass, flow]

    alone = solve_ivp(
        rates, (0.0, 30.0), [-7.0, 0.0, AREA * HEIGHT], t_eval=result.time, rtol=1e-10, atol=1e-11,
        max_step=0.005, method="DOP853",
    )  # fmt: skip
    z = np.asarray(result.select("position", body="load", axis="z"))
    assert z == pytest.approx(alone.y[0], abs=2e-6)
    assert states(result)[0] == pytest.approx(alone.y[2], abs=2e-6)
    assert z[-1] > 3.0, "it is out"
    assert states(result)[0][-1] < 0.5 * AREA * HEIGHT
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


# --- both formulations, Jacobian, restart, lanes --------------------------------------------------------


AIR = pytest.mark.parametrize("air", ["free", "vented", "shut"])


def hanging(seed: int, air: str = "free") -> Scene:
    """A load with two compartments and a part in the water that swings on two links through a sea."""
    kept = {"air": air, "exponent": 1.3} if air == "shut" else {"air": air}
    rng = np.random.default_rng(seed)
    scene = Scene(name="hanging", gravity=G)
    scene.add_body(name="hook", mass=300.0, inertia=(50.0, 60.0, 70.0), position=(0.5, 0.2, 5.0))
    scene.add_body(
        name="load", mass=9000.0, inertia=(3000.0, 4000.0, 5000.0), position=(1.0, 0.0, 0.3),
        angular_velocity=(0.2, -0.15, 0.3), velocity=(0.615, 0.86, 0.02),
    )  # fmt: skip
    scene.add_joint(kind="distance", name="rope", first="ground", second="hook", point=(0.0, 0.0, 10.0),
                    second_point=(0.5, 0.2, 5.0))  # fmt: skip
    scene.add_joint(kind="spherical", name="eye", first="hook", second="load", point=(0.6, 0.2, 4.0))
    for n in range(2):
        bottom = rng.uniform((-1.0, -1.0, -2.0), (1.0, 1.0, -1.0))
        places = bottom + rng.uniform((-0.5, -0.5, 0.0), (0.5, 0.5, 2.5), (3, 3))
        filled(
            scene, *((place, 0.05 + 0.02 * i) for i, place in enumerate(places)), name=f"water {n}",
            point=bottom, area=1.0 + n, height=2.5, initial=0.4 + 0.3 * n, **kept,
        )  # fmt: skip
    scene.add_immersed("load", parts=[CylinderPart(length=2.0, diameter=0.6, point=(0.0, 0.0, -1.0))])
    scene.add_sea(
        vessel=None, hs=1.5, tp=6.0, seed=seed, direction_deg=30.0,
        current=Current(speed=0.5, direction_deg=100.0),
    )  # fmt: skip
    return scene


@AIR
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_agree_and_the_ledger_closes(seed: int, air: str) -> None:
    one, other = (run(hanging(seed, air), 5.0, 0.1, form, rtol=1e-10) for form in FORMS)
    assert np.asarray(one["position"]) == pytest.approx(np.asarray(other["position"]), abs=1e-7)
    assert np.asarray(one["load_state"]) == pytest.approx(np.asarray(other["load_state"]), rel=1e-5, abs=1e-3)
    for result in (one, other):
        assert np.max(np.abs(result["energy_balance"])) < 1e-6 * np.max(result["absolute_work"])
        lost = np.asarray(result.select("load_state", state_name="water 0.flow_loss"))
        assert lost[-1] > 100.0
        assert np.all(np.diff(lost) >= 0.0), "flow never gives back"
        volume = np.asarray(result.select("load_state", state_name="water 1.volume"))
        assert volume.min() >= 0.0
        assert volume.max() <= 5.0 * (1.0 + 1e-9)


@AIR
@pytest.mark.parametrize("formulation", FORMS)
def test_a_run_continues_bit_for_bit(formulation: str, air: str) -> None:
    scene = hanging(1, air)
    given: dict[str, Any] = {"formulation": formulation, "integrator": "dopri5", "dt_out": 0.1}
    whole = Run(scene, 2.0, **given)
    whole.advance(0.97)
    rest = Run(scene, 2.0, start=whole.state, outputs_from=0.0, **given)
    for one in (whole, rest):
        one.advance(2.0)
    assert np.array_equal(whole.state.values, rest.state.values)


def test_a_run_continues_at_a_bound_bit_for_bit() -> None:
    scene = standing(-3.6, ((0.0, 0.0, 0.0), 0.3))
    scene.waves = wave(period=8.0, amplitude=1.0)
    given: dict[str, Any] = {"integrator": "dopri5", "dt_out": 0.1}
    whole = Run(scene, 20.0, **given)
    for stop in np.arange(8.0, 16.0, 0.7):
        rest = Run(scene, 20.0, start=whole.state, outputs_from=0.0, **given) if stop > 8.0 else None
        whole.advance(float(stop))
        if rest is not None:
            rest.advance(float(stop))
            assert np.array_equal(rest.state.values, whole.state.values)


@AIR
@pytest.mark.parametrize("volume", [0.7, None])
@pytest.mark.parametrize("seed", range(3))
def test_the_exact_jacobian_is_that_of_differences(seed: int, volume: float | None, air: str) -> None:
    """Partly filled, and full."""
    scene = hanging(seed, air)
    model = scene.compile()
    evaluator = _core.Evaluator(model, "redundant")
    y = np.asarray(evaluator.project(1.7, model.initial_state))
    for name, _, place, *_ in model.load_states:
        water = scene.loads.get(name.removesuffix(".volume"))
        if isinstance(water, _core.EntrappedWater):
            y[place] = 1.001 * water.area * water.height if volume is None else volume
    found = np.asarray(evaluator.jacobian(1.7, y))
    expected = np.empty_like(found)
    for i in range(len(y)):
        wide, near = (
            (
                np.asarray(evaluator.derivative(1.7, y + h * e))
                - np.asarray(evaluator.derivative(1.7, y - h * e))
            )
            / (2.0 * h)
            for h, e in ((h, np.eye(len(y))[i]) for h in (2e-5, 1e-5))
        )
        expected[:, i] = (4.0 * near - wide) / 3.0
    scale = np.max(np.abs(expected), axis=1, keepdims=True) + 1.0
    assert np.max(np.abs(found - expected) / scale) < 1e-5


@pytest.mark.skipif(module_of(4) is None, reason="no lanes on this processor, or in this build")
@AIR
def test_lanes_hold_water_each_its_own(air: str) -> None:
    scenes = []
    for lane in range(4):
        scene = hanging(2, air)
        scene.replace("load", mass=3000.0 + 500.0 * lane)
        scenes.append(scene)
    evaluator = _core.LaneEvaluator(module_of(4), [scene.compile() for scene in scenes])
    state = evaluator.start() + 1e-3 * np.random.default_rng(1).normal(size=evaluator.start().shape)
    alone = evaluator.scalar_derivative(2.3, state)
    apart = np.abs(evaluator.derivative(2.3, state) - alone) / np.abs(alone).max(axis=1)[:, None]
    assert apart.max() < 1e-11


@pytest.mark.warns("AssemblyWarning")
def test_a_load_welded_on_a_body_brings_its_water_to_the_carrier() -> None:
    def scene() -> Scene:
        out = Scene(name="welded", gravity=G)
        out.add_body(name="deck", mass=2000.0, inertia=(900.0, 800.0, 700.0), position=(0.0, 0.0, 1.6),
                     angular_velocity=(0.1, 0.15, -0.1))  # fmt: skip
        out.add_body(name="load", mass=700.0, inertia=(200.0, 300.0, 300.0), position=(1.5, 0.5, 0.2))
        out.add_joint(kind="weld", name="seafastening", first="deck", second="load", point=(1.0, 0.4, 0.3))
        filled(out, ((0.0, 0.0, -0.5), 0.1), area=1.0, height=2.0, point=(0.0, 0.0, -1.0), initial=1.5)
        return out

    found = []
    for merge in (True, False):
        model = scene().compile(merge=merge)
        done = Run(scene(), 1.5, model=model, dt_out=0.1, channels=CHANNELS, formulation="redundant", **EXACT)
        done.advance(1.5)
        result = done.result()
        assert result.stats["compiled_coordinates"] == (6 if merge else 12)
        assert np.max(np.abs(result["energy_balance"])) < 1e-6 * np.max(result["absolute_work"])
        found.append(np.asarray(result["position"]))
    assert found[0] == pytest.approx(found[1], abs=1e-8)


# --- what is refused, and told --------------------------------------------------------------------------


def test_leaning_over_is_told() -> None:
    scene = Scene(name="leans", gravity=G)
    scene.add_body(
        name="load", mass=4e3, inertia=(4e3, 4e3, 4e3), position=(0.0, 0.0, 30.0),
        angular_velocity=(0.0, 0.5, 0.0), gravity=False,
    )  # fmt: skip
    filled(scene, BOTTOM)
    result = run(scene, 2.0, 0.5)
    assert events(result)["leans"] == pytest.approx([np.radians(30.0) / 0.5], abs=1e-9)


HOLE = {"point": (0.0, 0.0, 0.0), "area": 0.1}


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"area": -1.0}, "area is -1"),
        ({"height": 0.0}, "height is 0"),
        ({"density": 1.025}, "t/m3"),
        ({"initial": -1.0}, "initial"),
        ({"discharge_coefficient": "0.6"}, "discharge_coefficient"),
        ({"point": (0.0, 1.0)}, "point has shape"),
        ({"openings": []}, "openings"),
        ({"openings": [3.0]}, "seacrane.water.Opening"),
        ({"openings": [{"point": (0, 0, 0), "area": -0.1}]}, "opening: area is -0.1"),
        ({"openings": [{"point": (0, 0, 0), "size": 0.1}]}, "size"),
    ],
)  # fmt: skip
def test_bad_calls_are_refused(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        bare().add_entrapped_water("load", **{"area": 2.0, "height": 3.0, "openings": [HOLE]} | given)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"openings": [HOLE | {"point": (0.0, 0.0, -0.1)}]}, "opening 1 is at -0.1 m over the bottom"),
        ({"openings": [HOLE, HOLE | {"point": (0.0, 0.0, 3000.0)}]}, "opening 2 is at 3000 m"),
        ({"openings": [HOLE | {"point": (500.0, 0.0, 1.0)}]}, "opening 1 is 500 m beside"),
        ({"openings": [HOLE | {"area": 300.0}]}, "more than the section of 2 m2"),
        ({"openings": [HOLE] * 13}, "1 to 12"),
        ({"initial": 6.5}, "it holds 6 m3"),
        ({"discharge_coefficient": 1.1}, "discharge_coefficient"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_when_the_scene_is_compiled(given: dict[str, Any], message: str) -> None:
    scene = bare()
    scene.add_immersed("load", parts=[BoxPart(size=(1.5, 1.5, 3.0), point=(0.0, 0.0, 1.5))])
    told = {"area": 2.0, "height": 3.0, "openings": [HOLE], "air": "free"}
    scene.add_entrapped_water("load", **told | given)
    with pytest.raises(SceneError, match=message):
        scene.compile()


def test_a_compartment_that_lies_is_refused() -> None:
    scene = bare(quaternion=(np.sqrt(0.5), 0.0, np.sqrt(0.5), 0.0))
    with pytest.raises(SceneError, match="leans by 90 deg"):
        scene.add_entrapped_water("load", area=2.0, height=3.0, openings=[HOLE])
    with pytest.raises(SceneError, match="no body 'lod'"):
        scene.add_entrapped_water("lod", area=2.0, height=3.0, openings=[HOLE])


def bare(**more: Any) -> Scene:
    scene = Scene(name="refused", gravity=G)
    scene.add_body(name="load", mass=1e3, inertia=(5e2, 5e2, 5e2), position=(0.0, 0.0, 5.0), **more)
    return scene


def test_tables_stand_for_openings() -> None:
    first, second = (
        bare().add_entrapped_water("load", area=2.0, height=3.0, openings=[hole])
        for hole in (HOLE, Opening(**HOLE))
    )
    assert first == second
    assert first.name == "water in load"


OPENINGS: list[Callable[[], Opening]] = [
    lambda: Opening(point=(0.0, 0.0), area=0.1),
    lambda: Opening(point=(0.0, 0.0, 0.0), area=0.0),
]


@pytest.mark.parametrize("made", OPENINGS)
def test_bad_openings_are_refused(made: Callable[[], Opening]) -> None:
    with pytest.raises(SceneError, match="opening: "):
        made()
