"""What a state is of, by its parts; one from before an input was there has zero for it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from seacrane import _core
from seacrane.errors import FileFormatError

LATER = ".reference_rate"  # of actuators, since 0.2


def require_parts(path: Path, parts: list[str], model: _core.Model) -> None:
    """Raise FileFormatError where a file's `State.parts` are those of another model; none: not known."""
    own = _core.initial_state(model).parts
    if not parts or parts == own or is_older(parts, model):
        return
    count = max(len(parts), len(own))
    padded = [[*some, *["nothing more"] * (count - len(some))] for some in (parts, own)]
    there, here = next(pair for pair in zip(*padded, strict=True) if pair[0] != pair[1])
    raise FileFormatError(
        f"{path}: is the state of another scene: it holds {there[:80]} where the scene has {here}; give a "
        "state of this scene"
    )


def is_older(parts: list[str], model: _core.Model) -> bool:
    """Whether a state of these `State.parts` is of this model, but for inputs that it does not have yet."""
    own = _core.initial_state(model).parts
    count = sum(count for name, _, count in model.inputs if not name.endswith(LATER))
    return parts != own and parts == [*own[:-1], f"inputs of {count} numbers"]


def with_present_inputs(state: _core.State, model: _core.Model) -> _core.State:
    """The state with zeros for the inputs that it does not have yet; itself where it has them all."""
    if not is_older(state.parts, model):
        return state
    begun = _core.initial_state(model)
    inputs = np.array(begun.inputs)
    older = [slot + i for name, slot, n in model.inputs if not name.endswith(LATER) for i in range(n)]
    inputs[older] = state.inputs
    return _core.State(
        time=state.time, values=state.values, inputs=inputs, histories=state.histories, steps=state.steps,
        closed=state.closed, record=state.record, parts=begun.parts,
    )  # fmt: skip
