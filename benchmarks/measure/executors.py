"""What a member of an ensemble costs beside its stepping loop, and what a second core gives."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import nullcontext
from typing import Any

from seacrane import Kept, Run, cases, ensemble
from seacrane.ensembles.other_sea import OtherSeeds

from .section import Section
from .sources import CRANE, LANES
from .timing import best_seconds

T_END, MEMBERS, PACK, REPEATS = 10_800.0, 32, 4, 2  # s
TRACK = Kept(channel="position", names={"body": "payload"}, interval=1.0)
HOW: dict[str, Any] = {"integrator": "tsit5", "rtol": 1e-2, "dt_out": 1.0, "channels": ["position"]}
KINDS: dict[str, Callable[[], Any]] = {
    "one thread": nullcontext,
    "two threads": lambda: ThreadPoolExecutor(2),
    "two processes": lambda: ProcessPoolExecutor(2),
}


def executors() -> Iterator[list[Any]]:
    """Times of storms of case 2 by executor, the best of some that take turns; then parts of one member."""
    scene = cases.case2()
    best: dict[str, float] = {}
    for _ in range(REPEATS):
        for name, opened in KINDS.items():
            with opened() as executor:
                _storms(executor, members=2 * PACK, t_end=1.0)  # workers begin
                begun = time.perf_counter()
                _storms(executor, members=MEMBERS, t_end=T_END)
                took = (time.perf_counter() - begun) / MEMBERS
            best[name] = min(took, best.get(name, took))
    for name, took in best.items():
        yield [f"a storm of three hours, {name}", 1e3 * took, best["one thread"] / took]

    def stepped() -> Run:
        run = Run(scene, T_END, **HOW)
        run.advance(T_END)
        return run

    done, seeds = stepped(), OtherSeeds(scene, {})
    waves = seeds.sea(2)
    whole = best_seconds(stepped, repeats=REPEATS)
    parts: dict[str, Callable[[], object]] = {
        "describe the lift, where a function does": cases.case2,
        "prepare the run of a scene": lambda: Run(scene, T_END, **HOW),
        "make the sea again": lambda: seeds.sea(2),
        "prepare the run in it": lambda: done.in_sea(waves),
        "end: look for what is out of range, make the record": done.record,
    }
    for name, call in parts.items():
        took = best_seconds(call, repeats=3 * REPEATS)
        yield [f"one member alone: {name}", 1e3 * took, None]
        whole -= took if name.startswith("prepare the run of") else 0.0
    yield ["one member alone: its stepping loop", 1e3 * whole, None]


def _storms(executor: Executor | None, *, members: int, t_end: float) -> None:
    ensemble(
        cases.case2(), over={"seed": range(members)}, keep={"track": TRACK}, t_end=t_end, executor=executor,
        pack=PACK, **HOW,
    )  # fmt: skip


SECTION = Section(
    title="Ensembles by executor",
    text=(
        f"{MEMBERS} storms of {T_END:g} s of case 2, payload every second, `tsit5` at rtol 1e-2, in "
        f"packs of {PACK} with lanes: wall time of a storm, best of {REPEATS} that take turns, workers begun "
        "before. The aim is 1.95 for two cores; what else runs on the machine is missing from two cores "
        "first. Then CPU times of the parts of one member that runs alone, without lanes."
    ),
    head=["what", "ms", "times one thread"],
    rows=executors,
    sources=(*CRANE, *LANES),
)
