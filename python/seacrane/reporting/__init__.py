"""Reports of results: pages with everything inside, from one list of sections."""

from seacrane.reporting.report import Report, report

__all__ = ["Report", "report"]
