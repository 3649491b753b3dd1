"""What each kind of fluid memory costs per evaluation, and how the cost grows with the states."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

from seacrane import Scene, cases
from seacrane.analysis import Evaluator

from .section import Section

PART = "loads, waves, memory"
SAMPLE = "sample of a convolution, per its step"
KINDS = ("none", "per-pair", "passive", "convolution")
SHARES = (0.25, 0.5, 0.75)


def memory_kinds(*, repeats: int) -> Section:
    """The vessel alone with every kind, and with the first blocks of the per-pair models only."""
    scenes = {kind: cases.vessel(memory=kind) for kind in KINDS}
    floor = _parts(scenes["none"], repeats)[PART]
    rows = [_row("none", scenes["none"], floor, repeats)]
    blocks = list(scenes["per-pair"].vessels["vessel"].memory)
    for share in SHARES:
        some = blocks[: round(share * len(blocks))]
        rows.append(_row(f"per-pair, {len(some)} of {len(blocks)} models", _vessel(some), floor, repeats))
    rows += [_row(kind, scenes[kind], floor, repeats) for kind in KINDS[1:]]
    return Section(
        title="Kinds of fluid memory",
        text=(
            "The vessel alone in the sea: the memory's share of one evaluation, as the part `loads, waves, "
            "memory` less that of the scene without memory, best of "
            f"{repeats}. A convolution also takes a sample of the motion, once per step of its own "
            "and not once per evaluation."
        ),
        head=["memory", "states", "history samples", "ns per evaluation", "ns per state", "us per sample"],
        rows=rows,
    )


def _vessel(blocks: list[Any]) -> Scene:
    """The vessel with these models as its memory."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        scene = cases.vessel(memory="none")
    old = scene.vessels["vessel"]
    names = ("added_mass", "linear_damping", "quadratic_damping", "restoring", "mooring_stiffness")
    kept = {name: getattr(old, name) for name in (*names, "mooring_damping")}
    scene.vessels.clear()
    scene.add_vessel(body="vessel", memory=blocks, **kept)
    return scene


def _parts(scene: Scene, repeats: int) -> dict[str, float]:
    """Shortest time of every part of an evaluation, ns."""
    model = scene.compile()
    state = np.array(model.initial_state)
    runs = [Evaluator(model).time_parts(0.0, state, 4_000) for _ in range(repeats)]
    return {name: min(run[name] for run in runs) for name in runs[0]}


def _row(name: str, scene: Scene, floor: float, repeats: int) -> list[Any]:
    model, parts = scene.compile(), _parts(scene, repeats)
    cost = parts[PART] - floor
    states = model.memory_states
    return [
        name,
        states,
        model.history_samples,
        round(cost),
        round(cost / states, 2) if states else "",
        round(parts[SAMPLE] / 1e3, 1) if SAMPLE in parts else "",
    ]
