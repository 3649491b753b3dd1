"""Colours of what is drawn, the same in pages, models and pictures."""

from __future__ import annotations

BODIES = {
    "crane": "#f0a818",
    "tower": "#e8e4da",
    "barrel": "#5b6670",
    "rod": "#c9d1d6",
    "payload": "#b5432f",
    "sheave": "#5b6670",
    "hub": "#c9d1d6",
    "drum": "#2f4a6b",
    "mark": "#ffe14d",
}
PLAIN = ("#7c6aa6", "#3f8f8a", "#b0793a", "#5578a8", "#8a8f3c", "#a65a7c")  # bodies of no other kind, in turn
HULL = {"above": "#2f5f86", "deck": "#93a58e", "below": "#8c3b32"}
WIRES = {
    "link": "#1b1f24",
    "wire": "#1b1f24",
    "spring": "#6a4fa0",
    "barrel": BODIES["barrel"],
    "rod": BODIES["rod"],
}
SLACK = "#e0701a"
TRACKS = {"tip": "#ffffff", "payload": "#ffe14d"}


def body_colour(part: str, role: str, number: int) -> str:
    """The colour of a part, else of its body's role, else one of the plain ones by the body's number."""
    return BODIES.get(part) or BODIES.get(role) or PLAIN[number % len(PLAIN)]


def rgb(colour: str) -> tuple[float, float, float]:
    """Red, green, blue of "#rrggbb", 0 to 1."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return red, green, blue
