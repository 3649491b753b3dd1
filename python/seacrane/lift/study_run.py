"""Run a study into its folder, or go on with it."""

from __future__ import annotations

import os
from concurrent.futures import Executor
from pathlib import Path

from seacrane.ensembles.ensemble import Ensemble, ensemble
from seacrane.ensembles.other_sea import WORDS, require_same_sea
from seacrane.ensembles.study import Source, require_paths, stage_paths
from seacrane.errors import FileFormatError, SceneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.drafts import is_draft
from seacrane.inputs.whole_file import read_whole
from seacrane.lift.document import LARGEST_FILE
from seacrane.lift.lift import Lift
from seacrane.lift.study_file import StudyFile
from seacrane.lift.varied_keys import KeyPlace, LiftScenes, keys_in, with_keys

FILE, MEMBERS = "study.toml", "members"


def run_study(
    path: str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    progress: bool = False,
) -> Ensemble:
    """Run a study file; what is in its folder is not run again.

    Parameters
    ----------
    path : Of the study file.
    folder : Made if absent. It will hold a copy of the file, and the members as they come.
    executor : concurrent.futures.Executor, optional
    progress : Show a bar with the time left.

    Raises
    ------
    FileFormatError
        With the line, for what is wrong in the study or its lift.
    SceneError
        If the folder is that of another study, or of something else.
    SimulationError, WorkerVersionError, OSError
        As of `ensemble`; what came back before is kept.
    """
    study, target = StudyFile.load(path), Path(folder)
    lift = study.lift()
    t_end, start, method, outputs = study.settings(lift)
    source = _source(study, lift)
    text = read_whole(Path(path), LARGEST_FILE, "no study file is")
    _claim(target, text)
    done = ensemble(
        source, over=study.over, keep=study.keep, until=study.until, accuracy=study.accuracy or lift.accuracy,
        stages=lift.stages, start=start, t_end=None if lift.stages else t_end, method=method, outputs=outputs,
        executor=executor, store=target / MEMBERS, progress=progress,
    )  # fmt: skip
    _write(target / FILE, text)
    return done


def _source(study: StudyFile, lift: Lift) -> Source:
    """The scene of the lift, or what makes scenes where keys of the lift vary."""
    scene = lift.scene()
    study.require_accuracy(scene, staged=bool(lift.stages))
    tables, axes = lift.tables, study.members.axes
    keys, of_stages = keys_in(tables), stage_paths(lift.stages)
    for name, values in axes.items():
        try:
            require_paths(scene, [name], WORDS, [*keys, *of_stages])
            for value in (values[0], values[-1]) if name in keys else ():
                Lift(with_keys(tables, keys, {name: value}))
        except (FileFormatError, SceneError) as error:
            study.fail_at(name, str(error))
    varied: dict[str, KeyPlace] = {name: keys[name] for name in axes if name in keys}
    if not varied:
        return scene
    words = [name for name in axes if name in WORDS]
    if words:
        try:
            require_same_sea(scene, words)
        except SceneError as error:
            study.fail_at(words[0], str(error))
    return LiftScenes(tables, varied)


def _claim(folder: Path, text: bytes) -> None:
    """Make the folder, or refuse one of something else."""
    if folder.exists() and not folder.is_dir():
        raise SceneError(f"{folder} is a file; give the name of a folder")
    folder.mkdir(parents=True, exist_ok=True)
    if (folder / FILE).exists():
        return
    if any(not is_draft(one) for one in folder.iterdir()):
        raise SceneError(f"{folder} holds something else than a study; give another folder")
    _write(folder / FILE, text)


def _write(path: Path, text: bytes) -> None:
    if path.exists() and read_whole(path, LARGEST_FILE, "no study file is") == text:
        return
    with atomic_write(path) as draft:
        draft.write_bytes(text)
