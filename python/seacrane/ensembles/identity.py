"""What tells a study from another: two of the same identity have the same results."""

from __future__ import annotations

import hashlib
import inspect
import json
from collections.abc import Callable
from dataclasses import asdict, is_dataclass
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.file import scene_digest
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import Members
from seacrane.ensembles.stage_values import Stages
from seacrane.ensembles.study import Study
from seacrane.run.stage import Stage
from seacrane.scene.scene import Scene
from seacrane.version import __version__


def identity_of(study: Study, members: Members, pack: int) -> dict[str, Any]:
    """Plain data, equal only for studies whose members have the same results.

    The scenes of the first and the last member stand for what a function uses beyond its own text.
    """
    source = study.source
    begun = {} if study.start is None else {"start": _start(study, members)}
    return begun | {
        "version": __version__,
        "scene": scene_digest(source) if isinstance(source, Scene) else _function(source),
        "first and last member": [_scene(study, members, place) for place in (0, len(members) - 1)],
        "over": _digest([members.grid, *members.axes.items()]),
        "members": len(members),
        "members in a pack": pack,
        "lanes": study.lanes,
        **({"stages": _stages(study.stages)} if study.stages else {}),
        "t_end": None if study.stages else study.t_end,
        "method": _text(asdict(study.method)),
        "outputs": _text(asdict(study.outputs)),
        "keep": {
            name: _text(asdict(what)) if isinstance(what, Kept) else _function(what)
            for name, what in study.keep.items()
        },
    }


def _stages(stages: Stages) -> str:
    """A text that is equal for stages that are the same."""
    return _function(stages) if callable(stages) else _digest([_stage(one) for one in stages])


def _stage(stage: Stage) -> list[Any]:
    plain = {
        what: one.to_pieces() if isinstance(one, _core.Curve) else asdict(one) if is_dataclass(one) else one
        for what, one in stage.commands.items()
    }
    commands = json.dumps(plain, sort_keys=True, default=lambda array: np.asarray(array).tolist())
    ends = [condition.text for condition in stage.conditions]
    return [
        stage.name,
        stage.duration,
        stage.maximum_duration,
        ends,
        commands,
        [*stage.connect],
        [*stage.release],
    ]


def _start(study: Study, members: Members) -> str:
    """The start of the first member, which stands for what a function makes of the others."""
    try:
        state = study.start_of(study.scene(members.values(0)))
    except Exception as error:  # its failure is recorded when it is run
        return f"{type(error).__name__}: {error}"
    assert state is not None
    return _digest([state.time, *np.asarray(state.values).tolist()])


def _scene(study: Study, members: Members, place: int) -> str:
    try:
        return scene_digest(study.scene(members.values(place)))
    except Exception as error:  # its failure is recorded when it is run
        return f"{type(error).__name__}: {error}"


def _function(function: Callable[..., Any]) -> str:
    """Its name and a digest of its text, or of its code where it has none; of a dataclass its entries."""
    if is_dataclass(function) and not isinstance(function, type):
        return f"{type(function).__module__}.{type(function).__qualname__} {_text(asdict(function))}"
    name = (
        f"{getattr(function, '__module__', '')}.{getattr(function, '__qualname__', type(function).__name__)}"
    )
    try:
        return f"{name} {_digest(inspect.getsource(function))}"
    except (OSError, TypeError):
        code = getattr(function, "__code__", None)
        return f"{name} {_digest([code.co_code.hex(), repr(code.co_names)]) if code else ''}"


def _text(data: dict[str, Any]) -> str:
    return json.dumps(data, sort_keys=True, default=str)


def _digest(data: Any) -> str:
    return hashlib.sha256(json.dumps(data).encode()).hexdigest()[:16]
