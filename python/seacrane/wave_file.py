"""A sea and its loads in a scene file."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.plain_data import notes_from_node, plain_data
from seacrane.scene_node import Node
from seacrane.waves import ByHeading, Waves

_ARRAYS = {"omega": (-1,), "amplitude": (-1,), "phase": (-1,), "direction": (-1,), "position": (2,)}
_TRANSFER = ("transfer_real", "transfer_imaginary")
# Entries that older files do not have.
_ADDED_LATER: dict[str, Any] = {
    "evaluation": "table",
    "force_by_heading": None,
    "drift": None,
    "drift_by_heading": None,
    "negligible": 1e-9,
}


def waves_to_data(waves: Waves) -> dict[str, Any]:
    """As plain data."""
    transfer = np.asarray(waves.transfer, dtype=complex)
    out: dict[str, Any] = {"body": waves.body, "relative_bound": float(waves.relative_bound)}
    out["depth"] = None if waves.depth == math.inf else float(waves.depth)
    out["evaluation"], out["negligible"] = waves.evaluation, float(waves.negligible)
    out |= {key: np.asarray(getattr(waves, key), dtype=float).tolist() for key in _ARRAYS}
    out |= {"transfer_real": transfer.real.tolist(), "transfer_imaginary": transfer.imag.tolist()}
    force, drift = waves.force_by_heading, waves.drift_by_heading
    if force is not None:
        values = np.asarray(force.values, dtype=complex)
        parts = {"real": values.real.tolist(), "imaginary": values.imag.tolist()}
        out["force_by_heading"] = {"heading": np.asarray(force.heading).tolist(), **parts}
    if waves.drift is not None:
        out["drift"] = np.asarray(waves.drift, dtype=float).tolist()
    if drift is not None:
        heading, values = np.asarray(drift.heading), np.asarray(drift.values, dtype=float)
        out["drift_by_heading"] = {"heading": heading.tolist(), "real": values.tolist()}
    out["information"] = plain_data("waves: information", waves.information)
    return {**_ADDED_LATER, **out}


def waves_from_node(node: Node) -> Waves:
    """What `waves_to_data` wrote; raises FileFormatError."""
    if isinstance(node.value, dict):
        node = Node({**_ADDED_LATER, **node.value}, node.path)
    node.expect(("body", "relative_bound", "depth", *_ARRAYS, *_TRANSFER, *_ADDED_LATER, "information"))
    depth, drift = node.at("depth"), node.at("drift")
    count = len(node.at("omega").items())
    real, imaginary = (node.at(key).array((count, 6)) for key in _TRANSFER)
    values = {
        key: node.at(key).array((count,) if shape == (-1,) else shape) for key, shape in _ARRAYS.items()
    }
    position = values.pop("position").tolist()
    return Waves(
        body=node.at("body").text(),
        transfer=_complex(real, imaginary),
        position=(position[0], position[1]),
        relative_bound=node.at("relative_bound").number(),
        depth=math.inf if depth.value is None else depth.number(),
        evaluation=node.at("evaluation").text(),
        negligible=node.at("negligible").number(),
        force_by_heading=_by_heading(node.at("force_by_heading"), count, complex_values=True),
        drift=None if drift.value is None else drift.array((count, 6)),
        drift_by_heading=_by_heading(node.at("drift_by_heading"), count, complex_values=False),
        information=notes_from_node(node.at("information")),
        **values,
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
