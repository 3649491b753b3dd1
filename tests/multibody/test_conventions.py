"""Signs that the pictures of docs/conventions.md show: what the engine does with each."""

from __future__ import annotations

import numpy as np
import pytest

from seacrane import Curve, Scene, cases, simulate
from seacrane.analysis import driven
from seacrane.crane import KnuckleBoomCrane, Payload
from seacrane.sea import WaveComponents

PUSHES = {
    "surge": ((0.0, 0.0, 0.0), (1e5, 0.0, 0.0)),
    "sway": ((0.0, 0.0, 0.0), (0.0, 1e5, 0.0)),  # to port
    "heave": ((0.0, 0.0, 0.0), (0.0, 0.0, 1e6)),
    "roll": ((0.0, 10.0, 0.0), (0.0, 0.0, 1e6)),  # the port side up
    "pitch": ((50.0, 0.0, 0.0), (0.0, 0.0, -1e6)),  # the bow down
    "yaw": ((50.0, 0.0, 0.0), (0.0, 1e5, 0.0)),  # the bow to port
}


@pytest.mark.parametrize("motion", PUSHES)
def test_a_push_moves_the_vessel_in_the_positive_sense(motion: str) -> None:
    scene = cases.vessel(hs=0.0)
    point, force = PUSHES[motion]
    scene.add_point_force(name="push", body="vessel", point=point, force=force)
    result = simulate(scene, t_end=2.0)
    assert result.select("vessel_motion", motion=motion)[-1] > 1e-5


@pytest.mark.parametrize("degrees", [0.0, 90.0, 225.0])
def test_a_wave_travels_to_its_direction(degrees: float) -> None:
    omega, direction = 0.8, np.radians(degrees)
    wave = WaveComponents(omega=[omega], amplitude=[1.0], phase=[0.3], direction=[direction])
    speed, times = 9.80665 / omega, np.linspace(0.0, 20.0, 9)
    x, y = speed * times * np.cos(direction), speed * times * np.sin(direction)
    along, against = wave.elevation(times, x=x, y=y), wave.elevation(times, x=-x, y=-y)
    np.testing.assert_allclose(along, np.cos(0.3), atol=1e-12)
    assert np.ptp(against) > 1.0


def test_slew_turns_to_port_when_negative() -> None:
    geometry = KnuckleBoomCrane.load().geometry
    x, y, _ = geometry.tip(slew=-np.pi / 2.0, s1=2.0, s2=2.0)
    assert y > 10.0 and abs(x) < 1e-9
    assert geometry.tip(slew=0.0, s1=2.0, s2=2.0)[0] < -10.0


@pytest.mark.parametrize(("cylinder", "joint", "angle"), [("main", "C", 0), ("knuckle", "F", 1)])
def test_extending_a_cylinder_raises_its_jib(cylinder: str, joint: str, angle: int) -> None:
    scene = Scene(name="crane")
    scene.add_crane(base="ground", s1=1.0, s2=1.0, payload=Payload())
    scene.record_coordinate(joint=joint, name="jib")
    for name, moved in {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}.items():
        scene.add_actuator(name=name, joint=moved)
    out = Curve.quintic(start_time=0.0, end_time=20.0, start=0.0, end=1.0)
    result = simulate(driven(scene, references={cylinder: out}), t_end=20.0)
    geometry = KnuckleBoomCrane.load().geometry
    strokes = ({"s1": 1.0, "s2": 1.0}, {"s1": 1.0 + (angle == 0), "s2": 1.0 + (angle == 1)})
    before, after = (geometry.jib_angles(**one)[angle] for one in strokes)
    assert after - before > 0.05
    assert result.select("coordinate[jib]")[-1] == pytest.approx(after - before, abs=1e-6)
    assert result.select("cylinder_force", cylinder="main").min() > 0.0, "it carries the jib: it pushes"
    assert result["link_tension"].min() > 0.0, "the payload hangs: the link pulls"
