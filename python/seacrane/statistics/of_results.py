"""extremes(): of a channel of one run, or of the same channel over the runs of several seeds."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.channels import unit_of
from seacrane.description.pick import Pick, pick_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import flag_of, number_of
from seacrane.inputs.described import described
from seacrane.inputs.keywords import named
from seacrane.result import Result
from seacrane.statistics.estimate import THREE_HOURS
from seacrane.statistics.record import FEWEST_VALUES, record_of, up_crossings, warn_of_repeat, warn_of_start
from seacrane.statistics.record_extremes import RecordExtremes, record_extremes
from seacrane.statistics.seeds import SeedExtremes, seed_extremes

EVEN = 1e-6  # of a step by which output times may be uneven


@named
def extremes(
    result: Result | Iterable[Result],
    *,
    channel: str,
    exposure: float = THREE_HOURS,
    after: float = 0.0,
    smallest: bool = False,
    tail: str = "pareto",
    threshold: float | None = None,
    static: float | None = None,
    half_width: float | None = None,
    **names: str,
) -> RecordExtremes | SeedExtremes:
    """Estimate the largest value of a channel in an exposure time, and how sure that is.

    Parameters
    ----------
    result : Result or several
        Of one run: by its up-crossings and its peaks over a threshold. Of the same lift with several seeds:
        by the distribution of their maxima.
    channel : str
        With outputs at even times; a selector with names in brackets does as well, "position[load, z]".
    exposure : float
        s; default 3 h.
    after : float
        Time before which outputs are left out, s.
    smallest : bool
        Ask for the smallest value: every number is then that of the channel with its sign changed.
    tail, threshold
        Of one run, as `record_extremes` takes them.
    static : float, optional
        As both functions take it; default the mean of the outputs, with the sign changed where they are.
    half_width : float, optional
        Of several runs, as `seed_extremes` takes it.
    **names : str
        One for each dimension of the channel, such as ``body="payload", axis="z"``.

    Returns
    -------
    RecordExtremes or SeedExtremes

    Raises
    ------
    SceneError
        For a channel or name that is not there, runs of different length, uneven times, or a number out
        of range.

    Warns
    -----
    FewSeedsWarning, StartTransientWarning, RepeatingSeaWarning, PoorFitWarning
    """
    sign = -1.0 if flag_of("smallest", smallest) else 1.0
    results = [result] if isinstance(result, Result) else _several(result)
    pick = pick_of("extremes", channel, names, held=results[0].channels)
    begin = number_of("after", after) if pick.after is None else pick.after
    channel, names = pick.channel, dict(pick.names)
    parts = [one.part(after=begin, stage=pick.stage) for one in results]
    records = [_record(one, channel, part, sign, names) for one, part in zip(results, parts, strict=True)]
    called = " ".join(["minus " * (sign < 0.0) + channel, *names.values()])
    words = {"name": called, "unit": unit_of(channel, names.values())}
    if isinstance(result, Result):
        (values, step), repeat = records[0], _repeat(result)
        return record_extremes(
            values, interval=step, exposure=exposure, tail=tail, threshold=threshold, static=static,
            repeat=repeat, **words,
        )  # fmt: skip
    durations = [values.size * step for values, step in records]
    if max(durations) - min(durations) > EVEN * max(durations):
        raise SceneError(
            f"runs of {min(durations):g} to {max(durations):g} s: the maxima of seeds are of one length; "
            "leave interrupted runs out"
        )
    for one, (values, _) in zip(results, records, strict=True):
        warn_of_start(values, up_crossings(values, float(values.mean())).size)
        warn_of_repeat(_repeat(one), durations[0])
    rest = float(np.mean([values.mean() for values, _ in records]))
    picked = Pick(channel=channel, names=names)
    bounds = [one.reached(picked, part=part) for one, part in zip(results, parts, strict=True)]
    return seed_extremes(
        [float((largest if sign > 0.0 else -least).max()) for least, largest in bounds],
        duration=durations[0], exposure=exposure, static=rest if static is None else static,
        half_width=half_width,
        **words,
    )  # fmt: skip


def _several(results: Iterable[Result]) -> list[Result]:
    if not isinstance(results, Iterable):
        raise SceneError(f"result is {described(results)}; give a Result, or those of several seeds")
    listed = list(results)
    for one in listed:
        if not isinstance(one, Result):
            raise SceneError(f"results hold {described(one)}; give what simulate() returns")
    if not listed:
        raise SceneError("results: none is given")
    return listed


def _record(
    result: Result, channel: str, part: slice, sign: float, names: dict[str, str]
) -> tuple[Array, float]:
    """A part of one curve, and the time between two of its values, s."""
    curve = result.curve(channel, **names)
    time, values = result.time[part], sign * curve[part]
    if time.size < FEWEST_VALUES:
        raise SceneError(
            f"{time.size} outputs in the part that is asked for: at least {FEWEST_VALUES} are needed"
        )
    if not np.isfinite(values).all():
        raise SceneError(f"channel {channel!r} has gaps: ask for a part of the run, or another channel")
    steps = np.diff(time)
    if np.ptp(steps) > EVEN * steps.mean():
        raise SceneError(
            f"output times are uneven ({steps.min():g} to {steps.max():g} s): simulate with dt_out="
        )
    return record_of(values), float(steps.mean())


def _repeat(result: Result) -> float | None:
    """Time after which the sea of a run comes back on itself, s; None where it is not known to."""
    period: Any = result.stats.get("repeat_period_s") if result.stats.get("repeat_found") else None
    return None if period is None else float(period)
