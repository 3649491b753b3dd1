"""Many runs of one lift: what varies, what each run keeps, and where the results go."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
