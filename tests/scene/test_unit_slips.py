"""Slips in a unit, by a factor of 1000: every number of every element is answered, or listed with why not."""

from __future__ import annotations

import tomllib
import warnings
from pathlib import Path

import numpy as np
import pytest
from slipped_scenes import SAMPLES

import seacrane
from seacrane import Scene, SeacraneError, _core, simulate

LIST = tomllib.loads((Path(__file__).parent / "unanswerable_slips.toml").read_text())
UNANSWERED = {slip: one["reason"] for one in LIST["reason"] for slip in one["slips"]}
FACTORS = {"x 1000": 1e3, "/ 1000": 1e-3}
SLIPS = {
    f"{name}: {key} {label}": (name, key, factor)
    for name, sample in SAMPLES.items()
    for key in sample.numbers
    for label, factor in FACTORS.items()
}
ELEMENTS = {
    *_core.LOAD_KINDS.values(), _core.Body, _core.Driver, _core.VesselHydrodynamics, _core.Point,
}  # fmt: skip
NO_QUANTITIES = {  # directions, angles that tables turn about, counts, shares of a line; a C function's own
    "Body.quaternion", "FlowForce.angles", "Line.axes", "Line.turns", "Line.share", "ImmersedSpan.share",
    "FunctionForce.parameters",
}  # fmt: skip


def told(name: str, key: str | None = None, factor: float = 1.0) -> list[str]:
    """What describing and stepping a sample says: names of warnings, and of the error that ended it."""
    sample, errors = SAMPLES[name], []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            scene = sample.scene(sample.numbers) if key is None else sample.slipped(key, factor)
            simulate(scene, t_end=0.2, dt_out=0.05)
        except (SeacraneError, ValueError) as error:
            errors = [type(error).__name__]
    return [*(warning.category.__name__ for warning in caught), *errors]


@pytest.mark.parametrize("name", SAMPLES)
def test_a_sample_without_a_slip_says_nothing(name: str) -> None:
    assert told(name) == []


def test_samples_hold_every_number_of_every_element() -> None:
    held = {f"{sample.kind.__name__}.{key}" for sample in SAMPLES.values() for key in sample.numbers}
    numbers = {
        f"{kind.__name__}.{field.name}"
        for kind in ELEMENTS
        for field in kind.FIELDS
        if field.type in ("number", "array", "curve") and field.role == "value"
    }
    assert numbers - NO_QUANTITIES <= held


def test_the_list_names_slips_that_are_there_once_with_reasons() -> None:
    listed = [slip for one in LIST["reason"] for slip in one["slips"]]
    assert set(listed) <= set(SLIPS) and len(set(listed)) == len(listed)
    assert all(len(reason.split()) >= 5 for reason in UNANSWERED.values())


@pytest.fixture(scope="module")
def answers() -> dict[str, list[str]]:
    return {slip: told(*of) for slip, of in SLIPS.items()}


def test_every_slip_is_answered_or_listed(answers: dict[str, list[str]]) -> None:
    assert {slip for slip, said in answers.items() if not said} <= set(UNANSWERED)


def test_what_is_listed_is_not_told_as_a_slip(answers: dict[str, list[str]]) -> None:
    """Runs that come to something else may tell of that."""
    errors = {kind.__name__ for kind in (seacrane.SceneError, seacrane.SimulationError)}
    told_all_the_same = {slip for slip in UNANSWERED if {"UnitWarning", *errors} & set(answers[slip])}
    assert told_all_the_same == set()


def test_most_slips_are_answered(answers: dict[str, list[str]]) -> None:
    assert len(UNANSWERED) <= 0.3 * len(SLIPS)


def test_values_that_are_meant_as_none_are_no_slips() -> None:
    """A bound of 1e7 is none, whether it was written or left out."""
    scene = Scene(name="bounds")
    scene.add_body(name="load", mass=2e4, inertia=[3e4] * 3, position=(0, 0, -15))
    scene.add_line(name="wire", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=5e7,
                   tension_at_start=2e4 * scene.gravity)  # fmt: skip
    scene.add_winch(line="wire", maximum_rate=1e7, maximum_acceleration=1e7, lag=0.2, maximum_tension=1e12)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        simulate(scene, t_end=0.2)
