"""What a wheel holds and asks for: its tag, its sizes, and what its compiled modules want of the system."""

from __future__ import annotations

import io
import re
import subprocess
import sys
import zipfile
from pathlib import Path

from elftools.elf.elffile import ELFFile

MANYLINUX = re.compile(r"manylinux_(\d+)_(\d+)_")


def inside(wheel: Path) -> dict[str, str]:
    """Facts by name, of all its modules together; sizes in MB of 1e6 bytes."""
    with zipfile.ZipFile(wheel) as archive:
        unpacked = sum(entry.file_size for entry in archive.infolist())
        names = sorted(entry for entry in archive.namelist() if entry.endswith(".so"))
        modules = [archive.read(name) for name in names]
    elves = [ELFFile(io.BytesIO(module)) for module in modules]
    stems = (Path(name).name.split(".")[0] for name in names)
    sizes = (f"{stem} {len(module) / 1e6:.1f}" for stem, module in zip(stems, modules, strict=True))
    needed = {name for elf in elves for name in needed_libraries(elf)}
    return {
        "wheel": wheel.name,
        "size, MB": f"{wheel.stat().st_size / 1e6:.1f}",
        "unpacked, MB": f"{unpacked / 1e6:.1f}",
        "compiled modules, MB": ", ".join(sizes),
        "libraries that they need": " ".join(sorted(needed)),
        "newest version of a symbol that they need": max(map(newest_symbol, elves), key=_numbers),
        "names that they show to others": " ".join(name for elf in elves for name in shown_names(elf)),
    }


def needed_libraries(elf: ELFFile) -> list[str]:
    """Shared libraries that the loader must find."""
    tags = elf.get_section_by_name(".dynamic").iter_tags("DT_NEEDED")
    return sorted(tag.needed for tag in tags)


def newest_symbol(elf: ELFFile) -> str:
    """Of the C library: the least version that has all that the module calls."""
    section = elf.get_section_by_name(".gnu.version_r")
    versions = [entry.name for _, entries in section.iter_versions() for entry in entries]
    return max((name for name in versions if name.startswith("GLIBC_")), key=_numbers)


def _numbers(version: str) -> list[int]:
    return [int(number) for number in version.removeprefix("GLIBC_").split(".")]


def shown_names(elf: ELFFile) -> list[str]:
    """Symbols that the module defines and other modules of a process can see."""
    symbols = elf.get_section_by_name(".dynsym").iter_symbols()
    seen = (symbol for symbol in symbols if symbol["st_shndx"] != "SHN_UNDEF")
    return sorted(symbol.name for symbol in seen if symbol["st_other"]["visibility"] == "STV_DEFAULT")


def oldest_system(wheel: Path) -> tuple[int, int]:
    """The glibc that ``auditwheel show`` says is enough.

    Raises
    ------
    SystemExit
        auditwheel finds no manylinux that the wheel fits.
    """
    command = [sys.executable, "-m", "auditwheel", "show", wheel]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(done.stdout)
    found = MANYLINUX.search(done.stdout)
    if not found:
        raise SystemExit(f"{wheel.name} fits no manylinux: see the words of auditwheel above")
    return int(found[1]), int(found[2])
