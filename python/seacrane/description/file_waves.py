"""A sea and its loads in a scene file."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.description.file_origin import sea_from_node, sea_to_data
from seacrane.description.waves import ByHeading, HullLoads, Waves
from seacrane.inputs.node import Node
from seacrane.sea.current import Current

_ARRAYS = ("omega", "amplitude", "phase", "direction")
_TRANSFER = ("transfer_real", "transfer_imaginary")
_WAVES = (
    "relative_bound", "depth", "evaluation", "negligible", "current", "stretching", *_ARRAYS, "hulls",
    "provenance",
)  # fmt: skip
_CURRENT = ("depth", "speed", "direction_deg")
_HULL = (
    "body", "position", "heading", "cutoff", *_TRANSFER, "force_by_heading", "drift", "drift_by_heading",
)  # fmt: skip


def waves_to_data(waves: Waves) -> dict[str, Any]:
    """As plain data."""
    out: dict[str, Any] = {"relative_bound": float(waves.relative_bound)}
    out["depth"] = None if waves.depth == math.inf else float(waves.depth)
    out["evaluation"], out["negligible"] = waves.evaluation, float(waves.negligible)
    current = waves.current
    out["current"] = None if current is None else {
        key: np.asarray(getattr(current, key)).tolist() for key in _CURRENT
    }  # fmt: skip
    out["stretching"] = waves.stretching
    out |= {key: np.asarray(getattr(waves, key), dtype=float).tolist() for key in _ARRAYS}
    out["hulls"] = [_hull_to_data(body, hull) for body, hull in waves.hulls.items()]
    out["provenance"] = sea_to_data(waves.provenance)
    return out


def _hull_to_data(body: str, hull: HullLoads) -> dict[str, Any]:
    transfer = np.asarray(hull.transfer, dtype=complex)
    out: dict[str, Any] = {"body": body, "position": [float(x) for x in hull.position]}
    out["heading"], out["cutoff"] = float(hull.heading), float(hull.cutoff)
    out |= {"transfer_real": transfer.real.tolist(), "transfer_imaginary": transfer.imag.tolist()}
    force, drift = hull.force_by_heading, hull.drift_by_heading
    out |= dict.fromkeys(("force_by_heading", "drift", "drift_by_heading"))
    if force is not None:
        values = np.asarray(force.values, dtype=complex)
        parts = {"real": values.real.tolist(), "imaginary": values.imag.tolist()}
        out["force_by_heading"] = {"heading": np.asarray(force.heading).tolist(), **parts}
    if hull.drift is not None:
        out["drift"] = np.asarray(hull.drift, dtype=float).tolist()
    if drift is not None:
        heading, values = np.asarray(drift.heading), np.asarray(drift.values, dtype=float)
        out["drift_by_heading"] = {"heading": heading.tolist(), "real": values.tolist()}
    return out


def waves_from_node(node: Node) -> Waves:
    """What `waves_to_data` wrote; raises FileFormatError."""
    node.expect(_WAVES)
    depth, count = node.at("depth"), len(node.at("omega").values())
    hulls: dict[str, HullLoads] = {}
    for entry in node.at("hulls").items():
        entry.expect(_HULL)
        body = entry.at("body").text()
        if body in hulls:
            entry.at("body").fail("is in the list twice; give every vessel once")
        hulls[body] = _hull_from_node(entry, count)
    arrays: dict[str, Any] = {key: node.at(key).array((count,)) for key in _ARRAYS}
    return Waves(
        depth=math.inf if depth.value is None else depth.number(),
        relative_bound=node.at("relative_bound").number(),
        evaluation=node.at("evaluation").text(),
        negligible=node.at("negligible").number(),
        current=_current_from_node(node.at("current")),
        stretching=node.at("stretching").text(),
        provenance=sea_from_node(node.at("provenance")),
        hulls=hulls,
        **arrays,
    )


def _current_from_node(node: Node) -> Current | None:
    if node.value is None:
        return None
    node.expect(_CURRENT)
    return Current(**{key: node.at(key).array((-1,)) for key in _CURRENT})


def _hull_from_node(node: Node, count: int) -> HullLoads:
    drift, position = node.at("drift"), node.at("position").array((2,)).tolist()
    return HullLoads(
        transfer=_complex(*(node.at(key).array((count, 6)) for key in _TRANSFER)),
        position=(position[0], position[1]),
        heading=node.at("heading").number(),
        force_by_heading=_by_heading(node.at("force_by_heading"), count, complex_values=True),
        drift=None if drift.value is None else drift.array((count, 6)),
        drift_by_heading=_by_heading(node.at("drift_by_heading"), count, complex_values=False),
        cutoff=node.at("cutoff").number(),
    )


def _by_heading(node: Node, count: int, *, complex_values: bool) -> ByHeading | None:
    if node.value is None:
        return None
    parts = ("real", "imaginary") if complex_values else ("real",)
    node.expect(("heading", *parts))
    heading = node.at("heading").array((-1,))
    values = [node.at(part).array((len(heading), count, 6)) for part in parts]
    return ByHeading(heading=heading, values=_complex(*values) if complex_values else values[0])


def _complex(real: NDArray[np.float64], imaginary: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Without arithmetic, which would lose the sign of a zero."""
    out = np.empty(real.shape, dtype=complex)
    out.real, out.imag = real, imaginary
    return out
