"""The committed list: what must complete with the default setting, and what must be refused by name."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Any

from seacrane.accuracy import row as rows
from seacrane.accuracy.row import Row
from stability_atlas.methods import DEFAULT
from stability_atlas.points import relative_error, relative_uncertainty


@dataclass(frozen=True, kw_only=True)
class Promise:
    """What one axis promises at some of its values, with the default setting.

    Attributes
    ----------
    axis : str
    values : tuple of float
    verdict : str
        "completed", or how it must end: "refused" or "stopped".
    left : float
        Largest constraint error of a result, m or rad.
    energy : float
        Largest energy balance, over the work or the kinetic energy.
    error : float
        Largest error over the motion, where there is a reference that is known as well as that.
    words : tuple of str
        What the message of a refusal or a stop must hold.
    """

    axis: str
    values: tuple[float, ...]
    verdict: str = rows.COMPLETED
    left: float = 1e-9
    energy: float = 1e-5
    error: float = 1e-3
    words: tuple[str, ...] = ()


@lru_cache(maxsize=1)
def promises() -> tuple[Promise, ...]:
    """All of the list, committed.toml beside this file."""
    data: dict[str, Any] = tomllib.loads(
        files("stability_atlas").joinpath("committed.toml").read_text(encoding="utf-8")
    )
    return tuple(
        Promise(**{**entry, "values": tuple(map(float, entry["values"])),
                   "words": tuple(entry.get("words", ()))})
        for entry in data["promise"]
    )  # fmt: skip


def values(axis: str) -> tuple[float, ...]:
    """All values of an axis that the list names."""
    return tuple(value for promise in promises() if promise.axis == axis for value in promise.values)


def broken(measured: Sequence[Row], axes: Sequence[str]) -> list[str]:
    """What the rows break of the list; of the forbidden endings, those of all methods."""
    by_key = {row.key: row for row in measured}
    out = [f"{row.key}: {row.verdict}: {row.message}" for row in measured if row.verdict in rows.FORBIDDEN]
    for promise in promises():
        if promise.axis not in axes:
            continue
        for value in promise.values:
            key = f"{promise.axis}|{value!r}|{DEFAULT.name}"
            if key in by_key:  # a value of the nightly atlas only has no row in a quick one
                out += [f"{key}: {text}" for text in _breaks(promise, by_key[key])]
    return out


def _breaks(promise: Promise, row: Row) -> list[str]:
    if row.verdict != promise.verdict:
        return [f"{row.verdict} instead of {promise.verdict}: {row.message}"]
    if row.verdict != rows.COMPLETED:
        missing = [word for word in promise.words if word not in row.message]
        return [f"says nothing of {', '.join(missing)}: {row.message}"] if missing else []
    out = []
    if not row.left <= promise.left:
        out.append(f"constraint error {row.left:.3g}, promised {promise.left:g}")
    if row.energy > promise.energy:
        out.append(f"energy error {row.energy:.3g}, promised {promise.energy:g}")
    error = relative_error(row)
    if error > promise.error and not relative_uncertainty(row) > 0.1 * promise.error:
        out.append(f"error {error:.3g} of the motion, promised {promise.error:g}")
    return out
