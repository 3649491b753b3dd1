"""The file of a pack: failures and remarks of its members, and what they kept, as NetCDF."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.outcome import Outcome
from seacrane.ensembles.variables import TEXTS
from seacrane.errors import FileFormatError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.json_text import json_of
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, open_netcdf

LARGEST_FILE = 2**32  # bytes of arrays


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
