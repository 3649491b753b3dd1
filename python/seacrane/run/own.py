"""Channels of one's own, out of the channels of a result by name."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from seacrane.description.channels import CHANNELS, OWN
from seacrane.description.expression import Curve, Number, values_of, worked_out
from seacrane.description.pick import Pick
from seacrane.errors import SceneError
from seacrane.scene.own_channels import picked, picks, programs

if TYPE_CHECKING:
    from seacrane.description.description import Description

Array = NDArray[np.float64]
Names = Mapping[str, Sequence[str]]


def with_sources(scene: Description, channels: Iterable[str]) -> list[str]:
    """Channels with those that expressions are made of in the place of the expressions."""
    out = list(dict.fromkeys(channels))
    if OWN not in out:
        return out
    made_of = [pick.channel for curves in picks(scene).values() for pick in curves]
    return list(dict.fromkeys([*(name for name in out if name != OWN), *made_of]))


def require_own(scene: Description, names: Names) -> None:
    """SceneError where an expression has a name that the scene has not, or leaves one of several open."""
    for channel, curves in picks(scene).items():
        for pick in curves:
            for dim in CHANNELS[pick.channel].dims_of_several[1:]:
                known = names.get(dim, ())
                _require_name(f"channel {channel!r}: {pick}", dim, pick.names.get(dim), known)


def _require_name(what: str, dim: str, name: str | None, known: Sequence[str]) -> None:
    if name is None and len(known) != 1:
        raise SceneError(f"{what}: says not which {dim}; name one of {', '.join(known) or 'none'}")
    if name is not None and name not in known:
        near = get_close_matches(name, known, n=1)
        fix = f"did you mean {near[0]!r}?" if near else f"choose from {', '.join(known) or 'none'}"
        raise SceneError(f"{what}: there is no {dim} {name!r}; {fix}")


def own_values(scene: Description, arrays: Mapping[str, Array], names: Names, count: int) -> Array | None:
    """Values of expressions, (count, expression); None where there is none or a part was not recorded."""
    if not scene.channels or not all(name in arrays for name in with_sources(scene, [OWN])):
        return None

    def leaf(step: Number | Curve) -> Array:
        if isinstance(step, Number):
            return np.asarray(step.value)
        return _curve(arrays, names, picked(scene, "channel", step))

    columns = [worked_out(program, leaf, values_of) for program in programs(scene).values()]
    return np.stack([np.broadcast_to(column, count) for column in columns], axis=1)


def _curve(arrays: Mapping[str, Array], names: Names, pick: Pick) -> Array:
    array = arrays[pick.channel]
    for dim in reversed(CHANNELS[pick.channel].dims_of(array.ndim)[1:]):
        array = array[..., names[dim].index(pick.names[dim]) if dim in pick.names else 0]
    return array
