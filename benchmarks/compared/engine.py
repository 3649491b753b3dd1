"""Equations of motion: two formulations, an independent program, Jacobians, conservation, going on."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray
from reference.compare import differences
from reference.simulate import simulate as simulate_reference
from test_against_reference import quick_case2, reference_system
from test_jacobian import largest_error, mixture, moving
from test_reference_problems_figures import CONSERVATIVE, drift, thrown_crane
from test_restart import SCENES, parts, run, values

from seacrane import Scene, cases, simulate
from seacrane.inputs.frames import rotation_matrix

from .row import Row

Array = NDArray[np.float64]
CRANE, CONSERVED = "Crane on a vessel", "Conservation"
CASES: dict[str, Callable[[], Scene]] = {
    "case 1": cases.case1, "case 2": cases.case2, "case 3": cases.case3, "vessel alone": cases.vessel,
}  # fmt: skip
TITLES = {"bricard": "Bricard's loop", "wing nut": "Dzhanibekov's nut"}
NAMES = ("time", "position", "velocity", "angular_velocity", "quaternion", "vessel_motion")


def independent(t_end: float = 4.0) -> Iterator[Row]:
    """Ten bodies, memory, waves and controllers in NumPy and SciPy, with fast references."""
    scene = quick_case2()
    ours = simulate(scene, t_end=t_end, dt_out=0.5, rtol=1e-11)
    theirs = simulate_reference(reference_system(scene), t_end, ours.time, rtol=1e-9)
    channels = {name: ours.time if name == "time" else ours[name] for name in NAMES}
    found = differences(theirs, channels, bodies=list(ours.coords["body"]))
    units = {"position": "m", "attitude": "rad", "velocity": "m/s"}
    for name, unit in units.items():
        yield Row(
            subject=CRANE, compared=f"case 2 with fast references, {t_end:g} s: {name} of ten bodies",
            reference="rotation matrices and other rows, NumPy and SciPy", difference=found[name], unit=unit,
            limit=1e-8, test="cranes/test_against_reference.py",
        )  # fmt: skip


def formulations(t_end: float = 100.0, names: tuple[str, ...] = tuple(CASES)) -> Iterator[Row]:
    """Both of the engine's own formulations, which share no solver."""
    for name in names:
        settings: dict[str, Any] = {"integrator": "dop853", "rtol": 1e-11, "channels": ["position"]}
        first, second = (
            simulate(CASES[name](), t_end=t_end, dt_out=1.0, formulation=form, **settings)["position"]
            for form in ("redundant", "recursive")
        )
        yield Row(
            subject=CRANE, compared=f"{name}, {t_end:g} s: places of all bodies, redundant form",
            reference="recursive form", difference=float(np.abs(first - second).max()), unit="m", limit=1e-7,
            test="multibody/test_formulations.py",
        )  # fmt: skip


def jacobians() -> Iterator[Row]:
    """Exact derivatives of a random tree with every kind of joint and load."""
    worst = 0.0
    for seed in (1, 2, 3):
        model = mixture(seed, baumgarte=0.0 if seed == 1 else 2.0).compile()
        worst = max(worst, largest_error(model, 0.3, moving(model, seed), step=3e-4, kinks=True))
    yield Row(
        subject=CRANE, compared="exact Jacobian of random scenes, share of a row's largest entry",
        reference="five-point differences", difference=worst, unit="", limit=1e-7,
        test="multibody/test_jacobian.py",
    )  # fmt: skip


def energy(t_end: float = 100.0, names: tuple[str, ...] = tuple(CONSERVATIVE)) -> Iterator[Row]:
    """Scenes in which nothing does work: change of energy over the largest kinetic energy."""
    for name in names:
        worst = max(
            drift(CONSERVATIVE[name](), t_end, integrator="dop853", formulation=form)
            for form in ("redundant", "recursive")
        )
        yield Row(
            subject=CONSERVED, reference="its start", difference=worst, unit="", limit=1e-9,
            compared=f"{TITLES.get(name, name)}, {t_end:g} s: energy over the largest kinetic energy",
            test="multibody/test_reference_problems_figures.py",
        )  # fmt: skip


def momentum(t_end: float = 20.0) -> Iterator[Row]:
    """A crane on a vessel thrown into empty space: both momenta, over the size of their parts."""
    scene = thrown_crane()
    channels = ["position", "velocity", "angular_velocity", "quaternion"]
    result = simulate(scene, t_end=t_end, dt_out=0.5, rtol=1e-10, channels=channels)
    bodies = list(scene.bodies.values())
    mass, inertia = np.array([b.mass for b in bodies]), np.array([b.inertia for b in bodies])
    turn = rotation_matrix(result["quaternion"])
    spin = np.einsum("knij,njl,knml,knm->kni", turn, inertia, turn, result["angular_velocity"])
    linear = mass[:, None] * result["velocity"]
    angular = np.cross(result["position"], linear) + spin
    for name, parts_of in (("linear", linear), ("angular", angular)):
        whole, size = parts_of.sum(axis=1), np.linalg.norm(parts_of, axis=2).sum(axis=1).max()
        yield Row(
            subject=CONSERVED, compared=f"thrown crane, {t_end:g} s: {name} momentum over its parts",
            reference="its start", difference=float(np.abs(whole - whole[0]).max() / size), unit="",
            limit=1e-9, test="project/test_validation.py",
        )  # fmt: skip


def books(t_end: float = 100.0, names: tuple[str, ...] = tuple(CASES)) -> Iterator[Row]:
    """Work of all loads against the change of energy, and joints, over the cases."""
    for name in names:
        result = simulate(CASES[name](), t_end=t_end, dt_out=0.5, rtol=1e-8)
        share = np.abs(result["energy_balance"][1:]) / result["absolute_work"][1:]
        yield Row(
            subject=CONSERVED, compared=f"{name}, {t_end:g} s, `rtol` 1e-8: energy balance over the work",
            reference="closed books", difference=float(share.max()), unit="", limit=1e-8,
            test="multibody/test_reference_problems_figures.py",
        )  # fmt: skip
        if name != "vessel alone":
            yield Row(
                subject=CONSERVED, compared=f"{name}, {t_end:g} s, `rtol` 1e-8: gap of any joint",
                reference="closed joints", difference=float(result["constraint_error"].max()),
                unit="m or rad", limit=1e-9, test="multibody/test_reference_problems_figures.py",
            )  # fmt: skip


def going_on() -> Iterator[Row]:
    """A run of case 2 that stops and goes on from its state, against the run that does not stop."""
    scene = SCENES["case2"]()
    whole = run(scene)
    whole.advance(0.73)
    later = run(scene, parts(whole.core.state))
    for one in (whole, later):
        one.advance(1.5)
    yield Row(
        subject=CRANE, compared="case 2 stopped and continued: every number of the state",
        reference="the run that was not stopped", unit="", limit=0.0, test="run/test_state_file.py",
        difference=float(np.abs(values(later) - values(whole)).max()),
    )  # fmt: skip
