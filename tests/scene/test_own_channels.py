"""Channels of one's own against NumPy on what was recorded; in files and stages; hostile texts."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal
from test_relative_motion import hoisting, tumbling

from seacrane import Kept, Result, Scene, Stage, Until, cases, ensemble, simulate, simulate_stages
from seacrane.analysis import linear_model
from seacrane.description.expression import DEEPEST, FUNCTIONS, LONGEST, parsed
from seacrane.description.file import scene_digest
from seacrane.errors import FileFormatError, SceneError
from seacrane.operability import Criterion
from seacrane.operability.linear_channels import linear_channels


def z(result: Result, body: str) -> Any:
    return result.select("position", body=body, axis="z")


def of_load(result: Result, axis: str, channel: str = "velocity") -> Any:
    return result.select(channel, body="load", axis=axis)


def corner(result: Result, axis: str) -> Any:
    return result.select("point_position", point="corner", axis=axis)


EXPRESSIONS: dict[str, tuple[str, str, Callable[[Result], Any]]] = {
    "sum": ("corner.z - load.z + 3 m", "m", lambda r: corner(r, "z") - z(r, "load") + 3.0),
    "signs": ("-load.z - -hull.z", "m", lambda r: -z(r, "load") + z(r, "hull")),
    "order": ("load.z - 2 * hull.z / 4 - 1 m", "m", lambda r: z(r, "load") - 2 * z(r, "hull") / 4 - 1),
    "left": ("load.z / 2 / 3 * 4", "m", lambda r: z(r, "load") / 2 / 3 * 4),
    "nested": ("(load.z - (hull.z - 2 m)) * 0.5", "m", lambda r: (z(r, "load") - (z(r, "hull") - 2.0)) * 0.5),
    "speed": ("hypot(velocity[load, x], velocity[load, axis=y])", "m/s",
              lambda r: np.hypot(of_load(r, "x"), of_load(r, "y"))),
    "root": ("sqrt(load.x * load.x + load.y * load.y)", "m",
             lambda r: np.sqrt(of_load(r, "x", "position") ** 2 + of_load(r, "y", "position") ** 2)),
    "angle": ("atan2(corner.y, corner.x)", "rad", lambda r: np.arctan2(corner(r, "y"), corner(r, "x"))),
    "most": ("max(abs(hull.z), load.z, 200 mm)", "m",
             lambda r: np.maximum(np.maximum(np.abs(z(r, "hull")), z(r, "load")), 0.2)),
    "least": ("min(load.z, hull.z)", "m", lambda r: np.minimum(z(r, "load"), z(r, "hull"))),
    "heel": ("heel[hull] - 10 deg", "rad", lambda r: r.select("heel", body="hull") - np.radians(10.0)),
    "power": ("1e3 kg * acceleration[load, z] * velocity[load, z]", "W",
              lambda r: 1e3 * of_load(r, "z", "acceleration") * of_load(r, "z")),
    "constant": ("2.5e1 kN", "N", lambda r: np.full(r.time.size, 25e3)),
}  # fmt: skip


def described(scene: Scene) -> Scene:
    for name, (text, _, _) in EXPRESSIONS.items():
        scene.add_channel(name, expression=text)
    return scene


def test_expressions_are_those_of_numpy_on_what_was_recorded() -> None:
    scene = described(tumbling())
    result = simulate(scene, 3.0)
    assert {"heel", "acceleration"} <= set(result)  # on request, and recorded by themselves
    for name, (_, unit, expected) in EXPRESSIONS.items():
        assert scene.channels[name].unit == unit
        values = result.curve(f"own[{name}]")
        assert values.shape == result.time.shape
        assert_allclose(values, expected(result), rtol=4e-16, atol=1e-15, err_msg=name)
    assert np.ptp(result.curve("own[speed]")) > 0.0 or np.ptp(result.curve("own[angle]")) > 0.1
    alone = simulate(scene, 3.0, channels=["own"])
    assert list(alone) == ["own"] and alone.coords["expression"] == tuple(EXPRESSIONS)
    assert_array_equal(alone["own"], result["own"])
    assert "own" not in simulate(tumbling(), 0.1)


def test_a_limit_state_a_criterion_and_what_is_kept_take_it() -> None:
    scene = tumbling()
    scene.add_channel("over", expression="load.z - hull.z")
    scene.add_limit_state("own[over]", minimum=5.0)
    result = simulate(scene, 2.0)
    lowest = result.curve("own[over]").min()
    assert result.utilisation[0].utilisation == pytest.approx(5.0 / lowest)
    assert Criterion(channel="own[over]", minimum=5.0).names == {"expression": "over"}
    assert Kept.of_text("own[over].min").of(result).values == pytest.approx(lowest)


def test_a_stage_ends_where_it_says(tmp_path: Path) -> None:
    scene = hoisting()
    scene.add_channel("raised", expression="load.z + 10 m")
    scene.add_channel("slack", expression="line_unstretched_length[wire] - 2 m")
    up = {"until": Until.channel("own[raised]", minimum=1.0), "maximum_duration": 20.0}
    stages = [Stage(name="up", **up), Stage(name="on", duration=1.0)]
    for asked in (None, ["own", "position", "hook_speed"]):
        result = simulate_stages(scene, stages, dt_out=0.05, channels=asked)
        end = result.stages[0].end
        assert 1.5 < end < 3.0
        assert np.interp(end, result.time, result.curve("own[raised]")) == pytest.approx(1.0, abs=1e-3)
        assert_allclose(result.curve("own[raised]"), result.curve("position[load, z]") + 10.0, atol=1e-12)
    assert "hook_speed" in result
    assert_array_equal(Result.load(result.save(tmp_path / "run.nc"))["own"], result["own"])


def test_files_keep_it_and_digests_tell_it(tmp_path: Path) -> None:
    scene = tumbling()
    digest, path = scene_digest(scene), tmp_path / "scene.json"
    scene.save(path)
    assert not Scene.load(path).channels
    described(scene)
    assert scene_digest(scene) != digest and scene_digest(tumbling()) == digest
    scene.save(path)
    assert Scene.load(path).channels == scene.channels
    path.write_text(path.read_text().replace("corner.z", "croner.z"))
    with pytest.raises(FileFormatError, match=r"no point or body 'croner'; did you mean 'corner'\?"):
        Scene.load(path)


NEEDED, DEEP = "number or a curve was expected at", f"more than {DEEPEST} parentheses"
REFUSED = [
    ("load.z + heel[hull]", r"'\+' is of m and rad"), ("load.z - 3", "'-' is of m and 1.*'3 m'"),
    ("hypot(load.z, velocity[load, z])", "'hypot' is of m and m/s"), ("lod.z", "'lod'; did you mean 'load'"),
    ("sqr(load.z)", "function 'sqr'; did you mean 'sqrt'"), ("atan2(load.z)", "atan2 has 1 arguments.*2"),
    ("load.z load.x", "operator or the end .* at 'load.x'"), ("(load.z", r"'\)' was expected at its end"),
    ("", f"channel 'a' is '': a {NEEDED}"), ("1e999 m", "'1e999' is no finite number"),
    ("own[a]", "is a channel of your own too"), ("slew_angle", "slew_angle counts on over a whole run"),
    ("load_state", "load_state is in SI"), ("vessel_motion", "one unit"),
    ("position[load, z, after=3]", "leave after out"), ("__import__('os').system('true')", "is no part"),
    ("load.z ** 2", rf"{NEEDED} '\*'"), ("(" * 100 + "load.z" + ")" * 100, DEEP),
    ("-" * 900 + "load.z", DEEP), ("load.z+" * 500 + "load.z", f"3506 characters, above {LONGEST}"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "told"), REFUSED, ids=[row[0][:30] for row in REFUSED])
def test_what_makes_no_sense_is_refused_by_name(text: str, told: str) -> None:
    scene = tumbling()
    with pytest.raises(SceneError, match=told) as caught:
        scene.add_channel("a", expression=text)
    assert str(caught.value).startswith("channel 'a'") and len(str(caught.value)) < 500
    assert not scene.channels


def test_names_that_the_scene_does_not_have_end_before_a_run() -> None:
    scene = hoisting()
    scene.add_channel("a", expression="line_tension[wier]")
    with pytest.raises(SceneError, match=r"channel 'a': line_tension.*'wier'; did you mean 'wire'"):
        simulate(scene, 0.1)


def test_a_name_of_a_point_and_a_body_is_told_apart() -> None:
    scene = tumbling()
    scene.add_point(name="load", body="hull", point=(0, 0, 0))
    with pytest.raises(SceneError, match=r"point and a body; write point_position\[load, z\] or position"):
        scene.add_channel("a", expression="load.z")
    scene.add_point(name="corner 0", body="hull", point=(0, 0, 0))
    scene.add_channel("a", expression="'corner 0'.z - \"corner 0\".x")
    assert scene.channels["a"].unit == "m"


def test_random_texts_are_read_or_refused() -> None:
    """Pieces of expressions in any order: nothing but a program or a SceneError comes of them."""
    parts = [*FUNCTIONS, "load.z", "'a b'.x", "p[q, r]", "roll", "3", "1e9", ".5 m", "kN", "(", ")",
             ",", "+", "-", "*", "/", "[", "]", "'", '"', ".", "=", "\u00b2", "\0", "9" * 400]  # fmt: skip
    draw, read = random.Random(7), 0
    for _ in range(20_000):
        text = draw.choice(["", " "]).join(draw.choices(parts, k=draw.randint(1, 12)))
        try:
            read += len(parsed("fuzz", text)) > 0
        except SceneError as error:
            assert str(error).startswith("fuzz")
    assert read > 500


def test_ensembles_and_linear_models_take_it() -> None:
    scene = cases.vessel(hs=1.0, tp=8.0)
    scene.add_channel("bow", expression="vessel_motion[heave] - 60 m * vessel_motion[pitch] / 1 rad")
    kept = ensemble(scene, over={"seed": [1, 2]}, keep={"bow": "own[bow].max"}, t_end=10.0)
    assert not kept.failures
    values = kept.dataset["bow"].values
    assert values.shape == (2,) and values[0] != values[1]
    motions = [Criterion(channel=channel, maximum=1.0) for channel in ("own[bow]", "heave", "pitch")]
    known = linear_channels(linear_model(scene), motions)
    assert_allclose(known.c[0], known.c[1] - 60.0 * known.c[2], atol=1e-9)
