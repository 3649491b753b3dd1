"""Bulk parameters of Sofar's Spotter buoys, as SD cards have them; the dashboard's CSV has units itself.

Layouts: https://github.com/sofarocean/spotter-sd-parser; of the dashboard
https://www.glerl.noaa.gov/res/recon/data/bystation/mich-mkg/2021/sensor_format/spotter/. Times are UTC.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from seacrane.sea.records.kind import SEA_STATES, Columns, Kind, has, place_of

BULK = re.compile(
    r"^\s*#?\s*year\s*,\s*month\s*,\s*day\s*,.*significant wave height(?!\s*[\[(])", re.IGNORECASE
)
UNITS = {"height": "m", "period": "s", "direction": "deg", "spreading": "deg", "sec": "UTC"}


def bulk_parameters(lines: Sequence[str], _: float | None) -> Columns:
    """The same columns, with the units that the layout tells."""
    at = place_of(lines, BULK)
    names = [one.strip() for one in lines[at].lstrip(" #").split(",")]
    units = [UNITS.get(one.lower().split()[-1] if one else "") for one in names]
    header = ",".join(f"{one} [{unit}]" if unit else one for one, unit in zip(names, units, strict=True))
    return Columns(header, ["" if i <= at else line for i, line in enumerate(lines)], at + 1)


KINDS = (
    Kind(
        name="Spotter bulk parameters",
        looks="`year, month, day, hour, min, sec, milisec, Significant Wave Height, ...`",
        layout="https://github.com/sofarocean/spotter-sd-parser",
        reader=SEA_STATES, is_it=has(BULK), columns=bulk_parameters,
    ),
)  # fmt: skip
