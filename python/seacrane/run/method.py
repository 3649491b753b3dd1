"""How a scene is stepped: Method, words of a call that stand for it and for Outputs, formulation, start."""

from __future__ import annotations

import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal, TypeAlias, TypedDict

from seacrane import _core
from seacrane._core import Integrator, integrator
from seacrane.analysis.rest_state import equilibrium
from seacrane.errors import KeywordError, SceneError
from seacrane.inputs.checked import number_of
from seacrane.inputs.keywords import named, no_keyword
from seacrane.inputs.shown import shown
from seacrane.run.outputs import Outputs
from seacrane.scene.scene import Scene

DEFAULT_INTEGRATOR, DEFAULT_TOLERANCE = "dopri5", 1e-6
LARGEST_TOLERANCE = 0.1
FORMULATIONS = ("auto", "recursive", "redundant")
REST: Literal["rest"] = "rest"
Start: TypeAlias = _core.State | Literal["rest"] | None
BOUNDS = {  # of what is above zero: the largest value, the unit, the fix
    "rtol": (LARGEST_TOLERANCE, "", "give a positive number up to 0.1, e.g. 1e-6"),
    "dt": (sys.float_info.max, " s", "give a finite positive number, or leave it out"),
    "maximum_step": (sys.float_info.max, " s", "give a finite positive number, or leave it out"),
    "spectral_radius": None,
    "energy_limit": (math.inf, "", "give a positive number, such as 1e-3"),
}
SOLVES_FOR_MULTIPLIERS = "ida"
# Multiplications, each about as many as a count of the loops of the core gives.
PER_BODY = 2000.0  # kinematics, inertia and loads, in either form
PER_RESPONSE = 150.0  # of one body to one row of a loop
EIGENVECTORS = 9.0  # times the rows cubed, where rows depend on each other
FEW_ROWS = 12  # of loops, up to which the core takes them densely
LOST_DIGITS = 1e5  # S_ii / d_i beyond which the redundant form is solved by a dense LU, as in the core
# An evaluation of the redundant form must be this much dearer before it is left: where a mechanism folds, it
# can take a hundred times fewer steps.
MARGIN = 50.0


@named
@dataclass(frozen=True, kw_only=True)
class Method:
    """How a scene is stepped: integrator, tolerance or step, formulation. What is None is the default.

    Attributes
    ----------
    integrator : str
        One of `seacrane.integrator_names()`; docs/integrators.md says what each is for.
    rtol : float, optional
        Local error per step over the scale of each state (0.1 m, 0.01 rad, 0.1 m/s, 0.01 rad/s; lengths
        times `scene.length_scale`): absolute, so that results do not depend on where the origin is. Methods
        of fixed step take it where they iterate, and to tell which kinks of curves end a step. Default 1e-6.
    dt : float, optional
        Step of fixed-step methods, s; default: the method's own.
    formulation : str
        "redundant": six velocities per body and multipliers, the paper's. "recursive": the same motion in
        the coordinates of a tree of bodies, cylinder loops in closed form, other loops by a small block of
        constraints; several times faster. "auto" (default) takes it where it leaves no constraints, or where
        the redundant one would be solved densely at far more cost, and the integrator allows.
    maximum_step : float, optional
        Longest step, s; default: no limit.
    spectral_radius : float, optional
        What is left after a step of "generalized-alpha" of a motion far too fast for it: 1 damps nothing, 0
        all in one step; default 0.8. Other integrators have none.
    energy_limit : float, optional
        Stops the run at the first output where `energy_balance` exceeds this share of the absolute work and
        the largest kinetic energy until then; default: never. Not for the paper's kinematics.

    Raises
    ------
    SceneError
        For a value that makes no sense, by its name.
    """

    integrator: str = DEFAULT_INTEGRATOR
    rtol: float | None = None
    dt: float | None = None
    formulation: str = "auto"
    maximum_step: float | None = None
    spectral_radius: float | None = None
    energy_limit: float | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.integrator, str):
            names = ", ".join(_core.integrator_names())
            raise SceneError(f"integrator is {self.integrator!r}; choose one of {names}")
        if self.formulation not in FORMULATIONS:
            raise SceneError(f"formulation {self.formulation!r} is unknown; choose {', '.join(FORMULATIONS)}")
        for name, bound in BOUNDS.items():
            if getattr(self, name) is None:
                continue
            value = number_of(name, getattr(self, name))
            if bound and not 0.0 < value <= bound[0]:
                raise SceneError(f"{name} is {value:g}{bound[1]}; {bound[2]}")
            object.__setattr__(self, name, value)

    @property
    def used_rtol(self) -> float:
        """The tolerance, or the default one."""
        return DEFAULT_TOLERANCE if self.rtol is None else self.rtol

    @property
    def setting(self) -> str:
        """The step and the tolerance that were given, in words."""
        given = (("dt", self.dt), ("rtol", self.rtol))
        return " ".join(f"{word}={value:g}" for word, value in given if value is not None)

    @property
    def name(self) -> str:
        """Formulation, integrator and setting, in words."""
        return " ".join(part for part in (self.formulation, self.integrator, self.setting) if part)


