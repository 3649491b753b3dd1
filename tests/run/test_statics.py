"""Statics against closed forms, virtual work, other functions, and a run that comes to rest."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import seacrane as sc
from seacrane import cases
from seacrane.analysis import driven
from seacrane.crane import Crane, Payload, load_crane
from seacrane.crane.load_crane import SHIPPED

G = 9.80665
MASS = 4.0e6  # kg, of the barge
C33, C44, C55 = 1.2e7, 2.4e8, 2.0e9  # N/m, N m/rad
HEIGHT, LOAD = 20.0, 5.0e4  # m above the waterline, kg


def barge(**slack: float) -> sc.Scene:
    """A hull by its matrices, restored in heave, roll and pitch, moored in the plane."""
    scene = sc.Scene(name="barge", gravity=G)
    scene.add_body("hull", mass=MASS, inertia=np.diag([2e8, 2e9, 2e9]), position=(0, 0, 0), gravity=False)
    scene.add_vessel(
        body="hull", name="hull", added_mass=np.zeros((6, 6)), restoring=np.diag([0, 0, C33, C44, C55, 0]),
        linear_damping=np.diag([1e6, 1e6, 1e7, 3e8, 3e9, 1e9]), mooring_stiffness=[1e5, 1e5, 1e7], **slack,
    )  # fmt: skip
    return scene


def hanging(scene: sc.Scene, *, y: float, mass: float = LOAD) -> sc.Scene:
    """A load on a rope of 10 m from a light mast, `y` to port."""
    mast, low = (0.0, y, HEIGHT), (0.0, y, HEIGHT - 10.0)
    scene.add_body(name="mast", mass=1e-3, inertia=1e-3 * np.eye(3), position=mast)
    scene.add_joint(name="weld", kind="weld", first="hull", second="mast", point=mast)
    scene.add_body(name="load", mass=mass, inertia=mass * np.eye(3), position=low)
    ends = {"first": "mast", "second": "load", "point": mast, "second_point": low}
    scene.add_joint("rope", kind="distance", **ends, length=10)
    scene.add_roles(link="rope")
    return scene


def lashed(scene: sc.Scene, place: tuple[float, float, float]) -> sc.Scene:
    scene.add_body(name="box", mass=LOAD, inertia=LOAD * np.eye(3), position=place)
    scene.add_joint(name="lashed", kind="weld", first="hull", second="box", point=place)
    return scene


def test_a_damped_run_comes_to_rest_there() -> None:
    scene = lashed(barge(), (0.0, 3.0, 2.0))
    told, motion = sc.statics(scene), sc.simulate(scene, t_end=120.0, dt_out=1.0)["vessel_motion"][-1]
    assert (motion[3], -motion[2]) == pytest.approx(
        (float(told["heel"]), float(told["draught change"])), rel=1e-4
    )


def test_a_hanging_load_counts_at_its_tip() -> None:
    """GM = (C44 - m g h) / (displaced weight); fixed on deck, h is the height of the load itself.

    C44 phi = m g (y cos phi + h sin phi), which for small angles is phi = m g y / (C44 - m g h).
    """
    weight, y = (MASS + LOAD) * G, 3.0
    assert sc.statics(barge())["GM"] == pytest.approx(C44 / (MASS * G), rel=1e-9)
    hung = sc.statics(hanging(barge(), y=0.0))
    assert hung["GM"] == pytest.approx((C44 - LOAD * G * HEIGHT) / weight, rel=1e-6)
    fixed = sc.statics(lashed(barge(), (0.0, 0.0, HEIGHT - 10.0)))
    assert fixed["GM"] == pytest.approx((C44 - LOAD * G * (HEIGHT - 10.0)) / weight, rel=1e-6)
    assert hung["draught change"] == pytest.approx(LOAD * G / C33, rel=1e-6)
    assert hung["hook load"] == pytest.approx(LOAD * G, rel=1e-6)
    phi = -float(sc.statics(hanging(barge(), y=y))["heel"])  # towards the load, which lowers port
    assert C44 * phi == pytest.approx(LOAD * G * (y * np.cos(phi) + HEIGHT * np.sin(phi)), rel=1e-6)
    assert phi == pytest.approx(LOAD * G * y / (C44 - LOAD * G * HEIGHT), rel=2e-3)


def crane_on_ground(*, s1: float = 1.0) -> sc.Scene:
    scene = sc.Scene(name="quay", gravity=G)
    scene.add_crane(base="ground", slew=0.0, s1=s1, s2=1.5, payload=Payload(mass=2e4))
    return scene


def test_cylinder_forces_are_those_of_virtual_work() -> None:
    crane, scene = load_crane(), crane_on_ground()
    pose = {"main": [0.0, 1.0], "knuckle": [-0.5, 1.0]}
    told = sc.statics(scene, coordinates=pose)
    assert told["cylinder force main"].shape == (2, 2)
    for i, main in enumerate((1.0, 2.0)):
        for k, knuckle in enumerate((1.0, 2.5)):
            by_work = crane.static_cylinder_forces(s1=main, s2=knuckle, payload_mass=2e4, gravity=G)
            found = [told[f"cylinder force {label}"][i, k] for label in ("main", "knuckle")]
            assert found == pytest.approx(by_work, rel=1e-6)
    assert np.abs(told["slew torque"]).max() < 1e-6, "the slew axis is vertical"
    for name, joint in (("slew", "A"), ("main", "main_cylinder")):  # drivers give way to the pose
        scene.add_driver(joint=joint, curve=sc.Curve.constant(value=0.0), name=name)
    driven_there = sc.statics(scene, coordinates=pose)
    np.testing.assert_allclose(driven_there["cylinder force main"], told["cylinder force main"], rtol=1e-9)
    for stroke in (0.0, 0.5):  # the tip's height is where it is described
        raised = crane_on_ground(s1=1.0 + stroke)
        body, point = raised.roles[""].tip
        height = sc.statics(crane_on_ground(), coordinates={"main": stroke})["tip height"]
        assert height == pytest.approx(raised.place_of(body=body, point=point)[2], abs=1e-6)


def test_a_radius_is_reached_by_one_cylinder() -> None:
    """The tip of the crane's own geometry is at the radius asked for, at the forces of that stroke."""
    crane = load_crane()
    told = sc.statics(crane_on_ground(), slew=[0.0, -1.0], radius=[19.0, 22.0])
    np.testing.assert_allclose(told["tip radius"], [[19.0, 22.0]] * 2, rtol=1e-9)
    strokes = np.linspace(2.0, 5.0, 301)
    tips = [np.hypot(*crane.tip(slew=0.0, s1=s, s2=1.5)[:2]) for s in strokes]
    s1 = np.interp(19.0, tips[::-1], strokes[::-1])
    by_work = crane.static_cylinder_forces(s1=s1, s2=1.5, payload_mass=2e4, gravity=G)
    assert told["cylinder force main"][0, 0] == pytest.approx(by_work[0], rel=1e-4)
    np.testing.assert_allclose(told["cylinder force main"][0], told["cylinder force main"][1], rtol=1e-6)


