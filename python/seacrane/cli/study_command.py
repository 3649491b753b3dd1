"""``seacrane study``, ``merge``, ``sheet`` and ``answers``: run a lift into a folder, or go on with it."""

from __future__ import annotations

import argparse
import contextlib
import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from seacrane.cli.command_line import INTERRUPTED
from seacrane.errors import SceneError, WorkerVersionError
from seacrane.version import __version__

if TYPE_CHECKING:
    from seacrane.ensembles import Ensemble, Price
    from seacrane.plotting.table import Answer

Done = TypeVar("Done")
NOTHING_LEFT = "price: no member is left to be measured"
MERGE = "seacrane merge takes all parts"


def study(arguments: argparse.Namespace) -> int:
    """Run the members that are not there, and tell what all of them say; 130 after Ctrl-C."""
    from seacrane.cli.result_commands import show_study
    from seacrane.lift.study_run import run_study

    def told(price: Price | None) -> bool:
        if price is not None or arguments.price:
            print(price or NOTHING_LEFT, flush=True)
        return not arguments.price

    def tell(done: Ensemble) -> None:
        if arguments.price:
            return
        if done.accuracy is not None:
            print(done.accuracy)
        if arguments.part is None:
            show_study(arguments.out, None)
        else:
            print(f"part {arguments.part} is done, {len(done.failures)} failed; {MERGE}")

    limit, part = arguments.member_limit, arguments.part
    run = partial(run_study, arguments.study, member_limit=limit, part=part, priced=told)
    return _done(arguments, run, tell)


def merge(arguments: argparse.Namespace) -> int:
    """Make one study or sheet of its parts, and tell what it says."""
    from seacrane.cli.result_commands import show_study
    from seacrane.lift.sheet_run import FILE, merge_sheet
    from seacrane.lift.study_run import merge_study

    if (Path(arguments.parts[0]) / FILE).is_file():
        print(merge_sheet(arguments.parts, arguments.out))
        return 0
    merge_study(arguments.parts, arguments.out)
    show_study(arguments.out, None)
    return 0


def sheet(arguments: argparse.Namespace) -> int:
    """Print the sheet and what is held against it; 130 after Ctrl-C."""
    from seacrane.lift.sheet_run import SheetRun, run_sheet

    def told(price: Price | None) -> bool:
        print(price or NOTHING_LEFT)
        return False

    def tell(done: SheetRun | None) -> None:
        if not arguments.price:
            print(done or f"part {arguments.part} is done; {MERGE}")

    priced = told if arguments.price else None
    return _done(arguments, partial(run_sheet, arguments.sheet, part=arguments.part, priced=priced), tell)


def answers(arguments: argparse.Namespace) -> int:
    """Print the answers that a lift asks for; 130 after Ctrl-C."""
    from seacrane.lift.answers_run import run_answers

    def tell(done: Mapping[str, Answer]) -> None:
        print("\n\n".join(map(str, done.values())))

    return _done(arguments, partial(run_answers, arguments.lift), tell)


def _done(arguments: argparse.Namespace, run: Callable[..., Done], tell: Callable[[Done], None]) -> int:
    """Run it into the folder, and tell what was found; 130 after Ctrl-C, which is told."""
    progress = arguments.progress or sys.stderr.isatty()
    with _executor(arguments) as executor:
        try:
            done = run(arguments.out, executor=executor, progress=progress)
        except KeyboardInterrupt:
            _end_workers(executor)
            print(
                f"seacrane {arguments.command}: interrupted; {arguments.out} keeps what came back, and the "
                "same command goes on",
                file=sys.stderr,
            )
            return INTERRUPTED
    tell(done)
    return 0


@contextlib.contextmanager
def _executor(arguments: argparse.Namespace) -> Iterator[Executor | None]:
    """Processes, a Dask cluster, or None for this process alone."""
    if arguments.dask is not None:
        if arguments.workers is not None:
            raise SceneError("--workers and --dask are both given; leave one out")
        with _cluster(arguments.dask) as executor:
            yield executor
    elif arguments.workers is None or arguments.workers == 1:
        yield None
    elif arguments.workers < 1:
        raise SceneError(f"--workers is {arguments.workers}; give a number from 1 on")
    else:
        from concurrent.futures import ProcessPoolExecutor
        from multiprocessing import get_context

        with ProcessPoolExecutor(  # the terminal sends Ctrl-C to workers too, who leave it to the parent
            arguments.workers, mp_context=get_context("spawn"), initializer=signal.signal,
            initargs=(signal.SIGINT, signal.SIG_IGN),
        ) as pool:  # fmt: skip
            yield pool


def _end_workers(executor: Executor | None) -> None:
    """End the processes of the pool, with the members in flight.

    The pool would wait for what it still writes to them, and for what one of them was writing: their ends of
    the two pipes are closed, as CPython does with one of them where a pool breaks (its issue 94777).
    """
    from multiprocessing import active_children

    queues = [getattr(executor, name, None) for name in ("_call_queue", "_result_queue")]
    if executor is not None:
        executor.shutdown(wait=False, cancel_futures=True)
    for child in active_children():
        child.terminate()
        child.join()
    for queue, side in zip(queues, ("_reader", "_writer"), strict=True):
        with contextlib.suppress(OSError, AttributeError):
            getattr(queue, side).close()


@contextlib.contextmanager
def _cluster(address: str) -> Iterator[Executor]:
    try:
        client = import_module("distributed").Client(address, timeout="10s")
    except ModuleNotFoundError as error:
        raise SceneError("--dask takes dask.distributed: pip install 'seacrane[ensemble]'") from error
    except (OSError, ValueError) as error:
        raise SceneError(f"--dask {address}: no scheduler answers there ({error})") from error
    with client:
        with contextlib.suppress(TimeoutError):
            client.wait_for_workers(1, timeout=10.0)
        versions = client.run(_version_finder())
        if not versions:
            raise SceneError(f"--dask {address}: the cluster has no worker; start at least one")
        for worker, version in versions.items():
            if version != __version__:  # what is sent to such a worker would have no answer
                has = f"seacrane {version}" if version else "no seacrane"
                raise WorkerVersionError(
                    f"--dask {address}: worker {worker} has {has}; install {__version__} there"
                )
        yield client.get_executor()


def _version_finder() -> Callable[[], str | None]:
    """A function that Dask sends as code, for a worker may not have the module in which it stands."""

    def version() -> str | None:
        from importlib import import_module

        try:
            return str(import_module("seacrane.version").__version__)
        except ModuleNotFoundError:
            return None

    return version
