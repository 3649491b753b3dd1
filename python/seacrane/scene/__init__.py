"""What is added to a scene from hydrodynamics, seas, winds and limits."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
