"""Hydrodynamics: databases of vessels, readers, self-check, fluid memory; parts of a load in water."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
