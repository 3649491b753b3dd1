"""What a member of an ensemble costs beside its stepping loop, in its worker and in the caller."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import Kept, Result, Run, _core, cases, ensemble

from .section import Section

HOW: dict[str, Any] = {"rtol": 1e-2, "dt_out": 1.0, "channels": ["position"]}
TRACK = Kept(channel="position", names={"body": "payload"}, interval=1.0)
WORKERS = 2
PACK = 4  # as of a thousand members
_here = threading.local()  # loop: CPU time of loops since `before`, s


def by_thread(_: Result) -> list[float]:
    """Of a member whose process does other things beside it: ms beside the loop, and in it."""
    return _lap(time.thread_time())


def by_process(_: Result) -> list[float]:
    """Of a member that its process runs alone: with what other threads of the executor take."""
    return _lap(time.process_time())


def _lap(now: float) -> list[float]:
    """CPU time in ms since the member before, beside loops and in them; NaN for the first of a thread."""
    _watch_loops()
    before, loop = getattr(_here, "before", np.nan), getattr(_here, "loop", np.nan)
    _here.before, _here.loop = now, 0.0
    return [1e3 * (now - before - loop), 1e3 * loop]


def _watch_loops() -> None:
    if hasattr(Run.advance, "watched"):
        return
    Run.advance = _watched(Run.advance)  # type: ignore[method-assign]
    _core.advance_side_by_side = _watched(_core.advance_side_by_side)


def _watched(advance: Callable[..., bool]) -> Callable[..., bool]:
    def watched(*given: Any) -> bool:
        start = time.thread_time()
        try:
            return advance(*given)
        finally:
            _here.loop = getattr(_here, "loop", 0.0) + time.thread_time() - start

    watched.watched = True  # type: ignore[attr-defined]
    return watched


@dataclass(frozen=True, kw_only=True)
class _Kind:
    """An executor, and which clocks tell what it costs."""

    name: str
    opened: Callable[[], Any]
    clock: Callable[[Result], list[float]]
    caller: Callable[[], float] | None  # none: the caller is the worker


def overhead(*, members: int = 16, t_end: float = 10_800.0) -> Section:
    """CPU time of a member of case 2 beside its loop, by executor."""
    kinds = [
        _Kind(name="none", opened=nullcontext, clock=by_process, caller=None),
        _Kind(
            name="two threads", opened=lambda: ThreadPoolExecutor(WORKERS), clock=by_thread,
            caller=time.thread_time,
        ),
        _Kind(
            name="two processes", opened=lambda: ProcessPoolExecutor(WORKERS), clock=by_process,
            caller=time.process_time,
        ),
    ]  # fmt: skip
    if _has_dask():
        kinds.append(_Kind(name="dask", opened=_dask, clock=by_thread, caller=time.process_time))
    return Section(
        title="Ensemble overhead",
        text=(
            f"CPU time in ms of one member beside its stepping loop: case 2, {t_end:g} s, default method at "
            "rtol 1e-2, payload every second, another seed for each. In the worker: sea, start, result, what "
            f"is kept, and the executor's part there; median of packs of {PACK}, without the first of each "
            "worker, which compiles. In the caller: sending and gathering, without what an ensemble takes "
            "once. Dask is a local cluster, its scheduler in the caller, with what it does there all the "
            "time; what its workers do beside their task is left out. Load of the machine: "
            f"{os.getloadavg()[0]:.1f} on {os.cpu_count()} cores; what others do to caches and clocks is in "
            "these times."
        ),
        head=["executor", "in the worker, ms", "in the caller, ms", "the loop itself, ms"],
        rows=[_row(kind, members, t_end) for kind in kinds],
    )


def _row(kind: _Kind, members: int, t_end: float) -> list[Any]:
    scene = cases.case2()
    taken: list[float] = []
    counts = (2 * WORKERS * PACK, 2 * WORKERS * PACK + members)
    with kind.opened() as executor:
        for count in counts:
            start = kind.caller() if kind.caller else 0.0
            there = ensemble(
                scene, over={"seed": range(count)}, keep={"track": TRACK, "lap": kind.clock}, t_end=t_end,
                executor=executor, pack=PACK, **HOW,
            )  # fmt: skip
            taken.append(kind.caller() - start if kind.caller else 0.0)
    packs = there.dataset.lap.to_numpy().reshape(-1, PACK, 2).mean(axis=1)
    beside, loop = np.nanmedian(packs, axis=0)
    caller = 1e3 * max(taken[1] - taken[0], 0.0) / members if kind.caller else None
    return [kind.name, float(beside), caller, float(loop)]


def _has_dask() -> bool:
    try:
        import distributed  # noqa: F401
    except ImportError:
        return False
    return True


@contextmanager
def _dask() -> Iterator[Executor]:
    from distributed import Client, LocalCluster

    given: dict[str, Any] = {"n_workers": WORKERS, "threads_per_worker": 1, "dashboard_address": None}
    with LocalCluster(**given) as cluster, Client(cluster) as client:
        yield client.get_executor()


if __name__ == "__main__":
    print(overhead().markdown())
