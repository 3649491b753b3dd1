"""Lines with rung="auto": what they become in a run, why, and what happens where the choice was wrong."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, add_led, below, hung, swinging
from numpy.testing import assert_allclose

from seacrane import Curve, Result, Run, SampledController, Scene, SceneError, cases, simulate
from seacrane.analysis import equilibrium, natural_modes
from seacrane.analysis.line_dynamics import line_dynamics
from seacrane.analysis.linearise import jacobian
from seacrane.errors import LineSlackError
from seacrane.run.line_rungs import curve_frequency, excitations, tension_error
from seacrane.warnings import PushingLineWarning, QuasiStaticLineWarning

STIFF = 1e4 * STIFFNESS  # N, EA of 10 m


def heaved(*, stiffness: float = STIFF) -> Scene:
    """20 t below a block that moves up and down from rest, on 10 m of line that carries the weight."""
    scene = below((0.0, 0.0, -10.0))
    add_led(scene, "block", Curve.quintic(start_time=0.0, end_time=7.5, start=0.0, end=1.0))
    scene.add_line(name="hoist", bodies=["block", "load"], points=np.zeros((2, 3)), EA=stiffness,
                   length=10.0 / (1.0 + MASS * G / stiffness), rung="auto")  # fmt: skip
    return scene


def over_the_top() -> Scene:
    """A load at the lowest point of its circle, too slow to reach the highest with its line taut."""
    speed = np.sqrt(3.5 * G * 10.0)
    length = 10.0 / (1.0 + MASS * (G + speed**2 / 10.0) / STIFF)
    return below((0.0, 0.0, -10.0), velocity=(speed, 0, 0), EA=STIFF, length=length, rung="auto")


def rung_of(scene: Scene, t_end: float = 1.0, **settings: Any) -> tuple[str, str]:
    """The rung of its hoist, and why."""
    rung = Run(scene, t_end, **settings).rungs["hoist"]
    return rung.name, rung.reason


@pytest.mark.warns(sometimes=["UnitWarning"])
@pytest.mark.parametrize(("stiffness", "rung"), [(STIFF, "quasi-static"), (1e6, "elastic")])
def test_it_is_the_run_of_the_rung_it_takes(stiffness: float, rung: str) -> None:
    chosen, given = heaved(stiffness=stiffness), heaved(stiffness=stiffness)
    given.replace("hoist", rung=rung)
    one, other = (simulate(scene, 4.0, dt_out=0.5)["position"] for scene in (chosen, given))
    assert np.array_equal(one, other)


@pytest.mark.warns(sometimes=["StiffWarning"])
@pytest.mark.parametrize("stiffness", [6e7, 6e8])
def test_the_error_that_it_names_is_that_of_the_run(stiffness: float) -> None:
    """Of a block that heaves steadily: what the two rungs make of the tension differs by the law."""
    omega, scene, tension = 2.0, heaved(), []
    scene.replace("lead", curve=Curve.harmonic(offset=-0.2, amplitude=0.2, omega=omega))
    length = 10.0 / (1.0 + MASS * G / stiffness)
    for rung in ("quasi-static", "elastic"):
        scene.replace("hoist", rung=rung, EA=stiffness, damping_ratio=0.2, length=length)
        out = simulate(scene, 10.0, dt_out=0.05, rtol=1e-9)
        tension.append(out["line_tension"][out.time > 4.0, 0])
    own = np.sqrt(stiffness / 10.0 / MASS)
    law = float(tension_error(np.array([omega]), settling=0.2, own=own)[0])
    assert np.std(tension[0] - tension[1]) / np.std(tension[1]) == pytest.approx(law, rel=0.1)


def several(rng: np.random.Generator, rung: str) -> Scene:
    """Loads one below the other, or one beside a tugger, that swing from where they start."""
    scene, mass, length = Scene(name="several"), 10.0 ** rng.uniform(3, 5), rng.uniform(3.0, 40.0)
    angle, upper = rng.uniform(0.0, 0.3), rng.uniform(0.0, 0.5)
    place = length * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    scene.add_body(name="load", mass=mass, inertia=mass * np.eye(3), position=place)
    below = rng.uniform(0.02, 0.5) * mass
    ringing = rng.choice([0.0, 0.01, 0.3])
    kind = rng.choice(["below", "tugger", "both"])
    carried = mass + (below if kind != "tugger" else 0.0)
    scene.add_line(name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), damping_ratio=0.01,
                   EA=10.0 ** rng.uniform(7, 10), rung=rung,
                   tension_at_start=carried * G * (np.cos(angle) + (rng.random() < 0.3) * upper))  # fmt: skip
    if kind != "tugger":
        under = place - [0, 0, rng.uniform(1.0, 8.0)]
        scene.add_body(name="box", mass=below, inertia=below * np.eye(3), position=under)
        scene.add_line(name="lower", bodies=["load", "box"], points=np.zeros((2, 3)), damping_ratio=0.01,
                       EA=10.0 ** rng.uniform(6, 10), rung=rung,
                       tension_at_start=below * G * (1.0 + ringing))  # fmt: skip
    if kind != "below":
        beside = place + np.array([rng.uniform(5.0, 20.0), 0.0, 0.0])
        scene.add_line(name="tugger", bodies=["ground", "load"], points=[beside, np.zeros(3)],
                       EA=10.0 ** rng.uniform(5, 8), rung=rng.choice([rung, "elastic"]), damping_ratio=0.01,
                       tension_at_start=rng.uniform(0.0, 0.1) * mass * G)  # fmt: skip
    return scene


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(
    ("seeds", "quasi"),
    [(range(20), 3), pytest.param(range(20, 120), 0, marks=pytest.mark.slow("many random scenes"))],
)
def test_several_lines_are_near_the_elastic_ones(seeds: range, quasi: int) -> None:
    """To 3 % of all weight: ringing of 2 % from the start is let through, and 1 % beside it."""
    for seed in seeds:
        scenes = [several(np.random.default_rng(seed), rung) for rung in ("auto", "elastic")]
        chosen, elastic = (simulate(scene, 10.0, dt_out=0.02, rtol=1e-7) for scene in scenes)
        weight = sum(body.mass for body in scenes[0].bodies.values()) * G
        assert np.abs(chosen["line_tension"] - elastic["line_tension"]).max() < 0.03 * weight
        quasi -= ": quasi-static: " in chosen.stats["line_rungs"]
    assert quasi <= 0


def in_resonance(rung: str, omega: float) -> Scene:
    """180 t on 2,000 m of wire below a tip that heaves; its own frequency is 1.05 rad/s."""
    scene = below((0.0, 0.0, -2000.0), mass=180e3)
    add_led(scene, "tip", Curve.harmonic(amplitude=0.2, omega=omega, phase=np.pi / 2))
    scene.add_line(name="hoist", bodies=["tip", "load"], points=np.zeros((2, 3)), EA=4e8, damping_ratio=0.02,
                   tension_at_start=180e3 * G, rung=rung, settling=0.02)  # fmt: skip
    return scene


def test_resonance_counts() -> None:
    """At the wire's own frequency the tension errs by more than the law without resonance says."""
    assert rung_of(in_resonance("auto", 1.05))[0] == "elastic"
    Run(in_resonance("quasi-static", 0.5), 1.0)
    slow = in_resonance("quasi-static", 1.05)
    slow.replace("hoist", settling=0.2)
    with pytest.warns(QuasiStaticLineWarning, match="line 'hoist': its stretch is quasi-static"):
        Run(slow, 1.0)


