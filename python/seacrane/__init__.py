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
        Frame,
        Model,
        State,
        StateSpaceBlock,
        VesselHydrodynamics,
        integrator_names,
    )
    from seacrane.curves import spline_curve
    from seacrane.errors import FileFormatError, SceneError, SeacraneError, SimulationError
    from seacrane.frequency_domain import (
        ResponseStatistics,
        SummedResponse,
        motion_rao,
        response_statistics,
        response_summed,
    )
    from seacrane.hydro import HydroDatabase, load_database
    from seacrane.inverse import Balance, balance, driven, inverse_dynamics, reflected_inertia
    from seacrane.linear_system import LinearModel, linear_model
    from seacrane.linearise import fastest_mode, jacobian
    from seacrane.modal_analysis import NaturalModes, natural_modes
    from seacrane.rest_state import equilibrium
    from seacrane.result import Result
    from seacrane.scene import Scene
    from seacrane.simulation import Run, SampledController, simulate
    from seacrane.version import __version__
    from seacrane.vessel import add_sea, add_vessel
    from seacrane.waves import Waves

_HOME = {
    "Balance": "inverse",
    "Curve": "_core",
    "Evaluator": "_core",
    "FileFormatError": "errors",
    "Frame": "_core",
    "HydroDatabase": "hydro",
    "LinearModel": "linear_system",
    "Model": "_core",
    "NaturalModes": "modal_analysis",
    "ResponseStatistics": "frequency_domain",
    "Result": "result",
    "Run": "simulation",
    "SampledController": "simulation",
    "Scene": "scene",
    "SceneError": "errors",
    "SeacraneError": "errors",
    "SimulationError": "errors",
    "State": "_core",
    "StateSpaceBlock": "_core",
    "SummedResponse": "frequency_domain",
    "VesselHydrodynamics": "_core",
    "Waves": "waves",
    "__version__": "version",
    "add_sea": "vessel",
    "add_vessel": "vessel",
    "balance": "inverse",
    "driven": "inverse",
    "equilibrium": "rest_state",
    "fastest_mode": "linearise",
    "integrator_names": "_core",
    "inverse_dynamics": "inverse",
    "jacobian": "linearise",
    "linear_model": "linear_system",
    "load_database": "hydro",
    "motion_rao": "frequency_domain",
    "natural_modes": "modal_analysis",
    "reflected_inertia": "inverse",
    "response_statistics": "frequency_domain",
    "response_summed": "frequency_domain",
    "simulate": "simulation",
    "spline_curve": "curves",
}
_MODULES = ("cases", "crane", "hydro", "sea")

__all__ = [
    "Balance",
    "Curve",
    "Evaluator",
    "FileFormatError",
    "Frame",
    "HydroDatabase",
    "LinearModel",
    "Model",
    "NaturalModes",
    "ResponseStatistics",
    "Result",
    "Run",
    "SampledController",
    "Scene",
    "SceneError",
    "SeacraneError",
    "SimulationError",
    "State",
    "StateSpaceBlock",
    "SummedResponse",
    "VesselHydrodynamics",
    "Waves",
    "__version__",
    "add_sea",
    "add_vessel",
    "balance",
    "cases",
    "crane",
    "driven",
    "equilibrium",
    "errors",
    "fastest_mode",
    "hydro",
    "integrator_names",
    "inverse_dynamics",
    "jacobian",
    "linear_model",
    "load_database",
    "motion_rao",
    "natural_modes",
    "reflected_inertia",
    "response_statistics",
    "response_summed",
    "sea",
    "simulate",
    "spline_curve",
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
