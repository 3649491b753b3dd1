"""Linear algebra on one thread: shared out among threads, a small matrix waits longer than it is worked on.

OpenBLAS shares out from 8 rows on, and its threads spin while they wait: where other programs run, an
equilibrium takes ten times as long.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import wraps
from threading import Lock, local
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
Limits = list[tuple[Any, int]]  # a library, and the threads that it had


class _Here(local):
    """The state of each thread: blocks that it has open, and what libraries count for it alone."""

    def __init__(self) -> None:
        self.open = 0
        self.limits: Limits = []


class _OneThread:
    """``with one_thread:`` or ``@one_thread``: linear algebra has one thread while such a block is open.

    Most libraries know one number for the whole process: the last block that ends puts back what was there. A
    library that is loaded within a block is limited from the next block in it on: a function that imports
    SciPy opens its own.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._open = 0
        self._limits: Limits = []
        self._here = _Here()
        self._modules = 0  # that were loaded when libraries were last looked for
        self._libraries: list[Any] = []

    def __enter__(self) -> None:
        with self._lock:
            here = self._here
            new = self._modules != len(sys.modules)
            if new:
                from threadpoolctl import ThreadpoolController

                self._libraries = ThreadpoolController().select(user_api="blas").lib_controllers
                self._modules = len(sys.modules)
            if new or not here.open:
                for library in self._libraries:
                    number = library.get_num_threads()
                    if number is not None and number > 1:
                        own = getattr(library, "threading_layer", "") == "openmp"
                        (here.limits if own else self._limits).append((library, number))
                        _set(library, 1)
            self._open += 1
            here.open += 1

    def __exit__(self, *error: object) -> None:
        with self._lock:
            here = self._here
            self._open -= 1
            here.open -= 1
            for limits, still_open in ((here.limits, here.open), (self._limits, self._open)):
                while limits and not still_open:
                    _set(*limits.pop())

    def __call__(self, function: Callable[P, T]) -> Callable[P, T]:
        @wraps(function)
        def limited(*args: P.args, **kwargs: P.kwargs) -> T:
            with self:
                return function(*args, **kwargs)

        return limited


def _set(library: Any, number: int) -> None:
    """Newer versions of threadpoolctl let one thread alone set OpenBLAS's number, and ignore the others."""
    free = getattr(library, "clear_controlling_thread", lambda *, force: None)
    free(force=True)
    library.set_num_threads(number)
    free(force=True)


one_thread = _OneThread()
