"""What is fuzzed: each reader, how a case reaches it, what it may answer, and whether the answer is sound."""

from __future__ import annotations

import contextlib
import hashlib
import json
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from fuzz.limits import bounded
from fuzz.mutate import mutate_json, mutate_text
from fuzz.netcdf_spec import build
from seacrane import Lift, MotionHistory, Scene, sea
from seacrane.crane import JointedCrane, KnuckleBoomCrane
from seacrane.crane.jointed_file import load as load_jointed
from seacrane.crane.urdf import read_urdf
from seacrane.errors import FileFormatError, SceneError, SimulationError
from seacrane.hydro import Hull, HydroDatabase
from seacrane.hydro.readers import (
    bemio,
    bemio_group,
    capytaine,
    capytaine_group,
    nemoh,
    nemoh_group,
    orcaflex,
    veres,
    wamit,
    wamit_group,
)
from seacrane.hydro.readers.load import OF_SEVERAL
from seacrane.inputs.gltf import read_gltf
from seacrane.inputs.hdf5_structure import Structure
from seacrane.inputs.netcdf_limits import LARGEST_DATABASE as LARGEST
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS
from seacrane.inputs.state import load_state
from seacrane.lift.study_file import StudyFile
from seacrane.result import Result
from seacrane.statistics import MeasuredSeries

CORPUS = Path(__file__).parent / "corpus"
LONGEST_MESSAGE = 2000  # characters: what a file holds may not flood the screen
INFINITE = ("depth", "band", "rows")  # may be infinite, or not a number where a fit has no data


@dataclass(frozen=True)
class Target:
    """One kind of case.

    ``file`` is the name a case is written under, beside the files of the corpus folder ``beside``;
    ``modules`` are the sources whose lines count as the reader's; what ``read`` returns has to be finite.
    """

    name: str
    reader: str
    file: str
    read: Callable[[Path], Any]
    modules: tuple[str, ...]
    mutate: Callable[[bytes, random.Random], bytes] | None = mutate_text
    beside: str | None = None
    refusals: tuple[type[Exception], ...] = (FileFormatError,)
    netcdf: bool = False
    unfolds: bool = False  # compressed arrays, of which the file says how large they are

    def place(self, folder: Path) -> None:
        """The files that stand beside a case."""
        if self.beside:
            for file in (CORPUS / self.beside).iterdir():
                if file.name != self.file:
                    (folder / file.name).write_bytes(file.read_bytes())

    def run(self, case: bytes, folder: Path) -> str:
        """Read a case: "value", "refused", or "no case"; anything unsound raises.

        That is: another exception, a message that floods or does not name the file, a number that is not
        finite, more time or memory than its size allows.
        """
        path = folder / self.file
        if not self.netcdf:
            path.write_bytes(case)
        elif not build(case, path):
            return "no case"
        try:
            unfolded = (lambda: announced(path)) if self.unfolds else None
            with bounded(path.stat().st_size, unfolded):
                value = self.read(path)
        except self.refusals as error:
            if len(str(error)) > LONGEST_MESSAGE + len(str(path)):
                length, start = len(str(error)), str(error)[:200]
                raise AssertionError(f"a message of {length} characters: {start}") from None
            if isinstance(error, FileFormatError) and path.stem not in str(error):
                raise AssertionError(f"a message that does not name the file: {error}") from None
            return "refused"
        require_finite(self.name, value)
        return "value"


def announced(path: Path) -> int:
    """Bytes of the arrays of a NetCDF file, as far as they are not refused for their size."""
    structure = Structure(path, LARGEST, "")
    try:
        structure.check()
    except (FileFormatError, *NETCDF_ERRORS):
        return 0
    return structure.arrays


