"""The recipes of docs/ensembles.md, run as they stand there: each gives the bits of one process."""

from __future__ import annotations

import os
import re
import shutil
import socket
import subprocess
import sys
import textwrap
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

import pytest
from ensemble_studies import HEAVE_STUDY

from seacrane.ensembles import Ensemble
from seacrane.lift.study_run import MEMBERS, run_study

PAGE = Path(__file__).resolve().parents[2] / "docs" / "ensembles.md"
SECTION = PAGE.read_text(encoding="utf-8").partition("### Recipes\n")[2].partition("\n## ")[0]
RECIPES = [textwrap.dedent(one[0]) for one in re.finditer(r"(?: {4}.*\n)+", SECTION)]
NEEDS = {"machine": (), "array": ("xargs",), "mpi": ("mpirun", "mpi4py"), "dask": ("distributed",)}
OPEN_MPI = ("ALLOW_RUN_AS_ROOT", "ALLOW_RUN_AS_ROOT_CONFIRM", "MCA_rmaps_base_oversubscribe")


def free_port() -> int:
    """Below those that the system gives to whoever connects meanwhile."""
    for port in range(20000, 32000):
        with suppress(OSError), socket.create_server(("127.0.0.1", port)):
            return port
    raise OSError("no port is free")


@pytest.mark.slow("processes of four kinds")
@pytest.mark.parametrize(("folder", "recipe"), [*zip(NEEDS, RECIPES, strict=True)], ids=NEEDS)
def test_a_recipe_gives_the_bits_of_one_process(folder: str, recipe: str, tmp_path: Path) -> None:
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    for one in NEEDS[folder]:
        if not shutil.which(one, path=path) and not find_spec(one):
            pytest.skip(f"no {one}: pip install distributed mpi4py, and Debian's package openmpi-bin")
    (tmp_path / "my_study.toml").write_text(HEAVE_STUDY)
    recipe = recipe.replace("8786", str(free_port()))
    script = f"set -e; trap 'kill $(jobs -p) 2> /dev/null || true; wait' EXIT\n{recipe}"
    given = os.environ | {"PATH": path} | {f"OMPI_{name}": "1" for name in OPEN_MPI}
    subprocess.run(["bash", "-c", script], cwd=tmp_path, env=given, timeout=300, check=True)
    run_study(tmp_path / "my_study.toml", tmp_path / "one")
    (study,) = (tmp_path / folder).rglob("study.json")
    there = Ensemble.load(study.parent)
    assert there.dataset.identical(Ensemble.load(tmp_path / "one" / MEMBERS).dataset) and not there.failures
