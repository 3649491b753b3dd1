"""What hangs on elastic lines is drawn, and their tension is among what pages and overviews show."""

from __future__ import annotations

import json

import pytest

from seacrane import Scene, simulate, view
from seacrane.pictures.drawn_bodies import looks
from seacrane.pictures.overview import overview_sheet
from seacrane.pictures.shapes import BoxShape


def lifted(falls: int) -> Scene:
    """A load held on deck by a weld, below the tip of a crane that reeves its line so often."""
    scene = Scene(name="lifted")
    scene.add_given_vessel("rest")
    crane = scene.add_crane(s1=2.0, s2=2.0)
    for joint in ("A", "main_cylinder", "knuckle_cylinder"):
        scene.add_driver(joint=joint, curve=0.0)
    jib, head = crane.tip or ("", ())
    x, y, z = scene.place_of(body=jib, point=head)
    scene.add_body(name="load", mass=2e4, inertia=(2e4, 2e4, 2e4), position=(x, y, z - 15.0))
    scene.add_joint(kind="weld", name="on deck", first="vessel", second="load")
    ends = [jib, "load"] * falls, [head, (0.0, 0.0, 1.5)] * falls
    bodies, points = (part[: falls + 1] for part in ends)
    scene.add_line(name="hoist", bodies=bodies, points=points, EA=1e8, length=13.49 * falls)
    return scene


def test_what_hangs_on_a_line_is_a_load_of_its_size_and_tensions_are_shown() -> None:
    for falls in (1, 2):
        look = looks(lifted(falls))["load"]
        (box,) = look.shapes
        assert look.role == "payload" and isinstance(box, BoxShape)
        assert box.size == pytest.approx([(12.0 * 2e4 / 2e4 / 2.0) ** 0.5] * 3)
    result = simulate(lifted(1), t_end=0.5, dt_out=0.1)
    assert "line tension" in [panel.quantity for panel in overview_sheet(result).panels]
    data = json.loads(view(result).html.split('id="data">')[1].split("</script>")[0])
    assert data["strip"][0]["title"] == "line tension hoist" and data["strip"][0]["labels"] == [""]