def test_the_law_and_the_frequencies_of_what_moves_a_scene() -> None:
    """2 (s omega)^2 of (omega / own)^2 for slow motion, and no more than four times it for any."""
    omega = np.array([0.1, 0.2])
    error = tension_error(omega, settling=0.2, own=20.0)
    assert_allclose(error, 2.0 * (0.2 * omega) ** 2 * (omega / 20.0) ** 2, rtol=0.01)
    fast = np.geomspace(0.01, 1e3, 400)
    assert np.all(tension_error(fast, settling=0.2, own=20.0) < 4.0 * (fast / 20.0) ** 2)
    ramp = Curve.quintic(start_time=0.0, end_time=10.0, start=0.0, end=1.0)
    assert curve_frequency(ramp, 2, start=0.0, end=60.0) == pytest.approx(np.sqrt(42.0) / 10.0, rel=1e-12)
    wave = Curve.harmonic(amplitude=0.3, omega=1.7)
    assert curve_frequency(wave, 2, start=0.0, end=9.0) == pytest.approx(1.7)
    sources = {name: (omega, weight) for name, omega, weight in excitations(cases.case2(), start=0, end=100)}
    omega, weight = sources["the sea"]
    assert 0.5 < np.sqrt((weight * omega**2).sum() / weight.sum()) < 1.2
    assert "the reference of 'slew'" in sources


