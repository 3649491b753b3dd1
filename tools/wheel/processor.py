"""What Linux tells of this processor, for comparison with what the package finds out by itself."""

from __future__ import annotations

import platform
import re
from pathlib import Path

NEEDED = {4: {"avx2", "fma"}, 8: {"avx2", "fma", "avx512f", "avx512dq", "avx512vl"}}


def lanes_of_this_processor() -> list[int]:
    """Numbers of lanes that it has instructions for; Linux leaves out what it does not keep registers of."""
    if platform.machine() != "x86_64":
        return []
    found = re.search(r"^flags\s*: (.*)$", Path("/proc/cpuinfo").read_text(encoding="ascii"), re.MULTILINE)
    flags = set(found[1].split()) if found else set()
    return [lanes for lanes, needed in NEEDED.items() if needed <= flags]
