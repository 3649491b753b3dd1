"""What error a method is expected to leave at a tolerance, and the cheapest method for an error.

Measured on random scenes (docs/trade.md): the largest error over 40 s is `factor` tolerance^`power` times a
scale of the quantity, whatever the scene, within a factor of a few. `benchmarks/expected_errors.py` fits
these numbers anew for the engine as it is.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import replace
from importlib.resources import files
from typing import TYPE_CHECKING

from seacrane.description.given import floating_bodies
from seacrane.description.suspension import hung_loads
from seacrane.run.method import Method

if TYPE_CHECKING:
    from seacrane.accuracy.quantities import Quantity
    from seacrane.scene.scene import Scene

_DATA = json.loads((files("seacrane") / "data" / "expected_errors.json").read_text(encoding="utf-8"))
# Factor and power by method; of `dopri5-stiff` and `cvode-bdf` on hydraulic cranes.
ERROR: Mapping[str, tuple[float, float]] = {name: (one[0], one[1]) for name, one in _DATA["errors"].items()}
SCALE: Mapping[str, float] = {
    "s": 0.1,
    "rad/s": 2e-4,
    **_DATA["scales"],
}  # by unit; of forces over the weight
MARGIN = float(_DATA["margin"])  # on the ratio of the errors of a method and its probe, which scenes change
LOWER = {"tsit5": "bs32", "verner76": "tsit5"}  # what a probe of each method is run with
STIFF = "dopri5-stiff"
BESIDE, BESIDE_STIFFEST = "tsit5", "cvode-bdf"  # what is run beside it
TIGHTER = 0.1  # tolerance of the latter over its own
LOOSEST, TIGHTEST = 1e-2, 1e-12  # from 1e-2 on stability sets the steps: a looser tolerance saves nothing
HIGH = 1e-5  # expected error, over the scale, below which the method of order 7 is the cheaper one
EITHER = r" or | \("  # behind the first unit of a channel of displacements and angles
FORCE, UNITS = "force", ("m", "m/s", "rad", "rad/s", "s")


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
    key = scale_of(quantity)
    return max(SCALE[key] * weight_of(scene, quantity), 1.0) if key == FORCE else SCALE[key]


def scale_of(quantity: Quantity) -> str:
    """What a quantity's scale goes by: its unit, or that it is a force."""
    unit = re.split(EITHER, quantity.unit)[0]
    return unit if unit in UNITS else FORCE


def weight_of(scene: Scene, quantity: Quantity) -> float:
    """The weight that a force carries, N."""
    if quantity.channels == ("hook_load",):
        mass = max(scene.bodies[one.load].mass for one in hung_loads(scene) if one.crane is not None)
    else:
        floating = floating_bodies(scene)
        mass = sum(body.mass for body in scene.bodies.values() if body.name not in floating)
    return max(mass * abs(scene.gravity), 1.0)
