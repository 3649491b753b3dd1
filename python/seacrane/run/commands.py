"""What a stage commands: curves of winches, lines, cylinders, actuators, drivers, changed from a time on."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from seacrane import _core
from seacrane.description.description import Some
from seacrane.description.given import given_drivers
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders
from seacrane.description.loads import lines_of, winch_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import finite_of
from seacrane.inputs.keywords import named
from seacrane.inputs.shown import shown
from seacrane.scene.edit import replace_element
from seacrane.scene.scene import Scene

RATE_TIME = 1.0  # s, in which a rate, a force or a brake that is commanded by a number is reached
JUMP = 1e-6  # m or rad, of a commanded place
HOLE = "rupture_area"  # of a hose that a stage lets burst: no curve, it opens at once


@named
@dataclass(frozen=True, kw_only=True)
class Move:
    """A smooth way of a commanded value from where it is to another, held from there on.

    A quintic that takes over value, rate and acceleration as they are, and arrives at rest.

    Attributes
    ----------
    to : float, optional
        Where to, in the unit of what is commanded (m, rad, N, N m or m/s).
    by : float, optional
        How far from the present value, instead of `to`.
    over : float
        s.

    Raises
    ------
    SceneError
    """

    to: float | None = None
    by: float | None = None
    over: float

    def __post_init__(self) -> None:
        if (self.to is None) == (self.by is None):
            raise SceneError(f"move: to is {self.to} and by is {self.by}; give one of them")
        for name in ("to", "by", "over"):
            value = getattr(self, name)
            if value is not None:
                object.__setattr__(self, name, finite_of(f"move: {name}", value))
        if not self.over > 0.0:
            raise SceneError(f"move: over is {self.over:g} s; give the positive time that it takes")

    def from_where_it_is(self, curve: _core.Curve, time: float) -> _core.Curve:
        """The curve until a time (s), and this move from there."""
        value, rate, acceleration = curve.evaluate([time])[0]
        end = self.to if self.to is not None else value + self.by
        start = [value, rate, 0.5 * acceleration, *_closing(end - value, rate, acceleration, self.over)]
        hold = [end, 0.0, 0.0, 0.0, 0.0, 0.0]
        move = _core.Curve.pieces(starts=[time, time + self.over], coefficients=[start, hold])
        return curve.then(time=time, curve=move)


def _closing(way: float, rate: float, acceleration: float, over: float) -> list[float]:
    """Coefficients 3 to 5 of the quintic that arrives at rest."""
    left = way - rate * over - 0.5 * acceleration * over**2
    slope = -rate - acceleration * over
    return [
        (10.0 * left - 4.0 * slope * over - 0.5 * acceleration * over**2) / over**3,
        (-15.0 * left + 7.0 * slope * over + acceleration * over**2) / over**4,
        (6.0 * left - 3.0 * slope * over - 0.5 * acceleration * over**2) / over**5,
    ]


Command = Move | _core.Curve | float


@dataclass(frozen=True)
class Target:
    """What a command changes: an attribute of an element, and whether it is a place, which may not jump."""

    kind: str
    element: str
    attribute: str
    place: bool


def targets(scene: Scene) -> dict[str, Target]:
    """What may be commanded, by name; inputs of a run have the same names, but for tensions and brakes."""
    found = {}
    for name, line in lines_of(scene.loads).items():
        if line.paid_out_by and not line.winch:
            continue
        own, attribute = winch_of(line) or name, "rate" if line.winch else "length"
        found[f"{own}.{attribute}"] = Target("load", name, attribute, not line.winch)
        if line.tension_gain > 0.0:
            found[f"{own}.tension"] = Target("load", name, "tension", False)
        if line.brake_capacity > 0.0:
            found[f"{own}.brake"] = Target("load", name, "brake", False)
    for name, cylinder in hydraulic_cylinders(scene).items():
        if cylinder.rated_flow > 0.0:
            found[f"{name}.command"] = Target("load", name, "command", False)
        if cylinder.gain > 0.0:
            found[f"{name}.reference"] = Target("load", name, "reference", True)
        if cylinder.rupture_area == 0.0:
            found[f"{name}.rupture"] = Target("load", name, HOLE, False)
    for name in scene.actuators:
        found[f"{name}.reference"] = Target("actuator", name, "reference", True)
        found[f"{name}.force"] = Target("actuator", name, "feed_forward", False)
    return found | {name: Target("driver", name, "curve", True) for name in scene.drivers}


def check_command(what: str, name: str, value: object, known: Mapping[str, Target]) -> None:
    """Raise SceneError for a command of what is not there, or one that is none."""
    if name not in known:
        raise SceneError(
            f"{what} commands {name!r}, which is not there; there are {', '.join(known) or 'none'}; a joint, "
            f"such as a crane's slew, is led by a driver: scene.add_driver(joint='A', name={name!r}, ...)"
        )
    if isinstance(value, (Move, _core.Curve)):
        if known[name].attribute == HOLE:
            raise SceneError(f"{what}: command {name!r} is {shown(value)}; a hose bursts at once: give m2")
        return
    number = finite_of(f"{what}: command {name!r}", value)
    if known[name].attribute == HOLE and not number > 0.0:
        raise SceneError(f"{what}: command {name!r} is {number:g} m2; give the area of the hole, above zero")
    if known[name].place:
        raise SceneError(
            f"{what}: command {name!r} is {shown(value)}, a place to go to in no stated time; give "
            f"Move(to={number:g}, over=...) with its seconds, or a Curve"
        )


def commanded(scene: Some, what: str, commands: Mapping[str, Command], time: float) -> Some:
    """The scene with commands that begin at a time, s; the curves until then stay.

    Raises SceneError for a curve that does not begin where the command stands.
    """
    out = scene.copy()
    known = targets(out)  # type: ignore[arg-type]
    for name, value in commands.items():
        target = known[name]
        if target.attribute == HOLE:
            burst = {"rupture_time": time, HOLE: float(value)}  # type: ignore[arg-type]
            replace_element(out, target.element, kind=target.kind, **burst)
            continue
        old = present(out, target)
        if isinstance(value, _core.Curve):
            pieces = value.to_pieces()  # on the stage's own clock, 0 where it begins
            own = _core.Curve.pieces(**pieces | {"starts": [start + time for start in pieces["starts"]]})
            new = old.then(time=time, curve=own)
            before, after = (float(curve.evaluate([time])[0, 0]) for curve in (old, new))
            if target.place and abs(after - before) > JUMP:
                raise SceneError(
                    f"{what}: command {name!r} begins at {after:.6g} where it stands at {before:.6g} (t = "
                    f"{time:.6g} s): that is a jump. Begin the curve there, or give Move(to=..., over=...)"
                )
        else:
            move = value if isinstance(value, Move) else Move(to=value, over=RATE_TIME)
            new = move.from_where_it_is(old, time)
        replace_element(out, target.element, kind=target.kind, **{target.attribute: new})
    return out


def taken_up(scene: Some, time: float) -> Some:
    """The scene with what moves at a time (s) at rest there, and on its way again within 1 s.

    Winches pay out nothing at that time, and places stand; given ships go on.
    """
    out, led = scene.copy(), given_drivers(scene)
    for target in targets(out).values():  # type: ignore[arg-type]
        winds = target.attribute == "rate"
        if not (winds or target.place) or target.element in led:
            continue
        curve = present(out, target)
        now = curve.evaluate([time])[0]
        stands = 0.0 if winds else float(now[0])
        if now[0] == stands and not np.any(now[1:]):
            continue
        way = Move(to=float(curve.evaluate([time + RATE_TIME])[0, 0]), over=RATE_TIME)
        new = way.from_where_it_is(_core.Curve.constant(value=stands), time)
        new = curve.then(time=time, curve=new.then(time=time + RATE_TIME, curve=curve))
        replace_element(out, target.element, kind=target.kind, **{target.attribute: new})
    return out


def present(scene: Scene | Some, target: Target) -> _core.Curve:
    """The curve that a command would change."""
    curve: _core.Curve = getattr(getattr(scene, f"{target.kind}s")[target.element], target.attribute)
    return curve
