"""What the tables of answers in a lift file ask for: checked as it is read, made of a run or of seeds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from seacrane.answers.code_factors import Beside
from seacrane.description.pick import Pick
from seacrane.ensembles.kept import Kept
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.lift.answer_keys import ANSWERS, AnswerCall
from seacrane.lift.build import refused_at
from seacrane.lift.calls import keywords
from seacrane.lift.check_keys import Entry
from seacrane.plotting.table import Answer
from seacrane.result.result import Result
from seacrane.scene.scene import Scene


@dataclass(frozen=True, kw_only=True)
class Asked:
    """What one table asks for.

    Attributes
    ----------
    given : Keywords of the call, or of what seeds keep.
    simulated : By row what is kept of a run.
    over : What runs over seeds vary; empty: it takes one run, or none.
    """

    call: AnswerCall
    given: Mapping[str, Any]
    simulated: Mapping[str, Kept]
    over: Mapping[str, Any]
    entry: Entry = field(repr=False, compare=False)

    @property
    def takes_run(self) -> bool:
        """Whether it takes the run of the lift."""
        return self.call.takes_run or bool(self.simulated)

    @property
    def curves(self) -> list[Pick]:
        """Of a run, each of which must be one that the scene has."""
        kept = [Pick(channel=one.channel, names=one.names) for one in self.simulated.values()]
        return [*self.call.curves(self.given), *kept]

    @property
    def channels(self) -> tuple[str, ...]:
        """That its runs record."""
        return tuple(dict.fromkeys([*(one.channel for one in self.curves), *self.call.channels]))

    def keep(self) -> Any:
        """What each run over seeds leaves."""
        assert self.call.keep is not None
        return self.call.keep(**self.given)

    def of(self, scene: Scene, result: Result | None) -> Answer:
        """The answer, of a run where it takes one."""
        told = {key: of(scene) for key, of in self.call.of_scene.items() if key not in self.given}
        given = {**told, **self.given, **({"result": result} if self.call.takes_run else {})}
        if not self.simulated:
            return self.call.make(**given)
        assert result is not None
        code: Any = self.call.make(**given)
        return self.call.make(**given, simulated={
            name: _number(code, name, kept, result) for name, kept in self.simulated.items()
        })  # fmt: skip


def asked_of(entry: Entry) -> Asked:
    """What a table asks for; FileFormatError with the line of what is wrong in it."""
    call = ANSWERS[entry.table.name]
    with refused_at(entry):
        given = keywords(call.keys, entry.values)
    for word, of_row in call.rows.items():
        made: dict[str, Any] = {}
        for place, (table, row) in enumerate(zip(entry.values[word], given[word], strict=True)):
            with refused_at(entry, word, place):
                for name, one in of_row(table, row).items():
                    if name in made:
                        raise SceneError(f"{shown(name)} is there twice; give it once")
                    made[name] = one
        if not made:
            entry.fail(f"{word} is empty; give at least one", word)
        given[word] = call.gather(made)
    simulated = {}
    for name, text in given.pop("simulated", {}).items():
        with refused_at(entry, "simulated", name):
            simulated[name] = _kept(text)
    over: dict[str, Any] = {}
    if call.keep is not None:
        over["seed"] = range(1, 1 + given.pop("seeds"))
        over |= {"hs": list(given.pop("hs"))} if "hs" in given else {}
    asked = Asked(call=call, given=given, simulated=simulated, over=over, entry=entry)
    with refused_at(entry):
        if call.keep is not None:
            asked.keep()
        elif not call.takes_run:  # by itself, with whatever a scene and a run may give
            unknown = {"simulated": dict.fromkeys(simulated, np.nan)} if simulated else {}
            call.make(**dict.fromkeys(call.of_scene, 1.0) | given | unknown)
    return asked


def _kept(text: str) -> Kept:
    kept = Kept.of_text(text)
    if kept.what == "series":
        raise SceneError(f"is {text!r}, a curve; give a number of it, such as '{text}.max'")
    return kept


def _number(code: Beside[Any], name: str, kept: Kept, result: Result) -> float:
    """What is kept of a run, in the unit of a row."""
    found = kept.of(result)
    unit, own = found.attributes["units"], code.unit_of(name) or "1"
    if unit != own:
        raise SceneError(f"simulated: {kept.channel} is in {unit}, and {name!r} in {own}; give another")
    if found.values.size != 1:
        raise SceneError(f"simulated: {kept.channel} has several curves; name one in brackets")
    return float(found.values.item())
