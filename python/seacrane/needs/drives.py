"""Choices about what moves and holds a crane: oil, and controlled drives."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np

from seacrane import _core
from seacrane.accuracy.simpler_scenes import locked
from seacrane.description.hydraulic_cylinders import hydraulic_cylinders, slide_of
from seacrane.needs.choice import Choice
from seacrane.scene.scene import Scene


def held_oil(scene: Scene) -> Iterator[Choice]:
    """Hydraulic cylinders that hold their stroke, each held by a driver instead."""
    held = {
        name: slide
        for name, one in hydraulic_cylinders(scene).items()
        if (slide := slide_of(scene, one)) is not None and _is_still(one.reference)
    }
    if held:
        lines = [
            f'scene.remove("{name}", kind="load")\nscene.add_driver("{slide}", curve=0.0)'
            for name, slide in held.items()
        ]
        yield Choice(
            name=f"cylinders held without oil: {', '.join(held)}",
            script="\n".join(lines),
            made=partial(_held, slides=held),
            of="drives",
        )


def _is_still(curve: _core.Curve) -> bool:
    pieces = curve.to_pieces()
    return len(pieces["starts"]) == 1 and not np.any(np.reshape(pieces["coefficients"], (-1, 6))[:, 1:])


def _held(scene: Scene, *, slides: dict[str, str]) -> Scene:
    out = scene.copy(loads={name: load for name, load in scene.loads.items() if name not in slides})
    for slide in slides.values():
        out.add_driver(slide, curve=0.0)
    return out


def held_crane(scene: Scene) -> Iterator[Choice]:
    """Controlled coordinates held where they start."""
    if scene.actuators:
        yield Choice(
            name="crane held where it starts", script="scene = needs.locked(scene)", made=locked, of="drives"
        )
