"""Lines towards the rigid rung, elastic and quasi-static: snatches, closed forms, what they must conserve."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, below, hung, settled, taut
from multibody_runs import momentum, record
from numpy.testing import assert_allclose

from seacrane import Curve, Scene, SceneError, SimulationError, cases, simulate


def pendulum(stiffness: float | None, **rung: Any) -> Scene:
    """2 t on 8 m, let go at 1 rad; the line is as long under its tension there as the rigid link."""
    place = 8.0 * np.array([np.sin(1.0), 0.0, -np.cos(1.0)])
    if stiffness is not None:
        length = 8.0 / (1.0 + 2e3 * G * np.cos(1.0) / stiffness)
        return below(place, mass=2e3, EA=stiffness, length=length, damping_ratio=0.3, **rung)
    return on_link(below(place, mass=2e3), second_point=place)


def on_link(scene: Scene, **given: Any) -> Scene:
    scene.add_joint(kind="distance", name="rope", first="ground", second="load", point=(0, 0, 0), **given)
    return scene


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_motion_and_tension_tend_to_the_rigid_link_as_one_over_ea(rung: str, formulation: str) -> None:
    settings: dict[str, Any] = {"dt_out": 0.1, "rtol": 1e-9, "formulation": formulation}
    rigid = record(pendulum(None), 6.0, **settings)
    moved, pulled = [], []
    stiffnesses = np.array([1e7, 1e8, 1e9])
    for stiffness in stiffnesses:
        out = record(pendulum(float(stiffness), rung=rung), 6.0, **settings)
        moved.append(np.abs(out["position"] - rigid["position"]).max())
        pulled.append(np.abs(out["line_tension"][10:, 0] - rigid["tension"][10:, 0]).max())
    for errors in (moved, pulled):
        slopes = np.diff(np.log(errors)) / np.diff(np.log(stiffnesses))
        assert slopes == pytest.approx(-1.0, abs=0.05)
    assert pulled[-1] < 1e-4 * np.abs(rigid["tension"]).max()


def falling(speed: float, *, stiffness: float | None, ratio: float = 0.02, along: float = 0.0) -> Scene:
    """20 t that meets the end of its slack 10 m at a speed, downwards; sideways it goes at another."""
    place, velocity = (0.0, 0.0, -9.98), (along, 0.0, -np.sqrt(speed**2 - 2.0 * G * 0.02))
    if stiffness is not None:
        return below(place, velocity=velocity, EA=10.0 * stiffness, length=10.0, damping_ratio=ratio)
    scene = on_link(below(place, velocity=velocity), second_point=place, length=10.0)
    scene.add_line(joint="rope", rung="rigid", restitution=np.exp(-np.pi * ratio / np.sqrt(1.0 - ratio**2)))
    return scene


@pytest.mark.warns("UnitWarning")
@pytest.mark.parametrize("along", [0.0, 0.5])
def test_a_snatch_is_the_impact_of_the_rigid_wire(along: float, formulation: str) -> None:
    """Impulse and speeds to 1 %: the wire's restitution is exp(-pi z / sqrt(1 - z^2)), 0.94 at 2 %."""
    settings: dict[str, Any] = {"dt_out": 2e-5, "rtol": 1e-9, "formulation": formulation}
    line = record(falling(3.0, stiffness=3e10, along=along), 0.02, **settings)
    wire = record(falling(3.0, stiffness=None, along=along), 0.02, **settings)
    assert wire["velocity"][:, 0, 2].min() == pytest.approx(-3.0, rel=1e-3)
    impulse = np.trapezoid(line["line_tension"][:, 0], line["time"])
    change = MASS * (wire["velocity"][-1, 0, 2] - wire["velocity"][0, 0, 2] + G * 0.02)
    assert impulse == pytest.approx(change, rel=0.01)
    assert change == pytest.approx(1.94 * 3.0 * MASS, rel=0.01)
    for axis in (0, 2):
        expected = wire["velocity"][-1, 0, axis]
        assert line["velocity"][-1, 0, axis] == pytest.approx(expected, rel=0.01, abs=1e-9)
    left = wire["absolute_work"][-1], line["absolute_work"][-1]  # J, what wire and damping took
    assert left[0] == pytest.approx(0.5 * MASS * 9.0 * (1.0 - np.exp(-0.04 * np.pi)), rel=0.01)
    assert left[1] == pytest.approx(left[0], rel=0.05)


@pytest.mark.parametrize(("speed", "stiffness"), [(1.0, 3e6), (2.0, 3e8)])
def test_the_peak_of_a_snatch_grows_as_v_root_km(speed: float, stiffness: float) -> None:
    """m g + sqrt((m g)^2 + k m v^2), never the impact of the rigid wire, which has no peak."""
    half = np.pi / np.sqrt(stiffness / MASS)
    scene, end = falling(speed, stiffness=stiffness, ratio=0.0), 0.02 / speed + 1.5 * half
    peak = float(record(scene, end, dt_out=half / 400, rtol=1e-9)["line_tension"].max())
    weight = MASS * G
    assert peak == pytest.approx(weight + np.sqrt(weight**2 + stiffness * MASS * speed**2), rel=2e-5)


