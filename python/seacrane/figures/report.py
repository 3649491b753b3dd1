"""One self-contained HTML page about a set of runs: figures, scene, counters, errors, findings, settings."""

from __future__ import annotations

import base64
import json
import os
import platform
from collections.abc import Iterable, Mapping, Sequence
from html import escape
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

import numpy as np

from seacrane.figures.findings import Finding
from seacrane.plotting.panel import Picture
from seacrane.result import Result, atomic_write

SceneReport = Mapping[str, Sequence[tuple[str, Any]]]

COUNTERS = {
    "simulated_s": "simulated time [s]",
    "wall_s": "wall time of the loop [s]",
    "steps": "accepted steps",
    "rejected_steps": "rejected steps",
    "evaluations": "evaluations",
    "states": "states",
    "coordinates": "coordinates",
    "constraints": "constraints",
    "degrees_of_freedom": "degrees of freedom",
    "compiled_coordinates": "compiled coordinates",
    "compiled_constraints": "compiled constraints",
    "wave_components": "wave components",
    "realised_hs": "realised Hs [m]",
    "wave_energy_without_load": "share of the waves' energy above the database's frequencies",
    "load_variance_without_load": "the same of the variance of a vessel's load, estimated",
    "seed": "seed",
    "fastest_mode_per_s": "fastest mode at the start [1/s]",
    "formulation": "formulation",
    "integrator": "integrator",
}
CONSTRAINT_ERRORS = {
    "constraint_error": "position residual after projection [m or rad]",
    "constraint_rate_error": "velocity residual after projection [m/s or rad/s]",
    "constraint_error_before_projection": "position residual before projection [m or rad]",
}
PACKAGES = ("seacrane", "numpy", "scipy", "matplotlib", "netCDF4", "xarray")

STYLE = """
body { font: 15px/1.45 Georgia, serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; color: #111; }
h1, h2, h3 { font-family: Helvetica, Arial, sans-serif; line-height: 1.2; }
table { border-collapse: collapse; margin: 0.8rem 0; font-size: 0.86em; }
th, td { border: 1px solid #bbb; padding: 0.2rem 0.5rem; text-align: left; vertical-align: top; }
th { background: #eee; }
td.number { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
figure { margin: 1.2rem 0; }
img { max-width: 100%; height: auto; }
figcaption { font-size: 0.86em; color: #333; }
pre { white-space: pre-wrap; font-size: 0.8em; background: #f5f5f5; padding: 0.5rem; }
@media print {
  body { margin: 0; max-width: none; font-size: 10.5pt; }
  figure, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; }
}
"""


def format_value(value: Any) -> str:
    """A number with five significant digits and no more, integers in full, anything else as it prints."""
    if isinstance(value, (bool, np.bool_)):
        return "yes" if value else "no"
    if isinstance(value, (float, np.floating)):
        return f"{float(value):.5g}"
    if isinstance(value, (list, tuple)):
        return ", ".join(format_value(item) for item in value)
    return "" if value is None else str(value)


def worst(result: Result, channel: str) -> float | None:
    """Largest absolute value of a channel over the run, or None if it was not recorded."""
    return float(np.max(np.abs(result[channel]))) if channel in result.channels else None


def energy_closure(result: Result) -> float | None:
    """Largest absolute energy balance over the largest absolute work, or None where it is not defined."""
    balance, work = worst(result, "energy_balance"), worst(result, "absolute_work")
    return balance / work if balance is not None and work else None


def report_html(
    *,
    title: str,
    summary: Sequence[str] = (),
    runs: Mapping[str, Result],
    pictures: Iterable[Picture] = (),
    scene: SceneReport | None = None,
    findings: Sequence[Finding] = (),
) -> str:
    """The page as text.

    Parameters
    ----------
    title : str
        Heading.
    summary : sequence of str
        What was computed, one paragraph each.
    runs : mapping of str to Result
        Runs by the names that heads of columns show.
    pictures : iterable of Picture
        Figures on disk; their images are embedded.
    scene : mapping of str to sequence of (name, value), optional
        What the compiled model holds, as ``scene.report()`` gives it.
    findings : sequence of Finding
        The paper's findings, measured.

    Returns
    -------
    str
        HTML with everything inside: no file, script or address outside it is needed.

    Raises
    ------
    OSError
        If the image of a picture cannot be read.
    """
    body = [f"<h1>{escape(title)}</h1>"]
    body += [f"<p>{escape(text)}</p>" for text in summary]
    body += [
        f"<p><strong>Interrupted:</strong> run {escape(name)} ended at {run.time[-1]:g} s.</p>"
        for name, run in runs.items()
        if run.interrupted
    ]
    body += [
        f"<p><strong>Out of range:</strong> run {escape(name)}: {escape(text)}.</p>"
        for name, run in runs.items()
        for text in str(run.stats.get("validity", "")).splitlines()
    ]
    shown = list(pictures)
    if findings:
        body += ["<h2>Findings</h2>", _findings(findings)]
    if shown:
        body += ["<h2>Figures</h2>", *map(_figure, shown)]
    body += ["<h2>Accuracy</h2>", "<h3>Worst constraint errors</h3>", _by_run(runs, _constraint_rows(runs))]
    body += ["<h3>Energy balance</h3>", _by_run(runs, _energy_rows(runs))]
    body += ["<h2>Cost</h2>", _by_run(runs, _counter_rows(runs))]
    if scene:
        body += ["<h2>Scene</h2>", *_scene(scene)]
    body += ["<h2>Settings</h2>", *(_settings(name, run) for name, run in runs.items())]
    body += ["<h2>Versions</h2>", _table(["package", "version"], versions().items())]
    head = f'<meta charset="utf-8"><title>{escape(title)}</title><style>{STYLE}</style>'
    content = "\n".join(body)
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head>\n<body>\n{content}\n</body></html>\n'


