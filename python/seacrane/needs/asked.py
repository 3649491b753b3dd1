"""What is asked of a scene: numbers by name, with their units."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from seacrane.description.channels import unit_of
from seacrane.description.given import given_vessels
from seacrane.description.suspension import hung_loads
from seacrane.ensembles.kept import Kept
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.scene.scene import Scene

Ask = Callable[[Any], float]


def usual(scene: Scene) -> dict[str, Any]:
    """The peak of each hook load, the heave of each load and the roll of a vessel."""
    out: dict[str, Any] = {}
    for hung in hung_loads(scene):
        one = hung.suspension
        if one.channel == one.name:
            out[f"hook_load[{one.name}].max"] = f"hook_load[{one.name}].max"
        else:
            out[f"hook load of {one.name}, N"] = partial(_lower_end, load=hung.load)
        out[f"position[{hung.load}, z].std"] = f"position[{hung.load}, z].std"
    if len(scene.vessels) == 1 and not given_vessels(scene):
        out["roll.std"] = "roll.std"
    return out


def _lower_end(result: Any, load: str) -> float:
    """The peak at the lower end of a line with mass, in however many segments."""
    names = [hung.suspension.channel for hung in hung_loads(result.scene) if hung.load == load]
    text = f"hook_load[{names[0]}].max"
    return _single(text, Kept.of_text(text))(result)


def asked(scene: Scene, keep: Mapping[str, Any] | None) -> Mapping[str, Any]:
    """What is asked, or the usual; SceneError where there is none."""
    found = usual(scene) if keep is None else keep
    if keep is None and not found:
        raise SceneError(
            f'required: nothing hangs or floats in scene {scene.name!r}; give keep={{"z": '
            '"position[<body>, z].max"}'
        )
    return found


def asked_of(keep: Mapping[str, Any]) -> tuple[dict[str, Ask], dict[str, str]]:
    """The functions that give the numbers, and their units, by name."""
    if not isinstance(keep, Mapping) or not keep:
        raise SceneError(f'required: keep is {shown(keep)}; give {{"peak": "hook_load.max"}}')
    asks, units = {}, {}
    for name, what in keep.items():
        kept = Kept.of_text(what) if isinstance(what, str) else what
        if isinstance(kept, Kept):
            if kept.what == "series":
                raise SceneError(
                    f"required: {name!r} is a series; ask for one number of it, such as its .max"
                )
            asks[name], units[name] = _single(name, kept), unit_of(kept.channel, kept.names.values())
        elif callable(kept):
            asks[name], units[name] = kept, ""
        else:
            raise SceneError(f'required: {name!r} is {shown(what)}; give a text such as "hook_load.max"')
    return asks, units


def _single(name: str, kept: Kept) -> Ask:
    def ask(result: Any) -> float:
        found = kept.of(result)
        values = found.values
        if values.size != 1:
            names = ", ".join(str(one) for along in found.coords.values() for one in along)
            raise SceneError(
                f"required: {name!r} is {values.size} numbers of a run, of {names}; ask for one of them"
            )
        return float(values.reshape(-1)[0])

    return ask
