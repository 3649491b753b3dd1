"""What every element owes in a run: both formulations, a closed ledger, the bits of a run that goes on."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from multibody_runs import record
from numpy.testing import assert_allclose

from seacrane import Run, Scene, State

FORMULATIONS = ("redundant", "recursive")


def both_forms(
    scene: Scene, t_end: float, within: dict[str, Any], *, merge: bool = False, ledger: float = 1e-6,
    **how: Any,
) -> dict[str, Any]:  # fmt: skip
    """Run in both formulations, with `merge` as a model whose bodies are not merged too.

    Channels agree within the bounds given (absolute, or absolute and relative), and the energy balances to a
    share of the work; the redundant run is returned.
    """
    runs = [record(scene, t_end, formulation=name, **how) for name in FORMULATIONS]
    assert set(within) <= set(runs[0])
    if merge:
        settings = {"dt_out": 0.05, "rtol": 1e-8} | how
        unmerged = Run(scene, t_end=t_end, model=scene.compile(merge=False), **settings)
        unmerged.advance(t_end)
        runs.append(dict(unmerged.core.channels()))
    for out in runs:
        for name, bound in within.items():
            if name in out:  # by default not all are recorded
                atol, rtol = bound if isinstance(bound, tuple) else (bound, 0.0)
                assert_allclose(out[name], runs[0][name], atol=atol, rtol=rtol, err_msg=name)
        assert np.max(np.abs(out["energy_balance"])) < ledger * out["absolute_work"][-1]
    return runs[0]


def goes_on(
    make: Callable[[], Scene], t_end: float, at: float, folder: Path | None = None, **how: Any
) -> State:
    """A run that is stopped and goes on from its state has the bits of the whole, and tells events once."""
    whole = Run(make(), t_end=t_end, **how)
    whole.advance(at)
    half, told = whole.core.state, len(whole.events())
    if folder is not None:
        half.save(folder / "half.state")
        half = State.load(folder / "half.state", scene=make())
    rest = Run(make(), t_end=t_end, start=half, **how)
    for run in (whole, rest):
        run.advance(t_end)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)
    assert [*whole.events()[told:]] == [*rest.events()]
    return half
