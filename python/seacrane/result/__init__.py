"""What a run recorded: named arrays, their dimensions and units, files and datasets."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
