"""`HydroGroup`: several hulls in one water, with all that is done to them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from numpy.typing import ArrayLike

from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import HydroGroupData
from seacrane.hydro.data.packed import digest_of
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.parts import group_of_databases, hull_of, ordered_group, uncoupled_group


class HydroGroup(HydroGroupData):
    __doc__ = HydroGroupData.__doc__

    @staticmethod
    def from_databases(
        *,
        databases: Mapping[str, HydroData],
        positions: Mapping[str, ArrayLike],
        headings: Mapping[str, float] | None = None,
        name: str = "group",
    ) -> HydroGroup:
        """Hulls beside each other that do not feel each other: no coupling, and forces as if alone.

        Parameters
        ----------
        databases : of each hull alone, by name, with the same frequencies, in one water.
        positions : (3,) m, the reference point of each from the group's origin on the still waterline.
        headings : rad, of the x axis of each, 0 where not given.
        name : of the group.

        Raises
        ------
        ValueError : other names in the two, another water or other frequencies, a forward speed, additional
            matrices or tabulated roll damping.
        SceneError : headings of the waves that would have to be interpolated over more than 45 degrees.
        """
        return group_of_databases(HydroGroup, databases, positions, headings or {}, name)

    def __getitem__(self, name: str) -> HydroDatabase:
        """One hull while the others are held at rest beside it: its own blocks, forces with shielding.

        It is not the hull alone: the others reflect its waves, and shield it. Waves have zero phase at its
        reference point, headings count from its own x axis.
        """
        return hull_of(self, name)

    @property
    def hulls(self) -> Mapping[str, HydroDatabase]:
        """`group[name]` of every body, by name."""
        return {name: self[name] for name in self.names}

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.bodies)

    def ordered(self, names: Sequence[str]) -> HydroGroup:
        """The same group with its bodies in another order; a memory moves along.

        Raises
        ------
        ValueError : not each body once.
        """
        return ordered_group(self, names)

    def without_coupling(self) -> HydroGroup:
        """The group whose hulls do not feel each other's motions: no blocks beside the diagonal, no memory.

        Forces stay as they are, with the shielding.
        """
        return uncoupled_group(self)

    @property
    def digest(self) -> str:
        """SHA-256 of all that it holds: equal for groups that say the same."""
        return digest_of(self)

    def __repr__(self) -> str:
        return (
            f"<HydroGroup {self.name!r}: {', '.join(self.names)}, {self.omega.size} frequencies "
            f"{self.omega[0]:.4g} to {self.omega[-1]:.4g} rad/s, {self.heading.size} headings>"
        )
