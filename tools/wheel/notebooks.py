"""Runs a notebook and keeps it with its outputs: ``python tools/wheel/notebooks.py NOTEBOOK.md OUT.ipynb``.

Pages of `view` and `report` are left out: Jupyter shows none in a notebook that it has not run itself, and
each holds the whole page. The second cell says so, and which extra opens the notebook.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path
from typing import Any

import jupytext
import nbclient
import nbformat

LONGEST = 300  # s of a cell
HEAD = (
    "*Needs `pip install 'seacrane[notebooks]'`. The outputs are those of seacrane {version}. Pages in three "
    "dimensions and reports are not among them: they appear when their cell is run.*"
)


def executed(path: Path) -> Any:
    """The notebook with its outputs and a cell that says what it needs."""
    notebook = jupytext.read(path)
    notebook.metadata.pop("jupytext", None)  # else Jupyter keeps it together with a text that is not there
    with tempfile.TemporaryDirectory() as folder:
        resources = {"metadata": {"path": folder}}
        nbclient.NotebookClient(
            notebook, timeout=LONGEST, kernel_name="python3", resources=resources
        ).execute()
    for cell in notebook.cells:
        cell.metadata.pop("execution", None)
        for output in cell.get("outputs", ()):
            if "srcdoc=" in "".join(output.get("data", {}).get("text/html", "")):
                del output["data"]["text/html"]
    from seacrane import __version__

    notebook.cells.insert(1, nbformat.v4.new_markdown_cell(HEAD.format(version=__version__), id="needs"))
    nbformat.validate(notebook)
    return notebook


def main(source: str, target: str) -> None:
    """Run, then write."""
    notebook = executed(Path(source))
    Path(target).parent.mkdir(parents=True, exist_ok=True)
    nbformat.write(notebook, target)
    print(f"{target}: {Path(target).stat().st_size / 1e6:.2f} MB", flush=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
