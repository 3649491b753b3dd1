"""Water on a load: parts with buoyancy, added mass over depth, slam and drag, for `Scene.add_immersed`."""

from seacrane.water.parts import Box as Box
from seacrane.water.parts import Plate as Plate
from seacrane.water.parts import Cylinder as Cylinder
from seacrane.water.parts import Sphere as Sphere
from seacrane.water.parts import Table as Table
from seacrane.water.added_mass import circle_added_mass as circle_added_mass
from seacrane.water.added_mass import perforation_factor as perforation_factor
