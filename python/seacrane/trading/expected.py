"""What error a method is expected to leave at a tolerance, and the cheapest setting for an error.

Measured on random scenes (docs/trade.md): the largest error over 40 s is `factor` tolerance^`power` times a
scale of the quantity, whatever the scene, within a factor of a few.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from seacrane.description.crane_parts import hooks

if TYPE_CHECKING:
    from seacrane.scene.scene import Scene
    from seacrane.trading.quantities import Quantity

ERROR = {"bs32": (14.0, 0.89), "tsit5": (8.0, 1.1), "verner76": (0.8, 1.065)}  # factor, power
LOWER = {"tsit5": "bs32", "verner76": "tsit5"}  # what a probe of each method is run with
LOOSEST, TIGHTEST = 1e-2, 1e-12  # from 1e-2 on stability sets the steps: a looser tolerance saves nothing
HIGH = 1e-5  # expected error, over the scale, below which the method of order 7 is the cheaper one
SCALE = {"m": 0.05, "m/s": 0.15, "rad": 2e-4, "rad/s": 2e-4}
FORCE_SCALE = 0.125  # of the weight that the force carries


@dataclass(frozen=True, kw_only=True)
class Method:
    """An integrator at a tolerance."""

    name: str
    tolerance: float

    @property
    def error(self) -> float:
        """Expected error over the scale of a quantity."""
        factor, power = ERROR[self.name]
        return factor * math.pow(self.tolerance, power)


def setting_for(error: float) -> Method:
    """The cheapest setting with that expected error, on half decades of the tolerance."""
    name = "tsit5" if error >= HIGH else "verner76"
    factor, power = ERROR[name]
    decades = math.log10(max(error, 1e-300) / factor) / power
    tolerance = float(f"{10.0 ** (math.floor(2.0 * decades) / 2.0):.6g}")
    return Method(name=name, tolerance=min(max(tolerance, TIGHTEST), LOOSEST))


def probe_of(setting: Method) -> Method:
    """A cheap run that tells the error of a setting: one method lower, at the loosest tolerance."""
    return Method(name=LOWER[setting.name], tolerance=LOOSEST)


def unit_error(scene: Scene, quantity: Quantity) -> float:
    """Scale of a quantity's error, in its unit."""
    if quantity.unit in SCALE:
        return SCALE[quantity.unit]
    if quantity.name == "hook_tension":
        mass = max(scene.bodies[scene.joints[link].second].mass for link in hooks(scene).values())
    else:
        floating = {vessel.body for vessel in scene.vessels.values()}
        mass = sum(body.mass for body in scene.bodies.values() if body.name not in floating)
    return max(FORCE_SCALE * mass * abs(scene.gravity), 1.0)
