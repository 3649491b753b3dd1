"""``seacrane extremes``: the stability atlas, and whether what must always hold does."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from seacrane.cli.output_folder import output_folder
from seacrane.cli.tables import text_table

if TYPE_CHECKING:
    from stability_atlas import Atlas

BROKEN = 1


def run(arguments: argparse.Namespace) -> int:
    """Run the atlas, save its tables and figures, and print what was found; 1 where a promise is broken."""
    folder = output_folder(arguments.out)
    from stability_atlas import stability_atlas

    atlas = stability_atlas(out=folder, quick=arguments.quick, axes=arguments.axes)
    print(summary(atlas))
    print(f"saved {folder / 'extremes.csv'} and extremes_<axis>.png")
    for text in atlas.broken:
        print(f"seacrane extremes: broken promise: {text}", file=sys.stderr)
    return BROKEN if atlas.broken else 0


def summary(atlas: Atlas) -> str:
    """How the runs of each axis ended, and how well the predicted step limits hold."""
    verdicts = list(dict.fromkeys(row.verdict for row in atlas.rows))
    table = []
    for axis in dict.fromkeys(row.axis for row in atlas.rows):
        own = [row for row in atlas.rows if row.axis == axis]
        counts = [str(sum(row.verdict == verdict for row in own)) for verdict in verdicts]
        errors = [row.error for row in own if row.error == row.error]
        worst = f"{max(errors):.2g}" if errors else ""
        table.append([axis, *counts, worst])
    lines = [text_table(["axis", *verdicts, "largest error of a completed run"], table)] if table else []
    known = [row for row in atlas.step_limits if row.predicted == row.predicted]
    if known:
        ratios = [row.found / row.predicted for row in known]
        lines.append(
            f"{len(known)} longest stable steps: found over predicted {min(ratios):.3f} to {max(ratios):.3f}"
        )
    return "\n".join(lines)
