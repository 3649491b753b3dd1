"""What of a run is kept: a channel now and then, its mean, scatter and extremes, or what a function makes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal

import numpy as np

from seacrane.accuracy.quantities import STAGE, stage_time
from seacrane.description.channels import attributes, unit_of
from seacrane.description.pick import Pick, pick_of
from seacrane.ensembles.dataset import Labelled
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of, positive_of, text_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.result.record import Record

NUMBERS: Mapping[str, tuple[Callable[..., Any], str]] = {
    "mean": (np.mean, "mean"),
    "standard_deviation": (np.std, "standard deviation"),
    "maximum": (np.max, "largest"),
    "minimum": (np.min, "smallest"),
}
SHORT: Mapping[str, str] = {"max": "maximum", "min": "minimum", "std": "standard_deviation"}


@named
@dataclass(frozen=True, kw_only=True)
class Kept:
    """One channel of a run, or a number for it.

    Where something is kept by name, a short text says the same: ``"hook_load.max"``, ``"roll.std"``,
    ``"position[load, z, after=60].min"``.

    Attributes
    ----------
    channel : str
        Its name, or a selector with names in brackets, as of `Result.select`.
    what : str
        "series" (default): values over time. "mean", "standard_deviation": of its output times, each with the
        same weight. "maximum", "minimum": of the run, also between outputs, see `Result.reached`.
    names : mapping of str to str
        Names along its dimensions, as of `Result.select`, such as ``{"body": "payload", "axis": "z"}``;
        dimensions that are not named are kept.
    after : float
        s: earlier outputs are left out, such as transients of the start.
    stage : str
        Of a lift in stages: the outputs of this one alone, such as of ``"hook_load[stage=lift].max"``.
    interval : float, optional
        s between the values of a series, a multiple of the output interval; default: that interval.

    Raises
    ------
    SceneError
        For a value that makes no sense. Whether a scene has the channel is known when it is run.
    """

    channel: str
    what: Literal["series", "mean", "standard_deviation", "maximum", "minimum"] = "series"
    names: Mapping[str, str] = field(default_factory=dict)
    after: float = 0.0
    interval: float | None = None
    stage: str = ""

    def __post_init__(self) -> None:
        if isinstance(self.channel, Pick) or "[" in text_of("kept: channel", self.channel):
            self._take(pick_of("kept: channel", self.channel))
        if self.what not in ("series", *NUMBERS):
            known = ", ".join(map(repr, ("series", *NUMBERS)))
            raise SceneError(f"kept {self.channel}: what is {self.what!r}; choose {known}")
        if not isinstance(self.names, Mapping):
            raise SceneError(f"kept {self.channel}: names is {shown(self.names)}; give names by dimension")
        finite_of(f"kept {self.channel}: after", self.after, "s")
        if self.interval is None:
            return
        if self.what != "series":
            raise SceneError(f"kept {self.channel}: interval is for a series; leave it out of {self.what!r}")
        positive_of(f"kept {self.channel}: interval", self.interval, "s")

    @classmethod
    def of_text(cls, text: str) -> Kept:
        """What a short text keeps: a selector, then a point and a number; without these the series.

        Raises
        ------
        SceneError
            For a text that is none, and as `Kept`.
        """
        selector, _, last = text_of("kept", text).rpartition(".")
        what = SHORT.get(last, last)
        if what not in ("series", *NUMBERS) or not selector:
            selector, what = text, "series"
        pick = pick_of(f"kept {shown(text)}", selector)
        kept: Any = what
        return cls(
            channel=pick.channel, what=kept, names=pick.names, after=pick.after or 0.0, stage=pick.stage or ""
        )

    def _take(self, pick: Pick) -> None:
        """The names and the time of a selector, beside which neither `names` nor `after` says the same."""
        if not isinstance(self.names, Mapping) or self.names.keys() & pick.names.keys():
            raise SceneError(f"kept {pick}: names is {shown(self.names)}; give each name once")
        if (pick.after is not None and self.after) or (pick.stage is not None and self.stage):
            raise SceneError(f"kept {pick}: {pick.parts} is given twice; leave one out")
        object.__setattr__(self, "stage", self.stage or pick.stage or "")
        object.__setattr__(self, "channel", pick.channel)
        object.__setattr__(self, "names", {**pick.names, **self.names})
        object.__setattr__(self, "after", self.after if pick.after is None else pick.after)

    def require_times(self, t_end: float, interval: float) -> None:
        """Raise SceneError where a run to `t_end` (s) with outputs at an interval (s) has none of it."""
        if self.after > t_end:
            raise SceneError(f"kept {self.channel}: after is {self.after:g} s, the run ends at {t_end:g} s")
        every = 1.0 if self.interval is None else self.interval / interval
        if abs(every - round(every)) > 1e-9 * every or every < 0.5:
            raise SceneError(
                f"kept {self.channel}: interval is {self.interval:g} s, no multiple of the output interval "
                f"of {interval:g} s; give a multiple"
            )

    def of(self, result: Record) -> Labelled:
        """It, of a result."""
        channel = result.select(self.channel, **self.names)
        dims = tuple(dim for dim in result.dims[self.channel] if dim not in self.names)
        coords = {dim: np.array(result.coords[dim]) for dim in dims[1:]}
        told = attributes(self.channel) | {"units": unit_of(self.channel, self.names.values())}
        part = result.part(after=self.after, stage=self.stage or None)
        time, channel = result.time[part], channel[part]
        if not time.size:
            raise SceneError(f"kept {self.channel}: the run has no output in the part that is asked for")
        if self.what == "series":
            every = 1
            if self.interval is not None and result.time.size > 1:
                every = round(self.interval / float(result.time[1] - result.time[0]))
            coords = {"time": time[::every], **coords}
            return Labelled(values=np.array(channel[::every]), dims=dims, coords=coords, attributes=told)
        least, largest = result.reached(self.channel, part=part, **self.names)
        of = {"minimum": least, "maximum": largest}.get(self.what, channel)
        number, words = NUMBERS[self.what]
        values = np.asarray(number(of, axis=0), dtype=float)
        told = told | {"long_name": f"{words} of {told['long_name']}"}
        return Labelled(values=values, dims=dims[1:], coords=coords, attributes=told)


@dataclass(frozen=True, kw_only=True)
class StageTime:
    """When a stage of a lift begins or ends, or how long it takes, s: ``"stage[lift].end"``."""

    stage: str
    what: Literal["start", "end", "duration"] = "end"

    def __str__(self) -> str:
        return f"{self.what} of stage {self.stage}"

    @classmethod
    def of_text(cls, text: str) -> StageTime | None:
        """What a short text asks for; None where it asks for something else."""
        found = STAGE.fullmatch(text)
        return None if found is None else cls(stage=found[1].strip("\"'"), what=found[2])  # type: ignore[arg-type]

    def __call__(self, result: Result) -> float:
        """What is kept of a result; SceneError where it has no such stage."""
        return stage_time(result, self.stage, self.what, "kept")


def made_by(name: str, function: Callable[[Any], Any], result: Record) -> Labelled:
    """What a user's function makes of a result, in dimensions named after it."""
    try:
        values = np.asarray(function(result), dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise SceneError(f"keep {name!r}: {error}; return a number or an array of numbers") from error
    return Labelled(values=values, dims=tuple(f"{name}_{axis}" for axis in range(values.ndim)))
