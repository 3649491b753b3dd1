"""The script of the pages of `view` is what its sources and the pinned three.js make."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest


@pytest.mark.slow("bundles by npm")
def test_the_committed_bundle_is_what_its_sources_make(repository: Path, tmp_path: Path) -> None:
    """Where the pinned packages are installed (`make viewer`), or npm can install them."""
    tools = repository / "tools" / "viewer"
    if shutil.which("npm") is None:
        pytest.skip("no npm: install Debian's packages nodejs and npm")
    copy = tmp_path / "viewer"
    shutil.copytree(tools, copy, ignore=shutil.ignore_patterns("node_modules"))
    installed = tools / "node_modules"
    if installed.is_dir():
        (copy / "node_modules").symlink_to(installed)
    (made := tmp_path / "made").mkdir()
    done = subprocess.run([copy / "build.sh", made], capture_output=True, text=True, check=False)
    if done.returncode and not installed.is_dir():
        pytest.skip(f"npm cannot install the pinned packages here: {done.stderr.strip()[-200:]}")
    assert done.returncode == 0, done.stderr
    committed = repository / "python" / "seacrane" / "pictures" / "assets"
    for name in ("viewer.js", "LICENSE.three.txt"):
        same = (made / name).read_bytes() == (committed / name).read_bytes()
        assert same, f"{name} is not what its sources make: run `make viewer` and commit it"
