"""Runs in processes of their own, so that neither a hang nor a crash can pass unseen or stop the atlas."""

from __future__ import annotations

import contextlib
import multiprocessing
import queue
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from multiprocessing.connection import Connection
from typing import Any

from seacrane import Method, SeacraneError
from seacrane.accuracy import row as rows
from seacrane.accuracy.measured import Reference
from seacrane.accuracy.row import Row
from stability_atlas.methods import DEFAULT

DEFAULT_LIMIT_S = 20.0  # the default setting must end, not be cut off, on a slow machine too
BUSY = 8.0  # times more wall than processor time on a busy machine
GRACE_S = 60.0  # wall time, beyond what the times granted may take: who has not answered by then hangs


@dataclass(frozen=True, kw_only=True)
class Group:
    """Settings of one value of one axis: they share a reference."""

    axis: str
    value: float
    methods: tuple[Method, ...]
    limit_s: float
    with_reference: bool = True

    def empty(self, method: Method) -> Row:
        """The row of a setting, yet to be measured."""
        return Row(case={"axis": self.axis, "value": self.value}, method=method)


def serve(pipe: Connection) -> None:
    """What a worker does, until its caller has gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the caller's, who ends this process
    with contextlib.suppress(EOFError, BrokenPipeError):
        _serve(pipe)


def _serve(pipe: Connection) -> None:
    """Take groups, send rows, one by one; None ends a group."""
    from stability_atlas.axes import AXES
    from stability_atlas.measure import measure, reference_of

    while (group := pipe.recv()) is not None:
        case: Any = None
        truth = Reference()
        for method in group.methods:
            row = group.empty(method)
            try:
                if case is None:
                    case = AXES[group.axis].case(group.value)
                    truth = reference_of(case, group.limit_s) if group.with_reference else Reference()
            except Exception as error:  # the scene itself is refused, or should have been
                if isinstance(error, (SeacraneError, ValueError)):
                    pipe.send(row.ended(rows.REFUSED, error))
                else:
                    pipe.send(row.ended(rows.UNNAMED, f"{type(error).__name__}: {error}"))
                continue
            limit_s = max(group.limit_s, DEFAULT_LIMIT_S) if method == DEFAULT else group.limit_s
            pipe.send(measure(case, method, truth, limit_s, row))
        pipe.send(None)


class _Worker:
    """A process that serves, replaced when it hangs or crashes."""

    def __init__(self) -> None:
        self._start()

    def _start(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.process = context.Process(target=serve, args=(theirs,), daemon=True)
        self.process.start()
        theirs.close()

    def run(self, group: Group, take: Callable[[Row], None]) -> None:
        """All rows of a group, each handed over as it is known."""
        left = list(group.methods)
        while left:
            verdict = self._ask(replace(group, methods=tuple(left)), left, take)
            if verdict is None:
                return
            self.stop()
            self._start()
            group = replace(group, with_reference=group.with_reference and len(left) < len(group.methods))
            take(replace(group.empty(left.pop(0)), verdict=verdict, message=f"the process {verdict}"))

    def _ask(self, group: Group, left: list[Method], take: Callable[[Row], None]) -> str | None:
        """What ended it before its end; removes from `left` what is done."""
        patience = GRACE_S + BUSY * (
            20.0 * group.limit_s + DEFAULT_LIMIT_S
        )  # the first row waits for the reference, too
        try:
            self.pipe.send(group)
            while self.pipe.poll(patience):
                row = self.pipe.recv()
                if row is None:
                    return None
                take(row)
                left.pop(0)
                patience = GRACE_S + BUSY * max(group.limit_s, DEFAULT_LIMIT_S)
        except (EOFError, OSError):
            return rows.CRASHED
        return rows.HUNG

    def stop(self) -> None:
        self.process.kill()
        self.process.join()
        self.pipe.close()


def run_all(groups: Sequence[Group], jobs: int) -> Iterator[Row]:
    """Rows of all groups as they come, from `jobs` processes at a time."""
    waiting: queue.SimpleQueue[Group] = queue.SimpleQueue()
    for group in groups:
        waiting.put(group)
    done: queue.SimpleQueue[Row | BaseException | None] = queue.SimpleQueue()
    workers = [_Worker() for _ in range(min(jobs, len(groups)))]

    def feed(worker: _Worker) -> None:
        try:
            while True:
                worker.run(waiting.get_nowait(), done.put)
        except queue.Empty:
            done.put(None)
        except BaseException as error:  # a thread that dies in silence would leave the caller waiting
            done.put(error)

    threads = [threading.Thread(target=feed, args=(worker,), daemon=True) for worker in workers]
    for thread in threads:
        thread.start()
    try:
        running = len(threads)
        while running:
            row = done.get()
            if isinstance(row, BaseException):
                raise row
            if row is None:
                running -= 1
            else:
                yield row
    finally:
        for worker in workers:
            worker.stop()
