"""The three lift cases of Landsverk, Zhou & Hovland, and the vessel alone, as scenes.

Where the paper is silent the values are our choice; `docs/paper.md` lists them.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from seacrane import _core
from seacrane.crane import FOOT, KnuckleBoomCrane, Payload
from seacrane.inverse import balance, reflected_inertia
from seacrane.scene import Scene
from seacrane.sea_state import add_sea
from seacrane.vessel import add_vessel

if TYPE_CHECKING:
    import os

    from seacrane.hydro import HydroDatabase

ACTUATORS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
NATURAL_FREQUENCY = 2.0 * np.pi * 0.8  # rad/s of every controlled coordinate
DAMPING_RATIO = 0.8
MOVE_END = 45.0  # s
OSCILLATION_START, OSCILLATION_PERIOD = 50.0, 5.0  # s, case 3
SLEW_END = -np.pi / 2.0
STROKE_END = 2.0  # m, cases 1 and 2


def _database(database: str | os.PathLike[str] | HydroDatabase | None) -> HydroDatabase:
    from seacrane.hydro import HydroDatabase, load_database, shipped_database

    if database is None:
        return shipped_database()
    return database if isinstance(database, HydroDatabase) else load_database(database)


@lru_cache(maxsize=4)
def _gains() -> dict[str, tuple[float, float]]:
    """Stiffness and damping of each actuator.

    NATURAL_FREQUENCY and DAMPING_RATIO on the inertia it feels at case 2's final pose with the payload
    attached, the others locked and the vessel held.
    """
    scene = Scene(name="case 2, final pose")
    KnuckleBoomCrane.load().add_to(
        scene, base="ground", theta=SLEW_END, s1=STROKE_END, s2=STROKE_END, payload=Payload()
    )
    for name, joint in ACTUATORS.items():
        scene.add_actuator(name=name, joint=joint)
    inertia = reflected_inertia(scene)
    omega = NATURAL_FREQUENCY
    return {name: (value * omega**2, 2.0 * DAMPING_RATIO * omega * value) for name, value in inertia.items()}


def vessel(
    *,
    memory: str = "per-pair",
    kinematics: str = "yaw_following",
    database: str | os.PathLike[str] | HydroDatabase | None = None,
    mooring_period: float | None = 200.0,
    **sea: Any,
) -> Scene:
    """The vessel alone in waves.

    Parameters
    ----------
    memory : str
        "per-pair", "passive", "convolution" or "none".
    kinematics : str
        "yaw_following" or "paper".
    database : path or HydroDatabase, optional
        Default: the shipped hull of 115 m.
    mooring_period : float or None
        s; None removes station keeping.
    **sea
        hs (2 m), tp (8 s), gamma (3.3), wave_direction_deg (135), seed (1), count (200), and the other
        arguments of `add_sea`; hs = 0 is calm water.
    """
    return _afloat("vessel", memory, kinematics, database, mooring_period, sea)


def _afloat(
    name: str, memory: str, kinematics: str, database: Any, mooring_period: float | None, sea: dict[str, Any]
) -> Scene:
    chosen = _database(database)
    scene = Scene(name=name)
    add_vessel(scene, chosen, memory=memory, kinematics=kinematics, mooring_period=mooring_period)
    if "wave_direction_deg" in sea:
        sea["direction_deg"] = sea.pop("wave_direction_deg")
    add_sea(scene, chosen, **sea)
    return scene


def _lift(
    name: str, *, payload: Payload | None, references: dict[str, _core.Curve], options: dict[str, Any]
) -> Scene:
    options = dict(options)
    fixed = {key: options.pop(key, default) for key, default in _OPTIONS.items()}
    foot = fixed.pop("foot")
    scene = _afloat(name, sea=options, **fixed)
    crane = KnuckleBoomCrane.load()
    crane.add_to(scene, base="vessel", foot=foot, payload=payload)
    for actuator, joint in ACTUATORS.items():
        scene.record_coordinate(joint=joint)
        scene.add_actuator(name=actuator, joint=joint)
    start = balance(scene)
    scene.actuators.clear()
    for actuator, joint in ACTUATORS.items():
        stiffness, damping = _gains()[actuator]
        scene.add_actuator(
            name=actuator,
            joint=joint,
            stiffness=stiffness,
            damping=damping,
            feed_forward=start.loads[actuator],
            reference=references[actuator],
        )
    scene.add_point_force(
        name="balance",
        body="vessel",
        point=(start.weight_center[0], start.weight_center[1], 0.0),
        force=(0.0, 0.0, start.weight),
    )
    return scene


_OPTIONS: dict[str, Any] = {
    "memory": "per-pair",
    "kinematics": "yaw_following",
    "database": None,
    "mooring_period": 200.0,
    "foot": FOOT,
}


def _move(end: float) -> _core.Curve:
    return _core.Curve.quintic(start_time=0.0, end_time=MOVE_END, start=0.0, end=end)


def _swing_out() -> dict[str, _core.Curve]:
    return {"slew": _move(SLEW_END), "main": _move(STROKE_END), "knuckle": _move(STROKE_END)}


def case1(**options: Any) -> Scene:
    """Case 1: slew 0 to -90 deg, both strokes 0 to 2 m, no payload.

    Parameters
    ----------
    **options
        Of `vessel`, and foot (3,): place of the crane's foot in the vessel frame, m.
    """
    return _lift("case1", payload=None, references=_swing_out(), options=options)


def case2(*, payload: Payload | None = None, **options: Any) -> Scene:
    """Case 2: as case 1, with the payload (default 10 t on an 8 m link)."""
    return _lift("case2", payload=payload or Payload(), references=_swing_out(), options=options)


def case3(**options: Any) -> Scene:
    """Case 3: slew 0 to -90 deg, strokes 0 to 4 m, from 50 s on 3 + cos(2 pi t / 5) m; no payload."""
    omega = 2.0 * np.pi / OSCILLATION_PERIOD
    swing = _core.Curve.harmonic(start_time=OSCILLATION_START, offset=3.0, amplitude=1.0, omega=omega)
    stroke = _move(4.0).then(time=OSCILLATION_START, curve=swing)
    references = {"slew": _move(SLEW_END), "main": stroke, "knuckle": stroke}
    return _lift("case3", payload=None, references=references, options=options)
