"""Least and largest values between outputs: closed forms, dense records, stages, restarts and files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import seacrane as sc
from seacrane import cases
from seacrane.ensembles import Kept
from seacrane.operability.criterion import RecordNumbers

MASS, GRAVITY, LENGTH = 2e3, 9.81, 10.0
WEIGHT = MASS * GRAVITY


def hung(*, EA: float, fall: float = 0.0, damping: float = 0.0, hangs: int = 1) -> sc.Scene:
    """A mass that has fallen so far (m) where its line becomes taut, and more below it on lines alike."""
    scene = sc.Scene(name="mass on a line", gravity=GRAVITY)
    above, down = "ground", (0.0, 0.0, -np.sqrt(2.0 * GRAVITY * fall))
    for i in range(1, hangs + 1):
        name, place = f"mass {i}", (0.0, 0.0, -LENGTH * i)
        scene.add_body(name, mass=MASS / i, inertia=(1e3, 1e3, 1e3), position=place, velocity=down)
        scene.add_line(f"line {i}", bodies=[above, name], points=[(0.0, 0.0, 0.0)] * 2, length=LENGTH,
                       EA=EA / i, damping_ratio=damping, rung="elastic")  # fmt: skip
        above = name
    return scene


def largest(result: sc.Result, channel: str = "line_tension") -> np.ndarray:
    return np.asarray(result.reached(channel)[1]).max(axis=0)


@pytest.mark.parametrize("fall", [0.0, 0.05, 1.0])
def test_a_stiff_line_reaches_its_peak_in_closed_form(formulation: str, fall: float) -> None:
    """And the acceleration, where it is asked for."""
    EA = 4e8
    up = np.sqrt(1.0 + 2.0 * EA / LENGTH * fall / WEIGHT)
    exact, channels = WEIGHT * (1.0 + up), ["line_tension", "acceleration"]
    scene = hung(EA=EA, fall=fall)
    result = sc.simulate(scene, 1.5, dt_out=0.37, formulation=formulation, channels=channels)
    assert largest(result).item() == pytest.approx(exact, rel=1e-3)
    assert result["line_tension"].max() < 0.97 * exact  # the outputs miss it
    assert result.reached("line_tension")[0].min() == pytest.approx(0.0, abs=1e-3 * exact)
    least, most = result.reached("acceleration[mass 1, z]")
    assert most.max() == pytest.approx(GRAVITY * up, rel=2e-3)
    assert least.min() == pytest.approx(-GRAVITY, rel=1e-3)


USUAL = [(name, 1e-6) for name in ("dopri5", "dop853", "cvode-bdf", "rosenbrock")]


@pytest.mark.parametrize(("integrator", "rtol"), [*USUAL, ("rk4", None), ("dop853", 1e-5)])
def test_peaks_are_those_of_a_dense_record(integrator: str, rtol: float | None) -> None:
    random = np.random.default_rng(5)
    for hangs in (1, 2, 3):
        EA = 10.0 ** random.uniform(6.0, 8.5)
        scene = hung(EA=EA, fall=0.02 * random.random(), damping=0.02, hangs=hangs)
        period = 2.0 * np.pi * np.sqrt(MASS / hangs * LENGTH / (4.0 * EA))
        how = {"integrator": integrator, "formulation": "redundant"}
        how |= {"dt": period / 25.0} if rtol is None else {"rtol": rtol}
        seldom, often = (sc.simulate(scene, 2.0, dt_out=dt_out, **how) for dt_out in (0.3, period / 50.0))
        for channel in ("line_tension", "hook_load"):
            dense = often[channel]
            error = 1e-3 * dense.max()
            assert largest(seldom, channel) == pytest.approx(dense.max(axis=0), abs=error)
            assert seldom.reached(channel)[0].min(axis=0) == pytest.approx(dense.min(axis=0), abs=error)


def test_what_is_asked_for_is_kept_and_other_channels_are_as_recorded() -> None:
    scene = hung(EA=4e8)
    asked = sc.simulate(scene, 1.0, dt_out=0.5, channels=["position", "hook_load"])
    assert set(asked.extremes) == {"position", "hook_load"}
    assert asked.reached("position[mass 1, z]")[0].min() == pytest.approx(-LENGTH - 2 * WEIGHT * LENGTH / 4e8)
    usual = sc.simulate(scene, 1.0, dt_out=0.5)
    for bound in usual.reached("position"):
        np.testing.assert_array_equal(bound, usual["position"])
    least, most = usual.reached("line_tension")
    assert (least <= usual["line_tension"]).all() and (usual["line_tension"] <= most).all()


def test_a_limit_state_a_criterion_and_what_is_kept_read_the_peak() -> None:
    scene = hung(EA=4e8)
    scene.add_limit_state("line_tension[line 1]", maximum=1.5 * WEIGHT)
    result = sc.simulate(scene, 1.5, dt_out=0.5)
    used = result.utilisation[0]
    assert used.reached == pytest.approx(2.0 * WEIGHT, rel=1e-3)
    assert not used.kept
    kept = Kept.of_text("hook_load[after=0.5].max").of(result)
    assert kept.values == pytest.approx([2.0 * WEIGHT], rel=1e-3)
    numbers = RecordNumbers(channel="hook_load")(result)
    assert numbers[0] == pytest.approx(2.0 * WEIGHT, rel=1e-3)
    assert numbers[1] == pytest.approx(0.0, abs=2e-3 * WEIGHT)


def test_a_part_begins_with_the_value_of_its_first_output() -> None:
    scene = hung(EA=4e8, damping=0.05)
    result = sc.simulate(scene, 2.0, dt_out=0.5)
    part = result.part(after=1.0)
    later = result.reached("line_tension", part=part)[1]
    assert later[0] == result["line_tension"][part][0]
    assert later.max() < 0.99 * largest(result).item()


def test_files_and_stages_hold_them(tmp_path: Path) -> None:
    scene = hung(EA=1e7, fall=0.02, hangs=2)
    whole = sc.simulate(scene, 2.0, dt_out=0.25)
    again = sc.Result.load(whole.save(tmp_path / "whole.nc"))
    for name, both in whole.extremes.items():
        np.testing.assert_array_equal(both, again.extremes[name])
    some = sc.Result.load(tmp_path / "whole.nc", channels=["line_tension"])
    assert set(some.extremes) == {"line_tension"}
    streamed = sc.simulate(scene, 2.0, to=tmp_path / "streamed.nc", dt_out=0.25, checkpoint_every=0.6)
    stages = [sc.Stage(name="a", duration=0.7), sc.Stage(name="b", duration=1.3)]
    for other in (streamed.load(), sc.simulate(scene, stages, dt_out=0.25)):
        for channel in ("line_tension", "hook_load"):
            assert largest(other, channel) == pytest.approx(largest(whole, channel), rel=1e-3)
    assert "line_tension_largest" in whole.to_xarray()


def test_a_run_that_goes_on_between_outputs_keeps_what_came_before() -> None:
    scene = hung(EA=1e6)
    period = 2.0 * np.pi * np.sqrt(MASS * LENGTH / 1e6)
    whole = sc.simulate(scene, 0.9 * period, dt_out=0.9 * period)
    first = sc.Run(scene, 0.9 * period, dt_out=0.9 * period)
    first.advance(0.6 * period)  # behind the peak, before the output
    rest = sc.simulate(scene, 0.9 * period, dt_out=0.9 * period, start=first.state)
    assert largest(whole).item() == pytest.approx(2.0 * WEIGHT, rel=1e-3)
    assert largest(rest).item() == pytest.approx(2.0 * WEIGHT, rel=1e-3)


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_rod_at_the_bottom_of_its_swing_and_a_driver_reach_what_they_carry(
    formulation: str, way: float
) -> None:
    """T = m g (3 cos phi - 2 cos phi0) of a mass let go at phi0; m (g + a w^2) of one that is driven, whose
    guide may be told from the sledge to the ground."""
    scene, angle, omega, height = sc.Scene(name="pendulum", gravity=GRAVITY), 0.8, 2.0, 1.5
    place = LENGTH * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    scene.add_body("mass", mass=MASS, inertia=np.diag([1e3, 1e3, 1e3]), position=place)
    ends = {"first": "ground", "second": "mass", "point": (0, 0, 0), "second_point": place}
    scene.add_joint("rod", kind="distance", **ends, length=LENGTH)
    scene.add_body("sledge", mass=MASS, inertia=(1e3, 1e3, 1e3), velocity=(0.0, 0.0, height * omega))
    first, second = ("ground", "sledge")[:: int(way)]
    scene.add_joint("guide", kind="prismatic", first=first, second=second, point=(0, 0, 0), axis=(0, 0, 1))
    wave = sc.Curve.harmonic(amplitude=height, omega=omega, phase=-way * np.pi / 2)
    scene.add_driver(joint="guide", name="lift", curve=wave)
    result = sc.simulate(scene, 9.0, dt_out=1.3, formulation=formulation)
    force = MASS * height * omega**2
    for channel, low, high in (
        ("tension", WEIGHT * np.cos(angle), WEIGHT * (3.0 - 2.0 * np.cos(angle))),
        ("driver_force", *sorted((way * (WEIGHT - force), way * (WEIGHT + force)))),
    ):
        least, most = result.reached(channel)
        assert (least.min(), most.max()) == pytest.approx((low, high), rel=1e-3)
    assert result["tension"].max() < 0.99 * result.reached("tension")[1].max()


def test_what_is_evaluated_or_made_anew_reaches_its_peak(formulation: str) -> None:
    """A pendulum falls from the horizontal."""
    inertia, scene = 1e3, sc.Scene(name="pendulum", gravity=GRAVITY)
    scene.add_body("bob", mass=MASS, inertia=(inertia,) * 3, position=(LENGTH, 0.0, 0.0))
    scene.add_joint("pin", kind="revolute", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    scene.add_body("post", mass=1.0, inertia=(1.0,) * 3)
    scene.add_joint(kind="weld", name="foot", first="ground", second="post", point=(0, 0, 0))
    scene.add_point("pin", body="post")
    scene.add_point("middle", body="bob")
    scene.add_channel("under", expression="middle.z in post")
    scene.add_channel("fallen", expression="pin.z - bob.z")
    channels = ["reaction_force", "own"]
    result = sc.simulate(scene, 5.4, dt_out=2.7, channels=channels, formulation=formulation)
    share = MASS * LENGTH**2 / (MASS * LENGTH**2 + inertia)
    for name, end, peak in (
        ("reaction_force[pin, z]", 1, WEIGHT * (1.0 + 2.0 * share)),
        ("own[under]", 0, -LENGTH),
        ("own[fallen]", 1, LENGTH),
    ):
        bound = result.reached(name)[end]
        assert abs(bound).max() == pytest.approx(abs(peak), rel=1e-3)
        assert abs(result.curve(name)).max() < 0.98 * abs(peak)


def test_a_line_with_mass_carries_its_load_at_the_one_end_and_itself_too_at_the_other() -> None:
    scene, length, per_length = sc.Scene(name="deep", gravity=GRAVITY), 1000.0, 20.0
    scene.add_body("load", mass=2e4, inertia=np.diag([1e4] * 3), position=(0.0, 0.0, -length))
    scene.add_line("wire", bodies=["ground", "load"], points=[(0.0, 0.0, 0.0)] * 2, length=length, EA=4e8,
                   wire={"mass_per_length": per_length, "segments": 8}, rung="quasi-static")  # fmt: skip
    result = sc.simulate(scene, 1.0, start="rest")
    load, all_of_it = 2e4 * GRAVITY, (2e4 + per_length * length) * GRAVITY
    upper, lower = result["end_tension"][:, 0].T
    told = sc.summary(result)
    for found, exact in (
        (result["hook_load"][:, -1], load), (lower, load), (upper, all_of_it),
        (told["hook load wire"].maximum, load), (told["hoist tension wire"].maximum, all_of_it),
    ):  # fmt: skip
        assert found == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize("stages", [(), [sc.Stage(name="a", duration=0.7), sc.Stage(name="b", duration=0.8)]])
def test_a_study_has_the_peaks_that_it_keeps_and_no_others(stages: Any, monkeypatch: Any) -> None:
    """A function may read those of any channel. What is kept is the same whatever is kept beside it."""
    scene, seen, of = hung(EA=4e8, damping=0.05), list[set[str]](), Kept.of
    scene.add_channel("twice", expression="2 * line_tension[line 1]")
    monkeypatch.setattr(Kept, "of", lambda kept, result: seen.append({*result.extremes}) or of(kept, result))
    given: dict[str, Any] = {"over": {"gravity": [GRAVITY]}, "dt_out": 0.5, "stages": stages}
    given |= {} if stages else {"t_end": 1.5}

    def kept(peaks: set[str], **keep: Any) -> Any:
        seen.clear()
        found = sc.ensemble(scene, keep={"z": "position[mass 1, z]", "mean": "own.mean", **keep}, **given)
        assert seen and all(one == peaks for one in seen)
        return found.dataset

    none, some = kept(set()), kept({"hook_load", "own"}, most="hook_load.max", twice="own.min")
    given["channels"] = ["position", "line_tension", "own"]
    every = kept({*given["channels"]}, most=lambda result: result.reached("line_tension")[1].max())
    for name in ("z", "mean"):
        assert none[name].identical(some[name]) and none[name].identical(every[name])
    assert every["most"] == some["most"] > 1.8 * WEIGHT
    assert some["twice"] < 0.2 * WEIGHT


def test_members_in_lanes_keep_the_peaks_of_runs_by_themselves() -> None:
    given = {
        "over": {"seed": [1, 2, 3]}, "t_end": 8.0, "dt_out": 2.0,
        "keep": {"roll": "roll.max", "torque": "slew_torque.max", "heave": "heave.min"},
    }  # fmt: skip
    alone = sc.ensemble(cases.case2(), lanes=1, **given).dataset
    beside = sc.ensemble(cases.case2(), lanes=4, **given).dataset
    coarse = sc.ensemble(cases.case2(), lanes=1, **{**given, "keep": {"roll": "roll"}}).dataset
    for name in ("roll", "torque", "heave"):
        assert beside[name].to_numpy() == pytest.approx(alone[name].to_numpy(), rel=1e-3)
    assert (coarse["roll"].max("time") < 0.999 * alone["roll"]).any()
