"""phase_sheet(): the seas that each phase of an operation allows, and which of them governs."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal

from seacrane.description.pick import Pick
from seacrane.ensembles.object_store import folder_of
from seacrane.ensembles.parts import part_of
from seacrane.ensembles.price import Priced
from seacrane.ensembles.study import Stages
from seacrane.errors import SceneError
from seacrane.inputs.checked import not_negative_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.inputs.values import listed_of
from seacrane.operability.allowable import HEIGHTS, LINEAR_WITHIN, allowable_cells
from seacrane.operability.allowable_table import AllowableHs
from seacrane.operability.alpha import AlphaFactor, alpha_of
from seacrane.operability.criterion import Criterion
from seacrane.operability.phase import Phase, Span, legs_of
from seacrane.operability.phase_table import PhaseSheet
from seacrane.run.channel_names import require_curves
from seacrane.run.method import Method, Shorthand
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack

PASSAGES = "passages"  # their folder in that of a load case


@named
def phase_sheet(
    scene: Scene | Mapping[str, Scene],
    *,
    phases: Sequence[Phase],
    criteria: Sequence[Criterion],
    tp: Any,
    direction_deg: Any,
    hs: Any = HEIGHTS,
    stages: Stages = (),
    alpha: AlphaFactor | float = 1.0,
    lead_hours: float = 0.0,
    domain: Literal["auto", "frequency", "time"] = "auto",
    linear_within: float = LINEAR_WITHIN,
    seeds: Sequence[int] = tuple(range(1, 21)),
    until: float | None = None,
    duration: float | None = None,
    start_up: float | None = None,
    executor: Executor | None = None,
    store: str | os.PathLike[str] | None = None,
    method: Method | None = None,
    accuracy: Mapping[str, float] | None = None,
    part: tuple[int, int] | str | None = None,
    priced: Priced | None = None,
    progress: bool = False,
    **shorthand: Unpack[Shorthand],
) -> PhaseSheet:
    """Find the largest Hs of each phase of an operation, the criterion and the phase that govern.

    Each stationary phase is asked as `allowable_hs` is, with its planned hours as the exposure time. All
    passages of a load case are told by the same runs of its lift in stages.

    Parameters
    ----------
    scene : Scene or mapping of str to Scene
        One, or load cases by name: loads, rigs or vessels side by side.
    phases : sequence of Phase
        In their order.
    criteria : sequence of Criterion
        Each counts in every phase, or with `stage` in the phase, or the stage of a passage, of that name.
        Without an exposure time it is that of the phase. In a passage the P90 over seeds counts, whatever its
        statistic.
    tp, direction_deg, hs
        As of `allowable_hs`.
    stages : sequence of Stage, or callable
        The lift, of which passages are stages.
    alpha : AlphaFactor
        By the reference period of each phase: hours from the issue of the forecast to the end of the phase,
        planned ones and contingency. A point of safe return waits for another forecast.
    lead_hours : float
        From the issue of the forecast to the start, h.
    seeds : sequence of int
        Of runs, at least 3; default 20.
    until : float, optional
        As of `allowable_hs`: seeds end where a phase is known so well.
    domain, linear_within, duration, start_up
        As of `allowable_hs`, of stationary phases.
    executor, store, method, accuracy, progress, **shorthand
        As of `allowable_hs`; the store has a folder for each load case and phase. A sheet that was stopped
        goes on.
    part : (int, int) or str, optional
        Of the runs those of one part of so many alone, (3, 40) or "3/40": of every n-th sea all Hs and seeds.
        `merge_parts` makes one store of each folder; other seas are not known.
    priced : callable, optional
        As of `ensemble`, called for the runs of each stationary phase, and of the passages, of a load case.
        What is not run then is not known.

    Raises
    ------
    SceneError
        As `allowable_hs`, for a criterion of no phase, a phase without criteria, or a passage without stages;
        for a part or price of phases whose linear model is tested.
    """
    listed, factor = listed_of("phases", Phase, phases), alpha_of(alpha)
    cases = _cases(scene)
    before = not_negative_of("lead_hours", lead_hours, "h")
    if store is not None:
        _require_folders([*cases, *(phase.name for phase in listed if not phase.passage)])
    spans = [span for leg in legs_of(listed) for span in leg]
    for span in spans:
        factor.at(1.0, hours=before + span.end)
    own = _criteria_of(listed, criteria)
    passage = next((one.name for one in listed if one.passage), None)
    if passage is not None and not stages:
        raise SceneError(f"phase {passage!r} is a passage, and the lift has no stages; give stages")
    for described in cases.values():  # before any run
        for phase in listed:
            picks = [Pick(channel=one.channel, names=one.names) for one in own[phase.name]]
            require_curves(phase.scene_of(described), picks)
    shared: dict[str, Any] = {
        "tp": tp, "direction_deg": direction_deg, "hs": hs, "seeds": seeds, "until": until,
        "linear_within": linear_within, "executor": executor, "method": method, "accuracy": accuracy,
        "progress": progress, "part": None if part is None else part_of(part), "priced": priced,
        "shorthand": shorthand,
    }  # fmt: skip
    still = {"domain": domain, "duration": duration, "start_up": start_up, "stages": ()}
    moving = {"domain": "auto", "duration": None, "start_up": None, "stages": stages, "time": 0.0}
    tables: dict[tuple[str, str], AllowableHs] = {}
    for case, described in cases.items():
        folder = None if store is None else folder_of("store", store) / (case or "lift")
        if folder is not None:
            folder.mkdir(parents=True, exist_ok=True)
        for span in spans:
            if not span.phase.passage:
                one, name = span.phase.scene_of(described), span.phase.name
                asked = shared | still | {"criteria": own[name], "time": span.phase.time}
                cells, failures = allowable_cells(one, **asked, store=folder and folder / name)
                tables[case, name] = cells.table(one.name, factor, before + span.end, failures)
        passages = [span for span in spans if span.phase.passage]
        if passages:
            asked = shared | moving | {"store": folder and folder / PASSAGES}
            tables |= _passages(case, described, passages, own, factor, before, asked)
    return PhaseSheet(
        phases=listed, cases=tuple(cases), tables=tables, alpha=factor, lead_hours=before,
        name=cases[next(iter(cases))].name,
    )  # fmt: skip


def _passages(
    case: str, scene: Scene, spans: Sequence[Span], own: Mapping[str, Sequence[Criterion]],
    alpha: AlphaFactor, lead: float, asked: Mapping[str, Any],
) -> dict[tuple[str, str], AllowableHs]:  # fmt: skip
    """All passages of a load case, by the same runs."""
    every = [one for span in spans for one in own[span.phase.name]]
    places, first = {}, 0
    for span in spans:
        count = len(own[span.phase.name])
        places[span.phase.name] = range(first, first + count)
        first += count
    cells, failures = allowable_cells(scene, **asked, criteria=every, groups=list(places.values()))
    return {
        (case, span.phase.name): cells.table(
            scene.name, alpha, lead + span.end, failures, places[span.phase.name]
        )
        for span in spans
    }


def _require_folders(names: Sequence[str]) -> None:
    """Raise SceneError for a load case or phase that names no folder of its own in the store."""
    for name in names:
        if name in (".", "..", PASSAGES) or {*"/\\"} & {*name}:
            raise SceneError(
                f"store: {name!r} is no name of a folder of its own; give the load case or phase another name"
            )


def _cases(given: Any) -> dict[str, Scene]:
    """Load cases by name; one scene has none."""
    found = given if isinstance(given, Mapping) else {"": given}
    for name, one in found.items():
        if not isinstance(name, str) or not isinstance(one, Scene) or (not name and found is given):
            raise SceneError(f"scene is {shown(one)}; give a Scene, or scenes by the names of load cases")
    if not found:
        raise SceneError("scene is empty; give a Scene, or scenes by the names of load cases")
    return dict(found)


def _criteria_of(phases: Sequence[Phase], criteria: Any) -> dict[str, list[Criterion]]:
    """Criteria of each phase, over its hours, or as quantiles of each of its stages."""
    listed = list(criteria) if isinstance(criteria, Sequence) else [criteria]
    places = {place for phase in phases for place in (phase.name, *phase.stages)}
    for one in listed:
        if not isinstance(one, Criterion):
            raise SceneError(f"criteria has {shown(one)}; give a list of Criterion")
        if one.stage and one.stage not in places:
            raise SceneError(
                f"criterion {one.name!r}: there is no phase {one.stage!r}; phases are "
                + ", ".join(phase.name for phase in phases)
            )
    found = {phase.name: [made for one in listed for made in _in_phase(one, phase)] for phase in phases}
    empty = next((name for name, some in found.items() if not some), None)
    if empty is not None:
        raise SceneError(f"phase {empty!r}: no criterion is of it; give one")
    return found


def _in_phase(criterion: Criterion, phase: Phase) -> list[Criterion]:
    """The criterion as it counts in a phase; none where it is of another."""
    if criterion.stage not in ("", phase.name, *phase.stages):
        return []
    if not phase.passage:
        exposure = 3600.0 * phase.hours if criterion.exposure is None else criterion.exposure
        return [replace(criterion, stage="", exposure=exposure)]
    of = [criterion.stage] if criterion.stage in phase.stages else phase.stages
    return [_of_stage(criterion, stage) for stage in of]


def _of_stage(criterion: Criterion, stage: str) -> Criterion:
    name = criterion.name if criterion.stage == stage else f"{criterion.name} in {stage}"
    return replace(criterion, stage=stage, name=name, statistic="p90", exposure=None)
