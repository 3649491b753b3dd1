"""Lines with rung="auto": what they become in a run, why, and what happens where the choice was wrong."""

from __future__ import annotations

import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from line_scenes import MASS, STIFFNESS, G, case2_on_a_line, hung, on_deck, swinging
from numpy.testing import assert_allclose
from numpy.typing import NDArray

from seacrane import (
    Curve,
    Result,
    Run,
    SampledController,
    Scene,
    SceneError,
    cases,
    equilibrium,
    natural_modes,
    simulate,
    simulate_to_file,
)
from seacrane.analysis.line_dynamics import line_dynamics
from seacrane.analysis.linearise import jacobian
from seacrane.run.line_rungs import COMPILED, LARGEST_ERROR, curve_frequency, excitations, tension_error
from seacrane.warnings import (
    EnergyErrorWarning,
    LineRungWarning,
    PushingLineWarning,
    QuasiStaticLineWarning,
    StiffWarning,
)

Array = NDArray[np.float64]
STIFF = 1e4 * STIFFNESS  # N, EA of 10 m


def automatic(scene: Scene, **change: Any) -> Scene:
    """The scene with its hoist automatic."""
    scene.replace("hoist", rung="auto", **change)
    return scene


def heaved(*, omega: float = 0.8, amplitude: float = 1.0, stiffness: float = STIFF) -> Scene:
    """20 t below a block that moves up and down from rest, on 10 m of line that carries the weight."""
    scene = Scene(name="heaved")
    scene.add_body(name="block", mass=100.0, inertia=(10.0, 10.0, 10.0))
    scene.add_joint(kind="prismatic", name="guide", first="ground", second="block", point=(0, 0, 0))
    scene.add_driver(
        joint="guide", curve=Curve.quintic(start_time=0.0, end_time=6.0 / omega, start=0.0, end=amplitude)
    )
    scene.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0.0, 0.0, -10.0))
    scene.add_line(
        name="hoist", bodies=["block", "load"], points=np.zeros((2, 3)), EA=stiffness,
        length=10.0 / (1.0 + MASS * G / stiffness), rung="auto",
    )  # fmt: skip
    return scene


def over_the_top() -> Scene:
    """A load at the lowest point of its circle, too slow to reach the highest with its line taut."""
    scene = Scene(name="over the top")
    speed = np.sqrt(3.5 * G * 10.0)
    tension = MASS * (G + speed**2 / 10.0)
    scene.add_body(
        name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0), velocity=(speed, 0, 0)
    )
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=STIFF,
        length=10.0 / (1.0 + tension / STIFF), rung="auto",
    )  # fmt: skip
    return scene


def rung_of(scene: Scene, t_end: float = 1.0, **settings: Any) -> tuple[str, str]:
    """The rung of its hoist, and why."""
    rung = Run(scene, t_end, **settings).rungs["hoist"]
    return rung.name, rung.reason


@pytest.mark.parametrize(("stiffness", "expected"), [(1e6, "elastic"), (1e8, "quasi-static")])
def test_case2_takes_the_rung_that_its_stiffness_allows(stiffness: float, expected: str) -> None:
    rung = Run(case2_on_a_line("auto", stiffness), 100.0).rungs["link"]
    assert rung.name == expected
    assert "its own frequency being" in rung.reason


@pytest.mark.warns("UnitWarning")
def test_stiff_costs_like_soft_by_itself() -> None:
    settings: dict[str, Any] = {"dt_out": 1.0, "rtol": 1e-4, "channels": ["position"]}
    rigid = simulate(cases.case2(), 20.0, **settings)
    out = simulate(case2_on_a_line("auto", 1e11), 20.0, **settings)
    assert out.stats["evaluations"] < 1.5 * rigid.stats["evaluations"]
    assert out.stats["line_rungs"].startswith("link: quasi-static: its tension would err by ")


@pytest.mark.warns("UnitWarning")
def test_it_is_the_run_of_the_rung_it_takes() -> None:
    chosen = simulate(heaved(), 4.0, dt_out=0.5)
    given = heaved()
    given.replace("hoist", rung="quasi-static")
    assert np.array_equal(chosen["position"], simulate(given, 4.0, dt_out=0.5)["position"])
    soft, elastic = heaved(stiffness=1e6), heaved(stiffness=1e6)
    elastic.replace("hoist", rung="elastic")
    assert np.array_equal(
        simulate(soft, 4.0, dt_out=0.5)["position"], simulate(elastic, 4.0, dt_out=0.5)["position"]
    )


