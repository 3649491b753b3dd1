"""Figures show themselves in a notebook, where pyplot was never loaded."""

from __future__ import annotations

import pickle
import subprocess
import sys

from seacrane.plotting.figure import new_figure

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
    done = subprocess.run([sys.executable, "-c", SHOWN], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_figure_is_copied_with_what_shows_it() -> None:
    figure = new_figure(figsize=(2.0, 1.0))
    figure.subplots().plot([0.0, 1.0])
    again = pickle.loads(pickle.dumps(figure))
    assert again._repr_png_.args[0] is again
    assert again._repr_png_()[:4] == b"\x89PNG"
