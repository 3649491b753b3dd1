"""The folder of one study: what tells it from another, of the same results, and one writer at a time."""

from __future__ import annotations

import contextlib
import hashlib
import inspect
import json
import math
import os
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import asdict, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.members import Members
from seacrane.ensembles.study import Study
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write, is_draft, remove_all
from seacrane.inputs.file_version import FILE_VERSION, require_file_version
from seacrane.inputs.json_text import json_of
from seacrane.inputs.sole_writer import claim, opened
from seacrane.inputs.whole_file import read_whole
from seacrane.run.stage import Stage
from seacrane.scene.file import scene_digest
from seacrane.scene.scene import Scene
from seacrane.version import __version__

STUDY, LOCK = "study.json", "writer.lock"
FORMAT = "seacrane-ensemble"
OURS = re.compile(r"study\.json|pack_\d+\.nc")
LARGEST_STUDY = 256 * 2**20  # bytes; a million members of a few parameters


@contextlib.contextmanager
def claimed(path: str | os.PathLike[str], study: Mapping[str, Any]) -> Iterator[Path]:
    """The folder of a study, made where it is not there, for one writer at a time; its parent must exist.

    The study is plain data: "identity", and what is needed to read the folder later. SceneError if the folder
    holds another one, or something else; FileExistsError if another process writes it.
    """
    folder = Path(path)
    if not folder.parent.is_dir():
        raise SceneError(f"store {str(folder)!r}: there is no folder {folder.parent}; create it first")
    if folder.suffix == ".zarr":
        raise SceneError(
            f"store {str(folder)!r}: is a folder of NetCDF files; give another name, and export what it "
            f"holds: Ensemble.load(folder).dataset.to_zarr({folder.name!r})"
        )
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"store {str(folder)!r} is a file; give the name of a folder")
    others = (one for one in folder.rglob("*") if one.name != LOCK and not is_draft(one))
    if not (folder / STUDY).exists() and any(not one.is_dir() for one in others):
        raise SceneError(f"store {str(folder)!r} holds something else than an ensemble; give another folder")
    folder.mkdir(exist_ok=True)
    lock = opened(folder / LOCK)
    try:
        if not claim(lock):
            raise FileExistsError(
                f"store {str(folder)!r}: another process is writing it; wait, or give another"
            )
        remove_all(folder, OURS)
        require_same(folder, study)
        yield folder
    finally:
        os.close(lock)


def study_in(folder: Path) -> dict[str, Any]:
    """What a folder says that it is. Raises FileFormatError."""
    path = folder / STUDY
    if not path.is_file():
        raise FileFormatError(f"{folder}: is no ensemble, it has no {STUDY}")
    data = json_of(read_whole(path, LARGEST_STUDY, "it is no study of ours"), str(path))
    if not isinstance(data, dict) or data.get("format") != FORMAT:
        raise FileFormatError(f'{path}: is no study, it has no "format": "{FORMAT}"')
    require_file_version(path, data.get("version"))
    return data


def require_same(folder: Path, study: Mapping[str, Any]) -> None:
    """Write what the folder is, or refuse a folder of another study."""
    if not (folder / STUDY).exists():
        write_study(folder, {"format": FORMAT, "version": FILE_VERSION, **study})
        return
    there = study_in(folder).get("identity", {})
    here = study["identity"]
    other = [key for key in {**here, **there} if there.get(key) != here.get(key)]
    if other:
        raise SceneError(
            f"store {str(folder)!r} is of another study: {', '.join(other)} differ; give another folder, or "
            f"remove this one ({other[0]}: {str(there.get(other[0]))[:80]} there, "
            f"{str(here.get(other[0]))[:80]} here)"
        )


def identity_of(study: Study, members: Members, pack: int) -> dict[str, Any]:
    """Plain data, equal only for studies whose members have the same results.

    The scenes of the first and the last member stand for what a function uses beyond its own text.
    """
    source, given = study.source, study.stages
    stages = _function(given) if callable(given) else _digest([_stage(one) for one in given])
    begun = {} if study.start is None else {"start": _told(_start, study, members)}
    return begun | {
        "version": __version__,
        "scene": scene_digest(source) if isinstance(source, Scene) else _function(source),
        "first and last member": [_told(_scene, study, members, place) for place in (0, len(members) - 1)],
        "over": _digest([members.grid, *members.axes.items()]),
        "members": len(members),
        "members in a pack": pack,
        "lanes": study.lanes,
        **({"stages": stages} if study.stages else {}),
        **({"member_limit": study.member_limit} if study.member_limit < math.inf else {}),
        "t_end": None if study.stages else study.t_end,
        "method": _text(asdict(study.method)),
        "outputs": _text(asdict(study.outputs)),
        "keep": {
            name: _text(asdict(what)) if isinstance(what, Kept) else _function(what)
            for name, what in study.keep.items()
        },
    }


def write_study(folder: Path, data: Mapping[str, Any]) -> None:
    """Write what a folder is."""
    with atomic_write(folder / STUDY, tidy=False) as draft:
        draft.write_text(json.dumps(data), encoding="utf-8")


def _stage(stage: Stage) -> list[Any]:
    plain = {
        what: one.to_pieces() if isinstance(one, _core.Curve) else asdict(one) if is_dataclass(one) else one
        for what, one in stage.commands.items()
    }
    commands = json.dumps(plain, sort_keys=True, default=lambda array: np.asarray(array).tolist())
    ends = [condition.text for condition in stage.conditions]
    spans = [stage.name, stage.duration, stage.maximum_duration]
    return [*spans, ends, commands, [*stage.connect], [*stage.release]]


def _start(study: Study, members: Members) -> str:
    """The start of the first member, which stands for what a function makes of the others."""
    state = study.start_of(study.scene(members.values(0)))
    assert state is not None
    return _digest([state.time, *np.asarray(state.values).tolist()])


def _scene(study: Study, members: Members, place: int) -> str:
    return scene_digest(study.scene(members.values(place)))


def _told(made: Callable[..., str], *of: Any) -> str:
    """What is made, or how that fails, which is recorded when it is run."""
    try:
        return made(*of)
    except Exception as error:
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
