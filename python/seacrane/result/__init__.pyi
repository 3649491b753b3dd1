"""What a run recorded: named arrays, their dimensions and units, files and datasets."""

from seacrane.result.result import Result as Result
from seacrane.run.to_file import StreamedResult as StreamedResult
from seacrane.result.about import About as About
from seacrane.result.about import Event as Event
from seacrane.result.utilisation import Utilisation as Utilisation
from seacrane.result.traces import heavy_line_tension as heavy_line_tension
from seacrane.description.channels import Channel as Channel
from seacrane.description.channels import CHANNELS as CHANNELS
from seacrane.description.channels import AXES as AXES
from seacrane.inputs.frames import MOTIONS as MOTIONS
