"""Size of the three-dimensional pages and models, and the time that it takes to make them."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import netCDF4

from seacrane import Result, cases, simulate, view
from seacrane.result.result_file import SCENE

from .section import Section
from .sources import ENGINE

RUNS = {"60 s": (60.0, 0.1), "3 h": (10800.0, 0.2)}  # end and output interval, s


def pages() -> Iterator[list[Any]]:
    """Pages of case 2."""
    view(cases.case2())  # what is loaded once
    with tempfile.TemporaryDirectory() as folder:
        for name, (t_end, interval) in RUNS.items():
            result = simulate(cases.case2(), t_end, dt_out=interval)
            yield [name, interval, *_row(result, Path(folder))]


def _row(result: Result, folder: Path) -> list[float]:
    """Of the page, the model and the file of a result."""
    shown, making = _timed(lambda: view(result))
    model = folder / "lift.glb"
    _, writing = _timed(lambda: shown.save_gltf(model, overwrite=True))
    file = result.save(folder / "lift.nc")
    bare = Result.from_arrays(
        time=result.time,
        arrays=result.channels,
        coords=result.coords,
        stats=result.stats,
        about=result.about,
        state=result.state,
    ).save(folder / "bare.nc")
    with netCDF4.Dataset(file) as opened:
        assert SCENE in opened.variables
    page = len(shown.html.encode())
    sizes = [path.stat().st_size for path in (model, file, bare)]
    return [
        1.0 / shown.motion.interval, page / 1e6, 1e3 * shown.motion.error[0], making, sizes[0] / 1e6, writing,
        sizes[1] / 1e6, (sizes[1] - sizes[2]) / 1e6,
    ]  # fmt: skip


def _timed(make: Callable[[], Any]) -> tuple[Any, float]:
    """What is made, and the processor time of the best of three, s."""
    best = float("inf")
    for _ in range(3):
        begin = time.process_time()
        made = make()
        best = min(best, time.process_time() - begin)
    return made, best


SECTION = Section(
    title="Three-dimensional pages",
    text=(
        "`seacrane.view` of case 2 with its default channels: poses a second in the page, size of the file, "
        "largest distance of a body from the run at any output, and time to make it. Then the same of "
        "`View.save_gltf`, and the result's own file, with what the scene in it takes. The aim is 1.5 MB "
        "for 60 s."
    ),
    head=[
        "run", "outputs every, s", "poses/s", "page, MB", "within, mm", "page, s", "glTF, MB", "glTF, s",
        "result file, MB", "scene in it, MB",
    ],
    rows=pages,
    sources=(*ENGINE, "python/seacrane/pictures", "python/seacrane/result"),
)  # fmt: skip
