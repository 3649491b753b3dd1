"""Names and units in the header of a measured series: "roll [deg]", "heave_m", "Time (s)"."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import pi
from types import MappingProxyType

from seacrane.description.dimensions import UNITS, unit_text

G = 9.80665  # m/s2, standard: tonnes and kilograms of a load are its weight
TIMES = frozenset(
    ["time", "t", "timestamp", "time stamp", "datetime", "date time", "date/time", "utc", "utc time",
     "gps time", "elapsed time", "clock", "seconds"]
)  # fmt: skip
LONGEST = 200  # characters of a cell of a header
IN_BRACKETS = re.compile(r"([^\[\]()]*)[\[(]([^\[\]()]*)[\])]\s*")
_WORDS = {
    "°": "deg", "degree": "deg", "degrees": "deg", "radian": "rad", "radians": "rad", "metre": "m",
    "metres": "m", "meter": "m", "meters": "m", "sec": "s", "second": "s", "seconds": "s", "-": "1", "%": "%",
    "KN": "kN", "kNm": "kN m", "Nm": "N m", "MNm": "MN m", "te": "t", "tf": "t", "kgf": "kg", "tonnes": "t",
    "°/s": "deg/s", "rpm": "rpm",
}  # fmt: skip
SPELLED: Mapping[str, tuple[float, str]] = MappingProxyType(
    {  # factor to SI, and the SI unit
        **{text: (factor, unit_text(dimension)) for text, (factor, dimension) in UNITS.items()},
        "t": (1e3 * G, "N"), "kg": (G, "N"), "MN": (1e6, "N"), "MN m": (1e6, "N m"), "%": (0.01, "1"),
        "cm": (0.01, "m"), "km": (1e3, "m"), "ft": (0.3048, "m"), "mm/s": (1e-3, "m/s"),
        "cm/s": (0.01, "m/s"), "g": (G, "m/s2"), "mrad": (1e-3, "rad"), "deg/s2": (pi / 180.0, "rad/s2"),
        "rpm": (pi / 30.0, "rad/s"), "ms": (1e-3, "s"), "us": (1e-6, "s"), "min": (60.0, "s"),
        "h": (3600.0, "s"), "kPa": (1e3, "Pa"), "MPa": (1e6, "Pa"), "kW": (1e3, "W"), "MW": (1e6, "W"),
    }
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Heading:
    """A cell of a header: its place in the line, its text, its name in plain words, its unit as written."""

    place: int
    text: str
    name: str
    unit: str | None

    @property
    def is_time(self) -> bool:
        return self.name in TIMES


def unit_of_words(words: str) -> tuple[float, str] | None:
    """Factor to SI and the SI unit of a unit as loggers write it; None where it is unknown.

    Small and capital letters are told apart where it matters: mN is no MN.
    """
    text = words.strip().strip("[]()").strip()
    text = re.sub(r"_per_", "/", text).replace("²", "2").replace("³", "3").replace("^", "").replace("**", "")
    text = re.sub(r"\s*[·*]\s*", " ", text).replace("°/", "deg/")
    for one in (text, text.lower()):
        found = SPELLED.get(_WORDS.get(one, one))
        if found:
            return found
    return None


def heading_of(place: int, cell: str) -> Heading:
    """A cell of a header taken apart: unit in brackets at its end, or after its last underscore."""
    text = cell.strip().strip("\"'").strip()
    name, unit = text, None
    found = IN_BRACKETS.fullmatch(text)
    if found and found[1].strip():
        name, unit = found[1], found[2]
    elif not found:
        words = text.split("_")
        for count in (3, 1):  # rad_per_s, deg
            tail = "_".join(words[-count:])
            if len(words) > count and not tail.isdecimal() and unit_of_words(tail):
                name, unit = "_".join(words[:-count]), tail
                break
    return Heading(place=place, text=text, name=plain_words(name), unit=unit)


def plain_words(name: str) -> str:
    """A name in small letters, with one space between its words."""
    return " ".join(re.split(r"[\s_]+", name.strip(" _\t\"'").lower()))


def is_line_of_units(cells: Sequence[str]) -> bool:
    """Whether a line below a header holds the units of the columns, and no numbers."""
    texts = [cell.strip().strip("\"'") for cell in cells]
    return any(not _is_number(text) and text for text in texts) and all(
        not text or unit_of_words(text) for text in texts
    )


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
