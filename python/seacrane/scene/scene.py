"""The scene that users write: what it holds, and a method for everything that may be added."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from seacrane import _core
from seacrane.analysis.implausible import warn_of_capsize
from seacrane.analysis.scene_report import elements_of, scene_report
from seacrane.description import compilation, elements, places
from seacrane.description.description import Description
from seacrane.inputs.caller import heard
from seacrane.inputs.keywords import named, no_attribute
from seacrane.plotting.table import Table, table_of
from seacrane.scene import (
    bodies,
    edit,
    file,
    heave,
    hoist,
    hydraulics,
    immersed,
    lift_factors,
    limits,
    lines,
    recorded,
    rigging,
    roles,
    sea,
    springs,
    vessel,
    wind_current,
)
from seacrane.scene.add_crane import add_crane
from seacrane.scene.ballast import add_ballast
from seacrane.scene.realised_sea import sea_at


def compile_scene(scene: Description, *, merge: bool = True) -> _core.Model:
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
    UnstableRestWarning : names vessels whose roll restoring the weights on them outweigh.
    RedundantJointsWarning : names joints that are redundant: their reactions are minimum-norm, not unique.
    """
    warn_of_capsize(scene)
    return compilation.compile_scene(scene, merge=merge)


@named
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
    groups, points
        Elements by name, immutable; `loads` are all that puts forces on
        bodies, by kind: wind, lines, springs, oil, friction and the rest.
        `vessels[name].database` is what that vessel was added from.
    waves : Waves or None
    recorded, ranges, limit_states, clearances, channels, ratings, lift_factors, roles, provenance, meshes,
    notes
        As of `Description`: what is recorded, where coordinates are meant to stay, what channels may reach,
        which distances and expressions are recorded, the parts of cranes, where vessels come from, what
        bodies are drawn by, and the user's own notes.
    """

    add_body = bodies.add_body
    add_joint = elements.add_joint
    add_driver = elements.add_driver
    add_actuator = elements.add_actuator
    add_point = recorded.add_point
    add_limit_state = recorded.add_limit_state
    add_lift_factors = lift_factors.add_lift_factors
    add_channel = recorded.add_channel
    add_force = elements.add_force
    add_spring = springs.add_spring
    add_load = elements.add_load

    add_stop = limits.add_stop
    add_line = lines.add_line
    add_winch = rigging.add_winch
    add_friction = limits.add_friction
    add_contact = limits.add_contact
    add_heave_compensation = heave.add_heave_compensation
    add_hydraulic_cylinder = hydraulics.add_hydraulic_cylinder
    hold_pressures = hydraulics.hold_pressures

    add_vessel = vessel.add_vessel
    add_immersed = immersed.add_immersed
    add_sea = sea.add_sea
    sea_at = sea_at
    add_ballast = add_ballast
    add_wind = wind_current.add_wind
    add_current = wind_current.add_current

    add_crane = add_crane
    add_roles = roles.add_roles
    add_hoist = hoist.add_hoist
    add_mesh = bodies.add_mesh

    place_of = places.place_of

    compile = compile_scene
    replace = edit.replace_element
    remove = edit.remove_element

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Description):
            return NotImplemented
        alike = file.described(self) == file.described(other)
        return alike and self.function_forces == other.function_forces

    __hash__ = None  # type: ignore[assignment]  # what changes has no hash

    def __str__(self) -> str:
        return str(as_table(self))

    def _repr_html_(self) -> str:
        return as_table(self)._repr_html_()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            raise no_attribute(self, name)

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


def as_table(scene: Description) -> Table:
    """Kinds of element, their number and the names of each."""
    found = [(kind, list(names)) for kind, names in elements_of(scene)]
    found.append(("points", [f"{name} ({at.body})" for name, at in scene.points.items()]))
    found.append(("recorded", [f"{name} ({joint} {c})" for name, (joint, c) in scene.recorded.items()]))
    bounds = {name: f"{one.minimum + 0.0:g} to {one.maximum + 0.0:g}" for name, one in scene.ranges.items()}
    found.append(("ranges", [f"{name} ({bound})" for name, bound in bounds.items()]))
    others = ("limit_states", "clearances", "channels", "lift_factors", "meshes")
    found += [(key.replace("_", " "), list(getattr(scene, key))) for key in others]
    held = [(kind, len(names), ", ".join(names)) for kind, names in found if names]
    title = f"Scene {scene.name!r}, gravity {scene.gravity:g} m/s2"
    return table_of(("", "number", "names"), held, title=title, remarks=() if held else ["empty"])
