"""A compartment's air and its lid in closed form: free, vented, shut; the surface below and above the lid."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, simulate
from seacrane.arrays import Array
from seacrane.hydro import BoxPart, Compartment, CylinderPart

G, RHO, ATMOSPHERE, VAPOUR = 9.80665, 1025.0, 101325.0, 2339.0
AIR_DENSITY = 1.204
D, H, MASS, C_D = 6.0, 12.0, 90e3, 0.6
A = np.pi / 4.0 * D**2
MOUTH = {"point": (0.0, 0.0, 0.0), "area": A}
UPRIGHT = ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (-1.0, 0.0, 0.0))  # of a cylinder's x
SHUT: dict[str, Any] = {"air": "shut", "exponent": 1.0}


def vent(area: float) -> dict[str, Any]:
    return {"point": (0.0, 0.0, H), "area": area}


def bucket(lean: float, mouth: float, curve: Curve, *openings: dict[str, Any], **more: Any) -> Scene:
    """A suction anchor that is led along its axis, the middle of its mouth at an elevation; or its shell."""
    scene = Scene(name="bucket", gravity=G)
    axis = np.array([np.sin(lean), 0.0, np.cos(lean)])
    at = np.array([0.0, 0.0, mouth])
    turned = (np.cos(0.5 * lean), 0.0, np.sin(0.5 * lean), 0.0)
    scene.add_body("anchor", mass=MASS, inertia=(2e6, 2e6, 5e5), position=at, quaternion=turned)
    scene.add_joint("guide", kind="prismatic", first="ground", second="anchor", point=at, axis=axis)
    scene.add_driver(joint="guide", curve=curve, name="led")
    shell = CylinderPart(length=H, diameter=D, axes=UPRIGHT, strips=1, point=(0, 0, H / 2))
    given: dict[str, Any] = {"area": A, "height": H, "name": "water"} | more
    inside = Compartment(openings=openings, **given) if openings else None
    scene.add_immersed("anchor", parts=[shell], inside=inside, density=RHO)
    return scene


def pushes(formulation: str, t_end: float, *given: Any, **more: Any) -> tuple[Array, Array, Array]:
    """Times, what the compartment pushes the body by along its axis, N, and its volume."""
    run: dict[str, Any] = {"t_end": t_end, "dt_out": 0.1, "formulation": formulation, "rtol": 1e-8}
    filled, shell = simulate(bucket(*given, **more), **run), simulate(bucket(*given[:3]), **run)
    assert np.max(np.abs(filled["energy_balance"])) < 1e-5 * np.max(filled["absolute_work"])
    force = shell["driver_force"][:, 0] - filled["driver_force"][:, 0]
    return filled.time, force, filled.select("load_state", state_name="water.volume")


HEAVE, OMEGA = 0.5, 0.9


def heaving() -> Curve:
    return Curve.harmonic(amplitude=HEAVE, omega=OMEGA, phase=-0.5 * np.pi)


LEANS = pytest.mark.parametrize("lean", [0.0, np.radians(45.0)], ids=["upright", "lying"])


@LEANS
def test_with_a_dry_lid_an_open_mouth_carries_no_water_along_the_axis(formulation: str, lean: float) -> None:
    """What is left is the sea's pressure on the closed end that parts count, and the mouth has not."""
    deep = 6.0 * np.cos(lean)
    filled = {"initial": 6.0 * A}
    t, force, volume = pushes(formulation, 15.0, lean, -deep, heaving(), MOUTH, vent(1.0), **filled)
    depth = deep - HEAVE * np.sin(OMEGA * t) * np.cos(lean)
    air = 0.5 * AIR_DENSITY * (np.gradient(volume, t) / C_D) ** 2 * np.sign(np.gradient(volume, t))
    assert force == pytest.approx(-RHO * G * A * depth + air * (A - 1.0), abs=6e3)
    assert volume / A == pytest.approx(depth / np.cos(lean), abs=0.15)


