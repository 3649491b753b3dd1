"""The error that a fitted fluid memory leaves in a run, carried linearly, against runs by convolution."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane import Scene, SceneError, cases, simulate
from seacrane.accuracy import model_error
from seacrane.description.databases import without_databases
from seacrane.hydro import shipped_database
from seacrane.warnings import ModelErrorWarning

SEA = {"hs": 0.2, "tp": 9.0, "count": 40}


def by_convolution(scene: Scene) -> Scene:
    """The same vessel and springs with the retardation functions in place of the fit."""
    out = cases.vessel(memory="convolution", **SEA)
    fields = out.vessels["vessel"].__getstate__()
    for name in ("mooring_stiffness", "mooring_damping"):
        fields[name] = getattr(scene.vessels["vessel"], name)
    out.vessels["vessel"] = type(out.vessels["vessel"])(**fields)
    return out


@pytest.mark.parametrize(("memory", "nearness"), [("per-pair", 0.2), ("by-motion", 0.4)])
def test_it_is_the_difference_of_two_runs(memory: str, nearness: float) -> None:
    """In every motion, the slow ones of the springs included; heave, roll and pitch to a tenth."""
    scene = cases.vessel(memory=memory, **SEA)
    options = {"t_end": 40.0, "dt_out": 0.25, "rtol": 1e-8, "channels": ["vessel_motion"]}
    run, truth = simulate(scene, **options), simulate(by_convolution(scene), **options)
    apart = np.abs(run["vessel_motion"] - truth["vessel_motion"]).reshape(-1, 6).max(axis=0)
    found = model_error(scene, body="vessel", times=run.time)
    np.testing.assert_allclose(found.largest, apart, rtol=nearness, atol=3e-6)
    assert found.largest[2] / apart[2] == pytest.approx(1.0, abs=0.1)
    np.testing.assert_allclose(found.error[0], 0.0, atol=1e-12)
    assert np.abs(found.motion).max() > 50.0 * found.largest[2]


def test_a_run_to_an_accuracy_tells_it_beside_its_own_error() -> None:
    scene = cases.vessel(memory="per-pair", **SEA)
    options = {"t_end": 20.0, "dt_out": 0.5}
    with pytest.warns(
        ModelErrorWarning, match=r"roll of 1e-06 was asked, .* leaves an error of \d.*by-motion"
    ):
        result = simulate(scene, accuracy={"roll": 1e-6}, **options)
    assert result.stats["error_estimate_roll"] <= 1e-6
    expected = model_error(scene, body="vessel", times=result.time).largest[3]
    assert result.stats["model_error_roll"] == pytest.approx(expected, rel=0.02)
    wide = simulate(scene, accuracy={"roll": 1e-3}, **options)
    assert wide.stats["model_error_roll"] == pytest.approx(expected, rel=0.02)


def test_a_memory_by_motion_is_to_be_fitted_closer() -> None:
    scene = cases.vessel(memory="by-motion", **SEA)
    with pytest.warns(ModelErrorWarning, match=r"a memory by-motion of a smaller limit, or memory='convol"):
        simulate(scene, t_end=5.0, dt_out=0.5, accuracy={"roll": 1e-7})


def test_nothing_is_told_where_nothing_is_known() -> None:
    """A convolution fits nothing, and calm water moves nothing."""
    for scene in (cases.vessel(memory="convolution", **SEA), cases.vessel(hs=0.0)):
        result = simulate(scene, t_end=5.0, dt_out=0.5, accuracy={"roll": 1e-3})
        assert "model_error_roll" not in result.stats


def test_what_it_needs_is_named() -> None:
    scene, times = cases.vessel(**SEA), np.arange(0.0, 5.0, 0.5)
    with pytest.raises(SceneError, match="needs waves on one vessel"):
        model_error(cases.vessel(hs=0.0), body="vessel", times=times)
    with pytest.raises(SceneError, match="has no fitted memory"):
        model_error(cases.vessel(memory="convolution", **SEA), body="vessel", times=times)
    with pytest.raises(SceneError, match="times do not increase"):
        model_error(scene, body="vessel", times=times[::-1])
    with pytest.raises(SceneError, match="give at most 3600 s"):
        model_error(scene, body="vessel", times=[0.0, 4000.0])


def test_a_vessel_of_its_matrices_needs_its_database() -> None:
    scene, times = cases.vessel(**SEA), np.arange(0.0, 10.0, 0.5)
    expected = model_error(scene, body="vessel", times=times)
    bare = without_databases(scene)
    with pytest.raises(SceneError, match="has no database, which the error of its memory needs"):
        model_error(bare, body="vessel", times=times)
    bare.replace("vessel", kind="vessel", database=shipped_database())
    given = model_error(bare, body="vessel", times=times)
    np.testing.assert_array_equal(given.largest, expected.largest)


def test_results_and_files_state_what_the_memory_changes(tmp_path: Path) -> None:
    scene = cases.vessel(memory="by-motion", **SEA)
    known = scene.provenance["vessel"].memory_error
    assert known is not None
    assert 0.0 < known <= 0.01
    result = simulate(scene, t_end=1.0)
    assert result.settings["memory_error"] == known
    assert "memory_error" not in simulate(cases.vessel(**SEA), t_end=1.0).settings
    scene.save(tmp_path / "by_motion.json")
    assert Scene.load(tmp_path / "by_motion.json").provenance["vessel"].memory_error == known
    cases.vessel(**SEA).save(tmp_path / "per_pair.json")
    assert Scene.load(tmp_path / "per_pair.json").provenance["vessel"].memory_error is None
