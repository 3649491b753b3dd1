"""Scenes, their elements, models and states are copied, pickled and compared by value."""

from __future__ import annotations

import copy
import ctypes
import dataclasses
import inspect
import pickle
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from test_elements import every_load

from seacrane import Curve, Result, Run, Scene, SceneError, _core, cases, simulate
from seacrane.hydro import two_barges


def all_kinds() -> Scene:
    """And what has no other kind: channels of a user, limit states, lift factors, vessels in one water."""
    scene = every_load()
    scene.add_friction(joint="pin", load=1.0 / 3.0, speed=0.1)
    scene.add_channel(joint="pin", minimum=-2.0, maximum=2.0)
    scene.add_limit_state(channel="position", maximum=9.0, names={"body": "hull"})
    scene.add_channel("gap", points="corner", center=(1.0, 2.0, 1.0 / 3.0), size=(3.0, 0.0, 1.0))
    scene.add_channel("itself", expression="corner.x in hull")
    scene.add_channel(name="drop", expression="corner.z - hull.z")
    scene.add_limit_state(channel="constraint_error", maximum=1e-6)
    scene.add_line("rated", "hull", "arm", EA=1e6, length=1.0, breaking_load=1e5, safety_factor=5.0)
    scene.add_lift_factors("arm", weight_contingency=1.0 + 1.0 / 3.0)
    scene.add_vessel(two_barges(lid_damping=0.03), names=["crane barge", "feeder barge"])
    return scene


def pickled(value: Any) -> Any:
    return pickle.loads(pickle.dumps(value))


COPIES = {"pickle": pickled, "deepcopy": copy.deepcopy, "copy": copy.copy}


@pytest.mark.parametrize("how", COPIES)
def test_a_copied_scene_moves_alike_to_the_bit(how: str) -> None:
    scene = cases.case2(memory="convolution")
    one, two = (simulate(each, t_end=1.0) for each in (scene, COPIES[how](scene)))
    for name, values in one.channels.items():
        assert np.array_equal(values, two[name]), name
    assert one.state == two.state


@pytest.mark.parametrize("how", COPIES)
def test_every_kind_is_copied_by_value(how: str) -> None:
    scene = all_kinds()
    assert COPIES[how](scene) == scene
    for field in dataclasses.fields(Scene):
        table = getattr(scene, field.name)
        assert table or not isinstance(table, dict) or field.name in ("notes", "function_forces"), field.name


@pytest.mark.parametrize("how", [*COPIES.values(), Scene.copy, dataclasses.replace])
def test_copies_are_independent(how: Any) -> None:
    scene = cases.case2()
    scene.notes["list"] = [1]
    other = how(scene)
    for field in dataclasses.fields(Scene):
        table = getattr(other, field.name)
        if isinstance(table, dict) and field.name != "notes":
            table.clear()
    other.notes["list"].append(2)
    assert len(scene.bodies) == 10
    assert scene.notes["list"] == [1]
    assert other != scene and scene != cases.case2(seed=2)


def described_classes() -> list[type]:
    """Classes of the core that are made by named arguments and come back from a pickle."""
    found = [one for one in vars(_core).values() if isinstance(one, type) and hasattr(one, "__setstate__")]
    assert len(found) >= 19
    return [one for one in found if "__init__" in vars(one)]


@pytest.mark.parametrize("kind", described_classes(), ids=lambda kind: kind.__name__)
def test_what_is_pickled_is_all_that_the_constructor_takes(kind: type) -> None:
    """A new argument must not get lost on the way."""
    told = re.search(r"__init__\(self[^,)]*(.*)\) -> None", kind.__init__.__doc__ or "")
    scene = all_kinds()
    run = Run(cases.case2(memory="convolution"), t_end=1.0)
    run.advance(0.5)
    state = run.state
    memories = run.scene.vessels["vessel"].memory, cases.vessel().vessels["vessel"].memory[0]
    frame = next(iter(scene.joints.values())).first_frame
    samples = [state, state.steps, state.record, *state.histories, *memories, frame, Curve.constant(value=1)]
    samples += [kind.example() for kind in _core.LOAD_KINDS.values() if hasattr(kind, "example")]
    for field in dataclasses.fields(Scene):
        if isinstance(getattr(scene, field.name), dict):
            samples += getattr(scene, field.name).values()
    (sample, *_) = [one for one in samples if type(one) in (kind, *kind.__subclasses__())]
    if kind is not Curve:  # made by Curve.pieces
        own = inspect.signature(type(sample)).parameters if type(sample) is not kind else {}
        taken = {*re.findall(r", (\w+): ", told.group(1)), *(one for one in own if one != "matrices")}
        assert set(sample.__getstate__()) == taken
    assert pickled(sample) == sample
    assert hash(pickled(sample)) == hash(sample)
    assert sample != 3


CHILD = """
import pickle, sys
import numpy as np
from seacrane import Run
scene, model, state = pickle.load(open(sys.argv[1], "rb"))
run = Run(scene, model=model, start=state, t_end=2.0)
run.advance(2.0)
pickle.dump(run.state, open(sys.argv[1], "wb"))
"""


def test_scene_model_and_state_reach_another_process(tmp_path: Path) -> None:
    scene = cases.case2()
    run = Run(scene, t_end=2.0)
    run.advance(1.0)
    path = tmp_path / "run.pickle"
    path.write_bytes(pickle.dumps((scene, run.model, run.state)))
    subprocess.run([sys.executable, "-c", CHILD, str(path)], check=True)
    run.advance(2.0)
    assert pickle.loads(path.read_bytes()) == run.state
    result = simulate(cases.case1(), t_end=1.0)
    for again in (pickled(result), Result.load(result.save(tmp_path / "one.nc"))):
        assert again.state == result.state
    model = scene.compile(merge=False)
    scene.bodies.clear()  # a model is that which was compiled
    assert np.array_equal(pickled(model).initial_state, model.initial_state)
    assert pickled(model).merge == model.merge and copy.deepcopy(model) is model


def test_c_functions_are_copied_here_and_refused_elsewhere() -> None:
    kind = ctypes.CFUNCTYPE(None, ctypes.c_double, *[ctypes.POINTER(ctypes.c_double)] * 3)
    function = kind(lambda t, state, parameters, wrench: None)
    scene = Scene()
    scene.add_body(name="box", mass=1.0, inertia=(1.0, 1.0, 1.0))
    scene.add_force("box", name="pull", force=function)
    assert copy.deepcopy(scene) == scene
    with pytest.raises(SceneError, match="function force 'pull': its C function has no address in another"):
        pickle.dumps(scene)
