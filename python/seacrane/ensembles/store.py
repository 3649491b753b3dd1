"""Where outcomes are kept as they come: in memory, or in a folder with a NetCDF file for each pack."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from seacrane.ensembles.dataset import TEXTS, table_of
from seacrane.ensembles.members import MOST_MEMBERS, Members
from seacrane.ensembles.outcome import Labelled, Outcome
from seacrane.errors import FileFormatError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.json_text import json_of
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.run.interrupts import interrupts_kept
from seacrane.warnings import LostMembersWarning

if TYPE_CHECKING:
    import xarray

DIGITS = 7  # of a pack's number in the name of its file
LARGEST_FILE = 2**32  # bytes of arrays


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
        for pack in sorted(self.done()):
            yield from self.of(pack)

    def dataset(self, members: Members) -> xarray.Dataset:
        """All that is there, over these members."""
        return table_of(members, self.outcomes()).dataset()


class Memory(Store):
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


class Folder(Store):
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


def write_pack(path: Path, outcomes: list[Outcome]) -> None:
    """Write it: complete under its name, or not at all.

    Members that lie alike share a group: as a rule there is one.

    Raises OSError if it cannot be written; it names the file, the cause and the space left.
    """
    import netCDF4

    with atomic_write(path, tidy=False) as draft:
        try:
            with netCDF4.Dataset(draft, "w") as file:
                file.createDimension("member", len(outcomes))
                file.createVariable("member", "i8", ("member",))[:] = [one.index for one in outcomes]
                for name in TEXTS:
                    texts = np.array([getattr(one, name) for one in outcomes], dtype=object)
                    file.createVariable(name, str, ("member",))[:] = texts
                for number, alike in enumerate(_alike(outcomes)):
                    _write_group(file.createGroup(f"kept_{number}"), alike)
        except RuntimeError as error:  # the HDF5 library's failures to write arrive as RuntimeError
            raise OSError(f"the NetCDF library reports: {error}") from error


def read_pack(path: Path) -> list[Outcome]:
    """The outcomes of a pack. Raises FileFormatError where the file is damaged."""
    try:
        with open_netcdf(path, LARGEST_FILE, "give a smaller pack") as file:
            kept: dict[int, dict[str, Labelled]] = {}
            for group in file.groups.values():
                kept.update(_read_group(group))
            rows = zip(*(file[name][:].tolist() for name in ("member", *TEXTS)), strict=True)
            outcomes = [
                Outcome(index=index, kept=kept.get(index, {}), **dict(zip(TEXTS, texts, strict=True)))
                for index, *texts in rows
            ]
            if any(not one.kept and not one.failure for one in outcomes):
                raise ValueError("it lacks what a member kept")
            return outcomes
    except NETCDF_ERRORS as error:
        raise FileFormatError(
            f"{path}: is no pack of an ensemble, or damaged: {str(error)[:200]}; run the ensemble again, "
            "which makes it anew"
        ) from error


def _alike(outcomes: Iterable[Outcome]) -> list[list[Outcome]]:
    """The members that did not fail, grouped by the layout of their arrays."""
    groups: list[list[Outcome]] = []
    for one in outcomes:
        if one.failure:
            continue
        for group in groups:
            if lie_alike(group[0].kept, one.kept):
                group.append(one)
                break
        else:
            groups.append([one])
    return groups


def lie_alike(first: Mapping[str, Labelled], second: Mapping[str, Labelled]) -> bool:
    """Whether two members kept arrays of the same dimensions and coordinates."""
    return all(first[name].lies_like(second[name]) for name in first)


def _write_group(group: Any, outcomes: list[Outcome]) -> None:
    group.createDimension("member", len(outcomes))
    group.createVariable("member", "i8", ("member",))[:] = [one.index for one in outcomes]
    for name, first in outcomes[0].kept.items():
        inside = group.createGroup(name)
        for dim, length in zip(first.dims, first.values.shape, strict=True):
            inside.createDimension(dim, length)
        for dim, along in first.coords.items():
            texts = along.dtype.kind == "U"
            variable = inside.createVariable(f"along_{dim}", str if texts else "f8", (dim,))
            variable[:] = along.astype(object) if texts else along
        values = inside.createVariable("values", "f8", ("member", *first.dims))
        values[:] = np.stack([one.kept[name].values for one in outcomes])
        values.told = json.dumps(dict(first.attributes))


def _read_group(group: Any) -> dict[int, dict[str, Labelled]]:
    indices = group["member"][:].tolist()
    kept: dict[int, dict[str, Labelled]] = {index: {} for index in indices}
    for name, inside in group.groups.items():
        variable = inside["values"]
        dims = tuple(variable.dimensions[1:])
        coords = {
            dim: _texts_or_numbers(inside[f"along_{dim}"][:])
            for dim in dims
            if f"along_{dim}" in inside.variables
        }
        told = json_of(str(variable.told).encode(), name)
        for index, values in zip(indices, np.asarray(variable[:], dtype=float), strict=True):
            kept[index][name] = Labelled(values=values, dims=dims, coords=coords, attributes=told)
    return kept


def _texts_or_numbers(values: Any) -> Any:
    return values.astype(str) if values.dtype == object else np.asarray(values)
