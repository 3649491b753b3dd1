"""How the cost of one evaluation grows: chains, trees, cranes on one base, and rows of loops."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np

from seacrane import Frame, Model, Scene
from seacrane.crane import Payload

from .exponent import exponent
from .section import Section
from .timing import evaluation_ns

BODIES = (1, 3, 10, 30, 100, 300, 1000)
CRANES = (1, 2, 5, 15, 50, 100)
LARGE = 30  # the exponent is fitted from here on, where what every evaluation costs no longer shows
EVALUATIONS = 200_000  # over the number of bodies


def chain(bodies: int) -> Scene:
    """Links hinged end to end about turning axes."""
    return _linked(bodies, lambda i: i - 1)


def tree(bodies: int) -> Scene:
    """Links hinged as a binary tree."""
    return _linked(bodies, lambda i: (i - 1) // 2 if i else -1)


def _linked(bodies: int, parent: Callable[[int], int]) -> Scene:
    scene = Scene(name="linked")
    ends = {-1: np.zeros(3)}
    rng = np.random.default_rng(1)
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
                frames[0] = Frame(
                    point=np.array(joint.first_frame.point) + shift + [0.0, 0.0, 5.0],
                    axes=joint.first_frame.axes,
                )
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


def _compiled(scene: Scene) -> Model:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return scene.compile()


def _cost(scene: Scene, *, repeats: int, formulations: tuple[str, ...]) -> list[float]:
    model = _compiled(scene)
    count = max(20, EVALUATIONS // len(model.bodies) // 20)
    return [
        1e-3 * evaluation_ns(model, repeats=repeats, count=count, formulation=formulation)
        for formulation in formulations
    ]


def growth(*, repeats: int) -> Section:
    """Chains, trees and cranes of growing size, with the fitted exponents."""
    rows: list[list[Any]] = []
    for label, make, sizes in (
        ("chain", chain, BODIES), ("binary tree", tree, BODIES), ("cranes on one base", cranes, CRANES)
    ):  # fmt: skip
        bodies, costs = [], []
        for size in sizes:
            scene = make(size)
            bodies.append(len(scene.bodies))
            costs.append(_cost(scene, repeats=repeats, formulations=("recursive", "redundant")))
        slopes = [exponent(bodies, [c[k] for c in costs], LARGE) for k in range(2)]
        for size, n, (recursive, redundant) in zip(sizes, bodies, costs, strict=True):
            loops = 2 * size if make is cranes else 0
            rows.append([label, n, loops, recursive, redundant, redundant / recursive, None, None])
        rows[-1][-2:] = slopes
    return Section(
        title="Cost over the size of a scene",
        text=(
            "One evaluation, us, of bodies under gravity alone. Exponent: slope in logarithms from "
            f"{LARGE} bodies on; the aim for `recursive` is at most 1.1. A crane has nine bodies, two of its "
            "loops are cylinders, and none needs a constraint."
        ),
        head=["scene", "bodies", "cylinder loops", "recursive, us", "redundant, us",
              "redundant over recursive", "exponent, recursive", "exponent, redundant"],
        rows=rows,
    )  # fmt: skip


def loop_rows(*, repeats: int) -> Section:
    """Where a dense block for loops costs more than sparse elimination of all joints."""
    rows: list[list[Any]] = []
    for bodies in (10, 30, 100):
        for loops in (1, 2, 3, 5, 10, 20):
            if loops > bodies:
                continue
            scene = meshed(bodies, loops)
            recursive, redundant = _cost(scene, repeats=repeats, formulations=("recursive", "redundant"))
            rows.append([bodies, loops, recursive, redundant, redundant / recursive])
    return Section(
        title="Rows that close loops",
        text=(
            "One evaluation, us, of chains that rods tie to the ground, one row each. A row costs the "
            "recursive form a pass over the tree, and its share of a dense factorisation."
        ),
        head=["bodies", "rows", "recursive, us", "redundant, us", "redundant over recursive"],
        rows=rows,
    )
