"""Expressions of curves as text: read by a parser of their own into a short program; no Python is evaluated.

    sum     = product { ("+" | "-") product }
    product = factor { ("*" | "/") factor }
    factor  = "-" factor | number [unit] | curve | function "(" sum { "," sum } ")" | "(" sum ")"

A curve is a channel as `pick` reads it ("hook_load[main]", "roll"), or a named point or a body with an axis
("tip.z", its speed "tip.vz"; quoted where the name is more than a word: "'corner 0'.z"), also along the axes
of a body ("tip.z in barge").
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from fractions import Fraction
from functools import reduce
from typing import Any, NamedTuple, NoReturn, TypeVar

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.inputs.units import ANGLE, UNITS, Dimension, power, product, unit_text

Value = TypeVar("Value")
LONGEST, DEEPEST = 1000, 40  # characters; parentheses, calls and signs within each other
FUNCTIONS = {"sqrt": 1, "abs": 1, "hypot": 2, "atan2": 2, "min": 0, "max": 0}  # arguments; 0: two or more
SIGNS = (("+", "-"), ("*", "/"))
OF_ONE: dict[str, Callable[[Any], Any]] = {"negative": np.negative, "sqrt": np.sqrt, "abs": np.abs}
OF_TWO: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "/": np.divide,
    "hypot": np.hypot, "atan2": np.arctan2, "min": np.minimum, "max": np.maximum,
}  # fmt: skip


_UNIT = "|".join(sorted((re.escape(unit) for unit in UNITS if unit != "1"), key=len, reverse=True))
_NAME = r"""(?:[^\W0-9]\w*|'[^']*'|"[^"]*")"""
_TOKEN = re.compile(
    rf"""\s*(?:
    (?P<number>(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)(?:\s*(?P<unit>{_UNIT})(?![\w\[.]|\s*\())?
  | (?P<place>{_NAME}\.v?[xyz])(?!\w)(?:\s+in\s+(?P<along>{_NAME}))?
  | (?P<curve>[^\W0-9]\w*\s*\[[^\[\]]*\])
  | (?P<word>[^\W0-9]\w*)
  | (?P<sign>[-+*/(),])
    )""",
    re.VERBOSE,
)


class Number(NamedTuple):
    """A number in SI units."""

    value: float
    dimension: Dimension


class Curve(NamedTuple):
    """The text of a curve; of a place its name, its axis, and the body along whose axes that is."""

    text: str
    axis: str = ""
    along: str = ""

    @property
    def is_rate(self) -> bool:
        """Whether it is the speed of a place."""
        return self.axis.startswith("v")


class Call(NamedTuple):
    """What is done with the last values."""

    name: str
    of: int


Program = tuple[Number | Curve | Call, ...]


def parsed(what: str, text: str) -> Program:
    """The program of an expression: values before what is done with them; SceneError for what is none."""
    if len(text) > LONGEST:
        raise SceneError(f"{what}: has {len(text)} characters, above {LONGEST}; split it")
    return _Parser(what, text).program()


def worked_out(
    program: Program, leaf: Callable[[Any], Value], apply: Callable[[str, Sequence[Value]], Value]
) -> Value:
    """The value of a program by that of its numbers and curves and by what calls make of them."""
    stack: list[Value] = []
    for step in program:
        if isinstance(step, Call):
            stack[-step.of :] = [apply(step.name, stack[-step.of :])]
        else:
            stack.append(leaf(step))
    return stack[0]


def values_of(name: str, values: Sequence[Array]) -> Array:
    """What a call makes of arrays; not a number where it is none."""
    with np.errstate(all="ignore"):
        if name in OF_ONE:
            return np.asarray(OF_ONE[name](values[0]))
        return np.asarray(reduce(OF_TWO[name], values))


