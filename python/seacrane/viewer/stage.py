"""A drawing set up in pyvista: bodies, wheels, sea, wires and tracks, moved from time to time."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.frames import rotation_matrix
from seacrane.viewer.bodies import Look
from seacrane.viewer.camera import OPENING, Camera
from seacrane.viewer.drawing import Drawing
from seacrane.viewer.hanging import wire_line
from seacrane.viewer.palette import SKY, SLACK, TRACKS, WIRES
from seacrane.viewer.sea import sea_components, without_sea
from seacrane.viewer.sea_surface import SeaSurface, sea_surface
from seacrane.viewer.surfaces import surfaces_of

Array = NDArray[np.float64]

MISSING = "pictures without a browser need pyvista: install it by pip install 'seacrane[stills]'"


class Stage:
    """Everything that is drawn, in a picture of so many pixels."""

    def __init__(self, drawing: Drawing, camera: Camera, size: tuple[int, int]) -> None:
        try:
            import pyvista
        except ImportError as error:
            raise ImportError(MISSING) from error
        self.pv: Any = pyvista
        self.drawing, self.camera = drawing, camera
        self.plotter = self.pv.Plotter(off_screen=True, window_size=list(size))
        self.plotter.set_background(SKY)
        looks = [drawing.looks[name] for name in drawing.motion.bodies]
        self.bodies = [self._solid(look, i) for i, look in enumerate(looks)]
        self.wheels = [self._solid(wheel.look, 0) for wheel in drawing.wheels]
        self.sea, self.water = self._sea()
        self.wires: list[Any] = []
        self._tracks()
        self.text = self.plotter.add_text("", position="lower_left", font_size=10, color="#1d2b36")

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.plotter.close()

    def show(self, time: float) -> None:
        """Move everything to a time, s."""
        motion = self.drawing.motion
        within = np.array([min(max(time, motion.start), motion.end)])
        position, quaternion = motion.at(within)
        for i, actors in enumerate(self.bodies):
            _put(actors, rotation_matrix(quaternion[0, i]), position[0, i])
        self._show_wheels(float(within[0]), position, quaternion)
        self._show_sea(time)
        self._show_wires(time, position, quaternion)
        place, target = self.camera.at(position[0])
        self.plotter.camera_position = [place.tolist(), target.tolist(), (0.0, 0.0, 1.0)]
        self.plotter.camera.view_angle = OPENING
        far = float(np.linalg.norm(place - target)) + 12.0 * self.drawing.radius
        self.plotter.camera.clipping_range = (1e-3 * far, far)
        self.text.set_text("lower_left", f"{self.drawing.title}    {time:.2f} s")

    def picture(self) -> NDArray[np.uint8]:
        """(height, width, 3)."""
        self.plotter.render()  # a screenshot repeats what was drawn last
        return np.asarray(self.plotter.screenshot(return_img=True))[..., :3]

    def _show_wheels(self, time: float, position: Array, quaternion: Array) -> None:
        frames = self.drawing.motion.times
        for wheel, actors in zip(self.drawing.wheels, self.wheels, strict=True):
            number = int(wheel.at[0])
            body = rotation_matrix(quaternion[0, number]) if number >= 0 else np.eye(3)
            turn = rotation_matrix(wheel.turned(frames, time))
            _put(actors, body @ turn, self.drawing.place(wheel.at, position, quaternion)[0])

    def _solid(self, look: Look, number: int) -> list[Any]:
        return [
            self.plotter.add_mesh(
                self.pv.PolyData.from_regular_faces(one.vertices, one.faces), color=one.colour, ambient=0.35,
                diffuse=0.75, smooth_shading=False,
            )
            for one in surfaces_of(look, number)
        ]  # fmt: skip

    def _sea(self) -> tuple[SeaSurface | None, Any]:
        drawing = self.drawing
        if without_sea(drawing.scene):
            return None, None
        sea = sea_surface(sea_components(drawing.scene), drawing.box.mean(axis=0)[:2], drawing.radius)
        points = np.column_stack([sea.place, np.zeros(len(sea.place))])
        water = self.pv.PolyData.from_regular_faces(points, sea.faces)
        water.point_data["Normals"] = np.tile((0.0, 0.0, 1.0), (len(points), 1))
        water.point_data.active_normals_name = "Normals"
        water.point_data["colour"] = sea.colours(points[:, 2])
        self.plotter.add_mesh(
            water, scalars="colour", rgb=True, opacity=0.82, ambient=0.5, diffuse=0.55, specular=0.25,
            specular_power=25, smooth_shading=True, split_sharp_edges=False,
        )  # fmt: skip
        return sea, water

    def _show_sea(self, time: float) -> None:
        if self.sea is None:
            return
        height, slope = self.sea.elevation(time)
        self.water.points = np.column_stack([self.sea.place, height])
        normal = np.column_stack([-2.2 * slope, np.ones(len(slope))])  # shaded steeper than it is, to be read
        self.water.point_data["Normals"][:] = normal / np.linalg.norm(normal, axis=1, keepdims=True)
        self.water.point_data["colour"][:] = self.sea.colours(height)
        self.water.Modified()

    def _show_wires(self, time: float, position: Array, quaternion: Array) -> None:
        for actor in self.wires:
            self.plotter.remove_actor(actor, render=False)
        self.wires = []
        for wire in self.drawing.wires:
            if self.drawing.absent(wire, np.asarray(time)):
                continue
            start, end = (place[0] for place in self.drawing.ends_of(wire, position, quaternion))
            points, slack = wire_line(start, end, wire["length"])
            colour = SLACK if slack else WIRES[wire["kind"]]
            actor = self._line(points, colour, self.drawing.radius_of(wire))
            self.wires += [] if actor is None else [actor]

    def _tracks(self) -> None:
        """Paths of tips and payloads over the whole run."""
        motion = self.drawing.motion
        if len(motion.position) < 2:
            return
        for track in self.drawing.tracks:
            points = self.drawing.place(track["at"], motion.position, motion.quaternion)
            self._line(points, TRACKS[track["kind"]], 0.5 * self.drawing.wire_radius)

    def _line(self, points: Array, colour: str, radius: float) -> Any:
        kept = points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])]
        if len(kept) < 2:
            return None
        line = self.pv.lines_from_points(kept).tube(radius=radius, n_sides=8)
        return self.plotter.add_mesh(line, color=colour, ambient=0.4, render=False)


def _put(actors: list[Any], turn: Array, place: Array) -> None:
    """Actors to a pose."""
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = turn, place
    for actor in actors:
        actor.user_matrix = pose
