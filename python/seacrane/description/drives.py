"""What moves joint coordinates: drivers and actuators."""

from __future__ import annotations

from seacrane import _core
from seacrane.description.scene import Description, coordinate_of, insert
from seacrane.inputs.checked import curve_of, name_of


def add_driver(
    scene: Description,
    joint: str,
    *,
    curve: _core.Curve | float,
    coordinate: str | None = None,
    name: str | None = None,
) -> _core.Driver:
    """Prescribe a joint coordinate (m or rad) as a function of time; a number holds it there.

    `coordinate`: "angle" of revolute, "displacement" of prismatic and cylindrical joints (their default),
    "x y z roll pitch yaw" of a free joint.
    """
    coordinate = coordinate_of(scene, "driver", joint, coordinate)
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
    curves of time. Inputs "<name>.force" and "<name>.reference" add to them during a run.
    """
    coordinate = coordinate_of(scene, "actuator", joint, coordinate)
    name = name_of("actuator", name, joint)
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
