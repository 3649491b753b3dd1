"""The reference of a case: tight runs that differ in equations and in method, and how far they differ."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from seacrane.accuracy.quantities import compare
from seacrane.run.method import Method

Array = NDArray[np.float64]
REST = 1e-300  # in place of no motion


@dataclass(frozen=True, kw_only=True, eq=False)
class Reference:
    """Values by quantity, and how well they are known.

    Attributes
    ----------
    values : mapping of str to ndarray, shape (n, items, parts)
        Empty where there is no reference.
    uncertainty : mapping of str to float
        How far tight runs differ; empty where there is but one.
    runs : The methods, the one that gave the values first.
    refused : mapping of str to str
        Methods that did not work, and why.
    """

    values: Mapping[str, Array] = field(default_factory=dict)
    uncertainty: Mapping[str, float] = field(default_factory=dict)
    runs: tuple[str, ...] = ()
    refused: Mapping[str, str] = field(default_factory=dict)

    @property
    def motion(self) -> dict[str, float]:
        """Largest distance of each quantity from its start."""
        return {name: distance_from_start(values) for name, values in self.values.items()}


def distance_from_start(values: Array) -> float:
    """Largest distance of values (n, items, parts) from those at the first output."""
    return float(np.linalg.norm(values - values[0], axis=-1).max())


def reference(
    run: Callable[[Method], Mapping[str, Array] | str],
    methods: Sequence[Method],
    *,
    enough: float | None = None,
) -> Reference:
    """The reference that tight runs give.

    Parameters
    ----------
    run : callable
        Values by quantity of the run with a method, or why there are none.
    methods : sequence of Method
        That differ in equations and method.
    enough : float, optional
        Of the motion: once two runs agree within it, no other is made, and the two nearest of all count.
        Default: all are made; the first counts, and its largest distance from the others.
    """
    found: dict[str, Mapping[str, Array]] = {}
    refused: dict[str, str] = {}
    for method in methods:
        values = run(method)
        if isinstance(values, str):
            refused[method.name] = values
            continue
        found[method.name] = values
        if enough is not None and len(found) > 1 and _nearest(found)[0] <= enough:
            break
    if not found:
        return Reference(refused=refused)
    names = list(found)
    if enough is not None and len(found) > 1:
        names = list(_nearest(found)[1])
    first = found[names[0]]
    apart = [_distances(first, found[name]) for name in names[1:]]
    uncertainty = {name: max(one[name] for one in apart) for name in first} if apart else {}
    return Reference(values=first, uncertainty=uncertainty, runs=tuple(names), refused=refused)


def _distances(one: Mapping[str, Array], other: Mapping[str, Array]) -> dict[str, float]:
    return {name: compare(values, other[name]).largest for name, values in one.items()}


def _nearest(found: Mapping[str, Mapping[str, Array]]) -> tuple[float, tuple[str, str]]:
    """The two runs that are nearest to each other, and their distance over the motion of the first run."""
    motion = {name: max(distance_from_start(v), REST) for name, v in next(iter(found.values())).items()}

    def distance(pair: tuple[str, str]) -> float:
        apart = _distances(found[pair[0]], found[pair[1]])
        return max(
            value / motion[name] if math.isfinite(value) else math.inf for name, value in apart.items()
        )

    nearest = min(combinations(found, 2), key=distance)
    return distance(nearest), nearest
