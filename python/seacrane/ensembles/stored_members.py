"""The members that the folder of a study tells of."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from seacrane.ensembles.growing import BATCH, Growth
from seacrane.ensembles.members import MOST_MEMBERS, Members
from seacrane.ensembles.variables import RESERVED
from seacrane.errors import FileFormatError


def members_in(folder: Path, data: Mapping[str, Any]) -> Members:
    """Those of a study without `until`. Raises FileFormatError for what is no study of ours."""
    members = Members(axes=_axes(folder, data), grid=bool(data.get("grid")))
    lengths = {len(values) for values in members.axes.values()}
    if (not members.grid and len(lengths) > 1) or len(members) > MOST_MEMBERS:
        raise FileFormatError(f"{folder}: its study has lists of unlike lengths, or too many members")
    return members


def growth_in(folder: Path, data: Mapping[str, Any]) -> Growth:
    """That of a study with `until`, by the members of its first batch. Raises FileFormatError."""
    axes, size = _axes(folder, data), data["seeds_in_pack"]
    seeds = axes.get("seed", ())
    others = {name: values for name, values in axes.items() if name != "seed"}
    sound = len(seeds) == BATCH and all(type(one) is int for one in seeds)
    if not sound or type(size) is not int or not 1 <= size <= BATCH:
        raise FileFormatError(f"{folder}: its study grows by {BATCH} seeds, and tells others")
    growth = Growth(first=int(seeds[0]), batches=1, others=others, size=size)
    if growth.cells * BATCH > MOST_MEMBERS:
        raise FileFormatError(f"{folder}: its study has too many members")
    return growth


def _axes(folder: Path, data: Mapping[str, Any]) -> dict[str, tuple[Any, ...]]:
    axes = data.get("axes")
    sound = isinstance(axes, dict) and axes and all(map(_is_axis, axes.items()))
    if not isinstance(axes, dict) or not sound:
        raise FileFormatError(f"{folder}: its study names no parameters with values")
    return {name: tuple(values) for name, values in axes.items()}


def _is_axis(axis: tuple[str, Any]) -> bool:
    name, values = axis
    return (
        name not in RESERVED
        and isinstance(values, list)
        and bool(values)
        and all(isinstance(value, bool | int | float | str) for value in values)
    )
