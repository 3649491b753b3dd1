"""Water entry of a wedge and of a cylinder: the equation's own solutions, and the coefficients they rest on.

The printed solutions are of an integration of the equation of docs/water.md that shares no code with ours.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from seacrane import _core
from seacrane.arrays import Array
from seacrane.hydro import circle_added_mass

WEDGE = {  # m/s at the times of the set
    "table with pile-up": [4.70, 3.95, 3.28, 2.77, 2.40, 2.12, 1.73],
    "table of the plate as broad as the level water": [4.87, 4.37, 3.81, 3.33, 2.93, 2.61, 2.15],
}


@pytest.fixture
def wedge(modules: Any) -> Any:
    return modules("measured.yettou_wedge")


@pytest.mark.warns("UnitWarning")
@pytest.mark.parametrize("by", WEDGE)
def test_the_wedge_slows_down_as_the_printed_solution(by: str, wedge: Any) -> None:
    found = wedge.speeds(wedge.TIME, wedge.factors()[by])
    assert found == pytest.approx(WEDGE[by], rel=0.01)


def test_the_added_mass_of_a_wedge_alone_is_that_of_the_strip_theory(wedge: Any) -> None:
    """Its closed form beside sources on the section, without waves; a square on its corner has 1.1887."""
    height = 1.0 / np.tan(wedge.DEADRISE)
    points = np.column_stack([np.linspace(height, 0.0, 61), np.linspace(0.0, -1.0, 61)])
    told = _core.section_radiation(points=points, omega=[1.0], rho=1.0, panels=120)
    expected = wedge.factors()["table of the wedge alone, as a panel code has it"]
    assert told["infinite_added_mass"][1, 1] / height**2 == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("words", ["half as heavy as water", "as heavy as water"])
def test_drag_of_a_cylinder_grows_with_the_volume_that_is_wet(words: str, modules: Any) -> None:
    """The same equation by another integrator, with its own table of added mass."""
    cylinder = modules("measured.greenhow_lin_cylinder")
    share, drag, d = cylinder.SHARES[words], cylinder.DRAG[words], cylinder.DIAMETER
    area = np.pi / 4.0 * d**2
    mass = share * cylinder.RHO * area

    def added(h: float) -> float:
        return float(cylinder.RHO * d**2 / 4.0 * circle_added_mass([2.0 * h / d])[0])

    def rates(_: float, y: Array) -> list[float]:
        h, v = max(y[0], 0.0), y[1]
        angle = 2.0 * np.arccos(np.clip(1.0 - 2.0 * h / d, -1.0, 1.0))
        wet = d**2 / 8.0 * (angle - np.sin(angle))
        step = 1e-6 * d
        gain = (added(h + step) - added(max(h - step, 0.0))) / (h + step - max(h - step, 0.0))
        force = (mass - cylinder.RHO * wet) * cylinder.G
        force -= gain * v * v + 0.5 * cylinder.RHO * drag * d * wet / area * v * abs(v)
        return [v, force / (mass + added(h))]

    times = cylinder.DEPTHS[words][:, 0]
    found = cylinder.dropped(times, share, drag=drag, slam=np.pi)
    span = (0.0, float(times[-1] * cylinder.UNIT))
    alone = solve_ivp(rates, span, [0.0, cylinder.SPEED], t_eval=times * cylinder.UNIT, rtol=1e-8, atol=1e-10)
    assert found == pytest.approx(alone.y[0] / d, rel=1e-4)
