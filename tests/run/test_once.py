"""What follows from a description is worked out once, and anew once the description holds something else."""

from __future__ import annotations

import copy
import pickle
import warnings
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import pytest

from seacrane import Curve, Scene, SceneError, cases, equilibrium, simulate
from seacrane.crane import load_crane, shipped_cranes
from seacrane.description.once import ANSWERS
from seacrane.description.pick import Pick
from seacrane.result import Result
from seacrane.scene import Waves
from seacrane.warnings import FreeCraneWarning

SHORT = {"t_end": 0.3, "dt_out": 0.1}
Told = list[tuple[type[Warning], str, int]]


def small() -> Scene:
    """A pendulum with a spring, a driver, a limit and a line."""
    scene = Scene(name="small")
    for i, name in enumerate(("bob", "slide", "load")):
        scene.add_body(name=name, mass=2e3, inertia=[5e2, 5e2, 5e2], position=(1.0 + 3.0 * i, 0.0, 0.0))
    scene.add_joint("hinge", kind="revolute", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0))
    scene.add_joint("rail", kind="prismatic", first="ground", second="slide", point=(4, 0, 0), axis=(1, 0, 0))
    scene.add_driver(joint="rail", curve=Curve.quintic(start_time=0.0, end_time=5.0, start=0.0, end=0.5))
    scene.add_channel(joint="hinge")
    scene.add_line("wire", bodies=["ground", "load"], points=[(7, 0, 10), (0, 0, 0)], EA=1e7, length=9.99)
    return scene


def held(rung: str = "auto") -> Scene:
    scene = Scene(name="held")
    scene.add_crane(base="ground", s1=1.5, s2=1.0)  # what nothing drives is held
    scene.add_hoist(mass=20e3, size=(4.0, 4.0, 3.0), EA=3e7, rung=rung)
    return scene


def run(scene: Scene, **given: Any) -> tuple[Result, Told]:
    """A short run, and what it warned of."""
    with warnings.catch_warnings(record=True, action="always") as told:
        result = simulate(scene, **(SHORT | given))
    return result, [(one.category, str(one.message), one.lineno) for one in told]


def same(one: tuple[Result, Told], other: tuple[Result, Told]) -> None:
    for name, values in other[0].items():
        assert one[0][name].tobytes() == values.tobytes(), name
    assert list(one[0]) == list(other[0])
    assert (one[0].coords, one[0].about) == (other[0].coords, other[0].about)
    counted, again = ({k: v for k, v in each[0].stats.items() if k != "wall_s"} for each in (one, other))
    assert counted == again
    assert one[1] == other[1]


SPRING = {"first_point": (0, 0, 3), "second_point": (0, 0, 0), "natural_length": 3.0}
SWING = Curve.quintic(start_time=0.0, end_time=5.0, start=0.0, end=0.3)
SPEED = {"channel": "velocity", "names": {"body": "bob", "axis": "z"}, "maximum": 1.0}
CHANGES: dict[str, Callable[[Scene], Any]] = {
    "another body": lambda s: s.add_body(name="more", mass=3.0, inertia=[1, 1, 1], position=(0, 5, 0)),
    "a body in its place": lambda s: s.replace("bob", mass=3e3),
    "a body put into the table": lambda s: s.bodies.update(bob=s.copy().replace("bob", mass=3e3)),
    "another load": lambda s: s.add_spring("spring", first="ground", second="bob", stiffness=1e4, **SPRING),
    "a load less": lambda s: s.remove("wire", kind="load"),
    "a driver less": lambda s: s.drivers.clear(),
    "another driver": lambda s: s.add_driver(joint="hinge", curve=SWING),
    "a limit": lambda s: s.add_stop(joint="hinge", minimum=-1.0, maximum=0.02),
    "a limit state": lambda s: s.add_limit_state(**SPEED),
    "a channel": lambda s: s.add_channel("twice", expression="2 * position[bob, z]"),
    "gravity": lambda s: setattr(s, "gravity", 1.6),
    "a name": lambda s: setattr(s, "name", "another"),
    "notes": lambda s: s.notes.update(weather="fair"),
    "tonnes for kg": lambda s: s.replace("bob", mass=1e-3),
    "tables in another order": lambda s: setattr(s, "bodies", dict(reversed(s.bodies.items()))),
}


@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_scene_is_looked_at_anew(change: str) -> None:
    scene, fresh = small(), small()
    before = run(scene)
    same(run(scene), before)
    CHANGES[change](scene)
    CHANGES[change](fresh)
    same(run(scene), run(fresh))


def test_another_sea_and_no_sea() -> None:
    scene = cases.case2()
    run(scene)
    for give in (
        lambda s: setattr(s, "waves", cases.case2(hs=4.0).waves),
        lambda s: setattr(s, "waves", None),
        lambda s: s.add_sea(hs=3.0, tp=9.0, direction_deg=90.0, seed=4),
    ):
        fresh = cases.case2()
        give(scene)
        fresh.waves = None
        give(fresh)
        same(run(scene), run(fresh))


