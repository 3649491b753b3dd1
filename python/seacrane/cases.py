"""The three lift cases of Landsverk, Zhou & Hovland, and the vessel alone, as scenes.

Where the paper is silent the values are our choice; `docs/paper.md` lists them.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from seacrane import _core
from seacrane.analysis import quasi_static
from seacrane.analysis.inverse import reflected_inertia, tuned_gains
from seacrane.analysis.weight_balance import Balance, balance_by_force
from seacrane.crane import FOOT, Payload
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase, load_hull, shipped_database
from seacrane.scene.scene import Scene

if TYPE_CHECKING:
    import os
__all__ = ["ACTUATORS", "SLEW_END", "case1", "case2", "case3", "vessel"]

ACTUATORS = {"slew": "A", "main": "main_cylinder", "knuckle": "knuckle_cylinder"}
NATURAL_FREQUENCY = 2.0 * np.pi * 0.8  # rad/s of every controlled coordinate
DAMPING_RATIO = 0.8
MOVE_END = 45.0  # s
OSCILLATION_START, OSCILLATION_PERIOD = 50.0, 5.0  # s, case 3
CASE_END = 100.0  # s
MOORING_PERIOD = 200.0  # s
SLEW_END = -np.pi / 2.0
STROKE_END = 2.0  # m, cases 1 and 2


def _database(database: str | os.PathLike[str] | HydroDatabase | None) -> HydroDatabase:
    if database is None:
        return shipped_database()
    return database if isinstance(database, HydroDatabase) else load_hull(database)


@lru_cache(maxsize=4)
def _gains() -> dict[str, tuple[float, float]]:
    """Stiffness and damping of each actuator, on the inertia it feels at case 2's final pose with the payload
    attached, the others locked and the vessel held."""
    scene = Scene(name="case 2, final pose")
    scene.add_crane(
        base="ground", slew=SLEW_END, s1=STROKE_END, s2=STROKE_END, payload=Payload(), damping=False
    )
    for name, joint in ACTUATORS.items():
        scene.add_actuator(name=name, joint=joint)
    return tuned_gains(
        reflected_inertia(scene), natural_frequency=NATURAL_FREQUENCY, damping_ratio=DAMPING_RATIO
    )


def vessel(
    *, memory: str = "per-pair", kinematics: str = "yaw_following",
    database: str | os.PathLike[str] | HydroDatabase | None = None,
    mooring: float | None = MOORING_PERIOD, **sea: Any,
) -> Scene:  # fmt: skip
    """The vessel alone in waves.

    Parameters
    ----------
    memory : str
        "per-pair" (default, the paper's), "by-motion", "convolution" or "none".
    kinematics : str
        "yaw_following" or "paper".
    database : path or HydroDatabase, optional
        Default: the shipped hull of 115 m.
    mooring : float or None
        s; None removes station keeping.
    **sea
        hs (2 m), tp (8 s), gamma (3.3), wave_direction_deg (135), seed (1), count (200), and the other
        arguments of `add_sea`; hs = 0 is calm water.
    """
    scene = Scene(name="vessel")
    scene.add_vessel(_database(database), memory=memory, kinematics=kinematics, mooring=mooring)
    if "wave_direction_deg" in sea:
        sea["direction_deg"] = sea.pop("wave_direction_deg")
    scene.add_sea(**({} if "sea" in sea else {"hs": 2.0, "tp": 8.0, "direction_deg": 135.0}) | sea)
    return scene


@dataclass(frozen=True, eq=False)
class _Motion:
    """References by actuator, and the times through which their feed-forward is laid."""

    references: dict[str, _core.Curve]
    times: NDArray[np.float64]
    period: float | None = None


def _crane_afloat(
    name: str, *, payload: Payload | None, foot: Any, options: dict[str, Any]
) -> tuple[Scene, Balance]:
    """Vessel and crane, balanced at the start, its actuators without control; and what balances it."""
    scene = vessel(**options).copy(name=name)
    scene.add_crane(base="vessel", foot=foot, payload=payload, damping=False)
    for actuator, joint in ACTUATORS.items():
        scene.add_actuator(name=actuator, joint=joint)
    return scene, balance_by_force(scene)


def _lift(
    name: str, *, payload: Payload | None, motion: _Motion, foot: Any = FOOT,
    feed_forward: str = "references", **options: Any,
) -> Scene:  # fmt: skip
    if feed_forward not in ("references", "start"):
        raise SceneError(f"{name}: feed_forward is {feed_forward!r}; choose 'references' or 'start'")
    options["database"] = database = _database(options.get("database"))
    scene, start = _crane_afloat(name, payload=payload, foot=foot, options=options)
    loads = {actuator: _core.Curve.constant(value=load) for actuator, load in start.loads.items()}
    if feed_forward == "references":
        mooring = options.get("mooring", MOORING_PERIOD)
        load = payload and replace(payload, size=(payload.size[0], payload.size[1], payload.size[2]))
        try:
            loads = _quasi_static(motion, load, tuple(foot), database, mooring)
        except SceneError as error:
            raise SceneError(
                f"{name}: no rest state at every pose of the crane, as its feed-forward needs; lift less, or "
                f"pass feed_forward='start' for the constant loads of the start ({error})"
            ) from error
    scene.actuators.clear()
    for actuator, joint in ACTUATORS.items():
        stiffness, damping = _gains()[actuator]
        scene.add_actuator(
            name=actuator, joint=joint, stiffness=stiffness, damping=damping, feed_forward=loads[actuator],
            reference=motion.references[actuator],
        )  # fmt: skip
    return scene


@lru_cache(maxsize=8)
def _quasi_static(
    motion: _Motion, payload: Payload | None, foot: tuple[float, ...], database: HydroDatabase,
    mooring: float | None,
) -> dict[str, _core.Curve]:  # fmt: skip
    """Quasi-static balance along the motion; neither sea nor fluid memory nor kinematics matter at rest."""
    options = {"memory": "none", "database": database, "mooring": mooring, "hs": 0.0}
    scene, _ = _crane_afloat("at rest", payload=payload, foot=foot, options=options)
    return quasi_static.feed_forward(
        scene, references=motion.references, times=motion.times, period=motion.period
    )


def _move(end: float) -> _core.Curve:
    return _core.Curve.quintic(start_time=0.0, end_time=MOVE_END, start=0.0, end=end)


_TIMES = np.linspace(0.0, MOVE_END, 10)
_SWING_OUT = _Motion(
    {"slew": _move(SLEW_END), "main": _move(STROKE_END), "knuckle": _move(STROKE_END)}, _TIMES
)
_OMEGA = 2.0 * np.pi / OSCILLATION_PERIOD
_SWING = _core.Curve.harmonic(start_time=OSCILLATION_START, offset=3.0, amplitude=1.0, omega=_OMEGA)
_STROKE = _move(4.0).then(time=OSCILLATION_START, curve=_SWING)
_SWING_OUT_AND_OSCILLATE = _Motion(
    {"slew": _move(SLEW_END), "main": _STROKE, "knuckle": _STROKE},
    np.append(_TIMES, np.arange(MOVE_END, CASE_END + 0.1, 0.5)[1:]), OSCILLATION_PERIOD,
)  # fmt: skip


def case1(**options: Any) -> Scene:
    """Case 1: slew 0 to -90 deg, both strokes 0 to 2 m, no payload.

    Parameters
    ----------
    **options
        Of `vessel`, and

        - foot (3,): place of the crane's foot in the vessel frame, m;
        - feed_forward: "references" (default), the quasi-static loads along the motion, by
          `seacrane.analysis.feed_forward`; or "start", the constant loads of the start: strokes end short.
    """
    return _lift("case1", payload=None, motion=_SWING_OUT, **options)


def case2(*, payload: Payload | None = None, **options: Any) -> Scene:
    """Case 2: as case 1, with the payload (default 10 t on an 8 m link)."""
    return _lift("case2", payload=payload or Payload(), motion=_SWING_OUT, **options)


def case3(**options: Any) -> Scene:
    """Case 3: slew 0 to -90 deg, strokes 0 to 4 m, from 50 s on 3 + cos(2 pi t / 5) m; no payload."""
    return _lift("case3", payload=None, motion=_SWING_OUT_AND_OSCILLATE, **options)


def __dir__() -> list[str]:
    return __all__
