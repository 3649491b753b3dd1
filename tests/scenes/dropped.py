"""Bodies that fly freely into surfaces of all shapes, and where a parabola meets them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from seacrane import Scene, simulate

GRAVITY = 9.80665
SHAPES = ("plane", "box", "post", "pipe", "seabed")
FINEST = {"rosenbrock": -6.0, "bs32": -7.0}  # powers of ten, rtol
METHODS = (  # the default more often
    "dopri5", "tsit5", "dop853", "verner65", "bs32", "rosenbrock", "dopri5-stiff", "dopri5", "cvode-bdf",
    "ida",
)  # fmt: skip
ROUGH = ("cvode-bdf", "ida")
AT_END = 2e-6  # of a step: a touch so near to its end is at it


@dataclass(frozen=True)
class Drop:
    """A body, one point of it, a surface of the ground, how it is stepped; when and how fast they meet."""

    scene: Scene
    how: dict[str, Any]
    end: float
    thick: float
    met: tuple[float, float]

    def misses(self) -> str:
        """What is wrong with the first contact of a run; empty: nothing."""
        result = simulate(self.scene, self.end, channels=["contact_gap"], dt_out=0.002, **self.how)
        hits = [one for one in result.events if one.kind == "contact"]
        time, speed = self.met
        if not hits:
            return f"steps over {self.thick:.3g} m at t = {time:.6g} s, with {speed:.4g} m/s"
        late, fast = hits[0].time - time, hits[0].speed - speed
        off = 1e-5 + (2e3 if self.how["integrator"] in ROUGH else 100.0) * self.how["rtol"]  # m
        round_edge = min(0.05, 0.5 * self.thick)
        if abs(late) * speed > off + AT_END * time * speed or abs(fast) > off * (1.0 + 30.0 / round_edge):
            return f"touches {late:.3g} s late, {fast:.3g} m/s too fast"
        deepest = -float(result["contact_gap"].min())
        if deepest > 0.45 * self.thick:
            return f"sinks {deepest:.3g} m into {self.thick:.3g} m, met with {speed:.4g} m/s"
        return ""


def drops(seed: int, count: int) -> Iterator[Drop]:
    """Random ones that come in at 0.5 m/s at least, onto what is 3 cm thick or more."""
    rng = np.random.default_rng(seed)
    while count > 0:
        one = _drop(rng, SHAPES[count % len(SHAPES)])
        if one is not None:
            count -= 1
            yield one


def _drop(rng: np.random.Generator, shape: str) -> Drop | None:
    method = METHODS[rng.integers(len(METHODS))]
    speed = rng.uniform(0.5, 20.0)
    thick = float(np.exp(rng.uniform(np.log(0.03), np.log(3.0))))
    axis = rng.normal(size=3)
    axis /= np.linalg.norm(axis)
    place = rng.uniform(-5.0, 5.0, 3)
    flies = rng.uniform(0.05, 3.0)
    velocity = rng.normal(size=3)
    velocity *= speed / np.linalg.norm(velocity)
    gravity = GRAVITY if shape == "seabed" else GRAVITY * float(rng.integers(0, 2))
    down = np.array([0.0, 0.0, -gravity])
    position = place + rng.uniform(-0.5, 0.5, 3) * thick - velocity * flies + 0.5 * down * flies**2
    began = velocity - down * flies
    scene = Scene(name=f"drop onto a {shape}", gravity=gravity)
    scene.add_body("ball", mass=500.0, inertia=(300.0, 400.0, 500.0), position=position, velocity=began)
    frictions = (0.0,) if method == "ida" else (0.0, 0.4)
    contact = _surface(scene, rng, shape, thick, axis, place, frictions)
    met = _met(contact, position, began, down, flies + 1.0, thick)
    if met is None:
        return None
    # What rosenbrock and bs32 cannot hold but by thousands of steps, and how far the rough ones err.
    finest, coarsest = FINEST.get(method, -8.0), -4.0 if method in ROUGH else -2.0
    how = {"integrator": method, "rtol": float(10.0 ** rng.uniform(finest, coarsest))}
    how["formulation"] = "redundant" if method == "ida" else ("recursive", "redundant")[rng.integers(2)]
    least = {"box": float(min(contact.size)), "post": float(min(contact.size[1:])), "pipe": thick}
    return Drop(scene, how, met[0] + rng.uniform(0.1, 1.0), least.get(shape, np.inf), met)


def _surface(
    scene: Scene, rng: np.random.Generator, shape: str, thick: float, axis: Any, place: Any, frictions: Any
) -> Any:
    common: dict[str, Any] = {"points": [(0.0, 0.0, 0.0)], "stiffness": 500.0 * GRAVITY / 0.01, "name": "met"}
    common |= {"friction": float(rng.choice(frictions))}
    if shape == "seabed":
        return scene.add_contact("ball", on="ground", place=(0.0, 0.0, -5.0), **common)
    sizes = {
        "plane": None, "box": thick * rng.uniform(1.0, 20.0, 3),
        "post": thick * np.array([1.0, rng.uniform(1.0, 20.0)]),
        "pipe": thick * np.array([rng.uniform(1.0, 5.0), 0.0, rng.uniform(1.0, 10.0)]),
    }  # fmt: skip
    size = sizes[shape]
    if shape == "pipe" and size is not None:
        size[1] = size[0] + 2.0 * thick
    return scene.add_contact("ball", on="ground", surface=shape, axis=axis, place=place, size=size, **common)


def _met(
    contact: Any,
    position: NDArray[Any],
    velocity: NDArray[Any],
    down: NDArray[Any],
    until: float,
    thick: float,
) -> tuple[float, float] | None:
    """When the parabola comes inside first, and how fast; nothing where it grazes, or starts inside."""
    axes, place = np.asarray(contact.axes), np.asarray(contact.place)

    def beside(t: float) -> tuple[float, NDArray[Any]]:
        gap, way = contact.distance(axes.T @ (position + velocity * t + 0.5 * down * t**2 - place))
        return gap, axes @ way

    fastest = float(np.linalg.norm(velocity) + np.linalg.norm(down) * until)
    before, t = 0.0, 0.0
    while (gap := beside(t)[0]) > 0.0:
        before, t = t, t + max(gap, min(0.1 * thick, 0.01)) / fastest
        if t > until:
            return None
    if t == 0.0:
        return None
    time = float(brentq(lambda t: beside(t)[0], before, t, xtol=1e-13))
    speed = -float(beside(time)[1] @ (velocity + down * time))
    return (time, speed) if speed > 0.5 else None