class Shorthand(TypedDict, total=False):
    """Each as the attribute of `Method` or `Outputs` that it stands for; None: not given."""

    integrator: str | None
    rtol: float | None
    dt: float | None
    formulation: str | None
    maximum_step: float | None
    spectral_radius: float | None
    energy_limit: float | None
    dt_out: float | None
    channels: Sequence[str] | None


METHOD_WORDS = tuple(Method.__dataclass_fields__)
OUTPUT_WORDS = tuple(Outputs.__dataclass_fields__)


def settled(
    method: Method | None, outputs: Outputs | None, shorthand: Mapping[str, Any]
) -> tuple[Method, Outputs]:
    """The method and the outputs of a call: the objects given, or those that the shorthand makes.

    Raises
    ------
    SceneError
        For an object of another type, a value that makes no sense, or a word beside the object that it
        contradicts.
    KeywordError
        For a word that is none.
    """
    for word in shorthand:
        if word not in METHOD_WORDS and word not in OUTPUT_WORDS:
            known = ["method", "outputs", *METHOD_WORDS, *OUTPUT_WORDS]
            error = KeywordError(f"settings: {no_keyword(word, shorthand[word], known)}")
            error.known = (*METHOD_WORDS, *OUTPUT_WORDS)
            raise error
    kinds: dict[str, tuple[Any, Any]] = {"method": (Method, method), "outputs": (Outputs, outputs)}
    for name, (kind, given) in kinds.items():
        if given is not None and not isinstance(given, kind):
            raise SceneError(f"{name} is {given!r}; give a seacrane.{kind.__name__}")
    made = overridden(method, outputs, shorthand)
    for one, (name, (kind, given)) in zip(made, kinds.items(), strict=True):
        for word in () if given is None else kind.__dataclass_fields__:
            if getattr(one, word) != getattr(given, word):
                raise SceneError(
                    f"{word}={shorthand[word]!r} contradicts {name}, whose {word} is "
                    f"{getattr(given, word)!r}: leave {word} out, or change {name}"
                )
    return made


def overridden(
    method: Method | None, outputs: Outputs | None, shorthand: Mapping[str, Any]
) -> tuple[Method, Outputs]:
    """The objects, or defaults, with what the shorthand says in their place; raises SceneError."""
    given = {word: value for word, value in shorthand.items() if value is not None}
    how = {word: given[word] for word in METHOD_WORDS if word in given}
    what = {word: given[word] for word in OUTPUT_WORDS if word in given}
    return replace(method or Method(), **how), replace(outputs or Outputs(), **what)