@pytest.mark.parametrize("rung", ["auto", "quasi-static"])
def test_a_crane_that_is_let_go(rung: str) -> None:
    """Lines are settled anew; held drives are added once, and give way to one that is described."""
    scene, fresh = held(rung), held(rung)
    for _ in range(2):
        same(run(scene), run(fresh))
    slew = scene.roles[""].slew
    for one in (scene, fresh):
        one.replace("hoist", kind="load", EA=2e5)
    same(run(scene), run(fresh))
    for one in (scene, fresh):
        one.add_driver(joint=slew[0], coordinate=slew[1], curve=SWING)
    same(run(scene), run(fresh))
    assert len(scene.drivers) == 1  # what is held stands in the run's scene alone


def test_another_start() -> None:
    scene = small()
    run(scene)
    given = {"start": simulate(scene, 1.0).state, "t_end": 1.3}
    same(run(scene, **given), run(small(), **given))
    rest = held("elastic")
    run(rest)
    same(run(rest, start=equilibrium(rest)), run(held("elastic"), start=equilibrium(held("elastic"))))


def test_errors_come_where_they_came() -> None:
    scene = small()
    run(scene)
    scene.add_channel(joint="rail", minimum=-0.1, maximum=0.1)
    for _ in range(2):
        with pytest.raises(SceneError, match="outside its range"):
            simulate(scene, 5.0)
    simulate(scene, 0.3)


def test_warnings_come_at_each_run() -> None:
    scene = Scene(name="loose")
    scene.add_crane(base="ground", s1=1.5, s2=1.0, held=False)
    scene.add_hoist(mass=20e3, size=(4.0, 4.0, 3.0), EA=3e7, rung="elastic")
    first = run(scene)
    assert [category for category, *_ in first[1]].count(FreeCraneWarning) == 1
    for _ in range(2):
        same(run(scene), first)


def test_a_copy_shares_what_is_known_until_it_differs() -> None:
    scene = small()
    model = scene.compile()
    copy = scene.copy()
    assert scene.compile() is model is copy.compile()
    copy.replace("bob", mass=3e3)
    assert copy.compile() is not model and scene.compile(merge=False) is not model
    assert scene.compile() is model
    result = simulate(scene, 0.1)
    assert ANSWERS in vars(scene)  # what is kept for long holds no model
    assert ANSWERS not in vars(result.scene)
    assert ANSWERS not in vars(pickle.loads(pickle.dumps(scene)))


def test_a_sea_is_not_written_into() -> None:
    phase = np.zeros(1)
    waves = Waves(omega=np.ones(1), amplitude=np.ones(1), phase=phase, direction=np.zeros(1), hulls={})
    phase[0] = 1.0
    assert waves.phase[0] == 0.0
    with pytest.raises(ValueError, match="read-only"):
        pickle.loads(pickle.dumps(waves)).phase[0] = 1.0


def held_by(value: Any) -> Iterator[Any]:
    """All within it."""
    yield value
    own = [*value.values()] if isinstance(value, Mapping) else [*getattr(value, "__dict__", {}).values()]
    for one in value if isinstance(value, list | tuple) else own:
        yield from held_by(one)


@pytest.mark.parametrize("name", shipped_cranes())
def test_a_crane_that_scenes_share_is_not_written_into(name: str) -> None:
    assert load_crane(name) is load_crane(name)
    data = load_crane(name).data
    within = list(held_by(data))
    arrays = [one for one in within if isinstance(one, np.ndarray)]
    for array in arrays:
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 1.0
    for mapping in (one for one in within if isinstance(one, Mapping)):
        with pytest.raises(TypeError, match="read-only"):
            mapping["slew"] = ""
    assert len(arrays) >= 4 * len(data.bodies)


def test_mappings_of_a_description_are_not_written_into() -> None:
    """A crane's parts, a sea's hulls, a limit's and a channel's names, sources: none changes in place."""
    scene = cases.case2()
    limit = scene.add_limit_state("slew_torque", name="hold", maximum=1e6)
    factors = scene.add_lift_factors("payload", skew_load=1.25, sources={"skew_load": "weighed"})
    mappings = [scene.roles[""].cylinders, scene.roles[""].ropes, scene.waves.hulls, limit.names]
    mappings += [factors.sources, Pick(channel="tip", names={"a": "b"}).names]
    changes = {"__setitem__": ("a", 1), "update": ({"a": 1},), "pop": ("a", None), "setdefault": ("a", 1),
               "clear": (), "popitem": (), "__ior__": ({"a": 1},), "__delitem__": ("a",)}  # fmt: skip
    for mapping in mappings:
        for one in (mapping, copy.copy(mapping), copy.deepcopy(mapping), pickle.loads(pickle.dumps(mapping))):
            for change, given in changes.items():
                with pytest.raises(TypeError, match="read-only"):
                    getattr(one, change)(*given)
            assert type(one) is type(mapping) and list(one) == list(mapping)
