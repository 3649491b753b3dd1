"""Knuckle-boom cranes built from one documented data file."""

from __future__ import annotations

from seacrane.crane.builder import FOOT, KnuckleBoomCrane
from seacrane.crane.data_file import CraneData, CylinderData
from seacrane.crane.geometry import BODIES, CraneGeometry, PlanePose
from seacrane.crane.mass_properties import Box, MassProperties, Tube
from seacrane.crane.payload import Payload
from seacrane.crane.records import BodyRecord, JointRecord

__all__ = [
    "BODIES",
    "FOOT",
    "BodyRecord",
    "Box",
    "CraneData",
    "CraneGeometry",
    "CylinderData",
    "JointRecord",
    "KnuckleBoomCrane",
    "MassProperties",
    "Payload",
    "PlanePose",
    "Tube",
]
