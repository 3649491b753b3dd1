"""`view`: a result or a scene as a page in three dimensions; `View`, that page."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.crane import KnuckleBoomCrane
from seacrane.description import crane_parts
from seacrane.description.joint_coordinates import start_pose
from seacrane.description.scene import Description
from seacrane.errors import SceneError
from seacrane.files.atomic import atomic_write
from seacrane.hydro import Hull
from seacrane.inputs.checked import flag_of, number_of
from seacrane.inputs.frames import quaternion_of
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.scene.scene import Scene
from seacrane.viewer.arrows import arrows_of
from seacrane.viewer.bodies import Look, looks
from seacrane.viewer.caption import caption
from seacrane.viewer.motion import STEPS, Motion, motion_of
from seacrane.viewer.packing import Blob
from seacrane.viewer.page import page
from seacrane.viewer.sea import sea_components, without_sea
from seacrane.viewer.shapes import HullShape
from seacrane.viewer.strip import Choice, strip_of
from seacrane.viewer.wires import end_of, wires_of

Array = NDArray[np.float64]
SCENE_ALONE = 60.0  # s that the sea of a scene without a run is shown
LOWEST, HIGHEST = 200, 4000  # pixels


@dataclass(frozen=True, kw_only=True, repr=False)
class View:
    """A page that shows a scene or a result in three dimensions.

    The last expression of a notebook cell shows it there; `save` writes it as a file that any browser opens
    from disk, without network.

    Attributes
    ----------
    title : str
    html : str
        The whole page.
    motion : Motion
        The poses that it shows.
    height : int
        Of the frame in a notebook, pixels.
    """

    title: str
    html: str
    motion: Motion = field(compare=False)
    height: int = 640

    def __repr__(self) -> str:
        return f"<View of {self.title!r}: {len(self.html) / 1e6:.2f} MB>"

    def _repr_html_(self) -> str:
        frame = f"width:100%;height:{self.height}px;border:1px solid #c9d2d9"
        return (
            f'<iframe title="{escape(self.title)}" srcdoc="{escape(self.html)}" style="{frame}" '
            'allow="fullscreen"></iframe>'
        )

    def save(self, path: str | os.PathLike[str], *, overwrite: bool = False) -> Path:
        """Write the page: complete under its name, or not at all.

        Parameters
        ----------
        path : path
            Target, such as "lift.html"; its folder must exist.
        overwrite : bool
            Whether a file of that name may be replaced.

        Returns
        -------
        Path
            The file written.

        Raises
        ------
        FileExistsError
            If there is a file of that name, unless `overwrite`.
        OSError
            If it cannot be written.
        """
        path = Path(path)
        if path.exists() and not flag_of("overwrite", overwrite):
            raise FileExistsError(f"{path} exists; give another name, or overwrite=True")
        with atomic_write(path) as draft:
            draft.write_text(self.html, encoding="utf-8")
        return path


def view(
    what: Result | Scene,
    *,
    scene: Scene | None = None,
    channels: Sequence[Choice] | None = None,
    hulls: Mapping[str, Hull] | None = None,
    crane: KnuckleBoomCrane | None = None,
    height: int = 640,
) -> View:
    """Show a result, or a scene at its start, as an interactive page in three dimensions.

    The page holds all that it needs: bodies, wires, forces, tracks, channels over time, and the sea, which it
    sums from the wave components that load the vessels. Axes: x forward, y to port, z up.

    Parameters
    ----------
    what : Result or Scene
        Of a scene, bodies stand at their assembled start, in a moving sea.
    scene : Scene, optional
        That the result belongs to; needed for a result that was read from a file.
    channels : sequence, optional
        What is drawn over time: names of channels, or tuples of a channel and names along its dimensions,
        such as ``["link_tension", ("vessel_motion", "roll"), ("position", "payload", "z")]``. Default: link
        tension, roll and heave, and what else the result has of the usual; () for none.
    hulls : mapping of str to Hull, optional
        Hulls by the vessel's body. Default: the shipped hull for the shipped database; for other vessels a
        schematic one from mass and inertia, which the caption says.
    crane : KnuckleBoomCrane, optional
        Whose members are drawn for bodies with the same mass and inertia; default: the crane that comes with
        seacrane. Other bodies are drawn as bars between their joints, payloads as boxes.
    height : int
        Of the frame in a notebook, pixels.

    Returns
    -------
    View
        Shown by a notebook, saved by `View.save`.

    Raises
    ------
    SceneError
        For a result without poses, a scene that is missing or another one, a hull of no vessel, or a channel
        that is not there.
    """
    size = round(number_of("view: height", height))
    if not LOWEST <= size <= HIGHEST:
        raise SceneError(f"view: height is {height}; give pixels from {LOWEST} to {HIGHEST}")
    result = what if isinstance(what, Result) else None
    shown_scene = _scene_of(what, scene)
    motion = _at_start(shown_scene) if result is None else motion_of(result)
    _require_same_bodies(shown_scene, motion)
    appearance = looks(shown_scene, hulls=hulls, crane=crane)
    blob = Blob()
    data = {
        "motion": _motion_data(motion, blob),
        "least": SCENE_ALONE if result is None and shown_scene.waves is not None else 0.0,
        "bodies": [_body_data(name, appearance[name], blob) for name in motion.bodies],
        "sea": None if without_sea(shown_scene) else blob.floats(sea_components(shown_scene)),
        "wires": wires_of(shown_scene, motion.bodies),
        "tracks": _tracks(shown_scene, motion.bodies),
        "arrows": arrows_of(shown_scene, result, motion, motion.bodies, blob),
        "strip": strip_of(result, channels, motion, blob),
    }
    title = shown_scene.name
    rows = caption(shown_scene, result, motion, appearance)
    html = page(title=title, caption=rows, data=data, blob=blob.text())
    return View(title=title, html=html, motion=motion, height=size)


def _scene_of(what: Any, scene: Any) -> Description:
    """The scene that is shown."""
    if isinstance(what, Description):
        if scene is not None:
            raise SceneError("view: scene= is given beside a scene; give a result, or leave it out")
        return what
    if not isinstance(what, Result):
        raise SceneError(f"view: {shown(what)} is neither a Result nor a Scene")
    found = what.scene if scene is None else scene
    if found is None:
        raise SceneError(
            f"view: result of {what.stats['scene']!r} comes from a file, which holds no bodies or joints; "
            "give its scene with view(result, scene=scene)"
        )
    if not isinstance(found, Description):
        raise SceneError(f"view: scene is {shown(found)}; give a Scene")
    return found


def _require_same_bodies(scene: Description, motion: Motion) -> None:
    if not scene.bodies:
        raise SceneError(f"view: scene {scene.name!r} has no bodies; add some first")
    if set(scene.bodies) != set(motion.bodies):
        apart = sorted(set(scene.bodies) ^ set(motion.bodies))
        raise SceneError(
            f"view: scene {scene.name!r} is not the one of the result: {', '.join(map(repr, apart[:5]))} "
            f"{'is' if len(apart) == 1 else 'are'} only in one of them; give the scene that was run"
        )


def _at_start(scene: Description) -> Motion:
    """One frame: the assembled start."""
    names = tuple(scene.bodies)
    if not names:
        raise SceneError(f"view: scene {scene.name!r} has no bodies; add some first")
    model = scene.compile()  # type: ignore[attr-defined]
    poses = [start_pose(scene, model, name) for name in names]
    still = np.zeros((1, len(names), 3))
    return Motion(
        start=0.0, interval=1.0, bodies=names, position=np.array([[centre[0] for centre, _ in poses]]),
        quaternion=np.array([[quaternion_of(turn[0]) for _, turn in poses]]), velocity=still,
        angular_velocity=still,
    )  # fmt: skip


def _motion_data(motion: Motion, blob: Blob) -> dict[str, Any]:
    frames = len(motion.position)
    rows = {name: getattr(motion, name).reshape(frames, -1).T for name in STEPS}
    series = {name: blob.series(values, STEPS[name]) for name, values in rows.items()}
    return {"start": motion.start, "interval": motion.interval, **series}


def _body_data(name: str, look: Look, blob: Blob) -> dict[str, Any]:
    shapes = []
    for shape in look.shapes:
        if isinstance(shape, HullShape):
            numbers = {"vertices": blob.floats(shape.vertices), "faces": blob.whole(shape.faces)}
            shapes.append({"kind": "hull", "waterline": shape.waterline, **numbers})
        else:
            shapes.append(shape.data())
    return {"name": name, "role": look.role, "shapes": shapes}


def _tracks(scene: Description, bodies: Sequence[str]) -> list[dict[str, Any]]:
    """Points whose paths are drawn: tips of cranes, and what hangs on them."""
    tips = [
        {"kind": "tip", "name": label, "at": end_of(scene, bodies, body, point)}
        for label, (body, point) in crane_parts.tips(scene).items()
    ]
    hanging = [
        {"kind": "payload", "name": label, "at": [list(bodies).index(body), 0.0, 0.0, 0.0]}
        for label, body in crane_parts.payloads(scene).items()
    ]
    return [*tips, *hanging]
