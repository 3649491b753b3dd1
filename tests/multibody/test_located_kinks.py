"""Bounds that are located: steps begin on their new side, by every method, and go on bit for bit."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from seacrane import Curve, Run, Scene, State, integrator_names, simulate

Array = NDArray[np.float64]
G = 9.80665
STEPPING = {"semi-implicit-euler": 1e-3, "rk4": 0.02, "rk-low-storage": 0.02}
# Those that lose much by a restart go across by their step control; Newton of generalized-alpha finds no step
# across a jump.
ACROSS = ("cvode-adams", "cvode-bdf", "ida", "ark-dirk", "generalized-alpha")


def hoisted(*, rate: Curve | float = -0.5, minimum: float = 9.5, lag: float = 0.0) -> Scene:
    """A load of 10 t whose winch hauls in to its end."""
    scene = Scene(name="hoist")
    scene.add_body(name="load", mass=1e4, inertia=(1e4, 1e4, 1e4), position=(0, 0, -10.0))
    scene.add_line(
        name="hoist", bodies=["ground", "load"], points=np.zeros((2, 3)), EA=1e7,
        tension_at_start=1e4 * G, damping_ratio=0.0,
    )  # fmt: skip
    scene.add_winch(line="hoist", rate=rate, minimum_length=minimum, lag=lag)
    return scene


def lengths(scene: Scene, **settings: Any) -> Array:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return np.asarray(simulate(scene, 4.0, dt_out=0.1, **settings)["line_unstretched_length"])[:, 0]


@pytest.mark.parametrize("name", [name for name in integrator_names() if name not in ACROSS])
@pytest.mark.parametrize("rtol", [0.1, 1e-3, 1e-6])
def test_a_winch_stops_at_its_minimum_length_by_every_method(name: str, rtol: float) -> None:
    settings = {"dt": STEPPING[name]} if name in STEPPING else {"rtol": rtol}
    for lag in (0.0, 0.2):
        out = lengths(hoisted(lag=lag), integrator=name, **settings)
        assert abs(float(out[-1]) - 9.5) < 1e-6


@pytest.mark.parametrize("formulation", ["redundant", "recursive"])
def test_random_hoists_stop_at_their_minimum_length(formulation: str) -> None:
    for seed in range(15):
        rng = np.random.default_rng(seed)
        rate = (
            -rng.uniform(0.1, 2.0)
            if rng.random() < 0.5
            else Curve.harmonic(
                offset=-rng.uniform(0.2, 1.0), amplitude=rng.uniform(0.0, 1.0), omega=rng.uniform(0.3, 4.0)
            )
        )
        scene = hoisted(rate=rate, minimum=rng.uniform(8.5, 9.9), lag=rng.choice([0.0, 0.1, 0.5]))
        name = str(rng.choice(["tsit5", "dopri5", "dop853", "bs32", "verner76"]))
        out = lengths(scene, integrator=name, rtol=10.0 ** rng.uniform(-5, -1), formulation=formulation)
        assert out.min() > scene.loads["hoist"].minimum_length - 1e-6, seed


@pytest.mark.warns("WinchLimitWarning")
def test_accuracy_holds_where_a_winch_comes_to_its_end() -> None:
    truth = simulate(hoisted(), 4.0, dt_out=0.1, integrator="dop853", rtol=1e-11, maximum_step=0.01)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        found = simulate(hoisted(), 4.0, dt_out=0.1, accuracy={"position": 1e-3})
    error = np.linalg.norm(np.asarray(found["position"]) - np.asarray(truth["position"]), axis=-1).max()
    assert error < 1e-3


@pytest.mark.parametrize("name", ["dopri5", "tsit5", "dop853", "rosenbrock"])
@pytest.mark.parametrize("until", [-0.5, -1e-5, 0.0, 1e-7, 0.2])
def test_a_run_goes_on_bit_for_bit_about_a_located_bound(name: str, until: float, tmp_path: Path) -> None:
    """At times about that at which the bound is met."""
    when = (10.0 / (1.0 + 1e4 * G / 1e7) - 9.5) / 0.5
    until += when
    settings: dict[str, Any] = {"dt_out": 0.1, "integrator": name, "rtol": 1e-4}
    whole = Run(hoisted(), t_end=3.0, **settings)
    whole.advance(until)
    whole.core.state.save(tmp_path / "there.state")
    whole.advance(3.0)
    rest = Run(hoisted(), t_end=3.0, start=State.load(tmp_path / "there.state", scene=hoisted()), **settings)
    rest.advance(3.0)
    assert np.array_equal(rest.core.state.values, whole.core.state.values)
    met = [event.time for event in whole.events()]
    assert met == pytest.approx([when], rel=1e-3)
    assert sorted({*met} - {event.time for event in rest.events()}) == [t for t in met if t <= until]


def test_a_command_that_jumps_beyond_a_bound_is_told_as_it_jumps() -> None:
    jump = Curve.constant(value=-0.1).then(time=0.5, curve=Curve.constant(value=-0.6))
    scene = hoisted(rate=jump, lag=0.1, minimum=5.0)
    scene.replace("hoist", maximum_rate=0.4)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        result = simulate(scene, 1.0, dt_out=0.1)
    assert [(event.name, event.time) for event in result.events] == [("hoist.maximum_rate", 0.5)]
