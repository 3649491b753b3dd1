"""Sections of what was compared: validation, measured sets, the stability atlas."""

from __future__ import annotations

import csv
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import measurements
import validation
from compared.row import HEAD
from measure.section import ROOT, Section
from measure.sources import ENGINE
from measured_row import HEAD as MEASURED

STUDIES = ROOT / "studies"
sys.path.append(str(STUDIES))

from stability_atlas.summary import HEAD as ATLAS_HEAD  # noqa: E402
from stability_atlas.summary import summary  # noqa: E402


def shared() -> str:
    """What the tables of measured sets and real ships need."""
    return "" if os.environ.get("SEACRANE_SHARED") else "SEACRANE_SHARED, the folder of foreign data"


def atlas() -> Iterator[list[str]]:
    """The quick atlas, in a process of its own."""
    with tempfile.TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "stability_atlas", "--quick", "--out", folder]
        subprocess.run(command, check=True, env=os.environ | {"PYTHONPATH": str(STUDIES)}, cwd=ROOT)
        with (Path(folder) / "extremes.csv").open(newline="", encoding="utf-8") as file:
            yield from summary(csv.DictReader(file))


VALIDATION = Section(
    title="Validation",
    text=(
        "Every comparison with closed forms, other programs and published problems, with its bound where "
        "one is kept ([the page](../docs/validation.md))."
    ),
    head=HEAD,
    rows=validation.rows,
    sources=(
        *ENGINE, "python/seacrane/**/*.py", "benchmarks/compared", "benchmarks/peers/references",
        *(f"benchmarks/results/{name}.csv" for name in validation.TAKEN),
    ),
    needs=shared,
)  # fmt: skip
MEASUREMENTS = Section(
    title="Measurements",
    text="What tanks and other programs say beside us ([the page](../docs/measurements.md)).",
    head=MEASURED,
    rows=measurements.every_row,
    sources=(*ENGINE, "python/seacrane/**/*.py", "benchmarks/measured"),
    needs=shared,
)
ATLAS = Section(
    title="Stability atlas",
    text=(
        "One quantity at a time far beyond use, a few values and six settings each ([what is "
        "measured](../studies/stability_atlas/README.md)): how runs ended, and of the default the largest "
        "error over the motion and energy error over the work of its completed runs."
    ),
    head=ATLAS_HEAD,
    rows=atlas,
    sources=(*ENGINE, "studies/stability_atlas/*.py", "studies/stability_atlas/*.toml"),
)
