"""Linear algebra of small matrices has one thread in the package, and as many as before after it."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
import scipy.linalg
from numpy.typing import NDArray
from threadpoolctl import threadpool_info, threadpool_limits

import seacrane as sc
from seacrane import cases
from seacrane.crane import Payload
from seacrane.hydro import passivity_certificate, shipped_database
from seacrane.hydro.memory.fit import fit_memory
from seacrane.hydro.vessel.parameters import _smallest_damping
from seacrane.one_thread import one_thread

BEFORE = 2
ROUTINES = ["solve", "svd", "eig", "eigvals", "eigh", "eigvalsh", "lstsq", "pinv", "inv", "qr", "cholesky"]
SHARED_FROM = 8  # rows: smaller matrices have one thread in any case


def threads() -> set[int]:
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


@pytest.fixture(autouse=True)
def several_threads() -> Iterator[None]:
    """As on a machine of several processors, whatever this one has; in SciPy's library too."""
    assert scipy.linalg
    with threadpool_limits(BEFORE, user_api="blas"):
        if threads() != {BEFORE}:
            pytest.skip("this linear algebra takes no number of threads")
        yield
        assert threads() == {BEFORE}


def test_a_block_limits_and_gives_back() -> None:
    with one_thread:
        assert threads() == {1}
        with one_thread:
            assert threads() == {1}
        assert threads() == {1}
    assert threads() == {BEFORE}
    with pytest.raises(ZeroDivisionError), one_thread:
        _ = 1 / 0
    assert threads() == {BEFORE}
    assert one_thread(threads)() == {1}


@pytest.fixture
def seen(monkeypatch: Any) -> list[tuple[str, int]]:
    """Routine and threads of each call of NumPy's linear algebra with matrices that it would share out."""
    out: list[tuple[str, int]] = []
    _smallest_damping.cache_clear()

    def watched(name: str) -> Callable[..., Any]:
        routine = getattr(np.linalg, name)

        def watch(matrix: NDArray[Any], *args: Any, **kwargs: Any) -> Any:
            if min(np.shape(matrix)[-2:]) >= SHARED_FROM:
                out.extend((name, number) for number in threads())
            return routine(matrix, *args, **kwargs)

        return watch

    for name in ROUTINES:
        monkeypatch.setattr(np.linalg, name, watched(name))
    return out


def ship() -> sc.Scene:
    scene = sc.Scene(name="ship")
    scene.add_vessel(shipped_database(), memory="by-motion")
    scene.add_crane(s1=2.0, s2=2.0, payload=Payload(mass=5e4))
    scene.add_ballast()
    return scene


CALLS: dict[str, Callable[[], object]] = {
    "case 2": cases.case2,
    "ballast": ship,
    "equilibrium": lambda: sc.equilibrium(ship()),
    "load chart": lambda: sc.load_chart(ship(), radii=[20.0], limits={"heel_deg": 6.0}),
    "natural modes": lambda: sc.natural_modes(ship()),
    "motion RAO": lambda: sc.motion_rao(ship(), omega=[0.5, 1.0], direction=2.0, body="vessel"),
    "run": lambda: sc.simulate(cases.case2(), 1.0),
    "fit of a memory": lambda: fit_memory(database=shipped_database(), limit=0.3),
    "certificate": lambda: passivity_certificate(shipped_database().memory),
}


@pytest.mark.parametrize("name", CALLS)
def test_what_the_package_computes_has_one_thread(seen: list[tuple[str, int]], name: str) -> None:
    CALLS[name]()
    assert seen, "no matrix that would be shared out: this tests nothing"
    assert {number for _, number in seen} == {1}, seen


def test_members_have_one_thread_whatever_runs_beside_them() -> None:
    """Their number changes bits: a member in a pool would else depend on what the others do just then."""
    keep = {"threads": lambda result: float(max(threads()))}
    over = {"seed": [1, 2, 3, 4]}
    study = {"keep": keep, "t_end": 0.5, "pack": 1, "lanes": 1}
    scene = cases.vessel(memory="none")
    with ThreadPoolExecutor(2) as pool:
        for executor in (None, pool):
            assert (sc.ensemble(scene, over=over, executor=executor, **study).dataset.threads == 1.0).all()
