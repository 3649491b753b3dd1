"""``python -m seeded_faults`` (``make campaign NAME=faults``): seed each fault, tell who finds it.

What was found stands in ``out/faults/found.csv``; what is there already is not tried again. ``--check`` only
looks whether each fault still has its place, and fails where one has not.
"""

from __future__ import annotations

import argparse
import csv
import resource
import sys
from pathlib import Path

from seeded_faults.fault import faults
from seeded_faults.hunt import Hunt

ROOT = Path(__file__).resolve().parents[2]
HOME = ROOT / "out" / "faults"
COLUMNS = ("fault", "file", "found_by", "test", "cpu_s")


def main() -> int:
    """Run; 1 where a fault has lost its place, or nobody finds one."""
    parser = argparse.ArgumentParser(prog="python -m seeded_faults", description=__doc__)
    parser.add_argument("names", nargs="*", metavar="FAULT", help="all when left out")
    parser.add_argument("--check", action="store_true", help="only whether each fault has its place")
    parser.add_argument("--before", type=Path, help="found.csv of another time: its tests look first")
    parser.add_argument("--night", action="store_true", help="slow tests look for what others do not find")
    args = parser.parse_args()
    wanted = [fault for fault in faults() if not args.names or fault.name in args.names]
    unknown = {*args.names} - {fault.name for fault in wanted}
    if unknown:
        parser.error(f"there is no fault {sorted(unknown)[0]!r}")
    lost = [
        fault for fault in wanted if (ROOT / fault.file).read_text(encoding="utf-8").count(fault.old) != 1
    ]
    if lost:
        print("\n".join(f"fault {one.name!r} has not its place in {one.file}; mend it" for one in lost))
        return 1
    if args.check:
        print(f"{len(wanted)} faults have their places")
        return 0
    table = HOME / "found.csv"
    known = _known(table)
    before = _known(args.before, "test") if args.before else {}
    hunt = Hunt(ROOT, HOME)
    with table.open("a", newline="", encoding="utf-8") as out:
        rows = csv.writer(out, lineterminator="\n")
        if not known:
            rows.writerow(COLUMNS)
        for fault in wanted:
            if fault.name in known:
                continue
            began = _seconds()
            who, test = hunt.finder(fault, first=before.get(fault.name, ""), by_night=args.night)
            rows.writerow((fault.name, fault.file, who, test, f"{_seconds() - began:.0f}"))
            out.flush()
            print(f"{fault.name}: {who} {test}", flush=True)
    found = _known(table)
    missed = [fault.name for fault in wanted if found[fault.name] == "nobody"]
    print(
        f"{len(wanted) - len(missed)} of {len(wanted)} found" + "".join(f"\n  not {name}" for name in missed)
    )
    return int(bool(missed))


def _known(table: Path, column: str = "found_by") -> dict[str, str]:
    if not table.exists():
        return {}
    with table.open(encoding="utf-8") as rows:
        return {row["fault"]: row[column] for row in csv.DictReader(rows)}


def _seconds() -> float:
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


if __name__ == "__main__":
    sys.exit(main())
