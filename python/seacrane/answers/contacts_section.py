"""The contacts of a run: how hard, how fast and how often again each was hit."""

from __future__ import annotations

from seacrane.answers.blocks import note
from seacrane.answers.section import Section
from seacrane.result import Result
from seacrane.result.contact_loads import contact_loads

NOTE = (
    "Speed is that at which a point comes, along the surface's normal. A re-hit is each contact of a point "
    "after its first. The largest press is that of the outputs."
)


def _html(result: Result) -> str:
    told = contact_loads(result)
    return told.html() + note(NOTE) if told else ""


CONTACTS: Section[Result] = Section("Contacts", _html)
