"""Tries a wheel as one who installs it would, and keeps its facts: ``python tools/wheel/check.py WHEEL``.

It is installed where no compiler is found. `seacrane doctor` and `seacrane --version` run from it, and from
what `seacrane examples` writes a script, a lift file and the first notebook; every notebook has its outputs.
A run of case 2 is compared with one of the package that the system's own compiler made. Seeds of it in lanes,
as many as this processor has instructions for, are compared with seeds one by one. Facts go to
wheel-facts.csv beside the wheel, which `benchmarks/run.py --only wheel` publishes.
"""

from __future__ import annotations

import argparse
import csv
import json
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import jupytext
import numpy as np
from clean import Clean
from inside import inside, oldest_system
from processor import lanes_of_this_processor

ROOT = Path(__file__).resolve().parents[2]
HERE = Path(__file__).resolve().parent
TRIAL = ROOT / "build" / "wheel" / "trial"
OLDEST = (2, 28)  # the newest glibc that the wheel may ask for
SYSTEM = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1"}  # and the loader
LOADER = "ld-linux"
MODULES = ("_core", "_lanes_avx2", "_lanes_avx512")
SPAN = 20.0  # s of case 2
APART = 1e-9  # m: compilers round differently; a wrong wheel is further away
SPAN_OF_LANES = 5.0  # s
LANES_APART = 1e-6  # m, at a tolerance of 1e-9: lanes share their steps
REPEATS = 5
IMPORT = "import time; start = time.perf_counter(); import seacrane; print(time.perf_counter() - start)"
NO_COMPILER = (
    "import shutil; print(*filter(shutil.which, ('cc', 'c++', 'gcc', 'g++', 'clang', 'zig', 'cmake')))"
)


def require(good: bool, words: str) -> None:
    """End with these words unless it is good."""
    if not good:
        raise SystemExit(words)


def checked_inside(wheel: Path) -> dict[str, str]:
    """Facts of the file; refused where it would not run on an old system or shows more than it must."""
    facts = inside(wheel)
    oldest = oldest_system(wheel)
    require(oldest <= OLDEST, f"{wheel.name} needs glibc {oldest}; {OLDEST} was asked for")
    needed = facts["libraries that they need"].split()
    others = [name for name in needed if name not in SYSTEM and not name.startswith(LOADER)]
    require(not others, f"{wheel.name} needs {', '.join(others)}, which not every system has")
    shown = facts["names that they show to others"]
    require(shown == " ".join(f"PyInit_{name}" for name in MODULES), f"{wheel.name} shows {shown[:200]}")
    return facts | {"auditwheel show": "manylinux_{}_{}".format(*oldest)}


def timed(call: Callable[[], object]) -> float:
    """Seconds that a call takes."""
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def tried(clean: Clean, notebooks: list[str]) -> dict[str, str]:
    """What a new user does: ask, import, run the first of the notebooks that the wheel has."""
    found = clean.run("python", "-c", NO_COMPILER).strip()
    require(not found, f"the clean environment is not clean: {found}")
    print(clean.run("seacrane", "--version"))
    print(clean.run("seacrane", "doctor"))
    imports = [float(clean.run("python", "-c", IMPORT)) for _ in range(REPEATS)]
    print(clean.run("seacrane", "examples", "examples"))
    print(clean.run("python", "examples/pendulum.py"))
    print(clean.run("seacrane", "run", "examples/lifts/first_lift.toml", "--out", "runs"))
    first, *_ = notebooks_in(clean.folder / "examples", notebooks)
    if "pytest" in first.read_text(encoding="utf-8"):
        clean.run("python", "-m", "pip", "install", "-q", "pytest", reach=True)
    script = clean.folder / "notebook.py"
    jupytext.write(jupytext.read(first), script, fmt="py:percent")
    seconds = timed(lambda: print(clean.run("python", str(script))))
    return {
        "import, s": f"{statistics.median(imports):.2f}",
        f"notebook {first.stem[:2].lstrip('0')}, s": f"{seconds:.0f}",
    }


