"""Lines with mass that are paid out and hauled in: beside masses of fixed material, ledger, formulations."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from seacrane import Curve, Scene, SceneError, simulate
from seacrane.result import heavy_line_tension

Array = NDArray[np.float64]
G = 9.80665
MU, LOAD, EA, FIRST, LAST, ANGLE = 25.0, 2500.0, 2e6, 60.0, 84.0, 0.3
PAID = Curve.quintic(start_time=0.0, end_time=10.0, start=FIRST, end=LAST)


def length(t: float) -> tuple[float, float]:
    """Of the line, and its rate."""
    value, rate, _ = PAID.evaluate([t])[0]
    return float(value), float(rate)


def laid_out(count: int) -> Array:
    """Places of the ends of segments on a straight line at an angle, stretched as if it hung, (n, 2)."""
    step = FIRST / count
    pull = (LOAD + MU * (FIRST - (np.arange(count) + 0.5) * step)) * G * np.cos(ANGLE)
    along = np.cumsum(step * (1.0 + pull / EA))
    return along[:, None] * [np.sin(ANGLE), -np.cos(ANGLE)]


def material(count: int, times: Array) -> Array:
    """Where the load is, (n, 2), by masses that stay with their material: an independent formulation.

    The segment at the drum takes all that is paid out, and is cut when it is as long as two.
    """
    step = FIRST / count
    place, speed, t, out = laid_out(count), np.zeros((count, 2)), 0.0, []

    def rate(t: float, y: Array) -> Array:
        x, v = np.vstack([np.zeros((1, 2)), y[: y.size // 2].reshape(-1, 2)]), y[y.size // 2 :].reshape(-1, 2)
        whole, paid = length(t)
        own = np.full((len(v), 1), step)
        own[0] = whole - (len(v) - 1) * step
        reach = np.diff(x, axis=0)
        size = np.linalg.norm(reach, axis=1, keepdims=True)
        pull = EA * (size / own - 1.0) * reach / size
        mass = MU * own.copy()
        mass[:-1] = 0.5 * MU * (own[:-1] + own[1:])
        mass[-1] = LOAD + 0.5 * MU * own[-1]
        force = -pull - [0.0, G] * mass
        force[:-1] += pull[1:]
        fed = 0.5 * (v[0] + paid * reach[0] / own[0])  # the middle of the first segment gives its momentum
        force[0] += 0.5 * MU * paid * (fed - v[0])
        return np.concatenate([v.ravel(), (force / mass).ravel()])

    while len(out) < len(times):
        n = len(place)

        def full(t: float, y: Array, n: int = n) -> float:
            return length(t)[0] - (n + 1) * step

        full.terminal, full.direction = True, 1.0  # type: ignore[attr-defined]
        y = np.concatenate([place.ravel(), speed.ravel()])
        part = solve_ivp(rate, (t, times[-1]), y, dense_output=True, events=full, rtol=1e-8, atol=1e-9,
                         method="DOP853")  # fmt: skip
        t = part.t[-1]
        while len(out) < len(times) and times[len(out)] <= t:
            out.append(part.sol(times[len(out)])[2 * n - 2 : 2 * n])
        place, speed = (half.reshape(-1, 2) for half in np.split(part.y[:, -1], 2))
        middle = 0.5 * (speed[0] + length(t)[1] * place[0] / (2.0 * step))
        place, speed = np.vstack([0.5 * place[:1], place]), np.vstack([middle, speed])
    return np.array(out)


def paid_out(count: int, **given: Any) -> Scene:
    """The same line of the engine, its drum at the origin of the ground."""
    scene = Scene(name="paid out", gravity=G)
    ends = laid_out(count)
    scene.add_body(
        name="load", mass=LOAD, inertia=(LOAD,) * 3, position=(ends[-1, 0], 0.0, ends[-1, 1]),
    )  # fmt: skip
    line: dict[str, Any] = {"EA": EA, "length": PAID, "mass_per_length": MU, "damping_ratio": 0.0}
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0),
                   rung="with mass", segments=count, **line | given)  # fmt: skip
    for i, (x, z) in enumerate(ends[:-1], start=1):
        scene.bodies[f"wire.{i}"] = type(scene.bodies["load"])(
            **scene.bodies[f"wire.{i}"].__getstate__() | {"position": (x, 0.0, z)}
        )
    return scene


def test_a_line_that_is_paid_out_swings_as_one_of_masses_that_stay_with_their_material() -> None:
    """Both are of second order in the segments: so is their difference."""
    times = np.linspace(0.0, 12.0, 13)
    errors = []
    for count in (8, 16):
        result = simulate(paid_out(count), t_end=12.0, dt_out=1.0, channels=["position"], rtol=1e-8)
        load = np.asarray(result.select("position", body="load"))[:, [0, 2]]
        errors.append(np.abs(load - material(count, times)).max())
    assert errors[1] < 0.01
    assert 3.0 < errors[0] / errors[1] < 5.0


@pytest.mark.parametrize("direction", [1.0, -1.0], ids=["out", "in"])
def test_at_a_steady_rate_an_upright_line_carries_its_weight_as_at_rest(direction: float) -> None:
    first, last = (100.0, 220.0) if direction > 0.0 else (220.0, 100.0)
    scene = Scene(name="upright", gravity=G)
    tension = (4e3 + 0.5 * MU * first) * G
    scene.add_body(name="load", mass=4e3, inertia=(4e3,) * 3,
                   position=(0.0, 0.0, -first * (1.0 + tension / 1e9)))  # fmt: skip
    paid = Curve.quintic(start_time=0.0, end_time=120.0, start=first, end=last)
    scene.add_line("wire", "ground", "load", rung="with mass", EA=1e9, length=paid, mass_per_length=MU,
                   first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0), segments=6,
                   segment_rung="quasi-static")  # fmt: skip
    result = simulate(scene, t_end=120.0, dt_out=20.0, rtol=1e-6)
    here = paid.evaluate(np.asarray(result.time))
    upper, lower = heavy_line_tension(result, line="wire").T
    speeding = G - here[:, 2]  # the line moves down as one, by what is paid out
    assert lower == pytest.approx(4e3 * speeding, rel=2e-4)
    assert upper == pytest.approx((4e3 + MU * here[:, 0]) * speeding, rel=2e-4)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"length": Curve.table([0.0, 5.0], [60.0, 70.0])}, "length jumps at t = 0"),
        ({"diameter": 0.05}, "takes no length that changes; leave out its diameter"),
    ],
)
def test_what_cannot_be_wound_is_refused_by_name(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=message):
        paid_out(4, **given).compile()
