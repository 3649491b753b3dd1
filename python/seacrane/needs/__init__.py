"""What a scene requires: each choice of modelling made simpler, one at a time, with its cost and its loss."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
