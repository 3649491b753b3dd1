"""Lines with mass on a winch: beside a curve for their length, heave compensation, ledger, stages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from heavy_line_scenes import in_waves
from numpy.typing import NDArray
from test_jacobian import largest_error, moving

from seacrane import (
    Curve,
    Move,
    Scene,
    SceneError,
    SimulationError,
    Stage,
    Until,
    equilibrium,
    natural_modes,
    shipped_database,
    simulate,
    simulate_stages,
)
from seacrane.result import heavy_line_tension
from seacrane.run import Run

Array = NDArray[np.float64]
G = 9.80665
EXACT: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-9}
FORMS = ("recursive", "redundant")
LAG, FIRST, LAST, OVER = 0.2, 10.5, 14.0, 4.0  # s, m, m, s
PAID = Curve.quintic(start_time=0.0, end_time=OVER, start=FIRST, end=LAST)
KINDS: dict[str, dict[str, Any]] = {
    "by rate": {},
    "holds a tension": {"tension": 4e3, "tension_gain": 1e-4},
    "with a drum": {
        "drum_inertia": 300.0, "drum_radius": 0.5, "maximum_tension": 2e4, "brake_capacity": 1e4,
        "brake": Curve.quintic(start_time=0.5, end_time=1.5, start=0.0, end=0.4),
    },
}  # fmt: skip


def asked(lag: float) -> Curve:
    """The rate that a winch with a lag is asked for to pay out as PAID does: r + lag r'."""
    quintic = np.polynomial.Polynomial(PAID.to_pieces()["coefficients"][0])
    rate = quintic.deriv(1) + lag * quintic.deriv(2)
    whole = np.zeros(6)
    whole[: rate.coef.size] = rate.coef
    return Curve.pieces(starts=[0.0, OVER], coefficients=[whole, np.zeros(6)])


def wet(
    length: Curve | float = FIRST, *, rung: Any = "elastic", compensated: bool = False, **winch: Any
) -> Scene:
    """On a winch, but with a curve for its length."""
    scene = in_waves(length, rung=rung)
    if not isinstance(length, Curve):
        scene.add_winch("wire", **{"rate": asked(LAG), "lag": LAG} | winch)
    if compensated:
        scene.add_heave_compensation("active", body="load", winch="wire", gain=0.3, lag=0.3, high_pass=0.05)
    return scene


def hauled(length: Curve | float, *, rung: Any) -> Scene:
    """Taut, with a load that swings."""
    scene = Scene(name="hauled", gravity=G)
    scene.add_body(name="load", mass=4e3, inertia=(9e2, 8e2, 7e2), position=(1.0, 0.0, -FIRST))
    scene.add_line(
        "wire", "ground", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0), EA=4e6,
        length=length, mass_per_length=40.0, rung="with mass", segments=4, segment_rung=rung,
    )  # fmt: skip
    if not isinstance(length, Curve):
        scene.add_winch("wire", rate=asked(LAG), lag=LAG)
    return scene


@pytest.mark.warns(sometimes=["LineLengthWarning", "QuasiStaticLineWarning"])
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_a_winch_pays_out_as_a_curve_for_the_length_does(rung: Any) -> None:
    make: Callable[..., Scene] = wet if rung == "elastic" else hauled
    one, other = (
        simulate(make(length, rung=rung), t_end=6.0, dt_out=0.5, **EXACT) for length in (PAID, FIRST)
    )
    for channel, size in (("position", 10.0), ("line_tension", 1e4)):
        assert np.asarray(other[channel]) == pytest.approx(np.asarray(one[channel]), abs=2e-7 * size)