def test_the_error_that_it_names_is_that_of_the_run() -> None:
    """Of a block that heaves steadily: what the two rungs make of the tension differs by the law."""
    omega = 2.0
    scene = heaved()
    wave = Curve.harmonic(offset=-0.2, amplitude=0.2, omega=omega)
    scene.replace("guide.displacement", curve=wave)
    for stiffness in (6e7, 6e8):
        own = np.sqrt(stiffness / 10.0 / MASS)
        tension = []
        for rung in ("quasi-static", "elastic"):
            scene.replace(
                "hoist", rung=rung, EA=stiffness, damping_ratio=0.2,
                length=10.0 / (1.0 + MASS * G / stiffness),
            )  # fmt: skip
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", StiffWarning)
                out = simulate(scene, 10.0, dt_out=0.05, rtol=1e-9)
            tension.append(out["line_tension"][out.time > 4.0, 0])
        apart = np.std(tension[0] - tension[1]) / np.std(tension[1])
        law = float(tension_error(np.array([omega]), settling=0.2, own=own)[0])
        assert apart == pytest.approx(law, rel=0.1)


@pytest.mark.parametrize("seed", range(8))
def test_whatever_it_takes_is_near_the_elastic_line(seed: int) -> None:
    """Random loads, lines, swings and ramps of the block: 1 % of the weight, 1 cm of the load."""
    rng = np.random.default_rng(seed)
    stiffness, mass, length = 10.0 ** rng.uniform(7, 10), 10.0 ** rng.uniform(3, 5), rng.uniform(3.0, 40.0)
    angle, period, rise = rng.uniform(0.0, 0.6), rng.uniform(1.0, 8.0), rng.uniform(0.05, 1.0)
    scene = heaved()
    ramp = Curve.quintic(start_time=0.5, end_time=0.5 + period, start=0.0, end=rise)
    scene.replace("guide.displacement", curve=ramp)
    place = length * np.array([np.sin(angle), 0.0, -np.cos(angle)])
    scene.replace("load", mass=mass, inertia=mass * np.eye(3), position=place)
    strain = mass * G * np.cos(angle) / stiffness
    scene.replace("hoist", EA=stiffness, length=length / (1.0 + strain))
    chosen = simulate(scene, 10.0, dt_out=0.05, rtol=1e-7)
    scene.replace("hoist", rung="elastic")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        elastic = simulate(scene, 10.0, dt_out=0.05, rtol=1e-7)
    assert np.abs(chosen["position"] - elastic["position"]).max() < 0.01
    assert np.abs(chosen["line_tension"] - elastic["line_tension"]).max() < 0.01 * mass * G


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
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), damping_ratio=0.01,
        EA=10.0 ** rng.uniform(7, 10), rung=rung,
        tension_at_start=carried * G * (np.cos(angle) + (rng.random() < 0.3) * upper),
    )  # fmt: skip
    if kind != "tugger":
        under = place - [0, 0, rng.uniform(1.0, 8.0)]
        scene.add_body(name="box", mass=below, inertia=below * np.eye(3), position=under)
        scene.add_line(
            name="lower", bodies=["load", "box"], points=np.zeros((2, 3)), damping_ratio=0.01,
            EA=10.0 ** rng.uniform(6, 10), rung=rung,
            tension_at_start=below * G * (1.0 + ringing),
        )  # fmt: skip
    if kind != "below":
        beside = place + np.array([rng.uniform(5.0, 20.0), 0.0, 0.0])
        scene.add_line(
            name="tugger", bodies=["ground", "load"], points=[beside, np.zeros(3)],
            EA=10.0 ** rng.uniform(5, 8), rung=rng.choice([rung, "elastic"]), damping_ratio=0.01,
            tension_at_start=rng.uniform(0.0, 0.1) * mass * G,
        )  # fmt: skip
    return scene


def apart(seed: int) -> tuple[float, bool]:
    """By how much tensions with lines chosen by the run differ from elastic ones, over the weight of all
    loads; and whether a line is quasi-static at all."""
    runs = []
    for rung in ("auto", "elastic"):
        scene = several(np.random.default_rng(seed), rung)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            runs.append(simulate(scene, 10.0, dt_out=0.02, rtol=1e-7))
    weight = sum(body.mass for body in scene.bodies.values()) * G
    error = np.abs(runs[0]["line_tension"] - runs[1]["line_tension"]).max()
    return float(error / weight), ": quasi-static: " in runs[0].stats["line_rungs"]


