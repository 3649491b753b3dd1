"""Hydrodynamics of the vessel: databases, their readers and self-check, fluid memory."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
