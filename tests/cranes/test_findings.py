"""The findings of Landsverk, Zhou & Hovland as numbers, from the runs that their figures show."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from test_figures import read_csv

from seacrane import Result, cases, simulate
from seacrane.arrays import Array
from seacrane.hydro import shipped_database, vessel_parameters
from seacrane.hydro.data.rigid_mass import rigid_mass_matrix
from seacrane.inputs.frames import rotation_matrix
from seacrane.pictures.findings import (
    OSCILLATION_PERIOD,
    OSCILLATION_START,
    PaperRuns,
    amplitude_at,
    memory_effect,
    paper_findings,
    save_paper_figures,
    slew_stop,
)
from seacrane.result import MOTIONS
from seacrane.warnings import LargeSwingWarning


@pytest.fixture(scope="module")
def runs() -> PaperRuns:
    with pytest.warns(LargeSwingWarning):  # of case 1
        return PaperRuns(
            vessel=simulate(cases.vessel()), vessel_without_memory=simulate(cases.vessel(memory="none")),
            case1=simulate(cases.case1()), case2=simulate(cases.case2()), case3=simulate(cases.case3()),
        )  # fmt: skip


def motion(result: Result, name: str) -> Array:
    return result.select("vessel_motion", motion=name)


def test_every_finding_is_reproduced_and_its_numbers_are_right(runs: PaperRuns) -> None:
    """The number of memory's effect: rms difference over rms; the 5 s component, most in sway and roll."""
    found = paper_findings(runs)
    assert [one.verdict for one in found].count("reproduced") == 6 and len(found) == 7
    assert found[1].verdict == "measured"
    states = runs.vessel.stats["states"] / runs.vessel_without_memory.stats["states"]
    assert f"states x {states:.2f}" in found[1].number
    assert runs.vessel.stats["memory_states"] > 40 and runs.vessel_without_memory.stats["memory_states"] == 0
    printed = dict(re.findall(r"(\w+) (\d+) %", memory_effect(runs).number))
    for name in MOTIONS:
        with_memory, without = motion(runs.vessel, name), motion(runs.vessel_without_memory, name)
        change = np.sqrt(np.mean((without - with_memory) ** 2) / np.mean(with_memory**2))
        assert int(printed[name]) == round(100 * change) > 10
    assert 35.0 < slew_stop(runs.case1) <= 45.0
    settings = {"period": OSCILLATION_PERIOD, "start": OSCILLATION_START}
    added, without = (
        {
            name: amplitude_at(run.time, motion(run, name) - motion(runs.case1, name), **settings)
            for name in MOTIONS
        }
        for run in (runs.case3, runs.case2)
    )
    assert added["sway"] > added["heave"] > 3.0 * added["surge"]
    assert np.degrees(added["roll"]) > 0.5 and added["roll"] > 10.0 * max(added["pitch"], added["yaw"])
    assert all(added[name] > 5.0 * without[name] for name in ("sway", "heave", "roll"))
    assert f"sway {added['sway']:.2g} m" in found[-1].number
    assert f"roll {np.degrees(added['roll']):.2g} deg" in found[-1].number
    late = runs.vessel.time >= OSCILLATION_START
    alone, *heel = (
        np.degrees(motion(run, "roll")[late].mean()) for run in (runs.vessel, runs.case1, runs.case2)
    )
    assert f"case 1 {heel[0] - alone:+.3f} deg, case 2 {heel[1] - alone:+.3f} deg" in found[4].number


def test_eight_figures_and_their_data_are_written(runs: PaperRuns, tmp_path: Path) -> None:
    assert list(save_paper_figures(runs=runs, folder=tmp_path)) == list(range(3, 11))
    for number in range(3, 11):
        assert (tmp_path / f"figure_{number:02d}.png").read_bytes().startswith(b"\x89PNG")
    names, numbers = read_csv(tmp_path / "figure_03.csv")
    ours = [[MOTIONS.index(one.partition(",")[0]), one.endswith("[deg]")] for one in names[1:]]
    for column, (which, turns) in enumerate(ours, start=1):
        run = runs.vessel if column % 2 else runs.vessel_without_memory
        expected_values = run["vessel_motion"][:, which] * (np.degrees(1.0) if turns else 1.0)
        np.testing.assert_allclose(numbers[:, column], expected_values, rtol=1e-9, atol=1e-12)
    assert len(ours) == 12 and sum(turns for _, turns in ours) == 6
    _, numbers = read_csv(tmp_path / "figure_07.csv")
    assert numbers[-1, 3] == pytest.approx(-90.0, abs=0.1)
    king, tower = (runs.case3.select("euler_xyz", body=name, axis="z") for name in ("king", "tower"))
    phi = np.unwrap(king - tower)
    np.testing.assert_allclose(numbers[:, 3], np.rad2deg(phi), atol=1e-6)
    _, numbers = read_csv(tmp_path / "figure_10.csv")  # the difference of two heaves
    np.testing.assert_allclose(
        numbers[:, 1], motion(runs.case3, "heave") - motion(runs.case1, "heave"), rtol=1e-9
    )


