"""Statistics of records and of the maxima of seeds, how sure they are, and runs beside what was measured."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
