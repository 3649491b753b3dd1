"""Random lifts in lanes: as alone, or kept apart with a reason, whatever they differ in."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from ensemble_studies import drifting_hull
from limit_scenes import limited
from marks import needs_lanes
from random_scenes import KINDS, Shape, build

from seacrane import Result, Run, Scene, SceneError, SeacraneError, Stage, Until, cases
from seacrane.ensembles.other_sea import with_sea
from seacrane.ensembles.study import _paths, with_values
from seacrane.run.interrupts import Interrupts
from seacrane.run.lanes import LiftsInLanes, advance_side_by_side
from seacrane.run.staged_run import StagedRun

pytestmark = [needs_lanes, pytest.mark.filterwarnings("ignore::UserWarning")]
T_END = 3.0
METHODS: list[dict[str, Any]] = [
    *({"rtol": 1e-9, "integrator": name} for name in ("dopri5", "tsit5", "dop853", "dopri5-stiff")),
    {"rtol": 1e-9, "integrator": "dopri5", "maximum_step": 0.05},
    {"integrator": "rk4", "dt": 0.01},
    {"integrator": "rk-low-storage", "dt": 0.01},
    {"integrator": "semi-implicit-euler", "dt": 0.01},
]
MEMORIES = ("per-pair", "per-pair", "by-motion", "convolution")
DRIFTING = drifting_hull()


def afloat(rng: np.random.Generator) -> Callable[[], Scene]:
    """A ship, with its crane and load or without, made anew at each call."""
    name = str(rng.choice(["vessel", "vessel", "case2"]))
    given = {
        "memory": str(rng.choice(MEMORIES)), "drift": bool(rng.integers(2)), "hs": float(rng.uniform(1, 4)),
        "count": 30,
    }  # fmt: skip

    def make() -> Scene:
        other = dict(given)
        if rng.random() < 0.4:
            other["drift"] = not given["drift"]
        if rng.random() < 0.1:
            other["memory"] = str(rng.choice(MEMORIES))
        scene: Scene = getattr(cases, name)(database=DRIFTING, seed=int(rng.integers(1, 9)), **other)
        if rng.random() < 0.5:
            words = {"hs": float(rng.uniform(1, 4)), "direction_deg": float(rng.uniform(0, 360))}
            scene = with_sea(scene, words)
        return scene

    return make


def tree(rng: np.random.Generator) -> Callable[[], Scene]:
    """Bodies in a tree of joints, with springs and actuators."""
    count = int(rng.integers(1, 5))
    shape = Shape(
        seed=int(rng.integers(2**32)), parents=tuple(int(rng.integers(-1, i)) for i in range(count)),
        kinds=tuple(str(kind) for kind in rng.choice(KINDS, count)),
        swapped=tuple(bool(one) for one in rng.integers(2, size=count)), decades=2.0,
        base=str(rng.choice(["ground", "floating", "vessel"])),
    )  # fmt: skip
    return lambda: build(shape)


def with_limits(rng: np.random.Generator) -> Callable[[], Scene]:
    seed = int(rng.integers(100))
    return lambda: limited(seed)[0]


def one_number_off(scene: Scene, rng: np.random.Generator) -> Scene:
    """One number of the description is another; itself where that is no scene."""
    path = str(rng.choice(_paths(scene)))
    table, rest = path.split(".", 1)
    name, attribute = rest.rsplit(".", 1)
    was = getattr(getattr(scene, table)[name], attribute)
    if isinstance(was, bool) or not isinstance(was, float | np.ndarray) or not np.size(was):
        return scene
    now = np.array(was, dtype=float)
    now.flat[int(rng.integers(now.size))] += 1e-3 * max(1.0, float(np.abs(now).max()))
    try:
        out = with_values(scene, {path: now if isinstance(was, np.ndarray) else float(now)})
        out.compile()
    except SceneError:
        return scene
    return out


def members(rng: np.random.Generator) -> list[Scene]:
    make = [afloat, afloat, afloat, tree, with_limits][int(rng.integers(5))](rng)
    scenes = [make() for _ in range(int(rng.integers(2, 5)))]
    return [one_number_off(scene, rng) if rng.random() < 0.1 else scene for scene in scenes]


def off(result: Result, alone: Result) -> float:
    """The largest difference of places and orientations, and of ends of stages, in two runs."""
    if result.time.shape != alone.time.shape:
        return np.inf
    moved = result.time[result.time != alone.time]
    if not np.isin(moved, [stage.end for stage in result.stages]).all():
        return np.inf
    ends = [abs(one.end - other.end) for one, other in zip(result.stages, alone.stages, strict=True)]
    return max(
        *(float(np.abs(result[name] - alone[name]).max()) for name in ("position", "quaternion")), *ends
    )


def staged(scenes: list[Scene], rng: np.random.Generator) -> list[Stage]:
    """Stages that end at times, or where a body of each is at a place; what acts on it may be let go."""
    loads = [name for name in scenes[0].loads if all(name in scene.loads for scene in scenes)]
    out = [Stage(name="first", duration=float(rng.uniform(0.2, 1.0)))]
    release = [str(rng.choice(loads))] if loads and rng.random() < 0.4 else []
    if rng.random() < 0.4:
        body, axis = str(rng.choice(list(scenes[0].bodies))), str(rng.choice(["x", "y", "z"]))
        place = scenes[0].bodies[body].position["xyz".index(axis)] + rng.uniform(-0.1, 0.1)
        until = [Until.channel("position", body=body, axis=axis, minimum=place),
                 Until.channel("position", body=body, axis=axis, maximum=place - 0.05)]  # fmt: skip
        out.append(Stage(name="until", until=until, maximum_duration=5.0, release=release))
    else:
        out.append(Stage(name="second", duration=float(rng.uniform(0.2, 1.0)), release=release))
    return [*out, Stage(name="last", duration=float(rng.uniform(0.2, 1.0)))]


def staged_told_of(seed: int) -> tuple[str, str]:
    """As `told_of`, of lifts in stages."""
    rng = np.random.default_rng(10**6 + seed)
    scenes, settings = described(rng)
    try:
        stages = staged(scenes, rng)
        lifts, alone = ([StagedRun(scene, stages, **settings) for scene in scenes] for _ in range(2))
        for lift in alone:
            while lift.advance():
                pass
    except SeacraneError as error:  # alone as well
        return f"no run: {type(error).__name__}", ""
    with Interrupts() as interrupts:
        assert LiftsInLanes([lift.runs(interrupts) for lift in lifts], 4, lambda _: None).advance()
    return compared([lift.result() for lift in lifts], [lift.result() for lift in alone], settings)


def told_of(seed: int) -> tuple[str, str]:
    """How the runs of a seed went, and what was wrong with it."""
    scenes, settings = described(np.random.default_rng(seed))
    try:
        runs, alone = [[Run(scene, T_END, **settings) for scene in scenes] for _ in range(2)]
        for run in alone:
            run.advance(T_END)
    except SeacraneError as error:  # alone as well
        return f"no run: {type(error).__name__}", ""
    assert advance_side_by_side(runs, 4, lambda _: None)
    for run in runs:
        run.advance(T_END)
    return compared([run.result() for run in runs], [run.result() for run in alone], settings)


def described(rng: np.random.Generator) -> tuple[list[Scene], dict[str, Any]]:
    scenes, method = members(rng), METHODS[int(rng.integers(len(METHODS)))]
    return scenes, {
        "dt_out": 0.25,
        "channels": ["position", "quaternion"],
        "formulation": "recursive",
    } | method


def compared(results: list[Result], alone: list[Result], settings: dict[str, Any]) -> tuple[str, str]:
    lanes = max(int(one.stats.get("lanes", 1)) for one in results)
    if any(one.stats.get("lanes", 1) == 1 and not one.stats.get("kept_apart") for one in results):
        return "apart", "no reason is told"
    apart = [off(one, single) for one, single in zip(results, alone, strict=True)]
    bound = 1e-6 if lanes > 1 else 0.0
    wrong = "" if max(apart) <= bound else f"{settings}: {apart} from alone, in {lanes} lanes"
    return "in lanes" if lanes > 1 else "apart", wrong


def judged(seeds: range, told_of: Any) -> tuple[Counter[str], dict[int, str]]:
    how, wrong = Counter[str](), {}
    for seed in seeds:
        went, bad = told_of(seed)
        how[went] += 1
        wrong |= {seed: bad} if bad else {}
    return how, wrong


MANY = pytest.mark.slow("hundreds of random lifts")


@pytest.mark.parametrize(
    ("of", "seeds", "least"),
    [
        (told_of, range(20), (3, 3)),
        (staged_told_of, range(10), (3, 2)),
        (told_of, range(1111, 1112), (1, 0)),  # steps of given length do not end where a strike ends others
        (staged_told_of, range(1086, 1087), (1, 0)),  # the same
        (staged_told_of, range(1044, 1045), (0, 1)),  # a stage without a sling has extremes of its own
        pytest.param(told_of, range(1000, 1400), (60, 60), marks=MANY),
        pytest.param(staged_told_of, range(1000, 1200), (30, 30), marks=MANY),
    ],
)
def test_random_members_in_lanes_are_as_alone_or_kept_apart(of: Any, seeds: range, least: Any) -> None:
    how, wrong = judged(seeds, of)
    assert wrong == {}
    assert how["in lanes"] >= least[0] and how["apart"] >= least[1], how
