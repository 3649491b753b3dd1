"""Cranes built from documented data files: knuckle booms, and others as bodies and joints."""

from __future__ import annotations

from seacrane.crane.builder import FOOT, KnuckleBoomCrane
from seacrane.crane.data_file import CraneData, CylinderData
from seacrane.crane.geometry import BODIES, CraneGeometry, PlanePose
from seacrane.crane.jointed import JointedCrane
from seacrane.crane.load_crane import Crane, load_crane, shipped_cranes
from seacrane.crane.mass_properties import Box, MassProperties, Tube
from seacrane.crane.payload import Payload
from seacrane.crane.records import BodyRecord, JointRecord
from seacrane.crane.urdf_warning import UrdfWarning

__all__ = [
    "BODIES",
    "FOOT",
    "BodyRecord",
    "Box",
    "Crane",
    "CraneData",
    "CraneGeometry",
    "CylinderData",
    "JointRecord",
    "JointedCrane",
    "KnuckleBoomCrane",
    "MassProperties",
    "Payload",
    "PlanePose",
    "Tube",
    "UrdfWarning",
    "load_crane",
    "shipped_cranes",
]
