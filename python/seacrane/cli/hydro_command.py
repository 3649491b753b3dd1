"""``seacrane hydro``: read a hydrodynamic database, check it against itself, and plot it."""

from __future__ import annotations

import argparse
from typing import Any

from seacrane.cli.output_folder import output_folder
from seacrane.cli.tables import text_table, to_json

COLUMNS = ("check", "value", "limit", "verdict")


def run(arguments: argparse.Namespace) -> int:
    """Print the verdict table; a failing verdict is a finding about the file, not an error of ours."""
    from seacrane.hydro import load_database

    database = load_database(arguments.path)
    rows: list[dict[str, Any]] = [{name: getattr(row, name) for name in COLUMNS} for row in database.check()]
    print(to_json(rows) if arguments.json else _as_text(rows))
    if arguments.out is not None:
        from seacrane.hydro import fit_memory
        from seacrane.hydro_figures import save_hydro_figures

        folder = output_folder(arguments.out)
        memory = database.memory
        if memory is None and database.speed == 0.0:
            memory = fit_memory(database=database)
        pictures = save_hydro_figures(database=database, folder=folder, memory=memory)
        if not arguments.json:
            print("\n".join(f"saved {picture.image}" for picture in pictures))
    return 0


def _as_text(rows: list[dict[str, Any]]) -> str:
    from seacrane.report import format_value

    return text_table(COLUMNS, [[format_value(row[name]) for name in COLUMNS] for row in rows])
