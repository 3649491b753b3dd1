"""`view`: a result or a scene as a page in three dimensions; `View`, that page."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.crane import Crane
from seacrane.description.description import Description
from seacrane.description.pick import Pick
from seacrane.description.suspension import suspensions
from seacrane.errors import SceneError
from seacrane.hydro import Hull
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.checked import flag_of, number_of
from seacrane.inputs.keywords import named
from seacrane.inputs.replaceable import GENERATOR, check_replaceable
from seacrane.inputs.shown import shown
from seacrane.pictures.animated_gltf import GENERATOR as GLTF_GENERATOR
from seacrane.pictures.animated_gltf import gltf_of
from seacrane.pictures.caption import (
    FINENESS,
    caption,
    forces_of,
    marks_of,
    sea_components,
    strip_of,
    without_sea,
)
from seacrane.pictures.drawing import Drawing, drawing_of
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.pose_curves import POSES, Blob, Motion, linear_rows
from seacrane.pictures.shapes import HULL, SLACK, TRACKS, WIRES, HullShape, MeshShape, body_colour
from seacrane.pictures.wheels import Wheel, end_of
from seacrane.result import Result
from seacrane.scene.scene import Scene

SCENE_ALONE = 60.0  # s that the sea of a scene without a run is shown
LOWEST, HIGHEST = 200, 4000  # pixels
ANGLE_STEP = 1e-3  # rad, of a drum
SLOT = re.compile(r"@@(\w+)@@")
INSIDE_SCRIPT = {"<": "\\u003c", ">": "\\u003e", "&": "\\u0026", "\u2028": "\\u2028", "\u2029": "\\u2029"}
Arrow = tuple[str, str, list[float], Array]  # name, group, point of application, force over the outputs


@dataclass(frozen=True, kw_only=True, repr=False)
class Page:
    """A page that holds everything: a notebook shows it, any browser opens its file, without network.

    Attributes
    ----------
    html : str
        The whole page.
    height : int
        Of the frame in a notebook, pixels.
    """

    title: str
    html: str
    height: int = 640
    _frame: ClassVar[str] = 'sandbox="allow-scripts"'

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.title!r}: {len(self.html) / 1e3:.0f} kB>"

    def _repr_html_(self) -> str:
        """In a frame of its own: the notebook's looks and the page's do not mix."""
        style = f"width:100%;height:{self.height}px;border:1px solid #c9d2d9"
        return (
            f'<iframe srcdoc="{escape(self.html)}" title="{escape(self.title)}" {self._frame} '
            f'style="{style}"></iframe>'
        )

    def save(self, path: str | os.PathLike[str], *, overwrite: bool | None = None) -> Path:
        """Write the page: complete under its name, or not at all.

        Parameters
        ----------
        path : path
            Target file; its folder must exist.
        overwrite : bool, optional
            By default an earlier page of seacrane is replaced, and no other file. True: any file of that
            name. False: none.

        Returns
        -------
        Path
            The file written.

        Raises
        ------
        FileExistsError
            If there is a file of that name that is to stay.
        OSError
            If it cannot be written; an older file stays.
        """
        return _written(path, self.html.encode("utf-8"), overwrite, mark=GENERATOR)


@dataclass(frozen=True, kw_only=True, repr=False)
class View(Page):
    """A page that shows a scene or a result in three dimensions, by the poses of `drawing`."""

    drawing: Drawing = field(compare=False)
    _frame: ClassVar[str] = 'allow="fullscreen"'

    @property
    def motion(self) -> Motion:
        """The poses that it shows."""
        return self.drawing.motion

    def save_gltf(self, path: str | os.PathLike[str], *, overwrite: bool | None = None) -> Path:
        """Write bodies, sheaves, drums and wires as an animated glTF model, which modellers and viewers open.

        A node for each body, by its name, at its centre of mass; its animation is exact to what the page
        shows. The root node turns z up into glTF's y up. Slack wires are straight; the sea is left out.

        The path ends in .glb; `overwrite` and errors are as of `save`, of a model instead of a page.

        Raises
        ------
        SceneError
            For another ending than .glb, and for a run too long for one file.
        """
        if Path(path).suffix.lower() != ".glb":
            raise SceneError(f"view: save_gltf writes .glb; path ends in {shown(Path(path).name)}")
        return _written(path, gltf_of(self.drawing), overwrite, mark=GLTF_GENERATOR)


def _written(path: str | os.PathLike[str], data: bytes, overwrite: bool | None, *, mark: str) -> Path:
    """Complete under its name, or not at all."""
    path = Path(path)
    asked = None if overwrite is None else flag_of("overwrite", overwrite)
    check_replaceable(path, asked, mark=mark)
    with atomic_write(path) as draft:
        draft.write_bytes(data)
    return path


@named
def view(
    what: Result | Scene,
    *,
    scene: Scene | None = None,
    channels: Sequence[str | Pick] | None = None,
    hulls: Mapping[str, Hull] | None = None,
    crane: Crane | None = None,
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
        That the result belongs to; needed for a result that holds none, such as a copy.
    channels : sequence, optional
        What is drawn over time, such as ``["link_tension", "roll", "position[payload, z]"]``. Default:
        tensions, roll and heave, and what else the result has of the usual; () for none.
    hulls : mapping of str to Hull, optional
        Hulls by the vessel's body. Default: the shipped hull for the shipped database; for other vessels a
        schematic one from mass and inertia, which the caption says.
    crane : Crane, optional
        Whose members are drawn for bodies with the same mass and inertia; default: the cranes that come with
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
    drawing = drawing_of(what, scene=scene, hulls=hulls, crane=crane)
    motion, shown_scene = drawing.motion, drawing.scene
    blob = Blob()
    data = {
        "motion": {"start": motion.start, "interval": motion.interval, **motion.series(blob)},
        "least": SCENE_ALONE if result is None and shown_scene.waves is not None else 0.0,
        "bodies": [_body_data(name, i, drawing.looks[name], blob) for i, name in enumerate(motion.bodies)],
        "wheels": [_wheel_data(wheel, blob) for wheel in drawing.wheels],
        "sea": None if without_sea(shown_scene) else blob.plain(sea_components(shown_scene)),
        "wires": [wire | {"colours": [WIRES[wire["kind"]], SLACK]} for wire in drawing.wires],
        "tracks": [track | {"colour": TRACKS[track["kind"]]} for track in drawing.tracks],
        "forces": forces_of(result, drawing.wires, motion, blob),
        **marks_of(shown_scene, result, motion.bodies),
        "arrows": arrows_of(shown_scene, result, motion, blob),
        "strip": strip_of(result, channels, motion, blob),
    }
    rows = caption(shown_scene, result, motion, drawing.looks)
    html = page(title=drawing.title, caption=rows, data=data, blob=blob.text())
    return View(title=drawing.title, html=html, drawing=drawing, height=size)


def _mesh(shape: MeshShape, blob: Blob) -> dict[str, Any]:
    return {"vertices": blob.plain(shape.vertices), "faces": blob.plain(shape.faces)}


def _body_data(name: str, number: int, look: Look, blob: Blob) -> dict[str, Any]:
    shapes: list[dict[str, Any]] = []
    for shape in look.shapes:
        own = {"colour": body_colour(shape.colour, look.role, number)}
        if isinstance(shape, HullShape):
            painted = {"kind": "hull", "waterline": shape.waterline, "colours": HULL}
            shapes.append(painted | _mesh(shape, blob))
        elif isinstance(shape, MeshShape):
            shapes.append({"kind": "mesh", **_mesh(shape, blob), **own})
        else:
            shapes.append(shape.data() | own)
    return {"name": name, "role": look.role, "shapes": shapes}


def _wheel_data(wheel: Wheel, blob: Blob) -> dict[str, Any]:
    told = _body_data(wheel.name, 0, wheel.look, blob)
    angle = None if wheel.angle is None else blob.series(wheel.angle[None], ANGLE_STEP)
    return told | {"at": wheel.at, "axis": [round(float(x), 6) for x in wheel.axis], "angle": angle}


def page(*, title: str, caption: Sequence[tuple[str, str]], data: Mapping[str, Any], blob: str) -> str:
    """One page with everything inside, as text: rows of words, data for the script, its arrays as base64."""
    rows = "".join(f"<tr><th>{escape(what)}</th><td>{escape(words)}</td></tr>" for what, words in caption)
    # What would end the element of the bundle is escaped.
    script = re.sub(r"</(script)", r"<\\/\1", _asset("viewer.js"), flags=re.IGNORECASE)
    filled = {"title": escape(title), "style": _asset("page.css"), "caption": rows, "data": json_text(data),
              "blob": blob, "script": script.replace("<!--", "<\\!--")}  # fmt: skip
    return SLOT.sub(lambda slot: filled[slot[1]], _asset("page.html"))


def json_text(data: Any) -> str:
    """JSON that no HTML parser takes for markup, wherever it stands."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return re.sub("[<>&\u2028\u2029]", lambda found: INSIDE_SCRIPT[found[0]], text)


