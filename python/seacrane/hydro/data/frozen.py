"""Checks that databases, groups and what they consist of share: arrays of a shape, sizes, bands.

Where a file is read, what they refuse is an error of that file (`reading`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.arrays import Array
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.checked import require_unmasked

KINDS: dict[str, type] = dict.fromkeys(("force", "motion_rao", "values"), complex)
KINDS |= dict.fromkeys(("outputs", "inputs"), np.int64)


def freeze(part: Any, what: str, shapes: Mapping[str, tuple[int, ...]]) -> None:
    """Replace arrays of ``part`` by finite, read-only copies of the right shape and type; None stays.

    Raises SceneError: names ``what`` it is of and the entry.
    """
    for name, shape in shapes.items():
        value = getattr(part, name)
        if value is None:
            continue
        require_unmasked(f"{what}: {name}", value)
        array: NDArray[Any] = np.array(value, dtype=KINDS.get(name, float))
        if array.shape != shape:
            raise SceneError(f"{what}: {name} has shape {array.shape}; {shape} is needed")
        if not np.all(np.isfinite(array)):
            where = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
            raise SceneError(f"{what}: {name}{list(where)} is {array[where]}; give finite numbers")
        array.setflags(write=False)
        object.__setattr__(part, name, array)


def require_grid(what: str, omega: Array, heading: Array) -> None:
    """Raise unless frequencies are positive and headings within [0, 2 pi), both strictly increasing."""
    for name, values, low, high in (("omega", omega, 0.0, np.inf), ("heading", heading, -1e-12, 2.0 * np.pi)):
        if values.size == 0:
            raise SceneError(f"{what}: {name} is empty; give at least one value")
        steps = np.flatnonzero(np.diff(values) <= 0.0)
        if steps.size:
            i = int(steps[0])
            raise SceneError(
                f"{what}: {name} is not strictly increasing: {values[i]:.6g} then {values[i + 1]:.6g} at "
                f"index {i + 1}; sort it and drop duplicates"
            )
        if not (values[0] > low and values[-1] < high):
            raise SceneError(
                f"{what}: {name} spans {values[0]:.6g} to {values[-1]:.6g}, outside ({low}, {high})"
            )


def require_positive(part: Any, what: str, *names: str) -> None:
    """Raise unless these numbers of ``part`` are positive, and finite but for a depth."""
    for name in names:
        value = float(getattr(part, name))
        if not (0.0 < value < np.inf or (name == "depth" and value > 0.0)):
            raise SceneError(f"{what}: {name} is {value}; give a positive number")


def require_band(what: str, band: tuple[float, float] | None) -> None:
    """Raise unless a trusted band is none, or rises from zero or more."""
    if band is not None and not 0.0 <= band[0] < band[1]:
        raise SceneError(f"{what}: trusted_band {band} is not (low, high) in rad/s")


def require_definite(what: str, mass_matrix: Array | None) -> None:
    """Raise unless a mass matrix (6, 6) is positive definite, or not known."""
    if mass_matrix is not None and np.any(np.linalg.eigvalsh(0.5 * (mass_matrix + mass_matrix.T)) <= 0.0):
        raise SceneError(f"{what}: the mass matrix is not positive definite; check mass and inertia")


@contextmanager
def reading(
    where: object, kind: str = "", errors: tuple[type[Exception], ...] = (ValueError,)
) -> Iterator[None]:
    """Raise what goes wrong within as a FileFormatError that names the file; one that does so stays.

    Parameters
    ----------
    where : file or files.
    kind : what the file should be, where ``errors`` are those of a library that cannot read it.
    """
    try:
        yield
    except FileFormatError:
        raise
    except errors as error:
        told = f"cannot be read as {kind} ({str(error)[:200]}); write it again" if kind else error
        raise FileFormatError(f"{where}: {told}") from error
