"""The tables and the picture of docs/trade.md, from a trade of case 2 in a folder:

seacrane trade case2 --budget inf --out out/trade && python benchmarks/trade_tables.py out/trade
"""

from __future__ import annotations

import csv
import sys
from pathlib import Path

import documents
import numpy as np
from measure.section import significant
from measure.table import write

from seacrane import cases, trade

RESULTS = Path(__file__).resolve().parent / "results"
FIGURE = RESULTS.parents[1] / "docs" / "figures" / "trade_case2.png"
SETTINGS = (
    ("bs32", "rtol=0.001"),
    ("tsit5", "rtol=0.01"),
    ("dopri5", "rtol=0.01"),
    ("tsit5", "rtol=0.0001"),
    ("verner76", "rtol=0.001"),
    ("verner65", "rtol=1e-05"),
    ("verner76", "rtol=1e-05"),
    ("verner65", "rtol=1e-07"),
    ("verner76", "rtol=1e-09"),
)
WORDS = {
    ("none", "table", "full"): "no memory",
    ("convolution", "table", "full"): "memory by convolution",
    ("per-pair", "exact", "full"): "waves summed exactly (the setting's own error)",
    ("per-pair", "table", "crane locked"): "crane locked",
    ("per-pair", "table", "vessel prescribed"): "vessel prescribed, one-way",
    ("per-pair", "table", "payload as weight"): "payload as a constant weight",
    ("per-pair", "table", "frequency domain"): "frequency domain at the start pose",
}
QUANTITIES = ("payload_position", "roll", "hook_load", "cylinder_force")
SMALL = {"payload, m": 1.0, "roll, rad": 1.0, "hook tension, N": 1.0, "cylinder force, N": 1.0}
LARGE = {
    "payload, m": 1.0,
    "roll, deg": np.degrees(1.0),
    "hook tension, kN": 1e-3,
    "cylinder force, kN": 1e-3,
}


def tables(rows: list[dict[str, str]]) -> None:
    """Write what settings cost on the full scene, and what less physics loses."""
    full = {(row["integrator"], row["setting"]): row for row in rows if _is_full(row)}
    cost = [
        [f"`{name}`, {setting.split('=')[1]}", row["evaluations"], *_errors(row, SMALL)]
        for name, setting in SETTINGS
        for row in (full[name, setting],)
    ]
    write(RESULTS / "trade-of-case-2-settings.csv", ["setting", "evaluations", *SMALL], cost)
    less = [row for row in rows if row not in list(full.values()) and row["formulation"] != "redundant"]
    less += [row for row in rows if row["rung"] in ("crane locked", "vessel prescribed")]
    write(
        RESULTS / "trade-of-case-2-physics.csv",
        ["changed", *LARGE],
        [[_words(row), *_errors(row, LARGE)] for row in less],
    )


def _is_full(row: dict[str, str]) -> bool:
    return row["formulation"] == "recursive" and (row["memory"], row["waves"], row["rung"]) == (
        "per-pair",
        "table",
        "full",
    )


def _words(row: dict[str, str]) -> str:
    key = (row["memory"], row["waves"], row["rung"])
    if key in WORDS:
        return WORDS[key]
    if ":" in row["memory"]:
        kind, states = row["memory"].split(":")
        return f"memory {kind.replace('-', ' ')}, {states} states"
    return row["waves"].replace("table", "wave table").replace("of 200", "strongest of 200")


def _errors(row: dict[str, str], units: dict[str, float]) -> list[str]:
    values = zip((row[f"error_{quantity}"] for quantity in QUANTITIES), units.values(), strict=True)
    return [
        significant(float(value) * scale, 2) if value and value != "nan" else "" for value, scale in values
    ]


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    with (folder / "trade.csv").open(newline="", encoding="utf-8") as file:
        tables(list(csv.DictReader(file)))
    measured = trade(cases.case2(), budget=None, out=folder)  # takes the rows that the folder holds
    measured.plot(over="cpu_s").savefig(FIGURE, dpi=110)
    documents.fill()