@cache
def _asset(name: str) -> str:
    return (files("seacrane") / "pictures" / "assets" / name).read_text(encoding="utf-8")


def arrows_of(scene: Description, result: Result | None, motion: Motion, blob: Blob) -> list[dict[str, Any]]:
    """Arrows with their point of application and their force over the frames, N, inertial axes."""
    if result is None:
        return []
    found: list[tuple[dict[str, Any], Array]] = [
        ({"name": name, "group": group, "at": at}, linear_rows(motion, result.time, force))
        for forces in (_reactions, _pulls, _waves)
        for name, group, at, force in forces(scene, result, motion.bodies)
    ]
    largest: dict[str, float] = {}
    for arrow, rows in found:
        size = float(np.linalg.norm(rows, axis=0).max())
        largest[arrow["group"]] = max(largest.get(arrow["group"], 0.0), size)
    return [
        arrow | {"force": blob.series(rows, most * FINENESS), "largest": most}
        for arrow, rows in found
        if (most := largest[arrow["group"]]) > 0.0
    ]


def _reactions(scene: Description, result: Result, bodies: Sequence[str]) -> Iterator[Arrow]:
    """What each joint exerts on its second body."""
    names = result.coords["joint"] if "reaction_force" in result.channels else ()
    for name in (name for name in names if name in scene.joints):
        joint = scene.joints[name]
        hangs = joint.kind == "distance"
        slides = "displacement" in _core.joint_kinds()[joint.kind].coordinates and not hangs
        body, frame = (joint.first, joint.first_frame) if slides else (joint.second, joint.second_frame)
        force = result.select("reaction_force", joint=name)
        yield name, "link" if hangs else "joint", end_of(scene, bodies, body, frame.point), force


