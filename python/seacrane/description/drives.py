"""What moves joint coordinates: drivers and actuators."""

from __future__ import annotations

from seacrane import _core
from seacrane.description.crane_parts import drive_named
from seacrane.description.description import Description, coordinate_of, insert
from seacrane.inputs.checked import curve_of, name_of, text_of


def add_driver(
    scene: Description,
    joint: str,
    *,
    curve: _core.Curve | float,
    coordinate: str | None = None,
    name: str | None = None,
) -> _core.Driver:
    """Prescribe a joint coordinate (m or rad) as a function of time; a number holds it there.

    `joint` may be what a crane calls its drive, such as "slew" or "main"; the default name is that of the
    joint itself and of its coordinate, such as "main_cylinder.displacement".
    `coordinate`: "angle" of revolute, "displacement" of prismatic and cylindrical joints (their default),
    "x y z roll pitch yaw" of a free joint.
    """
    joint, coordinate = _place(scene, "driver", joint, coordinate)
    name = name_of("driver", name, f"{joint}.{coordinate}")
    path = curve_of(f"driver {name!r}: curve", curve)
    driver = _core.Driver(name=name, joint=joint, coordinate=coordinate, curve=path)
    inserted: _core.Driver = insert("driver", scene.drivers, driver)
    return inserted


def add_actuator(
    scene: Description,
    joint: str,
    *,
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
    curves of time. Inputs "<name>.force" and "<name>.reference" add to them during a run. `joint` may be what
    a crane calls its drive, such as "slew" or "main"; as it is given, it is the default name.
    """
    name = name_of("actuator", name, joint)
    joint, coordinate = _place(scene, "actuator", joint, coordinate)
    actuator = _core.Actuator(
        name=name,
        joint=joint,
        coordinate=coordinate,
        stiffness=stiffness,
        damping=damping,
        feed_forward=feed_forward,
        reference=reference,
    )
    inserted: _core.Actuator = insert("actuator", scene.actuators, actuator)
    return inserted


def _place(scene: Description, kind: str, joint: str, coordinate: str | None) -> tuple[str, str]:
    """Joint and coordinate, also where a crane's drive is called by its label."""
    known = text_of(f"{kind}: joint", joint) in scene.joints
    drive = None if known else drive_named(scene, joint)
    return drive or (joint, coordinate_of(scene, kind, joint, coordinate))
