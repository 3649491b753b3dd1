"""Offshore crane, payload and vessel moving together in waves.

Describe a `Scene`, `simulate` it, look at the `Result`. SI units, radians; x forward, y to port, z up.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from seacrane import errors

if TYPE_CHECKING:
    from seacrane import cases, crane, hydro, sea
    from seacrane._core import (
        Curve,
        Evaluator,
        FlowForce,
        Frame,
        Friction,
        Limit,
        Model,
        RetardationFunctions,
        SoftStop,
        State,
        StateSpaceBlock,
        TwistHistory,
        VesselHydrodynamics,
        integrator_names,
    )
    from seacrane.accuracy.step_error import StepError, step_error
    from seacrane.analysis.frequency_domain import (
        ResponseStatistics,
        SummedResponse,
        motion_rao,
        response_statistics,
        response_summed,
    )
    from seacrane.analysis.inverse import Balance, balance, driven, inverse_dynamics, reflected_inertia
    from seacrane.analysis.linear_system import LinearModel, linear_model
    from seacrane.analysis.linearise import fastest_mode, jacobian
    from seacrane.analysis.modal_analysis import NaturalModes, natural_modes
    from seacrane.analysis.quasi_static import feed_forward, quasi_static_loads
    from seacrane.analysis.rest_state import equilibrium
    from seacrane.description.assembled import AssemblyWarning
    from seacrane.description.curves import spline_curve
    from seacrane.description.provenance import SeaProvenance, VesselProvenance
    from seacrane.description.references import DriverImpulseWarning
    from seacrane.description.roles import CraneRoles
    from seacrane.description.waves import ByHeading, HullLoads, RepeatingSeaWarning, Waves
    from seacrane.errors import ChatteringError, FileFormatError, SceneError, SeacraneError, SimulationError
    from seacrane.hydro import HydroDatabase, load_database
    from seacrane.result import Event, Result
    from seacrane.run.method import Method
    from seacrane.run.output_times import OutputMemoryError
    from seacrane.run.outputs import Outputs
    from seacrane.run.run import Run
    from seacrane.run.sampled_controller import SampledController
    from seacrane.run.stiffness import StiffWarning
    from seacrane.run.to_file import StreamedResult, simulate_to_file
    from seacrane.scene.gusts import gust_curve
    from seacrane.scene.scene import Scene
    from seacrane.scene.sea import WavesWithoutLoadWarning
    from seacrane.scene.wind_current import DoubleCountedDampingWarning, FlowCoefficients
    from seacrane.sea import SeaState, WaveSystem
    from seacrane.simulation import simulate
    from seacrane.trading import Trade, trade
    from seacrane.validity.following import FullTurnWarning, OutsideRangeWarning, SoftGainsWarning
    from seacrane.validity.hull_range import (
        ForwardSpeedWarning,
        MeanHeadingWarning,
        MeanPositionWarning,
        MooringTurnWarning,
        NoWaveLoadsWarning,
    )
    from seacrane.validity.plausible import (
        AngleUnitWarning,
        BallastWarning,
        CompassDirectionWarning,
        DepthSignWarning,
        MassUnitWarning,
    )
    from seacrane.validity.range import (
        LargeHeelWarning,
        NearSingularWarning,
        OutsideDatabaseWarning,
        PushingLinkWarning,
    )
    from seacrane.version import __version__

_HOME = {
    "AngleUnitWarning": "validity.plausible",
    "AssemblyWarning": "description.assembled",
    "Balance": "analysis.inverse",
    "BallastWarning": "validity.plausible",
    "ByHeading": "description.waves",
    "ChatteringError": "errors",
    "CompassDirectionWarning": "validity.plausible",
    "CraneRoles": "description.roles",
    "Curve": "_core",
    "DepthSignWarning": "validity.plausible",
    "DoubleCountedDampingWarning": "scene.wind_current",
    "DriverImpulseWarning": "description.references",
    "Evaluator": "_core",
    "Event": "result",
    "FileFormatError": "errors",
    "FlowCoefficients": "scene.wind_current",
    "FlowForce": "_core",
    "ForwardSpeedWarning": "validity.hull_range",
    "Frame": "_core",
    "Friction": "_core",
    "FullTurnWarning": "validity.following",
    "HullLoads": "description.waves",
    "HydroDatabase": "hydro",
    "LargeHeelWarning": "validity.range",
    "Limit": "_core",
    "LinearModel": "analysis.linear_system",
    "MassUnitWarning": "validity.plausible",
    "MeanHeadingWarning": "validity.hull_range",
    "MeanPositionWarning": "validity.hull_range",
    "Method": "run.method",
    "Model": "_core",
    "MooringTurnWarning": "validity.hull_range",
    "NaturalModes": "analysis.modal_analysis",
    "NearSingularWarning": "validity.range",
    "NoWaveLoadsWarning": "validity.hull_range",
    "OutputMemoryError": "run.output_times",
    "Outputs": "run.outputs",
    "OutsideDatabaseWarning": "validity.range",
    "OutsideRangeWarning": "validity.following",
    "PushingLinkWarning": "validity.range",
    "RepeatingSeaWarning": "description.waves",
    "ResponseStatistics": "analysis.frequency_domain",
    "Result": "result",
    "RetardationFunctions": "_core",
    "Run": "run.run",
    "SampledController": "run.sampled_controller",
    "Scene": "scene.scene",
    "SceneError": "errors",
    "SeaProvenance": "description.provenance",
    "SeaState": "sea",
    "SeacraneError": "errors",
    "SimulationError": "errors",
    "SoftGainsWarning": "validity.following",
    "SoftStop": "_core",
    "State": "_core",
    "StateSpaceBlock": "_core",
    "StepError": "accuracy.step_error",
    "StiffWarning": "run.stiffness",
    "StreamedResult": "run.to_file",
    "SummedResponse": "analysis.frequency_domain",
    "Trade": "trading",
    "TwistHistory": "_core",
    "VesselHydrodynamics": "_core",
    "VesselProvenance": "description.provenance",
    "WaveSystem": "sea",
    "Waves": "description.waves",
    "WavesWithoutLoadWarning": "scene.sea",
    "__version__": "version",
    "balance": "analysis.inverse",
    "driven": "analysis.inverse",
    "equilibrium": "analysis.rest_state",
    "fastest_mode": "analysis.linearise",
    "feed_forward": "analysis.quasi_static",
    "gust_curve": "scene.gusts",
    "integrator_names": "_core",
    "inverse_dynamics": "analysis.inverse",
    "jacobian": "analysis.linearise",
    "linear_model": "analysis.linear_system",
    "load_database": "hydro",
    "motion_rao": "analysis.frequency_domain",
    "natural_modes": "analysis.modal_analysis",
    "quasi_static_loads": "analysis.quasi_static",
    "reflected_inertia": "analysis.inverse",
    "response_statistics": "analysis.frequency_domain",
    "response_summed": "analysis.frequency_domain",
    "simulate": "simulation",
    "simulate_to_file": "run.to_file",
    "spline_curve": "description.curves",
    "step_error": "accuracy.step_error",
    "trade": "trading",
}
_MODULES = ("cases", "crane", "hydro", "sea")

__all__ = [
    "AngleUnitWarning",
    "AssemblyWarning",
    "Balance",
    "BallastWarning",
    "ByHeading",
    "ChatteringError",
    "CompassDirectionWarning",
    "CraneRoles",
    "Curve",
    "DepthSignWarning",
    "DoubleCountedDampingWarning",
    "DriverImpulseWarning",
    "Evaluator",
    "Event",
    "FileFormatError",
    "FlowCoefficients",
    "FlowForce",
    "ForwardSpeedWarning",
    "Frame",
    "Friction",
    "FullTurnWarning",
    "HullLoads",
    "HydroDatabase",
    "LargeHeelWarning",
    "Limit",
    "LinearModel",
    "MassUnitWarning",
    "MeanHeadingWarning",
    "MeanPositionWarning",
    "Method",
    "Model",
    "MooringTurnWarning",
    "NaturalModes",
    "NearSingularWarning",
    "NoWaveLoadsWarning",
    "OutputMemoryError",
    "Outputs",
    "OutsideDatabaseWarning",
    "OutsideRangeWarning",
    "PushingLinkWarning",
    "RepeatingSeaWarning",
    "ResponseStatistics",
    "Result",
    "RetardationFunctions",
    "Run",
    "SampledController",
    "Scene",
    "SceneError",
    "SeaProvenance",
    "SeaState",
    "SeacraneError",
    "SimulationError",
    "SoftGainsWarning",
    "SoftStop",
    "State",
    "StateSpaceBlock",
    "StepError",
    "StiffWarning",
    "StreamedResult",
    "SummedResponse",
    "Trade",
    "TwistHistory",
    "VesselHydrodynamics",
    "VesselProvenance",
    "WaveSystem",
    "Waves",
    "WavesWithoutLoadWarning",
    "__version__",
    "balance",
    "cases",
    "crane",
    "driven",
    "equilibrium",
    "errors",
    "fastest_mode",
    "feed_forward",
    "gust_curve",
    "hydro",
    "integrator_names",
    "inverse_dynamics",
    "jacobian",
    "linear_model",
    "load_database",
    "motion_rao",
    "natural_modes",
    "quasi_static_loads",
    "reflected_inertia",
    "response_statistics",
    "response_summed",
    "sea",
    "simulate",
    "simulate_to_file",
    "spline_curve",
    "step_error",
    "trade",
]


def __getattr__(name: str) -> Any:
    """Names are imported when they are used, so that `import seacrane` stays fast."""
    if name in _HOME:
        value = getattr(import_module(f"seacrane.{_HOME[name]}"), name)
    elif name in _MODULES:
        value = import_module(f"seacrane.{name}")
    else:
        raise AttributeError(f"module 'seacrane' has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
