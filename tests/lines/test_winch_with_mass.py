"""Lines with mass that are paid out: by a winch or a curve, beside masses of fixed material, stages."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from heavy_line_scenes import FIRST, LAG, PAID, asked, wet
from line_scenes import add_led
from scipy.integrate import solve_ivp

from seacrane import Curve, Move, Scene, SceneError, SimulationError, Stage, Until, simulate
from seacrane.analysis import equilibrium, natural_modes
from seacrane.arrays import Array
from seacrane.result import heavy_line_tension

G = 9.80665
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-9}


def hauled(length: Curve | float, *, rung: Any) -> Scene:
    """Taut, with a load that swings."""
    scene = Scene(name="hauled", gravity=G)
    scene.add_body(name="load", mass=4e3, inertia=(9e2, 8e2, 7e2), position=(1.0, 0.0, -FIRST))
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0),
                   EA=4e6, length=length, wire={"mass_per_length": 40.0, "segments": 4},
                   rung=rung)  # fmt: skip
    if not isinstance(length, Curve):
        scene.add_winch("wire", rate=asked(LAG), lag=LAG)
    return scene


@pytest.mark.warns(sometimes=["LineLengthWarning", "QuasiStaticLineWarning"])
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_winch_pays_out_as_a_curve_for_the_length_does(rung: Any) -> None:
    make: Any = wet if rung == "elastic" else hauled
    scenes = [make(length, rung=rung) for length in (PAID, FIRST)]
    one, other = (simulate(scene, t_end=6.0, dt_out=0.5, **EXACT) for scene in scenes)
    for channel, size in (("position", 10.0), ("line_tension", 1e4)):
        assert np.asarray(other[channel]) == pytest.approx(np.asarray(one[channel]), abs=2e-7 * size)


MU, HEAVY, STIFF, MASS, DEEP = 25.0, 20, 4e8, 110e3, 1000.0  # kg/m, segments, N, kg, m


def hung(heave: Curve, *, deep: float = DEEP, segments: int = HEAVY, **winch: Any) -> Scene:
    """A load on a long wire below a tip that heaves as told."""
    scene = Scene(name="hung", gravity=G)
    add_led(scene, "tip", heave)
    stretch = deep * (MASS + 0.5 * MU * deep) * G / STIFF
    scene.add_body(name="load", mass=MASS, inertia=(1e6, 1e6, 1e6), position=(0.0, 0.0, -deep - stretch))
    scene.add_line("wire", "tip", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0), EA=STIFF,
                   length=deep, wire={"mass_per_length": MU, "segments": segments})  # fmt: skip
    scene.add_winch("wire", **{"lag": LAG} | winch)
    return scene


def test_what_heave_compensation_leaves_runs_down_a_long_wire_as_in_a_bar() -> None:
    """Its upper end is driven by the heave less what the winch pays out, and the load rings on the bar."""
    period, lag, corner = 4.5, 0.1, 0.01  # s, s, Hz
    omega = 2.0 * np.pi / period
    scene = hung(Curve.harmonic(offset=0.1, amplitude=-0.1, omega=omega))
    scene.add_heave_compensation("active", body="tip", winch="wire", lag=lag, high_pass=corner)
    result = simulate(scene, t_end=220.0, dt_out=0.1, start=equilibrium(scene), rtol=1e-7)
    modes = natural_modes(scene)
    own = 2.0 * np.pi / float(modes.natural_period[modes.find("load heave")])
    bar = np.sqrt(STIFF / MU)  # m/s
    p, strain = 1j * omega, (MASS + MU * DEEP) * G / STIFF  # the strain of what leaves the drum
    left = 1.0 - (1.0 + strain) * p / (p + 2.0 * np.pi * corner) / (1.0 + lag * p) / (1.0 + LAG * p)
    phase, impedance = omega * DEEP / bar, np.sqrt(STIFF * MU)
    gain = left / (np.cos(phase) - omega * MASS / impedance * np.sin(phase))
    late = result.time > 80.0
    time, z = result.time[late], result.select("position", body="load", axis="z")[late]
    columns = [np.ones_like(time), np.exp(-2.0 * np.pi * corner * time)]
    for one in (omega, own):
        columns += [np.cos(one * time), np.sin(one * time)]
    found = np.linalg.lstsq(np.stack(columns, axis=1), z, rcond=None)[0]
    assert np.hypot(*found[2:4]) == pytest.approx(0.1 * abs(gain), rel=0.003)


def test_stages_command_it_and_wait_for_it() -> None:
    """A joint that is connected on the way describes the scene anew where it is, with what is paid out."""
    scene = hung(Curve.constant(value=0.0), deep=40.0, segments=4)
    for name, place in (("tag", 0.0), ("other", 1.0)):
        scene.add_body(name=name, mass=10.0, inertia=(1, 1, 1), position=(50.0, place, 0.0), gravity=False)
    scene.add_joint("pin", kind="spherical", first="tag", second="other", point=(50.0, 0.0, 0.0))
    out = Stage(name="down", until=Until.channel("wire_paid_out", winch="wire", minimum=60.0),
                maximum_duration=60.0, commands={"wire.rate": 3.0})  # fmt: skip
    runs, channels = [], ["position", "load_state", "line_tension"]
    for connect in ([], ["pin"]):
        slow = {"wire.rate": Move(to=0.0, over=4.0)}
        stop = Stage(name="stop", duration=8.0, commands=slow, connect=connect)
        runs.append(simulate(scene, [out, stop], dt_out=0.5, channels=channels))
    one, other = (np.asarray(result.select("position", body="load", axis="z")) for result in runs)
    assert other == pytest.approx(one, abs=1e-4)
    length = runs[1].select("load_state", state_name="wire.length")[-1]
    upper = heavy_line_tension(runs[1], line="wire")[-1, 0]
    assert length > 100.0 and upper == pytest.approx((MASS + MU * length) * G, rel=0.02)


def test_what_does_not_fit_is_refused_by_name() -> None:
    rest = Curve.constant(value=0.0)
    lost = hung(rest, deep=40.0, segments=4)
    lost.replace("wire.3 winding", kind="load", paid_out_by="rope")
    for scene, message in (
        (hung(rest, deep=40.0, segments=4, lag=0.0), "line 'wire.1': .*its winch has no lag"),
        (lost, "paid out by 'rope'"),
        (paid_out(4, length=Curve.table([0.0, 5.0], [60.0, 70.0])), "length jumps at t = 0"),
    ):
        with pytest.raises(SceneError, match=message):
            scene.compile()
    with pytest.raises(SimulationError, match="hauled in to its minimum_length"):
        simulate(hung(rest, deep=12.0, segments=3, rate=-1.0, minimum_length=8.0), t_end=20.0)
    with pytest.raises(SceneError, match="takes no length that changes"):
        paid_out(4, diameter=0.05)
    scene = wet(PAID)
    with pytest.raises(SceneError, match="line 'wire': has a Curve for its length"):
        scene.add_winch("wire", lag=LAG)
    assert not scene.loads["wire.1"].winch


LOAD, SOFT, SHORT, LONG, ANGLE = 2500.0, 2e6, 60.0, 84.0, 0.3
WOUND = Curve.quintic(start_time=0.0, end_time=10.0, start=SHORT, end=LONG)


def wound_length(t: float) -> tuple[float, float]:
    """Of the line, and its rate."""
    value, rate, _ = WOUND.evaluate([t])[0]
    return float(value), float(rate)


def laid_out(count: int) -> Array:
    """Places of the ends of segments on a straight line at an angle, stretched as if it hung, (n, 2)."""
    step = SHORT / count
    pull = (LOAD + MU * (SHORT - (np.arange(count) + 0.5) * step)) * G * np.cos(ANGLE)
    along = np.cumsum(step * (1.0 + pull / SOFT))
    return along[:, None] * [np.sin(ANGLE), -np.cos(ANGLE)]


def material(count: int, times: Array) -> Array:
    """Where the load is, (n, 2), by masses that stay with their material: an independent formulation.

    The segment at the drum takes all that is paid out, and is cut when it is as long as two.
    """
    step = SHORT / count
    place, speed, t, out = laid_out(count), np.zeros((count, 2)), 0.0, []

    def rate(t: float, y: Array) -> Array:
        x, v = np.vstack([np.zeros((1, 2)), y[: y.size // 2].reshape(-1, 2)]), y[y.size // 2 :].reshape(-1, 2)
        whole, paid = wound_length(t)
        own = np.full((len(v), 1), step)
        own[0] = whole - (len(v) - 1) * step
        reach = np.diff(x, axis=0)
        size = np.linalg.norm(reach, axis=1, keepdims=True)
        pull = SOFT * (size / own - 1.0) * reach / size
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
            return wound_length(t)[0] - (n + 1) * step

        full.terminal, full.direction = True, 1.0  # type: ignore[attr-defined]
        y = np.concatenate([place.ravel(), speed.ravel()])
        how: dict[str, Any] = {"rtol": 1e-8, "atol": 1e-9, "method": "DOP853", "dense_output": True}
        part = solve_ivp(rate, (t, times[-1]), y, events=full, **how)
        t = part.t[-1]
        while len(out) < len(times) and times[len(out)] <= t:
            out.append(part.sol(times[len(out)])[2 * n - 2 : 2 * n])
        place, speed = (half.reshape(-1, 2) for half in np.split(part.y[:, -1], 2))
        middle = 0.5 * (speed[0] + wound_length(t)[1] * place[0] / (2.0 * step))
        place, speed = np.vstack([0.5 * place[:1], place]), np.vstack([middle, speed])
    return np.array(out)


def paid_out(count: int, **given: Any) -> Scene:
    """The same line of the engine, its drum at the origin of the ground."""
    scene = Scene(name="paid out", gravity=G)
    ends = laid_out(count)
    scene.add_body(name="load", mass=LOAD, inertia=(LOAD,) * 3, position=(ends[-1, 0], 0.0, ends[-1, 1]))
    line: dict[str, Any] = {"EA": SOFT, "length": given.pop("length", WOUND), "damping_ratio": 0.0}
    scene.add_line("wire", "ground", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0),
                   wire={"mass_per_length": MU, "segments": count} | given, **line)  # fmt: skip
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
    scene.add_line("wire", "ground", "load", EA=1e9, length=paid, wire={"mass_per_length": MU, "segments": 6},
                   first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0),
                   rung="quasi-static")  # fmt: skip
    result = simulate(scene, t_end=120.0, dt_out=20.0, rtol=1e-6)
    here = paid.evaluate(np.asarray(result.time))
    upper, lower = heavy_line_tension(result, line="wire").T
    speeding = G - here[:, 2]  # the line moves down as one, by what is paid out
    assert lower == pytest.approx(4e3 * speeding, rel=2e-4)
    assert upper == pytest.approx((4e3 + MU * here[:, 0]) * speeding, rel=2e-4)
