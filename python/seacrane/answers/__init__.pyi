"""Numbers in an engineer's words: the summary of a run, statics, allowable loads, what a scene requires."""

from seacrane.answers.summary import summary as summary
from seacrane.answers.summary import Summary as Summary
from seacrane.answers.statics import statics as statics
from seacrane.answers.statics import Statics as Statics
from seacrane.answers.load_chart import load_chart as load_chart
from seacrane.answers.load_chart import LoadChart as LoadChart
from seacrane.answers.lift_sheet import lift_sheet as lift_sheet
from seacrane.answers.lift_sheet import LiftSheet as LiftSheet
from seacrane.answers.report import report as report
from seacrane.answers.report import Report as Report
from seacrane.answers.contact_hits import contact_hits as contact_hits
from seacrane.answers.contact_hits import ContactHit as ContactHit
from seacrane.answers.required import required as required
from seacrane.answers.requirements import Requirements as Requirements
from seacrane.answers.requirements import Loss as Loss
from seacrane.answers.choices import Choice as Choice
from seacrane.answers.choices import choices_of as choices_of
from seacrane.answers.choices import missing_from as missing_from
from seacrane.answers.choices import uncoupled as uncoupled
from seacrane.accuracy.simpler_scenes import strongest as strongest
from seacrane.accuracy.simpler_scenes import with_memory as with_memory
from seacrane.accuracy.simpler_scenes import locked as locked
from seacrane.accuracy.simpler_scenes import scattered as scattered
