"""Limit states of a scene: added, and as plain data for files and results."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict
from typing import Any

from seacrane.description.limit_state import LimitState
from seacrane.description.scene import Description, insert
from seacrane.errors import SceneError
from seacrane.files.node import Node
from seacrane.inputs.checked import name_of, number_of, text_of
from seacrane.inputs.shown import shown

KEYS = ("name", "channel", "maximum", "minimum", "where")


def add_limit_state(
    scene: Description,
    channel: str,
    *,
    max: float | None = None,
    min: float | None = None,
    where: Mapping[str, str] | None = None,
    name: str | None = None,
) -> LimitState:
    """State what a channel may reach: every result then tells its utilisation, `Result.utilisation`.

    It exerts no load. The channel is recorded even where it is none of the usual ones.

    Parameters
    ----------
    channel : str
        As results name it, such as "link_tension" or "vessel_motion".
    max, min : float, optional
        Largest and smallest value that it may have, in its SI unit (rad for angles); not zero.
    where : mapping of str to str, optional
        Names along its dimensions, such as ``{"cylinder": "main"}`` or ``{"motion": "roll"}``. Of a dimension
        that is not named, the worst counts.
    name : str, optional
        Default: the channel and the names.

    Returns
    -------
    LimitState

    Raises
    ------
    SceneError
        For bounds that leave nothing between them or are zero; a channel or a name that the scene does not
        have is refused when a run starts.
    """
    channel = text_of("limit state: channel", channel)
    chosen = _where(channel, where or {})
    name = name_of("limit state", name, " ".join([channel.replace("_", " "), *chosen.values()]))
    bounds = {key: _bound(name, key, value) for key, value in (("max", max), ("min", min))}
    high, low = bounds["max"], bounds["min"]
    if high is None and low is None:
        raise SceneError(f"limit state {name!r}: has neither max nor min; give one")
    if high is not None and low is not None and not low < high:
        raise SceneError(f"limit state {name!r}: min is {low:g} and max {high:g}; min must be below max")
    state = LimitState(name=name, channel=channel, maximum=high, minimum=low, where=chosen)
    added: LimitState = insert("limit state", scene.limit_states, state)
    return added


def _where(channel: str, given: Any) -> dict[str, str]:
    if not isinstance(given, Mapping):
        raise SceneError(
            f'limit state of {channel!r}: where is {shown(given)}; give names, such as {{"motion": "roll"}}'
        )
    what = f"limit state of {channel!r}: where"
    return {text_of(what, dim): text_of(f"{what}, {dim}", name) for dim, name in given.items()}


def _bound(name: str, key: str, value: Any) -> float | None:
    if value is None:
        return None
    number = number_of(f"limit state {name!r}: {key}", value)
    if not math.isfinite(number) or number == 0.0:
        raise SceneError(
            f"limit state {name!r}: {key} is {number:g}; a utilisation is over a finite value that is not "
            "zero: give a small one for a load that may just not vanish"
        )
    return number


def limit_states_to_data(scene: Description) -> list[dict[str, Any]]:
    """As plain data."""
    return [asdict(state) for state in scene.limit_states.values()]


def limit_states_from_node(node: Node, scene: Description) -> None:
    """Give a scene the limit states that `limit_states_to_data` wrote; raises FileFormatError."""
    for entry in node.items():
        entry.expect(KEYS)
        bounds = {
            short: None if entry.at(key).value is None else entry.at(key).number()
            for key, short in (("maximum", "max"), ("minimum", "min"))
        }
        where = entry.at("where")
        if not isinstance(where.value, dict):
            where.fail("give an object with names")
        names = {dim: where.at(dim).text() for dim in where.value}
        with entry.scene_errors():
            add_limit_state(
                scene, name=entry.at("name").text(), channel=entry.at("channel").text(), where=names, **bounds
            )