def test_the_frequency_of_a_line_is_that_of_its_mode() -> None:
    """As bodies are joined: falls, two lines in series with a light block between, and one beside another."""
    scene = hung(falls=3)
    own = line_dynamics(scene, scene.compile(merge=False), scene.compile().initial_state, 0.0)["hoist"]
    assert own.omega == pytest.approx(np.sqrt(STIFFNESS / MASS), rel=1e-9)
    assert own.tension == pytest.approx(MASS * G / 3, rel=1e-9)
    assert own.mass == pytest.approx(MASS / 9, rel=1e-9)
    series = Scene(name="series")
    series.add_body(name="block", mass=10.0, inertia=(1, 1, 1), position=(0, 0, -5.0))
    series.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0))
    for name, bodies, at in (("upper", ["ground", "block"], 0.0), ("lower", ["block", "load"], 0.0)):
        series.add_line(name=name, bodies=bodies, points=[(0, 0, at), (0, 0, 0)], EA=1e8, damping_ratio=0.0,
                        length=5.0 / (1.0 + MASS * G / 1e8))  # fmt: skip
    model = series.compile(merge=False)
    rates = np.abs(np.linalg.eigvals(jacobian(model)))
    found = line_dynamics(series, model, np.array(model.initial_state), 0.0)
    for line in found.values():
        assert np.min(np.abs(rates / line.omega - 1.0)) < 1e-2


def shaken(rung: str = "auto") -> Scene:
    """A block whose short drop is faster than a load falls; the strain follows too late to go slack."""
    scene = heaved()
    scene.replace("lead", curve=Curve.quintic(start_time=0.5, end_time=0.65, start=0.0, end=-0.1))
    scene.replace("hoist", rung=rung)
    return scene


def automatic(scene: Scene) -> Scene:
    scene.replace("hoist", rung="auto")
    return scene


@pytest.mark.filterwarnings("ignore")
def test_it_stays_elastic_where_the_bound_does_not_hold() -> None:
    buffered, *stepped = (heaved() for _ in range(3))
    buffered.add_stop(name="buffer", joint="guide", minimum=-5.0, stiffness=1e6)
    jump = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=0.5))
    for scene, lag in zip(stepped, (0.2, 0.0), strict=True):
        scene.add_winch(line="hoist", rate=jump, lag=lag)
    for scene, words in (
        (automatic(hung(stretch=-0.1)), "it starts slack"), (shaken(), "a jump at t = 0.5 s"),
        (automatic(swinging()), "would ring from the start, by"),
        (heaved(stiffness=1e6), "more than 0.5 %"), (stepped[0], "a jump at t = 1 s would make"),
        (stepped[1], "its winch has no lag"), (buffered, "SoftStop 'buffer'"),
    ):  # fmt: skip
        rung, reason = rung_of(scene, 3.0)
        assert rung == "elastic" and words in reason
    assert rung_of(heaved(), 3.0, integrator="ida")[0] == "elastic"


