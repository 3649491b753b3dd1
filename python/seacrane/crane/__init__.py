"""Cranes built from documented data files: knuckle booms, and others as bodies and joints."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
