"""What is fuzzed: each reader, how a case reaches it, what it may answer, and whether the answer is sound."""

from __future__ import annotations

import contextlib
import hashlib
import json
import random
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass
from operator import attrgetter, methodcaller
from pathlib import Path
from typing import Any

import numpy as np

from fuzz.limits import bounded
from fuzz.mutate import mutate_json, mutate_text
from fuzz.netcdf_spec import build
from seacrane import Lift, MotionHistory, Scene, sea
from seacrane.crane import load_crane
from seacrane.crane.urdf import read_urdf
from seacrane.errors import FileFormatError, SceneError, SimulationError
from seacrane.hydro import Hull, HydroDatabase
from seacrane.hydro.readers import aqwa, bemio, capytaine, nemoh, nemoh_files, orcaflex, veres, wamit
from seacrane.inputs.mesh_files import read_gltf
from seacrane.inputs.netcdf_limits import LARGEST_DATABASE as LARGEST
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS, arrays_in
from seacrane.inputs.state import load_state
from seacrane.operability import ScatterDiagram, WaveHindcast
from seacrane.result import Result
from seacrane.statistics import MeasuredSeries

CORPUS = Path(__file__).parent / "corpus"
LONGEST_MESSAGE = 2000  # characters: what a file holds may not flood the screen
INFINITE = ("depth", "band", "rows")  # may be infinite, or not a number where a fit has no data


@dataclass(frozen=True)
class Target:
    """One kind of case, written as ``file`` beside the files of the corpus folder ``beside``; lines of
    ``modules`` count as the reader's; what ``read`` returns has to be finite."""

    name: str
    reader: str
    file: str
    read: Callable[[Path], Any]
    modules: tuple[str, ...]
    mutate: Callable[[bytes, random.Random], bytes] | None = mutate_text
    beside: str | None = None
    refusals: tuple[type[Exception], ...] = (FileFormatError,)
    netcdf: bool = False  # with compressed arrays, of which the file says how large they are

    def place(self, folder: Path) -> None:
        """The files that stand beside a case."""
        if self.beside:
            for file in (CORPUS / self.beside).iterdir():
                if file.name != self.file:
                    (folder / file.name).write_bytes(file.read_bytes())

    def run(self, case: bytes, folder: Path) -> str:
        """Read a case: "value", "refused", or "no case". What is unsound raises: another exception, a message
        that floods or does not name the file, a number that is not finite, too much time or memory."""
        path = folder / self.file
        if not self.netcdf:
            path.write_bytes(case)
        elif not build(case, path):
            return "no case"
        try:
            unfolded = (lambda: announced(path)) if self.netcdf else None
            with bounded(path.stat().st_size, unfolded):
                value = self.read(path)
        except self.refusals as error:
            if len(str(error)) > LONGEST_MESSAGE + len(str(path)):
                raise AssertionError(f"a message of {len(str(error))} characters: {error}"[:250]) from None
            if isinstance(error, FileFormatError) and path.stem not in str(error):
                raise AssertionError(f"a message that does not name the file: {error}") from None
            return "refused"
        require_finite(self.name, value)
        return "value"


def announced(path: Path) -> int:
    """Bytes of the arrays of a NetCDF file, as far as they are not refused for their size."""
    try:
        taken = sum(size for _, _, size in arrays_in(path))
    except (FileFormatError, *NETCDF_ERRORS):
        return 0
    return taken if taken <= LARGEST else 0


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
    with warnings.catch_warnings(action="ignore"):
        yield


Reader = Callable[[Path], Any]


def _of(read: Callable[..., Any], at: Callable[[Path], Path] = Path, *asked: Reader, **given: Any) -> Reader:
    """Reads at a place that follows from that of a case, and asks first what `load_database` asks."""

    def read_it(path: Path) -> Any:
        for ask in asked:
            ask(at(path))
        return read(at(path), **given)

    return read_it


_folder, _stem = attrgetter("parent"), methodcaller("with_suffix", "")
_listing = methodcaller("with_suffix", ".out")


def _scene(path: Path) -> Any:
    """A scene that loads has to compile, or to be refused by name."""
    scene = Scene.load(path)
    with contextlib.suppress(SceneError):
        scene.compile()


def _crane(path: Path) -> Any:
    """A crane that is read gives its parts, or a pose that is refused by name."""
    crane = load_crane(path)
    with contextlib.suppress(SceneError):
        crane.parts()
    return list(crane.mass_properties.values())


def _urdf(path: Path) -> Any:
    return [body.properties for body in read_urdf(path)[1]]


