"""``seacrane examples``: the scripts, jobs, lift files and notebooks that come with the package."""

from __future__ import annotations

import argparse
import shutil
from collections import Counter
from collections.abc import Sequence
from importlib.resources import as_file, files
from pathlib import Path

from seacrane.cli.output_folder import output_folder

KINDS = {(".", ".py"): "scripts", ("jobs", ".py"): "jobs", ("lifts", ".toml"): "lift files",
         ("notebooks", ".ipynb"): "notebooks"}  # fmt: skip


def run(arguments: argparse.Namespace) -> int:
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
