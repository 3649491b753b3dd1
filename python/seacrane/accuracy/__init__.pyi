"""The error of a run: what it is measured in, how it is estimated, and methods chosen by it."""

from seacrane.accuracy.trade_study import trade as trade
from seacrane.accuracy.trade_answer import Trade as Trade
from seacrane.accuracy.step_error import step_error as step_error
from seacrane.accuracy.step_error import StepError as StepError
from seacrane.accuracy.model_error import model_error as model_error
