"""What an ensemble costs, told before it is run, by members that count as done."""

from __future__ import annotations

import itertools
from pathlib import Path
from typing import Any

import named
import pytest
from ensemble_studies import HEAVE_STUDY

from seacrane import Scene, ensemble
from seacrane.cli.command_line import main
from seacrane.ensembles import Ensemble, Price, ensemble_price
from seacrane.warnings import FailedMembersWarning

CLOCK = "seacrane.ensembles.job.thread_time"
HEIGHT: dict[str, Any] = {"keep": {"low": "position[bob, z].min"}, "t_end": 0.2}


class Priced:
    """A clock that scenes drive: describing the one of mass m takes m seconds, all else takes none."""

    def __init__(self) -> None:
        self.now = 0.0

    def scene(self, *, mass: float) -> Scene:
        self.now += mass
        return named.pendulum(mass=mass)


@pytest.mark.parametrize(
    ("count", "measured", "core_s"),  # a linear cost is the count times that of the middle: by hand
    [(20, 4, 210.0), (40, 8, 820.0), (3, 2, 6.0), (1, 1, 1.0)],
)
def test_the_price_of_a_cost_known_by_hand(
    count: int, measured: int, core_s: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = Priced()
    monkeypatch.setattr(CLOCK, lambda: clock.now)
    given = {"over": {"mass": [*range(1, count + 1)]}, "pack": 1, "store": tmp_path / "store", **HEIGHT}
    price = ensemble_price(clock.scene, **given)
    assert price is not None and (price.members, price.measured) == (count, measured)
    assert price.core_hours == pytest.approx(core_s / 3600.0)
    files = {one: one.stat().st_mtime_ns for one in (tmp_path / "store").glob("pack_*.nc")}
    assert len(files) == measured
    told: list[Price | None] = []
    done = ensemble(clock.scene, **given, priced=lambda one: told.append(one) is None)
    assert [one and one.members for one in told] == ([count - measured] if count > measured else [None])
    assert {one: one.stat().st_mtime_ns for one in files} == files  # they are not run again
    assert price.bytes == sum(one.stat().st_size for one in (tmp_path / "store").glob("pack_*.nc"))
    assert done.dataset.identical(ensemble(clock.scene, **given | {"store": None}).dataset)


def test_what_begins_and_what_is_stepped_by_ticks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each reading of the clock takes 1 s: a member begins in 1 s, two together are stepped in 1 s."""
    monkeypatch.setattr(CLOCK, itertools.count().__next__)
    price = ensemble_price(named.pendulum, over={"mass": [*range(1, 21)]}, pack=2, **HEIGHT)
    assert price is not None and price.core_hours == pytest.approx(20 * 1.5 / 3600.0)
    assert price.bytes == 20 * 8 and not price.at_most


def test_a_price_says_where_its_members_failed() -> None:
    """They took no time: what it tells would be no price of any that succeed."""
    with pytest.warns(FailedMembersWarning, match=r"4 of 20 members failed"):
        assert ensemble_price(failing, over={"mass": [*range(1, 21)]}, pack=1, **HEIGHT)


def failing(*, mass: float) -> Scene:
    raise ValueError(f"no load of {mass} kg")


def test_the_price_of_seeds_until_it_is_enough(tmp_path: Path) -> None:
    given: dict[str, Any] = {
        "over": {"seed": range(1, 61), "mass": [1.0, 2.0]}, "until": {"low.mean": 0.9},
        "store": tmp_path / "store", **HEIGHT,
    }  # fmt: skip
    price = ensemble_price(seeded, **given)
    assert price is not None and price.at_most and price.members == 120
    assert str(price).startswith("price: at most ")
    again = ensemble_price(seeded, **given)  # of the others of the first batch, and of all later ones
    assert again is not None and again.members == 120 - price.measured
    ensemble(seeded, **given)
    assert ensemble_price(seeded, **given) is None


def seeded(*, seed: int, mass: float) -> Scene:
    return named.pendulum(mass=mass, arm=1.0 + 1e-3 * seed)


def test_the_command_tells_it_first_and_price_alone_stops(tmp_path: Path, capsys: Any) -> None:
    (file := tmp_path / "heave.toml").write_text(HEAVE_STUDY)
    command = ["study", str(file), "--out", str(tmp_path / "out")]
    assert main([*command, "--price"]) == 0
    told = capsys.readouterr().out
    assert told.startswith("price: ") and told.count("\n") == 1 and "for 80 members" in told
    few = int((Ensemble.load(tmp_path / "out" / "members").dataset.failure == "").sum())
    assert f"by the {few} of them that are done" in told and 0 < few < 80
    assert main(command) == 0
    assert capsys.readouterr().out.splitlines()[0].endswith("that are done")
    assert main([*command, "--price"]) == 0
    assert "no member is left" in capsys.readouterr().out
