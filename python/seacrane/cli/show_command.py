"""``seacrane show``: what a result or a study says, printed and drawn."""

from __future__ import annotations

import argparse
from pathlib import Path

from seacrane.cli.as_json import to_json
from seacrane.cli.output_folder import output_folder
from seacrane.errors import SceneError


def run(arguments: argparse.Namespace) -> int:
    """Print the summary; with --out, draw its curves. Of a study: tables and figures."""
    if Path(arguments.result).is_dir():
        return _study(arguments)
    from seacrane.answers.reported_curves import plot_summary
    from seacrane.answers.summary import summary
    from seacrane.plotting.panel import save_figure
    from seacrane.result import Result

    path = Path(arguments.result)
    result = Result.load(path)
    told = summary(result, after=arguments.start, before=arguments.end)
    if arguments.json:
        rows = {
            row.name: {k: v for k, v in vars(row).items() if k not in ("name", "printed")} for row in told
        }
        print(to_json({"rows": rows, "remarks": told.remarks}))
    else:
        print(told)
    if arguments.out is not None:
        name = f"{path.name.removesuffix('.partial').removesuffix('.nc')}.png"
        folder = output_folder(arguments.out, holds=[name], overwrite=arguments.overwrite)
        picture = save_figure(plot_summary(result), folder / name)
        if not arguments.json:
            print(f"saved {picture}")
    return 0


def _study(arguments: argparse.Namespace) -> int:
    """The study of the folder of a study."""
    given = {"--start": arguments.start, "--end": arguments.end, "--json": arguments.json or None}
    named = [name for name, value in given.items() if value is not None]
    if named:
        raise SceneError(f"{', '.join(named)} is for a result, and {arguments.result} is a folder of a study")
    show_study(arguments.result, arguments.out)
    return 0


def show_study(study: str, out: str | None) -> None:
    """Print the tables of a study, and write them and their figures into a folder, by default its own."""
    from seacrane.lift.shown_study import shown_study, study_sheets
    from seacrane.plotting.panel import draw, save_figure, save_table

    shown = shown_study(study)
    print(shown)
    folder = output_folder(study if out is None else out)
    saved = [save_table(one.head(), list(one.rows()), folder / f"{one.name}.csv") for one in shown.tables]
    saved += [save_figure(draw(sheet), folder / f"{name}.png") for name, sheet in study_sheets(shown)]
    if saved:
        print(f"\nsaved {', '.join(path.name for path in saved)} in {folder}")
