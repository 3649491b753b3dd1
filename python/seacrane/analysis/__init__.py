"""Rest, statics, inverse dynamics and linear theory of a scene."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
