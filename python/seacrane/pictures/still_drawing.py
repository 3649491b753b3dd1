"""A drawing set up in pyvista: bodies, wheels, sea, wires and tracks, moved from time to time.

The sea is a round sheet of triangles, finer towards its middle, and exact at its points.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.camera import OPENING, Camera
from seacrane.pictures.drawing import Drawing
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.page_sea import sea_components, without_sea
from seacrane.pictures.palette import SKY, SLACK, TRACKS, WIRES, rgb
from seacrane.pictures.surfaces import surfaces_of

Array = NDArray[np.float64]

MISSING = "pictures without a browser need pyvista: install it by pip install 'seacrane[stills]'"
POINTS = 33
TAUT = 1e-3  # of the length: what is shorter by less hangs straight
RINGS = 90
REACH = 9.0  # radius over that of the things in it
DEEP, CREST = (0.03, 0.17, 0.27), (0.20, 0.50, 0.58)  # colours of troughs and crests, rgb
FADES = (0.3, 0.95)  # of the radius, between which the water turns into sky


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


def wire_line(start: Array, end: Array, length: float) -> tuple[Array, bool]:
    """Points (n, 3) from start to end, m, and whether the wire is slack; a length of 0 never is."""
    chord = float(np.linalg.norm(end - start))
    if not (length > 0.0 and chord < length * (1.0 - TAUT)):
        return np.array([start, end]), False
    return _half_wave(start, end, length), True


def _half_wave(start: Array, end: Array, length: float) -> Array:
    """Downwards or, under a vertical chord, sideways, as high as the length asks for."""
    along = end - start
    chord = max(float(np.linalg.norm(along)), 1e-6 * length)
    along = along / chord
    side = np.array([0.0, 0.0, -1.0]) + along * along[2]
    if np.linalg.norm(side) < 0.2:
        side = np.array([1.0, 0.0, 0.0]) - along * along[0]
    side /= np.linalg.norm(side)
    u = np.linspace(0.0, 1.0, POINTS)[:, None]
    low, high = 0.0, length
    for _ in range(30):
        depth = 0.5 * (low + high)
        points = start + along * chord * u + side * depth * np.sin(np.pi * u)
        if np.linalg.norm(np.diff(points, axis=0), axis=1).sum() < length:
            low = depth
        else:
            high = depth
    return np.asarray(points)


@dataclass(frozen=True, kw_only=True, eq=False)
class SeaSurface:
    """A sheet of points `place` (n, 2), m, with triangles `faces` (m, 3); `far` (n,) is 0 to 1 outwards."""

    components: Array
    place: Array
    faces: NDArray[np.intp]
    far: Array

    def elevation(self, time: float) -> tuple[Array, Array]:
        """Heights (n,), m, and slopes (n, 2), of the sum of all components at a time, s."""
        amplitude, omega, phase, kx, ky = self.components.T
        angle = np.remainder(omega * time + phase, 2.0 * np.pi) - self.place @ np.array([kx, ky])
        rise = amplitude * np.sin(angle)
        return np.cos(angle) @ amplitude, np.column_stack([rise @ kx, rise @ ky])

    def colours(self, height: Array) -> NDArray[np.uint8]:
        """(n, 3): darker in troughs, sky far out."""
        usual = float(np.sqrt(np.sum(self.components[:, 0] ** 2))) or 0.5
        up = np.clip(0.45 + 0.3 * height / usual, 0.0, 1.0)[:, None]
        out = np.clip((self.far - FADES[0]) / (FADES[1] - FADES[0]), 0.0, 1.0)[:, None]
        out = out**2 * (3.0 - 2.0 * out)
        water = np.array(DEEP) * (1.0 - up) + np.array(CREST) * up
        return np.asarray(np.rint(255.0 * (water * (1.0 - out) + np.array(rgb(SKY)) * out)), dtype=np.uint8)


def sea_surface(components: Array, centre: Array, radius: float) -> SeaSurface:
    """Of components as of `sea_components`, about a centre (2,), for things of that radius, m."""
    spokes = 2 * RINGS
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(1, RINGS + 1), np.arange(spokes), indexing="ij"))
    u, angle = i / RINGS, 2.0 * np.pi * (j + 0.5 * (i % 2)) / spokes
    far = 0.22 * u + 0.78 * u**4
    ring = (REACH * radius * far)[:, None] * np.column_stack([np.cos(angle), np.sin(angle)])
    place = np.concatenate([np.zeros((1, 2)), ring]) + centre
    number = np.arange(1, 1 + RINGS * spokes).reshape(RINGS, spokes)
    after = np.roll(number, -1, axis=1)
    a, b, c, d = (one.ravel() for one in (number[:-1], number[1:], after[1:], after[:-1]))
    middle = np.column_stack([np.zeros(spokes, dtype=int), number[0], after[0]])
    faces = np.concatenate([middle, np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    return SeaSurface(components=components, place=place, faces=faces, far=np.concatenate([[0.0], far]))
