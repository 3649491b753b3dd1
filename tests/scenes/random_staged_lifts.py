"""Random lifts in stages: a load goes up and down on its winch through the water, onto the bed and off."""

from __future__ import annotations

from typing import Any

import numpy as np

from seacrane import Scene, Stage, Until
from seacrane.hydro import BoxPart

MASS, HIGH, BED = 20e3, 8.0, -7.0  # kg; m, where the load hangs at first, and the bed below the sea
HALF = 1.0  # m, of the load's height
MOST_STAGES = 6


def hanging() -> Scene:
    """A load on a winch, above the sea and its bed."""
    scene = Scene(name="random lift")
    scene.add_body("load", mass=MASS, size=(4.0, 3.0, 2.0 * HALF), position=(0.0, 0.0, HIGH))
    scene.add_line("wire", first="ground", first_point=(0, 0, 40), second="load", EA=1e8,
                   damping_ratio=0.2, tension_at_start=MASS * scene.gravity)  # fmt: skip
    scene.add_winch("wire", lag=0.2)
    feet = [(x, y, -HALF) for x in (-2.0, 2.0) for y in (-1.5, 1.5)]
    scene.add_contact("load", on="ground", points=feet, place=(0.0, 0.0, BED), friction=0.3, name="feet")
    scene.add_immersed("load", parts=[BoxPart(size=(4.0, 3.0, 2.0 * HALF), fill=0.4)])
    return scene


class _Planner:
    """Draws stages, each of which goes on from where the one before ends."""

    def __init__(self, seed: int) -> None:
        self._random = np.random.default_rng(seed)
        self.place, self.lies = HIGH, False  # m, of the load; whether it lies on the bed
        self.stages: list[Stage] = []

    def draw(self) -> list[Stage]:
        """Two to six stages."""
        for _ in range(self._random.integers(2, MOST_STAGES + 1)):
            kinds = [self._release, self._clear] if self.lies else [
                self._down, self._up, self._up, self._touch, self._touch, self._run, self._stop
            ]  # fmt: skip
            kinds[self._random.integers(len(kinds))]()
        return self.stages

    def _add(self, what: str, rate: float, **ends: Any) -> None:
        longest = {"maximum_duration": 200.0} if "until" in ends else {}
        name = f"{len(self.stages)} {what}"
        self.stages.append(Stage(name=name, commands={"wire.rate": rate}, **ends, **longest))

    def _rate(self) -> float:
        return float(self._random.uniform(0.2, 0.6))

    def _reach(self, place: float) -> Any:
        """A condition that is met at a place of the load: on a channel, a depth or a length."""
        side = "minimum" if place > self.place else "maximum"
        kind = self._random.integers(3)
        if kind == 0:
            return Until.channel("position", body="load", axis="z", **{side: place})
        if kind == 1:
            return Until.depth("load", **{"maximum" if side == "minimum" else "minimum": HALF - place})
        return Until.length("wire", **{"maximum" if side == "minimum" else "minimum": 40.0 - place})

    def _down(self) -> None:
        place = float(self._random.uniform(BED + HALF + 1.5, max(self.place - 1.0, BED + HALF + 2.0)))
        self._add("to a place", np.sign(self.place - place) * self._rate(), until=self._reach(place))
        self.place = place

    def _up(self) -> None:
        place = float(self._random.uniform(self.place + 1.0, self.place + 5.0))
        self._add("up", -self._rate(), until=self._reach(place))
        self.place = place

    def _touch(self) -> None:
        self._add("touch", self._rate(), until=Until.contact("feet"))
        self.place, self.lies = BED + HALF, True

    def _release(self) -> None:
        self._add("off", -self._rate(), until=Until.release("feet"))
        self.lies = False

    def _clear(self) -> None:
        by = float(self._random.uniform(0.5, 2.0))
        self._add("clear", -self._rate(), until=Until.clear("feet", minimum=by))
        self.place, self.lies = self.place + by, False

    def _run(self) -> None:
        rate, span = -self._rate(), float(self._random.uniform(3.0, 8.0))
        self._add("for a time", rate, duration=span)
        self.place -= rate * span

    def _stop(self) -> None:
        self._add("stop", 0.0, duration=float(self._random.uniform(2.0, 5.0)))


def random_stages(seed: int) -> list[Stage]:
    """Stages of `hanging`."""
    return _Planner(seed).draw()