@pytest.mark.parametrize("kind", KINDS)
def test_both_formulations_agree_and_the_ledger_closes(kind: str) -> None:
    channels = ["position", "energy_balance", "absolute_work", "load_state"]
    scene = wet(compensated=True, **KINDS[kind])
    one, other = (
        simulate(scene, t_end=2.0, dt_out=0.1, channels=channels, formulation=form, **EXACT) for form in FORMS
    )
    assert np.asarray(one["position"]) == pytest.approx(np.asarray(other["position"]), abs=1e-7)
    paid_out = one.select("load_state", state_name="wire.length")
    assert np.ptp(paid_out) > 0.2
    for result in (one, other):
        assert np.max(np.abs(result["energy_balance"])) < 1e-7 * np.max(result["absolute_work"])


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("rung", ["elastic", "quasi-static"])
def test_the_exact_jacobian_is_that_of_differences(kind: str, rung: Any) -> None:
    if rung == "quasi-static" and kind == "with a drum":
        pytest.skip("refused")
    model = wet(rung=rung, compensated=True, **KINDS[kind]).compile()
    assert largest_error(model, 0.7, moving(model, 4), step=3e-4, kinks=True) < 1e-6


@pytest.mark.parametrize("formulation", FORMS)
def test_a_run_continues_bit_for_bit(formulation: str) -> None:
    given: dict[str, Any] = {"formulation": formulation, "integrator": "dopri5", "dt_out": 0.1}
    whole = Run(wet(compensated=True), 1.0, **given)
    whole.advance(0.47)
    rest = Run(wet(compensated=True), 1.0, start=whole.state, outputs_from=0.0, **given)
    for one in (whole, rest):
        one.advance(1.0)
    assert np.array_equal(whole.state.values, rest.state.values)


MU, HEAVY, STIFF, MASS, DEEP = 25.0, 20, 4e8, 110e3, 1000.0  # kg/m, segments, N, kg, m


def hung(heave: Curve, *, deep: float = DEEP, segments: int = HEAVY, **winch: Any) -> Scene:
    """A load on a long wire below a tip that heaves as told."""
    scene = Scene(name="hung", gravity=G)
    scene.add_body(name="tip", mass=1e3, inertia=(1e3, 1e3, 1e3), position=(0.0, 0.0, 0.0))
    scene.add_joint(
        "guide", kind="prismatic", first="ground", second="tip", point=(0.0, 0.0, 0.0), axis=(0, 0, 1)
    )
    scene.add_driver(joint="guide", name="heave", curve=heave)
    stretch = deep * (MASS + 0.5 * MU * deep) * G / STIFF
    scene.add_body(name="load", mass=MASS, inertia=(1e6, 1e6, 1e6), position=(0.0, 0.0, -deep - stretch))
    scene.add_line(
        "wire", "tip", "load", first_point=(0.0, 0.0, 0.0), second_point=(0.0, 0.0, 0.0), EA=STIFF,
        length=deep, mass_per_length=MU, rung="with mass", segments=segments,
    )  # fmt: skip
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
    p = 1j * omega
    strain = (MASS + MU * DEEP) * G / STIFF  # of what leaves the drum
    left = 1.0 - (1.0 + strain) * p / (p + 2.0 * np.pi * corner) / (1.0 + lag * p) / (1.0 + LAG * p)
    phase, impedance = omega * DEEP / bar, np.sqrt(STIFF * MU)
    gain = left / (np.cos(phase) - omega * MASS / impedance * np.sin(phase))
    late = result.time > 80.0
    time = result.time[late]
    columns = [np.ones_like(time), np.exp(-2.0 * np.pi * corner * time)]
    for one in (omega, own):
        columns += [np.cos(one * time), np.sin(one * time)]
    found = np.linalg.lstsq(
        np.stack(columns, axis=1), result.select("position", body="load", axis="z")[late], rcond=None
    )[0]
    assert np.hypot(*found[2:4]) == pytest.approx(0.1 * abs(gain), rel=0.003)


