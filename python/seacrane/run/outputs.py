"""Outputs: what a run records, and how often."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from seacrane.errors import SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named

DEFAULT_INTERVAL = 0.1  # s


@named
@dataclass(frozen=True, kw_only=True)
class Outputs:
    """What a run records, and how often.

    Attributes
    ----------
    dt_out : float
        Output interval, s. Outputs are interpolated, projected, then evaluated; they never shorten steps.
    channels : sequence of str, optional
        What to record, kept as a tuple; default: all default channels of the scene.

    Raises
    ------
    SceneError
        For an interval that is no number, or channels that are no list of names. Whether a scene has the
        channels is known when it is run.
    """

    dt_out: float = DEFAULT_INTERVAL
    channels: Iterable[str] | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "dt_out", number_of("dt_out", self.dt_out))
        if self.channels is None:
            return
        if isinstance(self.channels, str) or not isinstance(self.channels, Iterable):
            raise SceneError(f"channels is {self.channels!r}; give a list of channel names")
        object.__setattr__(self, "channels", tuple(self.channels))
