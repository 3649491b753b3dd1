"""Constraints that come to depend on each other during a run, and bodies that only look as if they did."""

from __future__ import annotations

import re
import warnings
from typing import Any

import numpy as np
import pytest
from multibody_runs import ramp
from numpy.typing import NDArray
from reference.classic import integrate
from reference_problems import bricard

from seacrane import Result, Scene, simulate
from seacrane.warnings import NearSingularWarning

FORMULATIONS = ("redundant", "recursive")
GRAVITY = 9.80665


def folding(start: float, *, pins: int = 1, rate: float | None = None) -> Scene:
    """A crank, and a link as long from its tip to a slider: they fold together where the crank is at 90 deg.

    Every pin but the first is redundant. Without a driver's `rate` the crank turns freely, at 1 rad/s.
    """
    scene = Scene(name="folding", gravity=0.0)
    tip, end = (np.cos(start), 0.0, np.sin(start)), (2.0 * np.cos(start), 0.0, 0.0)
    turning = 1.0 if rate is None else 0.0
    speed = (-2.0 * turning * np.sin(start), 0, 0)
    scene.add_body(name="crank", mass=1.0, inertia=[1, 1, 1], angular_velocity=(0, -turning, 0))
    scene.add_body(name="slider", mass=1.0, inertia=[1, 1, 1], position=end, velocity=speed)
    for i in range(pins):
        pin = {"first": "ground", "second": "crank", "point": (0, 0.2 * i, 0), "axis": (0, -1, 0)}
        scene.add_joint(kind="revolute", name=f"pin {i}", **pin)
    scene.add_joint(
        kind="prismatic", name="guide", first="ground", second="slider", point=end, axis=(1, 0, 0)
    )
    scene.add_joint(kind="distance", name="link", first="crank", second="slider", point=tip, second_point=end)
    if rate is not None:
        scene.add_driver(name="turn", joint="pin 0", curve=ramp(rate))
    return scene


