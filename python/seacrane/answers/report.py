"""report(): one page about a run, by templates; what these show: numbers at a glance, pictures, tables.

A new section is a function of a result, a row of `GIVEN`, and a block of `templates/report.html`.
"""

from __future__ import annotations

import base64
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
from jinja2 import Environment, PackageLoader, StrictUndefined, UndefinedError

from seacrane.answers import checks
from seacrane.answers.lift_sheet import LiftSheet, lift_sheet
from seacrane.answers.particulars import particulars, stage_table
from seacrane.answers.reported_curves import hook_loads
from seacrane.answers.summary import Summary, require_result, summary
from seacrane.arrays import Array
from seacrane.description.suspension import hung_loads
from seacrane.errors import FileFormatError, SeacraneError
from seacrane.inputs.frames import AXES_NOTE
from seacrane.inputs.keywords import named
from seacrane.inputs.replaceable import GENERATOR
from seacrane.pictures.findings import Finding
from seacrane.pictures.plots import PANELS, draw_track, overview_sheet, payload_bodies
from seacrane.pictures.pose import outlined_skeleton, plot_scene
from seacrane.pictures.pose_curves import POSES
from seacrane.pictures.view import Page, view
from seacrane.plotting.panel import DOTS_PER_INCH, Picture, draw, png_of
from seacrane.plotting.table import Answer, Table, facts, table_of
from seacrane.result import Result
from seacrane.result.contact_loads import NO_CONTACTS, contact_loads
from seacrane.result.history import history_sheet
from seacrane.result.traces import Bounded, Trace, traces

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SceneReport = Mapping[str, Sequence[tuple[str, Any]]]
Cards = dict[str, tuple[str, bool | None]]
STATISTICS_HEAD = ("quantity", "unit", "max", "at [s]", "min", "at [s]", "mean", "std")
TENSIONS = ("hook_load", "line_tension", "limit_force")
LARGEST = {  # channels whose value farthest from zero is told at a glance
    "limit_force": "Largest force of a wire, stop or seat",
    "cylinder_force": "Largest cylinder force",
    "slew_torque": "Largest slew torque",
}


class Report(Page):
    """A page about one or several runs. Made by `report`."""


@named
def report(result: Result, *, title: str | None = None, requires: Answer | None = None) -> Report:
    """One page about a run: what was lifted and how, the loads, the limits, the numbers, and the checks.

    Parameters
    ----------
    result : Result
        Of any scene; what it has not recorded is left out.
    title : str, optional
        Heading; default: the scene's name.
    requires : Requirements, optional
        What `seacrane.required` found of the scene: the page ends with it.

    Returns
    -------
    Report
        ``save("lift.html")`` writes it, a notebook shows it.

    Raises
    ------
    SceneError
        If what is given is no result.
    """
    require_result(result)
    heading = str(result.stats["scene"]) if title is None else title
    return Report(title=heading, html=page_of("report.html", title=heading, run=result, requires=requires))


@dataclass(frozen=True, kw_only=True)
class Study:
    """Several runs that a report compares, by the names that heads of columns show.

    With the heading, paragraphs on what was computed, figures on disk whose images are embedded, what the
    compiled model holds as ``scene.report()`` gives it, and the paper's findings, measured.
    """

    title: str
    runs: Mapping[str, Result]
    summary: Sequence[str] = ()
    pictures: Sequence[Picture] = ()
    scene: SceneReport = field(default_factory=dict)
    findings: Sequence[Finding] = ()


def answers_report(title: str, answers: Mapping[str, Answer]) -> Report:
    """The page of answers, each below its title."""
    return Report(title=title, html=page_of("answers.html", title=title, answers=answers))


def study_report(study: Study) -> Report:
    """The page about several runs. Raises OSError if the image of a picture cannot be read."""
    return Report(title=study.title, html=page_of("study.html", title=study.title, study=study))


def page_of(template: str, **given: Any) -> str:
    """A page as a template lays it out; FileFormatError for what no run writes, as notes that are no JSON."""
    try:
        return _templates().get_template(template).render(given)
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError, UndefinedError) as error:
        raise FileFormatError(
            f"the page of {given['title']!r} cannot be made: {type(error).__name__}: {error}; the result "
            "holds notes that no run writes"
        ) from error


