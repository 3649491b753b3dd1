"""What is wrong with rest states that statics tells: those that do not last, and too much heel."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from seacrane.analysis.stability import Growing, growing
from seacrane.answers.rest_columns import AtRest, columns_of
from seacrane.description.scene import Description
from seacrane.inputs.caller import warn_caller
from seacrane.validity.range import LARGEST_HEEL
from seacrane.warnings import LargeHeelWarning, UnstableRestWarning

Columns = dict[str, tuple[str, float]]
Pose = Mapping[str, float]


class RestJudge:
    """Looks at rest states one after another, and tells the worst of them at the end."""

    def __init__(self, scene: Description) -> None:
        self._name, self._poses = scene.name, 0
        self._falling: list[tuple[Growing, str]] = []
        self._heeled: list[tuple[float, str]] = []

    def seen(self, at_rest: AtRest, pose: Pose) -> Columns:
        """The columns of a state at rest."""
        columns, where = columns_of(at_rest), _where(pose)
        self._poses += 1
        grows = growing(at_rest.scene, at_rest.model, at_rest.state)
        stability = [f"{name} {value:.3g} {unit}" for name, (unit, value) in columns.items() if _is_gm(name)]
        if grows:
            self._falling.append((grows[0], f"{where}{', '.join(stability)}"))
        for name, (_, value) in columns.items():
            if name.split(" ")[0] in ("heel", "trim") and abs(value) > np.degrees(LARGEST_HEEL):
                self._heeled.append((abs(value), f"{where}{name} is {value:.3g} deg"))
        return columns

    def warn(self) -> None:
        """Warn of the pose in which most grows fastest, and of that with the largest heel."""
        if self._falling:
            worst, told = max(self._falling, key=lambda one: one[0].value.real)
            warn_caller(
                f"statics: scene {self._name!r} does not stay at rest in {len(self._falling)} of "
                f"{self._poses} poses; {told or 'as described'}: {worst.label} {worst.words}. Lower "
                "the weights, take less on the hook, or hold what tips over",
                UnstableRestWarning,
            )
        if self._heeled:
            _, told = max(self._heeled)
            warn_caller(
                f"statics: {told}, beyond {np.degrees(LARGEST_HEEL):.0f} deg in {len(self._heeled)} of "
                f"{self._poses} poses: restoring is linear, so that heel, GM and all that follows from them "
                "are not those of the ship there. Take less on the hook or nearer, add ballast "
                "(Scene.add_ballast), or look at righting_arms",
                LargeHeelWarning,
            )


def _is_gm(name: str) -> bool:
    return name == "GM" or name.startswith("GM ")


def _where(pose: Pose) -> str:
    if not pose:
        return ""
    return f"at {', '.join(f'{name} {value:.4g}' for name, value in pose.items())} "
