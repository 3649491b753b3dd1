"""Lines over sheaves against closed forms, and Exudyn's reeving as `peers/exudyn_reeving.py` recorded it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from measure.table import read
from multibody_runs import record
from numpy.typing import NDArray
from peers import exudyn_reeving as peer
from reeving_scenes import MASS, G, belt, capstan, tackle

from seacrane import Scene

from .row import Row

Array = NDArray[np.float64]
SUBJECT, TEST = "Lines over sheaves", "lines/test_reeving.py"


def hook() -> Scene:
    """The scene of the peer."""
    scene = Scene(name="hook", gravity=peer.GRAVITY)
    scene.add_body(name="hook", **peer.HOOK)
    mass = peer.HOOK["mass"]
    viscous = peer.DAMPING / peer.LENGTH  # N s/m
    scene.add_line(
        name="hoist", bodies=["hook" if on else "ground" for on in peer.ON_HOOK], points=peer.POINTS,
        EA=peer.STIFFNESS, length=peer.LENGTH, sheaves={"radii": peer.RADII, "axes": peer.AXES}, mass=mass,
        damping_ratio=0.5 * viscous / np.sqrt(peer.STIFFNESS * mass / peer.LENGTH),
    )  # fmt: skip
    return scene


def recorded(path: Path = peer.RESULT) -> Array:
    """Rows of the peer: time, place, length, tension."""
    return np.array(read(path)[1], dtype=float)


def exudyn(rows: Array | None = None) -> Iterator[Row]:
    """A hook that swings on a line over three sheaves, for 4 s."""
    theirs = recorded() if rows is None else rows
    ours = record(hook(), peer.T_END, dt_out=peer.EVERY, rtol=1e-11)
    found = {
        "place of the hook": (ours["position"][:, 0] - theirs[:, 1:4], "m", 1e-6),
        "length of the path": (ours["line_length"][:, 0] - theirs[:, 4], "m", 1e-6),
        "tension over its mean": (
            (ours["line_tension"][:, 0] - theirs[:, 5]) / theirs[:, 5].mean(), "", 1e-6,
        ),
    }  # fmt: skip
    for what, (difference, unit, limit) in found.items():
        yield Row(
            subject=SUBJECT, compared=f"hook on a line over three sheaves, 4 s: {what}",
            reference="reeving of Exudyn", difference=float(np.abs(difference).max()), unit=unit, limit=limit,
            test="lines/test_exudyn_peer.py",
        )  # fmt: skip


def closed_forms() -> Iterator[Row]:
    """Lengths of belts, the share of six falls, and a capstan."""
    for crossed in (False, True):
        scene, length = belt(crossed=crossed)
        told = record(scene, 1e-3, dt_out=1e-3)["line_length"][0, 0]
        yield _closed(f"{'crossed' if crossed else 'open'} belt over two wheels: length", told / length - 1.0)
    scene = tackle(efficiencies=[1.0, *[0.98] * 5, 1.0], damping_ratio=0.2, slip_speed=0.005)
    scene.add_winch(line="hoist", rate=-0.5, lag=0.3)
    tensions = record(scene, 4.0, dt_out=1.0)["section_tension"][-1]
    share = np.mean(0.98 ** np.arange(6))
    yield _closed(
        "six falls at 0.98, hoisting: load over six tensions", tensions.mean() / tensions[0] / share - 1.0
    )
    tensions = record(capstan(turns=2.0), 3.0, dt_out=1.0)["section_tension"][-1]
    told = tensions[0] / tensions[1]
    yield _closed("capstan of 2 1/4 turns: tensions", told / np.exp(0.1 * 4.5 * np.pi) - 1.0)
    out = record(tackle(falls=4), 0.2)
    yield _closed(
        "four falls at rest: load over tension", np.abs(4.0 * out["line_tension"] / (MASS * G) - 1.0).max()
    )


def _closed(what: str, difference: float) -> Row:
    return Row(
        subject=SUBJECT, compared=what, reference="closed form", difference=abs(float(difference)), unit="",
        limit=1e-9, test=TEST,
    )  # fmt: skip
