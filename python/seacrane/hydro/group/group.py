"""`HydroGroup`: several hulls in one water, with all that is done to them."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Mapping, Sequence
from functools import cache, cached_property
from importlib.resources import files
from itertools import combinations
from os import PathLike
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from seacrane.arrays import Complex
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro.data.frozen import reading
from seacrane.hydro.data.hydro_data import HydroData
from seacrane.hydro.data.hydro_group_data import HydroGroupData, in_trusted_band
from seacrane.hydro.data.motion import motion_response
from seacrane.hydro.data.packed import NOT_PACKED, digest_of, packed, unpacked
from seacrane.hydro.data.relations import (
    damping_from_forces,
    infinite_added_mass_from_damping,
    resolved_by_headings,
)
from seacrane.hydro.database.check import (
    DAMPING_LIMIT,
    FORCE_DAMPING_LIMIT,
    KRAMERS_KRONIG_LIMIT,
    SYMMETRY_LIMIT,
    CheckRow,
    at_least,
    at_most,
    fit_rows,
    info,
    passivity_rows,
    skewness,
)
from seacrane.hydro.database.database import HydroDatabase
from seacrane.hydro.group.gap import Gap, clearance, gaps, long_wave_lift, natural_modes_of, radiating, spikes
from seacrane.hydro.group.lid import group_with_lid
from seacrane.hydro.group.parts import (
    group_of_databases,
    hull_of,
    moved_group,
    ordered_group,
    place_of,
    uncoupled_group,
)
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.frames import MOTIONS
from seacrane.inputs.shown import shown
from seacrane.inputs.user_cache import read_kept

MAGIC = b"seacrane hydro group "
VERSION = 1
MOST_BYTES = 1_000_000_000  # of the numbers, so that no damaged file fills the memory
SAME_PLACE = 0.01  # m
SAME_DRAUGHT = 0.02  # of it
FILES: dict[float | None, str] = {None: "alone", 0.01: "lid_0.01", 0.03: "lid_0.03"}


class HydroGroup(HydroGroupData):
    __doc__ = HydroGroupData.__doc__

    __getitem__ = hull_of
    at = moved_group
    ordered = ordered_group
    without_coupling = uncoupled_group
    natural_modes = natural_modes_of
    with_lid_damping = group_with_lid

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
        SceneError : boxes of hulls that overlap, or headings of the waves that would have to be interpolated
            over more than 45 degrees.
        """
        group = group_of_databases(HydroGroup, databases, positions, headings or {}, name)
        require_apart(group)
        return group

    @property
    def hulls(self) -> Mapping[str, HydroDatabase]:
        """`group[name]` of every body, by name."""
        return {name: self[name] for name in self.names}

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.bodies)

    @cached_property
    def motion_rao(self) -> Complex:
        """Motions (m, n, 6 k) per metre of wave amplitude, all hulls together; read-only.

        ``(-w^2 (M + A) + i w (B + B_lin) + C) X = F`` (`motion_response`), phases from the group's origin.
        Quadratic damping is left out, and there is no mooring.
        """
        motions = motion_response(self)
        motions.setflags(write=False)
        return motions

    def gaps(self) -> list[Gap]:
        """The gaps between hulls that are narrower than these, with the piston mode of their water by Molin.

        Main dimensions are those of the bodies' boxes. A hull within another's ring has no gap here.
        """
        return gaps(self)

    def check(self) -> list[CheckRow]:
        """All checks that the group's content allows, over all motions; docs/hull-hydrodynamics.md says what
        each value means."""
        memory = self.memory
        return [
            *_matrix_rows(self),
            *_far_field_rows(self),
            *_dispersion_rows(self),
            *_water_rows(self),
            *([] if memory is None else fit_rows(memory) + passivity_rows(memory)),
        ]

    def require(
        self, *, names: Sequence[str] | None = None, positions: Mapping[str, ArrayLike] | None = None,
        draughts: Mapping[str, float] | None = None, apart: bool = False,
    ) -> None:  # fmt: skip
        """Raise unless the group is what its user takes it for.

        Parameters
        ----------
        names : of the bodies, in this order.
        positions : (3,) m, by name: the reference points, to 0.01 m.
        draughts : m, by name, to 2 %.
        apart : whether boxes of hulls may not overlap; a hull within the ring of another has one that does.

        Raises
        ------
        SceneError : names the body, both values and the fix.
        """
        what = f"group {self.name!r}"
        if names is not None and tuple(names) != self.names:
            ordered = sorted(names) == sorted(self.names)
            fix = "they stand in another order: use group.ordered(names)" if ordered else "name each body"
            raise SceneError(
                f"{what}: holds {', '.join(self.names)}, not {', '.join(map(str, names))}; {fix}"
            )
        positions, draughts = positions or {}, draughts or {}
        for asked, given in (("positions", [*positions]), ("draughts", [*draughts])):
            for name in [one for one in given if one not in self.names]:
                raise SceneError(
                    f"{what}: {asked} name {name!r}, which it has not; it has {', '.join(self.names)}"
                )
        for body in self.bodies:
            place = np.asarray(positions.get(body.name, body.position), dtype=float)
            if place.shape != (3,) or not np.allclose(place, body.position, rtol=0.0, atol=SAME_PLACE):
                raise SceneError(
                    f"{what}: {body.name} has its reference point at {place_of(body.position)} m, not at "
                    f"{place_of(place)}: its matrices are about another point; use that one, or compute anew"
                )
            draught = float(draughts.get(body.name, body.draught))
            if not abs(draught - body.draught) <= SAME_DRAUGHT * body.draught:
                raise SceneError(
                    f"{what}: {body.name} was computed with a draught of {body.draught:.4g} m, and "
                    f"{draught:.4g} m is asked for; compute it at that draught"
                )
        if apart:
            require_apart(self)

    def save(self, path: str | PathLike[str]) -> None:
        """Write everything, the memory model included, to a file of seacrane, atomically and without loss.

        The memory of a group takes long to fit, and no panel code's file holds it.
        """
        with atomic_write(Path(path)) as draft:
            draft.write_bytes(MAGIC + b"%d\n" % VERSION + zlib.compress(packed(self), 9))

    @staticmethod
    def load(path: str | PathLike[str]) -> HydroGroup:
        """Read a file written by `save`.

        Raises
        ------
        seacrane.errors.FileFormatError : the file is not one of ours, or is damaged.
        """
        source = Path(path)
        if not source.is_file():
            raise FileFormatError(
                f"{source}: no such file; give the path of a group that HydroGroup.save wrote"
            )
        with reading(source, "a group of seacrane", (OSError, zlib.error, *NOT_PACKED)):
            found: HydroGroup = unpacked(_numbers(source), (HydroGroup,))
        return found

    @property
    def digest(self) -> str:
        """SHA-256 of all that it holds: equal for groups that say the same."""
        return digest_of(self)

    def __repr__(self) -> str:
        return (
            f"<HydroGroup {self.name!r}: {', '.join(self.names)}, {self.omega.size} frequencies "
            f"{self.omega[0]:.4g} to {self.omega[-1]:.4g} rad/s, {self.heading.size} headings>"
        )


