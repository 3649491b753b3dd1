"""``seacrane hydro``: read a hydrodynamic database, check it against itself, and plot it."""

from __future__ import annotations

import argparse
import dataclasses
from typing import TYPE_CHECKING, Any

from seacrane.cli.as_json import to_json
from seacrane.cli.output_folder import output_folder
from seacrane.plotting.table import table_of

if TYPE_CHECKING:
    from seacrane.hydro import CheckRow, HydroDatabase, HydroGroup

COLUMNS = ("check", "value", "limit", "verdict")


def run(arguments: argparse.Namespace) -> int:
    """Print the verdict table; a failing verdict is a finding about the file, not an error of ours."""
    from seacrane.hydro import HydroGroup, load_database

    band = None if arguments.band is None else (arguments.band[0], arguments.band[1])
    database = load_database(arguments.path, depth=arguments.depth, trusted_band=band)
    if isinstance(database, HydroGroup):
        return _of_group(database, arguments)
    database = _with_memory(database, kind=arguments.memory, asked=band is not None)
    _show(database.check(), as_json=arguments.json)
    if arguments.out is not None:
        from seacrane.hydro.database.figures import SHEETS, save_hydro_figures

        files = [f"{stem}.{kind}" for stem in SHEETS for kind in ("png", "csv")]
        folder = output_folder(arguments.out, holds=files, overwrite=arguments.overwrite)
        pictures = save_hydro_figures(database=database, folder=folder)
        if not arguments.json:
            print("\n".join(f"saved {picture.image}" for picture in pictures))
    return 0


def _of_group(group: HydroGroup, arguments: argparse.Namespace) -> int:
    """The table of several hulls; their memory, which takes minutes, where it is asked for."""
    from seacrane.errors import SceneError
    from seacrane.hydro import fit_memory

    if arguments.out is not None:
        raise SceneError(
            f"group {group.name!r}: --out draws one hull, and the file holds {', '.join(group.names)}; "
            "leave it "
            "out, or draw load_database(path)[name].plot()"
        )
    if arguments.memory is not None:
        group = dataclasses.replace(group, memory=fit_memory(database=group, kind=arguments.memory))
    _show(group.check(), as_json=arguments.json)
    return 0


def _show(checked: list[CheckRow], *, as_json: bool) -> None:
    rows: list[dict[str, Any]] = [{name: getattr(row, name) for name in COLUMNS} for row in checked]
    print(to_json(rows) if as_json else table_of(COLUMNS, [row.values() for row in rows]))


def _with_memory(database: HydroDatabase, *, kind: str | None, asked: bool) -> HydroDatabase:
    """The database with its memory, fitted here where it holds none, or where it or its band is asked for."""
    from seacrane.hydro.memory.fit import enough_frequencies, fit_memory

    if not asked and kind is None and (database.memory is not None or not enough_frequencies(database)):
        return database
    model = fit_memory(database=database) if kind is None else fit_memory(database=database, kind=kind)
    return dataclasses.replace(database, memory=model)
