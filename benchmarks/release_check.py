"""Lists tables that another engine measured: ``python benchmarks/release_check.py`` (``make release-check``).

Ends with status 1 where there are any. The engine is the compiled core: what only Python changed, it cannot
tell.
"""

from __future__ import annotations

import sys

from measure import engine


def main() -> int:
    """Name them, each with what measured it."""
    others = engine.of_another()
    for table in others:
        print(f"{table.relative_to(engine.ROOT)}: {engine.words(table)}", file=sys.stderr)
    print(f"engine {engine.engine()}: {len(others)} tables of another one", file=sys.stderr)
    return int(bool(others))


if __name__ == "__main__":
    raise SystemExit(main())
