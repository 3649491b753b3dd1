"""Numbers in an engineer's words: the summary of a run, statics, allowable loads."""

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
