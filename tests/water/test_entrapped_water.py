"""Water in a compartment of a body: flow through openings, its mass and weight, its ledger, its bounds."""

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

from seacrane import Scene, SceneError, _core, equilibrium, simulate
from seacrane.arrays import Array
from seacrane.hydro import BoxPart, Compartment, CylinderPart, Opening
from seacrane.scene import Waves
from seacrane.sea import Current

ROUNDED = 1e-3  # m, the head over which the root is rounded off
BOTTOM = ((0.0, 0.0, 0.0), 0.05)  # place and area of an opening
AREA, HEIGHT, C_D = 3.0, 4.0, 0.62


def filled(scene: Scene, *openings: tuple[Any, float], **more: Any) -> None:
    """A compartment of a body "load", whose air is free, in a shell that keeps water out and no more."""
    given = {
        "air": "free", "area": AREA, "height": HEIGHT, "discharge_coefficient": C_D, "name": "water",
    } | more  # fmt: skip
    wide, tall = np.sqrt(given["area"]), given["height"]
    middle = np.add(given.get("point", np.zeros(3)), (0.0, 0.0, 0.5 * tall))
    part = BoxPart(size=(wide, wide, tall), point=middle, added_mass=(0, 0, 0), drag=0.0, source="none")
    inside = Compartment(openings=[Opening(point=point, area=area) for point, area in openings], **given)
    scene.add_immersed("load", parts=[part], inside=inside, density=RHO, name=f"shell of {given['name']}")


def standing(z: float, *openings: tuple[Any, float], **more: Any) -> Scene:
    """A compartment whose bottom is held at a height."""
    scene = Scene(name="standing", gravity=G)
    scene.add_body(name="load", mass=6e3, inertia=(6e3, 6e3, 6e3), position=(0.0, 0.0, z))
    scene.add_joint(kind="weld", name="held", first="ground", second="load", point=(0.0, 0.0, z))
    filled(scene, *openings, **more)
    return scene


def guided(axis: tuple[float, float, float], z: float, mass: float = 4e3, **more: Any) -> Scene:
    """A body that slides along an axis."""
    scene = Scene(name="guided", gravity=G)
    scene.add_body(name="load", mass=mass, inertia=(mass, mass, mass), position=(0.0, 0.0, z), **more)
    at = (0.0, 0.0, z)
    scene.add_joint("guide", kind="prismatic", first="ground", second="load", point=at, axis=axis)
    return scene


def run(scene: Scene, t_end: float, dt_out: float, formulation: str = "auto", **more: Any) -> Any:
    return simulate(scene, t_end=t_end, dt_out=dt_out, formulation=formulation, **EXACT | more)


def states(result: Any) -> tuple[Array, Array]:
    """Volume, and what is lost, of the one compartment."""
    volume, loss = (result.select("load_state", state_name=f"water.{one}") for one in ("volume", "flow_loss"))
    return np.asarray(volume), np.asarray(loss)


def times(result: Any, name: str) -> list[float]:
    """Of an event of the one compartment."""
    return [event.time for event in result.events if event.name == f"water.{name}"]


def through(head: Any, area: float = 0.05) -> Any:
    """m3/s through an opening under a head."""
    rounded = np.sqrt(np.sqrt(np.square(head) + ROUNDED**2))
    return C_D * area * np.sqrt(2.0 * G) * head / rounded


def test_in_air_it_runs_out_as_torricelli_says_and_in_his_time() -> None:
    first = 3.5
    result = run(standing(30.0, BOTTOM, initial=AREA * first), 300.0, 1.0)
    volume, loss = states(result)
    rate = C_D * 0.05 / AREA * np.sqrt(0.5 * G)
    root = np.clip(np.sqrt(first) - rate * np.asarray(result.time), 0.0, None)
    high = root**2 > 0.1
    assert volume[high] / AREA == pytest.approx(root[high] ** 2, abs=5e-6)
    assert times(result, "empty") == pytest.approx([np.sqrt(first) / rate], rel=1e-7)
    assert np.abs(volume[-1]) < 1e-9, "and it stays empty"
    assert loss[-1] == pytest.approx(RHO * G * AREA * first**2 / 2.0, rel=1e-6), "all of its head is lost"
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])
    volume, loss = states(run(standing(30.0, ((0.5, 0.0, 1.2), 0.05), initial=AREA * 3.0), 400.0, 1.0))
    assert volume[-1] / AREA == pytest.approx(1.2, abs=1e-6), "to the height of an opening in its wall"
    assert loss[-1] == pytest.approx(RHO * G * AREA * (3.0 - 1.2) ** 2 / 2.0, rel=1e-5)


def test_under_water_it_fills_as_the_root_of_the_head_says_and_stays_full() -> None:
    deep = 10.0
    result = run(standing(-deep, BOTTOM), 400.0, 1.0)
    volume, _ = states(result)
    rate = C_D * 0.05 / AREA * np.sqrt(0.5 * G)
    head = np.sqrt(deep) - rate * np.asarray(result.time)
    full_at = (np.sqrt(deep) - np.sqrt(deep - HEIGHT)) / rate
    filling = np.asarray(result.time) < full_at
    assert volume[filling] / AREA == pytest.approx(deep - head[filling] ** 2, abs=1e-7)
    assert times(result, "full") == pytest.approx([full_at], rel=1e-7)
    assert volume[~filling] == pytest.approx(AREA * HEIGHT, abs=1e-9)
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


