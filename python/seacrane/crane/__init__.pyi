"""Cranes of bodies and joints, built from documented data files."""

from seacrane.crane.parts import Payload as Payload
from seacrane.crane.load_crane import load_crane as load_crane
from seacrane.crane.load_crane import shipped_cranes as shipped_cranes
from seacrane.crane.crane import Crane as Crane
from seacrane.crane.data import CraneData as CraneData
from seacrane.crane.data import BodyData as BodyData
from seacrane.crane.data import JointData as JointData
from seacrane.scene.add_crane import FOOT as FOOT
from seacrane.crane.parts import CraneParts as CraneParts
from seacrane.crane.mass_properties import MassProperties as MassProperties
from seacrane.crane.mass_properties import Box as Box
from seacrane.crane.mass_properties import Tube as Tube
