"""Two records of a case: the same bits, or by how much they differ, and what of that was expected."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

Record = Mapping[str, Any]
HERE = Path(__file__).parent
WHATS = ("values", "shape", "unit", "dims", "axes", "settings", "missing", "new")
NUMBERS = ("first", "last", "least", "largest")
# Least sizes by unit or channel, as of tolerances: what is zero but for rounding has no size of its own.
# Nor is a channel smaller than a share of the largest of its unit in the run.
LEAST = {
    "m": 0.1, "m/s": 0.1, "m/s2": 0.1, "rad": 0.01, "rad/s": 0.01, "rad/s2": 0.01, "N": 1.0, "N m": 1.0,
    "J": 1.0, "W": 1.0, "coordinate": 0.01, "coordinate_rate": 0.01, "constraint_error": 1.0,
    "constraint_rate_error": 1.0, "constraint_error_before_projection": 1.0,
}  # fmt: skip
SHARE = 1e-3


@dataclass(frozen=True)
class Change:
    """What is expected to differ: patterns of names, of what kind, how much at most, and why."""

    scenes: str
    channels: str
    reason: str
    bound: float = 0.0
    what: str = "values"

    def __post_init__(self) -> None:
        if self.what not in WHATS or not self.reason.strip() or self.bound < 0.0:
            raise ValueError(f"changed.toml: {self}: give one of {', '.join(WHATS)}, a bound and a reason")


@dataclass(frozen=True)
class Renamed:
    """New names by the old ones, of channels and of axes; changes with a reason."""

    channels: Mapping[str, str] = field(default_factory=dict)
    axes: Mapping[str, str] = field(default_factory=dict)
    labels: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def read(cls, path: Path = HERE / "renamed.toml") -> Renamed:
        """Raises ValueError for a name without its meaning."""
        tables = tomllib.loads(path.read_text(encoding="utf-8"))
        for row in (row for rows in tables.values() for row in rows):
            if row.keys() != {"old", "new", "meaning"}:
                raise ValueError(f"{path.name}: {row}: give old, new and meaning")
        return cls(**{name: {row["old"]: row["new"] for row in rows} for name, rows in tables.items()})


def changes(path: Path = HERE / "changed.toml") -> list[Change]:
    return [Change(**row) for row in tomllib.loads(path.read_text(encoding="utf-8")).get("change", [])]


@dataclass(frozen=True)
class Difference:
    """One thing that differs; `size` is relative, and infinite where no number tells it."""

    run: str
    channel: str
    what: str
    size: float
    text: str = ""

    def __str__(self) -> str:
        told = f"{self.size:.1e}" if self.what == "values" else self.text
        return f"{told} in {self.channel} ({self.run})"

    def expected(self, scene: str, allowed: Sequence[Change]) -> Change | None:
        return next((change for change in allowed if self._meets(scene, change)), None)

    def _meets(self, scene: str, change: Change) -> bool:
        named = fnmatchcase(scene, change.scenes) and fnmatchcase(self.channel, change.channels)
        return named and self.what == change.what and (self.what != "values" or self.size <= change.bound)


def differences(old: Record, new: Record, renamed: Renamed) -> list[Difference]:
    """Of a case, in all of its runs; a channel whose bits alone differ has the size 0."""
    found = []
    for run in sorted(old["runs"].keys() | new["runs"].keys()):
        if run not in old["runs"] or run not in new["runs"]:
            what = "missing" if run in old["runs"] else "new"
            found.append(Difference(run, "all channels", what, math.inf, f"the run is {what}"))
        else:
            found += _of_run(run, old["runs"][run], new["runs"][run], renamed)
    return sorted(found, key=lambda one: -one.size)


def _of_run(run: str, old: Record, new: Record, renamed: Renamed) -> Iterator[Difference]:
    if old["settings"] != new["settings"]:
        yield Difference(run, "settings", "settings", math.inf, f"{old['settings']} -> {new['settings']}")
    axes = {
        renamed.axes.get(dim, dim): [renamed.labels.get(label, label) for label in labels]
        for dim, labels in old["axes"].items()
    }
    before = {renamed.channels.get(name, name): channel for name, channel in old["channels"].items()}
    for dim in sorted(axes.keys() & new["axes"].keys()):
        if axes[dim] != new["axes"][dim]:
            yield Difference(run, f"axis {dim}", "axes", math.inf, f"{axes[dim]} -> {new['axes'][dim]}")
    for name in sorted(before.keys() | new["channels"].keys()):
        if name not in before or name not in new["channels"]:
            what = "missing" if name in before else "new"
            yield Difference(run, name, what, math.inf if what == "missing" else -1.0, what)
            continue
        one, other = before[name], new["channels"][name]
        dims = [renamed.axes.get(dim, dim) for dim in one["dims"]]
        for what, was, now in (
            ("unit", one["unit"], other["unit"]), ("dims", dims, other["dims"]),
            ("shape", (one["shape"], one.get("not_finite")), (other["shape"], other.get("not_finite"))),
        ):  # fmt: skip
            if was != now:
                yield Difference(run, name, what, math.inf, f"{what} {was} -> {now}")
        if one["sha256"] != other["sha256"] and one["shape"] == other["shape"]:
            yield Difference(run, name, "values", relative(one, other, _size(name, before)))


def _largest(channel: Record) -> float:
    ends = [abs(float.fromhex(channel[key])) for key in ("least", "largest") if key in channel]
    return max(filter(math.isfinite, ends), default=0.0)


def _size(name: str, channels: Mapping[str, Record]) -> float:
    """What differences of a channel are divided by: its largest absolute value, or a least one."""
    unit = channels[name]["unit"]
    alike = max(_largest(one) for one in channels.values() if one["unit"] == unit)
    share = 1.0 if name == "energy_balance" else SHARE  # what is left over of all energies
    return max(_largest(channels[name]), share * alike, LEAST.get(unit, 0.0), LEAST.get(name, 0.0))


def relative(one: Record, other: Record, size: float) -> float:
    """Largest difference of the recorded numbers over a size; of the weighted sums that of their means."""
    count = math.prod(one["shape"])
    pairs = [(float.fromhex(one[key]), float.fromhex(other[key]), 1.0) for key in NUMBERS if key in one]
    sums = zip(one["sums"], other["sums"], strict=True)
    pairs += [(float.fromhex(a), float.fromhex(b), 0.5 * count) for a, b in sums]
    return max(_apart(a, b, weight * size) for a, b, weight in pairs)


def _apart(a: float, b: float, size: float) -> float:
    if a == b or (math.isnan(a) and math.isnan(b)):
        return 0.0
    if not (math.isfinite(a) and math.isfinite(b)):
        return math.inf
    return abs(a - b) / size if size > 0.0 else math.inf