def _lift(path: Path) -> Any:
    """A lift that loads has to build and to compile, or to be refused by name; without what takes long."""
    lift = Lift.load(path)
    if not {"vessel", "sea", "control"} & set(lift.tables):
        scene = lift.scene()
        with contextlib.suppress(SceneError, SimulationError):  # of angles that are singular at the start
            scene.compile()


def _measured(path: Path) -> Any:
    """The arguments of `MeasuredWaves` as JSON; what is no such object is refused here."""
    try:
        arguments = json.loads(path.read_bytes())
    except (ValueError, RecursionError):
        raise SceneError("no JSON") from None
    known = {entry.name for entry in fields(sea.MeasuredWaves)} - {"spreading"}
    needed = {"time", "elevation", "direction_deg"}
    if not isinstance(arguments, dict) or not needed <= set(arguments) <= known:
        raise SceneError("other arguments")
    waves = sea.MeasuredWaves(**arguments)
    components = waves.waves(direction=np.radians(waves.direction_deg), depth=np.inf)
    return [components.amplitude, components.phase]


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


def _log(path: Path) -> Any:
    """A sensor's sentences, with a rate where they have no clock."""
    found = MeasuredSeries.load(path, rate_hz=10.0, maximum_gap=1.0)
    return [found.time, *found.columns.values()]


def _sea_states(path: Path) -> Any:
    """Heights that are not known are NaN; those that are have to be finite."""
    found = WaveHindcast.load(path, utc_offset=None)
    return [found.hs[found.known], found.tp[found.known]]


def _scatter(path: Path) -> Any:
    found = ScatterDiagram.load(path, units={"hs": "m", "tp": "s"}, classes="middle")
    return [found.hs, found.tp, found.counts]


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


def _under(folder: str, names: str) -> tuple[str, ...]:
    return tuple(f"{folder}/{name}.py" for name in names.split())


_SCENE = ("scene/file.py", *_under("inputs", "node plain_data"))
_HYDRO = "hydro/readers"
_ORCAFLEX = _under(_HYDRO, "orcaflex orcaflex_model")
_VERES = _under(_HYDRO, "veres veres_files text_records")
_WAMIT = _under(_HYDRO, "wamit wamit_listing wamit_tables text_records")
_NEMOH = _under(_HYDRO, "nemoh nemoh_files")
_AQWA = _under(_HYDRO, "aqwa aqwa_files")
_COLUMNS = _under("sea", "series_file reading mending")
_RECORDED = (*_COLUMNS, "scene/motion_history.py")
_SEAS = (*_COLUMNS, "operability/sea_states.py")
_LIFT = _under("lift", "document check_keys")
_JOINTED = _under("crane", "load_crane")
_URDF = _under("crane", "urdf")
_SHAPE, _SEEN = (FileFormatError, ValueError), (FileFormatError, SceneError)
_MATRICES = {"mass_matrix": np.diag([1e7] * 3 + [1e9] * 3), "restoring": np.eye(6) * 1e7}


def _set_targets(name: str, files: str, read: Reader, modules: tuple[str, ...]) -> list[Target]:
    """One target for each file of a set, the others being sound."""
    kinds = {file: file.split(".")[file.startswith("box.")].lower() for file in files.split()}
    reader = name.removesuffix("-group")
    return [Target(f"{name}-{kinds[file]}", reader, file, read, modules, beside=name) for file in kinds]


def _netcdf(name: str, file: str, read: Reader, *modules: str, **more: Any) -> Target:
    """Files written from mutated specifications: damage of bytes is answered by HDF5's own checks."""
    reader = name.removesuffix("-group")
    return Target(name, reader, file, read, modules, mutate_json, netcdf=True, **more)


