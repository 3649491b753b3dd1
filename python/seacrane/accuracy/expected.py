"""What error a method is expected to leave at a tolerance, and the cheapest method for an error.

Measured on random scenes (docs/trade.md): the largest error over 40 s is `factor` tolerance^`power` times a
scale of the quantity, whatever the scene, within a factor of a few.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from seacrane.description.given import floating_bodies
from seacrane.description.suspension import hung_loads
from seacrane.run.method import Method

if TYPE_CHECKING:
    from seacrane.accuracy.quantities import Quantity
    from seacrane.scene.scene import Scene

# Factor and power; of `dopri5-stiff` and `cvode-bdf` on hydraulic cranes.
ERROR = {
    "bs32": (14.0, 0.89),
    "tsit5": (8.0, 1.1),
    "verner76": (0.8, 1.065),
    "dopri5-stiff": (4.0, 0.75),
    "cvode-bdf": (40.0, 0.8),
}
LOWER = {"tsit5": "bs32", "verner76": "tsit5"}  # what a probe of each method is run with
STIFF = "dopri5-stiff"
BESIDE, BESIDE_STIFFEST = "tsit5", "cvode-bdf"  # what is run beside it
TIGHTER = 0.1  # tolerance of the latter over its own
LOOSEST, TIGHTEST = 1e-2, 1e-12  # from 1e-2 on stability sets the steps: a looser tolerance saves nothing
HIGH = 1e-5  # expected error, over the scale, below which the method of order 7 is the cheaper one
SCALE = {"m": 0.05, "m/s": 0.15, "rad": 2e-4, "rad/s": 2e-4, "s": 0.1}
FORCE_SCALE = 0.125  # of the weight that the force carries


def expected_error(method: Method) -> float:
    """Expected error of a method over the scale of a quantity."""
    factor, power = ERROR[method.integrator]
    return factor * math.pow(method.used_rtol, power)


def method_for(error: float, *, stiff: bool = False) -> Method:
    """The cheapest method with that expected error, on half decades of the tolerance; `stiff`: of a scene
    with loads that would bind the steps of explicit methods."""
    low = STIFF if stiff else "tsit5"
    name = low if error >= HIGH else "verner76"
    factor, power = ERROR[name]
    decades = math.log10(max(error, 1e-300) / factor) / power
    tolerance = float(f"{10.0 ** (math.floor(2.0 * decades) / 2.0):.6g}")
    return Method(integrator=name, rtol=min(max(tolerance, TIGHTEST), LOOSEST))


def probe_of(method: Method, *, stiffest: bool = False) -> Method:
    """A run by another method that tells the error of one: of lower order, at the loosest tolerance.

    Of the method whose steps stiff loads do not bind it is as good as the method itself, explicit or, where
    the scene is so stiff that this would take far too many steps, implicit.
    """
    if method.integrator == STIFF and stiffest:
        return replace(method, integrator=BESIDE_STIFFEST, rtol=TIGHTER * method.used_rtol)
    if method.integrator == STIFF:
        return replace(method, integrator=BESIDE)
    return replace(method, integrator=LOWER[method.integrator], rtol=LOOSEST)


def unit_error(scene: Scene, quantity: Quantity) -> float:
    """Scale of a quantity's error, in its unit."""
    if quantity.unit in SCALE:
        return SCALE[quantity.unit]
    if quantity.channels == ("hook_load",):
        mass = max(scene.bodies[one.load].mass for one in hung_loads(scene) if one.crane is not None)
    else:
        floating = floating_bodies(scene)
        mass = sum(body.mass for body in scene.bodies.values() if body.name not in floating)
    return max(FORCE_SCALE * mass * abs(scene.gravity), 1.0)
