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
    from seacrane.assembled import AssemblyWarning
    from seacrane.curves import spline_curve
    from seacrane.environment import (
        DoubleCountedDampingWarning,
        FlowCoefficients,
        add_current,
        add_drift,
        add_wind,
        use_actual_position,
        use_slow_position,
    )
    from seacrane.errors import ChatteringError, FileFormatError, SceneError, SeacraneError, SimulationError
    from seacrane.following import FullTurnWarning, OutsideRangeWarning, SoftGainsWarning
    from seacrane.frequency_domain import (
        ResponseStatistics,
        SummedResponse,
        motion_rao,
        response_statistics,
        response_summed,
    )
    from seacrane.hull_range import (
        ForwardSpeedWarning,
        MeanHeadingWarning,
        MeanPositionWarning,
        MooringTurnWarning,
        NoWaveLoadsWarning,
    )
    from seacrane.hydro import HydroDatabase, load_database
    from seacrane.inverse import Balance, balance, driven, inverse_dynamics, reflected_inertia
    from seacrane.limits import add_end_stop, add_friction, add_seat, add_soft_stop, add_wire
    from seacrane.linear_system import LinearModel, linear_model
    from seacrane.linearise import fastest_mode, jacobian
    from seacrane.long_run import StreamedResult, simulate_to_file
    from seacrane.modal_analysis import NaturalModes, natural_modes
    from seacrane.output_times import OutputMemoryError
    from seacrane.plausible import (
        AngleUnitWarning,
        BallastWarning,
        CompassDirectionWarning,
        DepthSignWarning,
        MassUnitWarning,
    )
    from seacrane.quasi_static import feed_forward, quasi_static_loads
    from seacrane.references import DriverImpulseWarning
    from seacrane.rest_state import equilibrium
    from seacrane.result import Event, Result
    from seacrane.sampled_controller import SampledController
    from seacrane.scene import Scene
    from seacrane.sea import SeaState, WaveSystem
    from seacrane.sea_state import WavesWithoutLoadWarning, add_sea
    from seacrane.simulation import Run, simulate
    from seacrane.stiffness import StiffWarning
    from seacrane.trading import Trade, trade
    from seacrane.trading.fixed_step import StepError, step_error
    from seacrane.validity import (
        LargeHeelWarning,
        NearSingularWarning,
        OutsideDatabaseWarning,
        PushingLinkWarning,
    )
    from seacrane.version import __version__
    from seacrane.vessel import add_vessel
    from seacrane.waves import ByHeading, HullLoads, RepeatingSeaWarning, Waves
    from seacrane.wind import gust_curve

_HOME = {
    "AngleUnitWarning": "plausible",
    "AssemblyWarning": "assembled",
    "Balance": "inverse",
    "BallastWarning": "plausible",
    "ByHeading": "waves",
    "ChatteringError": "errors",
    "CompassDirectionWarning": "plausible",
    "Curve": "_core",
    "DepthSignWarning": "plausible",
    "DoubleCountedDampingWarning": "environment",
    "DriverImpulseWarning": "references",
    "Evaluator": "_core",
    "Event": "result",
    "FileFormatError": "errors",
    "FlowCoefficients": "environment",
    "FlowForce": "_core",
    "ForwardSpeedWarning": "hull_range",
    "Frame": "_core",
    "Friction": "_core",
    "FullTurnWarning": "following",
    "HullLoads": "waves",
    "HydroDatabase": "hydro",
    "LargeHeelWarning": "validity",
    "Limit": "_core",
    "LinearModel": "linear_system",
    "MassUnitWarning": "plausible",
    "MeanHeadingWarning": "hull_range",
    "MeanPositionWarning": "hull_range",
    "Model": "_core",
    "MooringTurnWarning": "hull_range",
    "NaturalModes": "modal_analysis",
    "NearSingularWarning": "validity",
    "NoWaveLoadsWarning": "hull_range",
    "OutputMemoryError": "output_times",
    "OutsideDatabaseWarning": "validity",
    "OutsideRangeWarning": "following",
    "PushingLinkWarning": "validity",
    "RepeatingSeaWarning": "waves",
    "ResponseStatistics": "frequency_domain",
    "Result": "result",
    "RetardationFunctions": "_core",
    "Run": "simulation",
    "SampledController": "sampled_controller",
    "Scene": "scene",
    "SceneError": "errors",
    "SeaState": "sea",
    "SeacraneError": "errors",
    "SimulationError": "errors",
    "SoftGainsWarning": "following",
    "SoftStop": "_core",
    "State": "_core",
    "StateSpaceBlock": "_core",
    "StepError": "trading.fixed_step",
    "StiffWarning": "stiffness",
    "StreamedResult": "long_run",
    "SummedResponse": "frequency_domain",
    "Trade": "trading",
    "TwistHistory": "_core",
    "VesselHydrodynamics": "_core",
    "WaveSystem": "sea",
    "Waves": "waves",
    "WavesWithoutLoadWarning": "sea_state",
    "__version__": "version",
    "add_current": "environment",
    "add_drift": "environment",
    "add_end_stop": "limits",
    "add_friction": "limits",
    "add_sea": "sea_state",
    "add_seat": "limits",
    "add_soft_stop": "limits",
    "add_vessel": "vessel",
    "add_wind": "environment",
    "add_wire": "limits",
    "balance": "inverse",
    "driven": "inverse",
    "equilibrium": "rest_state",
    "fastest_mode": "linearise",
    "feed_forward": "quasi_static",
    "gust_curve": "wind",
    "integrator_names": "_core",
    "inverse_dynamics": "inverse",
    "jacobian": "linearise",
    "linear_model": "linear_system",
    "load_database": "hydro",
    "motion_rao": "frequency_domain",
    "natural_modes": "modal_analysis",
    "quasi_static_loads": "quasi_static",
    "reflected_inertia": "inverse",
    "response_statistics": "frequency_domain",
    "response_summed": "frequency_domain",
    "simulate": "simulation",
    "simulate_to_file": "long_run",
    "spline_curve": "curves",
    "step_error": "trading.fixed_step",
    "trade": "trading",
    "use_actual_position": "environment",
    "use_slow_position": "environment",
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
    "Model",
    "MooringTurnWarning",
    "NaturalModes",
    "NearSingularWarning",
    "NoWaveLoadsWarning",
    "OutputMemoryError",
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
    "WaveSystem",
    "Waves",
    "WavesWithoutLoadWarning",
    "__version__",
    "add_current",
    "add_drift",
    "add_end_stop",
    "add_friction",
    "add_sea",
    "add_seat",
    "add_soft_stop",
    "add_vessel",
    "add_wind",
    "add_wire",
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
    "use_actual_position",
    "use_slow_position",
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