_VERES_FILES = "box.re7 box.re8 box.re1 box.re2 box.hyd"
_WAMIT_FILES = "box.1 box.3 box.4 box.9 box.hst box.frc box.out box.cfg"
_RESULTS = f"{nemoh_files.RADIATION} {nemoh_files.EXCITATION} {nemoh_files.CONTROL} "
_NEMOH_FILES = _RESULTS + f"{nemoh_files.STIFFNESS} {nemoh_files.HYDROSTATICS}"
_NEMOH_PAIR = _RESULTS + "Kh_1.dat Hydrostatics_1.dat"
_of_nemoh = _of(nemoh.read_nemoh, _folder, nemoh.FORMAT.can_open)
_wamit_pair = _of(wamit.read_wamit, _listing, wamit.is_wamit)
_of_capytaine = _of(capytaine.read_capytaine, Path, capytaine.is_capytaine)
_of_bemio = _of(bemio.read_bemio, Path, bemio.is_bemio)
_of_mafredo = _of(orcaflex.read_orcaflex, **_MATRICES)
_ALL = [
    *_set_targets("veres", _VERES_FILES, _of(veres.read_veres, _stem), _VERES),
    *_set_targets("wamit", _WAMIT_FILES, _of(wamit.read_wamit, _stem), _WAMIT),
    *_set_targets("nemoh", _NEMOH_FILES, _of_nemoh, _NEMOH),
    Target("aqwa", "aqwa", "hull.AH1", _of(aqwa.read_aqwa, _stem, aqwa.is_aqwa), _AQWA),
    Target("aqwa-listing", "aqwa", "hull.LIS", aqwa.read_aqwa, _AQWA),
    Target("orcaflex", "orcaflex", "ship.yml", orcaflex.read_orcaflex, _ORCAFLEX, mutate_json),
    *_set_targets("wamit-group", "box.out box.1 box.3 box.hst", _wamit_pair, _WAMIT),
    Target("wamit-listing", "wamit", "box.out", _wamit_pair, _WAMIT),
    *_set_targets("nemoh-group", _NEMOH_PAIR, _of_nemoh, _NEMOH),
    Target("orcaflex-text", "orcaflex", "ship.yml", orcaflex.read_orcaflex, _ORCAFLEX),
    Target("offsets", "offsets", "hull.txt", Hull.from_offsets, ("hydro/hull/lines.py",), refusals=_SHAPE),
    Target("stl", "stl", "hull.stl", Hull.from_stl, ("inputs/mesh_files.py",), refusals=_SHAPE),
    Target("gltf", "gltf", "box.gltf", _of(read_gltf, most=1000), ("inputs/mesh_files.py",), mutate_json),
    Target("gltf-bytes", "gltf", "box.glb", _of(read_gltf, most=1000), ("inputs/mesh_files.py",), None),
    Target("scene", "scene", "scene.json", _scene, _SCENE, mutate_json),
    Target("lift", "lift", "lift.toml", _lift, _LIFT),
    Target("crane", "crane", "crane.toml", _crane, _under("crane", "file_table")),
    Target("jointed", "jointed", "crane.toml", _crane, _JOINTED),
    Target("urdf", "urdf", "crane.urdf", _urdf, _URDF),
    Target("measured", "measured", "record.json", _measured, ("sea/measured.py",), mutate_json,
           refusals=(SceneError,)),
    Target("series", "series", "mru.csv", _series, _RECORDED, refusals=_SEEN),
    Target("motion-record", "series", "mru.csv", _motion_record, _RECORDED, refusals=_SEEN),
    *(Target(name, "log", "mru.log", _log, _under("sea/records", "nmea kind"), refusals=_SEEN)
      for name in ("pashr", "prdid", "tss1")),
    Target("ndbc", "ndbc", "buoy.txt", _sea_states, (*_SEAS, "sea/records/ndbc.py"), refusals=_SEEN),
    Target("spotter", "spotter", "bulk.csv", _sea_states, ("sea/records/spotter.py",), refusals=_SEEN),
    Target("sea-states", "ndbc", "site.csv", _sea_states, _SEAS, refusals=_SEEN),
    Target("scatter", "scatter", "site.csv", _scatter, ("sea/records/scatter.py",), refusals=_SEEN),
    Target("state", "state", "run.state", _state, ("inputs/state.py",)),
    _netcdf("database", "hull.nc", HydroDatabase.load, "hydro/database/netcdf.py"),
    _netcdf("mafredo", "ship.dhyd", _of_mafredo, f"{_HYDRO}/orcaflex.py"),
    _netcdf("capytaine", "ship.nc", _of_capytaine, f"{_HYDRO}/capytaine.py"),
    _netcdf("bemio", "ship.h5", _of_bemio, f"{_HYDRO}/bemio.py"),
    _netcdf("capytaine-group", "pair.nc", _of_capytaine, f"{_HYDRO}/capytaine.py"),
    _netcdf("bemio-group", "pair.h5", _of_bemio, f"{_HYDRO}/bemio.py"),
    _netcdf("hindcast", "site.nc", _sea_states, "operability/hindcast.py", refusals=_SEEN),
    _netcdf("result", "run.nc", _result, "result/result_file.py"),
]  # fmt: skip
TARGETS = {target.name: target for target in _ALL}


def cases(target: Target) -> list[Path]:
    """The committed cases of a target; those of a set's undamaged file included."""
    own = sorted(path for path in (CORPUS / target.name).glob("*") if path.is_file())
    return own + ([CORPUS / target.beside / target.file] if target.beside else [])