@pytest.mark.warns("UnitWarning")
def test_a_file_changes_no_rung_and_what_is_not_known_stays_elastic(tmp_path: Path) -> None:
    """A model that was compiled before, and inputs that will be set."""
    simulate(heaved(), 0.2, to=tmp_path / "a.nc", dt_out=0.1)
    told = Result.load(tmp_path / "a.nc").stats["line_rungs"]
    assert told.startswith("hoist: quasi-static")
    assert rung_of(heaved(), model=heaved().compile())[0] == "elastic"
    scene = heaved()
    scene.add_winch(line="hoist", lag=0.2)
    controller = SampledController(function=lambda time, state: {"hoist.rate": 0.1}, period=0.1)
    result = simulate(scene, 0.3, dt_out=0.1, controllers=[controller])
    assert "inputs are set during the run" in result.stats["line_rungs"]
    assert result["line_pay_out_rate"][-1, 0] > 0.05
    assert "inputs are set" in rung_of(scene, controlled=True)[1]
    run = Run(scene, 1.0)
    assert run.rungs["hoist"].name == "quasi-static"
    run.advance(0.2)
    with pytest.raises(SceneError, match=r"inputs: set at t = 0\.2 s .* controlled=True"):
        run.set_inputs({"hoist.rate": 0.1})


@pytest.mark.warns("LargeSwingWarning", "UnitWarning", sometimes=["StiffWarning"])
def test_a_run_whose_line_goes_slack_ends_by_name() -> None:
    how: dict[str, Any] = {"t_end": 2.5, "dt_out": 0.1, "rtol": 1e-6}
    start = simulate(over_the_top(), 0.5, dt_out=0.1).state
    assert "hoist.strain_rate" in start.load_states
    for begun in (None, start):
        given = how if begun is None else how | {"start": begun}
        with pytest.raises(LineSlackError, match=r"line 'hoist'.*goes slack.*rung 'elastic'") as ended:
            simulate(over_the_top(), **given)
        assert 1.0 < ended.value.result.time[-1] < 2.0
    elastic = over_the_top()
    elastic.replace("hoist", rung="elastic")
    assert np.min(simulate(elastic, **how)["line_tension"]) == 0.0


@pytest.mark.warns("UnitWarning")
@pytest.mark.parametrize("rung", ["quasi-static", "auto"])
def test_a_line_that_pushes_for_a_moment_is_told(rung: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seacrane.run.line_rungs.LARGEST_RINGING", np.inf)
    monkeypatch.setattr("seacrane.run.line_rungs.LARGEST_ERROR", np.inf)
    with pytest.warns(PushingLineWarning, match="line 'hoist': pushes"):
        out = simulate(shaken(rung), 1.0, dt_out=0.01)
    assert np.min(out["line_tension"]) < 0.0 < np.min(out["line_stretch"])


@pytest.mark.warns("UnitWarning")
def test_a_run_goes_on_with_the_rung_of_its_start_and_rests_as_the_elastic_line() -> None:
    whole, first = (Run(heaved(), t_end=t_end, dt_out=0.1) for t_end in (4.0, 2.0))
    whole.advance(4.0)
    first.advance(2.0)
    rest = Run(heaved(), t_end=4.0, dt_out=0.1, start=first.state)
    assert "as in the state it goes on from" in rest.rungs["hoist"].reason
    rest.advance(4.0)
    assert_allclose(rest.state.values, whole.state.values, rtol=1e-6, atol=1e-7)  # other steps
    scene = heaved()
    scene.replace("hoist", rung="elastic")
    assert rung_of(heaved(), 2.0, start=simulate(scene, 1.0).state)[0] == "elastic"
    chosen, elastic = automatic(hung(stretch=0.0)), hung(stretch=0.0)
    assert_allclose(equilibrium(chosen).values, equilibrium(elastic).values, atol=1e-12)
    assert_allclose(natural_modes(chosen).natural_period, natural_modes(elastic).natural_period)
    chosen.replace("hoist", EA=STIFF)
    run = Run(chosen, 1.0, start=equilibrium(chosen))
    assert run.rungs["hoist"].name == "quasi-static"
    run.advance(1.0)
    assert_allclose(run.state.values[2], equilibrium(chosen).values[2], atol=1e-9)