def start_state(scene: Scene, start: Any, *, time: float = 0.0) -> _core.State | None:
    """The state that is meant; None for the assembled start.

    Raises SceneError for something else, and where the scene has no state at rest.
    """
    if start is None or isinstance(start, _core.State):
        return start
    if isinstance(start, str) and start == REST:
        return equilibrium(scene, time=time)
    raise SceneError(f"start is {shown(start)}; give a seacrane.State, or {REST!r} for the state at rest")


def formulation_of(model: _core.Model, method: Method) -> str:
    """The formulation that a run with this method steps; SceneError for a combination that does not exist."""
    known, formulation = integrator(method.integrator), method.formulation
    reason = _redundant_because(model, known)
    if formulation == "recursive" and reason:
        raise SceneError(f"formulation 'recursive' is not available here: {reason}; choose 'redundant'")
    if formulation == "auto":
        pays = not reason and (model.tree["loop_rows"] == 0 or recursive_pays(model))
        formulation = "recursive" if pays else "redundant"
    dependent = model.redundant if known.name == SOLVES_FOR_MULTIPLIERS else ()
    joints = ", ".join(name for name in dependent if name not in model.merge["dropped"])
    if joints:
        raise SceneError(
            f"integrator {SOLVES_FOR_MULTIPLIERS!r} is not available here: the joints {joints} are "
            "redundant, and it solves for every reaction; give one of them more freedom, or choose "
            "'cvode-bdf', which projects"
        )
    return formulation


def _redundant_because(model: _core.Model, known: Integrator) -> str | None:
    """Why only the redundant formulation will do; None where both will."""
    if known.residual_form:
        return f"integrator {known.name!r} solves the redundant equations"
    if model.paper_kinematics:
        return "kinematics 'paper' has no symmetric mass matrix"
    if model.baumgarte > 0.0:
        return "Baumgarte stabilisation belongs to the redundant equations"
    if model.tree["refused"]:
        return str(model.tree["refused"])
    if model.euler_angles:
        return "orientation 'euler_xyz' is a choice of the redundant state"
    if model.tree["speeds"] == 0:
        return "the joints and drivers of this scene leave nothing to move"
    return None


def recursive_pays(model: _core.Model) -> bool:
    """Whether the redundant form would be solved densely and the recursive one costs far less.

    Dense: constraints that depend on each other, or masses so different that the sparse factors lose their
    digits. One such joint makes all of the scene dense, so a chain pays for a door on two hinges beside it;
    the recursive form keeps its tree and solves the rows of its loops alone. Many rows are never dense: those
    that the others hold are left out.
    """
    dependent = model.assembly["rank"] < model.constraints
    if model.merge["left_out"] or not (dependent or model.assembly["condition"] > LOST_DIGITS):
        return False
    bodies, rows = model.merge["coordinates"] / 6.0, float(model.merge["constraints"])
    loops = float(model.tree["loop_rows"])
    unknowns = 6.0 * bodies + rows
    dense = PER_BODY * bodies + 2.0 / 3.0 * unknowns**3
    if dependent:
        dense += EIGENVECTORS * rows**3
    if loops > FEW_ROWS and model.tree["loop_trees"] > 1:  # sparse: a row feels two trees
        tree = PER_BODY * bodies + PER_RESPONSE * loops * 2.0 * bodies / model.tree["loop_trees"]
    else:
        tree = PER_BODY * bodies + PER_RESPONSE * bodies * loops + loops**3 / 3.0
        if dependent:
            tree += PER_RESPONSE * bodies * loops + EIGENVECTORS * loops**3
    return bool(dense > MARGIN * tree)


def core_options(method: Method, formulation: str, **recorded: Any) -> _core.RunOptions:
    """The options of the core for a method; `recorded`: what it records and keeps, and when."""
    return _core.RunOptions(
        formulation=formulation, integrator=method.integrator, scaled_tolerance=method.used_rtol,
        fixed_step=method.dt, max_step=method.maximum_step, spectral_radius=method.spectral_radius,
        energy_limit=method.energy_limit, **recorded,
    )  # fmt: skip
