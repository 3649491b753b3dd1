"""Resident memory and import time, each in a fresh process."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator

from .section import Section
from .sources import ENGINE

# Peak resident memory where the system states it, present memory elsewhere.
MEMORY = """
def resident():
    try:
        with open("/proc/self/status") as status:
            return next(int(line.split()[1]) / 1024 for line in status if line.startswith("VmHWM"))
    except OSError:
        import psutil
        return psutil.Process().memory_info().rss / 2**20
"""
STAGES = {
    "Python": "",
    "Python and NumPy": "import numpy",
    "and `import seacrane`": "import numpy, seacrane",
    "and case 2 described and compiled": (
        "import numpy\nfrom seacrane import cases\nmodel = cases.case2().compile()"
    ),
    "and 100 s of case 2 simulated": (
        "import numpy\nfrom seacrane import cases, simulate\nresult = simulate(cases.case2())"
    ),
}
IMPORTS = (
    "import numpy",
    "import seacrane",
    "from seacrane import Scene, cases, simulate",
    "from seacrane import view",
)
REPEATS = 3
LIMIT_MEMORY, LIMIT_IMPORT = 150.0, 0.3  # MB, s


def _run(code: str) -> float:
    """The number that the code prints, from a fresh interpreter with one thread."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    return float(json.loads(done.stdout))


def footprint() -> Iterator[list[object]]:
    """Peak resident memory after each stage, then times of imports, an interpreter's own start left out."""
    base = 0.0
    for name, code in STAGES.items():
        value = min(_run(f"{MEMORY}\n{code}\nprint(resident())") for _ in range(REPEATS))
        base = value if name == "Python and NumPy" else base
        yield [f"memory: {name}", f"{value:.0f} MiB"]
    yield ["memory: the last beyond Python and NumPy", f"{value - base:.0f} MiB"]
    code = "import time\nstart = time.perf_counter()\n{}\nprint(time.perf_counter() - start)"
    for statement in IMPORTS:
        took = min(_run(code.format(statement)) for _ in range(2 * REPEATS))
        yield [f"time: `{statement}`", f"{1e3 * took:.0f} ms"]


SECTION = Section(
    title="Footprint",
    text=(
        f"Of a fresh process: peak resident memory, the smallest of {REPEATS}, and wall time of imports, the "
        f"shortest of some. Aims: {LIMIT_MEMORY:g} MiB beyond Python and NumPy, {LIMIT_IMPORT:g} s to import."
    ),
    head=["what", "value"],
    rows=footprint,
    sources=("python/seacrane/**/*.py", *ENGINE),
)
