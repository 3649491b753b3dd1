"""Notebooks and the scripts of documents run, and show what they promise."""

from __future__ import annotations

import pickle
import re
import subprocess
import sys
from pathlib import Path

import jupytext
import nbclient
import pytest

from seacrane.plotting.panel import new_figure

REPOSITORY = Path(__file__).resolve().parents[2]
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.md"))
DOCUMENTS = (
    "README.md",
    pytest.param("docs/getting-started.md", marks=pytest.mark.slow("its blocks run by day")),
)
SCRIPT = re.compile(r"```python\n(?P<script>.*?)```\s+```text\n(?P<output>.*?)```", re.DOTALL)
NUMBER = re.compile(r"-?\d+\.?\d*")


# One by day; the others run by night, all for the wheel and the site.
BY_DAY = ("08_wires",)
BY_NIGHT = pytest.mark.slow("a whole notebook")


@pytest.mark.parametrize(
    "path",
    [pytest.param(path, marks=[] if path.stem in BY_DAY else BY_NIGHT, id=path.stem) for path in NOTEBOOKS],
)
def test_notebook_runs(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "module://matplotlib_inline.backend_inline")  # as in a notebook
    resources = {"metadata": {"path": str(tmp_path)}}
    client = nbclient.NotebookClient(
        jupytext.read(path), timeout=300, kernel_name="python3", resources=resources
    )
    cells = [cell for cell in client.execute().cells if cell.cell_type == "code"]
    assert cells and all(cell.execution_count for cell in cells), "a cell was not run"
    outputs = [out for cell in cells for out in cell.outputs]
    streams = [out for out in outputs if out.output_type == "stream"]
    assert [out.text for out in streams if out.name == "stderr"] == []
    assert any(out.name == "stdout" for out in streams)
    assert any("image/png" in out.get("data", {}) for out in outputs), "no picture was drawn"


def test_a_copy_of_a_figure_shows_itself() -> None:
    figure = new_figure(figsize=(2.0, 1.0))
    figure.subplots().plot([0.0, 1.0])
    again = pickle.loads(pickle.dumps(figure))
    assert again._repr_png_.args[0] is again and again._repr_png_()[:4] == b"\x89PNG"


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
