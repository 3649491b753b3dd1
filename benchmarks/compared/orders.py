"""Orders of integration methods on a crane with constraints."""

from __future__ import annotations

from test_integrator_orders import measured_order

from seacrane import _core, integrator_names

HEAD = ("method", "order", "measured")


def orders(names: tuple[str, ...] | None = None) -> list[tuple[str, str, str]]:
    """Each method, its order, and the slope of the payload's error over the number of steps."""
    return [
        (f"`{name}`", _order(_core.integrator(name)), f"{measured_order(name):.2f}")
        for name in names or integrator_names()
    ]


def _order(method: _core.Integrator) -> str:
    if method.lowest_order < method.order:
        return f"{method.lowest_order} to {method.order}, chosen as it runs"
    return str(method.order)
