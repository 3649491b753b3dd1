"""Linear algebra on one thread: shared out among threads, a small matrix waits longer than it is worked on.

OpenBLAS shares out from 8 rows on, and its threads spin while they wait: where other programs run, an
equilibrium takes ten times as long.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import wraps
from threading import Lock
from typing import Any, ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")


class _OneThread:
    """``with one_thread:`` or ``@one_thread``: linear algebra has one thread while such a block is open.

    Libraries know one limit for the whole process; the last block that ends puts back what was there. A
    library that is loaded within a block is limited from the next block in it on: a function that imports
    SciPy opens its own.
    """

    def __init__(self) -> None:
        self._lock = Lock()
        self._open = 0
        self._modules = 0  # that were loaded when libraries were last looked for
        self._controller: Any = None
        self._limits: list[Any] = []

    def __enter__(self) -> None:
        with self._lock:
            new = self._modules != len(sys.modules)
            if new:
                from threadpoolctl import ThreadpoolController

                self._controller, self._modules = ThreadpoolController(), len(sys.modules)
            if new or not self._open:
                self._limits.append(self._controller.limit(limits=1, user_api="blas"))
            self._open += 1

    def __exit__(self, *error: object) -> None:
        with self._lock:
            self._open -= 1
            while not self._open and self._limits:
                self._limits.pop().restore_original_limits()

    def __call__(self, function: Callable[P, T]) -> Callable[P, T]:
        @wraps(function)
        def limited(*args: P.args, **kwargs: P.kwargs) -> T:
            with self:
                return function(*args, **kwargs)

        return limited


one_thread = _OneThread()