@LEANS
def test_a_wet_lid_less_its_opening_carries_all_of_it(formulation: str, lean: float) -> None:
    deep, share = 18.0 * np.cos(lean), 1.0 - 0.02 / A
    t, force, volume = pushes(formulation, 15.0, lean, -deep, heaving(), MOUTH, vent(0.02), initial=A * H)
    rate = -HEAVE * OMEGA**2 * np.sin(OMEGA * t)
    assert volume == pytest.approx(A * H * np.ones(len(t)), rel=1e-9)
    assert force == pytest.approx(-RHO * A * H * (G * np.cos(lean) + share * rate), rel=1e-6)


def test_a_tube_open_at_both_ends_carries_nothing_at_any_depth_and_an_open_one_in_air_is_its_steel() -> None:
    both = (MOUTH, vent(A))
    for deep in (6.0, 20.0):
        t, force, _ = pushes("auto", 15.0, 0.0, -deep, heaving(), *both, initial=A * min(deep, H))
        depth = deep - HEAVE * np.sin(OMEGA * t)
        closed = RHO * G * A * np.minimum(depth, H)
        assert force == pytest.approx(-closed, abs=1.0), "all the buoyancy of a closed shape, and no inertia"
    _, force, volume = pushes("auto", 5.0, 0.0, 3.0, heaving(), MOUTH, vent(1.0))
    assert np.max(np.abs(volume)) < 1e-9
    assert np.max(np.abs(force)) < 1e-3


def test_air_that_a_vent_lets_out_resists(formulation: str) -> None:
    lowered = Curve.pieces(starts=[0.0], coefficients=[[0.0, -3.0, 0.0, 0.0, 0.0, 0.0]])
    t, vented, volume = pushes(formulation, 2.5, 0.0, -3.5, lowered, MOUTH, vent(1.0), initial=1.03 * A)
    _, free, same = pushes(formulation, 2.5, 0.0, -3.5, lowered, MOUTH, air="free", initial=2.2 * A)
    late = (t > 1.0) & (t < 2.4)
    flow = np.gradient(volume, t)[late]
    pressure = 0.5 * AIR_DENSITY * (flow / (C_D * 1.0)) ** 2
    assert flow == pytest.approx(3.0 * A * np.ones(late.sum()), rel=0.05)
    assert (vented - free)[late] == pytest.approx(pressure * (A - 1.0), rel=0.02)
    assert np.all(same[late] > volume[late])


def isothermal(depth: Any) -> Any:
    """m of water in a bucket of one atmosphere of air whose mouth is at a depth."""
    height = ATMOSPHERE / (RHO * G)  # (depth - x) (H - x) = height x
    b = depth + H + height
    return 0.5 * (b - np.sqrt(b * b - 4.0 * depth * H))


@LEANS
def test_air_that_is_shut_in_is_compressed_as_its_law_says(formulation: str, lean: float) -> None:
    """Lowered from air; upright to a mouth 26 m deep."""
    down = Curve.quintic(start_time=0.0, end_time=60.0, start=0.0, end=-27.0)
    t, force, volume = pushes(formulation, 62.0, lean, 1.0, down, MOUTH, **SHUT)
    depth = np.clip(-(1.0 + down.evaluate(t)[:, 0] * np.cos(lean)), 0.0, None)
    if lean == 0.0:
        assert volume / A == pytest.approx(isothermal(depth), abs=6e-3)
    assert force == pytest.approx(-RHO * G * np.cos(lean) * volume, abs=6e3)


def test_air_of_the_pressure_outside_keeps_the_water_out() -> None:
    pressure, exponent = ATMOSPHERE + 10.0 * RHO * G, 1.4
    given: dict[str, Any] = {"air": "shut", "exponent": exponent, "air_pressure": pressure}
    scene = bucket(0.0, -10.0, Curve.constant(value=0.0), MOUTH, **given)
    result = simulate(scene, 20.0, dt_out=1.0)
    held = A * H * (pressure / ATMOSPHERE) ** (1.0 / exponent)
    assert result.select("load_state", state_name="water.air") == pytest.approx(held, rel=1e-6)
    assert np.abs(result.select("load_state", state_name="water.volume")).max() < 1e-3 * A


