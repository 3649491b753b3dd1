"""Statistics of records and of the maxima of seeds, how sure they are, and runs beside what was measured."""

from seacrane.statistics.of_results import extremes as extremes
from seacrane.statistics.estimate import Maximum as Maximum
from seacrane.statistics.estimate import Estimate as Estimate
from seacrane.statistics.seeds import SeedExtremes as SeedExtremes
from seacrane.statistics.seeds import seed_extremes as seed_extremes
from seacrane.statistics.record_extremes import RecordExtremes as RecordExtremes
from seacrane.statistics.record_extremes import record_extremes as record_extremes
from seacrane.statistics.distribution import Distribution as Distribution
from seacrane.statistics.distribution import distribution as distribution
from seacrane.statistics.tail import Tail as Tail
from seacrane.statistics.estimate import gaussian_maximum as gaussian_maximum
from seacrane.statistics.control_variate import controlled_mean as controlled_mean
from seacrane.statistics.control_variate import ControlledMean as ControlledMean
from seacrane.statistics.record import spectrum_estimate as spectrum_estimate
from seacrane.statistics.record import SpectrumEstimate as SpectrumEstimate
from seacrane.sea.measured_series import MeasuredSeries as MeasuredSeries
from seacrane.sea.mending import interpolated as interpolated
from seacrane.statistics.compare import compare as compare
from seacrane.statistics.compare import Comparison as Comparison