@cache
def _templates() -> Environment:
    """Text of users is escaped, tables are not, and None is nothing."""
    made = Environment(
        loader=PackageLoader("seacrane.answers"), autoescape=True, undefined=StrictUndefined,
        trim_blocks=True, lstrip_blocks=True, finalize=lambda one: "" if one is None else one,
    )  # fmt: skip
    made.globals.update(GIVEN)
    return made


def _drawn(figure: Figure) -> str:
    """A Matplotlib figure as a page holds it."""
    return _coded(png_of(figure, dpi=DOTS_PER_INCH))


def _coded(image: bytes) -> str:
    return base64.b64encode(image).decode("ascii")


def _glance(result: Result) -> Cards:
    """The numbers that are asked for first, and whether the run may be trusted."""
    end = f"{float(result.stats['simulated_s']):g} s"
    told: Cards = {"Simulated": (end, False if result.interrupted else None)}
    for part in (_hook_loads, _largest, _roll, _contact, _limits_held, _utilisation, _trust):
        told |= part(result)
    return told


def _finite(result: Result, channel: str, **names: str) -> list[Trace]:
    """The curves of a channel that hold any number: an interrupted run may have none."""
    if channel not in result.channels:
        return []
    return [one for one in traces(result, channel, **names) if np.isfinite(one.values).any()]


def _largest(result: Result) -> Cards:
    """The curve of each channel that reaches furthest from zero."""
    told: Cards = {}
    for channel, label in LARGEST.items():
        if found := _finite(result, channel):
            one = max(found, key=lambda trace: float(np.nanmax(np.abs(_farthest(trace)))))
            values = _farthest(one)
            told[label] = (_placed(result, one.unit, values, int(np.nanargmax(np.abs(values)))), None)
    return told


def _farthest(one: Bounded) -> Array:
    """Of least and largest values since the output before the one farther from zero."""
    return np.where(np.abs(one.least) > np.abs(one.largest), one.least, one.largest)


def _placed(result: Result, unit: str, values: Array, at: int) -> str:
    return f"{values[at]:.4g} {unit} at {result.time[at]:.4g} s"


def _hook_loads(result: Result) -> Cards:
    found = hook_loads(result)
    if not found:
        return {}
    most = max(found, key=lambda one: float(np.nanmax(one.largest)))
    least = min(found, key=lambda one: float(np.nanmin(one.least)))
    places = {
        "Largest hook load": (most.unit, most.largest, int(np.nanargmax(most.largest))),
        "Least hook load": (least.unit, least.least, int(np.nanargmin(least.least))),
    }
    return {text: (_placed(result, *one), one[1][one[2]] >= 0.0 or None) for text, one in places.items()}


