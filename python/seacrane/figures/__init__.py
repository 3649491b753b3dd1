"""Pictures of runs: the paper's figures 3 to 10, a quick overview, and the paper's findings as numbers."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
