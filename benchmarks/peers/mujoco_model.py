"""The tree of `system.tree_data` as a MuJoCo model (MJCF): hinges and slides, loops closed by `connect`."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
TINY = "1e-6 1e-6 1e-6"  # kg m2; MuJoCo refuses bodies without inertia


def _numbers(values: Array) -> str:
    return " ".join(repr(float(value)) for value in np.ravel(values))


class _Writer:
    """Nested bodies whose frames are parallel to the inertial one at the start."""

    def __init__(self, data: Mapping[str, Array]) -> None:
        self.data = data
        self.lines: list[str] = []
        self.origins: list[Array] = [np.zeros(3)]

    def open(self, name: str, at: Array, *masses: str) -> None:
        """Body with the joint's point as its origin, and the masses of the named records, joined."""
        self.lines.append(f'<body name="{name}" pos="{_numbers(at - self.origins[-1])}">')
        self.origins.append(at)
        self.lines.append(self._inertial(masses, at))

    def _inertial(self, names: tuple[str, ...], at: Array) -> str:
        if not names:
            return f'<inertial pos="0 0 0" mass="1e-6" diaginertia="{TINY}"/>'
        parts = [self.data[f"body {name}"] for name in names]
        mass = sum(float(part[0]) for part in parts)
        center = sum(part[0] * part[1:4] for part in parts) / mass
        inertia = np.zeros((3, 3))
        for part in parts:
            arm = part[1:4] - center
            inertia += part[4:].reshape(3, 3) + part[0] * (arm @ arm * np.eye(3) - np.outer(arm, arm))
        full = inertia[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
        return f'<inertial pos="{_numbers(center - at)}" mass="{mass!r}" fullinertia="{_numbers(full)}"/>'

    def joint(self, kind: str, axis: Array | list[float]) -> None:
        self.lines.append(f'<joint type="{kind}" axis="{_numbers(np.asarray(axis))}"/>')

    def close(self, count: int = 1) -> None:
        for _ in range(count):
            self.lines.append("</body>")
            self.origins.pop()

    def cylinder(self, foot: str, name: str) -> None:
        at = self.data[f"point {foot}"]
        self.open(f"{name}_barrel", at, f"{name}_barrel")
        self.joint("hinge", self.data[f"axis {foot}"])
        self.joint("hinge", self.data[f"second_axis {foot}"])
        self.open(f"{name}_rod", at, f"{name}_rod")
        self.joint("slide", self.data[f"axis {name}_cylinder"])
        self.close(2)


X, Y, Z = [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]


def mjcf(data: Mapping[str, Array]) -> str:
    """The model; step, integrator and stiffness of the loops are set by the driver."""
    w = _Writer(data)
    w.open("vessel", np.zeros(3), "vessel", "tower")
    for axis in (X, Y, Z):
        w.joint("slide", axis)
    for axis in (Z, Y, X):
        w.joint("hinge", axis)
    w.open("king", data["point A"], "king")
    w.joint("hinge", data["axis A"])
    w.cylinder("B", "main")
    w.open("main_jib", data["point C"], "main_jib")
    w.joint("hinge", data["axis C"])
    w.cylinder("E", "knuckle")
    w.open("knuckle_jib", data["point F"], "knuckle_jib")
    w.joint("hinge", data["axis F"])
    w.open("link", data["point link"])
    w.joint("hinge", X)
    w.joint("hinge", Y)
    w.open("payload", data["second_point link"], "payload")
    for axis in (Z, Y, X):
        w.joint("hinge", axis)
    w.close(6)
    anchors = "".join(
        f'<connect body1="{body}" body2="{other}" '
        f'anchor="{_numbers(data[f"point {at}"] - data[f"point {foot}"])}"/>'
        for body, other, at, foot in (
            ("main_rod", "main_jib", "D", "B"),
            ("knuckle_rod", "knuckle_jib", "G", "E"),
        )
    )
    gravity = _numbers(np.array([0.0, 0.0, -data["gravity"][0]]))
    return (
        f'<mujoco><compiler angle="radian" autolimits="false"/><option gravity="{gravity}" solver="Newton" '
        'tolerance="1e-14" iterations="20" jacobian="dense"><flag contact="disable"/></option>'
        f"<worldbody>{''.join(w.lines)}</worldbody><equality>{anchors}</equality></mujoco>"
    )
