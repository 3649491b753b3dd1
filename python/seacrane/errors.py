"""Exceptions raised by seacrane; each message names the object, the value and the fix."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    import os
    from pathlib import Path

    import numpy as np
    from numpy.typing import NDArray


class Recorded(Protocol):
    """What a run had recorded when it ended: a `seacrane.Result`, as far as this module knows it."""

    @property
    def time(self) -> NDArray[np.float64]:
        """Output times, shape (n,), s."""

    @property
    def interrupted(self) -> bool:
        """Whether the run stopped before its end."""

    @property
    def state(self) -> Any:
        """The last good `seacrane.State`, or None where there is none."""

    def __getitem__(self, channel: str, /) -> NDArray[np.float64]:
        """A channel, time first."""

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write it as NetCDF."""


class SeacraneError(Exception):
    """Base of every exception that seacrane raises on purpose.

    Attributes
    ----------
    result : Result or None
        What a run had recorded when it raised this, with `interrupted` set and its last good state; None
        outside a run.
    name : str
        Of the element that it is about, where what raised it says so; else empty.
    """

    result: Recorded | None = None
    name: str = ""


class SceneError(SeacraneError, ValueError):
    """A scene, or one of its elements, contradicts itself or holds a value out of range.

    Attributes
    ----------
    about : tuple of str
        Element and keyword of the value that it is about, where what raised it says so; else empty.
    """

    about: tuple[str, ...] = ()

    @classmethod
    def of(cls, value: str, text: str) -> SceneError:
        """About a value, by what it is called, such as "line 'hoist': points[1]"; the message begins so."""
        error = cls(f"{value} {text}")
        error.about = tuple(part.partition("[")[0] for part in value.split(": "))
        return error


class KeywordError(SceneError, TypeError):
    """A call with a keyword that there is not, or without what it needs; the message names the nearest.

    Attributes
    ----------
    known : tuple of str
        Keywords of which the one that was given is none, where more are known to the call.
    """

    known: tuple[str, ...] = ()


class OutputMemoryError(SceneError, MemoryError):
    """The outputs asked for would not fit into this computer's memory; nothing has been allocated."""


class FileFormatError(SeacraneError, ValueError):
    """A file is truncated, malformed or of an unknown kind.

    Attributes
    ----------
    placed : bool
        Whether the message begins with the file and the line.
    """

    placed: bool = False


class SimulationError(SeacraneError, RuntimeError):
    """A run could not be continued; the message says which state, when, and what to try; `result` holds
    the outputs until then."""


class LineSlackError(SimulationError):
    """A line on the rung "quasi-static" would go slack, or has hauled in to its end; the message names it."""


class MemberLimitError(SimulationError):
    """A member of an ensemble took more processor time than its `member_limit` allows."""


class ChatteringError(SimulationError):
    """Limits make and break contact without end in no time; the message names limit, joint and time."""


class WorkerVersionError(SeacraneError):
    """A worker has another version of seacrane than the process that asks for the ensemble."""


class PassivityError(SeacraneError, ValueError):
    """A memory model that can deliver energy, where a passive one was asked for."""


__all__ = [name for name, value in globals().items() if isinstance(value, type) and name.endswith("Error")]


def __dir__() -> list[str]:
    return __all__
