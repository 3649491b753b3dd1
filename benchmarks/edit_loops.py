"""Measures how long an edit takes from save to import: ``python benchmarks/edit_loops.py [--publish]``.

Of each kind one file is changed in earnest (a comment alone ccache would recognise), ``make build`` is called
and the package imported in a new process; then the file is restored, and the package built again.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
import time
import uuid
from pathlib import Path

from measure.section import Section

ROOT = Path(__file__).resolve().parents[1]
RESULTS = Path(__file__).resolve().parent / "results"
FILES = {
    "Python": "python/seacrane/run/outputs.py",
    "load": "cpp/seacrane/elements/loads/friction.hpp",
    "joint": "cpp/seacrane/elements/joints/universal.hpp",
    "channel": "cpp/seacrane/run/channels/accuracy.cpp",
    "integrator": "cpp/seacrane/integrate/rk_low_storage.cpp",
}


def build_and_import() -> tuple[float, float]:
    """s of processor time and of the wall."""
    began, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    for command in (["make", "--silent", "build"], [sys.executable, "-c", "import seacrane"]):
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return cpu, time.perf_counter() - began


def edited(file: Path) -> tuple[float, float]:
    """What an edit of the file costs."""
    kept = file.read_text(encoding="utf-8")
    name = f"edited_{uuid.uuid4().hex}"
    more = (
        f"{name} = 0\n"
        if file.suffix == ".py"
        else f"namespace seacrane {{ inline constexpr int {name} = 0; }}\n"
    )
    try:
        file.write_text(kept + more, encoding="utf-8")
        return build_and_import()
    finally:
        file.write_text(kept, encoding="utf-8")


def main() -> None:
    """Measure, print, keep."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--publish", action="store_true", help="also into benchmarks/results and the documents"
    )
    publish = parser.parse_args().publish
    build_and_import()
    rows = []
    for kind, file in FILES.items():
        cpu, wall = edited(ROOT / file)
        rows.append([f"{kind} ({Path(file).name})", cpu, wall, os.getloadavg()[0]])
        print(f"{kind}: {cpu:.1f} s of processor time, {wall:.1f} s", flush=True)
    build_and_import()
    head = ["edit of a", "CPU, s", "wall, s", "load of the machine"]
    section = Section(title="Edit loops", text="From save to import.", head=head, rows=rows)
    section.save(RESULTS if publish else ROOT / "out" / "bench")
    if publish:
        table = RESULTS / f"{section.name}.csv"
        subprocess.run([sys.executable, "benchmarks/documents.py", "--measured", table], cwd=ROOT, check=True)


if __name__ == "__main__":
    main()