def test_the_end_of_case_2_is_its_equilibrium_and_its_feed_forward() -> None:
    """Heel of equilibrium(), forces of the quasi-static feed-forward; at the start those of balance()."""
    scene = cases.case2(hs=0.0, memory="none")
    begun, balanced = sc.statics(scene), sc.balance(scene)
    assert abs(begun["heel"]) < 1e-6 and abs(begun["draught change"]) < 1e-6
    told = sc.statics(scene, slew=-np.pi / 2, coordinates={"main": 2.0, "knuckle": 2.0})
    rest = sc.equilibrium(driven(scene), time=50.0)
    held = sc.simulate(driven(scene), t_end=50.01, start=rest, dt_out=0.01)
    heel = held["vessel_motion"][0, 3]
    assert told["heel"].item() == pytest.approx(heel, rel=1e-6) and abs(heel) > np.radians(4.0)
    columns = {"main": "cylinder force main", "knuckle": "cylinder force knuckle", "slew": "slew torque"}
    for name, column in columns.items():
        forward = scene.actuators[name].feed_forward.evaluate([50.0])[0, 0]
        assert told[column].item() == pytest.approx(forward, rel=1e-4 if name == "slew" else 1e-5)
        assert name == "slew" or begun[column] == pytest.approx(balanced.loads[name], rel=1e-6)


def test_neither_fluid_memory_nor_a_wire_matters_at_rest() -> None:
    plain = sc.statics(cases.case2(hs=0.0, memory="none"), slew=-1.0)
    wired = cases.case2(hs=0.0, memory="convolution")
    wired.add_line(joint="link", rung="rigid")
    told = sc.statics(wired, slew=-1.0)
    for name, values in plain.columns.items():
        assert told[name].item() == pytest.approx(values.item(), rel=1e-6), name


def test_each_of_two_cranes_is_told_apart() -> None:
    scene = sc.Scene(name="quay")
    for prefix, y, mass in (("a ", 0.0, 2e4), ("b ", 30.0, 3e4)):
        scene.add_crane(base="ground", foot=(0.0, y, 0.0), prefix=prefix, payload=Payload(mass=mass))
    told = sc.statics(scene, coordinates={"main": [0.0, 1.0]}, crane="b ")
    assert told["hook load a hook"] == pytest.approx([20e3 * G, 20e3 * G])
    assert told["hook load b hook"] == pytest.approx([30e3 * G, 30e3 * G])
    np.testing.assert_allclose(*told["cylinder force a main"], rtol=1e-9)
    assert abs(np.diff(told["cylinder force b main"])[0]) > 10.0
    with pytest.raises(sc.SceneError, match="its cranes have prefixes 'a ', 'b '; name one as crane"):
        sc.statics(scene, slew=0.0)


