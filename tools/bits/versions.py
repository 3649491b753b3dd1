"""What the bits of a run depend on beside the sources."""

from __future__ import annotations

import platform
import re
from pathlib import Path

import numpy as np
import scipy

from seacrane import _core
from seacrane.cli.doctor_command import blas, build_facts
from seacrane.run.lanes import INSTRUCTIONS, module_of

BUILD = Path(__file__).parents[2] / "build" / "package"


def versions() -> dict[str, str]:
    """By what they are of."""
    facts = build_facts()
    lanes = [f"{count} ({name})" for count, name in INSTRUCTIONS.items() if module_of(count) is not None]
    return {
        "seacrane": facts["seacrane"],
        "compiler": facts.get("compiler", "unknown"),
        "libm": " ".join(platform.libc_ver()).strip() or platform.system(),
        "SUNDIALS": _sundials(),
        "NumPy": np.__version__,
        "SciPy": scipy.__version__,
        "linear algebra": blas(),
        "Python": platform.python_version(),
        "machine": platform.machine(),
        "instructions": ", ".join(name for name in INSTRUCTIONS.values() if _core.has_instructions(name)),
        "lanes": ", ".join(lanes) or "none",
    }


def _sundials() -> str:
    """As the build folder has found or fetched it; the core is linked statically, and does not tell."""
    cache = BUILD / "CMakeCache.txt"
    told = cache.read_text(encoding="utf-8") if cache.is_file() else ""
    for folder in re.findall(r"^SUNDIALS_DIR:PATH=(/.+)$", told, re.MULTILINE):
        text = (Path(folder) / "SUNDIALSConfigVersion.cmake").read_text(encoding="utf-8")
        return re.findall(r'set\(PACKAGE_VERSION "(.+)"\)', text)[0]
    return "fetched, see cmake/Dependencies.cmake" if told else "unknown: no build folder"
