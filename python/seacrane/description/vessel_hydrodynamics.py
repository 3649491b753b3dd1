"""Linear hydrodynamics of a body, with the database that they are from."""

from __future__ import annotations

from functools import partial
from typing import Any

from seacrane import _core
from seacrane.errors import SceneError
from seacrane.hydro import HydroDatabase
from seacrane.hydro.data.motion_raos import MotionRaos
from seacrane.hydro.data.packed import digest_of
from seacrane.inputs.shown import shown

Source = HydroDatabase | MotionRaos


class VesselHydrodynamics(_core.VesselHydrodynamics):
    __doc__ = f"""{_core.VesselHydrodynamics.__doc__}

    `database` is the `HydroDatabase` or `MotionRaos` by which a sea loads or moves the body, or None.
    """

    def __init__(self, *, database: Source | None = None, **matrices: Any) -> None:
        super().__init__(**matrices)
        if database is not None and not isinstance(database, Source):
            raise SceneError.of(
                f"vessel {self.name!r}: database",
                f"is {shown(database)}; give a HydroDatabase, as load_database reads, or MotionRaos",
            )
        self._database = database

    @property
    def database(self) -> Source | None:
        """By which a sea loads or moves the body; None where that is not known."""
        return self._database

    def __getstate__(self) -> dict[str, Any]:
        return super().__getstate__() | {"database": self._database}

    def __reduce__(self) -> tuple[Any, ...]:
        return partial(VesselHydrodynamics, **self.__getstate__()), ()

    def __copy__(self) -> VesselHydrodynamics:
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> VesselHydrodynamics:
        return self

    def __eq__(self, other: object) -> bool:
        same = super().__eq__(other)
        return same if same is not True else alike(self.database, getattr(other, "database", None))

    __hash__ = _core.VesselHydrodynamics.__hash__


def alike(one: Source | None, other: Source | None) -> bool:
    """Whether they hold the same."""
    if one is None or other is None:
        return one is other
    return one is other or digest_of(one) == digest_of(other)
