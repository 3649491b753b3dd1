"""What the tables of answers in a lift file ask for: checked as it is read, made of a run or of seeds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from seacrane.description.pick import Pick
from seacrane.description.provenance import SeaProvenance
from seacrane.ensembles.kept import Kept
from seacrane.ensembles.other_sea import require_same_sea
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.lift.answer_keys import ANSWERS, AnswerCall, require_mass
from seacrane.lift.build import refused_at
from seacrane.lift.calls import keywords
from seacrane.lift.check_keys import Entry
from seacrane.plotting.table import Answer
from seacrane.result.result import Result
from seacrane.run.channel_names import require_curves, unit_in
from seacrane.scene.scene import Scene

SAME_SEA = 0.01  # relative
FIX = "give that of one sea, or leave simulated out"


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

    def require(self, scene: Scene) -> None:
        """Refuse before any run what the scene has not, and a number in another unit than that of its row."""
        with refused_at(self.entry):
            require_curves(scene, self.curves)
            if self.over:
                require_same_sea(scene, self.over)
            if "mass" in self.given:
                require_mass(scene, self.given["mass"])
            given = self._given(scene)
            code: Any = self.call.make(**given) if self.simulated else None
            if self.simulated:
                self._require_sea(scene)
        for word, require in self.call.require.items():
            for place, table in enumerate(self.entry.values[word]):
                with refused_at(self.entry, word, place):
                    require(scene, table)
        for name, kept in self.simulated.items():
            unit = unit_in(scene, Pick(channel=kept.channel, names=kept.names))
            if unit != (code.unit_of(name) or "1"):
                told = f"{kept.channel} is in {unit}, and {name!r} in {code.unit_of(name) or '1'}"
                self.entry.fail(f"simulated: {told}; give another", "simulated")
            if kept.what != code.what_of_run:
                told = f"{name!r} is a {code.what_of_run} of the run, and not its {kept.what}"
                self.entry.fail(f"simulated: {told}; give .{code.what_of_run[:3]}", "simulated")

    def _require_sea(self, scene: Scene) -> None:
        """SceneError for a code in another sea than the run beside it."""
        of = SeaProvenance() if scene.waves is None else scene.waves.provenance
        hs, tz = self.given["hs"], self.given.get("tz", 0.0)
        if of.sea is None and of.hs and abs(hs - of.hs) > SAME_SEA * of.hs:
            raise SceneError.of("hs", f"is {hs:g} m, and the run beside it is in a sea of {of.hs:g} m; {FIX}")
        if of.sea is None and of.tp and tz >= of.tp:
            told = f"is {tz:g} s, and the run beside it is in a sea of Tp {of.tp:g} s, whose Tz is shorter"
            raise SceneError.of("tz", f"{told}; {FIX}")

    def of(self, scene: Scene, result: Result | None) -> Answer:
        """The answer, of a run where it takes one."""
        with refused_at(self.entry):
            given = self._given(scene)
            if self.call.takes_run:
                given["result"] = result
            if self.simulated:
                assert result is not None
                given["simulated"] = {name: _number(kept, result) for name, kept in self.simulated.items()}
            return self.call.make(**given)

    def _given(self, scene: Scene) -> dict[str, Any]:
        """With what the scene tells where the table does not."""
        told = {key: of(scene) for key, of in self.call.of_scene.items() if key not in self.given}
        return {**told, **self.given}


def asked_of(entry: Entry) -> Asked:
    """What a table asks for; FileFormatError with the line of what is wrong in it."""
    call = ANSWERS[entry.table.name]
    with refused_at(entry):
        given = keywords(call.keys, entry.values)
    for word in call.rows:
        given[word] = call.gather(_by_name(entry, word, call, given[word]))
    simulated: dict[str, Kept] = {}
    over: dict[str, Any] = {}
    for name, text in given.pop("simulated", {}).items():
        with refused_at(entry, "simulated", name):
            simulated[name] = _kept(text)
    if call.keep is not None:
        over = {"seed": range(1, 1 + given.pop("seeds"))}
        over |= {"hs": list(given.pop("hs"))} if "hs" in given else {}
    asked = Asked(call=call, given=given, simulated=simulated, over=over, entry=entry)
    with refused_at(entry):
        if call.keep is not None:
            asked.keep()
        elif not call.takes_run:  # by itself, with whatever a scene and a run may give
            unknown = {"simulated": dict.fromkeys(simulated, np.nan)} if simulated else {}
            call.make(**dict.fromkeys(call.of_scene, 1.0) | given | unknown)
    return asked


def _by_name(entry: Entry, word: str, call: AnswerCall, rows: Sequence[Any]) -> dict[str, Any]:
    """What the tables within one make, by their names."""
    found: dict[str, Any] = {}
    for place, row in enumerate(rows):
        with refused_at(entry, word, place):
            for name, one in call.rows[word](row).items():
                if name in found:
                    raise SceneError(f"{shown(name)} is there twice; give it once")
                found[name] = one
    if not found:
        entry.fail(f"{word} is empty; give at least one", word)
    return found


def _kept(text: str) -> Kept:
    kept = Kept.of_text(text)
    if kept.what == "series":
        raise SceneError(f"is {text!r}, a curve; give a number of it, such as '{text}.max'")
    return kept


def _number(kept: Kept, result: Result) -> float:
    values = kept.of(result).values
    if values.size != 1:
        raise SceneError(f"simulated: {kept.channel} has several curves; name one in brackets")
    if not np.isfinite(values).all():
        raise SceneError(f"simulated: {kept.channel} is no number at some outputs; name a stage that has it")
    return float(values.item())
