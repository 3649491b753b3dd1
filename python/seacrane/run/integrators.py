"""The list of integrators, with what the program needs to know of each."""

from __future__ import annotations

from dataclasses import dataclass

from seacrane import _core
from seacrane.errors import SceneError


@dataclass(frozen=True, kw_only=True)
class Integrator:
    """What an integration method is.

    Attributes
    ----------
    name : str
    order, lowest_order : int
        The highest one for a method of variable order; that of `order`, unless the order varies.
    setting : str
        What sets its accuracy: "rtol", or the "dt" of its steps.
    stable_up_to : float
        |eigenvalue| times step up to which an oscillation does not grow, of explicit methods of fixed step:
        along the imaginary axis; 0: no such limit.
    uses_jacobian : bool
        It solves with the Jacobian, so that fast modes do not limit its steps.
    residual_form : bool
        It solves the residual form, which formulation "redundant" has.
    projects : bool
        It projects the state onto the joints.
    """

    name: str
    order: int
    lowest_order: int
    setting: str = "rtol"
    stable_up_to: float = 0.0
    uses_jacobian: bool = False
    residual_form: bool = False
    projects: bool = True


def _pair(name: str, order: int) -> Integrator:
    return Integrator(name=name, order=order, lowest_order=order)


def _fixed(name: str, order: int, stable_up_to: float) -> Integrator:
    return Integrator(name=name, order=order, lowest_order=order, setting="dt", stable_up_to=stable_up_to)


def _implicit(name: str, order: int, *, setting: str = "rtol", residual_form: bool = False) -> Integrator:
    return Integrator(
        name=name, order=order, lowest_order=order, setting=setting, uses_jacobian=True,
        residual_form=residual_form,
    )  # fmt: skip


_ALL = (
    _fixed("semi-implicit-euler", 1, 2.0),
    _fixed("rk4", 4, 2.8),
    _fixed("rk4-exact-memory", 4, 2.8),
    _fixed("rk-low-storage", 4, 3.3),
    _pair("heun21", 2),
    _pair("bs32", 3),
    _pair("rk43", 4),
    _pair("dopri5", 5),
    _pair("tsit5", 5),
    _pair("verner65", 6),
    _pair("verner76", 7),
    _pair("dop853", 8),
    _implicit("rosenbrock", 3),
    _implicit("generalized-alpha", 2, setting="dt", residual_form=True),
    _implicit("generalized-alpha-index2", 2, setting="dt", residual_form=True),
    _pair("ark-erk", 4),
    _implicit("ark-dirk", 4),
    _implicit("ark-imex", 3),
    _implicit("ark-mri", 3, setting="dt"),
    Integrator(name="cvode-adams", order=12, lowest_order=1, projects=False),
    Integrator(name="cvode-bdf", order=5, lowest_order=1, uses_jacobian=True),
    Integrator(name="ida", order=5, lowest_order=1, uses_jacobian=True, residual_form=True),
)


def integrators() -> list[Integrator]:
    """All integration methods of the core, in the order of the documents."""
    known = {method.name: method for method in _ALL}
    return [known[name] for name in _core.integrator_names()]


def integrator(name: str) -> Integrator:
    """The one of that name; SceneError where there is none."""
    for method in integrators():
        if method.name == name:
            return method
    raise SceneError(f'unknown integrator "{name}"; choose one of {", ".join(_core.integrator_names())}')
