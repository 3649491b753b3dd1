"""Rest, statics, inverse dynamics and linear theory of a scene."""

from seacrane.analysis.rest_state import equilibrium as equilibrium
from seacrane.analysis.weight_balance import balance as balance
from seacrane.analysis.weight_balance import Balance as Balance
from seacrane.analysis.modal_analysis import natural_modes as natural_modes
from seacrane.analysis.modal_analysis import NaturalModes as NaturalModes
from seacrane.analysis.linear_system import linear_model as linear_model
from seacrane.analysis.linear_system import LinearModel as LinearModel
from seacrane.analysis.frequency_domain import motion_rao as motion_rao
from seacrane.analysis.response_statistics import response_statistics as response_statistics
from seacrane.analysis.response_statistics import ResponseStatistics as ResponseStatistics
from seacrane.analysis.drag_in_sea import drag_in_sea as drag_in_sea
from seacrane.analysis.frequency_domain import response_summed as response_summed
from seacrane.analysis.frequency_domain import SummedResponse as SummedResponse
from seacrane.analysis.inverse import inverse_dynamics as inverse_dynamics
from seacrane.analysis.inverse import driven as driven
from seacrane.analysis.quasi_static import feed_forward as feed_forward
from seacrane.analysis.quasi_static import quasi_static_loads as quasi_static_loads
from seacrane.analysis.inverse import reflected_inertia as reflected_inertia
from seacrane._core import Evaluator as Evaluator
from seacrane.analysis.linearise import jacobian as jacobian
from seacrane.analysis.linearise import fastest_mode as fastest_mode
