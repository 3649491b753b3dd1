"""Method and Outputs: the same values through every call, beside the words that stand for their parts."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from trade_scenes import pendulum

from seacrane import Method, Outputs, Run, SceneError, simulate, step_error
from seacrane.run.method import METHOD_WORDS, OUTPUT_WORDS, Shorthand

METHOD = Method(integrator="rk4", dt=0.05, formulation="redundant", maximum_step=0.5)
OUTPUTS = Outputs(dt_out=0.25, channels=["position"])
WORDS = {
    "integrator": "rk4", "dt": 0.05, "formulation": "redundant", "maximum_step": 0.5, "dt_out": 0.25,
    "channels": ["position"],
}  # fmt: skip


def test_values_and_words_make_the_same_run(tmp_path: Path) -> None:
    by_value = simulate(pendulum(), 1.0, method=METHOD, outputs=OUTPUTS)
    to_file = simulate(pendulum(), 1.0, to=tmp_path / "run.nc", method=METHOD, outputs=OUTPUTS)
    run = Run(pendulum(), 1.0, method=METHOD, outputs=OUTPUTS)
    assert run.advance(1.0)
    both = simulate(pendulum(), 1.0, method=METHOD, outputs=OUTPUTS, **WORDS)
    for other in (simulate(pendulum(), t_end=1.0, **WORDS), to_file.load(), run.result(), both):
        assert set(other) == {"position"}
        assert np.array_equal(other.time, by_value.time)
        assert np.array_equal(other["position"], by_value["position"])
        assert other.settings == by_value.settings
    recorded = {name: by_value.settings.get(name) for name in ("dt_out", "rtol", "dt", "maximum_step")}
    assert recorded == {"dt_out": 0.25, "rtol": 1e-6, "dt": 0.05, "maximum_step": 0.5}
    assert "dt" not in simulate(pendulum(), t_end=0.1).settings  # as passed
    assert METHOD.name == "redundant rk4 dt=0.05" and Method().name == "auto dopri5"
    step = Method(integrator="rk4", dt=0.05)
    by_words = step_error(pendulum(), t_end=2.0, integrator="rk4", dt=0.05, quantities=["position"])
    assert step_error(pendulum(), 2.0, method=step, quantities=["position"]) == by_words


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"rtol": 1e-3}, r"rtol=0.001 contradicts method"),
        ({"dt_out": 0.1}, r"dt_out=0.1 contradicts outputs, whose dt_out is 0.25"),
    ],
)
def test_a_word_that_contradicts_the_value_beside_it_is_refused(words: dict[str, Any], says: str) -> None:
    with pytest.raises((SceneError, TypeError), match=says):
        simulate(pendulum(), 1.0, **{"method": METHOD, "outputs": OUTPUTS, **words})


def test_every_word_has_its_place_and_every_field_its_word() -> None:
    assert set(Shorthand.__annotations__) == {*METHOD_WORDS, *OUTPUT_WORDS}
    assert set(METHOD_WORDS) == set(Method.__dataclass_fields__)
    assert set(OUTPUT_WORDS) == set(Outputs.__dataclass_fields__)


def test_beside_an_accuracy_a_method_may_hold_what_is_not_chosen() -> None:
    guarded = Method(formulation="redundant", maximum_step=0.1)
    result = simulate(pendulum(), 1.0, method=guarded, accuracy={"position": 1e-3})
    assert result.stats["formulation"] == "redundant"
    assert result.settings["maximum_step"] == 0.1
    with pytest.raises(SceneError, match=r"chooses integrator, rtol and dt itself, and dt=0\.1 is given"):
        simulate(pendulum(), 1.0, method=Method(dt=0.1), accuracy={"position": 1e-3})
