"""Choices about the sea and the hull in it: wave components, table, slow drift, fluid memory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from seacrane.accuracy.simpler_scenes import BOUND, SHARES, memory_name, strongest, with_memory
from seacrane.description.databases import source_of
from seacrane.description.given import given_vessels
from seacrane.description.wet_parts import immersed_parts
from seacrane.hydro import HydroDatabase
from seacrane.needs.choice import Choice
from seacrane.scene.scene import Scene
from seacrane.scene.sea import as_put

LOOSER = 0.05  # limit of a memory by motion


def fewer_waves(scene: Scene) -> Iterator[Choice]:
    """The strongest components alone."""
    waves = scene.waves
    if waves is None or not (waves.hulls or immersed_parts(scene)):
        return
    for share in SHARES:
        count = int(np.ceil(share * len(waves.omega)))
        if count < len(waves.omega):
            yield Choice(
                name=f"{count} of {len(waves.omega)} wave components",
                script=f"scene.waves = needs.strongest(scene.waves, {count})",
                made=partial(_in_fewer, count=count),
                of="wave components",
            )


def _in_fewer(scene: Scene, *, count: int) -> Scene:
    return scene.copy(waves=strongest(scene.waves, count))


def coarse_table(scene: Scene) -> Iterator[Choice]:
    """Loads of waves from a table with a wide bound, in place of a fine one or of the sum itself."""
    waves = scene.waves
    if waves is None or not waves.has_tables() or waves.evaluation == "fft":
        return
    if waves.evaluation == "exact" or waves.relative_bound < BOUND:
        changes = {"evaluation": "table", "relative_bound": BOUND}
        yield Choice(
            name=f"wave table within {BOUND:g}",
            script=f'scene.waves = dataclasses.replace(scene.waves, evaluation="table", '
            f"relative_bound={BOUND!r})",
            made=partial(_with_waves, changes=changes),
            of="wave table",
        )


def _with_waves(scene: Scene, *, changes: dict[str, Any]) -> Scene:
    return scene if scene.waves is None else scene.copy(waves=replace(scene.waves, **changes))


def no_drift(scene: Scene) -> Iterator[Choice]:
    """No slow drift of a vessel."""
    for body, hull in {} if scene.waves is None else scene.waves.hulls.items():
        if hull.drift is not None or hull.drift_by_heading is not None:
            yield Choice(
                name=f"no slow drift of {body}",
                script=f'scene.waves = scene.waves.changed("{body}", drift=None, drift_by_heading=None)',
                made=partial(_without_drift, body=body),
                of=f"slow drift of {body}",
            )


def _without_drift(scene: Scene, *, body: str) -> Scene:
    assert scene.waves is not None
    return scene.copy(waves=scene.waves.changed(body, drift=None, drift_by_heading=None))


def more_drift(scene: Scene) -> Iterator[Choice]:
    """The slow drift that a database has, and the scene leaves out."""
    for body, hull in {} if scene.waves is None else scene.waves.hulls.items():
        source = source_of(scene, body)
        if hull.drift is None and isinstance(source, HydroDatabase) and source.drift is not None:
            assert scene.waves is not None
            words = as_put(scene, scene.waves, body) | {"drift": True}
            words = {key: one for key, one in words.items() if one is not None}
            yield Choice(
                name=f"slow drift of {body}",
                script=f"scene.add_sea({', '.join(f'{key}={one!r}' for key, one in words.items())})",
                made=partial(_put_anew, words=words),
                of=f"slow drift of {body}",
            )


def _put_anew(scene: Scene, *, words: dict[str, Any]) -> Scene:
    out = scene.copy()
    out.add_sea(**words)
    return out


def less_memory(scene: Scene) -> Iterator[Choice]:
    """Fewer states of the fluid memory of the scene's one vessel, and none."""
    if not _one_vessel(scene) or memory_name(scene) == "none":
        return
    kind, known = memory_name(scene), _known(scene)
    if known and kind != "by-motion":
        yield _memory("by-motion")
    if known:
        yield _memory("by-motion", LOOSER)
    yield _memory("none")


def more_memory(scene: Scene) -> Iterator[Choice]:
    """A fluid memory where the scene has none."""
    if _one_vessel(scene) and memory_name(scene) == "none" and _known(scene):
        yield _memory("by-motion")


def no_coupling(scene: Scene) -> Iterator[Choice]:
    """Vessels of a group that do not feel each other's motions, each with a memory of its own."""
    for name, group in scene.groups.items():
        yield Choice(
            name=f"no coupling of {' and '.join(group.vessels)}",
            script=f'scene = needs.uncoupled(scene, "{name}")',
            made=partial(uncoupled, name=name),
            of=f"coupling of group {name}",
        )


def uncoupled(scene: Scene, name: str) -> Scene:
    """The scene whose vessels of a group move as if the others stood still; waves are those beside them."""
    if name not in scene.groups:
        return scene
    group = scene.groups[name]
    out = scene.copy()
    out.remove(name, kind="group")
    for vessel in group.vessels if len(group.memory) else ():
        out = with_memory(out, "by-motion", vessel=vessel)
    return out


def _memory(kind: str, level: float | None = None) -> Choice:
    name = "no fluid memory" if kind == "none" else f"fluid memory {kind}"
    more = "" if level is None else f", level={level:g}"
    return Choice(
        name=name if level is None else f"{name} within {100 * level:g} %",
        script=f'scene = needs.with_memory(scene, "{kind}"{more})',
        made=partial(with_memory, kind=kind, level=level),
        of="fluid memory",
    )


def _one_vessel(scene: Scene) -> bool:
    return len(scene.vessels) == 1 and not given_vessels(scene)


def _known(scene: Scene) -> bool:
    (vessel,) = scene.vessels.values()
    return isinstance(vessel.database, HydroDatabase)
