"""Ensembles into a Zarr group: the numbers of any other store, one member a chunk, nothing lost."""

from __future__ import annotations

import contextlib
import os
import resource
import signal
import subprocess
import sys
import time
import warnings
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from ensemble_studies import (
    KEEP,
    SWING,
    fails_in_the_middle,
    lowest,
    pendulum,
    short_or_long,
    storm,
    two_numbers_or_three,
)

from seacrane import FileFormatError, Kept, SceneError, ensemble
from seacrane.ensembles import Ensemble

zarr: Any = pytest.importorskip("zarr", reason="Zarr is not installed: pip install 'seacrane[zarr]'")

GRID = {"start": [1.0, 2.0, 3.0], "mass": [2.0, 5.0]}
PUSHED: dict[str, Any] = {
    "source": storm,
    "over": {"seed": range(1, 61), "height": [1.0, 2.0]},
    "keep": {"far": Kept(channel="position", what="maximum", names={"body": "bob", "axis": "x"})},
    "t_end": 1.0,
    "dt_out": 0.5,
}


@pytest.mark.parametrize("pack", [1, 4])
def test_it_holds_what_memory_does(pack: int, tmp_path: Path) -> None:
    plain = ensemble(pendulum, over=GRID, keep=KEEP, **SWING)
    with ThreadPoolExecutor(2) as executor:
        there = ensemble(
            pendulum, over=GRID, keep=KEEP, store=tmp_path / "a.zarr", executor=executor, pack=pack, **SWING
        )
    for found in (there, Ensemble.load(tmp_path / "a.zarr")):
        assert found.dataset.identical(plain.dataset)
        assert found.members == plain.members
        assert found.dataset.track.sel(start=2.0, mass=5.0, axis="z", time=0.5) == plain.dataset.track.sel(
            start=2.0, mass=5.0, axis="z", time=0.5
        )


def test_others_open_it_and_every_member_is_a_chunk(tmp_path: Path) -> None:
    plain = ensemble(pendulum, over=GRID, keep=KEEP, store=tmp_path / "a.zarr", **SWING)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = xarray.open_zarr(tmp_path / "a.zarr", chunks=None)
    assert found.track.dims == ("start", "mass", "time", "axis")
    assert found.track.attrs["units"] == "m"
    assert np.array_equal(found.track, plain.dataset.track)
    group = zarr.open_group(tmp_path / "a.zarr", mode="r")
    assert group["track"].chunks == (1, 1, 5, 3)
    assert group["lowest"].chunks == (1, 1)


def test_rows_and_texts_vary_too(tmp_path: Path) -> None:
    given: dict[str, Any] = {
        "source": pendulum,
        "over": [{"start": 1.0}, {"start": 2.5}],
        "keep": {"lowest": lowest, "short": Kept(channel="position", interval=1.0), "track": KEEP["track"]},
        **SWING,
    }
    plain = ensemble(**given)
    there = ensemble(**given, store=tmp_path / "a.zarr")
    assert {"time_short", "time_track"} <= set(map(str, there.dataset.dims))
    assert there.dataset.identical(plain.dataset)


@pytest.mark.warns("FailedMembersWarning")
def test_members_that_fail_are_told(tmp_path: Path) -> None:
    starts = {"start": [1.0, 2.0, 3.0, 4.0]}
    there = ensemble(
        fails_in_the_middle, over=starts, keep={"lowest": lowest}, store=tmp_path / "a.zarr", **SWING
    )
    assert there.failures == {2: "ValueError: no such start"}
    assert np.isnan(there.dataset.lowest.to_numpy()).tolist() == [False, False, True, False]
    other = ensemble(
        short_or_long, over={"start": [1.0, 2.0, 3.0]}, keep={"numbers": two_numbers_or_three},
        store=tmp_path / "b.zarr", **SWING,
    )  # fmt: skip
    assert list(other.failures) == [2]
    assert "numbers has dimensions" in other.failures[2]


SLOW = """
import sys
from ensemble_studies import lowest, pendulum
from seacrane import Kept, ensemble
ensemble(pendulum, over={"start": [1.0 + 0.01 * k for k in range(100)]}, keep={"lowest": lowest,
         "track": Kept(channel="position", interval=0.5)}, t_end=30.0, rtol=1e-9, store=sys.argv[1])
"""


@pytest.mark.slow("kills processes")
def test_a_killed_ensemble_goes_on_to_the_same_bits(tmp_path: Path) -> None:
    store = tmp_path / "a.zarr"
    path = os.pathsep.join([str(Path(__file__).parent), os.environ.get("PYTHONPATH", "")])
    child = subprocess.Popen([sys.executable, "-c", SLOW, str(store)], env={**os.environ, "PYTHONPATH": path})
    until = time.monotonic() + 60.0
    while len(list(store.glob("*/pack_*.json"))) < 5 and time.monotonic() < until:
        time.sleep(0.01)
    child.send_signal(signal.SIGKILL)
    child.wait()
    left = Ensemble.load(store).dataset.load()
    done = (left.failure == "").to_numpy()
    assert 5 <= done.sum() < 100
    ran: list[float] = []

    def counted(**values: Any) -> Any:
        ran.append(values["start"])
        return pendulum(**values)

    counted.__module__, counted.__qualname__ = pendulum.__module__, pendulum.__qualname__
    counted.__wrapped__ = pendulum  # type: ignore[attr-defined]
    given: dict[str, Any] = {
        "over": {"start": [1.0 + 0.01 * k for k in range(100)]},
        "keep": {"lowest": lowest, "track": Kept(channel="position", interval=0.5)},
        "t_end": 30.0,
        "rtol": 1e-9,
    }
    whole = ensemble(counted, store=store, **given)
    # First and last stand for the study; those that were being written may come again.
    assert len(ran) <= 100 - done.sum() + 4
    assert np.array_equal(left.track.to_numpy()[done], whole.dataset.track.to_numpy()[done])
    assert whole.dataset.identical(ensemble(pendulum, **given).dataset)


