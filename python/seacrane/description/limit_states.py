"""Limit states of a scene."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from seacrane.description.description import Description, insert
from seacrane.description.limit_state import LimitState
from seacrane.description.pick import pick_of
from seacrane.errors import SceneError
from seacrane.inputs.checked import name_of, number_of
from seacrane.inputs.shown import shown

SLACK = "slack"  # in place of a channel: the margin that marine operations are planned with
SLACK_MARGIN = 0.1  # of the static tension: 10 % as DNV-RP-N103 is quoted to ask for; unverified


def add_limit_state(
    scene: Description,
    channel: str,
    *,
    maximum: float | None = None,
    minimum: float | None = None,
    names: Mapping[str, str] | None = None,
    name: str | None = None,
) -> LimitState:
    """State what a channel may reach: every result then tells its utilisation, `Result.utilisation`.

    It exerts no load. The channel is recorded even where it is none of the usual ones.

    Parameters
    ----------
    channel : str
        As results name it, such as "link_tension", or a selector with names: "vessel_motion[roll]". "slack",
        or "slack[hoist]", is `slack_margin` with a minimum of 0.1: no line below a tenth of its static load.
    maximum, minimum : float, optional
        Largest and smallest value that it may have, in its SI unit (rad for angles); not zero.
    names : mapping of str to str, optional
        Names along its dimensions beside those in the selector, such as ``{"cylinder": "main"}``. Of a
        dimension that is not named, the worst counts.
    name : str, optional
        Default: the channel and the names.

    Raises
    ------
    SceneError
        For an unknown channel, and for bounds that leave nothing between them or are zero; a channel or a
        name that the scene does not have is refused when a run starts.
    """
    if not isinstance(names or {}, Mapping):
        raise SceneError(f"limit state: names is {shown(names)}; give names by dimension")
    word, bracket, rest = channel.partition("[") if isinstance(channel, str) else ("", "", "")
    if word.strip() == SLACK:
        channel = f"slack_margin{bracket}{rest}"
        minimum = SLACK_MARGIN if maximum is None and minimum is None else minimum
    pick = pick_of("limit state", channel, names)
    if pick.parts:
        raise SceneError(f"limit state {pick}: holds at all times; leave {pick.parts} out")
    words = [pick.channel.replace("_", " "), *pick.names.values()]
    name = name_of("limit state", name, " ".join(words))
    high, low = _bound(name, "maximum", maximum), _bound(name, "minimum", minimum)
    if high is None and low is None:
        raise SceneError(f"limit state {name!r}: has neither maximum nor minimum; give one")
    if high is not None and low is not None and not low < high:
        raise SceneError(
            f"limit state {name!r}: minimum is {low:g} and maximum {high:g}; minimum must be below maximum"
        )
    state = LimitState(name=name, channel=pick.channel, maximum=high, minimum=low, names=pick.names)
    added: LimitState = insert("limit state", scene.limit_states, state)
    return added


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
