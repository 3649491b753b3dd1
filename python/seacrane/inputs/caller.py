"""Warnings at the user's line, however deep in the package their cause is found."""

from __future__ import annotations

import inspect
import sys
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from contextvars import ContextVar
from functools import wraps
from multiprocessing import parent_process
from typing import Any, TypeVar

Some = TypeVar("Some")
PACKAGE = __name__.partition(".")[0]
Said = tuple[str, type[Warning], bool]  # a message, its category, and whether it was no silent one
_TOLD: set[str] = set()
_TELLING: ContextVar[bool] = ContextVar("telling", default=True)
_LISTENING: ContextVar[tuple[dict[str, None], ...]] = ContextVar("listening", default=())
_SILENCES: ContextVar[tuple[type[Warning], ...]] = ContextVar("silences", default=())  # by open `silently`
_RECORDING: ContextVar[tuple[tuple[list[Said], int], ...]] = ContextVar("recording", default=())


def warn_caller(message: str, category: type[Warning]) -> None:
    """Warn at the nearest line outside this package; Python then repeats it once per line, not per call."""
    silences = [issubclass(category, silent) for silent in _SILENCES.get()]
    for said, before in _RECORDING.get():
        said.append((message, category, not any(silences[before:])))
    for told in _LISTENING.get():
        told[message] = None
    if any(silences):
        return
    level, frame = 1, inspect.currentframe()
    while frame is not None and frame.f_globals.get("__name__", "").partition(".")[0] == PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(message, category, stacklevel=level)


def tell(assumption: str) -> None:
    """Say on the terminal what was assumed; once in an interpreter, and never in a worker process."""
    if assumption not in _TOLD and _TELLING.get() and parent_process() is None:
        _TOLD.add(assumption)
        sys.stderr.write(f"seacrane: {assumption}\n")


@contextmanager
def _with(variable: ContextVar[Some], value: Some) -> Iterator[None]:
    before = variable.set(value)
    try:
        yield
    finally:
        variable.reset(before)


def untold() -> AbstractContextManager[None]:
    """Inside, nothing is told: what a file leaves out is in its schema."""
    return _with(_TELLING, False)


def keeping(told: dict[str, None]) -> AbstractContextManager[None]:
    """Keep the messages of all warnings given inside, in their order, whether Python shows them or not."""
    return _with(_LISTENING, (*_LISTENING.get(), told))


def silently(category: type[Warning] = Warning) -> AbstractContextManager[None]:
    """Inside, warnings of a category are not shown: they were given before. Who listens hears them.

    Unlike `warnings.catch_warnings`, which is of the process, this is of the thread that runs it.
    """
    return _with(_SILENCES, (*_SILENCES.get(), category))


@contextmanager
def recorded() -> Iterator[list[Said]]:
    """The warnings that are given inside, to be given again by `say_again`."""
    said: list[Said] = []
    with _with(_RECORDING, (*_RECORDING.get(), (said, len(_SILENCES.get())))):
        yield said


def say_again(said: Iterable[Said]) -> None:
    """Give recorded warnings once more, as if what gave them were done once more."""
    for message, category, aloud in said:
        if aloud:
            warn_caller(message, category)
        else:
            with silently():
                warn_caller(message, category)


def heard(method: Callable[..., Any]) -> Callable[..., Any]:
    """The method of an object with a dict `warned`, which keeps what the method warns of."""

    @wraps(method)
    def listened(self: Any, /, *args: Any, **given: Any) -> Any:
        with keeping(self.warned):
            return method(self, *args, **given)

    return listened
