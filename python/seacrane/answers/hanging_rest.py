"""What hangs in a scene at rest, off the decks that it stood on: static forces by the names of a summary."""

from __future__ import annotations

from seacrane.answers.rest_columns import AtRest, pulls_of
from seacrane.answers.statics import resting
from seacrane.description.description import Some
from seacrane.description.waves import calm_water
from seacrane.errors import SeacraneError
from seacrane.inputs.caller import silently
from seacrane.one_thread import one_thread
from seacrane.result import Result


def lifted(scene: Some) -> Some:
    """The scene without seats: what stands on a deck hangs on its lines."""
    seats = {name: load.joint for name, load in scene.loads.items() if getattr(load, "kind", "") == "seat"}
    return scene.copy(
        loads={name: load for name, load in scene.loads.items() if name not in seats},
        joints={name: joint for name, joint in scene.joints.items() if name not in seats.values()},
    )


@one_thread
def hanging_rest(scene: Some) -> AtRest:
    """Its state at rest with every load off its deck, calm and held as at the start; SceneError for none."""
    return next(resting(lifted(scene).copy(waves=calm_water(scene.waves)), None, [{}], None))


def static_pulls(result: Result) -> dict[str, float] | str:
    """Static load of each rod, wire and line, N, by the rows of a summary; or why none is known."""
    try:
        if result.scene is None:
            return {}
        with silently():  # the run told them
            return {name: value for name, (_, value) in pulls_of(hanging_rest(result.scene)).items()}
    except SeacraneError as error:
        return str(error)
