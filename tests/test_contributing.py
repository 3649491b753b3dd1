"""The worked examples of docs/contributing.md fit the code as it is."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
DOCUMENT = (ROOT / "docs" / "contributing.md").read_text(encoding="utf-8")
EXAMPLES = re.findall(r"<summary>(.*?)</summary>\n\n```diff\n(.*?)```", DOCUMENT, re.DOTALL)


def test_every_kind_has_an_example() -> None:
    assert len(EXAMPLES) == DOCUMENT.count("```diff") >= 5


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not there to apply a diff")
@pytest.mark.parametrize(("name", "diff"), EXAMPLES, ids=[name for name, _ in EXAMPLES])
def test_an_example_applies(name: str, diff: str) -> None:
    command = ["git", "apply", "--check", "-"]
    done = subprocess.run(command, cwd=ROOT, input=diff, capture_output=True, text=True)
    assert done.returncode == 0, f"{name}: {done.stderr}"


@pytest.mark.parametrize(("name", "diff"), EXAMPLES, ids=[name for name, _ in EXAMPLES])
def test_an_addition_takes_at_most_three_files(name: str, diff: str) -> None:
    assert 1 <= len(re.findall(r"^diff --git ", diff, re.MULTILINE)) <= 3


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
