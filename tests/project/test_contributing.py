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
BY_NAME = {"argvalues": EXAMPLES, "ids": additions.NAMES}
KNOWS_NO_KIND = (
    "scene/test_elements.py",
    "multibody/test_integrator_orders.py",
    "scene/test_channels.py",
)  # those of Python


def test_the_document_names_every_example_and_no_other() -> None:
    assert set(re.findall(r"\(additions/(\w+)\)", DOCUMENT)) == set(additions.NAMES)


@pytest.mark.parametrize("example", **BY_NAME)
def test_the_words_behind_which_an_example_is_inserted_stand_once(example: additions.Addition) -> None:
    for insertion in example.insertions:
        insertion.place((ROOT / insertion.file).read_text(encoding="utf-8"))


@pytest.mark.parametrize("example", **BY_NAME)
def test_an_addition_takes_at_most_three_files(example: additions.Addition) -> None:
    assert 1 <= len(example.touched) <= 3
    assert not any((ROOT / file).exists() for file in example.new)


def test_an_example_is_inserted_beside_what_others_added(tmp_path: Path) -> None:
    registry = tmp_path / "list.hpp"
    registry.write_text("using Types = std::tuple<Weld, Distance,\n    Free, Another>;\n", encoding="utf-8")
    additions.Insertion("list.hpp", "Distance, Free", ", Screw").into(tmp_path)
    assert "Free, Screw, Another>" in registry.read_text(encoding="utf-8")
    with pytest.raises(ValueError, match="holds 'Distance Free' 0 times; it has to hold it once"):
        additions.Insertion("list.hpp", "Distance Free", "").into(tmp_path)


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


@pytest.mark.slow("compiles a file")
@pytest.mark.skipif(shutil.which("g++") is None, reason="g++ is not there to compile a joint")
def test_words_of_a_joint_may_be_one_letter(tmp_path: Path) -> None:
    """Compiled as the package is, optimised and with warnings as errors: some, only short texts raise."""
    folder = "seacrane/elements/joints"
    joints, added = ROOT / "cpp" / folder, tmp_path / folder
    added.mkdir(parents=True)
    text = (joints / "planar.hpp").read_text(encoding="utf-8").replace("Planar", "Added")
    words = "".join(
        f'  static constexpr const char* {name} = "x";\n' for name in ("kind", "coordinates", "usual")
    )
    text, found = re.subn(r'  static constexpr const char\* kind = "planar";\n', words, text)
    assert found == 1
    (added / "added.hpp").write_text(text, encoding="utf-8")
    text = (joints / "registry.hpp").read_text(encoding="utf-8")
    text, found = re.subn(r"(using JointTypes =\s+std::tuple<[^>]*)>;", r"\1, Added>;", text)
    assert found == 1
    text = text.replace("#include <utility>\n", f'#include <utility>\n\n#include "{folder}/added.hpp"\n')
    (added / "registry.hpp").write_text(text, encoding="utf-8")
    options = ["-std=c++20", "-O3", "-DNDEBUG", "-fPIC", "-fno-math-errno", "-Wall", "-Wextra", "-Werror"]
    includes = [f"-I{tmp_path}", f"-I{ROOT / 'cpp'}", f"-I{eigen()}"]
    command = ["g++", *options, *includes, "-c", joints / "joint_kinds.cpp", "-o", tmp_path / "out.o"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def eigen() -> str:
    """The folder of Eigen's headers that the package was built with."""
    cache = ROOT / "build" / "package" / "CMakeCache.txt"
    found = re.search(r"^Eigen3_DIR:PATH=(.*)/share/eigen3/cmake$", cache.read_text(), re.MULTILINE)
    if not found:
        pytest.skip("Eigen was not installed, and was fetched: its headers are elsewhere")
    return f"{found[1]}/include/eigen3"