def _numbers(source: Path) -> bytes:
    """What `HydroGroup.save` packed into a file."""
    data = read_kept(source)
    if not data.startswith(MAGIC):
        raise FileFormatError(
            f"{source}: no group of seacrane; save one with HydroGroup.save, or read a panel code's files "
            "with load_database"
        )
    version, _, body = data[len(MAGIC) :].partition(b"\n")
    if version != b"%d" % VERSION:
        raise FileFormatError(
            f"{source}: is of format version {shown(version[:8].decode('ascii', 'replace'))}, and this "
            f"seacrane reads format version {VERSION}; save it again with HydroGroup.save"
        )
    reader = zlib.decompressobj()
    numbers = reader.decompress(body, MOST_BYTES)
    if not reader.eof:
        raise ValueError("it ends within its numbers")
    return numbers


def require_apart(group: HydroGroupData) -> None:
    """Raise where the boxes of two hulls overlap.

    A hull within the ring of another has an overlapping box, and is no mistake.
    """
    for first, second in combinations(group.bodies, 2):
        width, _ = clearance(first, second)
        if width < 0.0:
            raise SceneError(
                f"group {group.name!r}: {first.name} and {second.name} overlap by {-width:.3g} m, as boxes "
                f"of {first.length:.4g} x {first.breadth:.4g} m and {second.length:.4g} x "
                f"{second.breadth:.4g} m at their positions and headings; move them apart"
            )


@cache
def two_barges(*, lid_damping: float | None) -> HydroGroup:
    """Two box barges that come with the package, memory included; read once, immutable.

    "crane vessel" is 100 x 25 x 5.5 m (length, breadth, draught), "feeder" 60 x 18 x 3.5 m, abreast to port
    of it with a gap of 5 m, in deep water. `tools/two_barges.py` computes them with Capytaine.

    Parameters
    ----------
    lid_damping : of the lid on the water in the gap, 0.01 or 0.03 (`HydroGroup.with_lid_damping`): compare
        both, as no theory tells it. None: each hull as if alone, without interaction.

    Raises
    ------
    SceneError : another damping.
    """
    if lid_damping not in FILES:
        raise SceneError(
            f"two barges: lid_damping is {lid_damping!r}; those that come with the package are 0.01 and "
            "0.03, and None for hulls without interaction"
        )
    return HydroGroup.load(
        Path(str(files("seacrane") / "data" / "two_barges" / f"{FILES[lid_damping]}.hydro"))
    )


COUPLING_LIMIT = 0.1  # thin plates and narrow gaps: codes differ by 25 % on coupling
LIFT_LIMIT = 0.1