def test_a_column_hangs_under_a_shut_lid_as_high_as_air_carries_it_and_falls(formulation: str) -> None:
    """Full, its hatch shut, pulled out of the sea on a wire."""
    scene = Scene(name="recovered", gravity=G)
    scene.add_body("anchor", mass=MASS, size=(D, D, H), position=(0.0, 0.0, -8.0))
    scene.add_line(
        "hoist", first="ground", second="anchor", first_point=(0, 0, 60), second_point=(0, 0, H / 2), EA=5e8,
        tension_at_start=MASS * G, damping_ratio=0.3,
    )  # fmt: skip
    scene.add_winch("hoist", rate=Curve.quintic(start_time=2.0, end_time=4.0, start=0.0, end=-0.25), lag=0.1)
    shell = CylinderPart(length=H, diameter=D, axes=UPRIGHT, strips=1, end_drag=0.0)
    bottom: dict[str, Any] = {"point": (0, 0, -H / 2), "area": A}
    water = Compartment(**bottom, height=H, openings=[bottom], initial=A * H, name="water", **SHUT)
    scene.add_immersed("anchor", parts=[shell], inside=water, density=RHO)
    result = simulate(scene, 80.0, dt_out=0.05, start="rest", formulation=formulation)
    pull = result.select("line_tension", line="hoist")
    z = result.select("position", body="anchor", axis="z")
    column = (ATMOSPHERE - VAPOUR) / (RHO * G)
    top, mouth = z + H / 2, z - H / 2
    hangs = (top > 2.0) & (mouth < -0.1)
    expected = MASS * G + RHO * G * A * np.minimum(top, column)
    assert pull[hangs] == pytest.approx(expected[hangs], rel=3e-3)
    out = mouth > 0.5
    assert pull[out][-100:] == pytest.approx(MASS * G * np.ones(100), rel=1e-2)
    assert result.select("load_state", state_name="water.volume")[-1] == pytest.approx(0.0, abs=1e-2)
    assert result.select("load_state", state_name="water.air")[-1] == pytest.approx(A * H, rel=1e-3)
    assert np.max(np.abs(result["energy_balance"])) < 1e-4 * np.max(result["absolute_work"])


@pytest.mark.parametrize(
    ("openings", "given", "message"),
    [([MOUTH], {}, "no opening is in its lid"), ([MOUTH], {"air": "shut"}, "exponent is 0, and air is shut"),
     ([MOUTH], {"air": "free", "exponent": 1.2}, "exponent is 1.2, and air is free"),
     ([MOUTH, MOUTH], {"air": "free"}, "openings in its bottom take 2")],
)  # fmt: skip
def test_what_geometry_does_not_tell_is_asked_for(openings: Any, given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        bucket(0.0, 0.0, heaving(), *openings, **given).compile()


@pytest.mark.parametrize("part", [{"fill": MASS / 7850.0 / 128.0, "point": (0, 0, 4)}, {"point": (6, 0, 4)}])
def test_a_compartment_outside_its_parts_is_refused(part: dict[str, Any]) -> None:
    """Of steel alone, and beside them."""
    scene = Scene(name="outside", gravity=G)
    scene.add_body("anchor", mass=MASS, size=(4, 4, 8))
    inside = Compartment(area=12.0, height=8.0, openings=[{"point": (0, 0, 8), "area": 1.0}])
    scene.add_immersed("anchor", parts=[BoxPart(size=(4, 4, 8), **part)], inside=inside)
    with pytest.raises(SceneError, match="'water in anchor' is outside the parts of 'anchor'"):
        scene.compile()
