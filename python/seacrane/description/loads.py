"""Loads of every kind, by the FIELDS of their classes.

A new kind of load is its C++ file with an entry in `elements/loads/registry.hpp`, and nothing here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.errors import SceneError

LOAD_KINDS: Mapping[str, type] = _core.LOAD_KINDS
Some = TypeVar("Some")
BEYOND = 1e5  # m: springs to such ends stand for a direction


def kind_of(element: Any) -> str:
    """The kind of a described load; raises SceneError for anything else."""
    for name, kind in LOAD_KINDS.items():
        if isinstance(element, kind):
            return name
    known = ", ".join(kind.__name__ for kind in LOAD_KINDS.values())
    raise SceneError(f"load {element!r} is of no known kind; give one of {known}")


def make_load(kind: str, entries: Mapping[str, Any]) -> Any:
    """A load of a kind from its entries; an entry "kind" of its own goes by the kind's name, as in files."""
    if kind not in LOAD_KINDS:
        raise SceneError(f"load: kind {kind!r} is unknown; choose one of {', '.join(LOAD_KINDS)}")
    return LOAD_KINDS[kind](**{"kind" if key == kind else key: value for key, value in entries.items()})


def named(element: Any, role: str) -> list[str]:
    """Texts of an element that name a "body", a "joint" or a "coordinate", in order."""
    found = [getattr(element, field.name) for field in type(element).FIELDS if field.role == role]
    return [text for texts in found for text in ([texts] if isinstance(texts, str) else texts)]


def changed(element: Some, **entries: Any) -> Some:
    """An element of the core with other entries."""
    return type(element)(**element.__getstate__() | entries)  # type: ignore[operator]


def lines_of(loads: Mapping[str, Any]) -> dict[str, _core.Line]:
    """The elastic lines among loads."""
    return {name: load for name, load in loads.items() if isinstance(load, _core.Line)}


def winch_of(line: _core.Line) -> str:
    """The name of the winch that pays a line out, its own or that of its line with mass; empty: none."""
    return line.paid_out_by or (line.name if line.winch else "")


def winches_of(loads: Mapping[str, Any]) -> dict[str, _core.Line]:
    """The lines that winches act on, by the winches' names; of a line with mass its first segment."""
    return {winch_of(line): line for line in lines_of(loads).values() if line.winch}


def on_winch(lines: Mapping[str, _core.Line], line: _core.Line) -> _core.Line | None:
    """The line with the winch that pays a line out: itself, or the first segment of its line with mass."""
    if line.winch or not line.paid_out_by:
        return line if line.winch else None
    return next(one for one in lines.values() if one.winch and one.paid_out_by == line.paid_out_by)


def length_at(line: _core.Line, time: float, states: Mapping[str, float]) -> float:
    """The unstretched length of a line, m: at a time (s), or on a winch with its state, if that is known."""
    paid_out = states.get(f"{winch_of(line)}.length")
    if paid_out is None:
        return float(line.length.evaluate([time])[0, 0])
    return float(line.share * paid_out)


def states_of(model: _core.Model, values: NDArray[np.float64]) -> dict[str, float]:
    """The states of loads among all values of a state, by name."""
    return {name: float(values[place]) for name, _, place, *_ in model.load_states}


def with_length(loads: Mapping[str, Any], winch: str, length: float) -> dict[str, _core.Line]:
    """What a winch pays out, one line or all segments of one with mass, for a whole length, m."""
    return {
        name: changed(line, length=line.share * length)
        for name, line in lines_of(loads).items()
        if winch_of(line) == winch
    }


def any_stiff(loads: Mapping[str, Any]) -> bool:
    """Whether loads have states of their own that would bind the steps of explicit methods."""
    return any(type(load).STIFF for load in loads.values())


def without_compensation(loads: Mapping[str, Any]) -> dict[str, Any]:
    """Loads without the heave compensators that actuators follow."""
    return {
        name: load
        for name, load in loads.items()
        if not (isinstance(load, _core.HeaveCompensator) and load.actuator)
    }


def drawn_springs(loads: Iterable[Any]) -> list[Any]:
    """Loads that are drawn as springs, but for those with an end beyond any view, as moorings have."""
    drawn = [load for load in loads if type(load).DRAWN == "spring"]
    return [load for load in drawn if np.abs([load.first_point, load.second_point]).max() < BEYOND]


def holding_loads(loads: Iterable[Any]) -> list[Any]:
    """Loads between two bodies that carry a weight, and hold the drive of a joint between the two."""
    return [load for load in loads if type(load).HOLDS]


def whole_of(name: str, line: _core.Line) -> str:
    """The line with mass that one is a segment of; else its own name."""
    whole, _, number = name.rpartition(".")
    tied = any(body.startswith(f"{whole}.") for body in line.bodies)
    return whole if number.isdigit() and whole and tied else name


def refuse_winch_of_segment(line: _core.Line) -> None:
    """Raise SceneError for a winch of its own on a segment of a line with mass."""
    whole = whole_of(line.name, line)
    if whole != line.name:
        raise SceneError(
            f"line {line.name!r}: is a segment of line {whole!r}, and what a winch of its own pays out would "
            f"have no mass, so that it would carry too little. Give the winch to the whole line: "
            f"add_winch({whole!r}, ...)"
        )


def path_of(line: _core.Line) -> list[tuple[str, Any]]:
    """Body and point (m, its coordinates) of each point of a line, in their order."""
    return list(zip(line.bodies, line.points, strict=True))


def joint_ends(joint: _core.Joint) -> tuple[tuple[str, Any], tuple[str, Any]]:
    """Body and point (m, its coordinates) of both sides of a joint."""
    return (joint.first, joint.first_frame.point), (joint.second, joint.second_frame.point)


def bodies_of(element: Any, joints: Mapping[str, _core.Joint]) -> list[str]:
    """The bodies that an element concerns: those it names, and those of the joints it names."""
    held = [joints[name] for name in named(element, "joint") if name in joints]
    ends = [body for joint in held for body in (joint.first, joint.second)]
    return list(dict.fromkeys([*named(element, "body"), *ends]))
