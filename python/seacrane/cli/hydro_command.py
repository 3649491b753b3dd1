"""``seacrane hydro``: read a hydrodynamic database, check it against itself, and plot it."""

from __future__ import annotations

import argparse
import dataclasses
from typing import TYPE_CHECKING, Any

from seacrane.cli.as_json import to_json
from seacrane.cli.output_folder import output_folder
from seacrane.plotting.text import text_table

if TYPE_CHECKING:
    from seacrane.hydro import HydroDatabase

COLUMNS = ("check", "value", "limit", "verdict")


def run(arguments: argparse.Namespace) -> int:
    """Print the verdict table; a failing verdict is a finding about the file, not an error of ours."""
    from seacrane.hydro import load_database

    band = None if arguments.band is None else (arguments.band[0], arguments.band[1])
    database = load_database(arguments.path, depth=arguments.depth, trusted_band=band)
    database = _with_memory(database, kind=arguments.memory, asked=band is not None)
    rows: list[dict[str, Any]] = [{name: getattr(row, name) for name in COLUMNS} for row in database.check()]
    print(to_json(rows) if arguments.json else _as_text(rows))
    if arguments.out is not None:
        from seacrane.hydro.database.figures import SHEETS, save_hydro_figures

        files = [f"{stem}.{kind}" for stem in SHEETS for kind in ("png", "csv")]
        folder = output_folder(arguments.out, holds=files, overwrite=arguments.overwrite)
        pictures = save_hydro_figures(database=database, folder=folder)
        if not arguments.json:
            print("\n".join(f"saved {picture.image}" for picture in pictures))
    return 0


def _with_memory(database: HydroDatabase, *, kind: str | None, asked: bool) -> HydroDatabase:
    """The database with its memory, fitted here where it holds none, or where it or its band is asked for."""
    from seacrane.hydro.memory.fit import enough_frequencies, fit_memory

    if not asked and kind is None and (database.memory is not None or not enough_frequencies(database)):
        return database
    model = fit_memory(database=database) if kind is None else fit_memory(database=database, kind=kind)
    return dataclasses.replace(database, memory=model)


def _as_text(rows: list[dict[str, Any]]) -> str:
    from seacrane.plotting.html import format_value

    return text_table(COLUMNS, [[format_value(row[name]) for name in COLUMNS] for row in rows])
