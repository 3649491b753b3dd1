"""When elements are absent in a lift of stages, from its events."""

from __future__ import annotations

from seacrane.result.result import Result

Spans = list[list[float]]


def absences(result: Result | None) -> dict[str, Spans]:
    """Times from which and up to which elements are absent, s, by name; only those that ever are.

    What a lift connects before it releases it is absent from the start. What stages that were not run
    released (`first` of `simulate_stages`) is not known.
    """
    found: dict[str, Spans] = {}
    if result is None:
        return found
    start, end = float(result.time[0]), float(result.time[-1])
    beyond = end + max(1.0, end - start)  # the last output is within
    for event in result.events:
        if event.kind == "connection":
            spans = found.setdefault(event.name, [[start, beyond]])
            spans[-1][1] = event.time
        elif event.kind == "release" and _is_of_a_stage(result, event.time):
            found.setdefault(event.name, []).append([event.time, beyond])
    return found


def _is_of_a_stage(result: Result, time: float) -> bool:
    """Whether a stage begins then: limits have events of that kind too."""
    return any(span.start == time for span in result.stages)
