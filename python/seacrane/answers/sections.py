"""The one list of sections: what a report of a result holds, from what an engineer asks first to provenance.

A new section is a function of a result that gives HTML, and a row of the list.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from html import escape
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from seacrane.answers.checks import (
    checked,
    cost,
    energy_balanced,
    events,
    findings_of,
    joints_closed,
    provenance,
    statistics_of,
    warned,
)
from seacrane.answers.lift_sheet import UNVERIFIED, lift_sheet
from seacrane.answers.limits_section import judged_bounds, limits
from seacrane.answers.particulars import particulars
from seacrane.answers.reported_curves import hook_loads
from seacrane.answers.summary import summary
from seacrane.description.suspension import hung_loads
from seacrane.errors import FileFormatError, SeacraneError
from seacrane.inputs.replaceable import GENERATOR
from seacrane.pictures.plots import PANELS, draw_track, overview_sheet, payload_bodies
from seacrane.pictures.pose import outlined_skeleton, plot_scene
from seacrane.pictures.pose_curves import POSES
from seacrane.pictures.view import view
from seacrane.plotting.panel import DOTS_PER_INCH, Picture, draw
from seacrane.plotting.table import table_of
from seacrane.result import Result
from seacrane.result.contact_loads import NO_CONTACTS, contact_loads
from seacrane.result.history import history_sheet
from seacrane.result.traces import Bounded, Trace, traces

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Array = NDArray[np.float64]
Cards = dict[str, tuple[str, bool | None]]
STATISTICS_HEAD = ("quantity", "unit", "max", "at [s]", "min", "at [s]", "mean", "std")
SHEET_NOTE = (
    f'"{UNVERIFIED}": nobody has said where the number is from. The steps are those of GL Noble Denton '
    "0027/ND Rev. 11, 6.2 and 7.2."
)
CONTACT_NOTE = (
    "Speed is that at which a point comes, along the surface's normal. A re-hit is each contact of a point "
    "after its first. The largest press is that of the outputs."
)
TENSIONS = ("hook_load", "line_tension", "limit_force")
LARGEST = {  # channels whose value farthest from zero is told at a glance
    "limit_force": "Largest force of a wire, stop or seat",
    "cylinder_force": "Largest cylinder force",
    "slew_torque": "Largest slew torque",
}
Subject = TypeVar("Subject")
PAGE = Template((files("seacrane") / "answers" / "page.html").read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Section(Generic[Subject]):
    """One block of a page.

    Attributes
    ----------
    title : Its heading.
    html : Its content as HTML, in which all text of users is escaped; where there is none it is left out.
    """

    title: str
    html: Callable[[Subject], str]


def _block(section: Section[Subject], subject: Subject) -> str:
    try:
        content = section.html(subject)
    except (LookupError, TypeError, ValueError, ArithmeticError, AttributeError) as error:
        raise FileFormatError(
            f"section {section.title!r} cannot be made: {type(error).__name__}: {error}; the result holds "
            "notes that no run writes"
        ) from error
    return f"<section><h2>{escape(section.title)}</h2>\n{content}</section>" if content else ""


def compose(*, title: str, lead: str, sections: Iterable[Section[Subject]], subject: Subject) -> str:
    """A page as `page.html` lays it out, with everything inside: nothing outside it is needed.

    Parameters
    ----------
    title : Heading, escaped here.
    lead : HTML below it.
    subject
        What they are about.

    Raises FileFormatError if a subject holds what its own program never writes, such as notes that are no
    JSON.
    """
    parts = [lead, *(_block(section, subject) for section in sections)]
    content = "\n".join(part for part in parts if part)
    return PAGE.substitute(title=escape(title), generator=GENERATOR, content=content)


def embedded(data: bytes, title: str, caption: str) -> str:
    """A PNG with a caption; its bytes become part of the page."""
    coded, head = base64.b64encode(data).decode("ascii"), escape(title)
    words = f"<figcaption><strong>{head}.</strong> {escape(caption)}</figcaption>"
    return f'<figure><img alt="{head}" src="data:image/png;base64,{coded}">{words}</figure>'


def drawn(figure: Figure, title: str, caption: str) -> str:
    """A Matplotlib figure with a caption."""
    image = io.BytesIO()
    figure.savefig(image, format="png", dpi=DOTS_PER_INCH)
    return embedded(image.getvalue(), title, caption)


def picture_block(picture: Picture) -> str:
    """A figure that is on disk.

    Raises OSError if its image cannot be read.
    """
    source = "" if picture.data is None else f" Data: {picture.data.name}."
    return embedded(picture.image.read_bytes(), picture.title, f"{picture.caption}{source}")


def cards(values: Mapping[str, tuple[str, bool | None]]) -> str:
    """Large numbers by what they are, each good, bad or neither."""
    colour = {None: "", True: " good", False: " bad"}
    boxes = "".join(
        f'<div class="card{colour[good]}">{escape(name)}<strong>{escape(text)}</strong></div>'
        for name, (text, good) in values.items()
    )
    return f'<div class="cards">{boxes}</div>'


def note(text: str) -> str:
    """A small remark."""
    return f'<p class="note">{escape(text)}</p>'


def _glance(result: Result) -> str:
    """The numbers that are asked for first, and whether the run may be trusted."""
    end = f"{float(result.stats['simulated_s']):g} s"
    told: Cards = {"Simulated": (end, False if result.interrupted else None)}
    for part in (_hook_loads, _largest, _roll, _contact, _limits_held, _utilisation, _trust):
        told |= part(result)
    return cards(told)


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
    judged = [bound.held for bound in judged_bounds(result) if bound.held is not None]
    broken = judged.count(False)
    words = f"{broken} of {len(judged)} not held" if broken else f"all {len(judged)} held"
    return {"Limits": (words, not broken)} if judged else {}


def _contact(result: Result) -> Cards:
    known = [one for one in contact_loads(result) if one.peak > 0.0]
    worst = max(known, key=lambda one: one.peak, default=None)
    if worst is None:
        return {}
    return {"Hardest press of a contact": (f"{worst.peak / 1e3:.4g} kN, {worst.point}", None)}


def _utilisation(result: Result) -> Cards:
    known = [state for state in result.utilisation if state.kept is not None]
    worst = max(known, key=lambda state: state.utilisation, default=None)
    if worst is None:
        return {}
    return {"Largest utilisation": (f"{worst.utilisation:.2f}, {worst.name}", worst.kept)}


def _trust(result: Result) -> Cards:
    checks = [good for good in (joints_closed(result), energy_balanced(result)) if good is not None]
    count = len(findings_of(result))
    told: Cards = {"Warnings": (str(count) if count else "none", not count)}
    if checks:
        told["Numerical checks"] = ("passed" if all(checks) else "not passed", all(checks))
    return told


def _summary(result: Result) -> str:
    told = replace(summary(result), contacts=NO_CONTACTS)
    return told.html() if told or told.utilisation else ""


def _statistics(result: Result) -> str:
    found, left_out = statistics_of(result)
    if not found and not left_out:
        return ""
    start, end = result.time[0], result.time[-1]
    words = (
        f"Over the outputs from {start:g} to {end:g} s. Reactions are sizes of the joint's force and moment."
    )
    if left_out:
        words += f" {left_out} curves that are zero up to rounding are left out."
    return table_of(STATISTICS_HEAD, found, form=".4g", remarks=[words]).html()


def _sheets(result: Result) -> str:
    """The lift sheet of each load with factors, or on a rope whose breaking load is known."""
    sheets = "".join(_sheet(result, load) for load in _rated_loads(result))
    return sheets + note(SHEET_NOTE) if sheets else ""


def _rated_loads(result: Result) -> list[str]:
    try:
        scene = result.scene
    except SeacraneError:
        return []
    if scene is None:
        return []
    hung = [one.load for one in hung_loads(scene)]
    return list(dict.fromkeys([*(one for one in scene.lift_factors if one in hung),
                               *(hung if scene.ratings else ())]))  # fmt: skip


def _sheet(result: Result, load: str) -> str:
    try:
        return lift_sheet(result, load=load).html()
    except SeacraneError as error:
        return note(f"No sheet of {load}: {error}.")


def _contacts(result: Result) -> str:
    told = contact_loads(result)
    return told.html() + note(CONTACT_NOTE) if told else ""


def _tensions(result: Result) -> str:
    held = [name for name in TENSIONS if name in result.channels]
    caption = "Hook loads, lines and limits over time; triangles mark the largest and the smallest value."
    return drawn(draw(history_sheet(result, *held)), "Tension", caption) if held else ""


def _histories(result: Result) -> str:
    """Where anything but the body positions, which only payloads show, is drawn."""
    shown = set(PANELS) & set(result.channels)
    if not (shown - {"position"} or (shown and payload_bodies(result))):
        return ""
    caption = (
        "What was recorded over time; triangles mark the largest and the smallest value. What is zero up to "
        "rounding is left out."
    )
    return drawn(draw(overview_sheet(result)), "Histories", caption)


def _track(result: Result) -> str:
    if "position" not in result.channels or not payload_bodies(result):
        return ""
    return drawn(draw_track(result), "Payload", "Track of the centre of mass in inertial axes.")


def _scene(result: Result) -> str:
    if not outlined_skeleton(result):
        return ""
    caption = (
        f"First ({result.time[0]:g} s) and last ({result.time[-1]:g} s) recorded pose, inertial axes. Bodies "
        "are lines through their joints; ships have the length and breadth of their radii of gyration, boxes "
        "the inertia of their bodies."
    )
    return drawn(plot_scene(result), "Scene", caption)


def _page(result: Result) -> str:
    if result.kept_scene is None or not all(name in result.channels for name in POSES):
        return ""
    words = "Space plays and pauses, the mouse turns and zooms. The caption of the page tells what is drawn."
    return f'<div class="screen">{view(result)._repr_html_()}<p class="note">{words}</p></div>'


SECTIONS: tuple[Section[Result], ...] = (
    Section("At a glance", _glance),
    Section("Summary", _summary),
    Section("Lift sheet", _sheets),
    Section("Particulars", particulars),
    Section("Scene", _scene),
    Section("In three dimensions", _page),
    Section("Hook load and tension", _tensions),
    Section("Limits", limits),
    Section("Contacts", _contacts),
    Section("Statistics", _statistics),
    Section("Histories", _histories),
    Section("Payload track", _track),
    Section("Events", events),
    Section("Warnings", warned),
    Section("Checks", checked),
    Section("Cost", cost),
    Section("Provenance", provenance),
)
