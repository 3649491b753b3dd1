"""`python -m stability_atlas`: the stability atlas, and whether what must always hold does."""

from __future__ import annotations

import argparse
import re
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path

from seacrane.cli.output import output_folder
from seacrane.plotting.table import table_of
from stability_atlas import Atlas, stability_atlas
from stability_atlas.points import relative_error

BROKEN = 1
DOCUMENT = Path(__file__).with_name("README.md")
PICTURE = re.compile(r"\]\((\S+/(extremes_\w+\.png))\)")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the atlas, save its tables and figures, and print what was found; 1 where a promise is broken."""
    chosen = _parser().parse_args(arguments)
    folder = output_folder(chosen.out)
    atlas = stability_atlas(out=folder, quick=chosen.quick, axes=chosen.axes)
    print(summary(atlas))
    print(f"saved {folder / 'extremes.csv'} and extremes_<axis>.png")
    if chosen.publish:
        publish(folder)
    for text in atlas.broken:
        print(f"stability atlas: broken promise: {text}", file=sys.stderr)
    return BROKEN if atlas.broken else 0


def publish(folder: Path, document: Path = DOCUMENT) -> list[Path]:
    """Put the pictures of a run in the place of those that the document shows; their paths."""
    shown = PICTURE.findall(document.read_text())
    return [Path(shutil.copyfile(folder / name, document.parent / path)) for path, name in shown]


def _parser() -> argparse.ArgumentParser:
    text = "drive every axis of use far beyond it with every method: extremes.csv and heat maps"
    more = f"{text}; a call that was stopped goes on; fails where something breaks that must always hold"
    parser = argparse.ArgumentParser(prog="stability_atlas", description=more)
    parser.add_argument("--out", metavar="DIR", required=True, help="folder to write to; made if absent")
    parser.add_argument(
        "--quick", action="store_true", help="few values and methods, and all that must always hold"
    )
    parser.add_argument(
        "--publish", action="store_true", help="put the pictures of this run into the document"
    )
    parser.add_argument(
        "--axes", metavar="NAME", nargs="+", help="only these axes; an unknown name lists them all"
    )
    return parser


def summary(atlas: Atlas) -> str:
    """How the runs of each axis ended, and how well the predicted step limits hold."""
    verdicts = list(dict.fromkeys(row.verdict for row in atlas.rows))
    table = []
    for axis in dict.fromkeys(str(row.case["axis"]) for row in atlas.rows):
        own = [row for row in atlas.rows if row.case["axis"] == axis]
        counts = [str(sum(row.verdict == verdict for row in own)) for verdict in verdicts]
        told = [relative_error(row) for row in own]
        errors = [error for error in told if error == error]
        worst = f"{max(errors):.2g}" if errors else ""
        table.append([axis, *counts, worst])
    lines = [str(table_of(["axis", *verdicts, "largest error of a completed run"], table))] if table else []
    known = [row for row in atlas.step_limits if row.predicted == row.predicted]
    if known:
        ratios = [row.found / row.predicted for row in known]
        lines.append(
            f"{len(known)} longest stable steps: found over predicted {min(ratios):.3f} to {max(ratios):.3f}"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    sys.exit(main())
