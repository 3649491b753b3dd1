"""``seacrane run``: simulate one scene and write what it records to a file."""

from __future__ import annotations

import argparse
import json
from typing import TYPE_CHECKING, Any

from seacrane.cli.command_line import INTERRUPTED
from seacrane.cli.output_folder import output_folder
from seacrane.cli.scene_source import load_source

if TYPE_CHECKING:
    from seacrane.result import Result

KEPT = ("constraint_error", "energy_balance", "absolute_work")
SETTINGS = ("dt_out", "integrator", "rtol", "dt", "spectral_radius", "formulation")


def run(arguments: argparse.Namespace) -> int:
    """Simulate and summarise; 130 if the run was interrupted."""
    source = load_source(arguments.scene, arguments, scripts=True)
    folder = output_folder(arguments.out)
    from seacrane.run.shorthand import overridden
    from seacrane.run.to_file import simulate_to_file

    words = {word: getattr(arguments, word) for word in SETTINGS}
    method, outputs = overridden(source.method, source.outputs, words)
    path = folder / f"{source.name}.nc"
    t_end = source.t_end if arguments.t_end is None else arguments.t_end
    span: dict[str, Any] = {} if t_end is None else {"t_end": t_end}
    told = simulate_to_file(
        source.scene, path, **span, method=method, outputs=outputs,
        checkpoint_every=arguments.checkpoint_every, resume=arguments.resume, overwrite=arguments.overwrite,
        progress=arguments.progress,
    )  # fmt: skip
    from seacrane.answers.curves import CHANNELS
    from seacrane.answers.summary import summary

    limited = [state["channel"] for state in json.loads(str(told.stats.get("limit_states", "[]")))]
    result = told.load((*KEPT, *CHANNELS, *limited))
    print(costs(result))
    print(f"\n{summary(result)}\n")
    print(f"saved {told.path}")
    return INTERRUPTED if told.interrupted else 0


def costs(result: Result) -> str:
    """What a run cost and how well it kept its invariants, in a few lines."""
    from seacrane.reporting.measures import energy_closure, speed, worst

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
        lost = float(stats["impact_energy_lost_J"])
        lines.append(f"events of limits {stats['events']}, energy lost in impacts {lost:.3g} J")
    if result.interrupted:
        lines.append(f"interrupted: outputs end at {result.time[-1]:g} s; --resume goes on from there")
    return "\n".join(lines)
