"""The tables of a study file and their keys; from the signatures that they call."""

from __future__ import annotations

from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import LatinHypercube
from seacrane.lift.document import FileKind
from seacrane.lift.keys import Key, keys_of

STUDY = FileKind("study", "seacrane study", "docs/studies.md")
TIME = {"unit": "s"}
FROM_LIFTS = ("run", "method", "outputs")  # tables that a study may have in place of its lift's
KEEP = (
    Key(name="name", type="text", required=True, text="What it is called in tables, and in until."),
    *keys_of(Kept, more={"names": {"type": "names"}, "after": TIME, "interval": TIME}),
)
RANGE = (
    Key(name="first", type="number", required=True, text="The first value."),
    Key(name="last", type="number", text="The last one; by default values go on by ones."),
    Key(name="count", type="whole", required=True, text="How many, evenly spaced."),
)
DESIGN = keys_of(LatinHypercube, only=("count", "seed"))
STATISTICS = (
    Key(name="exposure", type="number", unit="s", text="Of the largest values; default: that of a run."),
)
TEXTS = {
    "format": "What the file is.",
    "lift": "Path of a lift file, a lift that comes with seacrane, or the tables of a lift.",
    "over": "Values by parameter, of which all combinations are run: lists, or first, last and count.",
    "design": "So many members spread evenly over the ranges of all parameters, in place of over.",
    "keep": "What each run leaves.",
    "accuracy": "Largest errors by quantity; integrator and tolerance are chosen for all members by them.",
    "until": "Half widths of 95 % intervals as shares of the dynamic part; seeds are added until then.",
    "statistics": "How results are told.",
}
