"""A scene from what the user names: a built-in case, a data file, or a script."""

from __future__ import annotations

import argparse
import contextlib
import runpy
import sys
import traceback
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from seacrane.errors import SceneError
from seacrane.inputs.caller import tell

if TYPE_CHECKING:
    from seacrane.run.method import Method
    from seacrane.run.outputs import Outputs
    from seacrane.run.stage import Stage
    from seacrane.scene.scene import Scene

CASES = ("case1", "case2", "case3", "vessel")
RESULT_BEGINS = (b"\x89HDF", b"CDF", b"seacrane partial result")  # NetCDF of both kinds, a run that goes on
SEA_OPTIONS = ("hs", "tp", "wave_direction_deg", "spectrum", "gamma", "spreading", "seed")
CASE_OPTIONS = ("memory", *SEA_OPTIONS, "database")


@dataclass(frozen=True, kw_only=True)
class Source:
    """What the user named: a scene, the name of its files, and of a lift how it is run."""

    name: str
    scene: Scene
    t_end: float | None = None
    method: Method | None = None
    outputs: Outputs | None = None
    stages: Sequence[Stage] = ()
    start: Literal["rest"] | None = None
    accuracy: Mapping[str, float] | None = None


def load_source(source: str, options: argparse.Namespace, *, scripts: bool = False) -> Source:
    """A case by its name and `CASE_OPTIONS`, or a lift, a scene file or, if those may run, a script.

    Raises SceneError if there is no such scene, a script may not run or fails, or options do not apply, and
    FileFormatError for a file that is none of these.
    """
    given = {name: getattr(options, name, None) for name in CASE_OPTIONS}
    given = {name: value for name, value in given.items() if value is not None}
    if source in CASES:
        import seacrane.cases as cases

        return Source(name=source, scene=getattr(cases, source)(**given))
    path = Path(source)
    if given:
        names = ", ".join(f"--{name.replace('_', '-')}" for name in given)
        raise SceneError(f"{names} applies to the built-in cases only; set it inside {path.name}")
    if not path.is_file():
        raise SceneError(f"no scene {source!r}: it is neither one of {', '.join(CASES)} nor a file")
    if path.suffix == ".py":
        if not scripts:
            raise SceneError(f"{path.name} is a script, and only `seacrane run` executes scripts")
        return Source(name=path.stem, scene=run_script(path))
    if path.suffix == ".toml":
        return _lift(path)
    from seacrane.scene.scene import Scene

    return Source(name=path.stem, scene=Scene.load(path))


def _lift(path: Path) -> Source:
    from seacrane.lift.lift import Lift

    lift = Lift.load(path)
    if lift.study is not None:
        tell(f"{path.name} has a [study], whose runs `seacrane study` makes; this is of the lift itself")
    if lift.answers:
        tell(f"{path.name} asks for answers, which `seacrane answers` gives; this is of the lift itself")
    return Source(
        name=path.stem, scene=lift.scene(), t_end=None if lift.stages else lift.t_end, method=lift.method,
        outputs=lift.outputs, stages=lift.stages, start=lift.start, accuracy=lift.accuracy,
    )  # fmt: skip


def is_result(source: str) -> bool:
    """Whether the user named the file of a result, by what it holds."""
    if source in CASES or not Path(source).is_file():
        return False
    with Path(source).open("rb") as file:
        return file.read(max(map(len, RESULT_BEGINS))).startswith(RESULT_BEGINS)


def run_script(path: Path) -> Scene:
    """What the script's function ``scene()`` returns; SceneError, with the line, where it fails."""
    from seacrane.scene.scene import Scene

    try:
        with _importable(path.resolve().parent):
            function = runpy.run_path(str(path), run_name="seacrane_scene").get("scene")
            if not callable(function):
                raise SceneError(f"{path.name} defines no function scene(); add one that returns a Scene")
            scene = function()
    except (Exception, SystemExit) as error:
        frames = reversed(traceback.extract_tb(error.__traceback__))
        line = next((frame.lineno for frame in frames if frame.filename == str(path)), None)
        line = error.lineno if isinstance(error, SyntaxError) else line
        if line is None and isinstance(error, SceneError):
            raise
        place = f"{path.name} line {line}" if line else path.name
        raise SceneError(f"{place}: {type(error).__name__}: {error}") from error
    if not isinstance(scene, Scene):
        raise SceneError(f"scene() of {path.name} returns a {type(scene).__name__}; return a seacrane.Scene")
    return scene


@contextlib.contextmanager
def _importable(folder: Path) -> Iterator[None]:
    """Lets a script import what lies beside it, as `python script.py` would."""
    sys.path.insert(0, str(folder))
    try:
        yield
    finally:
        with contextlib.suppress(ValueError):
            sys.path.remove(str(folder))
