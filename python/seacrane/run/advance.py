"""A run advanced to its end: controllers, Ctrl-C, progress, and what an error carries."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence

from seacrane._core import integrator
from seacrane.analysis.linearise import fastest_mode
from seacrane.errors import SimulationError
from seacrane.result.result import Result
from seacrane.run.controller_calls import Calls
from seacrane.run.interrupts import Interrupts
from seacrane.run.run import Run
from seacrane.run.sampled_controller import SampledController
from seacrane.run.slow import slow_findings
from seacrane.run.step_advice import step_advice
from seacrane.validity.after_run import tried
from seacrane.validity.range import warn_of

Look = Callable[[float], None]


def finished(run: Run, controllers: Sequence[SampledController] = (), *, progress: bool = False) -> Result:
    """Advance a run to its end, or to where Ctrl-C stops it, and return its result.

    What ends it otherwise is raised as by `simulate`, with the outputs until then as its `result`.
    """
    with Interrupts() as interrupts:
        try:
            drive(run, Calls(controllers, run.start.time), interrupts, progress=progress)
        except BaseException as error:
            with contextlib.suppress(MemoryError, AttributeError):  # errors of others take no attributes
                error.result = run.result()  # type: ignore[attr-defined]
            raise
        result, found = run.judged_result()
    warn_of(found)
    return result


def drive(
    run: Run,
    calls: Calls,
    interrupts: Interrupts,
    *,
    progress: bool = False,
    watch: Look | None = None,
    halt: Callable[[], bool] | None = None,
) -> None:
    """Advance a run to its end, or to where Ctrl-C stops it.

    What ends it otherwise is raised as by `simulate`. `watch` is called with the time now and then, between
    two steps, and where a piece of the run ends; there `halt` may end the run, before controllers are called.
    """
    try:
        with _bar(run.start.time, run.t_end, progress) as report:
            looks = [look for look in (watch, report) if look]
            _advance(run, calls, interrupts, looks, watch, halt)
    except KeyboardInterrupt:  # between two pieces of the loop, or inside a controller
        run.interrupted = True
    except MemoryError as error:
        run.interrupted = True
        raise SimulationError(
            f"run: memory ran out at t = {run.core.time:.6g} s; record fewer channels, or a longer dt_out"
        ) from error
    except BaseException as error:  # also what another signal's handler raises
        run.interrupted = True
        _advise(run, error)
        raise
    if not run.interrupted:
        run.slow += tried("looking for modes", lambda: slow_findings(run), [], run.slow)


@contextlib.contextmanager
def _bar(t_start: float, t_end: float, wanted: bool) -> Iterator[Look | None]:
    """What shows the progress of a run."""
    if not wanted:
        yield None
        return
    from tqdm.auto import tqdm

    with tqdm(total=round(t_end - t_start, 3), unit="s", desc="simulated") as bar:
        yield lambda time: bar.update(round(time - t_start - bar.n, 3)) and None


def _advance(
    run: Run,
    calls: Calls,
    interrupts: Interrupts,
    looks: Sequence[Look],
    watch: Look | None,
    halt: Callable[[], bool] | None,
) -> None:
    def look(now: float) -> None:
        for one in looks:
            one(now)
        interrupts.take()

    while True:
        interrupts.take()
        calls.call(run, interrupts)
        stop = min(run.t_end, calls.next(run.core.time))
        reached = run.advance(stop, look)
        if watch is not None:
            watch(run.core.time)
        if not reached or stop >= run.t_end or (halt is not None and halt()):
            return


def _advise(run: Run, error: BaseException) -> None:
    """Say in the error of an explicit method of fixed step how long its step could be."""
    method = run.method
    if not isinstance(error, SimulationError) or not integrator(method.integrator).stable_up_to:
        return
    taken = max(int(run.core.statistics()["steps"]), 1)
    step = method.dt or (run.core.time - run.start.time) / taken
    advice = step_advice(method.integrator, step, fastest_mode(run.model))
    if advice:
        error.args = (f"{error}. {advice}",)
