"""What follows from a description alone: worked out once for its content, however often it is asked for.

Elements are immutable, so that a description holds what it held where it holds the same objects under the
same names: a look at them finds every change, whichever way it was made. What was worked out lies with the
scene, and copies share it for as long as they hold the same.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps
from itertools import chain
from operator import attrgetter, is_, itemgetter, methodcaller
from typing import Any, Concatenate, ParamSpec, TypeVar

from seacrane.description.description import ANSWERS, KINDS, Description
from seacrane.description.waves import Waves
from seacrane.inputs.caller import Said, recorded, say_again

P = ParamSpec("P")
T = TypeVar("T")
Scenes = TypeVar("Scenes", bound="Description")
_plain = itemgetter("name", "gravity", "orientation", "baumgarte", "length_scale")
_tables, _values = itemgetter(*KINDS), methodcaller("values")
MOST_HELD = 4  # answers of one function, as for the last runs from other times
_WORKING_ON: ContextVar[tuple[Any, Answers] | None] = ContextVar("working_on", default=None)
"""The scene that work is being done on, which does not change meanwhile: it is looked at once."""
Known = dict[Any, dict[Hashable, tuple[Any, list[Said]]]]


class Answers:
    """What was worked out of one content, by function and arguments, with the warnings given on the way: of
    the scene in its sea, and of all but the sea, which scenes that differ in nothing else share."""

    def __init__(self, content: list[Any], waves: Waves | None, in_any_sea: Known) -> None:
        self.content, self.waves = content, waves
        self.known: Known = {}
        self.in_any_sea = in_any_sea


def answers_of(scene: Description) -> Answers:
    """What is known of a scene as it is now."""
    tables = _tables(vars(scene))
    elements = chain.from_iterable(map(_values, tables))
    # by identity; all but the sea, and notes, which nothing reads
    content = [*_plain(vars(scene)), *map(len, tables), *chain.from_iterable(tables), *elements]
    held: Answers | None = vars(scene).get(ANSWERS)
    if held is None or len(held.content) != len(content) or not all(map(is_, held.content, content)):
        held = vars(scene)[ANSWERS] = Answers(content, scene.waves, {})
    elif held.waves is not scene.waves:
        held = vars(scene)[ANSWERS] = Answers(content, scene.waves, held.in_any_sea)
    return held


def once(work: Callable[Concatenate[Scenes, P], T]) -> Callable[Concatenate[Scenes, P], T]:
    """The function of a description, and of arguments that do not change, which works once for a content.

    Whoever asks gets the same object and is not to change it. Its warnings are given at each call. An error
    is not kept: what raised it is tried again.
    """
    return _answering(work, attrgetter("known"))


def once_in_any_sea(work: Callable[Concatenate[Scenes, P], T]) -> Callable[Concatenate[Scenes, P], T]:
    """As `once`, of what does not read `waves`: scenes in other seas share the answer."""
    return _answering(work, attrgetter("in_any_sea"))


def _answering(
    work: Callable[Concatenate[Scenes, P], T], place: Callable[[Answers], Known]
) -> Callable[Concatenate[Scenes, P], T]:
    @wraps(work)
    def answered(scene: Scenes, /, *args: P.args, **given: P.kwargs) -> T:
        trusted = _WORKING_ON.get()
        answers = trusted[1] if trusted is not None and trusted[0] is scene else answers_of(scene)
        held = place(answers).setdefault(work, {})
        key = (args, tuple(given.items()))
        found = held.get(key)
        if found is not None:
            say_again(found[1])
            return found[0]  # type: ignore[no-any-return]
        before = _WORKING_ON.set((scene, answers))
        try:
            with recorded() as said:
                value = work(scene, *args, **given)
        finally:
            _WORKING_ON.reset(before)
        for old in list(held)[: len(held) + 1 - MOST_HELD]:
            held.pop(old, None)
        held[key] = (value, said)
        return value

    return answered


@contextmanager
def unchanged(scene: Description) -> Iterator[None]:
    """Inside, the scene does not change: it is looked at once, for all that is asked of it."""
    before = _WORKING_ON.set((scene, answers_of(scene)))
    try:
        yield
    finally:
        _WORKING_ON.reset(before)


def sharing(scene: Scenes, other: Description) -> Scenes:
    """The scene, which holds what another one holds, with what is known of that."""
    vars(scene)[ANSWERS] = answers_of(other)
    return scene


def forgetting(scene: Scenes) -> Scenes:
    """The scene without what is known of it: what is kept for long holds no compiled model."""
    vars(scene).pop(ANSWERS, None)
    return scene