def test_several_lines_are_near_the_elastic_ones() -> None:
    """Ringing of 2 % from the start is let through, and 1 % of the weight beside it."""
    found = [apart(seed) for seed in range(20)]
    assert max(error for error, _ in found) < 0.03
    assert sum(quasi for _, quasi in found) >= 3


@pytest.mark.slow("many random scenes")
def test_many_scenes_of_several_lines_are_near_the_elastic_ones() -> None:
    found = [apart(seed) for seed in range(20, 120)]
    assert max(error for error, _ in found) < 0.03


def test_a_line_that_rings_makes_its_neighbours_elastic() -> None:
    """The lower line starts with 4 % more than its load's weight, the upper one at rest."""
    scene = Scene(name="two lines")
    for name, mass, depth in (("load", 2000.0, 25.0), ("box", 600.0, 28.0)):
        scene.add_body(name=name, mass=mass, inertia=(mass, mass, mass), position=(0, 0, -depth))
    for name, bodies, stiffness, pull in (
        ("upper", ["ground", "load"], 1.5e9, 2600.0), ("lower", ["load", "box"], 2e8, 624.0),
    ):  # fmt: skip
        scene.add_line(
            name=name, bodies=bodies, points=np.zeros((2, 3)), EA=stiffness, damping_ratio=0.0,
            tension_at_start=pull * G, rung="auto",
        )  # fmt: skip
    rungs = Run(scene, 5.0).rungs
    assert rungs["lower"].reason.startswith("its tension of ") and "would ring" in rungs["lower"].reason
    assert "of what line 'lower' makes of it, which is elastic and may ring" in rungs["upper"].reason
    scene.replace("lower", length=3.0 / (1.0 + 600.0 * G / 2e8))
    assert {rung.name for rung in Run(scene, 5.0).rungs.values()} == {"quasi-static"}


def in_resonance(rung: str, omega: float) -> Scene:
    """180 t on 2,000 m of wire below a tip that heaves; its own frequency is 1.05 rad/s."""
    scene = Scene(name="deep")
    scene.add_body(name="tip", mass=1e3, inertia=(1e3, 1e3, 1e3), gravity=False)
    scene.add_joint(kind="prismatic", name="up", first="ground", second="tip", axis=(0, 0, 1))
    scene.add_driver(joint="up", curve=Curve.harmonic(amplitude=0.2, omega=omega, phase=np.pi / 2))
    scene.add_body(name="load", mass=180e3, inertia=(4e5, 4e5, 4e5), position=(0, 0, -2000.0))
    scene.add_line(
        name="hoist", bodies=["tip", "load"], points=np.zeros((2, 3)), EA=4e8, damping_ratio=0.02,
        tension_at_start=180e3 * G, rung=rung, settling=0.02,
    )  # fmt: skip
    return scene


def test_resonance_counts() -> None:
    """With 20 ms the law without resonance is 0.1 %; at the wire's own frequency the tension errs by more."""
    assert float(tension_error(np.array([1.05]), settling=0.02, own=20.0)[0]) < 1e-5
    assert rung_of(in_resonance("auto", 1.05))[0] == "elastic"
    with warnings.catch_warnings():
        warnings.simplefilter("error", QuasiStaticLineWarning)
        Run(in_resonance("quasi-static", 0.5), 1.0)
    slow = in_resonance("quasi-static", 1.05)
    slow.replace("hoist", settling=0.2)
    with pytest.warns(
        QuasiStaticLineWarning, match=r"line 'hoist': its stretch is quasi-static, and its tension"
    ):
        Run(slow, 1.0)


def test_frequencies_of_what_moves_a_scene() -> None:
    ramp = Curve.quintic(start_time=0.0, end_time=10.0, start=0.0, end=1.0)
    assert curve_frequency(ramp, 2, start=0.0, end=60.0) == pytest.approx(np.sqrt(42.0) / 10.0, rel=1e-12)
    wave = Curve.harmonic(amplitude=0.3, omega=1.7)
    assert curve_frequency(wave, 2, start=0.0, end=9.0) == pytest.approx(1.7)
    assert curve_frequency(Curve.constant(value=4.0), 0, start=0.0, end=9.0) == 0.0
    sources = {name: (omega, weight) for name, omega, weight in excitations(cases.case2(), start=0, end=100)}
    omega, weight = sources["the sea"]
    assert 0.5 < np.sqrt((weight * omega**2).sum() / weight.sum()) < 1.2
    assert "the reference of 'slew'" in sources


