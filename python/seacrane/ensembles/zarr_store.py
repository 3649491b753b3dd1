"""A Zarr group that is filled member by member: every variable has a chunk for each of them."""

from __future__ import annotations

import contextlib
import json
import math
import shutil
import threading
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane.ensembles.dataset import failure_of, table_of
from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.members import MOST_MEMBERS, Members
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.store import numbers_of
from seacrane.ensembles.study_folder import IN_ZARR, records_of
from seacrane.ensembles.variables import NOT_RUN, TEXTS, axes_of, own_dims
from seacrane.ensembles.zarr_chunks import (
    MISSING,
    Noted,
    chunks_of,
    mark_text,
    noted,
    read_mark,
    remove_unfinished,
    require_files,
    wrong,
)
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write, space_left
from seacrane.inputs.caller import warn_caller
from seacrane.run.interrupts import interrupts_kept
from seacrane.warnings import LostMembersWarning

if TYPE_CHECKING:
    import xarray

ANEW = "run the ensemble again, which makes it anew"
DAMAGED = (
    ArithmeticError,
    AttributeError,
    LookupError,
    OSError,
    RuntimeError,
    TypeError,
    ValueError,
)  # what reading a damaged group raises
Block = tuple[tuple[int | slice, ...], slice]
CODECS = {"bytes", "vlen-utf8", "zstd"}
LARGEST = 2**30  # bytes of what one member keeps
LONGEST = 2 * 10**7  # values along a dimension
_FILTERS = threading.RLock()


