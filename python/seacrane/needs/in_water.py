"""Choices about the sea, the hull and parts in it: waves, drift, fluid memory, strips, coefficients."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from operator import methodcaller

import numpy as np

from seacrane import _core
from seacrane.accuracy.simpler_scenes import (
    BOUND,
    CASES,
    FEWER,
    SHARES,
    memory_name,
    scattered,
    shapes_in,
    strongest,
    with_memory,
)
from seacrane.description.databases import source_of
from seacrane.description.given import given_vessels
from seacrane.description.loads import changed
from seacrane.description.waves import Waves
from seacrane.description.wet_parts import immersed_parts
from seacrane.hydro import HydroDatabase
from seacrane.needs.choice import Choice, by_calls, call
from seacrane.scene.scene import Scene
from seacrane.scene.sea import as_put

LOOSER = 0.05  # limit of a memory by motion
MORE_WAVES = 1.2  # times the waves at a part: what a hull beside may make of them


def fewer_waves(scene: Scene) -> Iterator[Choice]:
    """The strongest components alone."""
    waves = scene.waves
    if waves is None or not (waves.hulls or immersed_parts(scene)):
        return
    for share in FEWER:
        count = int(np.ceil(share * len(waves.omega)))
        if count < len(waves.omega):
            yield Choice(
                name=f"{count} of {len(waves.omega)} wave components",
                script=f"scene.waves = needs.strongest(scene.waves, {count})",
                made=partial(_with_waves, change=partial(strongest, count=count)),
                of="wave components",
            )


def _with_waves(scene: Scene, *, change: Callable[[Waves], Waves]) -> Scene:
    return scene if scene.waves is None else scene.copy(waves=change(scene.waves))


def coarse_table(scene: Scene) -> Iterator[Choice]:
    """Loads of waves from a table with a wide bound, in place of a fine one or of the sum itself."""
    waves = scene.waves
    if waves is None or not waves.has_tables():
        return
    if waves.evaluation == "exact" or waves.relative_bound < BOUND:
        yield Choice(
            name=f"wave table within {BOUND:g}",
            script=f'scene.waves = dataclasses.replace(scene.waves, evaluation="table", '
            f"relative_bound={BOUND!r})",
            made=partial(_with_waves, change=partial(replace, evaluation="table", relative_bound=BOUND)),
            of="wave table",
        )


def no_drift(scene: Scene) -> Iterator[Choice]:
    """No slow drift of a vessel."""
    for body, hull in {} if scene.waves is None else scene.waves.hulls.items():
        none = {"drift": None, "drift_by_heading": None}
        if any(getattr(hull, key) is not None for key in none):
            yield Choice(
                name=f"no slow drift of {body}",
                script=f'scene.waves = scene.waves.changed("{body}", drift=None, drift_by_heading=None)',
                made=partial(_with_waves, change=methodcaller("changed", body, **none)),
                of=f"slow drift of {body}",
            )


def more_drift(scene: Scene) -> Iterator[Choice]:
    """The slow drift that a database has, and the scene leaves out."""
    for body, hull in {} if scene.waves is None else scene.waves.hulls.items():
        source = source_of(scene, body)
        if hull.drift is None and isinstance(source, HydroDatabase) and source.drift is not None:
            assert scene.waves is not None
            words = as_put(scene, scene.waves, body) | {"drift": True}
            words = {key: one for key, one in words.items() if one is not None}
            yield by_calls(f"slow drift of {body}", call("add_sea", **words), of=f"slow drift of {body}")


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


def no_waves_on_parts(scene: Scene) -> Iterator[Choice]:
    """Parts in still water."""
    if scene.waves is not None and any(part.wave_factor for part in immersed_parts(scene).values()):
        yield _factor("no waves on parts in water", 0.0)


def waves_on_parts(scene: Scene) -> Iterator[Choice]:
    """Waves at parts that see none, or higher ones, as a hull beside them makes."""
    parts = immersed_parts(scene)
    if scene.waves is None or not parts:
        return
    if any(part.wave_factor == 0.0 for part in parts.values()):
        yield _factor("waves on all parts in water", 1.0)
    else:
        yield _factor(f"wave_factor {MORE_WAVES:g} at parts in water", MORE_WAVES)


def _factor(name: str, factor: float) -> Choice:
    return Choice(
        name=name,
        script="for name, load in list(scene.loads.items()):\n"
        '    if type(load).__name__ == "ImmersedPart":\n'
        f'        scene.replace(name, kind="load", wave_factor={factor:g})',
        made=partial(_with_factor, factor=factor),
        of="waves on parts in water",
    )


def _with_factor(scene: Scene, *, factor: float) -> Scene:
    out = scene.copy()
    for name, part in immersed_parts(scene).items():
        out.loads[name] = changed(part, wave_factor=factor)
    return out


def no_strips(scene: Scene) -> Iterator[Choice]:
    """Each part that is cut into strips as one piece."""
    if any(part.row for part in immersed_parts(scene).values()):
        yield Choice(
            name="parts in water in one piece each",
            script="scene = needs.in_one_piece(scene)",
            made=in_one_piece,
            of="strips",
        )


def in_one_piece(scene: Scene) -> Scene:
    """The scene with one part in the place of each row of strips; a part cut both ways keeps its rows."""
    out = scene.copy()
    rows: dict[str, list[_core.ImmersedPart]] = {}
    for part in immersed_parts(scene).values():
        if part.row:
            rows.setdefault(part.row, []).append(part)
    for row in rows.values():
        for part in row:
            del out.loads[part.name]
        out.loads[row[0].name] = _whole(row)
    return out


def _whole(row: list[_core.ImmersedPart]) -> _core.ImmersedPart:
    """One part of the water, mass and drag of all strips of a row."""
    first, count = row[0], len(row)
    axes = np.asarray(first.axes, dtype=float)
    along = np.abs(axes.T @ np.asarray(first.step, dtype=float))
    size = np.where(along > 0.5 * along.max(), count, 1.0) * np.asarray(first.size, dtype=float)
    return changed(
        first, row="", place=0, count=1, step=np.zeros(3), size=size,
        point=np.mean([one.point for one in row], axis=0),
        added_masses=sum(np.asarray(one.added_masses) for one in row),
        volumes=sum(np.asarray(one.volumes) for one in row),
        drag=sum(np.asarray(one.drag) for one in row),
        slow_added_masses=sum(np.asarray(one.slow_added_masses) for one in row),
    )  # fmt: skip


def scatter(scene: Scene) -> Iterator[Choice]:
    """More and less added mass and drag than described: how well coefficients are known."""
    if not shapes_in(scene):
        return
    for case, (coefficient, _) in CASES.items():
        shares = sorted({SHARES[shape][coefficient] for shape in shapes_in(scene)})
        told = " to ".join(f"{100 * share:g}" for share in dict.fromkeys([shares[0], shares[-1]]))
        yield Choice(
            name=f"{case} in water, by {told} %",
            script=f'scene = needs.scattered(scene, "{case}")',
            made=partial(scattered, case=case),
            of="coefficients in water",
        )
