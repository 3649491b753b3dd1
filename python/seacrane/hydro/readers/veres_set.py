"""The files of one ShipX/VERES stem: which there are, whether they are of one run, which speeds they hold."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from seacrane.errors import FileFormatError
from seacrane.hydro.readers.veres_files import (
    Case,
    DriftFile,
    MatricesFile,
    TransferFile,
    read_drift,
    read_matrices,
    read_transfer,
    same_speed,
)
from seacrane.inputs.caller import warn_caller
from seacrane.warnings import PartialSetWarning, SeveralSpeedsWarning

LOST = {  # with a file that need not be there
    ".re8": "wave forces are solved from the motions",
    ".re1": "motions are not compared",
    ".re2": "no drift",
    ".hyd": "hydrostatics are not compared",
}
SUFFIXES = (".re7", ".re8", ".re1", ".re2", ".hyd")
MATRICES_AND_FORCE = SUFFIXES[:2]


@dataclass(frozen=True, eq=False)
class VeresSet:
    """The files of one stem; what is not there is None."""

    stem: Path
    matrices: MatricesFile
    force: TransferFile | None
    motion: TransferFile | None
    drift: DriftFile | None

    def files(self) -> list[MatricesFile | TransferFile | DriftFile]:
        every = (self.matrices, self.force, self.motion, self.drift)
        return [file for file in every if file is not None]


def veres_speeds(path: Path) -> tuple[float, ...]:
    """Forward speeds (m/s) that every file of the set at ``path`` holds."""
    return common_speeds(read_set(find_stem(path)))


def is_veres(path: Path) -> bool:
    """Whether ``path`` is a folder, stem or file of a VERES set."""
    if path.is_dir():
        return any(file.suffix.lower() in MATRICES_AND_FORCE for file in path.iterdir())
    stem = find_stem(path)
    return any(sibling(stem, suffix) is not None for suffix in MATRICES_AND_FORCE)


def find_stem(path: Path) -> Path:
    """Common stem (folder and name without suffix) of the set of files that ``path`` points to."""
    if path.is_dir():
        stems = sorted({file.with_suffix("") for file in path.iterdir() if file.suffix.lower() == ".re7"})
        if len(stems) != 1:
            found = ", ".join(stem.name for stem in stems) or "none"
            raise FileFormatError(
                f"{path}: one .re7 file is needed in a VERES folder, found: {found}; give the stem"
            )
        return stems[0]
    return path.with_suffix("") if path.suffix.lower() in SUFFIXES else path


def sibling(stem: Path, suffix: str) -> Path | None:
    """File of the set with that suffix, in either case."""
    for name in (stem.name + suffix, stem.name + suffix.upper()):
        if (stem.parent / name).is_file():
            return stem.parent / name
    return None


def read_set(stem: Path) -> VeresSet:
    """All files of the set, from one calculation."""
    re7, re8, re1, re2 = (sibling(stem, suffix) for suffix in SUFFIXES[:4])
    if re7 is None:
        raise FileFormatError(
            f"{stem}.re7: no such file; without it there is no mass, added mass, damping nor restoring. "
            "Motions alone (.re1) move a given ship: seacrane.MotionRaos"
        )
    if re8 is None and re1 is None:
        raise FileFormatError(
            f"{stem}.re8: no such file, nor .re1, from whose motions wave forces follow: without both "
            "there is no load of waves"
        )
    matrices, force = read_matrices(re7), None if re8 is None else read_transfer(re8)
    motion = None if re1 is None else read_transfer(re1)
    drift = None if re2 is None else read_drift(re2)
    found = VeresSet(stem, matrices, force, motion, drift)
    for file in found.files():
        header = file.header
        if isinstance(file, DriftFile):
            header = replace(header, lcg_aft=matrices.header.lcg_aft, vcg=matrices.header.vcg)
        if header != matrices.header:
            raise other_run(file.path, "header (density, gravity, dimensions)")
    return found


def other_run(path: Path, what: str) -> FileFormatError:
    """Error of a file that belongs to another calculation."""
    return FileFormatError(f"{path}: {what} differ from the .re7 file; use files of one VERES run")


def common_speeds(found: VeresSet) -> tuple[float, ...]:
    """Speeds of ``.re7`` that all other files hold too."""
    speeds = [case.speed for case in found.matrices.cases]
    common = [
        speed
        for speed in speeds
        if all(any(same_speed(speed, case.speed) for case in file.cases) for file in found.files())
    ]
    if not common:
        lists = "; ".join(f"{file.path.name}: {_listed(_of(file))}" for file in found.files())
        raise FileFormatError(
            f"{found.stem}: no speed is in every file ({lists}); use files of one VERES run"
        )
    return tuple(sorted(common))


def _of(file: MatricesFile | TransferFile | DriftFile) -> list[float]:
    return [case.speed for case in file.cases]


def _listed(values: Sequence[float]) -> str:
    return ", ".join(f"{value:g}" for value in values[:8]) + (", ..." if len(values) > 8 else "") + " m/s"


def choose_speed(found: VeresSet, speed: float | None) -> float:
    """The speed to read, with warnings about the others."""
    common = common_speeds(found)
    partial: list[float] = []
    for value in sorted(value for file in found.files() for value in _of(file)):
        if not any(same_speed(value, other) for other in (*common, *partial)):
            partial.append(value)
    if partial:
        warn_caller(
            f"{found.stem}: speeds {_listed(partial)} are not in every file of the set; only the common "
            f"ones, {_listed(common)}, can be read, and nothing is known beyond them",
            PartialSetWarning,
        )
    if speed is not None:
        match = [value for value in common if same_speed(value, speed)]
        if not match:
            raise FileFormatError(f"{found.stem}: no speed {speed:g} m/s; the files hold {_listed(common)}")
        return match[0]
    nearest = min(common, key=abs)
    if len(common) > 1:
        warn_caller(
            f"{found.stem}: the files hold speeds {_listed(common)}; {nearest:g} m/s is read, and motions at "
            "another speed differ. Give speed=... to choose",
            SeveralSpeedsWarning,
        )
    return nearest


def at_speed(cases: Sequence[Case], speed: float) -> Case:
    """The one of a file's cases that has the speed."""
    return next(case for case in cases if same_speed(case.speed, speed))
