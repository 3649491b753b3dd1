"""Random lifts are the same however they are told: mirrored, turned, shifted, later, cut, in halves."""

from __future__ import annotations

from collections import Counter

import pytest
from random_lifts import judged

pytestmark = pytest.mark.filterwarnings("ignore::UserWarning")


def found(seeds: range) -> tuple[Counter[str], dict[int, dict[str, str]]]:
    told = {seed: judged(seed) for seed in seeds}
    how = Counter(went.split(":")[0] for went, _ in told.values())
    return how, {seed: wrong for seed, (_, wrong) in told.items() if wrong}


def test_some() -> None:
    how, wrong = found(range(200, 203))
    assert wrong == {}
    assert how["run"] == 3, how


@pytest.mark.slow("dozens of random lifts, each in eight views")
def test_many() -> None:
    how, wrong = found(range(300, 360))
    assert wrong == {}
    assert how["run"] > 50, how
