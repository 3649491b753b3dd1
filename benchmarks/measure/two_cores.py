"""What a second core gives an ensemble: wall times of one batch on one core and on two.

python -m measure.two_cores --publish      # in benchmarks/, on a machine that does nothing else
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import nullcontext
from pathlib import Path
from typing import Any

from seacrane import Kept, cases, ensemble

from .section import Section

TRACK = Kept(channel="position", names={"body": "payload"}, interval=1.0)
HOW: dict[str, Any] = {"rtol": 1e-2, "dt_out": 1.0, "channels": ["position"], "keep": {"track": TRACK}}
PACK = 4
KINDS: dict[str, Callable[[], Any]] = {
    "none": nullcontext,
    "two threads": lambda: ThreadPoolExecutor(2),
    "two processes": lambda: ProcessPoolExecutor(2),
}


def two_cores(*, members: int = 64, t_end: float = 10_800.0, repeats: int = 3) -> Section:
    """Wall time of storms of case 2, best of several that take turns."""
    scene = cases.case2()
    best: dict[str, float] = {}
    busy = os.getloadavg()[0]
    for _ in range(repeats):
        for name, opened in KINDS.items():
            with opened() as executor:
                given = {"t_end": t_end, "executor": executor, "pack": PACK, **HOW}
                ensemble(scene, over={"seed": range(2 * PACK)}, **given | {"t_end": 1.0})  # workers begin
                start = time.perf_counter()
                ensemble(scene, over={"seed": range(members)}, **given)
                taken = time.perf_counter() - start
            best[name] = min(taken, best.get(name, taken))
    return Section(
        title="Two cores",
        text=(
            f"Wall time of {members} storms of {t_end:g} s of case 2, payload every second, rtol 1e-2, in "
            f"packs of {PACK}: best of {repeats} that took turns, workers begun before. The aim is 1.95 for "
            "two cores. Load of the machine before: "
            f"{busy:.1f} on {os.cpu_count()} cores; what others take there is missing from two cores first."
        ),
        head=["executor", "wall, s", "ms a storm", "times one core"],
        rows=[[name, one, 1e3 * one / members, best["none"] / one] for name, one in best.items()],
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--members", type=int, default=64)
    parser.add_argument("--publish", action="store_true", help="write into benchmarks/results")
    options = parser.parse_args()
    section = two_cores(members=options.members)
    print(section.markdown())
    if options.publish:
        section.save(Path(__file__).resolve().parent.parent / "results")


if __name__ == "__main__":
    main()
