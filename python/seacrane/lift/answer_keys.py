"""Answers that a lift file may ask for: a table has the name of the call, its keys are the keywords.

One entry of `ANSWERS` is all that an answer takes: schema, checks, the command and its files follow from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from inspect import signature
from typing import Any

import numpy as np

from seacrane.answers.code_factors import DECKS, code_factors
from seacrane.answers.deck_cargo import Cargo, deck_cargo
from seacrane.answers.fatigue import FatigueCurve, fatigue
from seacrane.answers.re_hits import ReHit, re_hit_probability
from seacrane.answers.rest_columns import HOOK_STIFFNESS, columns_of
from seacrane.answers.simplified_method import Draught, simplified_method
from seacrane.answers.statics import hanging_rest
from seacrane.description.pick import Pick, pick_of
from seacrane.errors import SceneError
from seacrane.inputs.caller import warn_caller
from seacrane.lift.inner_keys import LENGTH, POINT, ROW, TIME
from seacrane.lift.keys import EITHER, Key, keys_of, require_unit
from seacrane.plotting.table import Answer
from seacrane.run.channel_names import unit_in
from seacrane.scene.scene import Scene
from seacrane.warnings import MassUnitWarning

Given = Mapping[str, Any]
MASS, SPEED, STIFFNESS = ({"unit": unit} for unit in ("kg", "m/s", "N/m"))
AREA, ACROSS = {"unit": "m2"}, POINT | {"shapes": ((-1, 3),)}
SIMULATED = {"type": "names", "text": 'What a run leaves by rows, such as "slack_margin[hoist].max".'}
SCALES = {"N": ("N", "m2", "1"), "N m": ("N m", "m3", "1")}  # of a curve over the unit of its channel
FAR = 100.0  # a mass in another unit is by 1000
SCALE = EITHER.join(dict.fromkeys(unit for units in SCALES.values() for unit in units))


@dataclass(frozen=True, kw_only=True)
class AnswerCall:
    """An answer that a lift file may ask for.

    Attributes
    ----------
    make : Its call, with `result` where it takes a run, and `simulated` where a run may stand beside it.
    keys : Of its table.
    rows : Of the tables within it, by keyword: what one makes by its names.
    require : Of the tables within it, by keyword: refuses one, as it is written, that does not fit the scene.
    gather : What the call takes of all that rows make by their names.
    curves : Of the run, by what is asked: each must be one that the scene has.
    channels : Which the run records besides.
    keep : What runs over seeds leave each, of which the call is made; None: it takes one run, or none.
    of_scene : Keywords that the scene tells where the table does not.
    """

    make: Callable[..., Answer]
    keys: tuple[Key, ...]
    rows: Mapping[str, Callable[[Given], Given]] = field(default_factory=dict)
    require: Mapping[str, Callable[[Scene, Given], None]] = field(default_factory=dict)
    gather: Callable[[Given], Any] = lambda found: [*found.values()]
    curves: Callable[[Given], Iterable[Pick]] = lambda given: ()
    channels: tuple[str, ...] = ()
    keep: Callable[..., Any] | None = None
    of_scene: Mapping[str, Callable[[Scene], float]] = field(default_factory=dict)

    @property
    def takes_run(self) -> bool:
        """Whether it is of one run, whatever is asked."""
        return "result" in signature(self.make).parameters


def _tables(call: Any, *before: Key, **more: Given) -> dict[str, Any]:
    """A key that is a list of tables, each of which is a call."""
    return {"type": "tables", "keys": (*before, *keys_of(call, more=more))}


def _named(kind: Callable[..., Any], by: str) -> Callable[[Given], Given]:
    return lambda given: {given[by]: kind(**given)}


def _curves(given: Given) -> dict[str, FatigueCurve]:
    """One curve by its channels."""
    of = dict(given)
    return dict.fromkeys(of.pop("channels"), FatigueCurve(**of))


def _require_scale(scene: Scene, table: Given) -> None:
    """Of the unit of its channels, or of a section."""
    for channel in table["channels"]:
        units = SCALES.get(unit_in(scene, pick_of("fatigue", channel)), ("1",))
        require_unit(SCALED, table, EITHER.join(units), f"the scale of {channel}")


def _of_hooks(scene: Scene, column: str) -> dict[str, float]:
    """A column of statics by its hooks, the load off any deck."""
    columns = columns_of(hanging_rest(scene))
    return {name: one for name, (_, one) in columns.items() if name.startswith(column)}


def require_mass(scene: Scene, mass: float) -> None:
    """Warn of a mass in another unit than what hangs on the only hook."""
    found: dict[str, float] = {}
    with suppress(SceneError):
        found = _of_hooks(scene, "hook load")
    hung = next(iter(found.values())) / scene.gravity if len(found) == 1 else float("nan")
    if not FAR > mass / hung > 1.0 / FAR and np.isfinite(hung):
        told = f"mass is {mass:g} kg, and the hook of the lift carries {hung:.4g} kg: a slip in its unit?"
        warn_caller(told, MassUnitWarning)


def _hook_stiffness(scene: Scene) -> float:
    """Of the only hook."""
    found = _of_hooks(scene, HOOK_STIFFNESS)
    if len(found) != 1 or not np.isfinite([*found.values()]).all():
        told = ", ".join(f"{name} {one:g}" for name, one in found.items()) or "no hook"
        raise SceneError.of("stiffness", f"is left to statics, which has {told}; give stiffness_N_per_m")
    return float(*found.values())


CHANNELS = Key("channels", "texts", text="Which wear by it, such as line_tension[hoist].", required=True)
CURVE = _tables(FatigueCurve, CHANNELS, scale={"unit": SCALE})
SCALED = tuple(key for key in CURVE["keys"] if key.name == "scale")
SEEDS = (
    Key("seeds", "whole", text="How many, from 1 on.", required=True, bounds={"minimum": 1}),
    Key("hs", **ROW | LENGTH, text="Significant wave heights; default: that of the sea."),
)
_ALL = (
    AnswerCall(
        make=fatigue, keys=keys_of(fatigue, more={"curves": CURVE, "after": TIME}, without=("result",)),
        rows={"curves": _curves}, require={"curves": _require_scale}, gather=dict,
        curves=lambda given: [pick_of("fatigue", one) for one in given["curves"]],
    ),
    AnswerCall(
        make=code_factors, of_scene={"stiffness": _hook_stiffness},
        keys=keys_of(code_factors, more={
            "hs": LENGTH, "mass": MASS, "deck": {"choices": tuple(DECKS)}, "simulated": SIMULATED,
            "stiffness": STIFFNESS | {"required": False, "text": "At the hook; default: that of statics."},
            "tip_speed": SPEED, "hoisting_speed": SPEED,
        }),
    ),
    AnswerCall(
        make=simplified_method, rows={"draughts": _named(Draught, "name")},
        keys=keys_of(simplified_method, more={
            "mass": MASS, "hs": LENGTH, "tz": TIME, "lowering_speed": SPEED, "tip_heave": LENGTH,
            "tip_speed": SPEED, "tip_acceleration": {"unit": "m/s2"}, "stiffness": STIFFNESS,
            "density": {"unit": "kg/m3"}, "simulated": SIMULATED, "draughts": _tables(
                Draught, depth=LENGTH, volume={"unit": "m3"}, added_mass=MASS, drag_area=AREA,
                slam_area=AREA, water_plane=AREA,
            ),
        }),
    ),
    AnswerCall(
        make=deck_cargo, rows={"cargo": _named(Cargo, "point")}, channels=("quaternion",),
        keys=keys_of(deck_cargo, without=("result",), more={"after": TIME, "cargo": _tables(
            Cargo, mass=MASS, fastenings=ACROSS, stiffness={"type": "array", "shapes": ((-1, 3),)},
        )}),
        curves=lambda given: [
            Pick(channel="point_acceleration", names={"point": one.point, "axis": "z"})
            for one in given["cargo"]
        ],
    ),
    AnswerCall(
        make=re_hit_probability, keep=ReHit, keys=(*keys_of(ReHit, more={"margin": LENGTH}), *SEEDS),
        curves=lambda given: [Pick(channel="contact_least_gap", names={"contact": given["contact"]})],
        channels=("contact_press",),
    ),
)  # fmt: skip
ANSWERS: Mapping[str, AnswerCall] = {one.make.__name__: one for one in _ALL}
