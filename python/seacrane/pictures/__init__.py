"""Pictures: quick overviews, the paper's figures, and the page in three dimensions."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
