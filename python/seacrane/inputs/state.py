"""State files: everything a run needs to continue, as plain numbers. Reading one runs no code.

A file is the line "seacrane state", a line of JSON (the header), the arrays that the header lists as
little-endian doubles, one after the other, and the SHA-256 of all before.
"""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.errors import FileFormatError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.file_version import FILE_VERSION, require_file_version
from seacrane.inputs.shown import shown

MAGIC = b"seacrane state\n"
DIGEST = hashlib.sha256().digest_size
LARGEST_FILE = 2**30  # bytes: a million states take less
_RECORD = ("start_energy", "start_work", "residual", "impact_loss")
_EXTREMES = "extremes"  # an array that may hold what is not finite: there was none
_KINK = "kink"  # an array of states that have one


class Compilable(Protocol):
    """A `seacrane.Scene`, as far as a state needs one."""

    def compile(self) -> _core.Model:
        """The scene in the form that is stepped."""


def save_state(state: _core.State, path: str | os.PathLike[str]) -> None:
    """Write a state: complete under its name, or not at all.

    Raises FileExistsError where another kind of file, such as a result, has the name, and OSError where it
    cannot be written; an older file of that name stays.
    """
    path = Path(path)
    if path.is_file() and path.stat().st_size:
        with path.open("rb") as file:
            if file.read(len(MAGIC)) != MAGIC:
                raise FileExistsError(f"{path} is there and is not a state file; give another name")
    with atomic_write(path) as draft:
        draft.write_bytes(state_to_bytes(state))


def state_to_bytes(state: _core.State) -> bytes:
    """The contents of a state file."""
    steps, record = state.steps, state.record
    arrays: dict[str, Any] = {
        "time": [state.time],
        "values": state.values,
        "inputs": state.inputs,
        "steps": steps.values,
        "rate": steps.rate,
        "record": [] if record is None else [getattr(record, name) for name in _RECORD],
        "quaternions": [] if record is None else record.quaternions,
        _EXTREMES: [] if record is None else record.extremes,
    }
    if steps.kink is not None:
        arrays[_KINK] = [steps.kink]
    for i, history in enumerate(state.histories):
        arrays |= {
            f"history {i} start": [history.start],
            f"history {i} recent": history.recent,
            f"history {i} quadrature": history.quadrature,
        }
    flat = {name: np.asarray(values, dtype="<f8").ravel() for name, values in arrays.items()}
    header = {
        "version": FILE_VERSION,
        "formulation": steps.formulation,
        "integrator": steps.integrator,
        "parts": state.parts,
        "closed": state.closed,
        "intervals": [history.intervals for history in state.histories],
        "arrays": [[name, values.size] for name, values in flat.items()],
    }
    body = b"".join(
        [MAGIC, json.dumps(header).encode("ascii"), b"\n", *(values.tobytes() for values in flat.values())]
    )
    return body + hashlib.sha256(body).digest()


def load_state(path: str | os.PathLike[str], *, scene: Compilable | None = None) -> _core.State:
    """Read what `save_state` wrote, bit for bit, for a scene that is to continue from it.

    Raises FileNotFoundError, and FileFormatError for what is not a state file, is truncated or damaged, is of
    another version, or belongs to a scene of other bodies, memory or inputs.
    """
    path = Path(path)
    if not path.is_file():
        raise FileNotFoundError(f"no state file {path}")
    size = path.stat().st_size
    if size > LARGEST_FILE:
        raise FileFormatError(f"{path}: has {size} bytes, a state file no more than {LARGEST_FILE}")
    state = state_from_bytes(path.read_bytes(), path)
    if scene is not None:
        require_parts(path, state.parts, scene.compile())
    return state


def state_from_bytes(data: bytes, path: Path) -> _core.State:
    """What `state_to_bytes` made, found in a file; raises FileFormatError."""
    if not data.startswith(MAGIC):
        raise FileFormatError(f"{path}: is not a state file; give one that State.save wrote")
    body, digest = memoryview(data)[:-DIGEST], data[-DIGEST:]
    if hashlib.sha256(body).digest() != digest:
        raise FileFormatError(
            f"{path}: is truncated or damaged (its checksum does not fit); go on from an older state"
        )
    end = data.find(b"\n", len(MAGIC)) + 1
    try:
        header = json.loads(data[len(MAGIC) : end])
        require_file_version(path, header.get("version"))
        counts = [count for _, count in header["arrays"]]
        numbers = np.frombuffer(body, "<f8", offset=end).astype(np.float64)
        if sum(counts) != numbers.size:
            raise ValueError(f"arrays of {sum(counts)} numbers do not fill the {numbers.size} of the file")
        split = np.split(numbers, np.cumsum(counts))
        return _state(header, {name: one for (name, _), one in zip(header["arrays"], split, strict=False)})
    except FileFormatError:
        raise
    except (LookupError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError) as error:
        raise FileFormatError(f"{path}: is not a state: {error}; save the state again") from error


def _state(header: dict[str, Any], arrays: dict[str, Array]) -> _core.State:
    for name, values in arrays.items():
        if name != _EXTREMES and not np.isfinite(values).all():
            raise ValueError(f"{shown(name)} holds a value that is not finite")
    record = None
    if arrays["record"].size:
        numbers = dict(zip(_RECORD, arrays["record"], strict=True))
        record = _core.RecordHistory(quaternions=arrays["quaternions"], extremes=arrays[_EXTREMES], **numbers)
    return _core.State(
        time=_one(arrays["time"]),
        values=arrays["values"],
        inputs=arrays["inputs"],
        histories=[
            _core.TwistHistory(
                start=_one(arrays[f"history {i} start"]),
                intervals=count,
                recent=arrays[f"history {i} recent"].reshape(3, 6),
                quadrature=arrays[f"history {i} quadrature"].reshape(-1, 6),
            )
            for i, count in enumerate(header["intervals"])
        ],
        steps=_core.StepHistory(
            formulation=header["formulation"], integrator=header["integrator"],
            values=arrays["steps"], rate=arrays["rate"],
            kink=_one(arrays[_KINK]) if _KINK in arrays else None,
        ),
        closed=header["closed"],
        record=record,
        parts=header["parts"],
    )  # fmt: skip


def _one(values: Array) -> float:
    (value,) = values
    return float(value)


def require_parts(path: Path, parts: list[str], model: _core.Model) -> None:
    """Raise FileFormatError where a file's `State.parts` are those of another model; none: not known."""
    own = _core.initial_state(model).parts
    if not parts or parts == own:
        return
    count = max(len(parts), len(own))
    padded = [[*some, *["nothing more"] * (count - len(some))] for some in (parts, own)]
    there, here = next(pair for pair in zip(*padded, strict=True) if pair[0] != pair[1])
    raise FileFormatError(
        f"{path}: is the state of another scene: it holds {there[:80]} where the scene has {here}; give a "
        "state of this scene"
    )
