"""Small damping that a hanging load has: friction where it hangs, and drag in the air."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import _core
from seacrane.description.description import Description
from seacrane.description.forces import add_load
from seacrane.errors import SceneError
from seacrane.inputs.checked import curve_of, name_of, not_negative_of, number_of, shaped_of, text_of
from seacrane.inputs.plausible import direction_of

AIR = 1.226  # kg/m3 at 15 deg C, DNV-RP-C205
SWING_RATIO = 0.005  # of critical damping of a swinging load: an estimate
BOX_DRAG = 1.05  # C_D of a cube with a face to the flow: Hoerner, Fluid-Dynamic Drag (1965)
KNOTS = 36  # over the circle: a spline through them is a cosine to 3e-6


def add_pendulum_damping(
    scene: Description,
    name: str,
    *,
    first: str,
    second: str,
    first_point: Any = (0.0, 0.0, 0.0),
    second_point: Any = None,
    ratio: float = SWING_RATIO,
    mass: float = 0.0,
) -> _core.PendulumDamping:
    """Damping of a load's swing below the point where it hangs, as a ratio of critical.

    -2 ratio mass sqrt(g / L) times the velocity of the load across the line of length L from `first_point` to
    `second_point`, seen from the first body; the opposite acts on that body at the same place. Nothing acts
    along the line. A point mass below a fixed point has that ratio exactly. See docs/damping.md.

    Parameters
    ----------
    first : str
        Body that the load hangs from; "ground" is one too.
    second : str
        The load.
    first_point, second_point : array_like, shape (3,)
        In coordinates of these bodies, m. Default of the second: the load's centre of mass.
    ratio : float
        Of critical damping; 0 is none. Default 0.005: an estimate.
    mass : float
        kg, that swings; default (0): that of the load.

    Raises
    ------
    SceneError
        For a load that is not there, or values out of range; the rest comes with `Scene.compile`.
    """
    what = f"pendulum damping {name_of('pendulum damping', name)!r}"
    load = _body(scene, what, second)
    element = _core.PendulumDamping(
        name=name,
        first=text_of(f"{what}: first", first),
        second=second,
        first_point=first_point,
        second_point=_point(what, "second_point", second_point, load),
        ratio=ratio,
        mass=mass,
    )
    added: _core.PendulumDamping = add_load(scene, element)
    return added


def add_air_drag(
    scene: Description,
    body: str,
    *,
    frontal_area: float,
    lateral_area: float,
    drag_coefficient: float = BOX_DRAG,
    speed: _core.Curve | float = 0.0,
    direction_deg: float = 0.0,
    point: Any = None,
    density: float = AIR,
    name: str = "",
) -> _core.FlowForce:
    """Drag of the air on a body that moves through it, still air by default.

    Of the horizontal velocity V of the air relative to `point`, in axes that follow the body's yaw:
    density / 2 drag_coefficient |V| (frontal_area V_x, lateral_area V_y). Vertical motion has no drag.

    Parameters
    ----------
    frontal_area, lateral_area : float
        Seen along the body's x axis and along its y axis, m2.
    drag_coefficient : float
        0 is no drag. Default 1.05: a cube with a face to the flow (Hoerner 1965).
    speed, direction_deg : float or Curve, float
        Of a wind, m/s, and where it blows *to*, deg from +x towards +y. Leave it out where `add_wind` has it.
    point : array_like, shape (3,)
        Where it acts, m, body coordinates; default: the centre of mass.
    density : float
        kg/m3.
    name : str
        Default: the body's and " drag".

    Raises
    ------
    SceneError
        For a body that is not there, or values that are none; the rest comes with `Scene.compile`.
    """
    what = f"air drag {text_of('air drag: name', name, f'{body} drag')!r}"
    dragged = _body(scene, what, body)
    angles = np.linspace(0.0, 2.0 * np.pi, KNOTS, endpoint=False)
    coefficient = not_negative_of(f"{what}: drag_coefficient", drag_coefficient)
    rows = coefficient * np.column_stack([np.cos(angles), np.sin(angles), np.zeros(KNOTS)])
    element = _core.FlowForce(
        name=name or f"{body} drag",
        body=body,
        point=_point(what, "point", point, dragged),
        density=number_of(f"{what}: density", density),
        speed=curve_of(f"{what}: speed", speed),
        direction=float(np.radians(direction_of(f"{what}: direction_deg", direction_deg))),
        frontal_area=number_of(f"{what}: frontal_area", frontal_area),
        lateral_area=number_of(f"{what}: lateral_area", lateral_area),
        length=0.0,
        angles=angles.tolist(),
        coefficients=rows,
    )
    added: _core.FlowForce = add_load(scene, element)
    return added


def _body(scene: Description, what: str, name: str) -> _core.Body:
    if text_of(f"{what}: body", name) not in scene.bodies:
        raise SceneError(f"{what}: there is no body {name!r}; add it first")
    return scene.bodies[name]


def _point(what: str, key: str, given: Any, body: _core.Body) -> Any:
    return body.center_of_mass if given is None else shaped_of(f"{what}: {key}", given, (3,))
