"""`still` and `video`: pictures of a result or a scene without a browser, by pyvista."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane import Crane
from seacrane.errors import SceneError
from seacrane.hydro import Hull
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.checked import flag_of, number_of, numbers_of
from seacrane.inputs.shown import shown
from seacrane.pictures.camera import camera_of
from seacrane.pictures.drawing import Drawing, drawing_of
from seacrane.pictures.still_drawing import Stage
from seacrane.result import Result
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    from PIL.Image import Image

STILL = (".png", ".jpg", ".webp")
VIDEO = {".gif": "GIF", ".png": "PNG", ".webp": "WEBP"}
SMALLEST, LARGEST = 100, 4000  # pixels
MOST_PIXELS = 350e6  # of all pictures of a video, which are in memory together: 1 GB


def still(
    what: Result | Scene,
    *,
    path: str | os.PathLike[str],
    time: float | None = None,
    camera: str = "overview",
    size: Sequence[int] = (1200, 700),
    scene: Scene | None = None,
    hulls: Mapping[str, Hull] | None = None,
    crane: Crane | None = None,
    overwrite: bool = False,
) -> Path:
    """Write a picture of a result at a time, or of a scene at its start, without a browser.

    It shows what the page of `view` shows: hull, sea of all its components, crane, wires, payload, tracks; no
    forces and no names. Needs pyvista (``pip install 'seacrane[stills]'``).

    Parameters
    ----------
    what : Result or Scene
    path : path
        Target: .png, .jpg or .webp; its folder must exist.
    time : float, optional
        s; default: the start. Of a scene only the sea moves with it.
    camera : str
        "overview", "port", "starboard", "bow", "stern", "top", or the name of a payload's body.
    size : (int, int)
        Width and height, pixels, 100 to 4000.
    scene, hulls, crane
        As of `view`.
    overwrite : bool
        Whether a file of that name may be replaced.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    SceneError
        As `view`, and for a time outside the run, an unknown camera, size or ending.
    ImportError
        Without pyvista.
    FileExistsError, OSError
        If it cannot be written.
    """
    target = _target(path, STILL, overwrite)
    drawing = drawing_of(what, scene=scene, hulls=hulls, crane=crane)
    at = drawing.motion.start if time is None else _time(drawing, "time", time)
    with _stage(drawing, camera, size) as stage:
        stage.show(at)
        picture = _image(stage.picture())
    with atomic_write(target) as draft:
        picture.save(draft, format=_format(target))
    return target


def video(
    result: Result,
    *,
    path: str | os.PathLike[str],
    start: float | None = None,
    end: float | None = None,
    speed: float = 1.0,
    rate: float = 10.0,
    camera: str = "overview",
    size: Sequence[int] = (960, 540),
    scene: Scene | None = None,
    hulls: Mapping[str, Hull] | None = None,
    crane: Crane | None = None,
    overwrite: bool = False,
) -> Path:
    """Write a result as a moving picture, without a browser.

    Parameters
    ----------
    result : Result
    path : path
        Target: .webp (small), .gif, or .png (animated, without loss); its folder must exist.
    start, end : float, optional
        s; default: all of the run.
    speed : float
        Seconds of the run in a second of the video.
    rate : float
        Pictures a second, 1 to 50.
    camera, size, scene, hulls, crane, overwrite
        As of `still`.

    Returns
    -------
    Path
        The file written.

    Raises
    ------
    SceneError
        As `still`, and for pictures of more than 350 million pixels together.
    ImportError, FileExistsError, OSError
        As `still`.
    """
    target = _target(path, VIDEO, overwrite)
    if not isinstance(result, Result):
        raise SceneError(f"video: {shown(result)} is no Result; a scene is drawn by still()")
    drawing = drawing_of(result, scene=scene, hulls=hulls, crane=crane)
    width, height = _size(size)
    times = _times(drawing, start, end, speed, rate, most=int(MOST_PIXELS / (width * height)))
    with _stage(drawing, camera, size) as stage:
        pictures = []
        for time in times:
            stage.show(float(time))
            pictures.append(_image(stage.picture()))
    with atomic_write(target) as draft:
        pictures[0].save(
            draft, format=VIDEO[target.suffix.lower()], save_all=True, append_images=pictures[1:],
            duration=round(1e3 / float(rate)), loop=0,
        )  # fmt: skip
    return target


def _times(
    drawing: Drawing, start: Any, end: Any, speed: Any, rate: Any, *, most: int
) -> NDArray[np.float64]:
    """Of the pictures, s."""
    motion = drawing.motion
    first = motion.start if start is None else _time(drawing, "start", start)
    last = motion.end if end is None else _time(drawing, "end", end)
    pace, often = number_of("video: speed", speed), number_of("video: rate", rate)
    if not (last > first and 0.0 < pace < np.inf and 1.0 <= often <= 50.0):
        raise SceneError(
            f"video: from {first:g} to {last:g} s at speed {pace:g} and rate {often:g}; give an end after "
            "the start, a positive speed, and a rate from 1 to 50"
        )
    count = (last - first) / pace * often + 1.0
    if count > most:
        raise SceneError(
            f"video: takes {count:.0f} pictures, above {most} of this size; raise speed, lower rate or size"
        )
    return np.asarray(np.minimum(first + pace / often * np.arange(int(count)), last))


def _time(drawing: Drawing, name: str, value: Any) -> float:
    time, motion = number_of(name, value), drawing.motion
    last = np.inf if drawing.result is None else motion.end
    if not motion.start <= time <= last or time == np.inf:
        raise SceneError(f"{name} is {time:g} s; the run goes from {motion.start:g} to {last:g} s")
    return time


def _target(path: Any, endings: Any, overwrite: bool) -> Path:
    """The path, once it is one that may be written; before anything is drawn."""
    target = Path(path)
    if target.suffix.lower() not in endings:
        raise SceneError(f"path ends in {shown(target.name)}; choose {', '.join(endings)}")
    if target.exists() and not flag_of("overwrite", overwrite):
        raise FileExistsError(f"{target} exists; give another name, or overwrite=True")
    return target


def _stage(drawing: Drawing, camera: Any, size: Any) -> Stage:
    width, height = _size(size)
    return Stage(drawing, camera_of(drawing, camera, width / height), (width, height))


def _size(size: Any) -> tuple[int, int]:
    given = numbers_of("size", size)
    if given.shape != (2,) or not ((given >= SMALLEST) & (given <= LARGEST)).all():
        raise SceneError(f"size is {shown(size)}; give width and height from {SMALLEST} to {LARGEST} pixels")
    return round(float(given[0])), round(float(given[1]))


def _image(picture: NDArray[np.uint8]) -> Image:
    from PIL import Image as images

    return images.fromarray(picture)


def _format(path: Path) -> str:
    return {".png": "PNG", ".jpg": "JPEG", ".webp": "WEBP"}[path.suffix.lower()]
