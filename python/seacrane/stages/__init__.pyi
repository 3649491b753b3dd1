"""Lifts as sequences: stages with commands, connections and conditions to end, run as one result."""

from seacrane.stages.stage import Stage as Stage
from seacrane.stages.move import Move as Move
from seacrane.stages.until import Until as Until
from seacrane.stages.staged_run import simulate_stages as simulate_stages
from seacrane.stages.to_file import simulate_stages_to_file as simulate_stages_to_file
from seacrane.stages.staged_run import StagedRun as StagedRun
