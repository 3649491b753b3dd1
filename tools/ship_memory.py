"""Fit the default memory of the shipped hull, and write it into the package: `python tools/ship_memory.py`.

Run it after the hull's data or a fit changed: the model that is there is then no longer found.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path

from seacrane.hydro import fit_memory, shipped_database
from seacrane.hydro.memory.fit import FOLDER, shipped_folder
from seacrane.inputs.user_cache import VARIABLE, user_cache


def main() -> None:
    """Fit, and keep nothing else in the package's folder."""
    target = shipped_folder()
    shutil.rmtree(target, ignore_errors=True)
    with tempfile.TemporaryDirectory() as folder:
        os.environ[VARIABLE] = folder
        model = fit_memory(database=shipped_database())
        made = user_cache(FOLDER)
        assert made is not None
        shutil.copytree(made, target)
    assert model.motion is not None
    for path in sorted(Path(target).iterdir()):
        print(f"{path}: {model.states} states, {model.motion.error.worst:.3g} of the motions")


if __name__ == "__main__":
    main()
