"""The contacts of a run: how hard, how fast and how often again each was hit."""

from __future__ import annotations

from seacrane.answers.blocks import note
from seacrane.answers.section import Section
from seacrane.plotting.html import table
from seacrane.result import Result
from seacrane.result.contact_loads import HEAD, contact_loads

NOTE = (
    "Speed is that at which a point comes, along the surface's normal. A re-hit is each contact of a point "
    "after its first. The largest press is that of the outputs."
)


def _html(result: Result) -> str:
    return table(HEAD, contact_loads(result).cells()) + note(NOTE)


CONTACTS: Section[Result] = Section(
    title="Contacts", applies=lambda result: bool(contact_loads(result)), html=_html
)
