"""``seacrane show``: the summary of a result, printed and drawn."""

from __future__ import annotations

import argparse
from pathlib import Path

from seacrane.cli.json_text import to_json
from seacrane.cli.output_folder import output_folder


def run(arguments: argparse.Namespace) -> int:
    """Print the summary; with --out, draw its curves."""
    from seacrane.answers.summary import summary
    from seacrane.answers.summary_figure import plot_summary
    from seacrane.plotting.panel import save_figure
    from seacrane.result import Result

    path = Path(arguments.result)
    result = Result.load(path)
    told = summary(result, start=arguments.start, end=arguments.end)
    if arguments.json:
        print(to_json({"rows": told.to_dict(), "remarks": told.remarks}))
    else:
        print(told)
    if arguments.out is not None:
        name = f"{path.name.removesuffix('.partial').removesuffix('.nc')}.png"
        folder = output_folder(arguments.out, holds=[name], overwrite=arguments.overwrite)
        picture = save_figure(plot_summary(result), folder / name)
        if not arguments.json:
            print(f"saved {picture}")
    return 0
