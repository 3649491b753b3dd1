"""What keys of several tables of a lift file share: their choices, shapes and units."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.run.method import FORMULATIONS
from seacrane.scene.afloat import MEMORY
from seacrane.scene.realised_sea import SPECTRA

CHOSEN: dict[str, dict[str, Any]] = {
    "spectrum": {"type": "text", "choices": SPECTRA},
    "evaluation": {"choices": ("table", "exact")},
    "placement": {"choices": ("jittered", "uniform")},
    "memory": {"choices": MEMORY},
    "kinematics": {"choices": ("yaw_following", "paper")},
    "orientation": {"choices": ("quaternion", "euler_xyz")},
    "formulation": {"choices": FORMULATIONS},
    "integrator": {"choices": tuple(_core.integrator_names())},
    "kind": {"choices": tuple(_core.joint_kinds())},
}
POINT: dict[str, Any] = {"type": "array", "unit": "m", "shapes": ((3,),)}
DIRECTION: dict[str, Any] = {"type": "array", "shapes": ((3,),)}
EACH: dict[str, Any] = {"type": "array", "shapes": ((-1,), ())}  # or one number for all
LENGTH: dict[str, Any] = {"unit": "m"}
ROW: dict[str, Any] = {"type": "array", "shapes": ((-1,),)}
TIME: dict[str, Any] = {"unit": "s"}
NUMBER = {"type": "number"}
