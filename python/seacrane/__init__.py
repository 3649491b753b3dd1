"""Offshore crane, payload and vessel moving together in waves.

Describe a `Scene`, `simulate` it, look at the `Result`. SI units, radians; x forward, y to port, z up.
"""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
