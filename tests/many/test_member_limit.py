"""A limit of processor time for each member: one beyond it fails by name, others go on."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import named
import pytest
from marks import needs_lanes

from seacrane import SceneError, ensemble
from seacrane.warnings import FailedMembersWarning

HEIGHT: dict[str, Any] = {"keep": {"low": "position[bob, z].min"}, "t_end": 0.2}


@pytest.mark.filterwarnings("ignore")  # of an actuator that is far too stiff
@pytest.mark.parametrize("lanes", [1, pytest.param(4, marks=needs_lanes)])
def test_a_member_beyond_its_limit_fails_and_others_go_on(lanes: int) -> None:
    """At 1e7 rad/s an explicit method takes millions of steps. Those beside it are run anew by themselves."""
    scene = named.pendulum()
    scene.add_actuator(name="motor", joint="pin", stiffness=1.0)
    usual = ensemble(scene, over={"actuators.motor.stiffness": [1.0, 2.0]}, lanes=1, **HEIGHT)
    over = {"actuators.motor.stiffness": [1.0, 2.0, 1e14]}
    with pytest.warns(FailedMembersWarning, match=r"member 2, by MemberLimitError: it took more than 0\.2 s"):
        done = ensemble(scene, over=over, lanes=lanes, member_limit=0.2, **HEIGHT)
    assert list(done.failures) == [2]
    assert done.dataset.low[:2].to_numpy().tobytes() == usual.dataset.low.to_numpy().tobytes()
    apart = done.dataset.kept_apart.to_numpy()[:2]
    assert all(("MemberLimitError" in why) == (lanes > 1) for why in apart)


@pytest.mark.parametrize("limit", [0.0, -1.0, "1"])
def test_a_limit_that_is_none(limit: Any) -> None:
    with pytest.raises(SceneError, match="member_limit"):
        ensemble(named.pendulum, over={"mass": [1.0]}, member_limit=limit, **HEIGHT)


def test_a_store_is_of_one_limit(tmp_path: Path) -> None:
    given: dict[str, Any] = {"over": {"mass": [1.0]}, "store": tmp_path / "store", **HEIGHT}
    ensemble(named.pendulum, member_limit=60.0, **given)
    with pytest.raises(SceneError, match="member_limit differ"):
        ensemble(named.pendulum, **given)
