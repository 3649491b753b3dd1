"""Coverage-guided fuzzing of the readers with atheris: python tools/fuzzing/run.py [TARGET ...] --cases N.

Each target runs in processes of its own, in slices; counts, unsound cases and the corpus that grew are kept
in the folder --out, and a later call goes on from there. Unsound is what raises more than a refusal by name,
takes more than tests/fuzz/limits.py allows, returns a number that is not finite, or ends the process.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import traceback
from pathlib import Path
from typing import Any

sys.path.extend(map(str, (Path(__file__).resolve().parents[2] / "tests").glob("*/")))
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests"))

from fuzz.limits import Hang

MEMORY = 3 * 2**30  # bytes, beyond which nothing is given
SLICE = 50_000  # cases of one process


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="*", metavar="TARGET")
    parser.add_argument("--cases", type=int, default=1_000_000, help="of each target, earlier calls included")
    parser.add_argument("--seconds", type=float, default=1e9, help="after which no slice is begun")
    parser.add_argument("--slice-seconds", type=float, default=60.0, help="processor time of each in turn")
    parser.add_argument("--out", type=Path, default=Path("out/fuzz"))
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        return _child(options.targets[0], options)
    from fuzz.targets import TARGETS

    names = options.targets or list(TARGETS)
    unknown = [name for name in names if name not in TARGETS]
    if unknown:
        sys.exit(f"no target {unknown[0]!r}; choose from {', '.join(TARGETS)}")
    end = time.monotonic() + options.seconds
    while time.monotonic() < end:
        left = [name for name in names if _count(options.out, name)["cases"] < options.cases]
        if not left:
            break
        for name in left:
            if time.monotonic() < end:
                _slice(name, options)
    return _report({name: _count(options.out, name) for name in names})


def _count(out: Path, name: str) -> dict[str, Any]:
    path = out / name / "count.json"
    empty = {"cases": 0, "value": 0, "refused": 0, "no case": 0, "unsound": {}, "seconds": 0.0}
    return json.loads(path.read_text()) if path.is_file() else empty


def _slice(name: str, options: argparse.Namespace) -> None:
    command = [sys.executable, __file__, name, "--child", "--out", str(options.out)]
    command += ["--cases", str(options.cases), "--seconds", str(options.slice_seconds)]
    log = options.out / name / "log.txt"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("wb") as file:
        code = subprocess.run(command, stdout=file, stderr=file, check=False).returncode
    found = _count(options.out, name)
    print(f"{name}: {found['cases']} cases, {sum(found['unsound'].values())} unsound", flush=True)
    if code:
        print(f"{name}: the process ended with {code}; see {log} and crash-* beside it", flush=True)
        log.rename(log.with_name(f"log-{int(time.time())}.txt"))


def _report(counts: dict[str, dict[str, Any]]) -> int:
    print(f"{'target':18} {'cases':>9} {'values':>9} {'refused':>9} {'per s':>7}  unsound")
    for name, found in counts.items():
        rate = found["cases"] / max(found["seconds"], 1e-9)
        numbers = " ".join(f"{found[key]:9}" for key in ("cases", "value", "refused"))
        print(f"{name:18} {numbers} {rate:7.0f}  {found['unsound']}")
    return int(any(found["unsound"] for found in counts.values()))


def _child(name: str, options: argparse.Namespace) -> int:
    try:
        import atheris
    except ImportError:
        sys.exit("coverage-guided fuzzing needs atheris: pip install 'seacrane[fuzz]'")
    with atheris.instrument_imports(include=["seacrane"]):
        pass
    from fuzz.targets import TARGETS, cases, quiet

    target = TARGETS[name]
    home = options.out / name
    grown = home / "corpus"
    grown.mkdir(parents=True, exist_ok=True)
    folder = Path(tempfile.mkdtemp(dir="/dev/shm" if os.path.isdir("/dev/shm") else None))
    target.place(folder)
    for case in cases(target):
        (grown / hashlib.sha1(case.read_bytes()).hexdigest()).write_bytes(case.read_bytes())
    harness = Harness(target, home, folder, options)
    seed = int.from_bytes(os.urandom(4), "little") & 0x7FFFFFFF
    arguments = [sys.argv[0], str(grown), f"-artifact_prefix={home}/", f"-seed={seed}"]
    arguments += ["-max_len=120000", "-timeout=60", "-rss_limit_mb=4096", "-detect_leaks=0", "-verbosity=0"]
    mutator: dict[str, Any] = {}
    if target.mutate is not None:  # by the structure of the file; it decides how much changes at a time
        mutator["custom_mutator"] = lambda data, size, seed: target.mutate(data, random.Random(seed))[:size]
        arguments += ["-mutate_depth=1", "-cross_over=0"]
    atheris.Setup(arguments, harness, **mutator)
    taken = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (taken + MEMORY, taken + MEMORY))
    with quiet():
        atheris.Fuzz()
    return 0


class Harness:
    """Runs cases, counts them and keeps those that are unsound, one for each place where they fail."""

    def __init__(self, target: Any, home: Path, folder: Path, options: argparse.Namespace) -> None:
        self.target, self.home, self.folder, self.options = target, home, folder, options
        self.count = _count(options.out, target.name)
        self.before = self.count["seconds"]
        self.start = time.process_time()
        self.fresh = 0

    def __call__(self, data: bytes) -> None:
        try:
            self.count[self.target.run(data, self.folder)] += 1
        except (Exception, Hang) as error:
            self._keep(data, error)
        self.count["cases"] += 1
        self.fresh += 1
        if self.fresh % 500 == 0 or self.fresh < 3:
            self._save()
            over = time.process_time() - self.start > self.options.seconds
            if over or self.fresh >= SLICE or self.count["cases"] >= self.options.cases:
                shutil.rmtree(self.folder)
                os._exit(0)

    def _save(self) -> None:
        self.count["seconds"] = self.before + time.process_time() - self.start
        (self.home / "count.new").write_text(json.dumps(self.count))
        os.replace(self.home / "count.new", self.home / "count.json")

    def _keep(self, data: bytes, error: BaseException) -> None:
        frames = list(traceback.extract_tb(error.__traceback__))
        frame = ([one for one in frames if "/seacrane/" in one.filename] or frames)[-1]
        place = f"{type(error).__name__} {Path(frame.filename).name}:{frame.lineno}"
        if place not in self.count["unsound"]:
            (self.home / f"unsound-{place.replace(' ', '-').replace(':', '-')}").write_bytes(data)
            print(place, str(error)[:300], flush=True)
        self.count["unsound"][place] = self.count["unsound"].get(place, 0) + 1


if __name__ == "__main__":
    sys.exit(main())
