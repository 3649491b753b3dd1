"""How the cost of one evaluation grows: chains, trees, cranes on one base, and rows that close loops."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from seacrane import Frame, Scene
from seacrane.crane import Payload

from .section import Section
from .sources import STEPS
from .timing import evaluation_ns

BODIES = (1, 3, 10, 30, 100, 300, 1000)
CRANES = (1, 5, 15, 50, 100)
MESHED, ROWS = 30, (1, 3, 10, 20)
LARGE = 30  # the exponent is fitted from here on, where what every evaluation costs no longer shows
EVALUATIONS = 100_000  # over the number of bodies
REPEATS = 3


def exponent(sizes: Sequence[float], costs: Sequence[float], smallest: float) -> float:
    """Slope of the cost over the size in logarithms, from the smallest size that counts on."""
    x, y = np.array(sizes, dtype=float), np.array(costs, dtype=float)
    large = x >= smallest
    return float(np.polyfit(np.log(x[large]), np.log(y[large]), 1)[0])


def chain(bodies: int) -> Scene:
    """Links hinged end to end about turning axes."""
    return _linked(bodies, lambda i: i - 1)


def tree(bodies: int) -> Scene:
    """Links hinged as a binary tree."""
    return _linked(bodies, lambda i: (i - 1) // 2 if i else -1)


def _linked(bodies: int, parent: Callable[[int], int]) -> Scene:
    scene, rng = Scene(name="linked"), np.random.default_rng(1)
    ends = {-1: np.zeros(3)}
    for i in range(bodies):
        start = ends[parent(i)]
        arm = rng.normal(size=3)
        arm /= np.linalg.norm(arm)
        ends[i] = start + arm
        scene.add_body(name=f"link {i}", mass=1.0, inertia=(0.1, 0.1, 0.1), position=start + 0.5 * arm)
        scene.add_joint(
            kind="revolute", name=f"hinge {i}", first=f"link {parent(i)}" if parent(i) >= 0 else "ground",
            second=f"link {i}", point=start, axis=np.cross(arm, rng.normal(size=3)),
        )  # fmt: skip
    return scene


def cranes(count: int) -> Scene:
    """Cranes with a payload and two cylinders each, side by side on one floating base: nine bodies each."""
    scene = Scene(name="cranes")
    scene.add_body(name="base", mass=1e7, inertia=(1e9, 1e9, 1e9), position=(0.0, 0.0, -5.0))
    one = Scene()
    one.add_crane(base="ground", payload=Payload(), damping=False)
    for i in range(count):
        shift = np.array([0.0, 50.0 * i, 0.0])
        for name, body in one.bodies.items():
            scene.add_body(
                name=f"{name} {i}", mass=body.mass, inertia=body.inertia, center_of_mass=body.center_of_mass,
                position=np.array(body.position) + shift, quaternion=body.quaternion,
            )  # fmt: skip
        for joint in one.joints.values():
            frames = [joint.first_frame, joint.second_frame]
            names = ["base" if body == "ground" else f"{body} {i}" for body in (joint.first, joint.second)]
            if joint.first == "ground":
                point = np.array(joint.first_frame.point) + shift + [0.0, 0.0, 5.0]
                frames[0] = Frame(point=point, axes=joint.first_frame.axes)
            scene.add_joint(
                kind=joint.kind, name=f"{joint.name} {i}", first=names[0], second=names[1],
                first_frame=frames[0], second_frame=frames[1], **joint.parameters,
            )  # fmt: skip
    return scene


def meshed(bodies: int, loops: int) -> Scene:
    """The chain with rods of no mass from links to the ground: one row each."""
    scene = chain(bodies)
    for k in range(loops):
        body = f"link {(k + 1) * bodies // loops - 1}"
        at = np.array(scene.bodies[body].position)
        scene.add_joint(
            kind="distance", name=f"rod {k}", first="ground", second=body, second_point=at,
            point=at + np.array([0.3, 0.5 + k, 1.0]),
        )  # fmt: skip
    return scene


def _cost(scene: Scene) -> list[float]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        model = scene.compile()
    count = max(20, EVALUATIONS // len(model.bodies) // 20)
    return [
        1e-3 * evaluation_ns(model, repeats=REPEATS, count=count, formulation=formulation)
        for formulation in ("recursive", "redundant")
    ]


def growth() -> Iterator[list[Any]]:
    """Scenes of growing size, the exponents in the last row of each; a chain with more and more rods."""
    for label, make, sizes in (
        ("chain", chain, BODIES), ("binary tree", tree, BODIES), ("cranes on one base", cranes, CRANES)
    ):  # fmt: skip
        scenes = [make(size) for size in sizes]
        bodies = [len(scene.bodies) for scene in scenes]
        costs = [_cost(scene) for scene in scenes]
        slopes = [exponent(bodies, [cost[k] for cost in costs], LARGE) for k in range(2)]
        for i, (n, cost) in enumerate(zip(bodies, costs, strict=True)):
            last = slopes if i == len(bodies) - 1 else [None, None]
            yield [label, n, None, *cost, cost[1] / cost[0], *last]
    for rods in ROWS:
        cost = _cost(meshed(MESHED, rods))
        yield ["chain with rods", MESHED, rods, *cost, cost[1] / cost[0], None, None]


SECTION = Section(
    title="Cost over the size of a scene",
    text=(
        f"One evaluation, us, of bodies under gravity alone. Exponent: slope in logarithms from {LARGE} "
        "bodies on; the aim for `recursive` is at most 1.1. A crane has nine bodies and two cylinders, "
        "whose loops need no constraint. A rod from a link to the ground is a row: it costs the recursive "
        "form a pass over the tree, and its share of a dense factorisation."
    ),
    head=["scene", "bodies", "rows", "recursive, us", "redundant, us", "redundant over recursive",
          "exponent, recursive", "exponent, redundant"],
    rows=growth,
    sources=STEPS,
)  # fmt: skip
