"""Lines with mass: weight, stretch, shape at rest and waves against closed forms."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from heavy_line_scenes import CATENARY_H, CATENARY_V, G, hanging, slung, string, weights_of_shape
from numpy.typing import NDArray

from seacrane import Scene, SceneError, natural_modes, simulate
from seacrane.result import heavy_line_tension


@pytest.mark.warns(sometimes=["LineLengthWarning"])
@pytest.mark.parametrize("count", [1, 8])
def test_a_hanging_wire_is_longer_by_half_its_weight_and_the_load_s(count: int, formulation: str) -> None:
    """w L^2 / (2 EA) is exact for lumped masses with halves at the ends, and so are both tensions."""
    result = simulate(hanging(count), t_end=1.0, formulation=formulation, rtol=1e-8)
    wire, load = 50.0 * G * 100.0, 1e3 * G
    place = result.select("position", body="load")
    assert place[0, 2] == pytest.approx(-100.0 - (0.5 * wire + load) * 100.0 / 1e6, rel=1e-12)
    assert np.ptp(place, axis=0) == pytest.approx([0.0, 0.0, 0.0], abs=1e-9)
    if count > 1:
        tension = heavy_line_tension(result, line="wire")
        assert tension == pytest.approx(np.tile([wire + load, load], (result.time.size, 1)), rel=1e-6)


def test_the_shape_at_rest_tends_to_the_elastic_catenary_with_second_order() -> None:
    errors = [np.subtract(weights_of_shape(n), (CATENARY_H, CATENARY_V)) for n in (20, 40, 80, 160)]
    orders = np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))
    assert orders == pytest.approx(np.full((3, 2), 2.0), abs=0.01)
    assert np.ptp(simulate(slung(12), t_end=2.0, rtol=1e-8)["position"], axis=0).max() < 1e-6
    assert np.abs(errors[-1]).max() < 2e-5 * CATENARY_H


def test_the_first_transverse_period_of_a_taut_string_converges_with_second_order() -> None:
    """2 L sqrt(m / T), its mass per stretched length 2 kg/m, T 10 kN."""
    omega = np.pi / 50.0 * np.sqrt(1e4 / 2.0)
    errors = []
    for count in (4, 8, 16):
        found = 2.0 * np.pi / natural_modes(string(count)).natural_period
        chain = 2.0 * np.sqrt(1e4 / 2.0) * count / 50.0 * np.sin(0.5 * np.pi / count)
        assert np.abs(found - chain).min() < 1e-6 * chain
        errors.append(omega - chain)
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([2.0, 2.0], abs=0.05)


def test_drag_slows_a_line_across_and_not_along() -> None:
    """A free fall in still air of a level line, and of an upright one."""
    for along, area in (((50.0, 0.0, 0.0), 0.1 * 50.0), ((0.0, 0.0, 50.0), 0.0)):
        scene = Scene(name="falling")
        for name, place in (("one", (0.0, 0.0, 0.0)), ("two", along)):
            scene.add_body(name=name, mass=100.0, inertia=(1.0, 1.0, 1.0), position=place)
        scene.add_line(name="line", bodies=["one", "two"], points=np.zeros((2, 3)), EA=1e6, length=50.0,
                       wire={"mass_per_length": 4.0, "segments": 1, "diameter": 0.1, "density": 1.2,
                       "drag_coefficient": 1.1})  # fmt: skip
        speed = simulate(scene, t_end=5.0, rtol=1e-8).select("velocity", body="one")[:, 2]
        final = np.sqrt(400.0 * G / (0.5 * 1.2 * 1.1 * area)) if area else 1e9
        assert speed[-1] == pytest.approx(-final * np.tanh(5.0 * G / final), rel=1e-6 if area else 1e-9)


def test_as_its_mass_falls_it_becomes_the_elastic_line_in_first_order() -> None:
    """A load that swings and bounces on 30 m of wire, undamped, with 5 % to 0.6 % of its mass in the wire."""

    def path(mass_per_length: float) -> NDArray[np.float64]:
        scene = Scene(name="thrown")
        start = (0.0, 0.0, -30.0 * (1.0 + 1e3 * G / 1e6))
        scene.add_body(name="load", mass=1e3, inertia=(1e3,) * 3, position=start, velocity=(1.0, 0.0, 0.5))
        heavy: dict[str, Any] = {"wire": {"mass_per_length": mass_per_length, "segments": 4}}
        scene.add_line(name="wire", first="ground", second="load", EA=1e6, length=30.0, damping_ratio=0.0,
                       **(heavy if mass_per_length else {"rung": "elastic"}))  # fmt: skip
        return simulate(scene, t_end=5.0, rtol=1e-9).select("position", body="load")

    elastic = path(0.0)
    errors = [np.abs(path(mass) - elastic).max() for mass in (1.6, 0.8, 0.4, 0.2)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([1.0] * 3, abs=0.03)


@pytest.mark.parametrize(
    ("given", "message"),
    [({"bodies": ["ground", "ground"]}, "both ends are on 'ground'"), ({"length": 20.0}, "no rest shape"),
     ({"points": [(0, 0, -5), (0, 0, 0)]}, "points are both at")],
)  # fmt: skip
def test_what_makes_no_line_is_refused_by_name(given: dict[str, Any], message: str) -> None:
    scene = Scene(name="refused")
    scene.add_body(name="load", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, -5.0))
    line: dict[str, Any] = {"bodies": ["ground", "load"], "points": np.zeros((2, 3)), "length": 5.0}
    with pytest.raises(SceneError, match=f"line 'wire': .*{message}"):
        scene.add_line("wire", EA=1e6, wire={"mass_per_length": 3.0, "segments": 4}, **line | given)
    assert list(scene.bodies) == ["load"]