def test_a_ship_adrift_moves_as_momentum_says() -> None:
    """Surge, sway and yaw at the end: (M + A(0)) eta + int (momentum of the crane) dt = 0.

    Moments are about the hull's reference point, which may move because the total momentum is zero. Over the
    whole motion the fluid counts with the added mass of zero frequency.
    """
    scene = cases.case1(hs=0.0, mooring=None)
    adrift = simulate(scene, t_end=400.0, dt_out=0.2, rtol=1e-8)
    rate = np.degrees(np.gradient(motion(adrift, "yaw"), adrift.time))
    assert np.min(rate[(adrift.time > 25.0) & (adrift.time < 33.0)]) > 0.006  # while it slews, and not after
    assert np.max(np.abs(rate[adrift.time > 50.0])) < 0.0006
    momentum = np.zeros((len(adrift.time), 6))
    origin = adrift["vessel_motion"][:, :3]
    for k, name in enumerate(adrift.coords["body"]):
        if name == "vessel":
            continue
        body, rotation = scene.bodies[name], rotation_matrix(adrift["quaternion"][:, k])
        linear = body.mass * adrift["velocity"][:, k]
        inertia = rotation @ body.inertia @ rotation.transpose(0, 2, 1)
        momentum[:, :3] += linear
        momentum[:, 3:] += np.cross(adrift["position"][:, k] - origin, linear)
        momentum[:, 3:] += np.einsum("tij,tj->ti", inertia, adrift["angular_velocity"][:, k])
    step = adrift.time[1] - adrift.time[0]
    moved = step * (np.sum(momentum, axis=0) - 0.5 * (momentum[0] + momentum[-1]))
    p = vessel_parameters(shipped_database())
    mass = rigid_mass_matrix(p.mass, p.center_of_mass, p.inertia) + p.memory.frequency_response([1e-4])[0][0]
    hull = mass @ adrift["vessel_motion"][-1]
    np.testing.assert_allclose(hull[:2], -moved[:2], rtol=0.01)
    # The hull's moment holds products of 4 deg of heel with surge and roll: second order, 3 % of it.
    turned = mass[5, 5] * motion(adrift, "yaw")[-1]
    assert abs(hull[5] + moved[5]) < 0.05 * turned


def test_oscillation_is_what_the_frequency_domain_gives_for_the_decks_load() -> None:
    """Case 3 in calm water, transient gone: motions at 5 s are Z(i w)^-1 times the deck's load at 5 s."""
    scene = cases.case3(hs=0.0)
    run = simulate(scene, t_end=400.0, dt_out=0.05, rtol=1e-8)
    late = run.time >= 350.0
    omega = 2.0 * np.pi / OSCILLATION_PERIOD
    rotation = rotation_matrix(run["quaternion"][late, 0])
    reaction = run.select("reaction_force", joint="deck")[late]
    balance = scene.point_forces["balance"]
    force = balance.force - reaction
    moment = np.cross(rotation @ balance.point, np.broadcast_to(balance.force, reaction.shape))
    moment -= run.select("reaction_moment", joint="deck")[late]
    moment -= np.cross(rotation @ scene.joints["deck"].first_frame.point, reaction)
    t = run.time[late] - run.time[-1]
    columns = np.column_stack([np.cos(omega * t), -np.sin(omega * t), np.ones_like(t), t, t**2, t**3])
    values = np.hstack([force, moment, run["vessel_motion"][late]])
    cosine, sine = np.linalg.lstsq(columns, values, rcond=None)[0][:2]
    load, found = (cosine + 1j * sine)[:6], (cosine + 1j * sine)[6:]
    p = vessel_parameters(shipped_database())
    added_mass, damping = p.memory.frequency_response([omega])
    heeled = rotation_matrix(np.mean(run["quaternion"][late, 0], axis=0))
    center, inertia = heeled @ p.center_of_mass, heeled @ p.inertia @ heeled.T
    mass = rigid_mass_matrix(p.mass, center, inertia) + added_mass[0]
    impedance = -(omega**2) * mass + 1j * omega * (damping[0] + p.linear_damping) + p.restoring
    expected = np.linalg.solve(impedance, load)
    error = np.abs(found - expected) / np.abs(expected)
    np.testing.assert_array_less(error[:5], 0.01)
    assert np.argmax(np.abs(expected[:3])) == 1 and np.argmax(np.abs(expected[3:])) == 0
