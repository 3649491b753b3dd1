"""ensemble_price(): the price of an ensemble, without going on."""

from __future__ import annotations

from typing import Any

from seacrane.ensembles.ensemble import ensemble
from seacrane.ensembles.price import Price
from seacrane.ensembles.study import Source


def ensemble_price(source: Source, **given: Any) -> Price | None:
    """What ``ensemble(source, **given)`` costs, by a few of its members.

    These are run as the ensemble runs them, and its `store` keeps them: the ensemble goes on with the others.

    Parameters
    ----------
    source, **given
        As of `ensemble`.

    Returns
    -------
    Price or None
        None where no member is left to run, or `until` is past its first batch.

    Raises
    ------
    SceneError, SimulationError, WorkerVersionError, OSError
        As `ensemble`.
    """
    told: list[Price | None] = []

    def stop(price: Price | None) -> bool:
        told.append(price)
        return False

    ensemble(source, **given, priced=stop)
    return told[0]
