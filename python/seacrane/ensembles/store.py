"""Packs of members, and where their outcomes are kept: in memory, or in a folder of NetCDF files."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.ensembles.dataset import TEXTS, Labelled, Outcome, dataset_of
from seacrane.ensembles.members import MOST_MEMBERS, Members, Value
from seacrane.ensembles.other_sea import WORDS
from seacrane.ensembles.study import START_TIME, Study
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.caller import silently, warn_caller
from seacrane.inputs.json_text import json_of
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf
from seacrane.inputs.shown import shown
from seacrane.run.interrupts import interrupts_kept
from seacrane.warnings import LostMembersWarning

if TYPE_CHECKING:
    import xarray

DIGITS = 7  # of a pack's number in the name of its file
PACK = re.compile(rf"pack_([0-9]{{{DIGITS}}})\.nc")
LARGEST_FILE = 2**32  # bytes of arrays
MOST_PACKS = 250  # as a rule: a file costs far more than what one member puts into it
LARGEST_PACK = 64
MOST_FRESH = 2**26  # bytes of what was written here that wait in memory to be read


class Folder:
    """Outcomes of packs by their number, each in a NetCDF file; one process writes."""

    def __init__(self, path: Path) -> None:
        self.path, self._room = path, MOST_FRESH
        self._fresh: dict[int, list[Outcome]] = {}  # written here, and not read since

    def __iter__(self) -> Iterator[int]:
        """Numbers of the packs that are there."""
        found = {int(name[1]) for name in map(PACK.fullmatch, self._names()) if name}
        if found and max(found) >= MOST_MEMBERS:
            raise FileFormatError(
                f"{self.path}: has a pack {max(found)}, more than there may be members; remove it"
            )
        return iter(found)

    def _names(self) -> Iterator[str]:
        """Of the files that are there; none where the folder is not."""
        yield from (path.name for path in self.path.glob("pack_*.nc"))

    @interrupts_kept()
    def __setitem__(self, pack: int, outcomes: list[Outcome]) -> None:
        """Write a pack: complete under its name, or not at all.

        Members that lie alike share a group: as a rule there is one.
        Raises OSError if it cannot be written; it names the file, the cause and the space left.
        """
        import netCDF4

        with atomic_write(self._file(pack), tidy=False) as draft:
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
        self._room -= bytes_in({pack: outcomes}, pack)
        if self._room >= 0:
            self._fresh[pack] = outcomes

    @interrupts_kept()
    def __getitem__(self, pack: int) -> list[Outcome]:
        """The outcomes of a pack. Raises FileFormatError where its file is damaged."""
        if pack in self._fresh:
            return self._fresh.pop(pack)
        path = self._file(pack)
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

    def size(self, pack: int) -> int:
        """Bytes of the file of a pack."""
        return self._file(pack).stat().st_size

    def _file(self, pack: int) -> Path:
        return self.path / f"pack_{pack:0{DIGITS}d}.nc"


Store = Folder | dict[int, list[Outcome]]  # in memory, for as long as the process lives


def bytes_in(store: Store, pack: int) -> int:
    """What a pack takes: its file, or its arrays in memory."""
    if isinstance(store, Folder):
        return store.size(pack)
    return sum(kept.values.nbytes for one in store[pack] for kept in one.kept.values())


def stored(store: Store, members: Members) -> xarray.Dataset:
    """All that is there, over these members."""
    return dataset_of(members, (one for number in sorted(store) for one in store[number]))


def kept_packs(store: Store, packs: Mapping[int, Sequence[int]]) -> set[int]:
    """Packs that need not be run, by their members; warns with LostMembersWarning of what cannot be read."""
    there = set(store) & packs.keys()
    lost = {number: why for number in sorted(there) if (why := _lost(store, number, packs[number]))}
    if lost:
        first = next(iter(lost))
        others = f"; so are those of {len(lost) - 1} other packs" if len(lost) > 1 else ""
        warn_caller(
            f"store: members {_shown(packs[first])} are lost or damaged, and are run again: "
            f"{lost[first]}{others}",
            LostMembersWarning,
        )
    return there - lost.keys()


def _lost(store: Store, number: int, indices: Sequence[int]) -> str:
    """Why a pack of these members, which is there, cannot be read; nothing where it can."""
    try:
        found = [one.index for one in store[number]]
    except (FileFormatError, OSError) as error:
        return str(error)
    return "" if found == list(indices) else f"pack {number}: holds other members"


def _shown(indices: Sequence[int]) -> str:
    first, last = indices[0], indices[-1]
    if list(indices) == list(range(first, last + 1)):
        return f"{first} to {last}"
    return ", ".join(map(str, indices))


def _alike(outcomes: Iterable[Outcome]) -> list[list[Outcome]]:
    """The members that did not fail, grouped by the layout of their arrays."""
    groups: list[list[Outcome]] = []
    for one in outcomes:
        if one.failure:
            continue
        for group in groups:
            if all(kept.lies_like(one.kept[name]) for name, kept in group[0].kept.items()):
                group.append(one)
                break
        else:
            groups.append([one])
    return groups


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
        along = {dim: inside[f"along_{dim}"][:] for dim in dims if f"along_{dim}" in inside.variables}
        coords = {d: one.astype(str) if one.dtype == object else np.asarray(one) for d, one in along.items()}
        told = json_of(str(variable.told).encode(), name)
        for index, values in zip(indices, np.asarray(variable[:], dtype=float), strict=True):
            kept[index][name] = Labelled(values=values, dims=dims, coords=coords, attributes=told)
    return kept


def packs_of(order: Sequence[int], size: int) -> dict[int, Sequence[int]]:
    """Members in packs of a size, by the number of the pack."""
    starts = range(0, len(order), size)
    return {number: order[start : start + size] for number, start in enumerate(starts)}


def pack_size(pack: int | None, count: int, lanes: int, together: int) -> int:
    """Members in a pack. `together` is how many members share what is done before the first of them.

    Raises SceneError for a pack that is no number, or no multiple of the lanes.
    """
    if pack is None and together:
        return min(LARGEST_PACK, together)
    if pack is None:
        return lanes * ceil(min(LARGEST_PACK, ceil(count / MOST_PACKS)) / lanes)
    if not isinstance(pack, int) or isinstance(pack, bool) or pack < 1:
        raise SceneError(f"pack is {shown(pack)}; give a whole number from 1 on")
    if pack % lanes:
        raise SceneError(f"pack is {pack} and lanes is {lanes}; give a pack that is a multiple of lanes")
    return pack


def order_of(study: Study, members: Members) -> Sequence[int]:
    """Numbers of all members, those of one lift next to each other, with seeds fastest.

    Parameters that part lifts, as kinds of crane do, come first. Other numbers, such as masses, lie by size,
    and the words of the sea behind them: neighbours cost about the same.
    """
    if study.lanes == 1:
        return range(len(members))
    others = sorted(name for name in members.axes if name not in WORDS)
    sea = sorted(name for name in members.axes if name in WORDS and name != "seed")
    parting = _parting(study, members, others) if len(others) > 1 else []
    slowest_first = [*parting, *(name for name in others if name not in parting), *sea]
    slowest_first += ["seed"] if "seed" in members.axes else []
    ranks = [_ranks(members, name) for name in slowest_first]
    return np.lexsort(ranks[::-1]).tolist()  # type: ignore[no-any-return]


def _ranks(members: Members, name: str) -> NDArray[np.int64]:
    """The place of every member's value among those of a parameter, by size."""
    values = members.axes[name]
    sizes = {value: rank for rank, value in enumerate(sorted(set(values), key=_size))}
    ranks = np.array([sizes[value] for value in values])
    if not members.grid:
        return ranks
    axis, shape = list(members.axes).index(name), tuple(members.shape.values())
    return np.broadcast_to(ranks.reshape([-1 if i == axis else 1 for i in range(len(shape))]), shape).ravel()


def _size(value: Value) -> tuple[bool, Any]:
    return isinstance(value, str), value


def _parting(study: Study, members: Members, names: Sequence[str]) -> list[str]:
    """Parameters whose values keep lifts apart, as two lifts that differ in nothing else tell."""
    base = {name: min(values, key=_size) for name, values in sorted(members.axes.items())}
    usual = _model(study, base)
    found = []
    for name in names:
        if name == START_TIME:
            continue
        several = sorted(set(members.axes[name]), key=_size)
        for value in {several[len(several) // 2], several[-1]} - {base[name]}:
            other = _model(study, {**base, name: value})
            if usual is None or other is None or _core.lanes_differ(usual, other):
                found.append(name)
                break
    return found


def _model(study: Study, values: dict[str, Value]) -> _core.Model | None:
    """The compiled lift of these values; None where there is none, which its member will say."""
    with silently():
        try:
            return study.scene(values).compile()
        except Exception:
            return None
