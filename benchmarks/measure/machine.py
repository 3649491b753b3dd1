"""The machine and the tools behind the numbers, as far as they can be read."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
from importlib.metadata import version
from pathlib import Path


def processor() -> str:
    """Model name of the processor and the number of cores the process may use."""
    name = platform.processor() or platform.machine()
    description = Path("/proc/cpuinfo")
    virtual = ""
    if description.is_file():
        fields = [line.split(":", 1) for line in description.read_text().splitlines() if ":" in line]
        values = {key.strip(): value.strip() for key, value in reversed(fields)}
        name = values.get("model name", name)
        virtual = ", virtual" if "hypervisor" in values.get("flags", "").split() else ""
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    return f"{name}, {cores} cores{virtual}"


def compiler() -> str:
    """First line of what the C++ compiler says of itself; empty when none is installed any more."""
    path = shutil.which("c++")
    if path is None:
        return ""
    said = subprocess.run([path, "--version"], capture_output=True, text=True, check=True).stdout
    return said.splitlines()[0]


def machine() -> str:
    """One paragraph: processor, load, system, compiler, versions."""
    parts = [processor(), f"{platform.system()} {platform.machine()}", compiler()]
    parts += [f"Python {platform.python_version()}"]
    parts += [f"{package} {version(package)}" for package in ("seacrane", "numpy", "scipy")]
    load = ""
    if hasattr(os, "getloadavg"):
        load = f" Load average when the measurement began: {os.getloadavg()[0]:.1f}."
    return f"{'; '.join(part for part in parts if part)}.{load}"
