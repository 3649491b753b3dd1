"""``seacrane trade``: measure what every setting costs and what error it brings."""

from __future__ import annotations

import argparse
import math
from typing import Any

from seacrane.cli.output_folder import output_folder
from seacrane.cli.scene_source import load_source


def run(arguments: argparse.Namespace) -> int:
    """Measure, save trade.csv and trade.png, and print the front and what the scene requires."""
    source = load_source(arguments.scene, arguments, scripts=False)
    folder = output_folder(arguments.out)
    from seacrane.accuracy import trade
    from seacrane.needs import required
    from seacrane.needs.bench import usual
    from seacrane.run.outputs import Outputs

    outputs = Outputs(dt_out=(source.outputs or Outputs()).dt_out)
    span: dict[str, Any] = {"stages": source.stages, "start": source.start, "outputs": outputs}
    if source.t_end is not None and not source.stages:
        span["t_end"] = source.t_end
    budget = None if arguments.budget == math.inf else arguments.budget
    result = trade(source.scene, budget=budget, out=folder, **span)
    try:
        print(result)
    finally:
        print(f"saved {folder / 'trade.csv'} and {folder / 'trade.png'}")
    if usual(source.scene):
        print(required(source.scene, method=source.method, progress=True, **span))
    return 0
