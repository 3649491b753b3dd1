"""Exceptions raised by seacrane; each message names the object, the value and the fix."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from seacrane.result import Result


class SeacraneError(Exception):
    """Base of every exception that seacrane raises on purpose.

    Attributes
    ----------
    result : Result or None
        What a run had recorded when it raised this, with `interrupted` set and its last good state; None
        outside a run.
    """

    result: Result | None = None


class SceneError(SeacraneError, ValueError):
    """A scene, or one of its elements, contradicts itself or holds a value out of range."""


class FileFormatError(SeacraneError, ValueError):
    """A file is truncated, malformed or of an unknown kind."""


class SimulationError(SeacraneError, RuntimeError):
    """A run could not be continued; the message says which state, when, and what to try; `result` holds
    the outputs until then."""


class ChatteringError(SimulationError):
    """Limits make and break contact without end in no time; the message names limit, joint and time."""
