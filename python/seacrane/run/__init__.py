"""Runs, at once or in stages: settings, stepping, outputs to memory or to a file."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
