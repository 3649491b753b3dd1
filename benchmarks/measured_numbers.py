"""Columns of the files of measured sets."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
from numpy.typing import NDArray


def columns(path: Path, delimiter: str = ",") -> dict[str, NDArray[np.float64]]:
    """Columns of a CSV file by name; what is no number, such as an empty cell, is NaN."""
    with path.open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file, delimiter=delimiter)
    return {name: np.array([_number(row[k]) for row in rows]) for k, name in enumerate(head)}


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")