def wave(amplitude: float) -> Waves:
    return Waves(omega=[np.pi / 4.0], amplitude=[amplitude], phase=[0.0], direction=[0.0], hulls={})


def test_a_compartment_that_comes_out_in_troughs_keeps_its_bounds_and_its_steps() -> None:
    """Full in crests, draining in troughs, with an opening in its bottom and one in its lid."""
    scene = standing(-3.6, ((0.0, 0.0, 0.0), 0.3), ((0.0, 0.0, 4.0), 0.1))
    scene.waves = wave(2.0)
    result = run(scene, 80.0, 0.05, integrator="dopri5", rtol=1e-7)
    volume, loss = states(result)
    assert volume.max() <= AREA * HEIGHT * (1.0 + 1e-7) and volume.min() >= -1e-7 * AREA * HEIGHT
    assert np.diff(times(result, "full"))[1:] == pytest.approx(8.0, abs=1e-4), (
        "once in each wave, after it has filled"
    )
    assert np.all(np.diff(loss) >= -1e-6)
    assert result.stats["steps"] < 4000
    assert np.max(np.abs(result["energy_balance"])) < 1e-5 * np.max(result["absolute_work"])


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


def height_of(state: Any) -> float:
    return float(np.asarray(state.values)[2])


def test_its_inertia_is_that_of_a_rod_from_the_bottom_to_the_surface() -> None:
    turn, center = Rotation.from_rotvec([0.2, -0.3, 0.5]), np.array([0.1, 0.2, -0.3])
    scene = Scene(name="mass", gravity=G)
    scene.add_body(name="load", mass=700.0, inertia=(100.0, 200.0, 300.0), position=(0.0, 0.0, 20.0),
                   center_of_mass=center, quaternion=wet.quaternion(turn))  # fmt: skip
    bottom = np.array([0.4, -0.2, -1.0])
    filled(scene, ((0.5, 0.0, -0.9), 0.01), point=bottom, initial=7.5)
    found, expected = wet.masses(scene, 700.0, (100.0, 200.0, 300.0), turn)
    for s in (np.arange(4000) + 0.5) / 4000 * 7.5 / AREA:
        expected += wet.shifted(RHO * 7.5 / 4000 * np.eye(3), turn.apply(bottom - center + (0.0, 0.0, s)))
    assert found == pytest.approx(expected, rel=1e-6, abs=1e-3)


@pytest.mark.parametrize(("start", "current"), [(2.0, 0.0), (0.0, 1.2)])
def test_water_that_comes_in_is_brought_up_to_speed(start: float, current: float, formulation: str) -> None:
    """Along a level guide momentum is that of body and water, and half of m' v^2 over the water is lost."""
    scene = guided((1.0, 0.0, 0.0), -6.0, velocity=(start, 0.0, 0.0))
    filled(scene, ((0.0, 0.5, 3.9), 0.05))
    if current:
        scene.add_sea(vessel=None, hs=0.0, current=Current(speed=current, direction_deg=0.0))
    result = run(scene, 30.0, 0.5, formulation)
    volume, loss = states(result)
    over = np.asarray(result.select("velocity", body="load", axis="x")) - current
    mass = 4e3 + RHO * volume
    assert mass * over == pytest.approx(4e3 * (start - current) * np.ones(len(over)), rel=1e-9)
    fallen = RHO * G * (6.0 * volume - volume**2 / (2.0 * AREA))
    taken = 0.5 * 4e3 * (start - current) ** 2 - 0.5 * mass * over**2
    assert loss == pytest.approx(fallen + taken, rel=1e-6)
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


HOLES = (((0.0, 0.0, 0.1), 0.2), ((0.0, 0.0, 2.5), 0.1))


def test_a_lift_out_of_the_water_is_that_of_the_same_equations(formulation: str) -> None:
    """Pulled out of the water from below by a force that just exceeds its weight with water."""
    scene = guided((0.0, 0.0, 1.0), -7.0)
    filled(scene, *HOLES, initial=AREA * HEIGHT)
    scene.add_force("load", name="pull", force=(0.0, 0.0, 1.15 * (4e3 + RHO * AREA * HEIGHT) * G))
    brake = {"first_point": (0.0, 0.0, 100.0), "damping": 2e4, "natural_length": 100.0}
    scene.add_spring("brake", first="ground", second="load", **brake)
    result = run(scene, 30.0, 0.25, formulation)

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

    how: dict[str, Any] = {"rtol": 1e-10, "atol": 1e-11, "max_step": 0.005, "method": "DOP853"}
    alone = solve_ivp(rates, (0.0, 30.0), [-7.0, 0.0, AREA * HEIGHT], t_eval=result.time, **how)
    z = np.asarray(result.select("position", body="load", axis="z"))
    assert z == pytest.approx(alone.y[0], abs=2e-6)
    assert states(result)[0] == pytest.approx(alone.y[2], abs=2e-6)
    assert z[-1] > 3.0, "it is out"
    assert np.max(np.abs(result["energy_balance"])) < 1e-8 * np.max(result["absolute_work"])


