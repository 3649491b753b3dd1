"""The pictures of docs/conventions.md: ``python tools/conventions [--out FOLDER]``."""

from __future__ import annotations

import argparse
from pathlib import Path

from crane_angles import crane_figure
from frames import frames_figure
from motions import motions_figure
from waves import waves_figure

FIGURES = {
    "frames": frames_figure,
    "motions": motions_figure,
    "waves": waves_figure,
    "crane": crane_figure,
}


def main() -> None:
    """Draw all of them into a folder."""
    root = Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=root / "docs" / "figures")
    folder = parser.parse_args().out
    for name, draw in FIGURES.items():
        draw().savefig(folder / f"conventions_{name}.png", dpi=110, bbox_inches="tight")


if __name__ == "__main__":
    main()
