"""Many runs of one lift: what varies, what each run keeps, and where the results go."""

from seacrane.ensembles.ensemble import ensemble as ensemble
from seacrane.ensembles.ensemble import Ensemble as Ensemble
from seacrane.ensembles.merging import merge_parts as merge_parts
from seacrane.ensembles.price import Price as Price
from seacrane.ensembles.priced import ensemble_price as ensemble_price
from seacrane.ensembles.kept import Kept as Kept
from seacrane.ensembles.members import LatinHypercube as LatinHypercube
from seacrane.ensembles.chosen_accuracy import EnsembleAccuracy as EnsembleAccuracy
from seacrane.ensembles.targets import Certainty as Certainty
from seacrane.ensembles.linear_control import LinearControl as LinearControl
from seacrane.ensembles.linear_control import HookLoadControl as HookLoadControl
