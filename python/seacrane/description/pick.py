"""Which curves of a result are meant: a channel, names along its dimensions, from when on; as a short text.

    hook_load
    vessel_motion[roll]                roll
    position[load, z]                  position[body=load, axis=z]
    hook_load[main, after=60]
    hook_load[main, stage=lift]

A name without its dimension goes to the one that holds it: x, y, z and the six motions to their own, others
to those that the scene names, in their order. A motion by itself is that of the vessel.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from itertools import product
from typing import Any

from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, FIXED, MOTIONS
from seacrane.errors import SceneError
from seacrane.inputs.checked import text_of
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown

WHOLE = re.compile(r"\s*([^\[\]]*?)\s*(?:\[(.*)\])?\s*", re.DOTALL)
ITEM = re.compile(r"""\s*(?:(\w+)\s*=\s*)?("[^"]*"|'[^']*'|[^,"']*?)\s*(?:,|$)""")


@dataclass(frozen=True, kw_only=True)
class Pick:
    """Curves of a channel."""

    channel: str
    names: Mapping[str, str] = field(default_factory=dict)  # by dimension; others are kept
    after: float | None = None  # s: earlier outputs are left out; None: nothing is said of it
    stage: str | None = None  # the outputs of this one alone

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", ReadOnly(self.names))

    @property
    def parts(self) -> str:
        """The words that leave outputs out, such as "after"; none: it is of all of them."""
        given = {"after": self.after, "stage": self.stage}
        return " and ".join(word for word, value in given.items() if value is not None)

    def curves(
        self, values: Array, dims: Sequence[str], coords: Mapping[str, Sequence[str]]
    ) -> Iterator[tuple[dict[str, str], Array]]:
        """Each curve (n,) that it picks of the values (n, ...) of its channel, with names by dimension."""
        every = [[self.names[dim]] if dim in self.names else coords[dim] for dim in dims[1:]]
        for one in product(*every):
            names = dict(zip(dims[1:], one, strict=True))
            at: tuple[slice | int, ...] = (slice(None), *(coords[dim].index(n) for dim, n in names.items()))
            yield names, values[at]

    def __str__(self) -> str:
        words = [f"{dim}={name}" for dim, name in self.names.items()]
        words += [] if self.after is None else [f"after={self.after:g}"]
        words += [] if self.stage is None else [f"stage={self.stage}"]
        return f"{self.channel}[{', '.join(words)}]" if words else self.channel


def pick_of(
    what: str, channel: str | Pick, names: Mapping[str, str] | None = None, *,
    held: Collection[str] | None = None,
) -> Pick:  # fmt: skip
    """A selector as a value, from its text or from a channel with names along its dimensions beside those in
    the text; `held` are the channels of a result, of which it must be one.

    Raises SceneError for a text that is none, a channel that does not exist, a dimension that it has not, or
    a name that none of its dimensions holds.
    """
    if isinstance(channel, Pick):
        text, items = channel.channel, list(channel.names.items())
        parts: dict[str, Any] = {"after": channel.after, "stage": channel.stage}
    else:
        text, items, parts = _read(what, channel)
    if text in MOTIONS and not items and "body" not in (names or {}):  # yaw is a channel of bodies too
        text, items = "vessel_motion", [("motion", text)]
    if held is not None and text not in held:
        raise SceneError(f"channel {shown(text)} is not in this result; it holds {', '.join(held)}")
    if text not in CHANNELS:
        near = get_close_matches(text, [*CHANNELS, *MOTIONS], n=1)
        raise SceneError(
            f"{what}: channel {shown(text)} does not exist; "
            + (f"did you mean {near[0]!r}?" if near else "docs/channels.md lists them")
        )
    return Pick(channel=text, names=_by_dimension(what, text, [*items, *(names or {}).items()]), **parts)


def _read(what: str, text: str) -> tuple[str, list[tuple[str, str]], dict[str, Any]]:
    """Channel, (dimension or nothing, name), and `after` and `stage` of a text."""
    found = WHOLE.fullmatch(text_of(what, text))
    if not found:
        raise SceneError.of(what, f"is {shown(text)}; give a channel, such as 'position[load, z]'")
    channel, inner = found.groups()
    items: list[tuple[str, str]] = []
    parts: dict[str, Any] = {"after": None, "stage": None}
    at = 0
    while inner and at < len(inner):
        item = ITEM.match(inner, at)
        if not item or not item[2]:
            raise SceneError.of(
                f"{what}", f"is {shown(text)}; give names with commas between, such as 'load, z'"
            )
        at = item.end()
        key, value = item[1] or "", item[2].strip("\"'")
        if key not in parts:
            items.append((key, value))
        elif parts[key] is not None:
            raise SceneError.of(what, f"is {shown(text)}; give {key} once")
        else:
            parts[key] = value if key == "stage" else _time(what, value)
    return channel, items, parts


def _time(what: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise SceneError.of(f"{what}: after", f"is {shown(text)}; give a time in s") from None


def _by_dimension(what: str, channel: str, items: Sequence[tuple[str, str]]) -> dict[str, str]:
    dims = CHANNELS[channel].dims_of_several[1:]
    found: dict[str, str] = {}
    for key, name in sorted(items, key=lambda item: not item[0]):  # those that say their dimension first
        free = [dim for dim in dims if dim not in found]
        fixed = [dim for dim in free if dim in FIXED and name in FIXED[dim]]
        dim = key or next(iter([*fixed, *(dim for dim in free if dim not in FIXED)]), "")
        if dim not in dims:
            has = ", ".join(dims) or "none but time"
            asked = f"dimension {key!r}" if key else f"{shown(name)}"
            raise SceneError.of(f"{what}: {channel}", f"has no {asked}; its dimensions are {has}")
        if dim in found:
            raise SceneError.of(f"{what}: {channel}", f"is given two names along {dim}; give one")
        if dim in FIXED and name not in FIXED[dim]:
            raise SceneError.of(f"{what}: {dim}", f"is {shown(name)}; choose from {', '.join(FIXED[dim])}")
        found[dim] = text_of(f"{what}: {dim}", name)
    return {dim: found[dim] for dim in dims if dim in found}


def column_name(channel: str, names: Sequence[str]) -> str:
    """The text that picks one curve, by its names in the order of its dimensions."""
    quoted = [name if re.fullmatch(r"[^,=\"'\[\]]+", name) else f'"{name}"' for name in names]
    return f"{channel}[{', '.join(quoted)}]" if quoted else channel
