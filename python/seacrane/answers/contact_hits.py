"""How often and how hard the points of contacts were hit in a run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from seacrane import _core
from seacrane.arrays import Array
from seacrane.description.description import GROUND
from seacrane.description.given import beside_surface, borne_mass
from seacrane.errors import SceneError
from seacrane.inputs.frames import rotation_matrix
from seacrane.result.result import Result


@dataclass(frozen=True, kw_only=True)
class ContactHit:
    """One time that a point of a contact was closed.

    Attributes
    ----------
    point : Such as "landing.1".
    number : 1 for the first time, 2 and on for re-hits; 0 where the run began with it closed.
    begin, end : s; the run's own where it began or ended closed.
    speed : At which the point came, m/s; 0 where the run began with it closed.
    peak, impulse : Largest force away from the surface, N; its trapezoidal sum over the outputs, N s.
    dynamic_factor : float
        Peak over the point's share of the body's weight, of the other body where this one is the ground or a
        ship whose motion is given; not a number without gravity.
    undamped : float
        Share of the weight onto the surface + speed sqrt(stiffness mass), N, with the share of the mass: the
        peak of a hit by that mass alone, without damping, which may raise it. A bumper on a wall bears no
        weight; without the channels "position" and "quaternion" all of it counts. Not a number for a table.
    """

    point: str
    number: int
    begin: float
    end: float
    speed: float
    peak: float
    impulse: float
    dynamic_factor: float
    undamped: float


def contact_hits(result: Result, contact: str) -> tuple[ContactHit, ...]:
    """Each time that a point of a contact was closed: when, how fast, with what peak and impulse.

    Parameters
    ----------
    result : Result
        With the channel "contact_press". The impulse is that of its outputs: 20 outputs within a hit give it
        to about 1 %.
    contact : str
        Name of the contact.

    Returns
    -------
    tuple of ContactHit
        By point, then by time. The first of a point has number 1; each later one is a re-hit.

    Raises
    ------
    SceneError
        For a contact that is not there, or a result without the channel.
    """
    loads = {} if result.scene is None else result.scene.loads
    element = loads.get(contact)
    if result.scene is None or not isinstance(element, _core.Contact):
        known = ", ".join(name for name, one in loads.items() if isinstance(one, _core.Contact)) or "none"
        raise SceneError(f"contact_hits: there is no contact {contact!r}; the scene has {known}")
    if "contact_press" not in result:
        raise SceneError('contact_hits: the result has no channel "contact_press"; record it')
    count = len(element.points)
    mass = borne_mass(result.scene, element.body, element.on) / count
    weight = mass * result.scene.gravity
    stiffness = np.nan if len(element.forces) else element.stiffness
    found: list[ContactHit] = []
    for i in range(count):
        point = f"{contact}.{i + 1}"
        press = np.asarray(result.select("contact_press", contact_point=point))
        largest = result.reached("contact_press", contact_point=point)[1]
        for number, begin, end, speed in _closed(result, point, float(press[0])):
            peak, impulse = _of_hit(np.asarray(result.time), press, largest, begin, end)
            onto = weight * _upright(result, element, i, int(np.searchsorted(result.time, begin)))
            found.append(ContactHit(
                point=point, number=number, begin=begin, end=end, speed=speed, peak=peak, impulse=impulse,
                dynamic_factor=peak / weight if weight > 0.0 else np.nan,
                undamped=onto + speed * float(np.sqrt(stiffness * mass)),
            ))  # fmt: skip
    return tuple(found)


def _upright(result: Result, contact: _core.Contact, point: int, row: int) -> float:
    """The share of a weight that presses onto the surface at an output; 1 where poses are not recorded."""
    if "position" not in result or "quaternion" not in result:
        return 1.0
    row = min(row, len(result.time) - 1)

    def pose(body: str) -> tuple[Array, Array]:
        if body == GROUND or result.scene is None:
            return np.zeros(3), np.eye(3)
        centre = np.asarray(result.select("position", body=body))[row]
        axes = rotation_matrix(np.asarray(result.select("quaternion", body=body))[row])
        return centre - axes @ np.asarray(result.scene.bodies[body].center_of_mass), axes

    return max(float(beside_surface(contact, point, pose)[1][2]), 0.0)


def _closed(result: Result, point: str, first: float) -> list[tuple[int, float, float, float]]:
    """Number, begin, end and speed of each time that a point was closed."""
    events = [e for e in result.events if e.name == point and e.kind in ("contact", "release")]
    out: list[tuple[int, float, float, float]] = []
    number, since, speed = 0, float(result.time[0]), 0.0
    closed = events[0].kind == "release" if events else first > 0.0
    for event in events:
        if event.kind == "contact":
            number, since, speed, closed = number + 1, event.time, event.speed, True
        elif closed:
            out.append((number, since, event.time, speed))
            closed = False
    return [*out, (number, since, float(result.time[-1]), speed)] if closed else out


def _of_hit(time: Array, press: Array, largest: Array, begin: float, end: float) -> tuple[float, float]:
    """Peak and impulse. The output behind a hit tells what it reached after the last one within."""
    within = (time > begin) & (time < end)
    first, last = np.searchsorted(time, [begin, end])
    peak = float(largest[first : last + 1].max(initial=0.0))
    ends: Any = np.interp([begin, end], time, press)
    ends[0] = ends[0] if begin <= time[0] else 0.0
    ends[1] = ends[1] if end >= time[-1] else 0.0
    t = np.concatenate([[begin], time[within], [end]])
    n = np.concatenate([ends[:1], press[within], ends[1:]])
    return peak, float(np.trapezoid(n, t))
