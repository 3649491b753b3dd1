"""One method for a whole ensemble by the error that its runs may have: few probes, and checks at random."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from seacrane.accuracy.asked import asked
from seacrane.accuracy.case import Case
from seacrane.accuracy.choice import error_of, run_to_accuracy
from seacrane.ensembles.job import Prepared
from seacrane.ensembles.members import Members, Value
from seacrane.ensembles.study import Study
from seacrane.inputs.caller import warn_caller
from seacrane.one_thread import one_thread
from seacrane.run.method import Method
from seacrane.warnings import AccuracyNotHeldWarning

A_PROBE_FOR, MOST_PROBES = 25, 3  # members; each probe takes about two runs
CHECKED = 0.04  # of the members, each by its run once more and a cheap one
SEED = 20250101  # of which members are checked

Errors = Mapping[str, float]


@dataclass(frozen=True, kw_only=True)
class EnsembleAccuracy:
    """The method of an ensemble and the errors that were found.

    Attributes
    ----------
    method : Method
        Of all members: the tightest that a probe asked for.
    limits : mapping of str to float
        As `accuracy` has them, in the units of the quantities.
    probes, checks : mapping of int to mapping
        Estimated errors by member and quantity.
    cost : float
        Evaluations of all runs over those of the members alone.
    """

    method: Method
    limits: Errors
    probes: Mapping[int, Errors]
    checks: Mapping[int, Errors]
    cost: float

    def __str__(self) -> str:
        worst = max((self.excess(errors) for errors in self.checks.values()), default=0.0)
        told = (
            f"; largest error of {len(self.checks)} checked: {worst:.2g} of its limit" if self.checks else ""
        )
        return f"by accuracy: {self.method.integrator} {self.method.setting}{told}"

    @property
    def held(self) -> bool:
        """Whether every member that was checked is within the limits."""
        return all(self.excess(errors) <= 1.0 for errors in self.checks.values())

    def excess(self, errors: Errors) -> float:
        """Largest error over its limit."""
        return max(errors[name] / limit for name, limit in self.limits.items())


@dataclass(frozen=True, kw_only=True)
class Probe:
    """What a probe found: a method that does, its error, and evaluations of its run and of all it took."""

    method: Method
    errors: Errors
    run: int
    all: int


def probed(
    study: Study, members: Members, accuracy: Mapping[str, float], executor: Executor | None
) -> dict[int, Probe]:
    """Probes by member, which lie evenly among all.

    Raises SceneError as of ``simulate(accuracy=...)``.
    """
    count = len(members)
    number = min(max(count // A_PROBE_FOR, 1), MOST_PROBES)
    places = [int((2 * place + 1) * count / (2 * number)) for place in range(number)]
    return _each(_probe, study, members, accuracy, places, executor)


def checked(
    study: Study,
    members: Members,
    accuracy: Mapping[str, float],
    probes: Mapping[int, Probe],
    ran: Iterable[int],
    executor: Executor | None,
) -> EnsembleAccuracy:
    """Check members at random, of those that ran without a failure; warns with AccuracyNotHeldWarning."""
    left = [index for index in ran if index not in probes]
    number = min(max(1, round(CHECKED * (len(left) + len(probes)))), len(left))
    random = np.random.Generator(np.random.Philox(SEED))
    places = sorted(int(left[place]) for place in random.choice(len(left), number, replace=False))
    checks = _each(_check, study, members, accuracy, places, executor)
    one = np.mean([probe.run for probe in (*probes.values(), *checks.values())])
    more = sum(probe.all for probe in (*probes.values(), *checks.values()))
    told = EnsembleAccuracy(
        method=study.method,
        limits=dict(accuracy),
        probes={index: probe.errors for index, probe in probes.items()},
        checks={index: probe.errors for index, probe in checks.items()},
        cost=1.0 + more / (float(one) * max(len(left) + len(probes), 1)),
    )
    _warn(told, members)
    return told


def _warn(told: EnsembleAccuracy, members: Members) -> None:
    if told.held:
        return
    index, errors = max(told.checks.items(), key=lambda item: told.excess(item[1]))
    name = max(told.limits, key=lambda one: errors[one] / told.limits[one])
    beyond = sum(told.excess(one) > 1.0 for one in told.checks.values())
    at = ", ".join(f"{key}={value!r}" for key, value in members.values(index).items())
    warn_caller(
        f"accuracy: {beyond} of {len(told.checks)} members that were checked are beyond it; worst is member "
        f"{index} ({at}): {name} has an error of {errors[name]:.3g}, allowed are {told.limits[name]:g}. Give "
        f"rtol={told.method.used_rtol / 10.0:g} in its place",
        AccuracyNotHeldWarning,
    )


def _each(
    function: Callable[[Study, Mapping[str, float], Mapping[str, Value]], Probe],
    study: Study,
    members: Members,
    accuracy: Mapping[str, float],
    places: list[int],
    executor: Executor | None,
) -> dict[int, Probe]:
    how = map if executor is None else executor.map
    found = how(partial(function, study, accuracy), map(members.values, places))
    return dict(zip(places, found, strict=True))


@one_thread
def _probe(study: Study, accuracy: Mapping[str, float], values: Mapping[str, Value]) -> Probe:
    case = _case(study, values)
    result = run_to_accuracy(case, accuracy, method=study.method, outputs=study.outputs, shorthand={})
    if result.interrupted:
        raise KeyboardInterrupt
    stats = result.stats
    tolerance = float(result.settings["rtol"])
    method = replace(study.method, integrator=str(stats["integrator"]), rtol=tolerance)
    return Probe(
        method=method,
        errors={name: float(stats[f"error_estimate_{name}"]) for name in accuracy},
        run=int(stats["evaluations"]),
        all=int(stats["accuracy_evaluations"]),
    )


@one_thread
def _check(study: Study, accuracy: Mapping[str, float], values: Mapping[str, Value]) -> Probe:
    case = asked(_case(study, values), accuracy, study.outputs)
    errors, run, other = error_of(case, study.method)
    return Probe(method=study.method, errors=errors, run=run, all=run + other)


def _case(study: Study, values: Mapping[str, Value]) -> Case:
    """Of a member, which begins where it begins in the ensemble."""
    if not study.stages:
        scene = study.scene(values)
        return Case(scene=scene, t_end=study.t_end, start=study.start_of(scene))
    scene, stages, start, _ = Prepared(study).lift(values)
    return Case(scene=scene, t_end=math.nan, stages=tuple(stages), start=start)
