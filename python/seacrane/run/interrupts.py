"""Ctrl-C during a run: taken between two steps and inside controllers, never while outputs are kept."""

from __future__ import annotations

import contextlib
import signal
import threading
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any, Self


class Interrupts:
    """Holds Ctrl-C back within the block until `take` is called.

    What is pressed after the last `take`, such as Ctrl-C twice in a row, asks for nothing more: the run
    has stopped, and its outputs are on their way to the caller. A block within another one takes what is
    pressed in it at once.
    """

    def __init__(self) -> None:
        self._before: Callable[[int, FrameType | None], Any] | None = None  # what Ctrl-C stands for
        self._outer: Callable[[int, FrameType | None], Any] | None = None
        self._pressed: list[tuple[int, FrameType | None]] = []
        self._at_once = False

    def __enter__(self) -> Self:
        if threading.current_thread() is threading.main_thread():
            before = signal.getsignal(signal.SIGINT)
            if callable(before):
                around = getattr(before, "__self__", None)
                self._outer = before
                self._before = around._before if isinstance(around, Interrupts) else before
                signal.signal(signal.SIGINT, self._handle)
        return self

    def __exit__(self, *_: object) -> None:
        if self._outer is not None:
            signal.signal(signal.SIGINT, self._outer)

    def take(self) -> None:
        """Do what Ctrl-C stands for, if it was pressed: as a rule, raise KeyboardInterrupt."""
        while self._pressed and self._before is not None:
            self._before(*self._pressed.pop())

    @contextlib.contextmanager
    def at_once(self) -> Iterator[None]:
        """Within the block, which is not ours, nothing is held back."""
        self._at_once = True
        try:
            self.take()
            yield
        finally:
            self._at_once = False

    def _handle(self, number: int, frame: FrameType | None) -> None:
        if self._at_once and self._before is not None:
            self._before(number, frame)
        else:
            self._pressed.append((number, frame))


@contextlib.contextmanager
def interrupts_kept() -> Iterator[None]:
    """Hold Ctrl-C back within the block, and do what it stands for at its end.

    Python raises KeyboardInterrupt wherever it is. Within a destructor, the callback of a weak reference or
    the import of a compiled module, of which libraries have many, it is forgotten.
    """
    interrupts = Interrupts()
    try:
        with interrupts:
            yield
    finally:
        interrupts.take()
