"""simulate_stages_to_file(): a lift in stages whose result is on disk after each of them."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from seacrane.result.result import Result
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.run.sampled_controller import SampledController
from seacrane.run.shorthand import Shorthand
from seacrane.run.stage import Stage
from seacrane.run.staged_run import StagedRun
from seacrane.run.start import Start
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from typing_extensions import Unpack


def simulate_stages_to_file(
    scene: Scene,
    stages: Sequence[Stage],
    path: str | os.PathLike[str],
    *,
    start: Start = None,
    first: str | None = None,
    method: Method | None = None,
    outputs: Outputs | None = None,
    controllers: Sequence[SampledController] = (),
    overwrite: bool = False,
    **shorthand: Unpack[Shorthand],
) -> Result:
    """Carry out a lift stage by stage, and write its result after each stage.

    The file is whole whenever the process is killed: it then holds the stages that were over, with
    `interrupted` set. Ctrl-C and errors keep the stage that they end, too. The outputs stay in memory.

    Parameters
    ----------
    scene, stages, start, first, method, outputs, controllers, **shorthand
        As `simulate_stages`.
    path : path
        NetCDF file; its folder must exist.
    overwrite : bool
        Replace a file of that name, as soon as the first stage is over.

    Raises
    ------
    FileExistsError
        If there is a file of that name.
    OSError
        If it cannot be written.
    SceneError, SimulationError
        As `simulate_stages`.

    Warns
    -----
    As `simulate_stages`.
    """
    path = Path(path)
    if path.exists() and not overwrite:
        raise FileExistsError(f"{path.name} is there already; give another name, or overwrite=True")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"{path}: there is no folder {path.parent}; make it first")
    run = StagedRun(
        scene, stages, start=start, first=first, method=method, outputs=outputs, controllers=controllers,
        **shorthand,
    )  # fmt: skip
    try:
        while run.advance():
            run.result().save(path)
    except BaseException as error:
        recorded = getattr(error, "result", None)
        if isinstance(recorded, Result):
            with contextlib.suppress(OSError):  # the error at hand tells more
                recorded.save(path)
        raise
    run.warn()
    result = run.result()
    result.save(path)
    return result
