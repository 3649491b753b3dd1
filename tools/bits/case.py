"""A case: a scene, how it is run, and the list of all."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from seacrane import SampledController, Scene, Stage

Settings = Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class Case:
    """One scene with all that its runs are told: what is left out here is not told to them.

    Attributes
    ----------
    methods : Words of `Method` by each run; of an ensemble "lanes" too.
    t_end, dt_out : s; stages tell their end themselves.
    over, keep : Of an ensemble.
    """

    name: str
    build: Callable[[], Scene]
    methods: Sequence[Settings]
    t_end: float
    dt_out: float
    start: str | None = None
    stages: Callable[[], list[Stage]] | None = None
    controllers: Sequence[SampledController] = ()
    over: Mapping[str, Any] | None = None
    keep: Mapping[str, Any] | None = None

    def settings(self, method: Settings) -> dict[str, Any]:
        """All that a run is told, in words and numbers."""
        told = {**method, "dt_out": self.dt_out, "start": self.start or "as assembled"}
        if self.stages is None:
            told["t_end"] = self.t_end
        if self.over is not None:
            told["over"] = {name: list(values) for name, values in self.over.items()}
        return told


CASES: dict[str, Case] = {}


def by(integrator: str, formulation: str = "recursive", *, rtol: float = 1e-6, **more: Any) -> Settings:
    """A method by all of its words; the tolerance is told to methods of fixed step too, for kinks."""
    return {"integrator": integrator, "formulation": formulation, "rtol": rtol, **more}


USUAL = (by("dopri5"), by("rk4", "redundant", dt=0.01))


def case(
    *methods: Settings, t_end: float = 2.0, dt_out: float = 0.05, name: str = "", **more: Any
) -> Callable[[Callable[[], Scene]], Callable[[], Scene]]:
    """Put a function that builds a scene into the list, under its file and its name."""

    def enter(build: Callable[[], Scene]) -> Callable[[], Scene]:
        called = f"{build.__module__.rpartition('.')[2]}/{name or build.__name__}"
        if called in CASES:
            raise ValueError(f"case {called!r} is there twice; give the second another name")
        CASES[called] = Case(
            name=called, build=build, methods=methods or USUAL, t_end=t_end, dt_out=dt_out, **more
        )
        return build

    return enter
