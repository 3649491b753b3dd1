"""What an experiment runs with one method after the other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.channels import DERIVED
from seacrane.run.channel_names import missing_names
from seacrane.run.outputs import Outputs
from seacrane.run.stage import Stage
from seacrane.run.start import Start
from seacrane.scene.scene import Scene

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Case:
    """One scene, how long it is run, and when errors are taken.

    Attributes
    ----------
    t_end, dt_out : float
        s.
    start : State or "rest", optional
        Where to begin; default: the assembled start.
    stages : tuple of Stage
        Carried out in place of one run to `t_end`.
    truth : mapping of str to ndarray, optional
        Values of quantities, known otherwise than by tight runs of the same scene.
    compiled : Model, optional
        The compiled scene, to save compiling it again.
    """

    scene: Scene
    t_end: float
    dt_out: float
    start: Start = None
    stages: tuple[Stage, ...] = ()
    truth: Mapping[str, Array] | None = None
    compiled: _core.Model | None = None

    @cached_property
    def model(self) -> _core.Model:
        """The compiled scene; one serves all runs."""
        return self.scene.compile() if self.compiled is None else self.compiled

    def outputs(self, channels: Iterable[str]) -> Outputs:
        """At the times of the case, those of the channels that the scene has."""
        wanted = list(dict.fromkeys(channels))
        known = offered_channels(self.model) - missing_names(self.scene, wanted).keys()
        return Outputs(dt_out=self.dt_out, channels=[name for name in wanted if name in known])


def offered_channels(model: _core.Model) -> set[str]:
    """All that a result of this model may hold."""
    known = set(model.channel_names(defaults_only=False))
    return known | {name for name, channel in DERIVED.items() if set(channel.made_of) & known}