def require_finite(place: str, value: Any) -> None:
    """Raise unless every number in arrays and dataclasses is finite."""
    if is_dataclass(value) and not isinstance(value, type):
        for entry in fields(value):
            if entry.name not in INFINITE:
                require_finite(f"{place}.{entry.name}", getattr(value, entry.name))
    elif isinstance(value, tuple | list):
        for i, item in enumerate(value):
            require_finite(f"{place}[{i}]", item)
    elif isinstance(value, float | complex | np.ndarray | np.generic):
        array = np.asarray(value)
        if array.dtype.kind in "fc" and not np.all(np.isfinite(array)):
            raise AssertionError(f"{place} is not finite: {array[~np.isfinite(array)].ravel()[:3]}")


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Warnings of the readers are not what is looked for; NaN that comes of an overflow is found above."""
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def _veres(path: Path) -> Any:
    return veres.read_veres(path.with_suffix(""))


def _wamit(path: Path) -> Any:
    return wamit.read_wamit(path.with_suffix(""))


def _capytaine(path: Path) -> Any:
    capytaine.is_capytaine(path)  # as `load_database` asks first
    return capytaine.read_capytaine(path)


def _nemoh(path: Path) -> Any:
    return nemoh.read_nemoh(path.parent)


def _bemio(path: Path) -> Any:
    bemio.is_bemio(path)
    return bemio.read_bemio(path)


def _wamit_group(path: Path) -> Any:
    """As `load_database` asks first."""
    for kind in OF_SEVERAL:
        kind.can_open(path.with_suffix(".out"))
    return wamit_group.read_wamit_group(path.with_suffix(".out"))


def _nemoh_group(path: Path) -> Any:
    nemoh_group.FORMAT.can_open(path.parent)
    return nemoh_group.read_nemoh_group(path.parent)


def _capytaine_group(path: Path) -> Any:
    capytaine_group.FORMAT.can_open(path)
    return capytaine_group.read_capytaine_group(path)


def _bemio_group(path: Path) -> Any:
    bemio_group.FORMAT.can_open(path)
    return bemio_group.read_bemio_group(path)


def _mafredo(path: Path) -> Any:
    return orcaflex.read_orcaflex(path, mass_matrix=np.diag([1e7] * 3 + [1e9] * 3), restoring=np.eye(6) * 1e7)


def _hull_of_offsets(path: Path) -> Any:
    return Hull.from_offsets(path).panels


def _hull_of_stl(path: Path) -> Any:
    return Hull.from_stl(path).panels


def _gltf(path: Path) -> Any:
    return read_gltf(path, most=1000)


def _scene(path: Path) -> Any:
    """A scene that loads has to compile, or to be refused by name."""
    scene = Scene.load(path)
    with contextlib.suppress(SceneError):
        scene.compile()


def _crane(path: Path) -> Any:
    """A crane file that is read gives bodies with mass and inertia."""
    crane = KnuckleBoomCrane.load(path)
    return list(crane.mass_properties.values())


def _jointed(path: Path) -> Any:
    """A crane of bodies and joints that is read gives its parts, or a pose that is refused by name."""
    crane = JointedCrane(load_jointed(path))
    with contextlib.suppress(SceneError):
        crane.parts(foot=(0.0, 0.0, 0.0))
    return list(crane.mass_properties.values())


def _urdf(path: Path) -> Any:
    """A URDF file that is read gives bodies with mass and inertia."""
    return [body.properties for body in read_urdf(path).bodies]


def _lift(path: Path) -> Any:
    """A lift that loads has to build and to compile, or to be refused by name; without what takes long."""
    lift = Lift.load(path)
    if not {"vessel", "sea", "control"} & set(lift.tables):
        scene = lift.scene()
        with contextlib.suppress(SceneError, SimulationError):  # of angles that are singular at the start
            scene.compile()


def _study(path: Path) -> Any:
    """A study that is read has its members and its lift, which may be another file."""
    study = StudyFile.load(path)
    study.settings(study.lift())
    return [len(study.members), *(study.until or {}).values()]


def _measured(path: Path) -> Any:
    """The arguments of `MeasuredWaves` as JSON; what is no such object is refused here."""
    try:
        arguments = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        raise SceneError("no JSON") from None
    known = {entry.name for entry in fields(sea.MeasuredWaves)} - {"spreading"}
    if (
        not isinstance(arguments, dict)
        or not {"time", "elevation", "direction_deg"} <= set(arguments) <= known
    ):
        raise SceneError("other arguments")
    waves = sea.MeasuredWaves(**arguments)
    components = waves.waves(direction=np.radians(waves.direction_deg), depth=np.inf)
    return [waves.band_passed(), components.amplitude, components.phase]


def _series(path: Path) -> Any:
    """Columns of any kind, mended, filtered and resampled where that is possible."""
    found = MeasuredSeries.load(path, maximum_gap=1.0, drop_outliers=True)
    with contextlib.suppress(SceneError):
        found = found.filtered(0.3).resampled(1.0)
    return [found.time, *found.columns.values()]


def _motion_record(path: Path) -> Any:
    """Six motions of a file without one of them."""
    history = MotionHistory.load(path, zero=["sway"], rate_hz=10.0)
    return [history.time, history.motion]


def _state(path: Path) -> Any:
    """A state file as it is, then with its checksum made right, so that damage reaches the reader."""
    content = path.read_bytes()
    with contextlib.suppress(FileFormatError):
        load_state(path)
    path.write_bytes(content + hashlib.sha256(content).digest())
    load_state(path)


def _result(path: Path) -> Any:
    """A scene in it is read as well, or refused by name."""
    found = Result.load(path, largest=LARGEST)
    if found.kept_scene is not None:
        _ = found.scene
    return [] if found.interrupted else list(found.channels.values())


_NETCDF = ("inputs/netcdf_limits.py", "inputs/hdf5_structure.py")
_SCENE = (
    "description/file.py",
    "inputs/node.py",
    "description/file_waves.py",
    "description/file_text.py",
    "description/file_origin.py",
    "inputs/plain_data.py",
    "description/file_elements.py",
)
_ORCAFLEX = ("hydro/readers/orcaflex.py", "hydro/readers/orcaflex_model.py")
_VERES = tuple(
    f"hydro/readers/{name}.py"
    for name in ("veres", "veres_files", "veres_set", "veres_hydrostatics", "text_records")
)
_WAMIT = tuple(f"hydro/readers/{name}.py" for name in ("wamit", "wamit_control", "wamit_tables"))
_WAMIT_GROUP = tuple(f"hydro/readers/{name}.py" for name in ("wamit_group", "wamit_listing"))
_NEMOH = ("hydro/readers/nemoh.py",)
_NEMOH_GROUP = ("hydro/readers/nemoh_group.py",)
_NEMOH_FILES = (nemoh.RADIATION, nemoh.EXCITATION, nemoh.CONTROL, "Kh_1.dat", "Hydrostatics_1.dat")
_LIFT = tuple(f"lift/{name}.py" for name in ("document", "text_lines", "check_keys", "curve_text"))
_SERIES = tuple(f"series/{name}.py" for name in ("series_file", "headings", "reading", "rows", "clock"))
_RECORDED = (*_SERIES, "series/mending.py", "scene/recorded_motion.py")
_SHAPE = (FileFormatError, ValueError)


def _set_targets(
    name: str, kinds: str, read: Callable[[Path], Any], modules: tuple[str, ...]
) -> list[Target]:
    """One target for each file of a set, the others being sound."""
    return [
        Target(f"{name}-{kind}", name, f"box.{kind}", read, modules, beside=name) for kind in kinds.split()
    ]


def _netcdf_targets(name: str, file: str, read: Callable[[Path], Any], *modules: str) -> list[Target]:
    """Files written from mutated specifications, and files mutated byte by byte."""
    return [
        Target(name, name, file, read, (*modules, *_NETCDF), mutate_json, netcdf=True, unfolds=True),
        Target(f"{name}-bytes", name, file, read, (*modules, *_NETCDF), None, unfolds=True),
    ]


_JOINTED = ("crane/jointed_file.py", "crane/jointed_check.py", "crane/link_frames.py")
_URDF = ("crane/urdf.py", "crane/urdf_values.py", "crane/urdf_visuals.py")
_ALL = [
    *_set_targets("veres", "re7 re8 re1 re2 hyd", _veres, _VERES),
    *_set_targets("wamit", "1 3 4 hst frc out cfg", _wamit, _WAMIT),
    *[
        Target(f"nemoh-{name.split('.')[0].lower()}", "nemoh", name, _nemoh, _NEMOH, beside="nemoh")
        for name in (nemoh.RADIATION, nemoh.EXCITATION, nemoh.STIFFNESS, nemoh.HYDROSTATICS, nemoh.CONTROL)
    ],
    Target("orcaflex", "orcaflex", "ship.yml", orcaflex.read_orcaflex, _ORCAFLEX, mutate_json),
    *_set_targets("wamit-group", "out 1 3 hst", _wamit_group, _WAMIT_GROUP),
    Target("wamit-listing", "wamit-listing", "box.out", _wamit_group, _WAMIT_GROUP),
    *[
        Target(
            f"nemoh-group-{name.split('.')[0].lower()}", "nemoh-group", name, _nemoh_group, _NEMOH_GROUP,
            beside="nemoh-group",
        )
        for name in _NEMOH_FILES
    ],
    Target("orcaflex-text", "orcaflex", "ship.yml", orcaflex.read_orcaflex, _ORCAFLEX),
    Target("offsets", "offsets", "hull.txt", _hull_of_offsets, ("hydro/hull/offsets.py",), refusals=_SHAPE),
    Target("stl", "stl", "hull.stl", _hull_of_stl, ("inputs/stl.py",), refusals=_SHAPE),
    Target("gltf", "gltf", "box.gltf", _gltf, ("inputs/gltf.py",), mutate_json),
    Target("gltf-bytes", "gltf", "box.glb", _gltf, ("inputs/gltf.py",), None),
    Target("scene", "scene", "scene.json", _scene, _SCENE, mutate_json),
    Target("lift", "lift", "lift.toml", _lift, _LIFT),
    Target("study", "study", "study.toml", _study, ("lift/study_file.py",)),
    Target("crane", "crane", "crane.toml", _crane, ("crane/data_file.py",)),
    Target("jointed", "jointed", "crane.toml", _jointed, _JOINTED),
    Target("urdf", "urdf", "crane.urdf", _urdf, _URDF),
    Target(
        "measured", "measured", "record.json", _measured, ("sea/measured.py",), mutate_json,
        refusals=(SceneError,),
    ),
    Target("series", "series", "mru.csv", _series, _RECORDED, refusals=(FileFormatError, SceneError)),
    Target(
        "motion-record", "series", "mru.csv", _motion_record, _RECORDED,
        refusals=(FileFormatError, SceneError),
    ),
    Target("state", "state", "run.state", _state, ("inputs/state.py",)),
    *_netcdf_targets("database", "hull.nc", HydroDatabase.load, "hydro/database/netcdf.py",
                     "hydro/readers/seacrane_netcdf.py"),
    *_netcdf_targets("mafredo", "ship.dhyd", _mafredo, "hydro/readers/mafredo_file.py"),
    *_netcdf_targets("capytaine", "ship.nc", _capytaine, "hydro/readers/capytaine.py"),
    *_netcdf_targets("bemio", "ship.h5", _bemio, "hydro/readers/bemio.py"),
    *_netcdf_targets("capytaine-group", "pair.nc", _capytaine_group, "hydro/readers/capytaine_group.py"),
    *_netcdf_targets("bemio-group", "pair.h5", _bemio_group, "hydro/readers/bemio_group.py"),
    *_netcdf_targets("result", "run.nc", _result, "result/result_file.py"),
]  # fmt: skip
TARGETS = {target.name: target for target in _ALL}


def cases(target: Target) -> list[Path]:
    """The committed cases of a target; those of a set's undamaged file included."""
    own = sorted(path for path in (CORPUS / target.name).glob("*") if path.is_file())
    return own + ([CORPUS / target.beside / target.file] if target.beside else [])
