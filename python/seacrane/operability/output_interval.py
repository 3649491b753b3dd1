"""How far apart outputs of a lift in stages may be to hold the peaks of what bounces on its hoist."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from seacrane.description.suspension import hung_loads
from seacrane.inputs.caller import warn_caller
from seacrane.run.modes import Modes
from seacrane.run.outputs import Outputs
from seacrane.run.staged_run import StagedRun
from seacrane.warnings import CoarseOutputsWarning

PER_PERIOD = 8.0  # outputs in a period: the parabola through a crest errs by less than 1 % of the amplitude
COARSE = 6.0  # outputs in a period: fewer are told of
LIGHT = 0.1  # of the heaviest load: what weighs less, such as a block, adds little to what the hoist carries
MOST_DAMPING = 0.5  # ratio
OF_THE_SHIP = ("vessel_motion", "tip_velocity")  # channels that loads which bounce hardly move


@dataclass(frozen=True)
class Bounce:
    """The fastest oscillation of a load on its hoist: period (s), and the load."""

    period: float
    load: str


def fastest_bounce(lift: StagedRun) -> Bounce | None:
    """The fastest of a lift, which is carried out for it, at its start and after each of its stages."""
    found, going = _bounces(lift), True
    while going:
        going = lift.advance()
        found += _bounces(lift)
    if lift.interrupted:
        raise KeyboardInterrupt
    return min(found, key=lambda one: one.period, default=None)


def _bounces(lift: StagedRun) -> list[Bounce]:
    mass = {one.load: lift.scene.bodies[one.load].mass for one in hung_loads(lift.scene)}
    heavy = {name for name, own in mass.items() if own >= LIGHT * max(mass.values())}
    if not heavy:
        return []
    modes = Modes(lift.model, list(lift.scene.bodies), [lift.state], MOST_DAMPING)
    return [
        Bounce(2.0 * np.pi / abs(value), body)
        for at in modes.oscillations
        for value, body in zip(at.values, at.bodies, strict=True)
        if body in heavy
    ]


def resolving(outputs: Outputs, bounce: Bounce | None, *, asked: bool) -> Outputs:
    """The outputs, nearer to each other where a load bounces fast; as they are where they were asked for.

    Warns
    -----
    CoarseOutputsWarning
        Where those that were asked for miss peaks.
    """
    if bounce is None:
        return outputs
    finest = bounce.period / PER_PERIOD
    if not asked:
        return replace(outputs, dt_out=min(outputs.dt_out, finest))
    if outputs.dt_out > bounce.period / COARSE:
        warn_caller(
            f"allowable_hs: dt_out is {outputs.dt_out:g} s, and {bounce.load!r} bounces on its hoist in "
            f"{bounce.period:.3g} s: outputs so far apart miss peaks, and the allowable Hs is too high; "
            f"leave dt_out out, or give {finest:.2g}",
            CoarseOutputsWarning,
        )
    return outputs
