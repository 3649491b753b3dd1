"""The installed package: complete, typed, quick to import, and with a stub that matches its module."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
from importlib import metadata, resources
from pathlib import Path


def run_python(code: str) -> str:
    """Standard output of a fresh interpreter that runs `code`."""
    finished = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stderr
    return finished.stdout


def test_package_is_installed_with_its_version_command_types_and_requirements(repository: Path) -> None:
    """Not imported from the source tree; without solvers and development tools."""
    located, version = run_python("import seacrane as s; print(s.__file__, s.__version__)").split()
    assert not Path(located).is_relative_to(repository / "python")
    project = tomllib.loads((repository / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert version == project["version"]
    (entry,) = metadata.entry_points(group="console_scripts", name="seacrane")
    assert entry.value == "seacrane.cli:main" and callable(entry.load())
    assert all((resources.files("seacrane") / name).is_file() for name in ("py.typed", "_core.pyi"))
    always = [line for line in metadata.requires("seacrane") or [] if "extra ==" not in line]
    assert {re.split(r"[^A-Za-z0-9_-]", line)[0] for line in always} == {
        "numpy", "scipy", "pandas", "xarray", "netCDF4", "h5py", "jinja2", "matplotlib",
        "threadpoolctl", "tqdm",
    }  # fmt: skip


def test_import_leaves_the_heavy_libraries_alone() -> None:
    loaded = set(run_python("import seacrane, sys; print(*sys.modules)").split())
    heavy = "scipy xarray matplotlib pandas h5netcdf h5py netCDF4 jinja2 tqdm threadpoolctl"
    assert "seacrane" in loaded and not loaded & {*heavy.split()}


def test_every_source_file_is_installed(repository: Path) -> None:
    source = repository / "python" / "seacrane"
    installed = Path(str(resources.files("seacrane")))
    for path in sorted(source.rglob("*")):
        if path.is_file() and "__pycache__" not in path.parts and path.suffix != ".so":
            copy = installed / path.relative_to(source)
            assert copy.is_file(), f"{path.relative_to(repository)} is not in the installed package"
            assert copy.read_bytes() == path.read_bytes(), f"{copy} is stale: run `make build`"


def test_committed_stub_is_what_the_module_generates(repository: Path, tmp_path: Path) -> None:
    options = ["--exit-code", "--ignore-invalid-expressions", r"<seacrane\._core\.\w+ object at 0x[0-9a-f]+>"]
    command = [sys.executable, "-m", "pybind11_stubgen", "seacrane._core", "--output-dir", str(tmp_path)]
    finished = subprocess.run([*command, *options], capture_output=True, text=True, check=False)
    assert finished.returncode == 0, finished.stdout + finished.stderr
    generated = (tmp_path / "seacrane" / "_core.pyi").read_text(encoding="utf-8")
    committed = (repository / "python" / "seacrane" / "_core.pyi").read_text(encoding="utf-8")
    assert committed == generated, "python/seacrane/_core.pyi is out of date: run `make stubs` and commit it"