class ZarrStore:
    """A Zarr group with a variable for everything kept; one process writes.

    A pack is there once its file in the group of the study is, which is written after its members; the
    attributes of that group are, after the arrays that they tell of. What a kill left between is made again.

    Parameters
    ----------
    path : Path
    holding : callable
        The members that there are room for, once one of this number is to be kept.

    Raises SceneError where Zarr is not installed.
    """

    def __init__(self, path: Path, holding: Callable[[int], Members]) -> None:
        try:
            self._zarr: Any = import_module("zarr")
        except ImportError as error:
            raise SceneError(
                f"store {str(path)!r} takes Zarr: pip install 'seacrane[zarr]'; or give a name without .zarr"
            ) from error
        self.path, self._holding = path, holding
        self._room = 0
        self._first: dict[str, Labelled] = {}
        self._arrays: dict[str, Any] = {}

    def done(self) -> set[int]:
        return numbers_of(records_of(self.path), ".json")

    def lost(self, pack: int, indices: Sequence[int]) -> str:
        try:
            members, chunks = read_mark(self._mark(pack))
            if members != list(indices):
                return f"{self._mark(pack)}: is of other members"
            return next((f"{file} {what}" for _, file, what in self._wrong(members, chunks, read=True)), "")
        except DAMAGED as error:
            return str(error)[:200]

    @interrupts_kept()
    def keep(self, pack: int, outcomes: list[Outcome]) -> None:
        indices = [one.index for one in outcomes]
        try:
            with _without_remarks():
                self._write(indices, outcomes)
            chunks = {name: [noted(file) for file in files] for name, files in self._files(indices)}
        except OSError as error:
            raise OSError(f"could not write {self.path}: {error}{space_left(self.path)}") from error
        with atomic_write(self._mark(pack), tidy=False) as draft:
            draft.write_text(json.dumps(mark_text(indices, chunks)), encoding="utf-8")

    @interrupts_kept()
    def of(self, pack: int) -> list[Outcome]:
        try:
            return self._read(read_mark(self._mark(pack))[0])
        except DAMAGED as error:
            raise FileFormatError(f"{self.path}: pack {pack} is damaged: {str(error)[:200]}") from error

    def outcomes(self) -> Iterator[Outcome]:
        for pack in sorted(self.done()):
            yield from self.of(pack)

    def dataset(self, members: Members) -> xarray.Dataset:
        """What is there, read as it is asked for; members of which a chunk is missing are failures.

        Raises FileFormatError for what is damaged or none of ours.
        """
        import xarray

        try:
            require_files(self.path)
            with _without_remarks():
                if not self._room_there():
                    return table_of(members, ()).dataset()
                self._require_ours()
                found: xarray.Dataset = xarray.open_zarr(
                    self.path, chunks=None, decode_cf=False, consolidated=False
                )
            dim, length = next(iter(members.shape.items()))
            found = found.set_coords([name for name in members.axes if name in found])
            return _told(found.isel({dim: slice(length)}), self._missing(len(members)))
        except FileFormatError:
            raise
        except DAMAGED as error:
            raise FileFormatError(f"{self.path}: is damaged: {str(error)[:200]}; {ANEW}") from error

    def mend(self) -> None:
        """Remove what a killed process left, and begin anew where the arrays cannot be read.

        Warns
        -----
        LostMembersWarning
            Where they cannot.
        """
        remove_unfinished(self.path)
        try:
            require_files(self.path)
            with _without_remarks():
                if self._room_there():
                    self._require_ours()
        except DAMAGED as error:
            self._forget(str(error)[:200])

    def _forget(self, why: str) -> None:
        count = len(self.done())
        records = records_of(self.path)
        for path in (*records.glob("pack_*.json"), *records.glob("zarr.json"), *self.path.glob("zarr.json")):
            path.unlink()
        for path in self.path.iterdir():
            if path != records and ((path / "zarr.json").exists() or (path / "c").is_dir()):
                shutil.rmtree(path)
        self._room, self._first = 0, {}
        self._arrays.clear()
        if count:
            warn_caller(
                f"store {str(self.path)!r}: its arrays are damaged: {why}; the members of all {count} packs "
                "are run again",
                LostMembersWarning,
            )

    def _missing(self, count: int) -> dict[int, str]:
        """By member: the chunk that it lacks."""
        found: dict[int, str] = {}
        for pack in self.done():
            members, chunks = read_mark(self._mark(pack))
            if max(members) >= self._room:
                raise ValueError(f"pack {pack} is of members that are not there")
            for index, file, what in self._wrong(members, chunks, read=False):
                if what != MISSING:
                    raise ValueError(f"{file} {what}")
                if index < count:
                    found.setdefault(index, f"lost: {file} {what}; {ANEW}")
        return found

    def _files(self, indices: Sequence[int]) -> Iterator[tuple[str, list[str]]]:
        """By variable, the chunks of members."""
        dims = {name: first.values.ndim for name, first in self._first.items()}
        return chunks_of(self.path, {**dims, **dict.fromkeys(TEXTS, 0)}, indices, self._shape)

    def _wrong(
        self, indices: Sequence[int], chunks: Mapping[str, Sequence[Noted]], *, read: bool
    ) -> Iterator[tuple[int, str, str]]:
        """Members, their chunks that are not as a mark tells, and why."""
        for name, files in self._files(indices):
            told = chunks.get(name, [None] * len(indices))
            for index, file, there in zip(indices, files, told, strict=True):
                if what := wrong(file, there, read=read):
                    yield index, file, what

    def _require_ours(self) -> None:
        """Know the arrays, or raise one of `DAMAGED` where they are not as this writes them."""
        group = self._opened()
        self._room = self._room_there()
        members = self._holding(self._room - 1)
        require_bounded(group, len(members.shape))
        self._first = _first_in(group)
        require_arrays(group, members, self._first)

    def _mark(self, pack: int) -> Path:
        return records_of(self.path) / f"pack_{pack:07d}.json"

    def _write(self, indices: Sequence[int], outcomes: Sequence[Outcome]) -> None:
        self._make_room(max(indices))
        self._make_arrays(outcomes)
        failures = [failure_of(one, self._first) for one in outcomes]
        blocks = list(_blocks(indices, self._shape))
        for name, first in self._first.items():
            values = np.full((len(outcomes), *first.values.shape), np.nan)
            for place, one in enumerate(outcomes):
                if not failures[place]:
                    values[place] = one.kept[name].values
            _put(self._array(name), values, blocks)
        for name in TEXTS:
            told = failures if name == "failure" else [getattr(one, name) for one in outcomes]
            _put(self._array(name), np.array(told, dtype=np.dtypes.StringDType()), blocks)

    def _read(self, indices: Sequence[int]) -> list[Outcome]:
        self._room = self._room or self._room_there()
        self._first = self._first or _first_in(self._opened())
        blocks = list(_blocks(indices, self._shape))
        texts = {name: _taken(self._array(name), blocks) for name in TEXTS}
        arrays = {name: _taken(self._array(name), blocks) for name in self._first}
        return [
            Outcome(
                index=index,
                kept={} if texts["failure"][place] else self._kept(arrays, place),
                **{name: str(told[place]) for name, told in texts.items()},
            )
            for place, index in enumerate(indices)
        ]

    def _kept(self, arrays: Mapping[str, Any], place: int) -> dict[str, Labelled]:
        return {
            name: Labelled(
                values=np.asarray(arrays[name][place], dtype=float),
                dims=first.dims,
                coords=first.coords,
                attributes=first.attributes,
            )
            for name, first in self._first.items()
        }

    def _opened(self) -> Any:
        return self._zarr.open_group(self.path, mode="r+", use_consolidated=False)

    def _array(self, name: str) -> Any:
        if name not in self._arrays:
            self._arrays[name] = self._opened()[name]
        return self._arrays[name]

    @property
    def _shape(self) -> tuple[int, ...]:
        return tuple(self._holding(self._room - 1).shape.values())

    def _room_there(self) -> int:
        """Members that every variable has room for."""
        if not (records_of(self.path) / "zarr.json").is_file():
            return 0
        found = self._opened()[IN_ZARR].attrs.get("members", 0)
        if type(found) is not int or not 0 <= found <= 2 * MOST_MEMBERS:
            raise ValueError(f"it tells of {str(found)[:60]} members")
        return found

    def _make_room(self, index: int) -> None:
        """For members up to this one at least; what has room for some is made longer."""
        self._room = self._room or self._room_there()
        if index < self._room:
            return
        members = self._holding(index)
        _require_plain_names(members)
        over = members.shape
        group = self._zarr.open_group(self.path, mode="a", use_consolidated=False)
        study = group.require_group(IN_ZARR)
        if not self._room:
            for name, text in TEXTS.items():
                group.create_array(
                    name, shape=tuple(over.values()), chunks=(1,) * len(over), dtype=str,
                    fill_value=NOT_RUN if name == "failure" else "", dimension_names=tuple(over),
                    attributes={"long_name": text}, overwrite=True,
                )  # fmt: skip
        for _, array in group.arrays():
            if array.metadata.dimension_names[: len(over)] == tuple(over):
                array.resize((*over.values(), *array.shape[len(over) :]))
        for name, (dim, values) in axes_of(members).items():
            _along(group, name, dim, values)
        self._zarr.consolidate_metadata(group.store)
        self._room = study.attrs["members"] = len(members)
        self._arrays.clear()

    def _make_arrays(self, outcomes: Sequence[Outcome]) -> None:
        """What is kept, as the first member has it that did not fail."""
        if self._first:
            return
        group = self._opened()
        if "dims" in group[IN_ZARR].attrs:
            self._first = _first_in(group)
            return
        kept = next((one.kept for one in outcomes if not one.failure), None)
        if kept is None:
            return
        over = self._holding(self._room - 1).shape
        for name, own in own_dims(kept).items():
            shape = kept[name].values.shape
            chunks = (*(1 for _ in over), *(max(length, 1) for length in shape))
            group.create_array(
                name, shape=(*over.values(), *shape), chunks=chunks, dtype="f8",
                fill_value=np.nan, dimension_names=(*over, *own.values()),
                attributes=dict(kept[name].attributes), overwrite=True,
            )  # fmt: skip
            for dim, values in kept[name].coords.items():
                _along(group, own[dim], own[dim], values)
        self._zarr.consolidate_metadata(group.store)
        group[IN_ZARR].attrs["dims"] = {name: list(one.dims) for name, one in kept.items()}
        self._first = dict(kept)


