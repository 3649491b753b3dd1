"""The keys of the [study] of a lift file; from the signatures that they call."""

from __future__ import annotations

from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import LatinHypercube
from seacrane.lift.keys import Key, keys_of

LIFTS = ("case1", "case2", "case3", "vessel")  # lifts that come with the package, by their names
TIME = {"unit": "s"}
KEEP = (
    Key(name="name", type="text", required=True, text="What it is called in tables, and in until."),
    *keys_of(Kept, more={"names": {"type": "names"}, "after": TIME, "interval": TIME}),
)
RANGE = (
    Key(name="first", type="number", required=True, text="The first value."),
    Key(name="last", type="number", text="The last one; by default values go on by ones."),
    Key(name="count", type="whole", required=True, bounds={"minimum": 1}, text="How many, evenly spaced."),
)
DESIGN = keys_of(LatinHypercube, more={"ranges": {"type": "ranges"}})
STUDY = (
    Key(
        name="lift", type="file", choices=LIFTS,
        text="Path of a lift file, or a lift that comes with seacrane, whose tables stand where this file "
        "has none of the name; of [run] its keys.",
    ),
    Key(
        name="over", type="values",
        text="Values by parameter, of which all combinations are run: lists, or first, last and count.",
    ),
    Key(
        name="design", type="table", keys=DESIGN,
        text="So many members spread evenly over the ranges of all parameters, in place of over.",
    ),
    Key(name="keep", type="tables", keys=KEEP, required=True, text="What each run leaves."),
    Key(
        name="until", type="limits",
        text="Half widths of 95 % intervals as shares of the dynamic part; seeds are added until then.",
    ),
    Key(
        name="exposure", type="number", unit="s", bounds={"exclusiveMinimum": 0},
        text="Of the largest values; default: that of a run.",
    ),
)  # fmt: skip
