"""The one list of sections: what a report of a result holds, from what an engineer asks first to provenance.

A new section is a module with a `Section` and an entry here.
"""

from __future__ import annotations

from seacrane.answers.checks import CHECKS, COST, EVENTS, WARNINGS
from seacrane.answers.contacts_section import CONTACTS
from seacrane.answers.glance import GLANCE
from seacrane.answers.histories import HISTORIES, LOADS, SCENE_PICTURE, THREE_DIMENSIONS, TRACKS
from seacrane.answers.limits_section import LIMITS
from seacrane.answers.particulars import PARTICULARS
from seacrane.answers.provenance_section import PROVENANCE
from seacrane.answers.section import Section
from seacrane.answers.sheet_section import SHEET
from seacrane.answers.summary_section import STATISTICS, SUMMARY
from seacrane.result import Result

SECTIONS: tuple[Section[Result], ...] = (
    GLANCE,
    SUMMARY,
    SHEET,
    PARTICULARS,
    SCENE_PICTURE,
    THREE_DIMENSIONS,
    LOADS,
    LIMITS,
    CONTACTS,
    STATISTICS,
    HISTORIES,
    TRACKS,
    EVENTS,
    WARNINGS,
    CHECKS,
    COST,
    PROVENANCE,
)
