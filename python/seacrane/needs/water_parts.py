"""Choices about parts in water: their waves, their strips, and how well their coefficients are known."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.description.loads import changed
from seacrane.description.wet_parts import immersed_parts
from seacrane.ensembles.coefficient_scatter import CASES, SHARES, scattered, shapes_in
from seacrane.needs.choice import Choice
from seacrane.scene.scene import Scene

MORE_WAVES = 1.2  # times the waves at a part: what a hull beside may make of them


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
            script="seacrane.ensembles.coefficient_scatter(scene, ...)",
            made=partial(scattered, shares=SHARES, case=case),
            of="coefficients in water",
        )
