"""Cranes built from documented data files: knuckle booms, and others as bodies and joints."""

from seacrane.crane.payload import Payload as Payload
from seacrane.crane.load_crane import load_crane as load_crane
from seacrane.crane.load_crane import shipped_cranes as shipped_cranes
from seacrane.crane.load_crane import Crane as Crane
from seacrane.crane.builder import KnuckleBoomCrane as KnuckleBoomCrane
from seacrane.crane.jointed import JointedCrane as JointedCrane
from seacrane.crane.data_file import CraneData as CraneData
from seacrane.crane.data_file import CylinderData as CylinderData
from seacrane.crane.geometry import CraneGeometry as CraneGeometry
from seacrane.crane.geometry import PlanePose as PlanePose
from seacrane.crane.geometry import BODIES as BODIES
from seacrane.crane.builder import FOOT as FOOT
from seacrane.crane.records import BodyRecord as BodyRecord
from seacrane.crane.records import JointRecord as JointRecord
from seacrane.crane.mass_properties import MassProperties as MassProperties
from seacrane.crane.mass_properties import Box as Box
from seacrane.crane.mass_properties import Tube as Tube
