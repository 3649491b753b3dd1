"""`.ci/system-packages` asks for what is missing, and for a browser only where tests want one."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SHELL = ("bash", "sed", "sort", "head", "id", "env")
BUILD = ("g++", "cmake", "ninja")
FAKE = '#!/bin/sh\necho "$@" >> {log}\nexit {code}\n'


@pytest.fixture
def machine(tmp_path: Path) -> Path:
    """A folder of programs: the shell's, the compiler's, an apt-get that only notes; no browser, no npm."""
    for name in SHELL + BUILD:
        found = shutil.which(name)
        if found is None:
            pytest.skip(f"no {name} here")
        (tmp_path / name).symlink_to(found)
    fake(tmp_path, "apt-get")
    fake(tmp_path, "sudo", '#!/bin/sh\nexec "$@"\n')
    return tmp_path


def fake(folder: Path, name: str, text: str = "", *, code: int = 0) -> None:
    path = folder / name
    path.write_text(text or FAKE.format(log=folder / "asked", code=code))
    path.chmod(0o755)


def run(machine: Path, repository: Path, *groups: str) -> tuple[subprocess.CompletedProcess[str], str]:
    """The script's end, and what it asked apt-get for."""
    command = [str(machine / "bash"), str(repository / ".ci" / "system-packages"), sys.executable, *groups]
    done = subprocess.run(command, env={"PATH": str(machine)}, capture_output=True, text=True, check=False)
    asked = machine / "asked"
    return done, asked.read_text() if asked.exists() else ""


def test_a_build_asks_for_no_browser(machine: Path, repository: Path) -> None:
    done, asked = run(machine, repository)
    assert done.returncode == 0, done.stderr
    assert "chromium" not in asked and "npm" not in asked


def test_a_build_asks_for_ccache_and_goes_on_without_it(machine: Path, repository: Path) -> None:
    fake(machine, "apt-get", FAKE.format(log=machine / "asked", code="$(echo $* | grep -c ccache)"))
    (machine / "grep").symlink_to(shutil.which("grep") or "/bin/grep")
    done, asked = run(machine, repository)
    assert done.returncode == 0, done.stderr
    assert "--no-install-recommends ccache\n" in asked
    assert "ccache cannot be installed" in done.stderr


def test_tests_ask_for_a_browser_and_nightly_ones_for_npm(machine: Path, repository: Path) -> None:
    done, asked = run(machine, repository, "browser", "npm")
    assert done.returncode == 0, done.stderr
    assert "--no-install-recommends chromium\n" in asked
    assert "--no-install-recommends npm\n" in asked


@pytest.mark.parametrize("browser", ["chromium", "google-chrome"])
def test_a_browser_that_is_there_is_enough(machine: Path, repository: Path, browser: str) -> None:
    fake(machine, browser)
    done, asked = run(machine, repository, "browser")
    assert done.returncode == 0, done.stderr
    assert "chromium" not in asked


def test_without_a_browser_to_install_tests_go_on(machine: Path, repository: Path) -> None:
    """As on Ubuntu, whose browser is no package."""
    fake(machine, "apt-get", '#!/bin/sh\ncase "$*" in *chromium*) exit 100;; esac\n')
    done, _ = run(machine, repository, "browser")
    assert done.returncode == 0
    assert "chromium cannot be installed" in done.stderr


def test_an_unknown_group_is_refused(machine: Path, repository: Path) -> None:
    done, asked = run(machine, repository, "browsers")
    assert done.returncode == 1 and asked == ""
    assert "'browsers'" in done.stderr
