"""Statistics of records and of the maxima of seeds: what is exceeded, and how sure that is."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
