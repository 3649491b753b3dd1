"""Offshore crane, payload and vessel moving together in waves.

Describe a `Scene`, `simulate` it, look at the `Result`. SI units, radians; x forward, y to port, z up.
"""

# Describe a lift
from seacrane.scene.scene import Scene as Scene
from seacrane.lift.lift import Lift as Lift
from seacrane.crane.parts import Payload as Payload
from seacrane.hydro.database.database import HydroDatabase as HydroDatabase
from seacrane.hydro.database.database import shipped_database as shipped_database
from seacrane.hydro.readers.load import load_database as load_database
from seacrane._core import Curve as Curve
from seacrane._core import Frame as Frame
from seacrane._core import Point as Point
from seacrane.sea.systems import SeaState as SeaState
from seacrane.sea.systems import WaveSystem as WaveSystem
from seacrane.scene.wind_current import FlowCoefficients as FlowCoefficients
from seacrane.scene.motion_history import MotionHistory as MotionHistory
from seacrane.hydro.data.motion_raos import MotionRaos as MotionRaos
from seacrane import scene as scene
from seacrane import crane as crane
from seacrane import hydro as hydro
from seacrane import sea as sea
from seacrane import cases as cases

# Run it
from seacrane.simulation import simulate as simulate
from seacrane.run.run import Run as Run
from seacrane.run.method import Method as Method
from seacrane.run.outputs import Outputs as Outputs
from seacrane.run.sampled_controller import SampledController as SampledController
from seacrane._core import Model as Model
from seacrane._core import State as State
from seacrane._core import integrator_names as integrator_names
from seacrane import run as run

# Run it in stages
from seacrane.run.stage import Stage as Stage
from seacrane.run.commands import Move as Move
from seacrane.run.stage import Until as Until

# Look at what came of it
from seacrane.result.result import Result as Result
from seacrane.answers.summary import summary as summary
from seacrane.answers.report import report as report
from seacrane.pictures.plots import plot_overview as plot_overview
from seacrane.pictures.view import view as view
from seacrane import result as result
from seacrane import pictures as pictures

# Rest, statics, linear theory
from seacrane.analysis.rest_state import equilibrium as equilibrium
from seacrane.analysis.weight_balance import balance as balance
from seacrane.answers.statics import statics as statics
from seacrane.answers.load_chart import load_chart as load_chart
from seacrane.analysis.modal_analysis import natural_modes as natural_modes
from seacrane.analysis.linear_system import linear_model as linear_model
from seacrane.analysis.frequency_domain import motion_rao as motion_rao
from seacrane.analysis.response_statistics import response_statistics as response_statistics
from seacrane import answers as answers
from seacrane import analysis as analysis

# Many runs and what they say together
from seacrane.ensembles.ensemble import ensemble as ensemble
from seacrane.ensembles.kept import Kept as Kept
from seacrane.statistics.of_results import extremes as extremes
from seacrane import ensembles as ensembles
from seacrane import statistics as statistics

# Which seas a lift may go ahead in
from seacrane.operability.allowable import allowable_hs as allowable_hs
from seacrane.operability.criterion import Criterion as Criterion
from seacrane.operability.availability import availability as availability
from seacrane.operability.windows import weather_windows as weather_windows
from seacrane import operability as operability

# What settings cost and what error they bring
from seacrane.accuracy.trade_study import trade as trade
from seacrane.accuracy.step_error import step_error as step_error
from seacrane.answers.required import required as required
from seacrane import accuracy as accuracy

# What went wrong
from seacrane.errors import SeacraneError as SeacraneError
from seacrane.errors import SceneError as SceneError
from seacrane.errors import SimulationError as SimulationError
from seacrane.errors import FileFormatError as FileFormatError
from seacrane.version import __version__ as __version__
from seacrane import errors as errors
from seacrane import warnings as warnings
