"""The one list of sections: what a report of a result holds, from what an engineer asks first to provenance.

A new section is a module with a `Section` and an entry here.
"""

from __future__ import annotations

from seacrane.reporting.checks import CHECKS, COST, EVENTS, WARNINGS
from seacrane.reporting.glance import GLANCE
from seacrane.reporting.histories import HISTORIES, LOADS, TRACKS
from seacrane.reporting.limits import LIMITS
from seacrane.reporting.particulars import PARTICULARS
from seacrane.reporting.provenance import PROVENANCE
from seacrane.reporting.scene_picture import SCENE_PICTURE
from seacrane.reporting.section import Section
from seacrane.reporting.statistics import STATISTICS
from seacrane.reporting.summary import SUMMARY
from seacrane.reporting.three_dimensions import THREE_DIMENSIONS
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