@pytest.mark.warns("StiffWarning")
def test_what_it_pays_out_carries_its_weight_at_a_steady_rate() -> None:
    """From 12 m to 600 m."""
    rate = Curve.quintic(start_time=0.0, end_time=20.0, start=0.0, end=5.0)
    scene = hung(Curve.constant(value=0.0), deep=12.0, segments=6, rate=rate)
    channels = ["load_state", "line_tension", "wire_paid_out"]
    result = simulate(scene, t_end=120.0, dt_out=5.0, channels=channels)
    length = result.select("load_state", state_name="wire.length")
    upper, lower = heavy_line_tension(result, line="wire").T
    steady = result.time > 40.0
    assert length[-1] > 500.0
    assert lower[steady] == pytest.approx(MASS * G, rel=2e-3)
    assert upper[steady] == pytest.approx((MASS + MU * length[steady]) * G, rel=2e-3)
    assert result.select("wire_paid_out", winch="wire")[-1] == pytest.approx(length[-1] - 12.0)


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
        stop = Stage(
            name="stop", duration=8.0, commands={"wire.rate": Move(to=0.0, over=4.0)}, connect=connect
        )
        runs.append(simulate_stages(scene, [out, stop], dt_out=0.5, channels=channels))
    for result in runs:
        assert result.select("load_state", state_name="wire.length")[-1] > 100.0
    one, other = (np.asarray(result.select("position", body="load", axis="z")) for result in runs)
    assert other == pytest.approx(one, abs=1e-4)
    length = runs[1].select("load_state", state_name="wire.length")[-1]
    assert heavy_line_tension(runs[1], line="wire")[-1, 0] == pytest.approx(
        (MASS + MU * length) * G, rel=0.02
    )


def test_a_run_ends_by_name_where_it_has_hauled_in_to_its_end() -> None:
    scene = hung(Curve.constant(value=0.0), deep=12.0, segments=3, rate=-1.0, minimum_length=8.0)
    with pytest.raises(SimulationError, match=r"hauled in to its minimum_length, which would stop the mass"):
        simulate(scene, t_end=20.0)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"lag": 0.0}, "which needs a smooth rate, and its winch has no lag; give one, such as 0.1 s"),
        ({"minimum_length": 60.0}, "starts with a length of 40 m and a minimum_length of 60 m"),
    ],
)
def test_what_does_not_fit_is_refused_by_name(given: dict[str, Any], message: str) -> None:
    with pytest.raises(SceneError, match=f"line 'wire.1': .*{message}"):
        hung(Curve.constant(value=0.0), deep=40.0, segments=4, **given).compile()


def test_a_length_that_changes_by_itself_takes_no_winch() -> None:
    scene = wet(PAID)
    with pytest.raises(SceneError, match="line 'wire': has a Curve for its length, and the winch changes it"):
        scene.add_winch("wire", lag=LAG)
    assert not scene.loads["wire.1"].winch


def test_parts_of_a_line_that_is_not_there_are_refused() -> None:
    scene = hung(Curve.constant(value=0.0), deep=40.0, segments=4)
    scene.replace("wire.3 winding", kind="load", paid_out_by="rope")
    with pytest.raises(
        SceneError, match="paid out by 'rope', and no segment before it is on a winch of this name"
    ):
        scene.compile()


def test_a_file_keeps_it(tmp_path: Path) -> None:
    scene = wet(compensated=True)
    scene.save(tmp_path / "wet.json")
    assert Scene.load(tmp_path / "wet.json").loads == scene.loads


def test_a_hoist_hangs_its_load_on_such_a_line_and_winch() -> None:
    scene = Scene(name="hoist", gravity=G)
    scene.add_given_vessel(shipped_database())
    scene.add_sea(hs=0.0, tp=8.0)
    scene.add_crane(slew=0.0, s1=1.0, s2=2.0)
    for wire, message in (({"EA": 1.0}, "wire has 'EA'; give some of"), (None, "needs a smooth length")):
        with pytest.raises(SceneError, match=message):
            scene.add_hoist("wire", mass=50e3, size=(4, 4, 4), rung="with mass", winch=True, wire=wire)
    scene.add_hoist("wire", mass=50e3, size=(4, 4, 4), length=20.0, EA=1.5e8, rung="with mass",
                    mass_per_length=20.0, winch={"lag": 0.1},
                    wire={"segments": 5, "medium": "sea", "diameter": 0.06})  # fmt: skip
    at_rest = equilibrium(scene)
    assert at_rest.load_states["wire.length"] == pytest.approx(20.0, rel=1e-2)
    assert [name for name in scene.loads if name.endswith("water")] == [
        f"wire.{i} water" for i in range(1, 6)
    ]
