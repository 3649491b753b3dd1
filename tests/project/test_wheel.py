"""What is handed on: a complete source archive, a module that asks for little, wheels that are configured."""

from __future__ import annotations

import importlib
import re
import subprocess
import sys
import tarfile
from pathlib import Path

import pytest

from seacrane.cli.doctor_command import core_file

ROOT = Path(__file__).resolve().parents[2]
linux = pytest.mark.skipif(sys.platform != "linux", reason="modules of Linux are read by readelf")


def read_elf(*options: str) -> list[str]:
    """Lines of readelf about the compiled module."""
    command = ["readelf", "--wide", *options, str(core_file())]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


@pytest.mark.slow("makes an sdist")
def test_sdist_holds_all_that_the_build_needs_and_nothing_that_was_made(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", tmp_path, ROOT]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (archive,) = tmp_path.glob("seacrane-*.tar.gz")
    with tarfile.open(archive) as tar:
        sdist = {name.split("/", 1)[1] for name in tar.getnames() if "/" in name}
    wanted = {"LICENSE", "README.md", "pyproject.toml", "CMakeLists.txt", "PKG-INFO"}
    for folder in ("cpp", "cmake", "python", "examples", "licenses", "tools/wheel"):
        files = [path for path in (ROOT / folder).rglob("*") if path.is_file()]
        wanted |= {path.relative_to(ROOT).as_posix() for path in files}
    left = {name for name in wanted if name.endswith((".so", ".pyd", ".pyc"))}
    assert wanted - left - sdist == set()
    made = {"out", "build", "dist", ".venv", "__pycache__", "node_modules"}
    left = {name for name in sdist if not re.fullmatch(r"build/executed/\w+\.ipynb", name)}  # by `make wheel`
    assert [name for name in left if made & set(name.split("/")) or name.endswith((".so", ".pyc"))] == []
    if (ROOT / ".git").exists():
        ours = ["git", "ls-files", "--cached", "--others", "--exclude-standard"]
        listed = subprocess.run(ours, cwd=ROOT, capture_output=True, text=True, check=True).stdout
        assert left - set(listed.splitlines()) == {"PKG-INFO"}


@linux
def test_module_needs_libraries_of_every_system_only() -> None:
    needed = {line.split("[")[1].rstrip("]") for line in read_elf("--dynamic") if "(NEEDED)" in line}
    assert "libc.so.6" in needed
    assert {name.partition(".so")[0] for name in needed if not name.startswith("ld-linux")} <= {
        "libstdc++", "libgcc_s", "libm", "libc", "libpthread", "libdl",
    }  # fmt: skip


@linux
def test_module_shows_nothing_but_its_start() -> None:
    """SUNDIALS inside it does not meet another copy in the same process."""
    table = [line.split() for line in read_elf("--dyn-syms")]
    symbols = [row for row in table if len(row) >= 8 and row[0].rstrip(":").isdigit()]
    assert symbols
    shown = [row[7] for row in symbols if row[6] != "UND" and row[5] == "DEFAULT"]
    assert shown == ["PyInit__core"]


def test_another_archive_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(ROOT / "tools" / "wheel"))
    libraries = importlib.import_module("libraries")
    for name in ("sundials", "eigen"):
        address, digest = libraries.pin(name, libraries.PINS.read_text(encoding="utf-8"))
        assert address.startswith("https://") and name in address
        assert re.fullmatch("[0-9a-f]{64}", digest)
    other, pins = tmp_path / "eigen-9.tar.gz", tmp_path / "pins.cmake"
    other.write_bytes(b"not Eigen")
    pins.write_text(f"FetchContent_Declare(eigen\n  URL {other.as_uri()}\n  URL_HASH SHA256={'0' * 64}\n)")
    monkeypatch.setattr(libraries, "PINS", pins)
    (tmp_path / "got").mkdir()
    with pytest.raises(SystemExit, match=rf"eigen-9\.tar\.gz has SHA256 \w+.*{'0' * 64}"):
        libraries.download("eigen", tmp_path / "got")
