"""Files of real ships: motions solved with what was read, against the motions that the files hold."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path

from seacrane import load_database
from seacrane.hydro import HydroDatabase

from .row import Row

FILES = {
    "a supply vessel's VERES files": ("veres/supply", "hydro/test_hydro_veres.py"),
    "a tanker's WAMIT files": ("wamit", "hydro/test_hydro_wamit.py"),
}


def closures(shared: Path) -> Iterator[Row]:
    """The worst of the motions that share a bound, within the trusted band, over the largest motion."""
    for name, (folder, test) in FILES.items():
        for limit, motions in _by_limit(_quietly(shared / folder)).items():
            words = "all motions" if len(motions) == 6 else ", ".join(motions)
            yield Row(
                subject="Hydrodynamics", compared=f"{name}: {words} from matrices and forces as read",
                reference="the motions that the files hold", difference=max(motions.values()), unit="",
                limit=limit, test=test,
            )  # fmt: skip


def _quietly(folder: Path) -> HydroDatabase:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return load_database(folder)


def _by_limit(database: HydroDatabase) -> dict[float, dict[str, float]]:
    """Motions and their differences by the bound that the source of the files states."""
    found: dict[float, dict[str, float]] = {}
    for row in database.check():
        if row.check.startswith("motion_rao_") and row.limit is not None:
            found.setdefault(row.limit, {})[row.check.removeprefix("motion_rao_")] = row.value
    return found
