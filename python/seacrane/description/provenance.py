"""Where the hydrodynamics of a vessel and the waves of a sea come from, as the program records it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any


@dataclass(frozen=True, kw_only=True)
class VesselProvenance:
    """Where a vessel's hydrodynamics or its given motion come from; None where it is not known.

    Attributes
    ----------
    database : Name of the hydrodynamic database.
    omega : Its lowest and highest frequency, rad/s.
    memory : Kind of fluid memory, as `Scene.add_vessel` takes it.
    memory_error : What a memory fitted by motion changes of any motion: `MotionError.worst`.
    motion : Of a vessel whose motion is given: "raos", "history" or "rest"; None for one that floats.
    record : Where a measured motion comes from and what was done to it.
    ramp, duration : Of that motion: s over which it grows from rest, and s at which it ends.
    size : Length, breadth and draught of the ship that a light body stands for, m.
    free_surface : (float, float, float) or None
        What the free surface of the database's roll tanks takes from C44, N m/rad: as the vessel has it, and
        the least and the most of the fits to the data.
    slack_tanks : What tanks by `slack_moment` of `Scene.add_vessel` take from C44 and C55, N m/rad.
    """

    database: str | None = None
    omega: tuple[float, float] | None = None
    memory: str | None = None
    motion: str | None = None
    ramp: float | None = None
    duration: float | None = None
    size: tuple[float, float, float] | None = None
    memory_error: float | None = None
    free_surface: tuple[float, float, float] | None = None
    slack_tanks: tuple[float, float] | None = None
    record: str | None = None

    @property
    def taken(self) -> tuple[float, float, float]:
        """From C44 by all free surfaces, N m/rad: as the vessel has it, the least and the most."""
        more = self.slack_tanks[0] if self.slack_tanks else 0.0
        used, least, most = self.free_surface or (0.0, 0.0, 0.0)
        return used + more, least + more, most + more


@dataclass(frozen=True, kw_only=True)
class SeaProvenance:
    """What a sea was made from, and what its realisation came to; None where it is not known.

    Attributes
    ----------
    spectrum : Kind of the spectrum of a sea of one wave system.
    hs, tp, gamma, wave_direction_deg : Its parameters: m, s, peak enhancement, deg.
    spreading : Kind and exponent of its spreading.
    sea : A `SeaState` in plain data, in place of all of these.
    realised_hs_of_systems : m, where there are several wave systems.
    realised_hs : 4 sqrt(sum a^2 / 2), m.
    wave_energy_without_load, load_variance_without_load : float or None
        Shares of the waves beyond the database's frequencies.
    """

    spectrum: str | None = None
    hs: float | None = None
    tp: float | None = None
    gamma: float | None = None
    wave_direction_deg: float | None = None
    spreading: Mapping[str, Any] | None = None
    sea: Mapping[str, Any] | None = None
    realised_hs_of_systems: Mapping[str, float] | None = None
    seed: int | None = None
    wave_components: int | None = None
    repeat_found: int | None = None
    realised_hs: float | None = None
    repeat_period_s: float | None = None
    wave_energy_without_load: float | None = None
    load_variance_without_load: float | None = None

    def settings(self) -> dict[str, Any]:
        """What the sea was made from, as far as it is known."""
        return {name: value for name, value in self._known().items() if name in SEA_SETTINGS}

    def stats(self) -> dict[str, Any]:
        """What its realisation came to, as far as it is known."""
        return {name: value for name, value in self._known().items() if name not in SEA_SETTINGS}

    def _known(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if value is not None}


SEA_SETTINGS = tuple(one.name for one in fields(SeaProvenance))[:8]