def _matrix_rows(group: HydroGroupData) -> list[CheckRow]:
    """Symmetry of the hulls' own blocks and of what couples them, and damping that takes energy from all.

    Of motions that radiate: what a file holds for others is noise.
    """
    own = np.kron(np.eye(len(group.bodies)), np.ones((6, 6))).astype(bool)
    inside, felt = in_trusted_band(group), radiating(group)
    both = np.outer(felt, felt)
    rows = []
    for name, matrix in (("added_mass", group.added_mass), ("damping", group.damping)):
        skew = np.where(both, skewness(matrix[inside]), 0.0)
        rows.append(at_most(f"symmetry_{name}", float(skew[own].max()), SYMMETRY_LIMIT))
        rows.append(at_most(f"symmetry_{name}_coupling", float(skew[~own].max()), COUPLING_LIMIT))
    damping = group.damping[inside][:, felt][:, :, felt]
    if damping.size:
        rows.append(at_least("damping_smallest_eigenvalue", _smallest_damping(damping), DAMPING_LIMIT))
    return rows


def _smallest_damping(damping: NDArray[np.float64]) -> float:
    """Smallest eigenvalue of B over all frequencies, scaled by the square roots of its largest diagonals."""
    peak = np.sqrt(np.maximum(np.diagonal(damping, axis1=1, axis2=2).max(axis=0), 0.0))
    active = peak > 0.0
    if not np.any(active):
        return 0.0
    scaled = (damping[:, active][:, :, active]) / np.outer(peak[active], peak[active])
    return float(np.linalg.eigvalsh(0.5 * (scaled + scaled.swapaxes(1, 2)))[:, 0].min())


def _far_field_rows(group: HydroGroupData) -> list[CheckRow]:
    """Damping (own and coupled) against the waves that the exciting forces say are radiated."""
    radiated = damping_from_forces(group)
    inside = in_trusted_band(group) & resolved_by_headings(group)
    if radiated is None or not np.any(inside):
        return []
    peak = np.sqrt(np.abs(np.diagonal(group.damping, axis1=1, axis2=2)).max(axis=0))
    felt = radiating(group)
    error = np.abs(radiated - 0.5 * (group.damping + group.damping.swapaxes(1, 2)))[inside].max(axis=0)
    share = np.where(np.outer(felt, felt), error / np.maximum(np.outer(peak, peak), 1e-300), 0.0)
    return _by_motion_and_pair(group, "damping_from_forces", share, felt, FORCE_DAMPING_LIMIT)


def _dispersion_rows(group: HydroGroupData) -> list[CheckRow]:
    """Infinite-frequency added mass against what the damping implies, by the range of the motions' own."""
    if group.infinite_frequency_added_mass is None:
        return []
    known = group.infinite_frequency_added_mass
    difference = np.abs(infinite_added_mass_from_damping(group) - known)
    span = np.ptp(np.diagonal(group.added_mass, axis1=1, axis2=2), axis=0)
    felt = radiating(group) & (span > 0.0)
    share = np.where(
        np.outer(felt, felt), difference / np.maximum(np.sqrt(np.outer(span, span)), 1e-300), 0.0
    )
    return _by_motion_and_pair(group, "kramers_kronig", share, felt, KRAMERS_KRONIG_LIMIT)


def _by_motion_and_pair(
    group: HydroGroupData, name: str, share: NDArray[np.float64], felt: NDArray[np.bool_], limit: float
) -> list[CheckRow]:
    """A row for each motion that is felt, and one for the largest entry between each two hulls."""
    labels = [f"{hull}_{motion}" for hull in group.names for motion in MOTIONS]
    rows = [at_most(f"{name}_{labels[i]}", float(share[i, i]), limit) for i in np.flatnonzero(felt)]
    for (i, a), (j, b) in combinations(enumerate(group.names), 2):
        block = share[6 * i : 6 * i + 6, 6 * j : 6 * j + 6]
        rows.append(at_most(f"{name}_{a}_{b}", float(block.max()), limit))
    return rows


def _water_rows(group: HydroGroupData) -> list[CheckRow]:
    """Each hull's C33 against the force of a long wave on it, which hydrostatics of another hull fail; widths
    of the gaps, their piston modes, and what explains each narrow peak of the damping.

    An irregular frequency within the trusted band is an error of the source; a resonance of a gap is water,
    too high without a damping lid.
    """
    lift = long_wave_lift(group)
    rows = [
        at_most(f"c33_against_long_wave_{body.name}", abs(body.restoring[2, 2] / force - 1.0), LIFT_LIMIT)
        for body, force in zip(group.bodies, () if lift is None else lift, strict=lift is not None)
    ]
    for a, b in combinations(group.bodies, 2):
        rows.append(info(f"clearance_{a.name}_{b.name}_m", clearance(a, b)[0]))
    rows += [info(f"gap_{gap.first}_{gap.second}_piston_rad_s", gap.piston) for gap in gaps(group)]
    for spike in spikes(group):
        label = f"{spike.cause}_frequency{'_' if spike.of else ''}{spike.of}_rad_s"
        wrong = spike.cause == "irregular" and in_trusted_band(group, np.array(spike.omega))
        verdict = "fail" if wrong else "info"
        rows.append(CheckRow(check=label, value=spike.omega, limit=None, verdict=verdict))
    if group.lid_damping is not None:
        rows.append(info("lid_damping", group.lid_damping))
    return rows
