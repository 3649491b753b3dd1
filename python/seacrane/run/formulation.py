"""The formulation that a method steps a scene in, and what a method asks of the scene."""

from __future__ import annotations

from seacrane import _core
from seacrane._core import Integrator, integrator
from seacrane.errors import SceneError
from seacrane.run.method import Method
from seacrane.scene.scene import Scene

BAUMGARTE = 5.0  # 1/s: of methods that cannot project, where the scene names none
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


def stepped(scene: Scene, model: _core.Model | None, method: Method) -> tuple[Scene, _core.Model, str]:
    """The scene, its compiled model and the formulation that a run with this method steps.

    The scene is another one, stabilised by Baumgarte's method, where its joints have to be kept by an
    integrator that cannot project.

    Raises SceneError for a combination that does not exist.
    """
    model = scene.compile() if model is None else model
    known = integrator(method.integrator)
    formulation = _formulation(model, method, known)
    if not known.projects and formulation == "redundant" and scene.baumgarte == 0.0 and scene.joints:
        scene = scene.copy(baumgarte=BAUMGARTE)
        model = scene.compile()
    if known.name == SOLVES_FOR_MULTIPLIERS:
        _refuse_redundant_joints(model)
    return scene, model, formulation


def _formulation(model: _core.Model, method: Method, known: Integrator) -> str:
    """The formulation to step; SceneError where the recursive one is asked for and does not exist."""
    reason = _redundant_because(model, known)
    if method.formulation == "recursive" and reason:
        raise SceneError(f"formulation 'recursive' is not available here: {reason}; choose 'redundant'")
    if method.formulation != "auto":
        return method.formulation
    if reason:
        return "redundant"
    return "recursive" if model.tree["loop_rows"] == 0 or recursive_pays(model) else "redundant"


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
    if not known.projects and (model.tree["loop_rows"] or model.limits):
        return f"integrator {known.name!r} cannot project, and this scene keeps constraints or limits"
    if model.tree["speeds"] == 0:
        return "the joints and drivers of this scene leave nothing to move"
    return None


def _refuse_redundant_joints(model: _core.Model) -> None:
    """SceneError where joints that are stepped depend on each other: each multiplier is solved for."""
    joints = ", ".join(name for name in model.redundant if name not in model.merge["dropped"])
    if joints:
        raise SceneError(
            f"integrator {SOLVES_FOR_MULTIPLIERS!r} is not available here: the joints {joints} are "
            "redundant, and it solves for every reaction; give one of them more freedom, or choose a method "
            "that projects, as 'cvode-bdf' does"
        )


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
