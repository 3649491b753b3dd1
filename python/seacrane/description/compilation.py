"""A description compiled into the core's model."""

from __future__ import annotations

import warnings

from seacrane import _core
from seacrane.description.assembled import warn_of_moves
from seacrane.description.description import Description
from seacrane.description.holding import with_holds
from seacrane.description.loads import lines_of, refuse_heavy_winch
from seacrane.description.rungs import compiled_loads
from seacrane.description.wave_loads import compiled_waves
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import name_of, number_of, text_of


def compile_scene(scene: Description, *, merge: bool = True) -> _core.Model:
    """What `Scene.compile` does, without its look at what capsizes; its docstring says what is raised."""
    scene = with_holds(scene)
    for line in lines_of(scene.loads).values():
        if line.winch:
            refuse_heavy_winch(line)
    model = _core.compile(
        name=name_of("scene", scene.name),
        gravity=number_of(f"scene {scene.name!r}: gravity", scene.gravity),
        orientation=text_of(f"scene {scene.name!r}: orientation", scene.orientation),
        baumgarte=number_of(f"scene {scene.name!r}: baumgarte", scene.baumgarte),
        length_scale=number_of(f"scene {scene.name!r}: length_scale", scene.length_scale),
        bodies=list(scene.bodies.values()),
        joints=list(scene.joints.values()),
        drivers=list(scene.drivers.values()),
        loads=compiled_loads(scene.all_loads()),
        vessels=list(scene.vessels.values()),
        wave_loads=[] if scene.waves is None else compiled_waves(scene.waves, prune=merge),
        coordinates=[(name, *place) for name, place in scene.recorded.items()],
        points=list(scene.points.values()),
        merge=merge,
    )
    warn_of_moves(scene, model)
    if model.redundant:
        warn_caller(
            f"scene {scene.name!r}: constraints of {', '.join(model.redundant)} are redundant "
            f"({model.constraints - model.assembly['rank']} more than needed); motion is unique, these "
            "reactions are not: the minimum-norm ones are given",
            UserWarning,
        )
    model.compiled_from = (scene.copy(), merge)
    return model


def compiled_in_sea(scene: Description, model: _core.Model) -> _core.Model:
    """The model of a scene, from that of the same scene in another sea: nothing but the sea is compiled.

    The scene belongs to the model from now on: it is not to be changed.

    Raises
    ------
    SceneError
        For a sea on other vessels than the model's, or loads at another kind of position.
    """
    assert scene.waves is not None
    _, merge = model.compiled_from
    out = model.in_sea(compiled_waves(scene.waves, prune=merge))
    out.compiled_from = (scene, merge)
    return out


def compiled(scene: Description, merge: bool) -> _core.Model:
    """The model of a scene: how a pickled model comes back."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # given when it was compiled first
        return compile_scene(scene, merge=merge)
