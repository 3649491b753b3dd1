"""Seas: spectra, spreading, several wave systems and the waves they are realised into; measured series."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