def test_the_frequency_of_a_line_is_that_of_its_mode() -> None:
    """As bodies are joined: falls, two lines in series with a light block between, and one beside another."""
    for falls in (1, 3):
        scene = hung(falls=falls)
        own = line_dynamics(scene, scene.compile(merge=False), scene.compile().initial_state, 0.0)["hoist"]
        assert own.omega == pytest.approx(np.sqrt(STIFFNESS / MASS), rel=1e-9)
        assert own.tension == pytest.approx(MASS * G / falls, rel=1e-9)
        assert own.mass == pytest.approx(MASS / falls**2, rel=1e-9)
    series = Scene(name="series")
    series.add_body(name="block", mass=10.0, inertia=(1, 1, 1), position=(0, 0, -5.0))
    series.add_body(name="load", mass=MASS, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0))
    for name, bodies, at in (("upper", ["ground", "block"], 0.0), ("lower", ["block", "load"], 0.0)):
        series.add_line(
            name=name, bodies=bodies, points=[(0, 0, at), (0, 0, 0)], EA=1e8, damping_ratio=0.0,
            length=5.0 / (1.0 + MASS * G / 1e8),
        )  # fmt: skip
    model = series.compile(merge=False)
    rates = np.abs(np.linalg.eigvals(jacobian(model)))
    found = line_dynamics(series, model, np.array(model.initial_state), 0.0)
    for line in found.values():
        assert np.min(np.abs(rates / line.omega - 1.0)) < 1e-2


@pytest.mark.warns(sometimes=["LiftedStartWarning"])
@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: automatic(hung(stretch=-0.1)), "it starts slack"),
        (lambda: automatic(swinging()), "would ring from the start, by"),
        (lambda: automatic(on_deck()), "it starts slack"),
        (lambda: heaved(stiffness=1e6), "more than 0.5 %"),
    ],
)
def test_it_stays_elastic_where_the_bound_does_not_hold(make: Any, words: str) -> None:
    rung, reason = rung_of(make())
    assert rung == "elastic"
    assert words in reason


