"""Orders of integration methods on a crane with constraints."""

from __future__ import annotations

from collections.abc import Iterator

from test_integrator_orders import measured_order

from seacrane import _core, integrator_names

from .row import Row


def orders(names: tuple[str, ...] | None = None) -> Iterator[Row]:
    """Each method: the slope of the payload's error over the number of steps, beside its order."""
    for name in names or integrator_names():
        method, found = _core.integrator(name), measured_order(name)
        low, high = min(method.lowest_order, method.order), method.order
        yield Row(
            subject="Orders of methods", compared=f"`{name}`: measured {found:.2f}",
            reference=f"order {high}" if low == high else f"order {low} to {high}, chosen as it runs",
            difference=max(low - found, 0.0), unit="below it", limit=0.25,
            test="multibody/test_integrator_orders.py",
        )  # fmt: skip
