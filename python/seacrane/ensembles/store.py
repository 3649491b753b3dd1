"""Where outcomes are kept as they come: in memory, or a file for each pack in a folder."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from seacrane.ensembles.dataset import table_of
from seacrane.ensembles.members import MOST_MEMBERS, Members
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.pack_file import read_pack, write_pack
from seacrane.errors import FileFormatError
from seacrane.inputs.caller import warn_caller
from seacrane.run.interrupts import interrupts_kept
from seacrane.warnings import LostMembersWarning

if TYPE_CHECKING:
    import xarray

DIGITS = 7  # of a pack's number in the name of its file


class Store(Protocol):
    """Keeps the outcomes of packs by their number."""

    def done(self) -> set[int]:
        """Numbers of the packs that are there."""

    def lost(self, pack: int, indices: Sequence[int]) -> str:
        """Why a pack of these members, which is there, cannot be read; nothing where it can."""

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        """Take a pack."""

    def of(self, pack: int) -> list[Outcome]:
        """The outcomes of one pack that is there."""

    def outcomes(self) -> Iterator[Outcome]:
        """The outcomes of all packs that are there, in order."""

    def dataset(self, members: Members) -> xarray.Dataset:
        """All that is there, over these members."""


class Memory:
    """A store for as long as the process lives."""

    def __init__(self) -> None:
        self._packs: dict[int, list[Outcome]] = {}

    def done(self) -> set[int]:
        return set(self._packs)

    def lost(self, pack: int, indices: Sequence[int]) -> str:
        return ""

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        self._packs[pack] = outcomes

    def of(self, pack: int) -> list[Outcome]:
        return self._packs[pack]

    def outcomes(self) -> Iterator[Outcome]:
        for pack in sorted(self._packs):
            yield from self._packs[pack]

    def dataset(self, members: Members) -> xarray.Dataset:
        return table_of(members, self.outcomes()).dataset()


class Folder:
    """A NetCDF file for each pack; one process writes."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def done(self) -> set[int]:
        names = (path.stem.removeprefix("pack_") for path in self.path.glob("pack_*.nc"))
        found = {int(name) for name in names if name.isdecimal() and len(name) == DIGITS}
        if found and max(found) >= MOST_MEMBERS:
            raise FileFormatError(
                f"{self.path}: has a pack {max(found)}, more than there may be members; remove it"
            )
        return found

    def lost(self, pack: int, indices: Sequence[int]) -> str:
        try:
            found = [one.index for one in self.of(pack)]
        except (FileFormatError, OSError) as error:
            return str(error)
        return "" if found == list(indices) else f"{self._file(pack)}: holds other members"

    @interrupts_kept()
    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        write_pack(self._file(pack), outcomes)

    @interrupts_kept()
    def of(self, pack: int) -> list[Outcome]:
        return read_pack(self._file(pack))

    def outcomes(self) -> Iterator[Outcome]:
        for pack in sorted(self.done()):
            yield from read_pack(self._file(pack))

    def dataset(self, members: Members) -> xarray.Dataset:
        return table_of(members, self.outcomes()).dataset()

    def _file(self, pack: int) -> Path:
        return self.path / f"pack_{pack:0{DIGITS}d}.nc"


def kept_packs(store: Store, packs: Mapping[int, Sequence[int]]) -> set[int]:
    """Packs that need not be run, by their members.

    Warns
    -----
    LostMembersWarning
        For those that are there and cannot be read.
    """
    there = store.done() & packs.keys()
    lost = {number: why for number in sorted(there) if (why := store.lost(number, packs[number]))}
    if lost:
        first = next(iter(lost))
        others = f"; so are those of {len(lost) - 1} other packs" if len(lost) > 1 else ""
        warn_caller(
            f"store: members {_shown(packs[first])} are lost or damaged, and are run again: "
            f"{lost[first]}{others}",
            LostMembersWarning,
        )
    return there - lost.keys()


def _shown(indices: Sequence[int]) -> str:
    first, last = indices[0], indices[-1]
    if list(indices) == list(range(first, last + 1)):
        return f"{first} to {last}"
    return ", ".join(map(str, indices))
