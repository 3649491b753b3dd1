"""The one list of sections: what a report of a result holds, from what an engineer asks first to provenance.

A new section is a module with a `Section` and an entry here.
"""

from __future__ import annotations

from seacrane.reporting.checks import CHECKS, COST, EVENTS, WARNINGS
from seacrane.reporting.glance import GLANCE
from seacrane.reporting.histories import HISTORIES, LOADS, SCENE_PICTURE, THREE_DIMENSIONS, TRACKS
from seacrane.reporting.limits import LIMITS
from seacrane.reporting.particulars import PARTICULARS
from seacrane.reporting.provenance import PROVENANCE
from seacrane.reporting.section import Section
from seacrane.reporting.summary import STATISTICS, SUMMARY
from seacrane.result import Result

SECTIONS: tuple[Section[Result], ...] = (
    GLANCE,
    SUMMARY,
    PARTICULARS,
    SCENE_PICTURE,
    THREE_DIMENSIONS,
    LOADS,
    LIMITS,
    STATISTICS,
    HISTORIES,
    TRACKS,
    EVENTS,
    WARNINGS,
    CHECKS,
    COST,
    PROVENANCE,
)
