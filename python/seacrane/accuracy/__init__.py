"""The error of a run: what it is measured in, how it is estimated, and methods chosen by it."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