def told(scene: Scene, formulation: str = "auto", **settings: Any) -> tuple[Result, list[str]]:
    """A run, and its warnings of what is near singular; those of redundant joints are left out."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = simulate(scene, formulation=formulation, **settings)
    near = [str(one.message) for one in caught if "are redundant" not in str(one.message)]
    assert all(issubclass(one.category, NearSingularWarning) for one in caught if str(one.message) in near)
    return result, near


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_rank_is_watched_beside_redundant_joints(formulation: str) -> None:
    """Ten times nearer to the fold the singular value is ten times smaller, and the link is named."""
    found = []
    for gap in (0.1, 0.01):
        t_end = (0.5 * np.pi - 0.5 - gap) / 0.2
        result, near = told(folding(0.5, pins=2, rate=0.2), formulation, t_end=t_end, maximum_step=0.05)
        assert not near
        assert result.stats["smallest_pivot_joint"] == "link"
        assert result.stats["smallest_pivot_at_s"] == pytest.approx(t_end, abs=0.1)
        assert result.stats["rank_changed"] == 0
        found.append(float(result.stats["smallest_singular_value"]))
    assert found[0] / found[1] == pytest.approx(10.0, rel=0.1)


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize(
    ("scene", "settings", "words"),
    [
        # With redundant joints into a singular position.
        (folding(0.5, pins=2, rate=0.2), {"t_end": (0.5 * np.pi - 0.5 - 1e-5) / 0.2, "maximum_step": 0.05},
         r"joint 'link'.*at t = 5.35"),
        # What looks like a redundant joint is a fold that the crank turns out of.
        (folding(0.5 * np.pi), {"t_end": 0.5}, "at t = 0 s"),
        # A sliding hinge lets Bricard's loop branch at 0.89 s, where no output is.
        (bricard.scene(last="cylindrical"), {"t_end": 1.4, "dt_out": 0.7, "rtol": 1e-8},
         r"joint 'hinge \d'.*at t = 0\.8[89]"),
        (bricard.scene(), {"t_end": 1.0, "rtol": 1e-8}, None),  # redundant joints that stay so
    ],
    ids=["fold", "start", "bifurcation", "redundant"],
)  # fmt: skip
def test_a_singular_position_is_told(
    scene: Scene, settings: dict[str, Any], words: str | None, formulation: str
) -> None:
    result, near = told(scene, formulation, **settings)
    if words is None:
        assert not near
        assert 0.01 < float(result.stats["smallest_singular_value"]) < 1.0
        assert result.stats["rank_changed"] == 0
        return
    assert any(re.search(words, one) for one in near), near
    if words == "at t = 0 s":
        assert result.stats["rank_changed"] == 1
    if "dt_out" in settings:  # what the warning is about
        assert np.abs(result["energy_balance"]).max() > 1e-4


def chain(links: int, *, hinges: int = 1, lean: float = 0.0) -> Scene:
    """A beam on `hinges` hinges on one line, and links of 1 m and 20 kg from it, leaning by `lean` rad."""
    scene = Scene(name="chain", gravity=GRAVITY)
    scene.add_body(name="beam", mass=50.0, inertia=[5.0] * 3)

    def pin(name: str, first: str, second: str, point: Any) -> None:
        scene.add_joint(kind="revolute", name=name, first=first, second=second, point=point, axis=(0, 1, 0))

    for i in range(hinges):
        pin(f"hinge {i}", "ground", "beam", (0, i, 0))
    along = np.array([np.sin(lean), 0.0, -np.cos(lean)])
    for i in range(links):
        scene.add_body(
            name=f"link {i}", mass=20.0, inertia=[0.02, 1.7, 1.7], position=(i + 0.5) * along,
            quaternion=(np.cos(0.5 * lean), 0, -np.sin(0.5 * lean), 0)
        )  # fmt: skip
        pin(f"pin {i}", f"link {i - 1}" if i else "beam", f"link {i}", i * along)
    return scene


@pytest.mark.parametrize("formulation", FORMULATIONS)
def test_a_long_chain_at_rest_is_not_singular(formulation: str) -> None:
    """Its smallest singular value falls as n^-2, and none of its rows depends on others."""
    result, near = told(chain(40), formulation, t_end=0.1)
    assert not near
    assert float(result.stats["smallest_singular_value"]) < 1e-4
    assert result.stats["rank_changed"] == 0


def test_a_long_chain_on_redundant_hinges_keeps_all_its_joints() -> None:
    """Beside redundant rows the redundant form would leave out a combination of the chain's."""
    places = []
    for hinges in (1, 2):
        result, near = told(chain(30, hinges=hinges, lean=0.5), t_end=0.2, rtol=1e-9)
        assert not near and result.stats["formulation"] == "recursive"
        places.append(result["position"][-1])
    np.testing.assert_allclose(places[1], places[0], atol=1e-7)


def pendulum(inertia: float, t: float) -> NDArray[np.float64]:
    """Place of a point 1 m from a hinge about y, let go level."""
    share = GRAVITY / (1.0 + inertia)
    angle = integrate(lambda _, y: (y[1], -share * np.cos(y[0])), (0.0, 0.0), [0.0, t])[-1, 0]
    return np.array((np.cos(angle), 0.0, np.sin(angle)))


@pytest.mark.parametrize("formulation", FORMULATIONS)
@pytest.mark.parametrize("inertia", [1e-4, 1e-10, 1e-20])
def test_a_body_of_next_to_no_inertia_hangs_on_a_hinge_that_is_not_redundant(
    inertia: float, formulation: str
) -> None:
    scene = Scene(name="plumb", gravity=GRAVITY)
    scene.add_body(name="bob", mass=1.0, inertia=[inertia] * 3, position=(1, 0, 0))
    scene.add_joint(
        kind="revolute", name="hinge", first="ground", second="bob", point=(0, 0, 0), axis=(0, 1, 0)
    )
    result, near = told(scene, formulation, t_end=2.0, rtol=1e-10)
    assert not near
    assert np.abs(result["position"][-1, 0] - pendulum(inertia, 2.0)).max() < 1e-8
    assert np.abs(result["constraint_error"]).max() < 1e-12
    assert np.abs(result["energy_balance"]).max() < 1e-8
