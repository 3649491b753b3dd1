"""A result or a scene as one self-contained page in three dimensions."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
