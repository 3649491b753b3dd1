"""The scene that users write: what it holds, and a method for everything that may be added."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from seacrane.analysis.ballast import add_ballast
from seacrane.analysis.scene_report import scene_report
from seacrane.crane.add_crane import add_crane
from seacrane.description import (
    bodies,
    clearances,
    crane_parts,
    damping,
    drives,
    edit,
    file,
    forces,
    joints,
    limit_states,
    meshes,
    places,
    recorded,
)
from seacrane.description.description import Description
from seacrane.inputs.caller import heard
from seacrane.renamed import METHODS
from seacrane.scene import (
    bridles,
    compiling,
    drift,
    given_vessel,
    heave,
    hoist,
    hydraulics,
    limits,
    lines,
    luffing,
    position,
    sea,
    slack_tank,
    table_text,
    vessel,
    wind_current,
)


class Scene(Description):
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

    Attributes
    ----------
    bodies, joints, drivers, actuators, point_forces, springs, force_tables, function_forces, loads, vessels,
    points
        Elements by name, immutable; `loads` are all that puts forces on
        bodies, by kind: wind, lines, springs, oil, friction and the rest.
        `vessels[name].database` is what that vessel was added from.
    waves : Waves or None
    recorded, ranges, limit_states, clearances, roles, provenance, meshes, notes
        As of `Description`: what is recorded, where coordinates are meant to stay, what channels may reach,
        which distances are recorded, the parts of cranes, where vessels come from, what bodies are drawn by,
        and the user's own notes.
    """

    add_body = bodies.add_body
    add_joint = joints.add_joint
    add_driver = drives.add_driver
    add_actuator = drives.add_actuator
    record_coordinate = recorded.record_coordinate
    add_range = recorded.add_range
    add_point = recorded.add_point
    add_limit_state = limit_states.add_limit_state
    add_clearance = clearances.add_clearance
    add_point_force = forces.add_point_force
    add_spring = forces.add_spring
    add_force_table = forces.add_force_table
    add_function_force = forces.add_function_force
    add_load = forces.add_load

    add_pendulum_damping = damping.add_pendulum_damping
    add_air_drag = damping.add_air_drag

    add_end_stop = limits.add_end_stop
    add_seat = limits.add_seat
    add_soft_stop = limits.add_soft_stop
    add_line = lines.add_line
    add_winch = lines.add_winch
    add_bridle = bridles.add_bridle
    add_friction = limits.add_friction
    add_heave_compensation = heave.add_heave_compensation
    add_gas_spring = heave.add_gas_spring
    add_hydraulic_cylinder = hydraulics.add_hydraulic_cylinder
    hold_pressures = hydraulics.hold_pressures

    add_vessel = vessel.add_vessel
    add_given_vessel = given_vessel.add_given_vessel
    add_slack_tank = slack_tank.add_slack_tank
    add_sea = sea.add_sea
    add_ballast = add_ballast
    add_drift = drift.add_drift
    use_actual_position = position.use_actual_position
    use_slow_position = position.use_slow_position
    add_wind = wind_current.add_wind
    add_current = wind_current.add_current

    add_crane = add_crane
    add_roles = crane_parts.add_roles
    add_hoist = hoist.add_hoist
    add_luffing_rope = luffing.add_luffing_rope
    add_mesh = meshes.add_mesh

    place_of = places.place_of

    compile = compiling.compile_scene
    replace = edit.replace_element
    remove = edit.remove_element

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Description):
            return NotImplemented
        alike = file.described(self) == file.described(other)
        return alike and self.function_forces == other.function_forces

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            gone = f" since 0.3; {METHODS[name]}" if name in METHODS else ""
            raise AttributeError(f"{type(self).__name__} has no {name!r}{gone}", name=name, obj=self)

    __hash__ = None  # type: ignore[assignment]  # what changes has no hash

    def __str__(self) -> str:
        return table_text.as_text(self)

    def _repr_html_(self) -> str:
        return table_text.as_html(self)

    def report(self) -> dict[str, list[tuple[str, Any]]]:
        """What the compiled model holds: {section: [(name, value), ...]}."""
        return scene_report(self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene as JSON (data only); raises SceneError if it holds a C function."""
        file.save_scene(self, path)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene that `save` wrote; runs no code. Raises FileFormatError."""
        return file.load_scene(path, cls())


for _name, _method in list(vars(Scene).items()):
    if _name.startswith(("add_", "use_", "hold_")):
        setattr(Scene, _name, heard(_method))
