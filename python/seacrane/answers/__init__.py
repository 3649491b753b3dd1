"""Numbers in an engineer's words: the summary of a run, statics, allowable loads, what a scene requires."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