@contextlib.contextmanager
def _without_remarks() -> Iterator[None]:
    """Zarr's, that texts and consolidated metadata are younger than its third format.

    Filters are of the process, so one thread at a time changes them.
    """
    with _FILTERS, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _told(found: xarray.Dataset, missing: Mapping[int, str]) -> xarray.Dataset:
    """With what is missing among the failures."""
    if not missing:
        return found
    failure = found["failure"]
    texts = np.array(failure.to_numpy(), dtype=object)
    for index, why in missing.items():
        texts[np.unravel_index(index, texts.shape)] = why
    return found.assign(failure=(failure.dims, texts, failure.attrs))


def _require_plain_names(members: Members) -> None:
    for name in members.axes:
        if "/" in name:
            raise SceneError(
                f"over: {name!r} names no variable of Zarr; rename the element, or give a store without .zarr"
            )


def _along(group: Any, name: str, dim: str, values: Any) -> None:
    """Values along a dimension."""
    texts = values.dtype.kind in "UO"
    array = group.create_array(
        name, shape=values.shape, chunks=(max(values.size, 1),), dtype=str if texts else values.dtype,
        dimension_names=(dim,), overwrite=True,
    )  # fmt: skip
    array[:] = values.astype(np.dtypes.StringDType()) if texts else values


