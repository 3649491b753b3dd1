"""Water on a load: parts with buoyancy, added mass over depth, slam and drag, for `Scene.add_immersed`."""

from seacrane.lazy import face

__all__ = face(__name__, __file__)
