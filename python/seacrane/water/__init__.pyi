"""Water on a load: parts with buoyancy, added mass over depth, slam and drag, for `Scene.add_immersed`."""

from seacrane.water.flat_parts import BoxPart as BoxPart
from seacrane.water.flat_parts import PlatePart as PlatePart
from seacrane.water.parts import CylinderPart as CylinderPart
from seacrane.water.parts import SpherePart as SpherePart
from seacrane.water.parts import TablePart as TablePart
from seacrane.water.parts import Opening as Opening
from seacrane.water.mesh_part import MeshPart as MeshPart
from seacrane.water.mesh_part import from_mesh as from_mesh
from seacrane.water.added_mass import circle_added_mass as circle_added_mass
from seacrane.water.added_mass import perforation_factor as perforation_factor
