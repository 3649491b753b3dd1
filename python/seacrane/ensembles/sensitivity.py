"""How a statistic over seeds changes with parameters: differences of runs in the very same waves."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.ensembles.ensemble import ensemble
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import Value
from seacrane.ensembles.study import Source
from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.plotting.text import text_table
from seacrane.result import Result
from seacrane.statistics.estimate import CONFIDENCE, EULER, P90_REDUCED, Estimate
from seacrane.statistics.gumbel import gumbel_fit

Array = NDArray[np.float64]
REDUCED = {"mpm": 0.0, "p90": P90_REDUCED, "mean": EULER}
FEWEST = 10  # seeds
DRAWS = 2000  # of the bootstrap
SEED = 20250101  # of the bootstrap


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Sensitivity:
    """A statistic and its gradient. Made by `sensitivity`; prints as a table.

    Attributes
    ----------
    number : str
        "mean", "mpm" or "p90".
    value : Estimate
        Of the parameters as they are.
    gradients : mapping of str to Estimate
        By parameter, in units of the statistic over that of the parameter.
    steps : mapping of str to float
        To either side.
    saved : mapping of str to float
        How many times as many runs other seeds on either side would take.
    seeds : int
        For which no run failed.
    failures : tuple of str
        Why others failed, each reason once.
    """

    number: str
    value: Estimate
    gradients: Mapping[str, Estimate]
    steps: Mapping[str, float]
    saved: Mapping[str, float]
    seeds: int
    failures: tuple[str, ...]

    def __str__(self) -> str:
        head = ("parameter", "gradient", "per step", "other seeds would take")
        rows = [
            [name, str(one), f"{one.value * self.steps[name]:.3g}", f"{self.saved[name]:.3g} times"]
            for name, one in self.gradients.items()
        ]
        caption = f"{self.number}: {self.value}, {self.seeds} seeds, 95 % intervals"
        return f"{caption}\n{text_table(head, rows, right=(1, 2, 3))}"

    __repr__ = __str__


@named
def sensitivity(
    source: Source,
    *,
    parameters: Mapping[str, tuple[float, float]],
    seeds: Iterable[int],
    keep: Kept | str | Callable[[Result], float],
    number: str = "mean",
    **given: Any,
) -> Sensitivity:
    """Estimate the gradient of a statistic over seeds, by central differences with common random numbers.

    For each seed the lift is run with the parameters as they are and with each of them a step to either side.
    What chance does to both sides is nearly the same and drops out of their difference.

    Parameters
    ----------
    source : Scene or callable
        As of `ensemble`; a function takes `seed` and the parameters.
    parameters : mapping of str to (float, float)
        Value and step of each, such as ``{"loads.tugger.EA": (2e5, 2e4)}``. The error of a central
        difference goes with the square of the step.
    seeds : iterable of int
        At least 10.
    keep : Kept, str or callable
        One number of each run, such as the largest value of a channel, "hook_load.max".
    number : str
        "mean" (default) of it over the seeds; "mpm" or "p90" of largest values by Gumbel's distribution.
    **given
        Further arguments of `ensemble`: t_end, executor, store, rtol and so on.

    Returns
    -------
    Sensitivity
        Intervals of a mean are Student's, of the others those of a bootstrap over the seeds.

    Raises
    ------
    SceneError
        For a value that makes no sense, or fewer than 10 seeds without a failure.
    """
    if number not in REDUCED:
        raise SceneError(f"sensitivity: number is {shown(number)}; choose from {', '.join(REDUCED)}")
    checked = _checked(parameters)
    rows = _rows(checked, list(seeds))
    done = ensemble(source, over=rows, keep={"value": keep}, **given)
    reasons = tuple(dict.fromkeys(done.failures.values()))
    if "value" not in done.dataset:
        raise SceneError(f"sensitivity: every run failed ({reasons[0]})")
    kept = done.dataset["value"].to_numpy()
    if kept.ndim != 1:
        dims = ", ".join(str(dim) for dim in done.dataset["value"].dims[1:])
        raise SceneError(f"sensitivity: what is kept is several numbers, over {dims}; keep one of them")
    table = kept.reshape(-1, 1 + 2 * len(checked))
    good = table[np.isfinite(table).all(axis=1)]
    if len(good) < FEWEST:
        raise SceneError(
            f"sensitivity: {len(good)} seeds without a failure; at least {FEWEST} are needed"
            + (f" ({reasons[0]})" if reasons else "")
        )
    sides = {name: (good[:, 2 * i + 1], good[:, 2 * i + 2]) for i, name in enumerate(checked)}
    steps = {name: step for name, (_, step) in checked.items()}
    return Sensitivity(
        number=number,
        value=_estimate([good[:, 0]], [1.0], number),
        gradients={
            name: _estimate([upper, lower], [0.5 / steps[name], -0.5 / steps[name]], number)
            for name, (lower, upper) in sides.items()
        },
        steps=steps,
        saved={name: _saved(lower, upper) for name, (lower, upper) in sides.items()},
        seeds=len(good),
        failures=reasons,
    )


def _checked(parameters: Any) -> dict[str, tuple[float, float]]:
    if not isinstance(parameters, Mapping) or not parameters:
        raise SceneError(f"parameters is {shown(parameters)}; give (value, step) by name")
    out = {}
    for name, pair in parameters.items():
        if not isinstance(pair, tuple | list) or len(pair) != 2 or name == "seed":
            raise SceneError(f"parameters: {name} is {shown(pair)}; give (value, step), of all but the seed")
        value, step = (number_of(f"parameters: {name}", one) for one in pair)
        if not (np.isfinite(value) and np.isfinite(step) and step > 0.0):
            raise SceneError(f"parameters: {name} is ({value:g}, {step:g}); give a step above zero")
        out[name] = (value, step)
    return out


def _rows(parameters: Mapping[str, tuple[float, float]], seeds: list[int]) -> list[dict[str, Value]]:
    """For each seed the parameters as they are, then each a step below and a step above."""
    if len(set(seeds)) < max(len(seeds), FEWEST):
        raise SceneError(
            f"seeds: {len(set(seeds))} different of {len(seeds)}; give at least {FEWEST}, once each"
        )
    middle = {name: value for name, (value, _) in parameters.items()}
    variants = [middle]
    for name, (value, step) in parameters.items():
        variants += [{**middle, name: value - step}, {**middle, name: value + step}]
    return [{"seed": seed, **variant} for seed in seeds for variant in variants]


def _estimate(samples: list[Array], factors: list[float], number: str) -> Estimate:
    """A weighted sum of the statistic of samples over the same seeds, with its interval."""
    if number == "mean":
        return _of_mean(sum((f * s for f, s in zip(factors, samples, strict=True)), np.zeros(1)))
    draws = np.random.Generator(np.random.Philox(SEED)).integers(
        samples[0].size, size=(DRAWS, samples[0].size)
    )
    value = sum(f * float(_gumbel(s, number)) for f, s in zip(factors, samples, strict=True))
    drawn = sum((f * _gumbel(s[draws], number) for f, s in zip(factors, samples, strict=True)), np.zeros(1))
    low, high = np.quantile(drawn, [(1.0 - CONFIDENCE) / 2.0, (1.0 + CONFIDENCE) / 2.0])
    return Estimate(value=value, low=float(low), high=float(high))


def _gumbel(maxima: Array, number: str) -> Array:
    location, scale = gumbel_fit(maxima)
    return np.asarray(location + REDUCED[number] * scale)


def _of_mean(values: Array) -> Estimate:
    from scipy.stats import t

    middle = float(values.mean())
    half = float(t.ppf((1.0 + CONFIDENCE) / 2.0, values.size - 1) * values.std(ddof=1)) / values.size**0.5
    return Estimate(value=middle, low=middle - half, high=middle + half)


def _saved(lower: Array, upper: Array) -> float:
    """Variance of the difference with other seeds on either side, over that with the same."""
    same = float((upper - lower).var(ddof=1))
    return float(lower.var(ddof=1) + upper.var(ddof=1)) / same if same > 0.0 else float("inf")
