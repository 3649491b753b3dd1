"""Rows on disk, from which an experiment that was stopped continues."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.whole_file import read_whole
from seacrane.trading.row import Row

LARGEST_FILE = 2**28  # bytes; a row takes some hundred


class RowFile:
    """Rows on disk, one per line under a first line that says which experiment they belong to.

    A file of another experiment (another scene, version or list of quantities) is begun anew.

    Attributes
    ----------
    rows : dict of str to Row
        By the key that each had before it was measured.
    """

    def __init__(self, path: Path | None, experiment: Mapping[str, Any]) -> None:
        self.path = path
        self.rows: dict[str, Row] = {}
        if path is None:
            return
        head = json.dumps({**experiment, "columns": [part.name for part in fields(Row)]}, sort_keys=True)
        lines = _lines(path) if path.is_file() else []
        if lines and lines[0] == head:
            for line in lines[1:]:
                try:
                    kept = json.loads(line)
                    self.rows[kept["key"]] = Row.from_data(kept["row"])
                except (
                    ValueError,
                    TypeError,
                    KeyError,
                    RecursionError,
                ):  # the line that an interrupted call was writing
                    continue
        with atomic_write(path) as draft:
            lines = [head, *(_line(key, row) for key, row in self.rows.items())]
            draft.write_text("\n".join(lines) + "\n", encoding="utf-8")

    def add(self, key: str, row: Row) -> None:
        """Keep a row under the key that it had before it was measured."""
        self.rows[key] = row
        if self.path is not None:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(_line(key, row) + "\n")


def _lines(path: Path) -> list[str]:
    return read_whole(path, LARGEST_FILE, "remove it").decode("utf-8", "replace").splitlines()


def _line(key: str, row: Row) -> str:
    return json.dumps({"key": key, "row": asdict(row)})


def completed(
    keys: Iterable[str],
    file: RowFile,
    measure: Callable[[list[str]], Iterable[tuple[str, Row]]],
    *,
    title: str,
    progress: bool,
) -> list[Row]:
    """The rows of all keys, in their order.

    Parameters
    ----------
    file : What it holds is not measured again; what is measured is kept there at once.
    measure : callable
        Measures the rows of the keys that are missing, in any order, and gives each with its key.
    title : Of the progress bar.
    progress : Whether to show it.
    """
    if progress:
        from tqdm.auto import tqdm
    else:
        from tqdm import tqdm  # the other one warns in a notebook without widgets, even when it shows nothing

    wanted = list(dict.fromkeys(keys))
    missing = [key for key in wanted if key not in file.rows]
    with tqdm(total=len(wanted), desc=title, unit="row", disable=not progress) as bar:
        bar.update(len(wanted) - len(missing))
        for key, row in measure(missing) if missing else ():
            file.add(key, row)
            bar.update()
    return [file.rows[key] for key in wanted]
