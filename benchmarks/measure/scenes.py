"""The scenes that are measured, and their size."""

from __future__ import annotations

from collections.abc import Callable

from seacrane import Scene, cases
from seacrane.analysis import fastest_mode

from .section import Section

SCENES: dict[str, Callable[[], Scene]] = {
    "case2": cases.case2,
    "case1": cases.case1,
    "case3": cases.case3,
    "vessel": cases.vessel,
    "case2, no memory": lambda: cases.case2(memory="none"),
    "vessel, no memory": lambda: cases.vessel(memory="none"),
    "case2, calm water": lambda: cases.case2(hs=0.0),
    "case2, exact wave sum": lambda: cases.case2(evaluation="exact"),
}


def sizes() -> Section:
    """States, components, channels and the fastest mode of every scene."""
    rows = []
    for name, make in SCENES.items():
        scene = make()
        model = scene.compile()
        components = 0 if scene.waves is None else scene.waves.omega.size
        rows.append(
            [
                name,
                len(model.bodies),
                model.coordinates,
                model.constraints,
                model.degrees_of_freedom,
                model.states,
                model.memory_states,
                components,
                len(model.channel_names()),
                fastest_mode(model),
            ]
        )
    return Section(
        title="Scenes",
        text="Fastest mode: the largest |eigenvalue| at the start, 1/s. Channels: recorded by default.",
        head=["scene", "bodies", "coordinates", "constraints", "degrees of freedom", "states",
              "memory states", "wave components", "channels", "fastest mode"],
        rows=rows,
    )  # fmt: skip