def test_what_cannot_be_reached_is_refused() -> None:
    crane = crane_on_ground()
    for scene, asked, words in (
        (crane, {"radius": 40.0}, "radius 40 m: 'main'"),
        (crane, {"coordinates": {"main": 9.0}}, "main is 9 m.* -1 to"),
        (crane, {"radius": 20.0, "coordinates": {"main": 1.0}}, "'main' is given a stroke"),
        (crane, {"slew": [[0.0]]}, r"slew has shape \(1, 1\)"), (barge(), {"slew": 0.0}, "prefixes none"),
    ):  # fmt: skip
        with pytest.raises(sc.SceneError, match=words):
            sc.statics(scene, **asked)


def test_pressures_are_forces_over_the_loaded_side() -> None:
    scene = sc.Scene(name="crane", gravity=G)
    scene.add_crane(base="ground", s1=1.5, s2=1.0)
    force, roles = sc.statics(scene), scene.roles[""]
    areas = {"main": (0.5, 0.25), "knuckle": (0.4, 0.2)}
    scene.roles.clear()
    scene.add_roles(slew=roles.slew, cylinders=roles.cylinders, tip=roles.tip, areas=areas)
    found = sc.statics(scene)
    for label, (full, ring) in areas.items():
        push = float(force[f"cylinder force {label}"])
        assert float(found[f"cylinder force {label}"]) == push
        pressure = push / (full if push > 0.0 else ring)
        assert float(found[f"cylinder pressure {label}"]) == pytest.approx(pressure)
        assert found.units[f"cylinder pressure {label}"] == "Pa"


def test_areas_come_from_the_crane_s_file_and_have_limit_states(tmp_path: Path) -> None:
    text, path = (SHIPPED / "knuckle_boom_250t.toml").read_text(), tmp_path / "crane.toml"

    def crane(areas: str) -> Crane:
        path.write_text(f'{text}\n[[pistons]]\ncylinder = "main"\n{areas}')
        return load_crane(path)

    scene = sc.Scene(name="crane", gravity=G)
    scene.add_crane(crane("full_area = 0.5\nrod_side_area = 0.25"), base="ground", s1=1.5, s2=1.0)
    assert scene.roles[""].areas == {"main": (0.5, 0.25)}
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint=joint, curve=sc.Curve.constant(value=0.0))
    scene.add_limit_state(channel="cylinder_pressure", maximum=20e6, names={"piston": "main"})
    result = sc.simulate(scene, 0.1, dt_out=0.1)
    force = result["cylinder_force"]
    np.testing.assert_allclose(result["cylinder_pressure"], force[:, :1] / 0.5)
    (used,) = result.utilisation
    assert used.unit == "Pa" and used.limit == pytest.approx(200e5)
    assert used.utilisation == pytest.approx(force[:, 0].max() / 0.5 / 20e6)
    with pytest.raises(sc.FileFormatError, match="full side"):
        crane("full_area = 0.5\nrod_side_area = 0.6")


def test_lines_tell_their_lengths() -> None:
    """A load of 10 t on a steel wire: T = m g, stretch = T L0 / EA."""
    scene = sc.Scene(name="line", gravity=G)
    scene.add_body(name="load", mass=1e4, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -20.0))
    scene.add_line("hoist", bodies=["ground", "load"], points=[(0, 0, 0), (0, 0, 0)], EA=1e7, length=19.9)
    found, tension = sc.statics(scene), 1e4 * G
    assert float(found["hook load hoist"]) == pytest.approx(10e3 * G, rel=1e-6)
    assert float(found["line tension hoist"]) == pytest.approx(tension, rel=1e-6)
    assert float(found["line unstretched length hoist"]) == pytest.approx(19.9, rel=1e-12)
    assert float(found["line length hoist"]) == pytest.approx(19.9 * (1.0 + tension / 1e7), rel=1e-9)


def test_numbers_give_numbers_and_rows_give_axes() -> None:
    """Also beside a row: only that one makes an axis."""
    scene = crane_on_ground()
    one, row = sc.statics(scene, slew=-0.5, radius=20.0), sc.statics(scene, slew=-0.5, radius=[20.0, 22.0])
    assert one["tip radius"].shape == () and row["tip radius"] == pytest.approx([20.0, 22.0])
    assert row["hoist tension"][0] == pytest.approx(one["hoist tension"], rel=1e-6)
    table = row.to_xarray()
    assert table["tip radius"].dims == ("radius",) and table["tip radius"].coords["slew"].item() == -0.5
