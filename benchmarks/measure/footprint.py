"""Resident memory and import time, each in a fresh process."""

from __future__ import annotations

import json
import os
import subprocess
import sys

from .section import Section

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
IMPORTS = {
    "import numpy": "import numpy",
    "import seacrane": "import seacrane",
    "from seacrane import Scene, cases, simulate": "from seacrane import Scene, cases, simulate",
    "from seacrane import view": "from seacrane import view",
}
LIMIT_MEMORY, LIMIT_IMPORT = 150.0, 0.3  # MB, s


def _run(code: str) -> float:
    """The number that the code prints, from a fresh interpreter with one thread."""
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    return float(json.loads(done.stdout))


def memory(*, repeats: int) -> Section:
    """Peak resident memory after each stage."""
    measured = {
        name: min(_run(f"{MEMORY}\n{code}\nprint(resident())") for _ in range(repeats))
        for name, code in STAGES.items()
    }
    base = measured["Python and NumPy"]
    return Section(
        title="Memory",
        text=(
            f"Peak resident memory of a fresh process, MiB; smallest of {repeats}. The aim is under "
            f"{LIMIT_MEMORY:g} beyond Python and NumPy."
        ),
        head=["after", "MiB", "beyond Python and NumPy"],
        rows=[[name, round(value), round(value - base)] for name, value in measured.items()],
    )


def imports(*, repeats: int) -> Section:
    """Time of imports in a fresh interpreter, its own start left out."""
    code = "import time\nstart = time.perf_counter()\n{}\nprint(time.perf_counter() - start)"
    rows = [
        [f"`{name}`", round(1e3 * min(_run(code.format(statement)) for _ in range(repeats)))]
        for name, statement in IMPORTS.items()
    ]
    return Section(
        title="Import",
        text=(
            f"Fresh interpreter, its own start left out; wall time, best of {repeats}. The aim is under "
            f"{LIMIT_IMPORT:g} s."
        ),
        head=["statement", "ms"],
        rows=rows,
    )