def hanging(seed: int, air: str = "free") -> Scene:
    """A load with two compartments and a part in the water that swings on two links through a sea."""
    kept = {"air": air, "exponent": 1.3} if air == "shut" else {"air": air}
    rng = np.random.default_rng(seed)
    scene = wet.hung_on_links(
        5.0, mass=9000.0, angular_velocity=(0.2, -0.15, 0.3), velocity=(0.615, 0.86, 0.02)
    )
    for n in range(2):
        bottom = rng.uniform((-1.0, -1.0, -2.0), (1.0, 1.0, -1.0))
        places = bottom + rng.uniform((-0.5, -0.5, 0.0), (0.5, 0.5, 2.5), (3, 3))
        filled(
            scene, *((place, 0.05 + 0.02 * i) for i, place in enumerate(places)), name=f"water {n}",
            point=bottom, area=1.0 + n, height=2.5, initial=0.4 + 0.3 * n, **kept,
        )  # fmt: skip
    scene.add_immersed("load", parts=[CylinderPart(length=2.0, diameter=0.6, point=(0.0, 0.0, -1.0))])
    current = Current(speed=0.5, direction_deg=100.0)
    scene.add_sea(vessel=None, hs=1.5, tp=6.0, seed=seed, direction_deg=30.0, current=current)
    return scene


@pytest.mark.parametrize("air", ["free", "vented", "shut"])
@pytest.mark.parametrize("seed", range(3))
def test_both_formulations_agree_and_the_ledger_closes(seed: int, air: str) -> None:
    """And the Jacobian is exact, partly filled and full."""
    scene = hanging(seed, air)
    found = both_forms(scene, 5.0, wet.ALIKE, **EXACT | {"rtol": 1e-10})["load_state"]
    names = [name for name, *_ in scene.compile().load_states]
    lost, volume = (found[:, names.index(name)] for name in ("water 0.flow_loss", "water 1.volume"))
    assert lost[-1] > 100.0
    assert np.all(np.diff(lost) >= 0.0), "flow never gives back"
    assert volume.min() >= 0.0 and volume.max() <= 5.0 * (1.0 + 1e-9)
    for whole in (False, True):

        def fill(model: Any, y: Array, whole: bool = whole) -> None:
            for name, _, place, *_ in model.load_states:
                water = scene.loads.get(name.removesuffix(".volume"))
                if isinstance(water, _core.EntrappedWater):
                    y[place] = 1.001 * water.area * water.height if whole else 0.7

        wet.has_the_jacobian_of_differences(scene, 1.7, 1e-5, fill)


@pytest.mark.parametrize("air", ["free", "vented", "shut"])
def test_a_run_continues_bit_for_bit(formulation: str, air: str) -> None:
    goes_on(lambda: hanging(1, air), 2.0, 0.97, integrator="dopri5", dt_out=0.1, formulation=formulation)


def test_a_run_continues_at_a_bound_bit_for_bit() -> None:
    scene = standing(-3.6, ((0.0, 0.0, 0.0), 0.3))
    scene.waves = wave(1.0)
    for stop in np.arange(8.0, 15.0, 0.7):
        goes_on(lambda: scene, float(stop) + 0.7, float(stop), integrator="dopri5", dt_out=0.1)


@needs_lanes
@pytest.mark.parametrize("air", ["free", "vented", "shut"])
def test_lanes_hold_water_each_its_own(air: str) -> None:
    scenes = [hanging(2, air) for _ in range(4)]
    for lane, scene in enumerate(scenes):
        scene.replace("load", mass=3000.0 + 500.0 * lane)
    wet.lanes_are_as_alone(scenes, 2.3)


HOLE = {"point": (0.0, 0.0, 0.0), "area": 0.1}


@pytest.mark.parametrize(
    ("given", "message"),
    [({"initial": 6.5}, "it holds 6 m3"), ({"openings": []}, "openings"),
     ({"openings": [HOLE | {"point": (0.0, 0.0, -0.1)}]}, "opening 1 is at -0.1 m"),
     ({"openings": [HOLE | {"point": (500.0, 0.0, 1.0)}]}, "opening 1 is 500 m beside"),
     ({"openings": [HOLE | {"area": 300.0}]}, "section of 2 m2"), ({"openings": [HOLE] * 13}, "1 to 12")],
)  # fmt: skip
def test_bad_calls_are_refused(given: dict[str, Any], message: str) -> None:
    scene, told = Scene(name="refused", gravity=G), {"openings": [HOLE], "air": "free"} | given
    scene.add_body(name="load", mass=1e3, inertia=(5e2, 5e2, 5e2), position=(0.0, 0.0, 5.0))
    part = BoxPart(size=(1.5, 1.5, 3.0), point=(0.0, 0.0, 1.5))
    with pytest.raises(SceneError, match=message):
        scene.add_immersed("load", parts=[part], inside=Compartment(area=2.0, height=3.0, **told))
        scene.compile()
