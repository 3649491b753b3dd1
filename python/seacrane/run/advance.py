"""A run advanced to its end: controllers, Ctrl-C, progress, and what an error carries."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator, Sequence

from seacrane import _core
from seacrane.analysis.after_run import Finding, tried, warn_of
from seacrane.analysis.linearise import fastest_mode
from seacrane.errors import SimulationError
from seacrane.result.result import Result
from seacrane.run.interrupts import Interrupts
from seacrane.run.modes import FEWEST_STEPS, Modes, growing, stiffness, unsteady_oil
from seacrane.run.run import Run
from seacrane.run.sampled_controller import Calls, SampledController

Look = Callable[[float], None]
NEAR = 0.8  # of a limit: from there on a run in another sea is looked at by itself


def finished(run: Run, controllers: Sequence[SampledController] = (), *, progress: bool = False) -> Result:
    """Advance a run to its end, or to where Ctrl-C stops it, and return its result.

    What ends it otherwise is raised as by `simulate`, with the outputs until then as its `result`.
    """
    with Interrupts() as interrupts:
        ended(run, controllers, interrupts, progress=progress)
        result, found = run.judged_result()
    warn_of(found)
    return result


def ended(
    run: Run, controllers: Sequence[SampledController], interrupts: Interrupts, *, progress: bool = False
) -> None:
    """Advance a run to its end, or to where Ctrl-C stops it.

    Errors carry the outputs until then as their `result`.
    """
    try:
        drive(run, Calls(controllers, run.start.time), interrupts, progress=progress)
    except BaseException as error:
        with contextlib.suppress(MemoryError, AttributeError):  # errors of others take no attributes
            error.result = run.result()  # type: ignore[attr-defined]
        raise


def drive(
    run: Run,
    calls: Calls,
    interrupts: Interrupts,
    *,
    progress: bool = False,
    watch: Look = lambda _: None,
    halt: Callable[[], object] | None = None,
) -> None:
    """Advance a run to its end, or to where Ctrl-C stops it.

    What ends it otherwise is raised as by `simulate`. `watch` is called with the time now and then, between
    two steps, and where a piece of the run ends; there `halt` may end the run, before controllers are called.
    """
    try:
        with _bar(run.start.time, run.t_end, progress) as report:

            def look(now: float) -> None:
                watch(now)
                report(now)
                interrupts.take()

            while True:
                interrupts.take()
                calls.call(run, interrupts)
                stop = min(run.t_end, calls.next(run.core.time))
                reached = run.advance(stop, look)
                watch(run.core.time)
                if not reached or stop >= run.t_end or (halt is not None and halt()):
                    break
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
def _bar(t_start: float, t_end: float, wanted: bool) -> Iterator[Look]:
    """What shows the progress of a run."""
    if not wanted:
        yield lambda _: None
        return
    from tqdm.auto import tqdm

    with tqdm(total=round(t_end - t_start, 3), unit="s", desc="simulated") as bar:
        yield lambda time: bar.update(round(time - t_start - bar.n, 3)) and None


def _advise(run: Run, error: BaseException) -> None:
    """Say in the error of an explicit method of fixed step how long its step could be."""
    name, dt = run.method.integrator, run.method.dt
    limit = _core.integrator(name).stable_up_to
    if not isinstance(error, SimulationError) or not limit:
        return
    step = dt or (run.core.time - run.start.time) / max(int(run.core.statistics()["steps"]), 1)
    fastest = fastest_mode(run.model)
    if fastest and fastest * step > limit:
        error.args = (
            f"{error}. The fastest mode at the start is {fastest:.4g} per s: {name} is unstable with steps "
            f"longer than about {limit / fastest:.3g} s, and took {step:.3g} s; give "
            f"dt={0.5 * limit / fastest:.1g}, or an adaptive integrator",
        )


def slow_findings(run: Run) -> list[Finding]:
    """By the modes where the run began and where it is.

    Of a run made by `Run.in_sea` they are found only where the modes at the common start, found once for all
    such runs, come near a limit.
    """
    many = run.core.steps >= FEWEST_STEPS
    if run.start_modes is not None and not (many and _found(run, run.start_modes, near=NEAR)):
        return []
    last = run.last_state()
    states = [run.start] if last is None else [run.start, last]
    found = _found(run, Modes(run.model, list(run.scene.bodies), states)) if many else []
    return found + unsteady_oil(run.scene, run.model, states)


def _found(run: Run, modes: Modes, near: float = 1.0) -> list[Finding]:
    stats, settings = run.stats(), run.settings
    remembering = [vessel.body for vessel in run.scene.vessels.values()] if stats["history_samples"] else []
    found = stiffness(run.scene.loads, modes, stats, settings, near=near)
    return found + growing(modes, stats, settings, undamped=remembering, near=near)