def test_a_scene_warns_once_and_a_large_one_is_left_elastic() -> None:
    scene = heaved()
    scene.add_joint(kind="prismatic", name="twin", first="ground", second="block", point=(0, 0, 0))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        assert rung_of(scene)[0] == "quasi-static"
    assert sum(str(one.message).count("are redundant") for one in caught) == 1
    for i in range(120):
        scene.add_body(name=f"chip {i}", mass=1.0, inertia=(1, 1, 1), position=(5.0 + i, 0, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert "states, more than 1500" in rung_of(scene)[1]


def stepped_winch(lag: float) -> Scene:
    scene = heaved()
    jump = Curve.constant(value=0.0).then(time=1.0, curve=Curve.constant(value=0.5))
    scene.add_winch(line="hoist", rate=jump, lag=lag)
    return scene


@pytest.mark.warns("UnitWarning")
def test_it_stays_elastic_where_something_would_shake_it() -> None:
    stopped = heaved()
    stopped.add_soft_stop(name="buffer", joint="guide", minimum=-5.0, stiffness=1e6)
    for scene, words in (
        (stepped_winch(0.2), r"a jump at t = 1 s would make its tension ring"),
        (stepped_winch(0.0), "its winch has no lag"),
        (stopped, "SoftStop 'buffer' may shake a line"),
    ):
        rung, reason = rung_of(scene, 3.0)
        assert rung == "elastic"
        assert words in reason
    for integrator in ("ida", "generalized-alpha"):
        assert f"'{integrator}' has no accelerations" in rung_of(heaved(), integrator=integrator)[1]
    scene = heaved()
    scene.add_body(name="float", mass=1.0, inertia=(1, 1, 1), position=(0, 0, -20))
    scene.add_joint(
        kind="prismatic", name="rail", first="ground", second="float", point=(0, 0, -20), axis=(0, 0, 1)
    )
    scene.add_end_stop(name="stop", joint="rail", minimum=-1.0)
    rung, reason = rung_of(scene)
    assert rung == "elastic"
    assert "limit 'stop' makes impacts" in reason


@pytest.mark.warns("LargeSwingWarning", "UnitWarning")
def test_a_run_whose_line_goes_slack_begins_anew_elastic() -> None:
    expected = over_the_top()
    expected.replace("hoist", rung="elastic")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", StiffWarning)
        elastic = simulate(expected, 2.5, dt_out=0.1, rtol=1e-6)
        assert np.min(elastic["line_tension"]) == 0.0
        with pytest.warns(LineRungWarning, match=r"it goes slack at t = 1\.\d+ s.*a second run from"):
            result = simulate(over_the_top(), 2.5, dt_out=0.1, rtol=1e-6)
    assert np.array_equal(result["position"], elastic["position"])
    assert result.stats["line_rungs"].startswith(
        "hoist: elastic: a first run was not: line 'hoist': its stretch"
    )
    assert "it goes slack at t = " in result.stats["validity"]
    assert result.time[0] == 0.0
    assert result.time[-1] == 2.5


@pytest.mark.warns("LargeSwingWarning", "UnitWarning")
def test_one_that_goes_on_and_then_goes_slack_begins_anew_from_its_own_start() -> None:
    start = simulate(over_the_top(), 0.5, dt_out=0.1).state
    assert "hoist.strain_rate" in start.load_states
    with pytest.warns(LineRungWarning, match=r"goes slack at t = 1\.\d+ s"):
        result = simulate(over_the_top(), 1.6, start=start, dt_out=0.1)
    assert result.time[0] == 0.5
    assert result.state.load_states == {}
    assert np.min(result["line_tension"]) == 0.0


@pytest.mark.warns("UnitWarning")
def test_a_run_goes_on_with_the_rung_of_its_start(tmp_path: Path) -> None:
    whole = Run(heaved(), t_end=4.0, dt_out=0.1)
    whole.advance(4.0)
    first = Run(heaved(), t_end=2.0, dt_out=0.1)
    first.advance(2.0)
    rest = Run(heaved(), t_end=4.0, dt_out=0.1, start=first.state)
    assert rest.rungs["hoist"].reason == "as in the state it goes on from, at 2 s"
    rest.advance(4.0)
    assert_allclose(rest.state.values, whole.state.values, rtol=1e-6, atol=1e-7)  # other steps
    scene = heaved()
    scene.replace("hoist", rung="elastic")
    other = simulate(scene, 1.0).state
    assert rung_of(heaved(), 2.0, start=other)[0] == "elastic"
    result = simulate(heaved(), 0.5, dt_out=0.1)
    result.save(tmp_path / "a.nc")
    again = Result.load(tmp_path / "a.nc")
    assert again.stats["line_rungs"] == result.stats["line_rungs"]


def test_rest_modes_and_files_take_it_as_elastic(tmp_path: Path) -> None:
    scene = automatic(hung(stretch=0.0))
    elastic = hung(stretch=0.0)
    rest = equilibrium(scene)
    assert_allclose(rest.values, equilibrium(elastic).values, atol=1e-12)
    assert_allclose(natural_modes(scene).natural_period, natural_modes(elastic).natural_period)
    stiff = automatic(hung(stretch=0.0), EA=STIFF)
    settled = Run(stiff, 1.0, start=equilibrium(stiff))
    assert settled.rungs["hoist"].name == "quasi-static"
    settled.advance(1.0)
    assert_allclose(settled.state.values[2], equilibrium(stiff).values[2], atol=1e-9)
    scene.save(tmp_path / "scene.json")
    assert Scene.load(tmp_path / "scene.json") == scene


@pytest.mark.warns("UnitWarning")
def test_what_cannot_begin_anew_stays_elastic(tmp_path: Path) -> None:
    simulate_to_file(heaved(), tmp_path / "a.nc", 0.2, dt_out=0.1)
    told = Result.load(tmp_path / "a.nc").stats["line_rungs"]
    assert told.startswith("hoist: elastic: outputs leave memory")
    model = heaved().compile()
    assert rung_of(heaved(), model=model) == ("elastic", COMPILED)


@pytest.mark.warns("UnitWarning")
def test_inputs_that_jump_make_it_elastic() -> None:
    scene = heaved()
    scene.add_winch(line="hoist", lag=0.2)
    assert rung_of(scene)[0] == "quasi-static"
    controller = SampledController(function=lambda time, state: {"hoist.rate": 0.1}, period=0.1)
    result = simulate(scene, 0.3, dt_out=0.1, controllers=[controller])
    assert "inputs are set during the run" in result.stats["line_rungs"]
    assert result["line_pay_out_rate"][-1, 0] > 0.05
    run = Run(scene, 1.0)
    run.advance(0.2)
    with pytest.raises(SceneError, match=r"inputs: set at t = 0\.2 s in a run whose lines hoist 'auto' made"):
        run.set_inputs({"hoist.rate": 0.1})


def test_the_error_law_is_the_closed_form() -> None:
    """2 (s omega)^2 of (omega / own)^2 for slow motion, and no more than four times it for any."""
    omega = np.array([0.1, 0.2])
    error = tension_error(omega, settling=0.2, own=20.0)
    assert_allclose(error, 2.0 * (0.2 * omega) ** 2 * (omega / 20.0) ** 2, rtol=0.01)
    fast = np.geomspace(0.01, 1e3, 400)
    assert np.all(tension_error(fast, settling=0.2, own=20.0) < 4.0 * (fast / 20.0) ** 2)
    assert LARGEST_ERROR < 0.01


def shaken(rung: str) -> Scene:
    """A block whose short drop is faster than a load falls; the strain follows too late to go slack."""
    scene = heaved()
    drop = Curve.quintic(start_time=0.5, end_time=0.65, start=0.0, end=-0.1)
    scene.replace("guide.displacement", curve=drop)
    scene.replace("hoist", rung=rung)
    return scene


@pytest.mark.warns("UnitWarning")
def test_a_line_that_pushes_for_a_moment_is_told() -> None:
    with pytest.warns(PushingLineWarning, match=r"line 'hoist': pushes with .* its stretch is quasi-static"):
        out = simulate(shaken("quasi-static"), 1.0, dt_out=0.01)
    assert np.min(out["line_tension"]) < 0.0 < np.min(out["line_stretch"])
    assert "a jump at t = 0.5 s" in rung_of(shaken("auto"))[1]


@pytest.mark.warns("UnitWarning")
def test_one_that_auto_let_push_begins_anew(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("seacrane.run.line_rungs.LARGEST_RINGING", np.inf)
    monkeypatch.setattr("seacrane.run.line_rungs.LARGEST_ERROR", np.inf)
    with pytest.warns(LineRungWarning, match="and it pushed for a moment. 'auto' had chosen its rung"):
        out = simulate(shaken("auto"), 1.0, dt_out=0.01)
    assert np.min(out["line_tension"]) == 0.0
    assert np.array_equal(out["position"], simulate(shaken("elastic"), 1.0, dt_out=0.01)["position"])


@pytest.mark.warns("LargeSwingWarning")
def test_an_energy_that_does_not_close_is_told() -> None:
    scene = heaved(stiffness=1e10)
    scene.replace("hoist", rung="elastic")
    with pytest.warns(
        EnergyErrorWarning, match=r"run: energy_balance reaches .* this is not the scene's motion"
    ):
        result = simulate(scene, 4.0, dt_out=0.1, integrator="rk4", dt=0.02)
    assert "energy_balance reaches" in result.stats["validity"]


def slung(rung: str) -> Scene:
    """35 t on four slings below a block, which a slew lets swing."""
    scene = Scene(name="slung")
    scene.add_crane(base="ground", foot=(0.0, 0.0, 12.0), s1=2.0, s2=1.0, held=True)
    scene.add_hoist(
        mass=35e3, size=(6, 4, 4), length=5.0, EA=6e7, rung=rung, block_mass=1e3, winch={"lag": 0.2},
        slings={"angle_deg": 60, "EA": 5e7, "rung": rung},
    )  # fmt: skip
    turned = Curve.quintic(start_time=0.0, end_time=6.0, start=0.0, end=0.3)
    scene.replace("A.angle", kind="driver", curve=turned)
    return scene


def test_auto_goes_over_a_block_and_slings() -> None:
    held, chosen = (simulate(slung(rung), 10.0, channels=["line_tension"]) for rung in ("elastic", "auto"))
    assert set(re.findall(r": (elastic|quasi-static): ", str(chosen.stats["line_rungs"]))) == {"quasi-static"}
    assert chosen.stats["evaluations"] < 0.3 * held.stats["evaluations"]
    hoist = [run.select("line_tension", line="hoist") for run in (held, chosen)]
    settled = held.time > 1.0
    assert np.abs(hoist[1] - hoist[0])[settled].max() < 0.005 * hoist[0].mean()
    assert np.ptp(hoist[0][settled]) > 0.02 * hoist[0].mean()
