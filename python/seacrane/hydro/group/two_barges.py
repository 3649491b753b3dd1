"""`two_barges`: a crane vessel and a feeder side by side, which come with the package."""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from pathlib import Path

from seacrane.errors import SceneError
from seacrane.hydro.group.group import HydroGroup

FILES: dict[float | None, str] = {None: "alone", 0.01: "lid_0.01", 0.03: "lid_0.03"}


@cache
def two_barges(*, lid_damping: float | None) -> HydroGroup:
    """Two box barges that come with the package, memory included; read once, immutable.

    "crane vessel" is 100 x 25 x 5.5 m (length, breadth, draught), "feeder" 60 x 18 x 3.5 m, abreast to port
    of it with a gap of 5 m, in deep water. `tools/two_barges.py` computes them with Capytaine.

    Parameters
    ----------
    lid_damping : of the lid on the water in the gap, 0.01 or 0.03 (`HydroGroup.with_lid_damping`): compare
        both, as no theory tells it. None: each hull as if alone, without interaction.

    Raises
    ------
    SceneError : another damping.
    """
    if lid_damping not in FILES:
        raise SceneError(
            f"two barges: lid_damping is {lid_damping!r}; those that come with the package are 0.01 and "
            "0.03, and None for hulls without interaction"
        )
    return HydroGroup.load(
        Path(str(files("seacrane") / "data" / "two_barges" / f"{FILES[lid_damping]}.hydro"))
    )