def _roll(result: Result) -> Cards:
    rolls = _finite(result, "vessel_motion", motion="roll")
    if not rolls:
        return {}
    one = max(rolls, key=lambda trace: float(np.nanmax(np.abs(_farthest(trace)))))
    values = one.values[np.isfinite(one.values)]
    half = values[values.size // 2 :]
    return {
        "Roll": (f"{np.nanmin(one.least):.3g} to {np.nanmax(one.largest):.3g} deg", None),
        "Mean roll, second half": (f"{half.mean():.3g} deg", None),
    }


def _limits_held(result: Result) -> Cards:
    judged = [bound.held for bound in checks.judged_bounds(result) if bound.held is not None]
    broken = judged.count(False)
    words = f"{broken} of {len(judged)} not held" if broken else f"all {len(judged)} held"
    return {"Limits": (words, not broken)} if judged else {}


def _contact(result: Result) -> Cards:
    known = [one for one in contact_loads(result) if one.peak > 0.0]
    worst = max(known, key=lambda one: one.peak, default=None)
    told = "" if worst is None else f"{worst.peak / 1e3:.4g} kN, {worst.point}"
    return {"Hardest press of a contact": (told, None)} if told else {}


def _utilisation(result: Result) -> Cards:
    known = [state for state in result.utilisation if state.kept is not None]
    if not known:
        return {}
    worst = max(known, key=lambda state: state.utilisation)
    return {"Largest utilisation": (f"{worst.utilisation:.2f}, {worst.name}", worst.kept)}


def _trust(result: Result) -> Cards:
    known = (checks.joints_closed(result), checks.energy_balanced(result))
    judged = [good for good in known if good is not None]
    count = len(checks.findings_of(result))
    told: Cards = {"Warnings": (str(count) if count else "none", not count)}
    if judged:
        told["Numerical checks"] = ("passed" if all(judged) else "not passed", all(judged))
    return told


def _summary(result: Result) -> Summary | None:
    told = replace(summary(result), contacts=NO_CONTACTS)
    return told if told or told.utilisation else None


def _statistics(result: Result) -> Table | None:
    found, left_out = checks.statistics_of(result)
    if not found and not left_out:
        return None
    start, end = result.time[0], result.time[-1]
    words = (
        f"Over the outputs from {start:g} to {end:g} s. Reactions are sizes of the joint's force and moment."
    )
    if left_out:
        words += f" {left_out} curves that are zero up to rounding are left out."
    return table_of(STATISTICS_HEAD, found, form=".4g", remarks=[words])


def _rated_loads(result: Result) -> list[str]:
    """Loads with factors, or on a rope whose breaking load is known."""
    try:
        scene = result.scene
    except SeacraneError:
        return []
    if scene is None:
        return []
    hung = [one.load for one in hung_loads(scene)]
    rated = [*(one for one in scene.lift_factors if one in hung), *(hung if scene.ratings else ())]
    return list(dict.fromkeys(rated))


def _sheet(result: Result, load: str) -> LiftSheet | Table:
    try:
        return lift_sheet(result, load=load)
    except SeacraneError as error:
        return Table(remarks=[f"No sheet of {load}: {error}."])


def _tensions(result: Result) -> str:
    held = [name for name in TENSIONS if name in result.channels]
    return _drawn(draw(history_sheet(result, *held))) if held else ""


def _histories(result: Result) -> str:
    """Where anything but the body positions, which only payloads show, is drawn."""
    shown = set(PANELS) & set(result.channels)
    there = shown - {"position"} or (shown and payload_bodies(result))
    return _drawn(draw(overview_sheet(result))) if there else ""


def _track(result: Result) -> str:
    there = "position" in result.channels and payload_bodies(result)
    return _drawn(draw_track(result)) if there else ""


GIVEN: dict[str, Callable[..., Any] | str | float] = {
    "axes": AXES_NOTE, "generator": GENERATOR, "closed": checks.CLOSED, "balanced": checks.BALANCED,
    "facts": facts, "table": table_of,
    "known": lambda rows: [(text, value) for text, value in rows if value is not None],
    "glance": _glance, "numbers": _summary, "rated_loads": _rated_loads, "sheet": _sheet,
    "particulars": particulars, "stage_table": stage_table,
    "scene": lambda run: _drawn(plot_scene(run)) if outlined_skeleton(run) else "",
    "has_poses": lambda run: run.kept_scene is not None and set(POSES) <= set(run.channels),
    "page": lambda run: view(run)._repr_html_(),
    "tensions": _tensions, "histories": _histories, "track": _track,
    "limits": checks.limits, "contacts": contact_loads, "statistics": _statistics, "events": checks.events,
    "findings": checks.findings_of, "constraint_rows": checks.constraint_rows,
    "energy_rows": checks.energy_rows, "counter_rows": checks.counter_rows,
    "joints_closed": checks.joints_closed, "energy_balanced": checks.energy_balanced,
    "digest": checks.digest, "versions": checks.versions, "recorded": checks.recorded,
    "settings": lambda run: json.dumps(dict(run.settings), indent=1, sort_keys=True),
    "side_by_side": checks.side_by_side, "image": lambda picture: _coded(picture.image.read_bytes()),
    "found": lambda study: [(one.finding, one.number, one.expected, one.verdict) for one in study.findings],
}  # fmt: skip
