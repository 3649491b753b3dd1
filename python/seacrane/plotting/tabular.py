"""Tables that go on as a pandas table or as comma-separated values."""

from __future__ import annotations

import os
from abc import ABC, abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING

from seacrane.inputs.atomic import atomic_write

if TYPE_CHECKING:
    import pandas
    import xarray


def write_csv(path: str | os.PathLike[str], table: pandas.DataFrame, *, index: str | None = None) -> Path:
    """Write a table with the unit of each column in its name, and its index unless it is a mere count.

    `index`: what the index is called. An older file of that name is replaced, complete or not at all.
    """
    units = table.attrs["units"]
    named = table.rename(columns={name: f"{name} [{units[name]}]" for name in units})
    with atomic_write(Path(path)) as draft:
        named.to_csv(draft, index=index is not None or any(table.index.names), index_label=index)
    return Path(path)


class Tabular(ABC):
    """What becomes an xarray Dataset, and so a table of plain columns: SI units, radians."""

    @abstractmethod
    def to_xarray(self) -> xarray.Dataset:
        """Columns over their axes, with their units."""

    def to_dataframe(self) -> pandas.DataFrame:
        """The same columns as a table, over the axes; `attrs["units"]` holds the units that are known."""
        import pandas

        data = self.to_xarray()
        if data.sizes:
            table = data.to_dataframe()
        else:
            table = pandas.DataFrame({name: [values.item()] for name, values in data.items()})
        table.attrs["units"] = {
            name: one.attrs["units"] for name, one in data.items() if "units" in one.attrs
        }
        return table

    def to_csv(self, path: str | os.PathLike[str]) -> Path:
        """Write these columns as comma-separated values, units in brackets; returns the path.

        An older file of that name is replaced, complete or not at all. Raises OSError.
        """
        return write_csv(path, self.to_dataframe())