def _pulls(scene: Description, result: Result, bodies: Sequence[str]) -> Iterator[Arrow]:
    """What each line exerts on the body at its lower end."""
    if not {"hook_load", *POSES} <= set(result.channels):
        return
    for one in suspensions(scene):
        if one.name in scene.joints or one.channel not in result.coords["suspension"]:
            continue
        up = result.place_of(*one.upper) - result.place_of(*one.lower)
        pull = result.select("hook_load", suspension=one.channel)[:, None] * up
        pull /= np.linalg.norm(up, axis=1, keepdims=True)
        yield one.name, "link", end_of(scene, bodies, *one.lower), pull


def _waves(scene: Description, result: Result, bodies: Sequence[str]) -> Iterator[Arrow]:
    """Wave forces at the reference points of vessels, turned by yaw out of the axes that follow it."""
    if "wave_force" not in result.channels:
        return
    several = "vessel" in result.dims["wave_force"]
    for vessel in scene.vessels.values():
        if several and vessel.name not in result.coords["vessel"]:
            continue
        pick = {"vessel": vessel.name} if several else {}
        force, yaw = result.select("wave_force", **pick)[:, :3].copy(), np.zeros(len(result.time))
        if vessel.kinematics == "yaw_following":
            w, x, y, z = np.moveaxis(result.select("quaternion", body=vessel.body), -1, 0)
            yaw = np.arctan2(2.0 * (x * y + w * z), w * w + x * x - y * y - z * z)
        turn = np.exp(1j * yaw) * (force[:, 0] + 1j * force[:, 1])
        force[:, 0], force[:, 1] = turn.real, turn.imag
        yield vessel.name, "wave", end_of(scene, bodies, vessel.body, np.zeros(3)), force
