"""Is a scene linear enough in a sea: runs and the linear model in the same waves, from the same state."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.databases import without_databases
from seacrane.ensembles.other_sea import with_sea
from seacrane.errors import SeacraneError
from seacrane.operability.criterion import Criterion
from seacrane.operability.levels import reached, record_numbers
from seacrane.operability.linear_seas import LinearSeas
from seacrane.run.advance import ended
from seacrane.run.interrupts import Interrupts
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.run import Run
from seacrane.scene.scene import Scene
from seacrane.validity.after_run import require_finite

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Sea:
    """One sea state: m, s, degrees of travel, and the seed of its phases."""

    hs: float
    tp: float
    direction_deg: float
    seed: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Probe:
    """One run to be compared.

    Attributes
    ----------
    t_end : s.
    method, outputs
        Of the run.
    """

    scene: Scene
    start: _core.State
    t_end: float
    criteria: tuple[Criterion, ...]
    method: Method
    outputs: Outputs

    def numbers(self) -> Array | str:
        """`record_numbers` of each criterion's channel, (m, 4), or why the run failed."""
        try:
            run = Run(self.scene, self.t_end, start=self.start, method=self.method, outputs=self.outputs)
            with Interrupts() as interrupts:
                run = ended(run, (), interrupts)
            interrupts.take()
            if run.interrupted:
                raise KeyboardInterrupt
            result = require_finite(run.result())
            return np.array([record_numbers(result.curve(one.channel, **one.names)) for one in self.criteria])
        except (SeacraneError, ArithmeticError, ValueError) as error:
            return f"{type(error).__name__}: {error}"


@dataclass(frozen=True, kw_only=True)
class Prober:
    """How probes are run.

    Attributes
    ----------
    scene : Its references held.
    start, duration : s.
    method, outputs
        Of the runs.
    """

    scene: Scene
    linear: LinearSeas
    criteria: tuple[Criterion, ...]
    start: float
    duration: float
    method: Method
    outputs: Outputs

    def differences(self, seas: Sequence[Sea], executor: Executor | None) -> Iterator[Array | str]:
        """For each sea and criterion what the run reached beyond the linear model, over the allowance, (m,).

        A text where the run failed: why.
        """
        made = [self._probe(sea) for sea in seas]
        probes = [probe for probe, _ in made]
        runs: Iterable[Array | str] = (
            map(Probe.numbers, probes) if executor is None else executor.map(Probe.numbers, probes)
        )
        for (_, linear), found in zip(made, runs, strict=True):
            yield found if isinstance(found, str) else self._difference(found, linear)

    def _probe(self, sea: Sea) -> tuple[Probe, Array]:
        words = {"hs": sea.hs, "tp": sea.tp, "direction_deg": sea.direction_deg, "seed": sea.seed}
        scene = with_sea(self.scene, words)
        assert scene.waves is not None
        end = self.start + self.duration
        steps = np.arange(round(self.duration / self.outputs.dt_out) + 1, dtype=float)
        times: Array = self.start + steps * self.outputs.dt_out
        state, linear = self.linear.in_waves(scene.waves, self.start, times)
        probe = Probe(
            scene=without_databases(scene), start=state, t_end=end, criteria=self.criteria,
            method=self.method, outputs=self.outputs,
        )  # fmt: skip
        return probe, np.array([record_numbers(column) for column in linear.T])

    def _difference(self, run: Array, linear: Array) -> Array:
        found = []
        for i, (criterion, rest) in enumerate(zip(self.criteria, self.linear.channels.rest, strict=True)):
            apart = reached(criterion, run[i], float(rest)) - reached(criterion, linear[i], float(rest))
            found.append(abs(float(apart)) / criterion.allowance(float(rest)))
        return np.array(found)
