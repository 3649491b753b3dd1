"""Lines of each reader that the committed corpus reaches: line_coverage.py [--missing] [FOLDER of more].

Ends with 1 if a reader is below 90 %. With --missing, prints which lines are not reached.
"""

from __future__ import annotations

import ast
import contextlib
import re
import sys
import tempfile
from pathlib import Path

import coverage

ROOT = Path(__file__).resolve().parents[2]
LEAST = 90.0
WRITERS = re.compile(  # functions in the readers' files that write, draw or describe
    r"(save|add_events|_add_|write|_write|_put|to_xarray|described|scene_digest|_elements|_load_entries"
    r"|_plain_array|_plain_field|_plain_entry|_block$|plain_data|plain_notes|kind_of"
    r"|state_to_bytes|_is_state|shape$|rows$|spectrum|__repr__|curves$"
    r"|_refuse_swings|_warn_of|require_parts"
    r"|half_breadth|_end_parameters|section$|panels$|dataset_of|_arrays$|rows_of_|_shape$|interpolated)"
)
sys.path.extend(map(str, [ROOT / "tests", *(ROOT / "tests").glob("*/")]))


def main() -> int:
    """The corpus under coverage, then a table."""
    meter = coverage.Coverage(data_file=None, source_pkgs=["seacrane"], config_file=False)
    meter.exclude(r"if TYPE_CHECKING:")
    meter.start()
    from fuzz.damage import damages
    from fuzz.limits import TooDear
    from fuzz.targets import TARGETS, cases, quiet

    more = [Path(word) for word in sys.argv[1:] if not word.startswith("-")]
    with quiet(), tempfile.TemporaryDirectory() as name:
        for target in TARGETS.values():
            folder = Path(name) / target.name
            folder.mkdir()
            target.place(folder)
            grown = [file for root in more for file in sorted((root / target.name / "corpus").glob("*"))]
            contents = [path.read_bytes() for path in [*cases(target), *grown]]
            for case in [*contents, *(damage.case() for damage in damages(target.name))]:
                with contextlib.suppress(TooDear):  # what is watched costs more; test_fuzz.py asks for that
                    target.run(case, folder)
    meter.stop()
    import seacrane

    package, worst = Path(seacrane.__file__).parent, 100.0
    modules: dict[str, set[str]] = {}
    for target in TARGETS.values():
        modules.setdefault(target.reader, set()).update(target.modules)
    print(f"{'reader':10} {'lines':>6} {'reached':>8} {'share':>7}")
    for reader, files in modules.items():
        lines, missed = 0, 0
        for file in sorted(files):
            _, statements, _, missing, _ = meter.analysis2(str(package / file))
            other = _written(package / file)
            lines, missed = lines + len(set(statements) - other), missed + len(set(missing) - other)
            if set(missing) - other and "--missing" in sys.argv:
                print(f"    {file}: {', '.join(map(str, sorted(set(missing) - other)))}")
        share = 100.0 * (lines - missed) / lines
        worst = min(worst, share)
        print(f"{reader:10} {lines:6} {lines - missed:8} {share:6.1f}%")
    return 0 if worst >= LEAST else 1


def _written(file: Path) -> set[int]:
    """Lines of the functions that do not read."""
    nodes = ast.walk(ast.parse(file.read_text(encoding="utf-8")))
    writers = [node for node in nodes if isinstance(node, ast.FunctionDef) and WRITERS.match(node.name)]
    return {line for node in writers for line in range(node.lineno, (node.end_lineno or node.lineno) + 1)}


if __name__ == "__main__":
    sys.exit(main())
