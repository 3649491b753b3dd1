"""What a run recorded: named arrays, their dimensions and units, files and datasets."""

from seacrane.files.atomic import atomic_write
from seacrane.inputs.frames import MOTIONS
from seacrane.result.about import About
from seacrane.result.channels import AXES, CHANNELS, Channel
from seacrane.result.events import Event
from seacrane.result.result import Result

__all__ = ["AXES", "CHANNELS", "MOTIONS", "About", "Channel", "Event", "Result", "atomic_write"]