def write_report(path: str | os.PathLike[str], **contents: Any) -> Path:
    """Write the page that `report_html` makes from the same arguments, complete or not at all.

    Parameters
    ----------
    path : path
        Target; its folder must exist.
    **contents
        Arguments of `report_html`.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    OSError
        If an image cannot be read or the page cannot be written.
    """
    path = Path(path)
    page = report_html(**contents)
    with atomic_write(path) as draft:
        draft.write_text(page, encoding="utf-8")
    return path


def versions() -> dict[str, str]:
    """Versions of Python and of the packages a result depends on."""
    found = {"python": platform.python_version(), "platform": f"{platform.system()} {platform.machine()}"}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "not installed as a package"
    return found


def _cell(value: Any) -> str:
    number = isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
    return (
        f'<td class="number">{format_value(value)}</td>'
        if number
        else f"<td>{escape(format_value(value))}</td>"
    )


def _table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    top = "".join(f"<th>{escape(name)}</th>" for name in head)
    lines = "\n".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    return f"<table><thead><tr>{top}</tr></thead><tbody>\n{lines}\n</tbody></table>"


def _by_run(runs: Mapping[str, Result], rows: Iterable[Sequence[Any]]) -> str:
    return _table(["", *runs], rows)


def _constraint_rows(runs: Mapping[str, Result]) -> list[list[Any]]:
    return [[text, *(worst(run, name) for run in runs.values())] for name, text in CONSTRAINT_ERRORS.items()]


def _energy_rows(runs: Mapping[str, Result]) -> list[list[Any]]:
    return [
        ["largest |energy balance| [J]", *(worst(run, "energy_balance") for run in runs.values())],
        ["largest absolute work [J]", *(worst(run, "absolute_work") for run in runs.values())],
        ["balance over work", *(energy_closure(run) for run in runs.values())],
    ]


def _counter_rows(runs: Mapping[str, Result]) -> list[list[Any]]:
    rows: list[list[Any]] = [
        [text, *(run.stats.get(name) for run in runs.values())]
        for name, text in COUNTERS.items()
        if any(name in run.stats for run in runs.values())
    ]
    return [*rows, ["times faster than real time", *(speed(run) for run in runs.values())]]


def speed(result: Result) -> float | None:
    """Simulated seconds per second of the loop, or None if the loop took no measurable time."""
    wall = float(result.stats["wall_s"])
    return float(result.stats["simulated_s"]) / wall if wall > 0 else None


def _findings(findings: Sequence[Finding]) -> str:
    return _table(
        ["finding", "measured", "expected", "verdict"],
        [[item.finding, item.number, item.expected, item.verdict] for item in findings],
    )


def _figure(picture: Picture) -> str:
    data = base64.b64encode(picture.image.read_bytes()).decode("ascii")
    title, text = escape(picture.title), escape(picture.caption)
    source = f" Data: {escape(picture.data.name)}." if picture.data is not None else ""
    return (
        f'<figure><img alt="{title}" src="data:image/png;base64,{data}">'
        f"<figcaption><strong>{title}.</strong> {text}{source}</figcaption></figure>"
    )


def _scene(scene: SceneReport) -> list[str]:
    parts = []
    for section, rows in scene.items():
        parts += [f"<h3>{escape(section)}</h3>", _table(["item", "value"], rows)]
    return parts


def _settings(name: str, run: Result) -> str:
    text = json.dumps(json.loads(str(run.stats["settings"])), indent=1, sort_keys=True)
    return f"<h3>{escape(name)}</h3><pre>{escape(text)}</pre>"
