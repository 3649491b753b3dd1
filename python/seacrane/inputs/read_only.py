"""Mappings that nobody changes in place: what was worked out of a description stays true of it."""

from __future__ import annotations

from typing import Any, NoReturn, TypeVar

Key = TypeVar("Key")
Value = TypeVar("Value")


class ReadOnly(dict[Key, Value]):
    """A dictionary that refuses changes, also after a copy and a pickle; `dict(it)` may be changed."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        held = ", ".join(map(repr, self)) or "nothing"
        raise TypeError(
            f"this mapping belongs to a description and is read-only (it holds {held}); change a copy, "
            "dict(...), and give that where the description is made"
        )

    __setitem__ = __delitem__ = __ior__ = _refuse
    clear = pop = popitem = setdefault = update = _refuse

    def __reduce__(self) -> tuple[Any, ...]:
        return ReadOnly, (dict(self),)
