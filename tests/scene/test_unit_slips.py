"""Slips in a unit, by a factor of 1000: every number of every element is answered, or listed with why not."""

from __future__ import annotations

import tomllib
import warnings
from fnmatch import fnmatchcase
from pathlib import Path

import numpy as np
import pytest
from slipped_scenes import MASS, SAMPLES, with_load
from where import at, in_header_of

import seacrane
from seacrane import SeacraneError, _core, simulate

LIST = tomllib.loads((Path(__file__).parent / "unanswerable_slips.toml").read_text())
FACTORS = {"x 1000": 1e3, "/ 1000": 1e-3}
SLIPS = {
    f"{name}: {key} {label}": (name, key, factor)
    for name, sample in SAMPLES.items()
    for key in sample.numbers
    for label, factor in FACTORS.items()
}
ELEMENTS = {*_core.LOAD_KINDS.values(), _core.Body, _core.Driver, _core.VesselHydrodynamics, _core.Point}
NO_QUANTITIES = {  # directions, angles that tables turn about, counts, shares of a line; a C function's own
    "Body.quaternion", "FlowForce.angles", "Line.axes", "Line.turns", "Line.share", "ImmersedSpan.share",
    "FunctionForce.parameters",
}  # fmt: skip


def told(name: str, key: str | None = None, factor: float = 1.0) -> list[str]:
    """What describing and stepping a sample says: names of warnings, and of the error that ended it."""
    sample, errors = SAMPLES[name], []
    with warnings.catch_warnings(record=True, action="always") as caught:
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
    place = at("tests/scenes/slipped_scenes.py", "SAMPLES")
    assert numbers - NO_QUANTITIES <= held, f"{place}: no sample has {numbers - NO_QUANTITIES - held}"


def test_every_slip_is_answered_or_listed_once_with_a_reason_and_most_are_answered() -> None:
    """What is listed is not told as a slip; runs that come to something else may tell of that."""
    listed = [slip for one in LIST["reason"] for slip in one["slips"]]
    alike = {slip for slip in SLIPS for words in listed if "*" in words and fnmatchcase(slip, words)}
    exact = [words for words in listed if "*" not in words]
    assert set(exact) <= set(SLIPS) - alike and len(set(exact)) == len(exact)
    assert all(len(one["reason"].split()) >= 5 for one in LIST["reason"])
    answers = {slip: told(*of) for slip, of in SLIPS.items()}
    silent = {slip for slip, said in answers.items() if not said}
    assert silent <= alike | set(exact), "\n".join(map(lacking, silent - alike - set(exact)))
    assert len(silent) <= 0.3 * len(SLIPS)
    errors = {kind.__name__ for kind in (seacrane.SceneError, seacrane.SimulationError)}
    assert {slip for slip in exact if {"UnitWarning", *errors} & set(answers[slip])} == set()


def lacking(slip: str) -> str:
    """Where what tells a slip belongs."""
    place, sampled = at("tests/scene/unanswerable_slips.toml", "[[reason]]"), SAMPLES[SLIPS[slip][0]].kind
    for kind, type_ in _core.LOAD_KINDS.items():
        place = in_header_of(kind) if type_ is sampled and kind != "limit" else place
    return f"{place}: nothing tells {slip}; give it `usually` or `proportions`, or the list a reason"


def test_values_that_are_meant_as_none_are_no_slips() -> None:
    """A bound of 1e7 is none, whether it was written or left out."""
    scene, wire = with_load(), {"bodies": ["ground", "load"], "points": np.zeros((2, 3))}
    scene.add_line(name="wire", EA=5e7, tension_at_start=MASS * scene.gravity, **wire)
    scene.add_winch("wire", maximum_rate=1e7, maximum_acceleration=1e7, lag=0.2, maximum_tension=1e12)
    simulate(scene, t_end=0.2)
