"""``seacrane hydro``, ``schema`` and ``examples``: databases, and what comes with the package."""

from __future__ import annotations

import argparse
import dataclasses
import shutil
import sys
from collections import Counter
from collections.abc import Sequence
from importlib.resources import as_file, files
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seacrane.cli.output import output_folder, to_json
from seacrane.plotting.table import table_of

if TYPE_CHECKING:
    from seacrane.arrays import Array
    from seacrane.hydro import CheckRow, HydroDatabase, HydroGroup

COLUMNS = ("check", "value", "limit", "verdict")
KINDS = {(".", ".py"): "scripts", ("jobs", ".py"): "jobs", ("lifts", ".toml"): "lift files",
         ("notebooks", ".ipynb"): "notebooks"}  # fmt: skip


def hydro(arguments: argparse.Namespace) -> int:
    """Print the verdict table; a failing verdict is a finding about the file, not an error of ours."""
    from seacrane.hydro import HydroGroup, load_database, write_database

    if arguments.path is None:
        return _formats(as_json=arguments.json)
    band = None if arguments.band is None else (arguments.band[0], arguments.band[1])
    mass = None if arguments.mass is None else _mass(arguments.mass)
    database = load_database(arguments.path, depth=arguments.depth, trusted_band=band, mass_matrix=mass)
    if not arguments.json:
        print(database.source)
    if isinstance(database, HydroGroup):
        return _of_group(database, arguments)
    database = _with_memory(database, kind=arguments.memory, asked=band is not None)
    written = []
    if arguments.write is not None:
        written = write_database(database=database, path=arguments.write, overwrite=arguments.overwrite)
    _show([*database.check(), *written], as_json=arguments.json)
    if arguments.out is not None:
        from seacrane.hydro.database.figures import SHEETS, save_hydro_figures

        files = [f"{stem}.{kind}" for stem in SHEETS for kind in ("png", "csv")]
        folder = output_folder(arguments.out, holds=files, overwrite=arguments.overwrite)
        pictures = save_hydro_figures(database=database, folder=folder)
        if not arguments.json:
            print("\n".join(f"saved {picture.image}" for picture in pictures))
    return 0


def _formats(*, as_json: bool) -> int:
    """What can be read, and by what it is known."""
    from seacrane.hydro.readers.format import told_of
    from seacrane.hydro.readers.load import FORMATS

    head, rows = ("kind", "files", "known by", "may be given"), told_of(FORMATS)
    print(to_json([dict(zip(head, row, strict=True)) for row in rows]) if as_json else table_of(head, rows))
    return 0


def _mass(given: Sequence[float]) -> Array:
    """The matrix (6, 6) of t, centre and radii of gyration."""
    import numpy as np

    from seacrane.errors import SceneError
    from seacrane.hydro import rigid_mass_matrix

    if not min(given[0], *given[4:]) > 0.0:
        raise SceneError(f"--mass is {' '.join(map(str, given))}; give mass and radii of gyration above zero")
    mass, centre, radii = 1e3 * given[0], np.array(given[1:4]), np.array(given[4:])
    return rigid_mass_matrix(mass, centre, np.diag(mass * radii**2))


def _of_group(group: HydroGroup, arguments: argparse.Namespace) -> int:
    """The table of several hulls; their memory, which takes minutes, where it is asked for."""
    from seacrane.errors import SceneError
    from seacrane.hydro import fit_memory

    if arguments.out is not None or arguments.write is not None:
        raise SceneError(
            f"group {group.name!r}: --out and --write take one hull, and the file holds "
            f"{', '.join(group.names)}; leave them out, or take load_database(path)[name]"
        )
    if arguments.memory is not None:
        memory = fit_memory(database=group, kind=arguments.memory, progress=sys.stderr.isatty())
        group = dataclasses.replace(group, memory=memory)
    _show(group.check(), as_json=arguments.json)
    return 0


def _show(checked: list[CheckRow], *, as_json: bool) -> None:
    rows: list[dict[str, Any]] = [{name: getattr(row, name) for name in COLUMNS} for row in checked]
    print(to_json(rows) if as_json else table_of(COLUMNS, [row.values() for row in rows]))


def _with_memory(database: HydroDatabase, *, kind: str | None, asked: bool) -> HydroDatabase:
    """With its memory, fitted where it has a mass and none, or where it or its band is asked for."""
    from seacrane.hydro.memory.fit import enough_frequencies, fit_memory

    fitted = database.memory is not None or database.mass_matrix is None
    if not asked and kind is None and (fitted or not enough_frequencies(database)):
        return database
    model = fit_memory(database=database) if kind is None else fit_memory(database=database, kind=kind)
    return dataclasses.replace(database, memory=model)


def schema(arguments: argparse.Namespace) -> int:
    """Print the schema, or its path."""
    from seacrane.lift.schema import schema_path, schema_text

    print(schema_path() if arguments.path else schema_text(), end="\n" if arguments.path else "")
    return 0


def examples(arguments: argparse.Namespace) -> int:
    """Copy them, and say what opens the notebooks."""
    with as_file(files("seacrane") / "examples") as source:
        if not source.is_dir():
            raise FileNotFoundError(
                "this seacrane runs from its sources, without the examples that an installed one has; they "
                "are in the folders examples and notebooks of the sources"
            )
        found = [path for path in sorted(source.rglob("*")) if path.is_file() and path.suffix != ".pyc"]
        names = [path.relative_to(source) for path in found]
        folder = output_folder(
            arguments.folder, holds=map(str, names), overwrite=arguments.overwrite, called=""
        )
        for path, name in zip(found, names, strict=True):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, folder / name)
    _tell(folder, names)
    return 0


def _tell(folder: Path, names: Sequence[Path]) -> None:
    counts = Counter((str(name.parent), name.suffix) for name in names)
    for kind, what in KINDS.items():
        if counts[kind]:
            print(f"{counts[kind]:3} {what} in {folder / kind[0]}")
    if counts["notebooks", ".ipynb"]:
        print("Notebooks hold their outputs; to open and run them: pip install 'seacrane[notebooks]', then")
        print(f"jupyter lab {folder / 'notebooks'}")
    else:
        print("This seacrane was built without notebooks; the wheel holds them.")
