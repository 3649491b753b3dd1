"""What every `add_` method takes without its keyword, and what it returns: docs/conventions.md."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import wraps
from typing import Any

import numpy as np
import pytest
from lift_examples import every_table

from seacrane import Scene
from seacrane.crane import Payload, load_crane
from seacrane.description.description import KINDS
from seacrane.hydro import DriftCoefficients, shipped_database, two_barges
from seacrane.scene import Ballast

METHODS = sorted(name for name in dir(Scene) if name.startswith("add_"))


def known(scene: Scene, returned: Any) -> bool:
    """Whether the scene holds what was returned: itself, all of several, or what an answer names."""
    if isinstance(returned, (list, tuple)):
        return bool(returned) and all(known(scene, one) for one in returned)
    if isinstance(returned, Ballast):
        return known(scene, list(returned.forces))
    if returned is not None and returned is scene.waves:
        return True
    return any(returned is one for key in KINDS for one in getattr(scene, key).values())


@contextmanager
def watched(monkeypatch: Any) -> Iterator[dict[str, list[bool]]]:
    """Of each method that is called by a user, whether what it returned was known to the scene."""
    seen: dict[str, list[bool]] = {}

    def watching(name: str, method: Callable[..., Any]) -> Callable[..., Any]:
        @wraps(method)
        def called(scene: Scene, /, *args: Any, **given: Any) -> Any:
            returned = method(scene, *args, **given)
            seen.setdefault(name, []).append(known(scene, returned))
            return returned

        return called

    with monkeypatch.context() as patch:
        for name in METHODS:
            patch.setattr(Scene, name, watching(name, getattr(Scene, name)))
        yield seen


def everything() -> None:
    """Calls of every method: those of a lift file's tables, and the rest."""
    every_table()
    drift = DriftCoefficients(
        heading=np.linspace(0.0, np.pi, 13), omega=np.linspace(0.2, 2.6, 25),
        coefficient=np.full((13, 25, 6), [-2e3, 1e3, 0.0, 0.0, 0.0, 1e4]),
    )  # fmt: skip
    ship = Scene()
    ship.add_vessel(replace(shipped_database(), drift=drift))
    ship.add_sea(hs=2.0, tp=8.0, count=20)
    ship.add_drift(outside="hold")
    ship.add_slack_tank(moment=100.0)
    ship.add_crane(payload=Payload())
    ship.add_ballast()
    ship.add_load(kind="limit", limit="wire", name="also rigid", joint="link")
    ship.add_function_force("wash", body="vessel", address=1)
    ship.add_mesh("vessel", vertices=np.eye(3), faces=[[0, 1, 2]])
    ship.add_limit_state("hook_load", maximum=3e5)
    ship.add_lift_factors("payload", weight_contingency=1.05)
    ship.add_gas_spring(
        "soft", first="vessel", second="payload", area=0.05, force=2e4, stiffness=3e3, length=40.0
    )
    ship.add_given_vessel("rest", name="barge", position=(0.0, 60.0, 0.0))
    ship.add_vessels(two_barges(lid_damping=0.03), position=(0.0, 300.0, 0.0))
    quay = Scene()
    quay.add_crane(load_crane("lattice_boom_100t"), base="ground", payload=Payload())
    quay.add_luffing_rope()


@pytest.mark.warns("SeabedWarning")
def test_every_method_returns_what_it_added_as_the_scene_holds_it(monkeypatch: Any) -> None:
    with watched(monkeypatch) as seen:
        everything()
    assert sorted(seen) == METHODS
    assert {name for name, found in seen.items() if not all(found)} == set()


@pytest.mark.parametrize("name", METHODS)
def test_a_method_takes_one_thing_at_most_without_its_keyword(name: str) -> None:
    """A line takes its two ends besides; the moment of a slack tank is a bare number, which says nothing."""
    _, *parameters = inspect.signature(getattr(Scene, name)).parameters.values()
    bare = [one.name for one in parameters if one.kind is one.POSITIONAL_OR_KEYWORD]
    allowed = ["name", "first", "second"] if name == "add_line" else [parameters[0].name]
    assert bare in ([], allowed)
    assert bare or parameters[0].default is not inspect.Parameter.empty or name == "add_slack_tank"
