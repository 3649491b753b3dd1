"""Every notebook runs from its first cell to its last, and shows what it promises."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jupytext
import nbclient
import pytest

NOTEBOOKS = sorted((Path(__file__).resolve().parents[1] / "notebooks").glob("*.md"))


def execute(path: Path, folder: Path) -> Any:
    """The executed notebook; raises CellExecutionError with the cell and its traceback."""
    notebook = jupytext.read(path)
    client = nbclient.NotebookClient(
        notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(folder)}}
    )
    return client.execute()


def code_cells(notebook: Any) -> list[Any]:
    return [cell for cell in notebook.cells if cell.cell_type == "code"]


def outputs(notebook: Any, kind: str) -> list[Any]:
    return [out for cell in code_cells(notebook) for out in cell.outputs if out.output_type == kind]


def test_there_is_a_notebook() -> None:
    assert [path.name for path in NOTEBOOKS][:1] == ["01_first_lift.md"]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")  # as in a notebook
    notebook = execute(path, tmp_path)
    cells = code_cells(notebook)
    assert cells
    assert all(cell.execution_count for cell in cells), "a cell was not run"
    streams = outputs(notebook, "stream")
    assert [out.text for out in streams if out.name == "stderr"] == []
    assert any(out.name == "stdout" for out in streams)
    assert any("image/png" in out.data for out in outputs(notebook, "display_data")), "no picture was drawn"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_is_kept_without_outputs(path: Path) -> None:
    assert outputs(jupytext.read(path), "stream") == []
    assert "image/png" not in path.read_text(encoding="utf-8")
