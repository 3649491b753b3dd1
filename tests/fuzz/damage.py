"""Damage and the answer that it must get: edits of sound files of the corpus, one a line of ``damage.jsonl``.

A line holds the target, the edit and ``answer``, a pattern that the refusal has to match. Edits: ``replace``
(a text by another, once), ``line`` and ``text`` (a line, counted from 1, by another; null drops it), ``set``
(an entry of a JSON document, by its keys; null drops it), or ``whole`` (the text itself).
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple

from fuzz.targets import CORPUS, TARGETS

SOUND = {  # where there is no set
    "aqwa": "hull", "aqwa-listing": "hull", "orcaflex": "model", "orcaflex-text": "model",
    "lift": "every-table",
}  # fmt: skip


class Damage(NamedTuple):
    """One line of the list."""

    target: str
    edit: dict[str, Any]
    answer: str

    def case(self) -> bytes:
        if "whole" in self.edit:
            return str(self.edit["whole"]).encode()
        sound = sound_case(self.target)
        if "replace" in self.edit:
            old, new = (text.encode() for text in self.edit["replace"])
            assert old in sound, f"{self.target} does not hold {old!r}"
            return sound.replace(old, new, 1)
        if "line" in self.edit:
            lines, text = sound.decode().splitlines(keepends=True), self.edit["text"]
            lines[self.edit["line"] - 1] = "" if text is None else f"{text}\n"
            return "".join(lines).encode()
        document = entry = json.loads(sound)
        (*path, last), value = self.edit["set"]
        for key in path:
            entry = entry[key]
        if value is None:
            del entry[last]
        else:
            entry[last] = value
        return json.dumps(document).encode()


def sound_case(name: str) -> bytes:
    """The sound file of a target."""
    target = TARGETS[name]
    path = CORPUS / target.beside / target.file if target.beside else CORPUS / name / SOUND[name]
    return path.read_bytes()


def damages(name: str | None = None) -> list[Damage]:
    """All of the list, or those of one target."""
    lines = [json.loads(line) for line in Path(CORPUS / "damage.jsonl").read_text().splitlines()]
    found = [Damage(line.pop("target"), line, line.pop("answer")) for line in lines]
    return [damage for damage in found if name in (None, damage.target)]
