"""In which seas a lift may go ahead: allowable Hs, availability, weather windows, waiting for them."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
