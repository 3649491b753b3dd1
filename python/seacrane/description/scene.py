"""A scene: what moves, what joins it, what loads it. Describe it here, compile it, simulate it."""

from __future__ import annotations

from collections.abc import Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.description.assembled import warn_of_moves
from seacrane.description.waves import Waves
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import (
    curve_of,
    flag_of,
    name_of,
    number_of,
    numbers_of,
    shaped_of,
    text_of,
    vector_of,
)
from seacrane.inputs.frames import axes_across, axes_along, rotation_matrix

if TYPE_CHECKING:
    import os

Array = NDArray[np.float64]
GROUND = "ground"
STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True, kw_only=True)
class Range:
    """Where a joint coordinate is meant to stay, m or rad, such as a cylinder's stroke."""

    name: str
    joint: str
    coordinate: str
    minimum: float
    maximum: float


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
        Multiplies the lengths (0.1 m, 0.1 m/s) that tolerances refer to; see `simulate`.
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
    loads: dict[str, Any] = field(default_factory=dict)
    vessels: dict[str, _core.VesselHydrodynamics] = field(default_factory=dict)
    waves: Waves | None = None
    recorded: dict[str, tuple[str, str]] = field(default_factory=dict)
    ranges: dict[str, Range] = field(default_factory=dict)
    notes: dict[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        for key in self.__dataclass_fields__:  # a table belongs to one scene
            if isinstance(getattr(self, key), dict):
                setattr(self, key, dict(getattr(self, key)))
        self.notes = deepcopy(self.notes)

    def __repr__(self) -> str:
        tables = ("bodies", "joints", "drivers", "actuators", "point_forces", "springs", "force_tables",
                  "function_forces", "loads", "vessels")  # fmt: skip
        held = [
            f"{len(getattr(self, table))} {table.replace('_', ' ')}"
            for table in tables
            if getattr(self, table)
        ]
        sea = ["waves"] if self.waves is not None else []
        return f"<Scene {self.name!r}: {', '.join([*held, *sea]) or 'empty'}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        from seacrane.description.file import described

        return described(self) == described(other) and self.function_forces == other.function_forces

    def __copy__(self) -> Scene:
        return self.copy()

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
        tensor = numbers_of(f"body {name!r}: inertia", inertia)
        tensor = np.diag(tensor) if tensor.shape == (3,) else tensor
        body = _core.Body(
            name=name_of("body", name),
            mass=number_of(f"body {name!r}: mass", mass),
            inertia=shaped_of(f"body {name!r}: inertia", tensor, (3, 3)),
            center_of_mass=shaped_of(f"body {name!r}: center_of_mass", center_of_mass, (3,)),
            position=shaped_of(f"body {name!r}: position", position, (3,)),
            quaternion=shaped_of(f"body {name!r}: quaternion", quaternion, (4,)),
            velocity=shaped_of(f"body {name!r}: velocity", velocity, (3,)),
            angular_velocity=shaped_of(f"body {name!r}: angular_velocity", angular_velocity, (3,)),
            gravity=flag_of(f"body {name!r}: gravity", gravity),
        )
        inserted: _core.Body = self._insert("body", self.bodies, body)
        return inserted

    def _pose(self, joint: str, body: str) -> tuple[Array, Array]:
        if text_of(f"joint {joint!r}: body", body) == GROUND:
            return np.zeros(3), np.eye(3)
        if body not in self.bodies:
            raise SceneError(f"joint {joint!r}: there is no body {body!r}; add it first")
        described = self.bodies[body]
        if not np.linalg.norm(described.quaternion) > 0.0:
            raise SceneError(f"body {body!r}: quaternion is {described.quaternion.tolist()}; normalise it")
        return described.position, rotation_matrix(described.quaternion)

    def _frame(self, joint: str, body: str, point: Any, axes: Array) -> _core.Frame:
        position, rotation = self._pose(joint, body)
        where = shaped_of(f"joint {joint!r}: point", point, (3,))
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
        name_of("joint", name)
        text_of(f"joint {name!r}: kind", kind)
        for key, value, owner in (
            ("length", length, "distance"),
            ("second_point", second_point, "distance"),
            ("second_axis", second_axis, "universal"),
        ):
            if value is not None and kind != owner:
                raise SceneError(
                    f"joint {name!r}: {key} belongs to a {owner} joint, this one is {kind}; leave it out"
                )
        if (first_frame is None) != (second_frame is None):
            raise SceneError(
                f"joint {name!r}: has one frame only; give first_frame and second_frame, or neither"
            )
        if first_frame is None or second_frame is None:
            at = self._pose(name, second)[0] if point is None else point
            along = axes_along(f"joint {name!r}: axis", (0.0, 0.0, 1.0) if axis is None else axis)
            across = along
            if second_axis is not None:
                across = axes_across(f"joint {name!r}: second_axis", along[:, 2], second_axis)
            elif kind == "universal":
                raise SceneError(
                    f"joint {name!r}: a universal joint needs second_axis, fixed on the second body"
                )
            other = at if second_point is None else second_point
            first_frame = self._frame(name, first, at, along)
            second_frame = self._frame(name, second, other, across)
            if kind == "distance" and length is None:
                if second_point is None:
                    raise SceneError(
                        f"joint {name!r}: a distance joint needs second_point, or frames and length"
                    )
                between = shaped_of(f"joint {name!r}: second_point", other, (3,)) - np.asarray(
                    at, dtype=float
                )
                length = float(np.linalg.norm(between))
        for frame in (first_frame, second_frame):
            if not isinstance(frame, _core.Frame):
                raise SceneError(f"joint {name!r}: a frame is {frame!r}; give a seacrane.Frame")
        joint = _core.Joint(
            kind=kind,
            name=name,
            first=text_of(f"joint {name!r}: first", first),
            second=text_of(f"joint {name!r}: second", second),
            first_frame=first_frame,
            second_frame=second_frame,
            length=0.0 if length is None else number_of(f"joint {name!r}: length", length),
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
        name = name_of("driver", name, f"{joint}.{coordinate}")
        if not isinstance(curve, _core.Curve):
            raise SceneError(f"driver {name!r}: curve is {curve!r}; give a seacrane.Curve")
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
        coordinate = self._coordinate("actuator", joint, coordinate)
        name = name_of("actuator", name, joint)
        actuator = _core.Actuator(
            name=name,
            joint=joint,
            coordinate=coordinate,
            stiffness=number_of(f"actuator {name!r}: stiffness", stiffness),
            damping=number_of(f"actuator {name!r}: damping", damping),
            feed_forward=curve_of(f"actuator {name!r}: feed_forward", feed_forward),
            reference=curve_of(f"actuator {name!r}: reference", reference),
        )
        inserted: _core.Actuator = self._insert("actuator", self.actuators, actuator)
        return inserted

    def add_point_force(
        self, *, name: str, body: str, force: Any, point: Any = (0.0, 0.0, 0.0), body_axes: bool = False
    ) -> _core.PointForce:
        """A constant force (N) at a point of a body (m, body coordinates), in inertial axes or, with
        `body_axes`, turning with the body. Input "<name>.force" (3 values) adds to it during a run."""
        element = _core.PointForce(
            name=name_of("point force", name),
            body=text_of(f"point force {name!r}: body", body),
            point=shaped_of(f"point force {name!r}: point", point, (3,)),
            force=shaped_of(f"point force {name!r}: force", force, (3,)),
            body_axes=flag_of(f"point force {name!r}: body_axes", body_axes),
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
            name=name_of("spring", name),
            first=text_of(f"spring {name!r}: first", first),
            second=text_of(f"spring {name!r}: second", second),
            first_point=shaped_of(f"spring {name!r}: first_point", first_point, (3,)),
            second_point=shaped_of(f"spring {name!r}: second_point", second_point, (3,)),
            stiffness=number_of(f"spring {name!r}: stiffness", stiffness),
            damping=number_of(f"spring {name!r}: damping", damping),
            natural_length=number_of(f"spring {name!r}: natural_length", natural_length),
            lengths=vector_of(f"spring {name!r}: lengths", lengths),
            forces=vector_of(f"spring {name!r}: forces", forces),
        )
        inserted: _core.Spring = self._insert("spring", self.springs, element)
        return inserted

    def add_force_table(
        self, *, name: str, body: str, times: Any, loads: Any, point: Any = (0.0, 0.0, 0.0)
    ) -> _core.ForceTable:
        """Force and moment `loads` (n, 6) in N and N m, inertial axes, about a point of the body (m, body
        coordinates), over `times` (n,) in s: linear in between, held outside."""
        rows = numbers_of(f"force table {name!r}: loads", loads)
        if rows.ndim != 2 or rows.shape[1] != 6:
            raise SceneError(f"force table {name!r}: loads have shape {rows.shape}; give (n, 6)")
        element = _core.ForceTable(
            name=name_of("force table", name),
            body=text_of(f"force table {name!r}: body", body),
            point=shaped_of(f"force table {name!r}: point", point, (3,)),
            times=vector_of(f"force table {name!r}: times", times),
            wrenches=rows,
        )
        inserted: _core.ForceTable = self._insert("force table", self.force_tables, element)
        return inserted

    def add_function_force(
        self, *, name: str, body: str, address: int, parameters: Sequence[float] = ()
    ) -> _core.FunctionForce:
        """A C function called in every evaluation, by its address (`numba.cfunc(...).address` or a `ctypes`
        pointer): void f(double t, const double* state13, const double* parameters, double* wrench6). State:
        position, quaternion, velocity, angular velocity of the body origin; wrench about it; inertial axes.
        """
        if not isinstance(address, int) or not 0 < address < 2**64:
            raise SceneError(
                f"function force {name!r}: address is {address!r}; give the address of a C function"
            )
        element = _core.FunctionForce(
            name=name_of("function force", name),
            body=text_of(f"function force {name!r}: body", body),
            address=address,
            parameters=vector_of(f"function force {name!r}: parameters", parameters),
        )
        inserted: _core.FunctionForce = self._insert("function force", self.function_forces, element)
        return inserted

    def add_load(self, element: Any) -> Any:
        """Add a described load of a kind in `seacrane.description.loads`, such as a FlowForce; returns it."""
        from seacrane.description.loads import kind_of

        return self._insert(kind_of(element), self.loads, element)

    def add_vessel(
        self, *, body: str, name: str | None = None, **hydrodynamics: Any
    ) -> _core.VesselHydrodynamics:
        """Linear hydrodynamics of a body about its origin; see `VesselHydrodynamics` for the arguments."""
        name = name_of("vessel", name, body)
        for key, value in hydrodynamics.items():
            what = f"vessel {name!r}: {key}"
            if key in _VESSEL_SHAPES:
                hydrodynamics[key] = shaped_of(what, value, _VESSEL_SHAPES[key])
            elif key == "memory":
                blocks = list(value) if isinstance(value, Sequence) else [value]
                states = all(isinstance(block, _core.StateSpaceBlock) for block in blocks)
                if not (states or isinstance(value, _core.RetardationFunctions)):
                    kinds = "a list of seacrane.StateSpaceBlock or seacrane.RetardationFunctions"
                    raise SceneError(f"{what} is {value!r}; give {kinds}")
            elif key == "kinematics":
                text_of(what, value)
            else:
                known = ", ".join([*_VESSEL_SHAPES, "memory", "kinematics"])
                raise SceneError(f"{what} is unknown; a vessel takes {known}")
        element = _core.VesselHydrodynamics(
            name=name, body=text_of(f"vessel {name!r}: body", body), **hydrodynamics
        )
        inserted: _core.VesselHydrodynamics = self._insert("vessel", self.vessels, element)
        return inserted

    def record_coordinate(
        self, *, joint: str, coordinate: str | None = None, name: str | None = None
    ) -> None:
        """Record a joint coordinate and its rate under a name (default: the joint's)."""
        coordinate = self._coordinate("recorded coordinate", joint, coordinate)
        name = name_of("recorded coordinate", name, joint)
        if self.recorded.get(name, (joint, coordinate)) != (joint, coordinate):
            raise SceneError(
                f"recorded coordinate {name!r}: is {'.'.join(self.recorded[name])} already; give another name"
            )
        self.recorded[name] = (joint, coordinate)

    def add_range(
        self,
        *,
        joint: str,
        minimum: float,
        maximum: float,
        coordinate: str | None = None,
        name: str | None = None,
    ) -> Range:
        """Tell where a joint coordinate is meant to stay, m or rad; it exerts no load (`add_end_stop` does).

        A reference that leaves it is refused when a run starts, a motion that does is warned of after the run
        (OutsideRangeWarning). A crane adds the strokes of its data file.
        """
        coordinate = self._coordinate("range", joint, coordinate)
        name = name_of("range", name, joint)
        low = number_of(f"range {name!r}: minimum", minimum)
        high = number_of(f"range {name!r}: maximum", maximum)
        if not low < high:
            raise SceneError(
                f"range {name!r}: minimum is {low} and maximum {high}; the minimum must be below the maximum"
            )
        element = Range(name=name, joint=joint, coordinate=coordinate, minimum=low, maximum=high)
        inserted: Range = self._insert("range", self.ranges, element)
        return inserted

    def _coordinate(self, kind: str, joint: str, coordinate: str | None) -> str:
        if text_of(f"{kind}: joint", joint) not in self.joints:
            raise SceneError(f"{kind}: there is no joint {joint!r}; add it first")
        usual = "angle" if self.joints[joint].kind == "revolute" else "displacement"
        return text_of(f"{kind} of joint {joint!r}: coordinate", coordinate, usual)

    def compile(self, *, merge: bool = True) -> _core.Model:
        """Check everything, close the joints and compile.

        Parameters
        ----------
        merge : bool
            Step bodies that never move relative to each other as one and leave out what adds nothing.

        Raises
        ------
        SceneError
            Names the element, the value and the fix; for loops that do not close, the loop and its gap.

        Warns
        -----
        AssemblyWarning : names bodies that closing the joints moved, by more than 0.01 m or 0.01 rad.
        UserWarning : names joints that are redundant: their reactions are minimum-norm, not unique.
        """
        model = _core.compile(
            name=name_of("scene", self.name),
            gravity=number_of(f"scene {self.name!r}: gravity", self.gravity),
            orientation=text_of(f"scene {self.name!r}: orientation", self.orientation),
            baumgarte=number_of(f"scene {self.name!r}: baumgarte", self.baumgarte),
            length_scale=number_of(f"scene {self.name!r}: length_scale", self.length_scale),
            bodies=list(self.bodies.values()),
            joints=list(self.joints.values()),
            drivers=list(self.drivers.values()),
            loads=[
                *self.actuators.values(),
                *self.point_forces.values(),
                *self.springs.values(),
                *self.force_tables.values(),
                *self.function_forces.values(),
                *self.loads.values(),
            ],
            vessels=list(self.vessels.values()),
            wave_loads=[] if self.waves is None else self.waves.compile(prune=merge),
            coordinates=list(self.recorded.values()),
            merge=merge,
        )
        warn_of_moves(self, model)
        if model.redundant:
            warn_caller(
                f"scene {self.name!r}: constraints of {', '.join(model.redundant)} are redundant "
                f"({model.constraints - model.assembly['rank']} more than needed); motion is unique, these "
                "reactions are not: the minimum-norm ones are given",
                UserWarning,
            )
        model.compiled_from = (self.copy(), merge)
        return model

    def copy(self, **changes: Any) -> Scene:
        """A scene with the same elements, which may be changed without touching this one."""
        return replace(self, **changes)

    def report(self) -> dict[str, list[tuple[str, Any]]]:
        """What the compiled model holds: {section: [(name, value), ...]}."""
        from seacrane.analysis.scene_report import scene_report

        return scene_report(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene as JSON (data only); raises SceneError if it holds a C function."""
        from seacrane.description.file import save_scene

        save_scene(self, path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene that `save` wrote; runs no code. Raises FileFormatError."""
        from seacrane.description.file import load_scene

        return load_scene(path)


def compiled(scene: Scene, merge: bool) -> _core.Model:
    """The model of a scene: how a pickled model comes back."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # given when it was compiled first
        return scene.compile(merge=merge)


_VESSEL_SHAPES: dict[str, tuple[int, ...]] = {
    "added_mass": (6, 6),
    "linear_damping": (6, 6),
    "quadratic_damping": (6,),
    "restoring": (6, 6),
    "mooring_stiffness": (3,),
    "mooring_damping": (3,),
}
