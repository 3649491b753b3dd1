"""``seacrane trade``: measure what every setting costs and what error it brings."""

from __future__ import annotations

import argparse

from seacrane.cli.output_folder import output_folder
from seacrane.cli.scene_source import load_source
from seacrane.errors import SceneError


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
        print(result)
    finally:
        print(f"saved {folder / 'trade.csv'} and {folder / 'trade.png'}")
    return 0
