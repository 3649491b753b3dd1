"""Cranes of bodies and joints, built from documented data files."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