def notebooks_in(examples: Path, wanted: list[str]) -> list[Path]:
    """Those that are wanted, each with outputs; refused where one is missing or has none."""
    found = sorted((examples / "notebooks").glob("*.ipynb"))
    require([path.stem for path in found] == wanted, f"the wheel has the notebooks {found}, not {wanted}")
    for path in found:
        outputs = [out for cell in json.loads(path.read_text())["cells"] for out in cell.get("outputs", ())]
        require(len(outputs) > 1, f"{path.name} has no outputs")
    return found


def compared(clean: Clean, against: Path) -> dict[str, str]:
    """Case 2 of the wheel and of the other package: how far apart, and how much time each takes."""
    kept = {"wheel": clean.folder / "wheel.npy", "other": clean.folder / "other.npy"}
    script = str(HERE / "same_run.py")
    seconds: dict[str, list[float]] = {"wheel": [], "other": []}
    for _ in range(REPEATS):
        seconds["wheel"].append(float(clean.run("python", script, str(SPAN), str(kept["wheel"]))))
        command = [against, script, str(SPAN), kept["other"]]
        said = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        seconds["other"].append(float(said))
    apart = float(np.abs(np.load(kept["wheel"]) - np.load(kept["other"])).max())
    require(apart < APART, f"case 2 of the wheel is {apart:.1e} m from that of {against}")
    ratio = min(seconds["wheel"]) / min(seconds["other"])
    return {
        f"largest distance of a body from the system compiler's run, case 2, {SPAN:g} s, m": f"{apart:.1e}",
        "time of that run over the system compiler's": f"{ratio:.2f}",
    }


def stepped_in_lanes(clean: Clean) -> dict[str, str]:
    """Every number of lanes that this processor can have: how far they are from runs one by one."""
    rows = json.loads(clean.run("python", str(HERE / "same_lanes.py"), str(SPAN_OF_LANES)))
    found, wanted = [row["lanes"] for row in rows], lanes_of_this_processor()
    require(
        found == wanted, f"the wheel has lanes {found} here, and the processor has instructions for {wanted}"
    )
    for row in rows:
        lanes, beside, apart = row["lanes"], row["beside"], row["apart"]
        require(beside == lanes, f"of {lanes} seeds in {lanes} lanes, {beside} went side by side")
        require(apart < LANES_APART, f"seeds in {lanes} lanes are {apart:.1e} m from those one by one")
    if not rows:
        return {}
    ratios = ", ".join(f"{row['time']:.2f} ({row['lanes']})" for row in rows)
    return {
        "largest distance of a payload in lanes from its run alone, case 2, "
        f"{SPAN_OF_LANES:g} s, tolerance 1e-9, m": f"{max(row['apart'] for row in rows):.1e}",
        "time of seeds in lanes over that one by one (lanes)": ratios,
    }


def write(facts: dict[str, str], file: Path) -> None:
    """A table of two columns."""
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w", newline="", encoding="utf-8") as out:
        csv.writer(out, lineterminator="\n").writerows([("fact", "value"), *facts.items()])


def main() -> None:
    """Check, try, compare, keep."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("wheel", type=Path)
    other = "interpreter with the package that the system's compiler made (default: this one)"
    parser.add_argument("--against", type=Path, default=Path(sys.executable), metavar="PYTHON", help=other)
    every = sorted(path.stem for path in (ROOT / "notebooks").glob("*.md"))
    parser.add_argument(
        "--notebooks", nargs="+", default=every, metavar="NAME", help="that it holds (default: all)"
    )
    asked = parser.parse_args()
    facts = checked_inside(asked.wheel)
    clean = Clean.with_wheel(asked.wheel.resolve(), TRIAL)
    facts |= tried(clean, asked.notebooks) | stepped_in_lanes(clean) | compared(clean, asked.against)
    write(facts, asked.wheel.with_name("wheel-facts.csv"))
    print("\n".join(f"{name}: {value}" for name, value in facts.items()))


if __name__ == "__main__":
    main()
