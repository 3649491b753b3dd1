"""A table of motions per metre of wave, from any source."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from seacrane.arrays import Array, Complex
from seacrane.errors import SceneError
from seacrane.hydro.data.frozen import freeze, require_grid, require_positive
from seacrane.hydro.data.heading_circle import centred, heading_weights, travel, with_mirror_images
from seacrane.hydro.data.interpolation import spline_weights
from seacrane.hydro.data.long_waves import phase_slip
from seacrane.inputs.caller import warn_caller
from seacrane.inputs.checked import flag_of, number_of, numbers_of, text_of
from seacrane.inputs.keywords import named
from seacrane.sea.dispersion import wavenumber
from seacrane.warnings import RaoPhaseWarning

TURN = 2.0 * np.pi
STEEPEST_PITCH = 6.0  # of the wave's slope, at the longest wave of a table: hulls follow it, 57 is degrees


@named
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class MotionRaos:
    """Motions of a ship per metre of wave amplitude: its displacement RAOs.

    x forward, y to port, z up, about the ship's reference point, where the wave has zero phase. Time factor
    exp(+i omega t): a motion that lags the crest by a phase p has the value ``amplitude * exp(-1j * p)``. A
    phase that leads enters with +. Other programs' tables: see docs/given-ships.md.

    Parameters
    ----------
    omega : (n,) rad/s, increasing.
    heading : (m,) rad, where the waves go to: 0 following, from +x towards +y (port); increasing within
        [0, 2 pi).
    values : complex (m, n, 6): surge, sway, heave (m/m) and roll, pitch, yaw (rad/m).
    depth : of the water, m; default: deep.
    symmetric : whether port and starboard are alike (default), so that headings may be mirrored.
    name : for messages.
    g : m/s2, for wavenumbers; default 9.81.

    Raises
    ------
    SceneError : another shape, a value that is not finite, frequencies or headings out of order, headings in
        degrees, or rotations in degrees: a pitch in the longest wave of more than six times its slope.

    Warns
    -----
    RaoPhaseWarning : a hull that follows the longest wave by its amplitudes is out of phase with it.
    """

    omega: Any
    heading: Any
    values: Any
    depth: float = float("inf")
    symmetric: bool = True
    name: str = "RAOs"
    g: float = 9.81

    def __repr__(self) -> str:
        low, high = float(np.min(self.omega)), float(np.max(self.omega))
        return (
            f"<MotionRaos: {np.size(self.heading)} headings, {np.size(self.omega)} frequencies, {low:.3g} to "
            f"{high:.3g} rad/s>"
        )

    def __post_init__(self) -> None:
        what = f"RAOs {text_of('RAOs: name', self.name)!r}"
        for key in ("omega", "heading", "values"):
            if key != "values" or not np.iscomplexobj(self.values):
                object.__setattr__(self, key, numbers_of(f"{what}: {key}", getattr(self, key)))
        if (reach := np.abs(self.heading).max(initial=0.0)) > TURN:
            raise SceneError(
                f"{what}: heading reaches {reach:.6g} rad, more than a turn; headings are radians: if these "
                "are degrees, give numpy.radians of them"
            )
        n, m = self.omega.size, self.heading.size
        freeze(self, what, {"omega": (n,), "heading": (m,), "values": (m, n, 6)})
        require_grid(what, self.omega, self.heading)
        for key in ("depth", "g"):
            object.__setattr__(self, key, number_of(f"{what}: {key}", getattr(self, key)))
        require_positive(self, what, "depth", "g")
        flag_of(f"{what}: symmetric", self.symmetric)
        self._refuse_degrees(what)
        lowest, motions = float(self.omega[0]), self.values[:, 0]
        if said := phase_slip(lowest, self.heading, motions, depth=self.depth, g=self.g):
            warn_caller(f"{what}: {said}", RaoPhaseWarning)

    def _refuse_degrees(self, what: str) -> None:
        slope = float(wavenumber(self.omega[:1], g=self.g, depth=self.depth)[0])
        pitch = float(np.abs(self.values[:, 0, 4]).max())
        if pitch > STEEPEST_PITCH * slope:
            raise SceneError(
                f"{what}: pitch is {pitch:.4g} rad/m at {self.omega[0]:.4g} rad/s, {pitch / slope:.3g} times "
                "the slope of that wave, which long waves do not do; rotations are rad/m: if the table is in "
                "deg/m, multiply roll, pitch and yaw by pi / 180"
            )

    def at(self, omega: Any, heading: Any) -> Complex:
        """Motions (k, 6) at frequencies (k,) and headings (k,): cubic splines over both.

        Below the table's frequencies those of the lowest; above them none.

        Raises
        ------
        SceneError : a heading in a gap of more than 45 deg.
        """
        w, b = np.asarray(omega, dtype=float), np.asarray(heading, dtype=float)
        circle, table, centre = self._circle
        in_heading = heading_weights(f"RAOs {self.name!r}", circle, b)
        inside = np.clip(w, self.omega[0], self.omega[-1])
        in_frequency = spline_weights(self.omega, inside)
        by_heading = (in_heading @ table.reshape(circle.size, -1)).reshape(b.size, self.omega.size, 6)
        found = np.einsum("kn,knd->kd", in_frequency, by_heading)
        if np.any(centre):
            found = found * travel(centre, wavenumber(inside, g=self.g, depth=self.depth), b)[:, None]
        found[w > self.omega[-1] * (1.0 + 1e-9)] = 0.0
        return np.asarray(found)

    @cached_property
    def _circle(self) -> tuple[Array, Complex, Array]:
        """All headings with their motions, mirrored ones added and phases as at the phase centre, and it."""
        heading, values = self.heading, self.values
        if self.symmetric:
            heading, values = with_mirror_images(heading, values)
        k = wavenumber(self.omega, g=self.g, depth=self.depth)
        return heading, *centred(k, heading, values)
