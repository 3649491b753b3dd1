"""How the package was built, from what its files and its metadata tell; nothing numerical is loaded."""

from __future__ import annotations

import platform
import re
from importlib.machinery import EXTENSION_SUFFIXES
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from seacrane.version import __version__

PACKAGE = Path(__file__).parents[1]
COMPILERS = (rb"GCC: \([^)]*\) [\d.]+", rb"clang version [\d.]+", rb"Apple clang version [\d.]+")
# What is inside a core that was built to find errors, and is slow for it.
SLOW = {
    b"__asan_init": "AddressSanitizer",
    b"__tsan_init": "ThreadSanitizer",
    b"__ubsan_handle": "UBSan",
    b"__gcov_": "coverage",
}


def core_file() -> Path | None:
    """The compiled core of this interpreter; None where there is none."""
    names = (PACKAGE / f"_core{suffix}" for suffix in EXTENSION_SUFFIXES)
    return next((name for name in names if name.is_file()), None)


def build_facts() -> dict[str, str]:
    """What is known of how this package was built, by what it is about.

    Returns
    -------
    dict of str to str
        "seacrane" (version), "python", "platform", "core" (file), "compiler", "instrumented" (only where it
        is), "wheel" (tag, only where it was installed from one) and "installed in".
    """
    facts = {
        "seacrane": __version__,
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "platform": f"{platform.system()} {platform.machine()}",
        "core": "missing: the package was not built for this Python",
    }
    file = core_file()
    if file is not None:
        facts["core"] = f"{file.name}, {file.stat().st_size / 1e6:.1f} MB"
        facts |= _inside(file.read_bytes())
    facts |= _wheel()
    return {**facts, "installed in": str(PACKAGE)}


def _inside(core: bytes) -> dict[str, str]:
    found: dict[str, str] = {}
    for pattern in COMPILERS:
        match = re.search(pattern, core)
        if match:
            found["compiler"] = match[0].decode("ascii", "replace")
            break
    slow = [name for mark, name in SLOW.items() if mark in core]
    return found | ({"instrumented": f"{', '.join(slow)}: slow"} if slow else {})


def _wheel() -> dict[str, str]:
    try:
        text = distribution("seacrane").read_text("WHEEL") or ""
    except PackageNotFoundError:
        return {}
    tags = re.findall(r"^Tag: (.+)$", text, re.MULTILINE)
    return {"wheel": ", ".join(tags)} if tags else {}
