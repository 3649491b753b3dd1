"""Runs, at once or in stages: settings, stepping, outputs to memory or to a file."""

from seacrane.simulation import simulate as simulate
from seacrane.run.run import Run as Run
from seacrane.run.method import Method as Method
from seacrane.run.outputs import Outputs as Outputs
from seacrane.run.sampled_controller import SampledController as SampledController
from seacrane._core import Model as Model
from seacrane._core import State as State
from seacrane._core import integrator_names as integrator_names
from seacrane.run.stage import Stage as Stage
from seacrane.run.commands import Move as Move
from seacrane.run.stage import Until as Until
from seacrane.run.staged_run import StagedRun as StagedRun
