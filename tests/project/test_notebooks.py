"""Notebooks and the scripts of documents run, and show what they promise."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import jupytext
import nbclient
import pytest

from seacrane.plotting.figure import new_figure

REPOSITORY = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.md"))
DOCUMENTS = (
    "README.md",
    pytest.param("docs/getting-started.md", marks=pytest.mark.slow("its blocks run by day")),
)
SCRIPT = re.compile(r"```python\n(?P<script>.*?)```\s+```text\n(?P<output>.*?)```", re.DOTALL)
NUMBER = re.compile(r"-?\d+\.?\d*")


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


# One by day; the others run by night, all for the wheel and the site.
BY_DAY = ("08_wires",)
BY_NIGHT = pytest.mark.slow("a whole notebook")


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=[] if path.stem in BY_DAY else BY_NIGHT, id=path.stem) for path in NOTEBOOKS],
)
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


def test_notebooks_are_numbered_and_kept_without_outputs() -> None:
    assert [int(path.name.split("_")[0]) for path in NOTEBOOKS] == list(range(1, len(NOTEBOOKS) + 1))
    for path in NOTEBOOKS:
        assert outputs(jupytext.read(path), "stream") == []
        assert "image/png" not in path.read_text(encoding="utf-8")


SHOWN = """
import sys
import numpy as np
from seacrane import Scene, simulate
from seacrane.pictures import plot_track
from IPython.core.formatters import DisplayFormatter

scene = Scene(name="stone")
scene.add_body(name="stone", mass=1.0, inertia=np.eye(3))
result = simulate(scene, t_end=1.0)
for figure in (result.plot("position"), plot_track(result, "stone")):
    data, _ = DisplayFormatter().format(figure)
    assert data["image/png"].startswith(b"\\x89PNG"), data
assert "matplotlib.pyplot" not in sys.modules
"""


def test_a_notebook_shows_a_figure_without_pyplot() -> None:
    """And a copy of it."""
    done = subprocess.run([sys.executable, "-c", SHOWN], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    figure = new_figure(figsize=(2.0, 1.0))
    figure.subplots().plot([0.0, 1.0])
    again = pickle.loads(pickle.dumps(figure))
    assert again._repr_png_.args[0] is again
    assert again._repr_png_()[:4] == b"\x89PNG"


@pytest.mark.parametrize("name", DOCUMENTS)
def test_script_of_document_prints_what_it_says(name: str, tmp_path: Path) -> None:
    """Words exactly; numbers within 5 %, so that a recomputed hull does not rewrite every document."""
    found = SCRIPT.search((REPOSITORY / name).read_text(encoding="utf-8"))
    assert found, f"{name} shows no script with its output"
    command = [sys.executable, "-c", found["script"]]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert NUMBER.sub("#", done.stdout) == NUMBER.sub("#", found["output"])
    printed, shown = (
        [float(number) for number in NUMBER.findall(text)] for text in (done.stdout, found["output"])
    )
    assert printed == pytest.approx(shown, rel=0.05)
