"""Builds what a wheel holds inside: SUNDIALS (CVODE, IDA), static, and the headers of Eigen.

    python tools/wheel/libraries.py FOLDER [--sundials ARCHIVE] [--eigen ARCHIVE]

An archive that is not given is downloaded from where cmake/Dependencies.cmake says, and must have the SHA256
that stands there. CMake takes the compilers from CC and CXX. Needs nothing but CMake and Python 3.9, which is
what cibuildwheel has before it builds.
"""

from __future__ import annotations

import argparse
import hashlib
import os
import re
import shutil
import subprocess
import tarfile
import tempfile
import urllib.request
from collections.abc import Sequence
from pathlib import Path

PINS = Path(__file__).resolve().parents[2] / "cmake" / "Dependencies.cmake"
COMMON = ("-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_INSTALL_LIBDIR=lib")
# Hidden: SUNDIALS inside the module must not meet another copy in the same Python process.
SUNDIALS = (
    "-DBUILD_SHARED_LIBS=OFF",
    "-DBUILD_STATIC_LIBS=ON",
    "-DCMAKE_POSITION_INDEPENDENT_CODE=ON",
    "-DCMAKE_C_VISIBILITY_PRESET=hidden",
    "-DBUILD_ARKODE=OFF",
    "-DBUILD_CVODES=OFF",
    "-DBUILD_IDAS=OFF",
    "-DBUILD_KINSOL=OFF",
    "-DEXAMPLES_ENABLE_C=OFF",
    "-DEXAMPLES_ENABLE_CXX=OFF",
    "-DEXAMPLES_INSTALL=OFF",
)
EIGEN = ("-DBUILD_TESTING=OFF", "-DEIGEN_BUILD_DOC=OFF", "-DEIGEN_BUILD_PKGCONFIG=OFF")


def pin(name: str, text: str) -> tuple[str, str]:
    """Address and SHA256 of a library's archive, as ``FetchContent_Declare(name ...)`` has them."""
    found = re.search(rf"FetchContent_Declare\({name}\s+URL (\S+)\s+URL_HASH SHA256=([0-9a-f]{{64}})", text)
    if not found:
        raise SystemExit(f"{PINS}: no address and SHA256 of {name}; give its archive by --{name}")
    return found[1], found[2]


def download(name: str, folder: Path) -> Path:
    """The pinned archive of a library."""
    address, expected = pin(name, PINS.read_text(encoding="utf-8"))
    archive = folder / address.rsplit("/", 1)[1]
    with urllib.request.urlopen(address) as answer, archive.open("wb") as file:
        shutil.copyfileobj(answer, file)
    found = hashlib.sha256(archive.read_bytes()).hexdigest()
    if found != expected:
        raise SystemExit(f"{address} has SHA256 {found}; {PINS.name} says {expected}")
    return archive


def unpack(archive: Path, folder: Path) -> Path:
    """The one folder that an archive holds."""
    with tarfile.open(archive) as tar:
        tar.extractall(folder, **({"filter": "data"} if hasattr(tarfile, "data_filter") else {}))
    (source,) = (path for path in folder.iterdir() if path.is_dir())
    return source


def install(source: Path, build: Path, prefix: Path, options: Sequence[str]) -> None:
    """Configure, build and install by CMake."""
    where = f"-DCMAKE_INSTALL_PREFIX={prefix}"
    # For ccache, where the compiler is called through it: the folder has another name each time.
    environment = {**os.environ, "CCACHE_BASEDIR": str(build.parent), "CCACHE_NOHASHDIR": "1"}
    for command in (
        ["cmake", "-S", source, "-B", build, where, *COMMON, *options],
        ["cmake", "--build", build, "--config", "Release"],
        ["cmake", "--install", build, "--config", "Release"],
    ):
        subprocess.run(command, check=True, env=environment)


def main() -> None:
    """Fetch, build and install both."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("prefix", type=Path, metavar="FOLDER", help="to install into")
    parser.add_argument("--sundials", type=Path, metavar="ARCHIVE", help="its source; not downloaded")
    parser.add_argument("--eigen", type=Path, metavar="ARCHIVE", help="its source; not downloaded")
    asked = parser.parse_args()
    for name, options in (("sundials", SUNDIALS), ("eigen", EIGEN)):
        with tempfile.TemporaryDirectory() as name_of_folder:
            folder = Path(name_of_folder)
            archive = getattr(asked, name) or download(name, folder)
            source = unpack(archive, folder / "source")
            install(source, folder / "build", asked.prefix.resolve(), options)


if __name__ == "__main__":
    main()