def test_it_grows_until_it_is_enough(tmp_path: Path) -> None:
    store = tmp_path / "a.zarr"
    wide = ensemble(**PUSHED, until={"far.mpm": 0.3}, store=store)
    assert wide.dataset.identical(ensemble(**PUSHED, until={"far.mpm": 0.3}).dataset)
    narrow = ensemble(**PUSHED, until={"far.mpm": 0.15}, store=store)
    plain = ensemble(**PUSHED, until={"far.mpm": 0.15})
    assert narrow.dataset.sizes["seed"] > wide.dataset.sizes["seed"]
    assert narrow.dataset.identical(plain.dataset)
    assert Ensemble.load(store).dataset.identical(plain.dataset)
    assert ensemble(**PUSHED, until={"far.mpm": 0.3}, store=store).dataset.identical(wide.dataset)


@pytest.mark.filterwarnings("ignore::seacrane.warnings.FewSeedsWarning")
@pytest.mark.parametrize("call", range(1, 7))
def test_a_kill_at_any_moment_is_mended(call: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Ended before one write of attributes or of the metadata of all after another."""
    given = PUSHED | {"over": {"seed": range(1, 41)}, "until": {"far.mpm": 0.02}, "pack": 20, "lanes": 1}
    plain = ensemble(**given)
    assert plain.dataset.sizes["seed"] == 40
    calls: list[int] = []
    with monkeypatch.context() as patched:
        for owner, name in ((zarr, "consolidate_metadata"), (zarr.core.attributes.Attributes, "__setitem__")):
            real = getattr(owner, name)

            def dies(*given: Any, real: Any = real) -> Any:
                calls.append(0)
                if len(calls) == call:
                    raise KeyboardInterrupt
                return real(*given)

            patched.setattr(owner, name, dies)
        with contextlib.suppress(KeyboardInterrupt):
            ensemble(**given, store=tmp_path / "a.zarr")
    again = ensemble(**given, store=tmp_path / "a.zarr")
    assert again.dataset.identical(plain.dataset)
    assert Ensemble.load(tmp_path / "a.zarr").dataset.identical(plain.dataset)


def test_a_full_disk_is_named_and_loses_nothing(tmp_path: Path) -> None:
    store = tmp_path / "a.zarr"
    given: dict[str, Any] = {"over": {"start": [1.0, 2.0, 3.0]}, "keep": {"much": much}, **SWING}
    ensemble(pendulum, store=store, **given)
    for name in ("seacrane-study/pack_0000002.json", "much/c/2/0"):
        (store / name).unlink()
    number = os.fork()
    if not number:
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
        try:
            ensemble(pendulum, store=store, **given)
        except OSError as error:
            os._exit(4 if "could not write" in str(error) and "free in" in str(error) else 5)
        os._exit(6)
    assert os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]) == 4
    assert not (store / "seacrane-study" / "pack_0000002.json").exists()
    assert ensemble(pendulum, store=store, **given).dataset.identical(ensemble(pendulum, **given).dataset)


def much(result: Any) -> Any:
    """More than a small disk takes, in numbers that do not compress."""
    return np.random.default_rng(int(100.0 * abs(result["position"][-1, 0, 2]))).random(10_000)


def test_what_is_something_else_is_refused(tmp_path: Path) -> None:
    given: dict[str, Any] = {"over": GRID, "keep": {"lowest": lowest}, **SWING}
    ensemble(pendulum, store=tmp_path / "a.zarr", **given)
    with pytest.raises(SceneError, match="is of another study: t_end differ"):
        ensemble(pendulum, store=tmp_path / "a.zarr", **{**given, "t_end": 3.0})
    zarr.create_group(tmp_path / "b.zarr")
    with pytest.raises(SceneError, match="holds something else than an ensemble"):
        ensemble(pendulum, store=tmp_path / "b.zarr", **given)
    with pytest.raises(FileFormatError, match=r"has no study\.json"):
        Ensemble.load(tmp_path / "b.zarr")
    mark = tmp_path / "a.zarr" / "seacrane-study" / "pack_0000001.json"
    mark.write_text("nothing")
    with pytest.raises(FileFormatError, match=r"pack_0000001\.json line 1.* malformed JSON"):
        Ensemble.load(tmp_path / "a.zarr")
    slashed = pendulum()
    slashed.add_body(name="a/b", mass=1.0, inertia=(1.0, 1.0, 1.0))
    with pytest.raises(SceneError, match=r"'bodies\.a/b\.mass' names no variable of Zarr"):
        ensemble(
            slashed, store=tmp_path / "c.zarr", over={"bodies.a/b.mass": [1.0, 2.0]}, keep={"lowest": lowest},
            **SWING,
        )  # fmt: skip


def test_zarr_that_is_missing_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "zarr", None)
    with pytest.raises(SceneError, match=r"pip install 'seacrane\[zarr\]'"):
        ensemble(pendulum, over=GRID, keep={"lowest": lowest}, store=tmp_path / "a.zarr", **SWING)
