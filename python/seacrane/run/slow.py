"""What made a run slow, or an oscillation in it grow, known at its end."""

from __future__ import annotations

from typing import TYPE_CHECKING

from seacrane.run.growth import growing
from seacrane.run.modes import Modes
from seacrane.run.stiffness import stiffness
from seacrane.run.unsteady_oil import unsteady_oil
from seacrane.validity.range import Finding

if TYPE_CHECKING:
    from seacrane.run.run import Run

NEAR = 0.8  # of a limit: from there on a run in another sea is looked at by itself


def slow_findings(run: Run) -> list[Finding]:
    """By the modes where the run began and where it is.

    Of a run made by `Run.in_sea` they are found only where the modes at the common start, found once for all
    such runs, come near a limit.
    """
    if run.start_modes is not None and not _found(run, run.start_modes, near=NEAR):
        return []
    last = run.last_state()
    states = [run.start] if last is None else [run.start, last]
    found = _found(run, Modes(run.model, list(run.scene.bodies), states))
    return found + unsteady_oil(run.scene, run.model, states)


def _found(run: Run, modes: Modes, near: float = 1.0) -> list[Finding]:
    stats, settings = run.stats(), run.settings
    remembering = [vessel.body for vessel in run.scene.vessels.values()] if stats["history_samples"] else []
    found = stiffness(run.scene.loads, modes, stats, settings, near=near)
    return found + growing(modes, stats, settings, undamped=remembering, near=near)
