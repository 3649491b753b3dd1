"""Parts of an ensemble, run by themselves: whole packs, so that each member has the same beside it.

Packs are numbered by the study alone. Part i of n has each n-th pack from the i-th on: packs lie by what they
cost, and so the parts cost about the same. Of a study that grows it has all packs of each n-th cell: whether
one takes more is known by that cell alone.
"""

from __future__ import annotations

import hashlib
import platform
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.run.lanes import INSTRUCTIONS
from seacrane.version import __version__

PART, ENGINE = "part", "engine"  # of an identity
KNOWN = "known"  # in which sense all cells of a part that grows are, once they are


@dataclass(frozen=True, kw_only=True)
class Part:
    """One of so many parts, from 1 on."""

    number: int
    of: int

    def __str__(self) -> str:
        return f"{self.number}/{self.of}"

    def numbers(self, count: int, what: str = "packs of members") -> range:
        """The numbers of its packs, or of its cells. Raises SceneError where there are fewer than parts."""
        if self.of > count:
            raise SceneError(
                f"part {self}: the study has {count} {what}, and a part has one at least; take at most "
                f"{count} parts, or a smaller pack"
            )
        return range(self.number - 1, count, self.of)

    def identity(self) -> dict[str, str]:
        """What tells its store from that of another part, or one that is run by another engine."""
        return {PART: str(self), ENGINE: engine()}


def part_of(given: Any) -> Part:
    """The part of (3, 40) or "3/40"; raises SceneError for another one."""
    found = re.fullmatch(r"(\d{1,7})/(\d{1,7})", given) if isinstance(given, str) else None
    pair = given if found is None else tuple(map(int, found.groups()))
    if not (isinstance(pair, tuple) and len(pair) == 2 and all(type(one) is int for one in pair)):
        raise SceneError(
            f"part is {shown(given)}; give one of how many, as (3, 40), or 3/40 on a command line"
        )
    part = Part(number=pair[0], of=pair[1])
    if not 1 <= part.number <= part.of:
        raise SceneError(f"part is {part}; give one from 1/{part.of} to {part.of}/{part.of}")
    return part


@lru_cache(maxsize=1)
def engine() -> str:
    """What the bits of a run depend on beside its study: the compiled core, libraries and the processor."""
    here = Path(_core.__file__).parent
    files = sorted(one for one in here.glob("_*") if one.suffix in (".so", ".pyd"))
    core = hashlib.sha256(b"".join(one.read_bytes() for one in files)).hexdigest()[:12]
    has = "+".join(name for name in INSTRUCTIONS.values() if _core.has_instructions(name)) or "no lanes"
    system = f"{platform.machine()} with {has}, {' '.join(platform.libc_ver())}"
    return f"seacrane {__version__}, core {core}, NumPy {np.__version__}, {system}"
