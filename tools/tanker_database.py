"""Compute the tanker model with Capytaine: ``python tools/tanker_database.py FOLDER``.

FOLDER is the set's data, `measured/kvlcc2_roll_decay` of the shared folder. Writes
`benchmarks/measured/kvlcc2_roll_decay.nc`. A development tool: needs Capytaine 3.
"""

from __future__ import annotations

import sys
from pathlib import Path

BENCHMARKS = Path(__file__).resolve().parents[1] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))

from measured.kvlcc2_roll_decay import tanker_database  # noqa: E402


def main() -> None:
    """Solve and save."""
    place = BENCHMARKS / "measured" / "kvlcc2_roll_decay.nc"
    database = tanker_database(Path(sys.argv[1]), "capytaine")
    database.save(place)
    print(f"{place}: {place.stat().st_size / 1e3:.0f} kB; {database.source}")


if __name__ == "__main__":
    main()
