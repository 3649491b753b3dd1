"""Crane codes and the simplified method by hand, and what is said of a simulation above them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas
import pytest

from seacrane import SceneError
from seacrane.answers import Draught, code_factors, simplified_method
from seacrane.answers.code_factors import api_hoisting_speed

G = 9.80665


@pytest.mark.parametrize(
    ("hs", "deck", "falls", "v_d", "v_h", "api"),
    [  # at three heights by hand; a third party prints 0.44, 0.75 and 0.14, 0.25, 0.30 m/s
        (1.4, "supply vessel", 1, 0.8936, 0.447, 0.147),
        (2.7, "supply vessel", 1, 1.5140, 0.757, 0.248),
        (3.6, "barge", 4, 1.3585, 0.380, 0.309),
    ],
)
def test_speeds_of_the_crane_codes(
    hs: float, deck: str, falls: int, v_d: float, v_h: float, api: float
) -> None:
    found = code_factors(hs=hs, mass=20e3, stiffness=2e6, deck=deck, falls=falls)
    assert found["deck speed"].value == pytest.approx(v_d, abs=1e-4)
    assert found["hoisting speed"].value == pytest.approx(v_h, abs=1e-3)
    assert found["hoisting speed, API"].value == pytest.approx(api, abs=1e-3)
    assert found["offlead"].value == 2.5 + 1.5 * hs and found["sidelead"].value == 1.25 + 0.75 * hs
    assert all("unverified" in row.source for row in found)
    assert api_hoisting_speed(6.0 * 0.3048) == pytest.approx(0.3048 * 0.621)


def test_a_simulation_above_the_code_is_said_first(tmp_path: Path) -> None:
    """psi = 1 + (0.25 + 1) / g sqrt(2e6 / 20e3) with v_D 0, v_C 1 and v_L 0.5 m/s."""
    found = code_factors(
        hs=2.0, mass=20e3, stiffness=2e6, deck="fixed", tip_speed=1.0, hoisting_speed=0.5,
        simulated={"dynamic factor": 3.0, "hoisting speed": 0.4},
    )  # fmt: skip
    assert found["dynamic factor"].value == pytest.approx(1.0 + 12.5 / G)
    assert found["dynamic factor"].ratio == pytest.approx(3.0 / (1.0 + 12.5 / G))
    assert found.exceeded == ("dynamic factor",)
    first = "SIMULATED ABOVE THE CODE: dynamic factor."
    assert str(found).startswith(first) and f"<caption>{first}" in found.html()
    assert found.html().count('class="bad"') == 1
    table = pandas.read_csv(found.to_csv(tmp_path / "codes.csv"), index_col=0)
    assert table.columns[0] == "exceeded" and table["exceeded"].dropna().to_dict() == {
        "hoisting speed": "no", "dynamic factor": "yes",
    }  # fmt: skip
    still = code_factors(hs=0.0, mass=1.0, stiffness=1.0, simulated={"deck speed": 0.1})
    assert still.exceeded == ("deck speed",)  # of which the code has nothing
    with pytest.raises(SceneError, match="no row 'psi'"):
        code_factors(hs=2.0, mass=1.0, stiffness=1.0, simulated={"psi": 1.0})
    wrong = {"falls": np.nan, "deck": ["barge"], "simulated": 2.0}
    for word, given in wrong.items():
        with pytest.raises(SceneError, match=f"{word} is"):
            code_factors(**{"hs": 2.0, "mass": 1.0, "stiffness": 1.0, word: given})


def test_the_simplified_method_at_three_draughts_by_hand() -> None:
    """Hs 1 m, Tz 2 pi s: omega 1 rad/s, the wave 0.9 m, its speed and acceleration 0.9 at the surface."""
    draughts = [
        Draught(name="touches", slam_area=10.0, water_plane=2.0),
        Draught(name="under", depth=G * np.log(2.0), volume=5.0, added_mass=4e3, drag_area=8.0),
        Draught(name="still", depth=1e3, volume=5.0, added_mass=4e3, drag_area=8.0),
    ]
    found = simplified_method(
        mass=20e3, draughts=draughts, hs=1.0, tz=2.0 * np.pi, lowering_speed=0.25, tip_speed=1.2,
        tip_acceleration=0.5, density=1000.0, stiffness=1e6, simulated={"under": 0.1},
    )  # fmt: skip
    touches, under, still = found
    speed = 0.25 + 1.5  # sqrt(1.2^2 + 0.9^2)
    assert touches.static == pytest.approx(20e3 * G) and touches.slam == pytest.approx(5e3 * speed**2)
    assert touches.inertia == pytest.approx(20e3 * 0.5) and touches.buoyancy == pytest.approx(1800.0 * G)
    assert touches.hydrodynamic == pytest.approx(np.hypot(5e3 * speed**2, 1e4 - 1800.0 * G))
    wave = 0.45  # half of it as deep as this
    drag, inertia = 4e3 * (0.25 + np.hypot(1.2, wave)) ** 2, np.hypot(24e3 * 0.5, 9e3 * wave)
    assert under.hydrodynamic == pytest.approx(np.hypot(drag, inertia))
    assert under.margin == pytest.approx(1.0 - np.hypot(drag, inertia) / (15e3 * G))
    assert under.ratio == pytest.approx(0.9 / (1.0 - under.margin)) and found.exceeded == ("under",)
    assert str(found).startswith("SIMULATED ABOVE THE METHOD: under.") and "unverified" in str(found)
    (air,) = simplified_method(
        mass=1e3, draughts=[Draught(name="air")], hs=1.0, tz=6.0, lowering_speed=0.2, simulated={"air": 0.8}
    )  # the water takes nothing by the method
    assert air.hydrodynamic == 0.0 and air.ratio == np.inf
    assert still.hydrodynamic == pytest.approx(np.hypot(4e3 * 1.45**2, 12e3)) and np.isnan(still.snap)
    with pytest.raises(SceneError, match="'touches' is there twice"):
        simplified_method(mass=2e4, draughts=[draughts[0]] * 2, hs=1.0, tz=6.0, lowering_speed=0.2)
    with pytest.raises(SceneError, match="'raft': the load floats"):
        simplified_method(
            mass=1e3, draughts=[Draught(name="raft", volume=2.0)], hs=1.0, tz=6.0, lowering_speed=0.2
        )


def test_a_snap_is_told_where_the_hoist_goes_slack() -> None:
    found = simplified_method(
        mass=1e3, draughts=[Draught(name="in", slam_area=40.0, added_mass=500.0)], hs=2.0, tz=6.0,
        lowering_speed=0.5, stiffness=2e5,
    )["in"]  # fmt: skip
    speed = 0.5 + 1.8 * 2.0 * np.pi / 6.0
    assert found.margin < 0.1 and found.snap == pytest.approx(speed * np.sqrt(2e5 * 1500.0))
