"""A rope is one element with rungs: what each makes, and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from seacrane import (
    Run,
    Scene,
    SceneError,
    _core,
    cases,
    ensemble,
    simulate,
)
from seacrane.errors import LineSlackError
from seacrane.warnings import LineRungWarning

G = 9.80665


def with_load(**body: Any) -> Scene:
    scene = Scene()
    given: dict[str, Any] = {"mass": 20e3, "inertia": (1e4, 1e4, 1e4), "position": (0.0, 0.0, -10.0)}
    scene.add_body(name="load", **given | body)
    return scene


THROWN = {"position": (0.3, 0.0, -10.0), "velocity": (1.0, 0.0, 0.5)}
BETWEEN = {"name": "hoist", "first": "ground", "second": "load"}


def wire() -> Scene:
    scene = with_load(**THROWN)
    scene.add_line(**BETWEEN, rung="rigid", restitution=0.3)
    return scene


def stretching(rung: str, **body: Any) -> Scene:
    scene = with_load(**body)
    scene.add_line(**BETWEEN, EA=1e9, tension_at_start=20e3 * G, rung=rung)
    return scene


def chain() -> Scene:
    scene = with_load(position=(0.3, 0.0, -100.0), velocity=(1.0, 0.0, 0.0))
    scene.add_line(
        **BETWEEN, rung="with mass", EA=2e8, length=99.9, mass_per_length=12.0, segments=5,
        segment_rung="quasi-static", diameter=0.05,
    )  # fmt: skip
    return scene


# The tension (N) of the first line and the load's x, y, z (m) at 3 s.
KNOWN: dict[str, tuple[Callable[[], Scene], str, float, tuple[float, float, float]]] = {
    "wire": (wire, "tension", 198326.008491, (-0.118620040802, 0, -10.0037957439)),
    "elastic": (
        lambda: stretching("elastic", **THROWN), "line_tension",
        216466.862067, (-0.118747381902, 0, -10.0039964009),
    ),
    "quasi-static": (
        lambda: stretching("quasi-static", velocity=(0.0, 0.2, 0.0)), "line_tension",
        196209.564468, (0, 0.0343309442861, -9.99994201493)
    ),
    "auto": (lambda: stretching("auto"), "line_tension", 196132.999812, (0, 0, -10.0000000001)),
    "heavy_quasi-static": (chain, "line_tension", 206658.533701, (2.74968337358, 0, -99.9630055773)),
}  # fmt: skip


@pytest.mark.parametrize("kind", KNOWN)
def test_each_rung_runs_as_it_did(kind: str) -> None:
    make, channel, tension, place = KNOWN[kind]
    result = simulate(make(), 3.0)
    assert result[channel][-1].ravel()[0] == pytest.approx(tension, rel=1e-9)
    assert result.select("position", body="load")[-1] == pytest.approx(place, rel=1e-9, abs=1e-9)


def test_a_line_of_two_bodies_runs_as_it_stands() -> None:
    scene = Scene()
    scene.add_body(name="load", mass=20e3, size=(2, 2, 3), position=(0, 0, -10))
    hoist = scene.add_line(name="hoist", first="ground", second="load", EA=3e7)
    assert np.array_equal(hoist.points, [(0.0, 0.0, 0.0), (0.0, 0.0, 1.5)])
    assert float(hoist.length.evaluate([0.0])[0, 0]) == 8.5
    result = simulate(scene, 10)
    assert result["line_tension"].max() < 3.0 * 20e3 * G


def test_a_line_is_tied_above_the_center_of_a_body_with_a_size_else_to_its_origin() -> None:
    scene = with_load(size=(2.0, 2.0, 4.0), center_of_mass=(0.1, 0.2, -0.3))
    scene.add_body(name="hook", mass=100.0, inertia=(1.0, 1.0, 1.0), position=(0.0, 0.0, -3.0))
    lower = scene.add_line(name="lower", first="hook", second="load", EA=1e7)
    assert np.array_equal(lower.points, [(0.0, 0.0, 0.0), (0.1, 0.2, 1.7)])
    upper = scene.add_line(
        name="upper", first="ground", second="hook", EA=1e7, first_point=(0, 0, 1), second_point=(0, 0, 0.5)
    )
    assert np.array_equal(upper.points, [(0.0, 0.0, 1.0), (0.0, 0.0, 0.5)])


def test_a_joint_becomes_a_rigid_line_and_a_rod_stays_a_joint() -> None:
    scene = cases.case2()
    limit = scene.add_line(joint="link", rung="rigid")
    assert (limit.name, limit.kind, limit.joint) == ("link", "wire", "link")
    assert scene.joints["link"].kind == "distance"


def test_what_is_returned_is_what_the_scene_holds() -> None:
    assert wire().loads["hoist"].kind == "wire"
    scene = with_load()
    assert scene.add_line(**BETWEEN, EA=1e7) is scene.loads["hoist"]
    segments = with_load().add_line(**BETWEEN, rung="with mass", EA=1e7, mass_per_length=10.0, segments=3)
    assert [one.name for one in segments] == ["hoist.1", "hoist.2", "hoist.3"]


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    "no such rung": ({"rung": "stiff"}, "rung is 'stiff'; choose one of 'rigid', 'quasi-static'"),
    "EA of a rigid one": ({"rung": "rigid", "EA": 1e7}, "rung 'rigid' takes no EA; leave it out"),
    "a rigid one with tension": (
        {"rung": "rigid", "tension_at_start": 1e3}, "rung 'rigid' takes no tension_at_start"
    ),
    "sheaves of a rigid one": ({"rung": "rigid", "radii": [0, 1, 0]}, "rung 'rigid' takes no radii"),
    "a rebound of an elastic one": (
        {"EA": 1e7, "restitution": 0.5}, "takes no restitution; leave it out, or choose rung 'rigid'"
    ),
    "mass of an elastic one": ({"EA": 1e7, "mass_per_length": 5.0}, "or choose rung 'with mass'"),
    "a joint of an elastic one": ({"EA": 1e7, "joint": "link"}, "rung 'elastic' takes no joint"),
    "a table of one with mass": (
        {"rung": "with mass", "EA": 1e7, "strains": [0, 1], "tensions": [0, 1]}, "takes no strains"
    ),
    "no mass of one with mass": ({"rung": "with mass", "EA": 1e7}, "mass_per_length is 0.0; give a finite"),
    "no EA": ({}, "has no EA; give it in N"),
    "a path told twice": ({"EA": 1e7, "bodies": ["ground", "load"]}, "beside other words for its path"),
    "a rigid curve": ({"rung": "rigid", "length": _core.Curve.constant(value=9.0)}, "length is .* give a n"),
}  # fmt: skip


@pytest.mark.parametrize("what", REFUSED)
def test_what_a_rung_does_not_take_is_refused_by_name(what: str) -> None:
    given, message = REFUSED[what]
    scene = with_load()
    with pytest.raises(SceneError, match=f"line 'hoist': .*{message}"):
        scene.add_line(**BETWEEN | given)
    assert not scene.loads and not scene.joints and list(scene.bodies) == ["load"]


def test_a_rigid_line_runs_between_two_bodies() -> None:
    with pytest.raises(SceneError, match="rung 'rigid' runs between two bodies, and bodies has 3 names"):
        with_load().add_line(
            name="hoist", rung="rigid", bodies=["ground", "load", "ground"], points=np.zeros((3, 3))
        )


def test_a_rigid_line_takes_no_winch() -> None:
    with pytest.raises(SceneError, match="line 'hoist': rung 'rigid' takes no winch; choose rung 'elastic'"):
        wire().add_winch(line="hoist")


def test_a_described_line_is_changed_by_the_words_that_it_has() -> None:
    scene = stretching("elastic")
    with pytest.raises(SceneError, match=r"cannot change 'stretch'; it has .*EA.* rung"):
        scene.replace("hoist", stretch="auto")
    assert scene.replace("hoist", rung="auto").rung == "auto"


def over_the_top() -> Scene:
    """A load too slow for the highest point of its circle; as quasi-static its line goes slack at 1.5 s."""
    speed = np.sqrt(3.5 * G * 10.0)
    scene = with_load(velocity=(speed, 0.0, 0.0))
    scene.add_line(**BETWEEN, EA=2e9, tension_at_start=20e3 * (G + speed**2 / 10.0), rung="auto")
    return scene


def test_a_run_ends_where_auto_was_wrong_and_keeps_what_it_recorded() -> None:
    run = Run(over_the_top(), 2.5, dt_out=0.1)
    assert run.settled == ["hoist"]
    with pytest.raises(LineSlackError, match="line 'hoist': its stretch is quasi-static, and it goes slack"):
        run.advance(2.5)
    assert run.result().time[-1] > 1.0
    again = run.with_elastic_lines("it went slack")
    assert again.core.time == 0.0 and again.settled == []
    assert again.advance(2.5)


@pytest.mark.warns("LargeSwingWarning")
def test_the_second_run_that_simulate_takes_is_the_elastic_one() -> None:
    with pytest.warns(LineRungWarning, match="a second run from the same start, with elastic lines"):
        result = simulate(over_the_top(), 2.5, dt_out=0.1)
    elastic = over_the_top()
    elastic.replace("hoist", rung="elastic")
    assert np.array_equal(result["position"], simulate(elastic, 2.5, dt_out=0.1)["position"])
    kept = ensemble(
        over_the_top(), over={"gravity": [G]}, keep={"top": "line_tension.max"}, t_end=2.5, dt_out=0.1
    )
    assert kept.dataset.top.item() == result.reached("line_tension")[1].max()


def test_inputs_that_will_be_set_make_a_run_elastic_before_it() -> None:
    scene = stretching("auto")
    scene.add_winch(line="hoist", lag=0.2)
    with pytest.raises(SceneError, match=r"inputs: set at t = 0 s .* give the Run controlled=True"):
        Run(scene, 1.0).set_inputs({"hoist.rate": 0.1})
    run = Run(scene, 1.0, controlled=True)
    run.set_inputs({"hoist.rate": 0.1})
    assert run.rungs["hoist"].reason == "inputs are set during the run, and their jumps may make it ring"