def flying(rung: str) -> Scene:
    """Three bodies without weight, one line over all of them; it is taut, and its ends fly apart."""
    scene = Scene(name="flying", gravity=0.0)
    places = {"first": (0.0, 0.0, 0.0), "block": (4.0, 0.0, 1.0), "last": (8.0, 1.0, 0.0)}
    for i, (name, place) in enumerate(places.items()):
        scene.add_body(name=name, mass=1e3 * (i + 1), inertia=(400.0, 500.0, 600.0), position=place,
                       velocity=(0.0, 0.3 * i, -0.2), angular_velocity=(0.1, -0.2 * i, 0.05))  # fmt: skip
    length = 2.0 * np.sqrt(17.0) + (np.sqrt(18.0) - np.sqrt(17.0))
    scene.add_line(
        name="rope", bodies=["first", "block", "last"], points=[(0.1, 0, 0), (0, 0.2, 0), (0, 0, 0.1)],
        EA=2e6, length=0.95 * length, rung=rung,
    )  # fmt: skip
    return scene


@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_line_keeps_momentum(rung: str, formulation: str) -> None:
    """Linear and angular, of three bodies in free flight, taut, slack and snatching."""
    scene, quasi = flying(rung), rung == "quasi-static"
    if quasi:
        scene.replace("rope", settling=0.3)
        for name in scene.bodies:
            scene.replace(name, angular_velocity=(0.0, 0.0, 0.0), velocity=(0.1, 0.0, 0.0))
    out = record(scene, 0.3 if quasi else 3.0, rtol=1e-10, formulation=formulation)
    assert quasi or np.min(out["line_tension"]) == 0.0
    assert quasi or np.max(out["line_tension"]) > 1e3
    size = np.abs(out["velocity"]).max() * 1e3
    for kept in momentum(scene, out):
        assert np.abs(kept - kept[0]).max() < 1e-7 * size


@pytest.mark.parametrize(("omega", "settling"), [(2.0, 0.2), (1.5, 0.1)])
def test_a_driven_load_follows_the_closed_form(omega: float, settling: float) -> None:
    """Strain and tension over cos(omega t) of a load whose line pays out and in, once the start has decayed:
    T = EA (e + s (e' - w) + s^2 e''), w' = (e' - w) / s."""
    scene, amplitude = hung(), 1e-4
    length = Curve.harmonic(start_time=0.0, offset=10.0, amplitude=amplitude, omega=omega)
    scene.replace("hoist", length=length, rung="quasi-static", settling=settling)
    begin, period = 150.0 * settling, 2.0 * np.pi / omega
    out = record(scene, begin + 4.0 * period, dt_out=period / 16, rtol=1e-9)
    late = out["time"] > begin
    t = out["time"][late]
    wave = np.stack([np.ones_like(t), np.cos(omega * t), -np.sin(omega * t)], axis=1)
    stretched = out["line_stretch"][late, 0] / out["line_unstretched_length"][late, 0]
    p, s, strain = 1j * omega, settling, MASS * G / (STIFFNESS * 10.0)
    follows = 1.0 + (s * p) ** 2 * (2.0 + s * p) / (1.0 + s * p)  # T / (EA e)
    moved = (1.0 + strain) * amplitude / (1.0 + p**2 * MASS / STIFFNESS / follows)
    expected = (moved - (1.0 + strain) * amplitude) / 10.0, -MASS * p**2 * moved
    for values, one in zip((stretched, out["line_tension"][late, 0]), expected, strict=True):
        found = np.linalg.lstsq(wave, values, rcond=None)[0]
        assert abs(complex(found[1], found[2]) - one) < 2e-4 * abs(one)


@pytest.mark.warns("QuasiStaticLineWarning")
def test_a_closed_loop_of_rows_beside_it() -> None:
    """Jacobians and steps where joints close a loop in the recursive form as well: three methods agree."""
    scene = taut()
    scene.add_joint(kind="distance", name="stay", first="ground", second="load", point=(4.2, 3.0, -5.0),
                    second_point=(4.2, 0.1, -5.0))  # fmt: skip
    ways = (("dopri5", "redundant", 1e-9), ("dopri5", "recursive", 1e-9), ("rosenbrock", "recursive", 1e-6))
    runs = [
        record(scene, 2.0, rtol=rtol, integrator=method, formulation=form)["position"]
        for method, form, rtol in ways
    ]
    assert_allclose(runs[1], runs[0], atol=1e-6)
    assert_allclose(runs[2], runs[0], atol=1e-3)


def test_a_line_that_goes_slack_or_stops_ends_the_run_by_name() -> None:
    thrown = settled(hung())
    thrown.replace("load", velocity=(0.0, 0.0, 2.0))
    hauled = hung(length=3.0)
    hauled.add_winch(line="hoist", rate=-0.5, lag=0.2, minimum_length=2.5)
    for scene, words in (
        (thrown, "quasi-static, and it goes slack"), (settled(hung(stretch=-0.1)), "goes slack"),
        (settled(hauled), "hauled in to its minimum_length"),
    ):  # fmt: skip
        with pytest.raises(SimulationError, match=f"line 'hoist'.*{words}"):
            simulate(scene, 3.0)


def test_what_it_cannot_do_is_told() -> None:
    stopped, paper = taut(), cases.case2(kinematics="paper")
    stopped.add_body(name="float", mass=1.0, inertia=(1, 1, 1), position=(0, 0, -20))
    stopped.add_joint(kind="prismatic", name="rail", first="ground", second="float", point=(0, 0, -20))
    stopped.add_stop(name="stop", joint="rail", minimum=-1.0)
    tugger = {"points": [(60, 0, 20), (0, 0, 0)], "EA": 1e8, "length": 60.0, "rung": "quasi-static"}
    paper.add_line(name="tugger", bodies=["ground", "payload"], **tugger)
    for scene, words in ((stopped, "limit 'stop' makes impacts"), (paper, "kinematics 'paper'")):
        with pytest.raises(SceneError, match=words):
            scene.compile()
