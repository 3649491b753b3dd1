"""Seas: spectra, spreading, measured records, several wave systems, and the waves they are realised into."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