def _blocks(indices: Sequence[int], shape: tuple[int, ...]) -> Iterator[Block]:
    """Members next to each other along the last axis, and their places among the indices."""
    at = np.stack(np.unravel_index(indices, shape), axis=1)
    apart = np.any(np.diff(at, axis=0) != [*[0] * (len(shape) - 1), 1], axis=1)
    ends = [0, *(np.flatnonzero(apart) + 1).tolist(), len(indices)]
    for begin, end in pairwise(ends):
        first = at[begin].tolist()
        yield (*first[:-1], slice(first[-1], first[-1] + end - begin)), slice(begin, end)


def _put(array: Any, values: Any, blocks: Sequence[Block]) -> None:
    for where, places in blocks:
        array[where] = values[places]


def _taken(array: Any, blocks: Sequence[Block]) -> Any:
    return np.concatenate([array[where] for where, _ in blocks])


def _first_in(group: Any) -> dict[str, Labelled]:
    """How arrays lie, with values of no meaning."""
    found: dict[str, Labelled] = {}
    for name, dims in group[IN_ZARR].attrs.get("dims", {}).items():
        array = group[name]
        shape = array.shape[array.ndim - len(dims) :]
        names = array.metadata.dimension_names[array.ndim - len(dims) :]
        coords = {
            dim: np.array(group[own][:].tolist())
            for dim, own in zip(dims, names, strict=True)
            if own in group
        }
        found[name] = Labelled(
            values=np.zeros(shape), dims=tuple(dims), coords=coords, attributes=array.attrs.asdict()
        )
    return found


def require_bounded(group: Any, over: int) -> None:
    """Refuse arrays that take too much memory for one member, or along a dimension, and foreign codecs.

    Parameters
    ----------
    over : Number of dimensions of the ensemble.

    Raises
    ------
    ValueError
    """
    for name, array in group.arrays():
        found = {codec.to_dict()["name"] for codec in array.metadata.codecs}
        if not found <= CODECS:
            raise ValueError(f"array {name[:60]!r} is packed by {', '.join(sorted(found - CODECS))[:60]}")
        if any(length > LONGEST for length in array.shape) or 8 * math.prod(array.shape[over:]) > LARGEST:
            raise ValueError(f"array {name[:60]!r} has shape {array.shape}")


def require_arrays(group: Any, members: Members, first: Mapping[str, Labelled]) -> None:
    """Refuse arrays of other shapes, chunks or names.

    Parameters
    ----------
    members : That there is room for.
    first : mapping of str to Labelled
        How arrays lie.

    Raises
    ------
    ValueError, KeyError
    """
    over = tuple(members.shape.values())
    names = {*TEXTS, *members.axes, "member", *first}
    for dims in own_dims(first).values():
        names |= set(dims.values())
    arrays = dict(group.arrays())
    strange = arrays.keys() - names
    if strange:
        raise ValueError(f"it holds an array {min(strange)[:60]!r}, which no ensemble writes")
    for name, array in arrays.items():
        if name not in TEXTS and name not in first and array.ndim != 1:
            raise ValueError(f"array {name[:60]!r} has shape {array.shape}")
    for name in (*TEXTS, *first):
        array, own = arrays[name], first[name].values.shape if name in first else ()
        there = tuple(array.shape)
        if there[1 : len(over)] != over[1:] or there[0] < over[0] or there[len(over) :] != own:
            raise ValueError(f"array {name[:60]!r} has shape {there}, for {(*over, *own)}")
        if tuple(array.chunks) != (*(1 for _ in over), *(max(length, 1) for length in own)):
            raise ValueError(f"array {name[:60]!r} has chunks {array.chunks}")
