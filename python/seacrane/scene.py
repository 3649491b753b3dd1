"""A scene: what moves, what joins it, what loads it. Describe it here, compile it, simulate it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.frames import axes_along, axes_across, rotation_matrix

if TYPE_CHECKING:
    import os

Array = NDArray[np.float64]
GROUND = "ground"
STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, kw_only=True)
class Waves:
    """A sea and the force transfer of a vessel in it, as plain arrays.

    Attributes
    ----------
    body : str
        The vessel's body.
    omega, amplitude, phase, direction : ndarray, shape (n,)
        rad/s, m, rad, rad (travelling to, from +x towards +y).
    transfer : ndarray, shape (n, 6), complex
        Force RAO at each component, N/m and N m/m about the body origin in the vessel's axes, exp(+i w t).
    position : tuple of float
        Mean position (x, y), m, where the phase is taken.
    relative_bound : float
        Bound on the table's interpolation error over the sum of component magnitudes; 0 sums exactly.
    information : mapping
        What is reported of the sea (seed, realised Hs, repeat period).
    """

    body: str
    omega: Array
    amplitude: Array
    phase: Array
    direction: Array
    transfer: NDArray[np.complex128]
    position: tuple[float, float] = (0.0, 0.0)
    relative_bound: float = 1e-9
    information: Mapping[str, Any] = field(default_factory=dict)

    def compile(self) -> _core.WaveLoads:
        """The loads for the compiled core; raises SceneError for shapes or values that make no sense."""
        waves = _core.WaveComponents(
            omega=self.omega, amplitude=self.amplitude, phase=self.phase, direction=self.direction
        )
        exact = _core.ExactWaveLoad(
            waves=waves, transfer=self.transfer, position=self.position, elevation_point=self.position
        )
        table = _core.WaveTable(load=exact, relative_bound=self.relative_bound) if self.relative_bound else None
        return _core.WaveLoads(name="waves", body=self.body, exact=exact, table=table)


@dataclass(kw_only=True)
class Scene:
    """Bodies, joints and loads by name; every `add_` method checks and returns the element it adds.

    Parameters
    ----------
    name : str
        Names files and reports.
    gravity : float
        m/s2, along -z.
    orientation : str
        State of orientation: "quaternion" (default), or "euler_xyz", the paper's angles, singular at
        phi_y = +-90 deg.
    baumgarte : float
        Frequency (1/s) of critically damped Baumgarte stabilisation; 0 (default) leaves it to projection.
    length_scale : float
        m; absolute tolerances are the relative tolerance times this length.
    """

    name: str = "scene"
    gravity: float = STANDARD_GRAVITY
    orientation: str = "quaternion"
    baumgarte: float = 0.0
    length_scale: float = 1.0
    bodies: dict[str, _core.Body] = field(default_factory=dict)
    joints: dict[str, _core.Joint] = field(default_factory=dict)
    drivers: dict[str, _core.Driver] = field(default_factory=dict)
    actuators: dict[str, _core.Actuator] = field(default_factory=dict)
    point_forces: dict[str, _core.PointForce] = field(default_factory=dict)
    springs: dict[str, _core.Spring] = field(default_factory=dict)
    force_tables: dict[str, _core.ForceTable] = field(default_factory=dict)
    function_forces: dict[str, _core.FunctionForce] = field(default_factory=dict)
    vessels: dict[str, _core.VesselHydrodynamics] = field(default_factory=dict)
    waves: Waves | None = None
    recorded: dict[str, tuple[str, str]] = field(default_factory=dict)
    notes: dict[str, Any] = field(default_factory=dict)

    def _insert(self, kind: str, table: dict[str, Any], element: Any) -> Any:
        if element.name in table:
            raise SceneError(f"{kind} {element.name!r}: the name is used twice; names of a kind must differ")
        table[element.name] = element
        return element

    def add_body(
        self,
        *,
        name: str,
        mass: float,
        inertia: Any,
        center_of_mass: Any = (0.0, 0.0, 0.0),
        position: Any = (0.0, 0.0, 0.0),
        quaternion: Any = (1.0, 0.0, 0.0, 0.0),
        velocity: Any = (0.0, 0.0, 0.0),
        angular_velocity: Any = (0.0, 0.0, 0.0),
        gravity: bool = True,
    ) -> _core.Body:
        """Add a rigid body.

        Parameters
        ----------
        name : str
        mass : float
            kg.
        inertia : array_like, shape (3, 3) or (3,)
            About the centre of mass in body axes, kg m2; three values are the diagonal.
        center_of_mass : array_like, shape (3,)
            From the body origin in body axes, m.
        position, quaternion : array_like
            Start pose of the body origin in the inertial frame; quaternion (w, x, y, z), body to inertial.
        velocity, angular_velocity : array_like, shape (3,)
            Of the body origin at the start, inertial axes, m/s and rad/s.
        gravity : bool
            Whether weight acts on it. The body of a vessel never gets weight: its restoring carries it.

        Raises
        ------
        SceneError
            For a duplicate name or a value that is not of that shape; values are checked at compile().
        """
        tensor = _numbers(f"body {name!r}: inertia", inertia)
        tensor = np.diag(tensor) if tensor.shape == (3,) else tensor
        body = _core.Body(
            name=name,
            mass=float(mass),
            inertia=_shaped(f"body {name!r}: inertia", tensor, (3, 3)),
            center_of_mass=_shaped(f"body {name!r}: center_of_mass", center_of_mass, (3,)),
            position=_shaped(f"body {name!r}: position", position, (3,)),
            quaternion=_shaped(f"body {name!r}: quaternion", quaternion, (4,)),
            velocity=_shaped(f"body {name!r}: velocity", velocity, (3,)),
            angular_velocity=_shaped(f"body {name!r}: angular_velocity", angular_velocity, (3,)),
            gravity=gravity,
        )
        inserted: _core.Body = self._insert("body", self.bodies, body)
        return inserted

    def _pose(self, joint: str, body: str) -> tuple[Array, Array]:
        if body == GROUND:
            return np.zeros(3), np.eye(3)
        if body not in self.bodies:
            raise SceneError(f"joint {joint!r}: there is no body {body!r}; add it first")
        described = self.bodies[body]
        return described.position, rotation_matrix(described.quaternion)

    def _frame(self, joint: str, body: str, point: Any, axes: Array) -> _core.Frame:
        position, rotation = self._pose(joint, body)
        where = _shaped(f"joint {joint!r}: point", point, (3,))
        return _core.Frame(point=rotation.T @ (where - position), axes=rotation.T @ axes)

    def add_joint(
        self,
        *,
        kind: str,
        name: str,
        first: str,
        second: str,
        point: Any = None,
        axis: Any = None,
        second_axis: Any = None,
        second_point: Any = None,
        length: float | None = None,
        first_frame: _core.Frame | None = None,
        second_frame: _core.Frame | None = None,
    ) -> _core.Joint:
        """Add a joint between two bodies; it may close a loop.

        Either `point` and `axis` in the inertial frame at the described pose, which also set the joint's
        zero, or a frame on each body.

        Parameters
        ----------
        kind : str
            weld, revolute, prismatic, cylindrical, universal, spherical, planar, distance or free.
        name, first, second : str
            The joint and its bodies; "ground" is the inertial frame.
        point : array_like, shape (3,)
            Joint point, m. Default: the origin of the second body.
        axis : array_like, shape (3,)
            Joint axis (any length): of rotation, of sliding, or normal to the plane; of a universal joint
            the one fixed on the first body. Default z.
        second_axis : array_like, shape (3,)
            Universal joint: the axis fixed on the second body, perpendicular to `axis`.
        second_point : array_like, shape (3,)
            Distance joint: the point on the second body.
        length : float
            Distance joint, m. Default: the distance at the described pose.
        first_frame, second_frame : Frame
            In body coordinates, instead of all the above.

        Raises
        ------
        SceneError
        """
        if (first_frame is None) != (second_frame is None):
            raise SceneError(f"joint {name!r}: has one frame only; give first_frame and second_frame, or neither")
        if first_frame is None or second_frame is None:
            at = self._pose(name, second)[0] if point is None else point
            along = axes_along(f"joint {name!r}: axis", (0.0, 0.0, 1.0) if axis is None else axis)
            across = along
            if second_axis is not None:
                across = axes_across(f"joint {name!r}: second_axis", along[:, 2], second_axis)
            elif kind == "universal":
                raise SceneError(f"joint {name!r}: a universal joint needs second_axis, fixed on the second body")
            other = at if second_point is None else second_point
            first_frame = self._frame(name, first, at, along)
            second_frame = self._frame(name, second, other, across)
            if kind == "distance" and length is None:
                if second_point is None:
                    raise SceneError(f"joint {name!r}: a distance joint needs second_point, or frames and length")
                length = float(np.linalg.norm(np.asarray(other, dtype=float) - np.asarray(at, dtype=float)))
        joint = _core.Joint(
            kind=kind,
            name=name,
            first=first,
            second=second,
            first_frame=first_frame,
            second_frame=second_frame,
            length=0.0 if length is None else float(length),
        )
        inserted: _core.Joint = self._insert("joint", self.joints, joint)
        return inserted

    def add_driver(
        self, *, joint: str, curve: _core.Curve, coordinate: str | None = None, name: str | None = None
    ) -> _core.Driver:
        """Prescribe a joint coordinate (m or rad) as a function of time.

        `coordinate`: "angle" of revolute, "displacement" of prismatic and cylindrical joints (their default),
        "x y z roll pitch yaw" of a free joint.
        """
        coordinate = self._coordinate("driver", joint, coordinate)
        name = name or f"{joint}.{coordinate}"
        driver = _core.Driver(name=name, joint=joint, coordinate=coordinate, curve=curve)
        inserted: _core.Driver = self._insert("driver", self.drivers, driver)
        return inserted

    def add_actuator(
        self,
        *,
        joint: str,
        name: str | None = None,
        coordinate: str | None = None,
        stiffness: float = 0.0,
        damping: float = 0.0,
        feed_forward: float | _core.Curve = 0.0,
        reference: float | _core.Curve = 0.0,
    ) -> _core.Actuator:
        """State feedback on a joint coordinate q, compiled into the loop.

        Load along q on both bodies: feed_forward + stiffness (reference - q) + damping (reference' - q'), N
        with N/m and N s/m, or N m with N m/rad and N m s/rad. `feed_forward` and `reference` are numbers or
        curves of time. Inputs "<name>.force" and "<name>.reference" add to them during a run.
        """
        actuator = _core.Actuator(
            name=name or joint,
            joint=joint,
            coordinate=self._coordinate("actuator", joint, coordinate),
            stiffness=float(stiffness),
            damping=float(damping),
            feed_forward=_curve(feed_forward),
            reference=_curve(reference),
        )
        inserted: _core.Actuator = self._insert("actuator", self.actuators, actuator)
        return inserted

    def add_point_force(
        self, *, name: str, body: str, force: Any, point: Any = (0.0, 0.0, 0.0), body_axes: bool = False
    ) -> _core.PointForce:
        """A constant force (N) at a point of a body (m, body coordinates), in inertial axes or, with
        `body_axes`, turning with the body. Input "<name>.force" (3 values) adds to it during a run."""
        element = _core.PointForce(
            name=name,
            body=body,
            point=_shaped(f"point force {name!r}: point", point, (3,)),
            force=_shaped(f"point force {name!r}: force", force, (3,)),
            body_axes=body_axes,
        )
        inserted: _core.PointForce = self._insert("point force", self.point_forces, element)
        return inserted

    def add_spring(
        self,
        *,
        name: str,
        first: str,
        second: str,
        first_point: Any = (0.0, 0.0, 0.0),
        second_point: Any = (0.0, 0.0, 0.0),
        stiffness: float = 0.0,
        damping: float = 0.0,
        natural_length: float = 0.0,
        lengths: Sequence[float] = (),
        forces: Sequence[float] = (),
    ) -> _core.Spring:
        """A spring-damper between points of two bodies (m, body coordinates): linear (N/m, N s/m, m), or a
        table of tension `forces` (N) over `lengths` (m)."""
        element = _core.Spring(
            name=name,
            first=first,
            second=second,
            first_point=_shaped(f"spring {name!r}: first_point", first_point, (3,)),
            second_point=_shaped(f"spring {name!r}: second_point", second_point, (3,)),
            stiffness=float(stiffness),
            damping=float(damping),
            natural_length=float(natural_length),
            lengths=[float(v) for v in lengths],
            forces=[float(v) for v in forces],
        )
        inserted: _core.Spring = self._insert("spring", self.springs, element)
        return inserted

    def add_force_table(
        self, *, name: str, body: str, times: Any, loads: Any, point: Any = (0.0, 0.0, 0.0)
    ) -> _core.ForceTable:
        """Force and moment `loads` (n, 6) in N and N m, inertial axes, about a point of the body (m, body
        coordinates), over `times` (n,) in s: linear in between, held outside."""
        rows = _numbers(f"force table {name!r}: loads", loads)
        if rows.ndim != 2 or rows.shape[1] != 6:
            raise SceneError(f"force table {name!r}: loads have shape {rows.shape}; give (n, 6)")
        element = _core.ForceTable(
            name=name,
            body=body,
            point=_shaped(f"force table {name!r}: point", point, (3,)),
            times=_numbers(f"force table {name!r}: times", times).tolist(),
            wrenches=rows,
        )
        inserted: _core.ForceTable = self._insert("force table", self.force_tables, element)
        return inserted

    def add_function_force(
        self, *, name: str, body: str, address: int, parameters: Sequence[float] = ()
    ) -> _core.FunctionForce:
        """A C function called in every evaluation, by its address (`numba.cfunc(...).address` or a `ctypes`
        pointer): void f(double t, const double* state13, const double* parameters, double* wrench6). State:
        position, quaternion, velocity, angular velocity of the body origin; wrench about it; inertial axes."""
        element = _core.FunctionForce(
            name=name, body=body, address=int(address), parameters=[float(v) for v in parameters]
        )
        inserted: _core.FunctionForce = self._insert("function force", self.function_forces, element)
        return inserted

    def add_vessel(self, *, body: str, name: str | None = None, **hydrodynamics: Any) -> _core.VesselHydrodynamics:
        """Linear hydrodynamics of a body about its origin; see `VesselHydrodynamics` for the arguments."""
        for key, shape in _VESSEL_SHAPES.items():
            if key in hydrodynamics:
                hydrodynamics[key] = _shaped(f"vessel {body!r}: {key}", hydrodynamics[key], shape)
        element = _core.VesselHydrodynamics(name=name or body, body=body, **hydrodynamics)
        inserted: _core.VesselHydrodynamics = self._insert("vessel", self.vessels, element)
        return inserted

    def record_coordinate(self, *, joint: str, coordinate: str | None = None, name: str | None = None) -> None:
        """Record a joint coordinate and its rate under a name (default: the joint's)."""
        coordinate = self._coordinate("recorded coordinate", joint, coordinate)
        self.recorded[name or joint] = (joint, coordinate)

    def _coordinate(self, kind: str, joint: str, coordinate: str | None) -> str:
        if joint not in self.joints:
            raise SceneError(f"{kind}: there is no joint {joint!r}; add it first")
        return coordinate or ("angle" if self.joints[joint].kind == "revolute" else "displacement")

    def compile(self) -> _core.Model:
        """Check everything, close the joints and compile.

        Raises
        ------
        SceneError
            Names the element, the value and the fix; for loops that do not close, the loop and its gap.

        Warns
        -----
        UserWarning
            Names joints that are consistent but redundant: their reactions are minimum-norm, not unique.
        """
        model = _core.compile(
            name=self.name,
            gravity=self.gravity,
            orientation=self.orientation,
            baumgarte=self.baumgarte,
            length_scale=self.length_scale,
            bodies=list(self.bodies.values()),
            joints=list(self.joints.values()),
            drivers=list(self.drivers.values()),
            actuators=list(self.actuators.values()),
            point_forces=list(self.point_forces.values()),
            springs=list(self.springs.values()),
            force_tables=list(self.force_tables.values()),
            function_forces=list(self.function_forces.values()),
            vessels=list(self.vessels.values()),
            wave_loads=[] if self.waves is None else [self.waves.compile()],
            coordinates=list(self.recorded.values()),
        )
        if model.redundant:
            import warnings

            warnings.warn(
                f"scene {self.name!r}: constraints of {', '.join(model.redundant)} are redundant "
                f"({model.constraints - model.assembly['rank']} more than needed); motion is unique, these "
                "reactions are not: the minimum-norm ones are given",
                stacklevel=2,
            )
        return model

    def copy(self, **changes: Any) -> Scene:
        """A scene with the same elements, which may be changed without touching this one."""
        tables = {
            key: dict(getattr(self, key))
            for key in self.__dataclass_fields__
            if isinstance(getattr(self, key), dict)
        }
        return replace(self, **{**tables, **changes})

    def report(self) -> dict[str, list[tuple[str, Any]]]:
        """What the compiled model holds: {section: [(name, value), ...]}."""
        from seacrane.scene_report import scene_report

        return scene_report(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene as JSON (data only); raises SceneError if it holds a C function."""
        from seacrane.scene_file import save_scene

        save_scene(self, path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene that `save` wrote; runs no code. Raises FileFormatError."""
        from seacrane.scene_file import load_scene

        return load_scene(path)


_VESSEL_SHAPES: dict[str, tuple[int, ...]] = {
    "added_mass": (6, 6),
    "linear_damping": (6, 6),
    "quadratic_damping": (6,),
    "restoring": (6, 6),
    "mooring_stiffness": (3,),
    "mooring_damping": (3,),
}


def _numbers(what: str, value: Any) -> Array:
    try:
        return np.asarray(value, dtype=float)
    except (TypeError, ValueError) as error:
        raise SceneError(f"{what} is {value!r}; give numbers") from error


def _shaped(what: str, value: Any, shape: tuple[int, ...]) -> Array:
    array = _numbers(what, value)
    if array.shape != shape:
        raise SceneError(f"{what} has shape {array.shape}; give {shape}")
    return array


def _curve(value: float | _core.Curve) -> _core.Curve:
    return value if isinstance(value, _core.Curve) else _core.Curve.constant(value=float(value))
