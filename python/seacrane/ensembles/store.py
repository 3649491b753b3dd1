"""Where outcomes are kept as they come: in memory, or a file for each pack in a folder."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from seacrane.ensembles.dataset import table_of
from seacrane.ensembles.members import Members
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.pack_file import read_pack, write_pack

if TYPE_CHECKING:
    import xarray


class Store(Protocol):
    """Keeps the outcomes of packs by their number."""

    def done(self) -> set[int]:
        """Numbers of the packs that are there."""

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        """Take a pack."""

    def of(self, pack: int) -> list[Outcome]:
        """Of one pack that is there."""

    def outcomes(self) -> Iterator[Outcome]:
        """Of all packs that are there, in order."""

    def dataset(self, members: Members) -> xarray.Dataset:
        """All that is there, over these members."""


class Memory:
    """A store for as long as the process lives."""

    def __init__(self) -> None:
        self._packs: dict[int, list[Outcome]] = {}

    def done(self) -> set[int]:
        return set(self._packs)

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
        return {int(path.stem.removeprefix("pack_")) for path in self.path.glob("pack_*.nc")}

    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        write_pack(self._file(pack), outcomes)

    def of(self, pack: int) -> list[Outcome]:
        return read_pack(self._file(pack))

    def outcomes(self) -> Iterator[Outcome]:
        for pack in sorted(self.done()):
            yield from read_pack(self._file(pack))

    def dataset(self, members: Members) -> xarray.Dataset:
        return table_of(members, self.outcomes()).dataset()

    def _file(self, pack: int) -> Path:
        return self.path / f"pack_{pack:07d}.nc"
