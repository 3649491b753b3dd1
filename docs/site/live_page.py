"""The page of docs/live.md: case 2 in three dimensions, made by the package as a user would make it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from seacrane import cases, simulate, view

DOCUMENT = "docs/live"
PAGE = "docs/case2.html"  # beside the document, which shows it in a frame
SHOWN = 60.0  # s


def write(app: Any, failed: Exception | None) -> None:
    """Save the page into the site, where the site holds the document."""
    if failed is None and DOCUMENT in app.env.found_docs:
        scene = cases.case2(hs=1.5, wave_direction_deg=180.0)
        view(simulate(scene, t_end=SHOWN)).save(Path(app.outdir) / PAGE)
