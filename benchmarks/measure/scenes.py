"""The scenes that are measured."""

from __future__ import annotations

from collections.abc import Callable

from seacrane import Scene, cases

SCENES: dict[str, Callable[[], Scene]] = {
    "case2": cases.case2,
    "case1": cases.case1,
    "case3": cases.case3,
    "vessel": cases.vessel,
    "case2, no memory": lambda: cases.case2(memory="none"),
    "case2, calm water": lambda: cases.case2(hs=0.0),
    "case2, exact wave sum": lambda: cases.case2(evaluation="exact"),
}
