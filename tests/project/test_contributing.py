"""The worked examples of docs/additions fit the code as it is, each by itself and all together."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools"))

import additions  # noqa: E402

DOCUMENT = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")
EXAMPLES = [additions.addition(name) for name in additions.NAMES]
# Those of Python that know no kind by name.
KNOWS_NO_KIND = ("scene/test_elements.py", "multibody/test_integrator_orders.py", "scene/test_channels.py")


@pytest.mark.parametrize("example", EXAMPLES, ids=additions.NAMES)
def test_the_words_behind_which_an_example_is_inserted_stand_once(example: additions.Addition) -> None:
    """And it takes at most three files."""
    assert set(re.findall(r"\(additions/(\w+)\)", DOCUMENT)) == set(additions.NAMES)
    for insertion in example.insertions:
        insertion.place((ROOT / insertion.file).read_text(encoding="utf-8"))
    assert 1 <= len(example.touched) <= 3
    assert not any((ROOT / file).exists() for file in example.new)


@pytest.mark.slow("compiles the package")
@pytest.mark.skipif(shutil.which("cmake") is None or shutil.which("g++") is None, reason="no compiler here")
def test_the_package_with_every_example_compiles_and_passes_its_tests(tmp_path: Path) -> None:
    """All in one build, which takes ten minutes: so an example also survives the additions of others."""
    copy, installed, build = (tmp_path / name for name in ("copy", "installed", "build"))
    for folder in ("cpp", "cmake", "licenses", "python", "examples", "tests", "studies"):
        shutil.copytree(ROOT / folder, copy / folder, ignore=shutil.ignore_patterns("__pycache__"))
    for file in ("CMakeLists.txt", "pyproject.toml", "README.md", "LICENSE"):
        shutil.copy(ROOT / file, copy)
    for example in EXAMPLES:
        example.into(copy)
    settings = {
        "SKBUILD_BUILD_DIR": str(build), "SKBUILD_CMAKE_DEFINE": "SEACRANE_WERROR=ON;SEACRANE_TESTS=ON",
        "PYTHONPATH": str(installed),
    }  # fmt: skip
    pip = [sys.executable, "-m", "pip", "install", "-q", "--no-deps", "--no-build-isolation"]
    own = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    for command in (
        [*pip, "--target", str(installed), str(copy)],
        ["cmake", "--build", str(build), "--target", "seacrane_tests"],
        ["ctest", "--test-dir", str(build), "--output-on-failure", "--no-tests=error"],
        # A table of a document is the author's to write again.
        [*own, "-k", "not documented_table", *(f"tests/{name}" for name in KNOWS_NO_KIND)],
    ):
        environment = {**os.environ, **settings}
        done = subprocess.run(command, cwd=copy, env=environment, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{command}: {done.stdout[-5000:]}{done.stderr[-5000:]}"