def dimension_of(what: str, name: str, values: Sequence[Dimension]) -> Dimension:
    """The dimension of what a call makes; SceneError where those of its arguments do not fit."""
    match name:
        case "*":
            return product(values)
        case "/":
            return product([values[0], power(values[1], Fraction(-1))])
        case "sqrt":
            return power(values[0], Fraction(1, 2))
    others = [one for one in values if one != values[0]]
    if others:
        units = f"{unit_text(values[0])} and {unit_text(others[0])}"
        raise SceneError(
            f"{what}: {name!r} is of {units}, which do not fit; give a number its unit, such as '3 m'"
        )
    return ANGLE if name == "atan2" else values[0]


class _Parser:
    """By recursive descent."""

    def __init__(self, what: str, text: str) -> None:
        self.what, self.text, self.at, self.depth = what, text, 0, 0
        self.steps: list[Number | Curve | Call] = []
        self.token: re.Match[str] | None = None
        self.advance()

    def program(self) -> Program:
        self.sum()
        if self.token is not None:
            self.fail("an operator or the end was expected")
        return tuple(self.steps)

    def fail(self, why: str) -> NoReturn:
        token = self.token
        place = "at its end" if token is None else f"at {shown(token[0].strip())}"
        raise SceneError(f"{self.what} is {shown(self.text)}: {why} {place}")

    def advance(self) -> None:
        if not self.text[self.at :].strip():
            self.token = None
            return
        self.token = _TOKEN.match(self.text, self.at)
        if self.token is None:
            rest = self.text[self.at :].strip()
            raise SceneError(
                f"{self.what} is {shown(self.text)}: {shown(rest[:20])} is no part of an expression; it has "
                f"numbers, curves, + - * / and {', '.join(FUNCTIONS)}"
            )
        self.at = self.token.end()

    def sign(self, *signs: str) -> str:
        """The sign that comes, where it is one of these, taken; else no text."""
        found = self.token["sign"] if self.token is not None else None
        if found not in signs:
            return ""
        self.advance()
        return str(found)

    def sum(self, level: int = 0) -> None:
        """Of products, which are of factors."""
        if level == len(SIGNS):
            self.factor()
            return
        self.sum(level + 1)
        while sign := self.sign(*SIGNS[level]):
            self.sum(level + 1)
            self.steps.append(Call(sign, 2))

    def factor(self) -> None:
        self.depth += 1
        if self.depth > DEEPEST:
            self.fail(f"more than {DEEPEST} parentheses and signs are within each other")
        if self.sign("-"):
            self.factor()
            self.steps.append(Call("negative", 1))
        elif self.sign("("):
            self.sum()
            self.close()
        else:
            self.value()
        self.depth -= 1

    def close(self) -> None:
        if not self.sign(")"):
            self.fail("')' was expected")

    def value(self) -> None:
        token = self.token
        if token is None or token["sign"]:
            self.fail("a number or a curve was expected")
        self.advance()
        if token["number"]:
            factor, dimension = UNITS[token["unit"] or "1"]
            number = factor * float(token["number"])
            if not np.isfinite(number):
                raise SceneError(f"{self.what}: {shown(token['number'])} is no finite number")
            self.steps.append(Number(number, dimension))
        elif token["place"]:
            name, _, axis = token["place"].rpartition(".")
            self.steps.append(Curve(name.strip("\"'"), axis, (token["along"] or "").strip("\"'")))
        elif token["curve"] or not self.sign("("):
            self.steps.append(Curve(token["curve"] or token["word"]))
        else:
            self.call(token["word"])

    def call(self, name: str) -> None:
        if name not in FUNCTIONS:
            near = get_close_matches(name, FUNCTIONS, n=1)
            fix = f"did you mean {near[0]!r}?" if near else f"choose from {', '.join(FUNCTIONS)}"
            raise SceneError(f"{self.what}: there is no function {shown(name)}; {fix}")
        count = 1
        self.sum()
        while self.sign(","):
            self.sum()
            count += 1
        self.close()
        if count != FUNCTIONS[name] and (FUNCTIONS[name] or count < 2):
            takes = FUNCTIONS[name] or "two or more"
            raise SceneError.of(f"{self.what}: {name}", f"has {count} arguments; it takes {takes}")
        self.steps.append(Call(name, count))
