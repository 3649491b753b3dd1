"""Faults of the engine compiled all at once, each asleep until the environment names it.

What holds a fault's text, a statement, stands twice in the source: as it is, and with the fault. So the
compiler runs once for all of them ("mutant schemata": Untch, Offutt and Harrold, ISSTA 1993).
"""

from __future__ import annotations

import re

from seeded_faults.fault import Fault

VARIABLE = "SEACRANE_SEEDED_FAULT"
# What every file includes. Numbers begin at 1: before the start of the program no fault is awake.
PRELUDE = f"""#pragma once
#include <cstdlib>
inline const int seacrane_seeded_fault = [] {{
  const char* given = std::getenv("{VARIABLE}");
  return given ? std::atoi(given) : 0;
}}();
"""
DECLARED = re.compile(r"((?:const )?(?!return\b|else\b)[\w:]+(?:<[^=;]*>)?) (\w+) =\s+(.*);", re.DOTALL)
COMMENTS = re.compile(r"(?:\s+|//[^\n]*\n|else\b)*")
DEEPER = {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}


def switched(text: str, fault: Fault, number: int) -> str:
    """The file's text with a fault that is awake where the environment has its number."""
    fault.seeded(text)  # raises where it has lost its place
    at = text.index(fault.old)
    ends = ";{}" if not fault.kind else ";{},=("
    start, end = (
        _start(text, at, ends),
        _end(text, at, at + len(fault.old), ";" if not fault.kind else ";,)}"),
    )
    start = COMMENTS.match(text, start, at).end()  # type: ignore[union-attr]
    sound = text[start:end]
    both = _both(sound, sound.replace(fault.old, fault.new), fault.kind, f"seacrane_seeded_fault == {number}")
    return text[:start] + both + text[end:]


def _both(sound: str, faulty: str, kind: str, awake: str) -> str:
    """Of an expression whose type is told, of a name that is declared, of another statement."""
    if kind:
        return f"({awake} ? {kind}({faulty}) : {kind}({sound}))"
    declared, other = DECLARED.fullmatch(sound), DECLARED.fullmatch(faulty)
    if declared and other:
        made = declared[1].removeprefix("const ")
        return f"{declared[1]} {declared[2]} = {awake} ? {made}({other[3]}) : {made}({declared[3]});"
    return f"if ({awake}) {{ {faulty} }} else {{ {sound} }}"


def _start(text: str, at: int, ends: str) -> int:
    """After the last of `ends` that is not within brackets which end before."""
    depth = 0
    while at > 0 and not (depth <= 0 and text[at - 1] in ends):
        depth -= DEEPER.get(text[at - 1], 0)
        at -= 1
    return at


def _end(text: str, first: int, at: int, ends: str) -> int:
    """At the next of `ends` that is not within brackets; of a statement after it and what is its `else`."""
    depth = sum(DEEPER.get(one, 0) for one in text[first:at])
    at -= text[at - 1] == ";"
    while text[at] not in ends or depth > 0:
        depth += DEEPER.get(text[at], 0)
        at += 1
    if ends != ";":
        return at
    return _end(text, at, at + 1, ends) if re.match(r"\s*else\b", text[at + 1 :]) else at + 1
