"""``seacrane trade``: measure what every setting costs and what error it brings."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from seacrane.cli.output_folder import output_folder
from seacrane.cli.scene_source import load_source
from seacrane.errors import SceneError
from seacrane.plotting.text import text_table

if TYPE_CHECKING:
    from seacrane.trading import Trade


def run(arguments: argparse.Namespace) -> int:
    """Measure, save trade.csv and trade.png, and print the Pareto front."""
    source = load_source(arguments.scene, arguments, scripts=False)
    if source.stages:
        raise SceneError(
            f"{arguments.scene} is a lift in stages; trade measures one run: leave [[stage]] out"
        )
    folder = output_folder(arguments.out)
    from seacrane.trading import trade

    result = trade(source.scene, quick=arguments.quick, out=folder)
    try:
        print(summary(result))
    finally:
        print(f"saved {folder / 'trade.csv'} and {folder / 'trade.png'}")
    return 0


def summary(result: Trade) -> str:
    """The reference's uncertainty and the Pareto front of the first quantity."""
    names = list(result.quantities)
    known = ", ".join(
        f"{name} {result.reference.uncertainty[name]:.1g} {result.quantities[name].unit}" for name in names
    )
    rows = [
        [row.formulation, row.method.integrator, row.method.setting, *map(str, row.case.values()),
         f"{row.wall_s * 1e3:.3g}", *(f"{row.error(name):.2g}" for name in names)]
        for row in result.pareto
    ]  # fmt: skip
    head = ["formulation", "integrator", "setting", "memory", "waves", "rung", "wall [ms]", *names]
    unstable = sum(not row.stable for row in result.rows)
    return "\n".join(
        [
            f"reference known within {known}",
            f"{len(result.rows)} rows, {unstable} of them not stable; Pareto front in {names[0]}:",
            text_table(head, rows),
        ]
    )
