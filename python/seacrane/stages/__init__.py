"""Lifts as sequences: stages with commands, connections and conditions to end, run as one result."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
