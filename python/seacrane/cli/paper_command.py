"""``seacrane paper``: the five runs of the paper, its figures with their data, and the report."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from seacrane.cli.command_line import INTERRUPTED
from seacrane.cli.output import output_folder

if TYPE_CHECKING:
    from seacrane.pictures import Finding, Picture
    from seacrane.result import Result

# Name of the run, of the case that makes its scene, and the case's options.
RUNS: dict[str, tuple[str, dict[str, Any]]] = {
    "vessel": ("vessel", {}),
    "vessel_without_memory": ("vessel", {"memory": "none"}),
    "case1": ("case1", {}),
    "case2": ("case2", {}),
    "case3": ("case3", {}),
}
T_END, DT_OUT = 100.0, 0.1  # s
REPEATS = 5  # a single wall time of some hundredths of a second says little about cost
REPORT = "report.html"
TITLE = "Offshore crane and vessel in waves: the lift cases of Landsverk, Zhou and Hovland"
SUMMARY = (
    "The vessel alone in waves, with and without fluid memory, and three cases of its crane swinging out to "
    "port: without payload (case 1), with a payload of 10 t (case 2), and with cylinders that oscillate with "
    "a 5 s period from 50 s on (case 3).",
    "The paper publishes no data and leaves parts of its model open; masses, geometry, hull, sea and control "
    "are our choices within what it states. The findings below compare numbers of these runs with what it "
    "says in words. Every run is made {repeats} times, and its wall time is the least of them.",
    "The paper's axes are x aft, y to starboard: what it prints of surge, sway, roll and pitch has the "
    "opposite sign of the figures here.",
)


def paper(arguments: argparse.Namespace) -> int:
    """Simulate, save, draw and report; 130 if a run was interrupted, with what was computed until then."""
    from seacrane.answers.checks import speed

    folder = output_folder(
        arguments.out, holds=(REPORT, *(f"{name}.nc" for name in RUNS)), overwrite=arguments.overwrite
    )
    runs: dict[str, Result] = {}
    for number, name in enumerate(RUNS, start=1):
        print(f"[{number}/{len(RUNS)}] {name} ...", flush=True)
        runs[name] = _simulate(name)
        runs[name].save(folder / f"{name}.nc")
        fast, stats = speed(runs[name]), runs[name].stats
        pace = f", {fast:.0f} times real time" if fast is not None else ""
        print(f"      {float(stats['wall_s']):.3g} s{pace}, {stats['evaluations']} evaluations", flush=True)
        if runs[name].interrupted:
            print(f"interrupted at {runs[name].time[-1]:g} s of {name}; {len(runs)} runs are in {folder}")
            return INTERRUPTED
    print("drawing figures 3 to 10 ...", flush=True)
    pictures, findings = draw(runs, folder)
    for finding in findings:
        print(f"      {finding.verdict}: {finding.finding}")
    page = _write_report(folder, runs, pictures, findings)
    print(f"saved {len(pictures)} figures and {page}")
    return 0


def _simulate(name: str) -> Result:
    """The quickest of equal runs, or the first that is interrupted."""
    import seacrane.cases as cases
    from seacrane.run.outputs import Outputs
    from seacrane.simulation import simulate

    case, options = RUNS[name]
    scene = getattr(cases, case)(**options)
    results = []
    for _ in range(REPEATS):
        results.append(simulate(scene, T_END, outputs=Outputs(dt_out=DT_OUT)))
        if results[-1].interrupted:
            return results[-1]
    return min(results, key=lambda result: float(result.stats["wall_s"]))


def draw(runs: dict[str, Result], folder: Path) -> tuple[list[Picture], list[Finding]]:
    """Figures 3 to 10 in a folder, and the findings."""
    from seacrane.pictures import PaperRuns, paper_findings, save_paper_figures

    paper_runs = PaperRuns(**runs)
    pictures = save_paper_figures(runs=paper_runs, folder=folder)
    return list(pictures.values()), paper_findings(paper_runs)


def _write_report(
    folder: Path, runs: dict[str, Result], pictures: list[Picture], findings: list[Finding]
) -> Path:
    import seacrane.cases as cases
    from seacrane.answers.report import Study, study_report

    study = Study(
        title=TITLE,
        summary=[text.format(repeats=REPEATS) for text in SUMMARY],
        runs=runs,
        pictures=pictures,
        scene={f"case 2, {section}": rows for section, rows in cases.case2().report().items()},
        findings=findings,
    )
    return study_report(study).save(folder / REPORT, overwrite=True)
