"""`.ci/system-packages` asks for what is missing, and for a browser only where tests want one."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

FAKE = '#!/bin/sh\necho "$@" >> {log}\ncase "$*" in *{fails}*) exit 100;; esac\n'
RECOMMENDED = "--no-install-recommends"


def fake(folder: Path, name: str, fails: str = "nothing") -> None:
    """A program that notes what it was asked for, and fails where that holds a word."""
    (folder / name).write_text(FAKE.format(log=folder / "asked", fails=fails))
    (folder / name).chmod(0o755)


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """A folder of programs: the shell's, the compiler's, an apt-get that only notes; no browser, no npm."""
    for name in ("bash", "sed", "sort", "head", "id", "env", "g++", "cmake", "ninja"):
        found = shutil.which(name)
        if found is None:
            pytest.skip(f"no {name} here")
        (tmp_path / name).symlink_to(found)
    fake(tmp_path, "apt-get")
    (tmp_path / "sudo").write_text('#!/bin/sh\nexec "$@"\n')
    (tmp_path / "sudo").chmod(0o755)
    return tmp_path


@pytest.mark.parametrize(
    ("groups", "there", "fails", "wanted", "told"),
    [
        ("", "", "nothing", ["ccache"], ""),
        ("", "", "ccache", ["ccache"], "ccache cannot be installed"),
        ("browser npm", "", "nothing", ["ccache", "chromium", "npm"], ""),
        ("browser", "google-chrome", "nothing", ["ccache"], ""),
        ("browser", "", "chromium", ["ccache", "chromium"], "chromium cannot be installed"),  # as on Ubuntu
    ],
)
def test_what_is_asked_for(
    groups: str, there: str, fails: str, wanted: list[str], told: str, machine: Path, repository: Path
) -> None:
    fake(machine, "apt-get", fails)
    if there:
        fake(machine, there)
    done, asked = run(machine, repository, *groups.split())
    assert done.returncode == 0 and told in done.stderr, done.stderr
    assert {name for name in ("ccache", "chromium", "npm") if f"{RECOMMENDED} {name}\n" in asked} == {*wanted}


def run(machine: Path, repository: Path, *groups: str) -> tuple[subprocess.CompletedProcess[str], str]:
    """The script's end, and what it asked apt-get for."""
    command = [str(machine / "bash"), str(repository / ".ci" / "system-packages"), sys.executable, *groups]
    done = subprocess.run(command, env={"PATH": str(machine)}, capture_output=True, text=True, check=False)
    asked = machine / "asked"
    return done, asked.read_text() if asked.exists() else ""


def test_an_unknown_group_is_refused(machine: Path, repository: Path) -> None:
    done, asked = run(machine, repository, "browsers")
    assert done.returncode == 1 and asked == "" and "'browsers'" in done.stderr
