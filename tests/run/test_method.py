"""Method and Outputs: the same values through every call, beside the words that stand for their parts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trade_scenes import pendulum

from seacrane import Method, Outputs, Run, SceneError, simulate, simulate_to_file, step_error
from seacrane.run.shorthand import METHOD_WORDS, OUTPUT_WORDS, Shorthand

METHOD = Method(integrator="rk4", dt=0.05, formulation="redundant", maximum_step=0.5)
OUTPUTS = Outputs(dt_out=0.25, channels=["position"])
WORDS: dict[str, Any] = {
    "integrator": "rk4", "dt": 0.05, "formulation": "redundant", "maximum_step": 0.5, "dt_out": 0.25,
    "channels": ["position"],
}  # fmt: skip


def test_values_and_words_make_the_same_run(tmp_path: Path) -> None:
    by_value = simulate(pendulum(), 1.0, method=METHOD, outputs=OUTPUTS)
    by_words = simulate(pendulum(), t_end=1.0, **WORDS)
    to_file = simulate_to_file(pendulum(), tmp_path / "run.nc", 1.0, method=METHOD, outputs=OUTPUTS)
    run = Run(pendulum(), 1.0, method=METHOD, outputs=OUTPUTS)
    assert run.advance(1.0)
    for other in (by_words, to_file.load(), run.result()):
        assert set(other) == {"position"}
        assert np.array_equal(other.time, by_value.time)
        assert np.array_equal(other["position"], by_value["position"])
        assert other.settings == by_value.settings


def test_settings_are_recorded_as_passed_and_what_is_left_out_is_absent() -> None:
    def settings(**words: Any) -> dict[str, Any]:
        found = simulate(pendulum(), t_end=0.1, **words).settings
        return {name: found[name] for name in found if name not in ("orientation", "baumgarte")}

    assert settings() == {"t_end": 0.1, "dt_out": 0.1, "rtol": 1e-6}
    assert settings(**WORDS) == {"t_end": 0.1, "dt_out": 0.25, "rtol": 1e-6, "dt": 0.05, "maximum_step": 0.5}


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"rtol": 1e-3}, r"rtol=0.001 contradicts method, whose rtol is None"),
        ({"integrator": "tsit5"}, r"integrator='tsit5' contradicts method, whose integrator is 'rk4'"),
        ({"dt": 0.1}, r"dt=0.1 contradicts method, whose dt is 0.05: leave dt out"),
        ({"dt_out": 0.1}, r"dt_out=0.1 contradicts outputs, whose dt_out is 0.25"),
        ({"channels": ["velocity"]}, r"contradicts outputs, whose channels is \('position',\)"),
    ],
)
def test_a_word_that_contradicts_the_value_beside_it_is_refused(words: dict[str, Any], says: str) -> None:
    with pytest.raises(SceneError, match=says):
        simulate(pendulum(), 1.0, method=METHOD, outputs=OUTPUTS, **words)


def test_a_word_that_repeats_the_value_beside_it_is_not() -> None:
    assert simulate(pendulum(), 0.5, method=METHOD, outputs=OUTPUTS, **WORDS).time.size == 3


@pytest.mark.parametrize(
    ("fields", "says"),
    [
        ({"rtol": 0.0}, "rtol is 0; give a positive number up to 0.1"),
        ({"rtol": "tight"}, "rtol is 'tight'; give a number"),
        ({"dt": -0.1}, "dt is -0.1 s; give a finite positive number, or leave it out"),
        ({"dt": 0.0}, "dt is 0.0 s"),
        ({"maximum_step": float("inf")}, "maximum_step is inf s"),
        ({"energy_limit": 0.0}, "energy_limit is 0.0; give a positive number"),
        ({"integrator": 3}, "integrator is 3; choose one of"),
        ({"formulation": "magic"}, "formulation 'magic' is unknown; choose auto"),
    ],
)
def test_a_method_that_makes_no_sense_is_refused_where_it_is_made(fields: dict[str, Any], says: str) -> None:
    with pytest.raises(SceneError, match=says):
        Method(**fields)


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"method": "rk4"}, "method is 'rk4'; give a seacrane.Method"),
        ({"outputs": 0.1}, "outputs is 0.1; give a seacrane.Outputs"),
    ],
)
def test_what_is_no_method_and_no_outputs_is_refused(given: dict[str, Any], says: str) -> None:
    with pytest.raises(SceneError, match=says):
        simulate(pendulum(), 1.0, **given)


def test_a_word_that_is_none_is_a_type_error_that_lists_them() -> None:
    with pytest.raises(
        TypeError, match=r"there is no 'tolerence', which is given as 0\.001; it takes scene, t_end, method"
    ):
        simulate(pendulum(), 1.0, tolerence=1e-3)  # type: ignore[call-arg]


def test_every_word_has_its_place_and_every_field_its_word() -> None:
    assert set(Shorthand.__annotations__) == {*METHOD_WORDS, *OUTPUT_WORDS}
    assert set(METHOD_WORDS) == set(Method.__dataclass_fields__)
    assert set(OUTPUT_WORDS) == set(Outputs.__dataclass_fields__)


def test_methods_are_values() -> None:
    same = Method(integrator="rk4", dt=0.05, formulation="redundant", maximum_step=0.5)
    assert same == METHOD and hash(same) == hash(METHOD) and hash(OUTPUTS)
    assert METHOD.name == "redundant rk4 dt=0.05"
    assert Method().name == "auto dopri5" and Method(rtol=1e-3).setting == "rtol=0.001"
    with pytest.raises(AttributeError):
        METHOD.dt = 0.1  # type: ignore[misc]


def test_the_error_of_a_step_takes_a_method_too() -> None:
    method = Method(integrator="rk4", dt=0.05)
    by_value = step_error(pendulum(), 2.0, method=method, quantities=["position"])
    by_words = step_error(pendulum(), t_end=2.0, integrator="rk4", dt=0.05, quantities=["position"])
    assert by_value == by_words
    with pytest.raises(SceneError, match="give the positive step whose error is asked for"):
        step_error(pendulum(), 2.0, integrator="rk4")


def test_beside_an_accuracy_a_method_may_hold_what_is_not_chosen() -> None:
    guarded = Method(formulation="redundant", maximum_step=0.1)
    result = simulate(pendulum(), 1.0, method=guarded, accuracy={"position": 1e-3})
    assert result.stats["formulation"] == "redundant"
    assert result.settings["maximum_step"] == 0.1
    with pytest.raises(SceneError, match=r"chooses integrator, rtol and dt itself, and dt=0\.1 is given"):
        simulate(pendulum(), 1.0, method=Method(dt=0.1), accuracy={"position": 1e-3})
