"""The machine behind the numbers, as far as it can be read."""

from __future__ import annotations

import os
import platform
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
