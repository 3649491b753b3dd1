"""``seacrane run`` and ``trade``: simulate one scene into a file, or measure what its settings cost."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING, Any

from seacrane.cli.command_line import INTERRUPTED
from seacrane.cli.output import output_folder
from seacrane.cli.scene_source import load_source
from seacrane.errors import SceneError

if TYPE_CHECKING:
    from seacrane.result import Result

KEPT = ("constraint_error", "energy_balance", "absolute_work")
SPANS = ("t_end", "checkpoint_every", "resume", "progress")
ESTIMATE = "error_estimate_"
SETTINGS = ("dt_out", "integrator", "rtol", "dt", "spectral_radius", "formulation")


def run(arguments: argparse.Namespace) -> int:
    """Simulate and summarise; 130 if the run was interrupted."""
    from seacrane.answers.reported_curves import CHANNELS
    from seacrane.run.method import overridden
    from seacrane.simulation import simulate

    source = load_source(arguments.scene, arguments, scripts=True)
    given = [name for name in SPANS if getattr(arguments, name) not in (None, False)]
    if source.stages and given:
        options = ", ".join(f"--{name.replace('_', '-')}" for name in given)
        raise SceneError(f"{options} does not go with a lift in stages, which is written stage by stage and "
                         "ends with its last; leave it out")  # fmt: skip
    folder = output_folder(arguments.out)
    path = folder / f"{source.name}.nc"
    words = {word: getattr(arguments, word) for word in SETTINGS}
    method, outputs = overridden(source.method, source.outputs, words)
    t_end = source.t_end if arguments.t_end is None else arguments.t_end
    span = source.stages or t_end
    done = simulate(
        source.scene, *([] if span is None else [span]), to=path, start=source.start, method=method,
        outputs=outputs, accuracy=source.accuracy, checkpoint_every=arguments.checkpoint_every,
        resume=arguments.resume, overwrite=arguments.overwrite, progress=arguments.progress,
    )  # fmt: skip
    try:
        print(told(done.load((*KEPT, *CHANNELS, *(state.channel for state in done.about.limit_states)))))
    finally:  # whatever happens to its summary, the run is there
        print(f"saved {done.path}")
    return INTERRUPTED if done.interrupted else 0


def told(result: Result) -> str:
    """All that is printed of a run."""
    from seacrane.answers.particulars import stage_table
    from seacrane.answers.summary import summary

    stages = f"\n{stage_table(result)}\n" if result.stages else ""
    return f"{costs(result)}\n\n{summary(result)}\n{stages}"


def costs(result: Result) -> str:
    """What a run cost and how well it kept its invariants, in a few lines."""
    from seacrane.answers.checks import energy_closure, speed, worst

    stats = result.stats
    fast = speed(result)
    pace = f" ({fast:.0f} times real time)" if fast is not None else ""
    lines = [
        f"{stats['scene']}: {float(stats['simulated_s']):g} s in {float(stats['wall_s']):.3g} s{pace}, "
        f"{stats['integrator']}, {stats['formulation']}",
        f"steps {stats['steps']} ({stats['rejected_steps']} rejected), evaluations {stats['evaluations']}, "
        f"states {stats['states']}",
    ]
    error = worst(result, "constraint_error")
    if error is not None:
        lines.append(f"worst constraint error {error:.2g} m or rad")
    balance, closure = worst(result, "energy_balance"), energy_closure(result)
    if balance is not None and closure is not None:
        lines.append(f"worst energy balance {balance:.3g} J, {closure:.2g} of the absolute work")
    if "events" in stats:
        lost = stats.get("impact_energy_lost_J")
        impacts = "" if lost is None else f", energy lost in impacts {float(lost):.3g} J"
        lines.append(f"events of limits {stats['events']}{impacts}")
    lines += [
        f"error of {name.removeprefix(ESTIMATE)}: {float(value):.2g} at most, estimated"
        for name, value in stats.items()
        if name.startswith(ESTIMATE)
    ]
    if result.interrupted:
        lines.append(f"interrupted: outputs end at {result.time[-1]:g} s; --resume goes on from there")
    return "\n".join(lines)


def trade(arguments: argparse.Namespace) -> int:
    """Measure, save trade.csv and trade.png, and print the front and what the scene requires."""
    source = load_source(arguments.scene, arguments)
    folder = output_folder(arguments.out)
    from seacrane import accuracy
    from seacrane.answers import required
    from seacrane.answers.required import usual
    from seacrane.run.outputs import Outputs

    outputs = Outputs(dt_out=(source.outputs or Outputs()).dt_out)
    span: dict[str, Any] = {"stages": source.stages, "start": source.start, "outputs": outputs}
    if source.t_end is not None and not source.stages:
        span["t_end"] = source.t_end
    budget = None if arguments.budget == math.inf else arguments.budget
    result = accuracy.trade(source.scene, budget=budget, out=folder, **span)
    try:
        print(result)
    finally:
        print(f"saved {folder / 'trade.csv'} and {folder / 'trade.png'}")
    if usual(source.scene):
        print(required(source.scene, method=source.method, progress=True, **span))
    return 0
