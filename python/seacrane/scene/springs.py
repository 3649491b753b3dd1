"""What acts between two points without being wound: springs, gas springs, and damping of what swings."""

from __future__ import annotations

from typing import Any

from seacrane import _core
from seacrane.description.description import Description, require
from seacrane.description.elements import put_load
from seacrane.description.places import ORIGIN, apart
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, not_negative_of, number_of, positive_of
from seacrane.inputs.keywords import taken
from seacrane.inputs.values import flat, told_by, value

PAIRS = (("pressure", "volume"), ("force", "stiffness"))
KINDS = {
    "spring": ("stiffness", "natural_length", "damping", "lengths", "forces"),
    "gas spring": ("gas", "damping", "quadratic_damping", "stops"),
    "pendulum damping": ("damping_ratio", "mass"),
}


@value(_core.GasSpring)
class Gas:
    """The gas of a gas spring at its length, by pressure and volume, or by force and stiffness there."""

    area: float  # m2
    pressure: float | None = None  # Pa
    volume: float | None = None  # m3
    force: float | None = None  # N
    stiffness: float | None = None  # N/m
    length: float | None = None  # m
    exponent: float = 1.4
    pushes: bool = False


@value(_core.GasSpring, "stop", "stiffness")
class Stops:
    """Stops at the ends of a gas spring's stroke."""

    minimum: float = 0.0  # m
    maximum: float = 1e7  # m, none
    stiffness: float = 1e8  # N/m


VALUES: dict[str, type[Any]] = {"gas": Gas, "stops": Stops}


@told_by(_core.GasSpring, _core.PendulumDamping, _core.Spring)
def add_spring(
    scene: Description, name: str, *, first: str, second: str, first_point: Any = ORIGIN,
    second_point: Any = None, stiffness: float | None = None, natural_length: float | None = None,
    damping: float | None = None, lengths: Any = None, forces: Any = None, gas: Gas | None = None,
    quadratic_damping: float | None = None, stops: Stops | None = None, damping_ratio: float | None = None,
    mass: float | None = None,
) -> _core.Spring | _core.GasSpring | _core.PendulumDamping:  # fmt: skip
    """Join two points by a spring, by a gas spring, or by the damping of a swing.

    The tension of a spring is stiffness times its elongation, or that of a table, and damping times the rate
    of its length.

    With `gas` it is a cylinder on a gas accumulator: passive heave compensation. Its tension is p area, with
    p V^exponent constant; lengthening compresses the gas. About the length it has the stiffness exponent
    p area^2 / V. Oil damps it. An end stop that is met is an event "<name>.minimum" or "<name>.maximum" of
    kind "limit". See docs/heave-compensation.md.

    With `damping_ratio` a load, the second body, swings below the first point: -2 damping_ratio mass
    sqrt(g / L) times the velocity of the load across the line of length L between the points, seen from the
    first body; the opposite acts on that body at the same place. Nothing acts along the line. A point mass
    below a fixed point has that ratio of critical damping exactly. See docs/damping.md.

    Parameters
    ----------
    second_point : array_like, shape (3,)
        m, coordinates of the second body. Default: its origin; of what swings its centre of mass.
    gas : Gas
        Its pressure and volume at its length, or the force and the stiffness that it has there; by default
        the length is the distance of the points as described.
    stops : Stops
        Lengths at which a gas spring is stopped. Default: none.
    damping_ratio : float
        Of critical; 0 is none. A payload of `add_crane` has 0.005: an estimate.

    Raises
    ------
    SceneError
        For what another kind takes, a swinging load that is not there, and pressure and volume beside force
        and stiffness, or one without the other; what else does not fit is said by `Scene.compile`.
    """
    given = {key: one for key, one in locals().items() if key != "scene"}
    kind = "gas spring" if gas is not None else "spring" if damping_ratio is None else "pendulum damping"
    what = f"{kind} {name_of(kind, name)!r}"
    ends = {key: given.pop(key) for key in ("name", "first", "first_point", "second", "second_point")}
    own = taken(what, kind, KINDS[kind], **given)
    if second_point is None:
        ends["second_point"] = ORIGIN
    if kind == "spring":
        return put_load(scene, _core.Spring(**ends, **own))
    if kind == "gas spring":
        own = _of_gas(what, flat(what, own, VALUES))
        if "length" not in own:
            own["length"] = apart(scene, what, (first, first_point), (second, ends["second_point"]))
        return put_load(scene, _core.GasSpring(**ends, **own))
    hung = scene.bodies[require(scene, what, "second", second)]
    ends["second_point"] = hung.center_of_mass if second_point is None else second_point
    own["ratio"] = not_negative_of(f"{what}: damping_ratio", own.pop("damping_ratio"))
    return put_load(scene, _core.PendulumDamping(**ends, **own))


def _of_gas(what: str, entries: dict[str, Any]) -> dict[str, Any]:
    """The entries with pressure and volume, which are there or follow from force and stiffness."""
    given = [{key: entries.pop(key) for key in pair if key in entries} for pair in PAIRS]
    if sorted(map(len, given)) != [0, 2]:
        has = ", ".join(f"{key}={one}" for pair in given for key, one in pair.items()) or "none"
        raise SceneError(
            f"{what}: give pressure and volume, or force and stiffness, both of one pair; it has {has}"
        )
    told = {key: positive_of(f"{what}: {key}", one) for pair in given for key, one in pair.items()}
    if "force" in told:
        area = positive_of(f"{what}: area", entries["area"], "m2")
        kappa, force = number_of(f"{what}: exponent", entries["exponent"]), told["force"]
        told = {"pressure": force / area, "volume": kappa * force * area / told["stiffness"]}
    return entries | told
