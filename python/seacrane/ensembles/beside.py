"""How many members are stepped side by side, and what is said of it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Mapping, Sequence

from seacrane.ensembles.members import Members
from seacrane.ensembles.other_sea import WORDS
from seacrane.ensembles.stage_values import START_TIME
from seacrane.errors import SceneError
from seacrane.run.lanes import lanes_of

SIDE_BY_SIDE = "side_by_side"  # attribute of a dataset
PARTLY = re.compile(r"from t = \S+ s on: |in part: ")
MOST_REASONS = 3


def lanes_for(lanes: int | None, pack: int | None, members: Members, *, starts: Sequence[float]) -> int:
    """The lanes of an ensemble, of which those that begin at several times of one run have none.

    Raises SceneError for lanes that there are not.
    """
    asked = lanes_of(lanes)
    if starts and lanes not in (None, 1):
        raise SceneError(f"lanes is {lanes}, and lifts with start_time are run one by one; leave lanes out")
    if starts:
        return 1
    if lanes is not None:
        return asked
    of_one_lift = any(name in WORDS for name in members.axes)
    return asked if of_one_lift and not (isinstance(pack, int) and pack % asked) else 1


def remark(lanes: int, told: Mapping[str, int], names: Collection[str]) -> str:
    """One line on how members are stepped.

    Parameters
    ----------
    lanes : Runs side by side.
    told : How many members were kept apart for each reason; none for the empty reason.
    names : What varies.
    """
    count = sum(told.values())
    if lanes == 1:
        return f"{count} one by one: {_why_one_by_one(names)}"
    reasons = Counter[str]()
    for why, several in told.items():
        reasons[PARTLY.sub("in part, ", why)] += several
    beside = reasons.pop("", 0)
    if not reasons:
        return f"{beside} in {lanes} lanes"
    first = [f"{several} ({why})" for why, several in reasons.most_common(MOST_REASONS)]
    more = ", ..." if len(reasons) > MOST_REASONS else ""
    return f"{beside} in {lanes} lanes, by themselves {', '.join(first)}{more}"


def _why_one_by_one(names: Collection[str]) -> str:
    if START_TIME in names:
        return "they begin at several times of one sea"
    if not any(name in WORDS for name in names):
        return "lanes is 1, as it is by default where no word of the sea varies"
    return "lanes is 1"
