"""What is worked out after a run does not lose the run: a failure there is a warning."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, Protocol, TypeVar

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SimulationError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import is_finite
from seacrane.warnings import NotFiniteWarning, UnjudgedWarning

Finding = tuple[type[Warning], str]
Some = TypeVar("Some")


class Counted(Protocol):
    """A result, as far as this module knows it."""

    @property
    def stats(self) -> Mapping[str, Any]:
        """Its counters."""


Judged = TypeVar("Judged", bound=Counted)
NOT_FINITE = "not_finite"  # stat of a result: such channels


def peak(values: Array, *, above: float | Array) -> list[tuple[float, int]]:
    """Where values (n,) pass a bound the farthest: the value and its place; nothing where none does."""
    beyond = values - above
    at = int(np.argmax(beyond))
    return [(float(values[at]), at)] if beyond[at] > 0.0 else []


def as_text(found: Iterable[Finding]) -> str:
    """One message a line."""
    return "\n".join(message for _, message in found)


def warn_of(found: Iterable[Finding]) -> None:
    """Warn of findings, at the user's line."""
    for category, message in found:
        warn_caller(message, category)


def tried(what: str, work: Callable[[], Some], otherwise: Some, found: list[Finding]) -> Some:
    """What `work` returns; where it fails `otherwise`, and a finding that says so."""
    try:
        return work()
    except Warning:  # one that the user has made an error
        raise
    except Exception as error:
        text = f"run: {what} failed after the run, which is kept: {type(error).__name__}: {error}"
        found.append((UnjudgedWarning, text))
        return otherwise


def not_finite(arrays: Mapping[str, Any]) -> dict[str, Finding]:
    """Channels that hold values that are not finite, and what is said of each."""
    out: dict[str, Finding] = {}
    for name, values in arrays.items():
        array = np.asarray(values)
        if is_finite(array):
            continue
        first = int(np.argwhere(~np.isfinite(array.reshape(len(array), -1)).all(axis=1))[0, 0])
        out[name] = (
            NotFiniteWarning,
            f"channel {name!r}: is not finite from output {first} on, of a run that reached its end. Leave "
            "out a channel that is not defined for the scene, and do not trust what is made of this one",
        )
    return out


def require_finite(result: Judged) -> Judged:
    """The result; SimulationError where a channel of it is not finite, for what makes numbers of it."""
    if NOT_FINITE in result.stats:
        raise SimulationError(
            f"run: {result.stats[NOT_FINITE]} of its channels hold values that are not finite; leave out a "
            "channel that is not defined for the scene"
        )
    return result
