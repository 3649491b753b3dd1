"""Size of the three-dimensional pages, and the time that it takes to make them."""

from __future__ import annotations

import time

from seacrane import cases, simulate, view

from .section import Section

RUNS = {"60 s": (60.0, 0.1), "3 h": (10800.0, 0.2)}  # end and output interval, s


def pages() -> Section:
    """Pages of case 2."""
    view(cases.case2())  # what is loaded once
    rows = []
    for name, (t_end, interval) in RUNS.items():
        result = simulate(cases.case2(), t_end, dt_out=interval)
        begin = time.perf_counter()
        shown = view(result)
        wall = time.perf_counter() - begin
        size = len(shown.html.encode()) / 1e6
        rows.append([name, interval, 1.0 / shown.motion.interval, size, 1e3 * shown.motion.error[0], wall])
    return Section(
        title="Three-dimensional pages",
        text=(
            "`seacrane.view` of case 2 with its default channels: poses a second in the page, size of the "
            "file, largest distance of a body from the run at any output, wall time to make it. The aim is "
            "1.5 MB for 60 s."
        ),
        head=["run", "outputs every, s", "poses/s", "MB", "within, mm", "wall, s"],
        rows=rows,
    )
