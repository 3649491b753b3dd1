"""The recorded channels of one run: named read-only arrays, their coordinates, and the run's counters."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from itertools import chain
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from seacrane.arrays import Array
from seacrane.description.channels import CHANNELS, FIXED, attributes, channel_of, dims_of
from seacrane.description.pick import Pick, pick_of
from seacrane.description.places import POSE, on_body, position_of
from seacrane.errors import FileFormatError, SceneError, SeacraneError
from seacrane.inputs.atomic import atomic_write
from seacrane.inputs.keywords import named
from seacrane.inputs.netcdf_limits import NETCDF_ERRORS
from seacrane.inputs.shown import shown
from seacrane.inputs.state import state_from_bytes, state_to_bytes
from seacrane.plotting.panel import draw
from seacrane.plotting.table import Answer, Column, Table
from seacrane.result.about import (
    NOT_KEPT,
    About,
    Event,
    KeptScene,
    checked_array,
    checked_events,
    checked_names,
    checked_stats,
    checked_time,
    event_arrays,
)
from seacrane.result.history import axes_note, history_sheet
from seacrane.result.partial_file import Piece, is_partial, partial_path, read_partial
from seacrane.result.record import Record
from seacrane.result.result_file import read_netcdf, write_netcdf
from seacrane.result.traces import as_arrays, parted
from seacrane.result.utilisation import Utilisation, utilisation_of

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

    from seacrane._core import State
    from seacrane.scene.scene import Scene

LARGEST_RESULT = 4 * 2**30  # bytes


@named
@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Result(Record, Answer):
    """What one run recorded, a mapping of its channels by name.

    Build it with `Result.from_arrays`, or read it with `Result.load`.

    Attributes
    ----------
    time : ndarray, shape (n,)
        Output times, s; read-only.
    channels : mapping of str to ndarray
        Recorded channels by the names of `CHANNELS`; time is the first axis; read-only, SI units and
        radians. Only what the scene has is present.
    dims : mapping of str to tuple of str
        Dimension names of each channel.
    coords : mapping of str to tuple of str
        Names along every dimension but time, such as `body`, `joint`, `axis`; only those in use.
    stats : mapping of str to str, int or float
        Version, method and counters of the run.
    about : About
        Its settings, stages and limit states, and what pictures and reports need of its scene.
    extremes : mapping of str to (ndarray, ndarray)
        Of some channels the least and the largest values since the output before, from the steps of the run;
        of the channel's shape, read-only. See `reached`.
    interrupted : bool
        True if the run was stopped before its end; it then holds the outputs up to that moment.
    events : tuple of Event
        What wires, end stops, seats and stages did, in order of time.
    state : State or None
        Where the run stopped, to continue from by ``simulate(start=...)``.
    kept_scene : KeptScene or None
        What `scene` is read from.
    """

    state: State | None = None
    kept_scene: KeptScene | None = None

    def __repr__(self) -> str:
        stopped = ", interrupted" if self.interrupted else ""
        return (
            f"<Result of {self.stats['scene']!r}: {self.time.size} outputs to {self.time[-1]:g} s, "
            f"{len(self.channels)} channels{stopped}>"
        )

    def _shown(self) -> Table:
        """The channels that were recorded, with the smallest and the largest value of each."""
        names = list(self.channels)
        along = [", ".join(f"{dim} {len(self.coords[dim])}" for dim in self.dims[n][1:]) for n in names]
        ends = np.full((len(names), 2), np.nan)
        for i, name in enumerate(names):
            values = np.stack(self.extremes.get(name, (self[name], self[name])))
            finite = values[np.isfinite(values)]
            ends[i] = (finite.min(), finite.max()) if finite.size else np.nan
        method = f"{self.stats['formulation']}, {self.stats['integrator']}"
        return Table(
            axes=[Column(name="channel", values=names)],
            columns=[
                Column(head="along", values=along), Column(head="smallest", values=ends[:, 0]),
                Column(head="largest", values=ends[:, 1]),
                Column(head="unit", values=[CHANNELS[name].unit for name in names]),
            ],
            title=f"{repr(self)[1:-1]}; {method}, {len(self.events)} events",
        )  # fmt: skip

    def __reduce__(self) -> tuple[Any, ...]:  # read-only mapping views cannot be pickled themselves
        parts = {one.name: getattr(self, one.name) for one in fields(self) if one.init}
        views = {name: dict(one) for name, one in parts.items() if isinstance(one, MappingProxyType)}
        return _rebuild, ({**parts, **views, "kept_scene": None},)

    @property
    def scene(self) -> Scene | None:
        """What was run, without notes; None in copies, and where a file could not hold it.

        Files hold it as the text of a scene file, which is read when it is first asked for: FileFormatError
        where it is damaged. C functions are not in it: `stats["scene_not_kept"]` names what is left out.
        """
        return None if self.kept_scene is None else self.kept_scene.scene

    @classmethod
    def from_arrays(
        cls,
        *,
        time: Any,
        arrays: Mapping[str, Any],
        coords: Mapping[str, Sequence[str]],
        events: Sequence[Event] = (),
        stats: Mapping[str, Any],
        about: About | None = None,
        interrupted: bool = False,
        state: State | None = None,
        scene: Scene | KeptScene | None = None,
    ) -> Result:
        """Check and wrap the arrays that the run loop filled; what is not told here is as of the attributes.

        Parameters
        ----------
        arrays : mapping of str to array_like
            Channels by the names of `CHANNELS`, and their `extremes` as "hook_load_least" and
            "hook_load_largest". Arrays of float64 are taken over without a copy and made read-only; the
            caller must not write to them through another view.
        coords : mapping of str to sequence of str
            Names along the dimensions that a scene names, such as `body` and `joint`, in the order of the
            arrays.
        stats : mapping
            Numbers and words, at least `ALWAYS_STATED`; values that are None are left out.
        interrupted : bool
            True if the run did not reach its end. Only then, in a run of stages, and where the stat
            `not_finite` names them, may channels hold values that are not finite.
        scene : Scene or KeptScene, optional
            What was run.

        Raises
        ------
        ValueError
            For an unknown channel, a wrong shape, a value that is not finite in a finished run, names
            given twice, or a missing stat.
        """
        times = checked_time(time)
        about = about or About()
        gaps = interrupted or bool(about.stages)  # where elements come and go
        gappy = str(stats.get("not_finite", "")).split(", ")
        for name in arrays:
            if channel_of(name) not in CHANNELS:
                raise ValueError(f"channel {name!r} is unknown; choose from {', '.join(CHANNELS)}")
        all_dims = {name: dims_of(name, np.ndim(values)) for name, values in arrays.items()}
        used = dict.fromkeys(dim for dims in all_dims.values() for dim in dims[1:])
        given = {dim: checked_names(dim, coords[dim]) for dim in used if dim in coords}
        names = given | dict(FIXED)
        sizes = {dim: len(own) for dim, own in names.items()}
        checked = {}
        for name, values in arrays.items():
            shape = (times.size, *(sizes.get(dim, 0) for dim in all_dims[name][1:]))
            checked[name] = checked_array(name, values, shape, gaps or channel_of(name) in gappy)
        channels, extremes = parted(checked)
        return cls(
            time=times, channels=channels, extremes=extremes, coords={dim: names[dim] for dim in used},
            stats=checked_stats(stats), about=about, interrupted=bool(interrupted),
            events=checked_events(events), state=state,
            kept_scene=scene if scene is None or isinstance(scene, KeptScene) else KeptScene(scene),
        )  # fmt: skip

    @property
    def arrays(self) -> dict[str, Array]:
        """Channels and `extremes` by the names that files give them."""
        return {**self.channels, **as_arrays(self.extremes)}

    def place_of(self, body: str, point: ArrayLike = (0.0, 0.0, 0.0)) -> Array:
        """Where a point of a body, or of the ground, was at every output, (n, 3), inertial frame, m.

        Parameters
        ----------
        body : str
            Or the name of a point, such as "tip", as `Scene.place_of` takes it.
        point : array_like, shape (3,)
            Coordinates of the body, m; default: its origin.

        Raises
        ------
        SceneError
            For a body that is not there, and where poses were not recorded or the result has no scene.
        """
        what = f"place_of {shown(body)}"
        scene = self.scene
        missing = [name for name in POSE if name not in self.channels]
        if missing:
            raise SceneError(f"{what}: channel {missing[0]!r} was not recorded; ask for it in channels=[...]")
        if scene is None:
            raise SceneError(f"{what}: this result has no scene; ask that of the run, or its file")
        return position_of(scene, self.channels, *on_body(scene, "place_of", body, point))

    def plot(self, *channels: str | Pick, **names: str) -> Figure:
        """Draw channels over time, a panel for each channel and unit, with events and extremes marked.

        ``savefig(path)`` of the figure writes it; a notebook shows it.
        `seacrane.plot_overview` draws what a run recorded, and more functions of that kind one thing each.

        Parameters
        ----------
        *channels : str or Pick
            As `select` takes them, such as "hook_load", "roll" or ``"position[load, z]"``.
        **names : str
            Pick one along a dimension, such as ``body="payload"``.

        Raises
        ------
        SceneError
            For a channel or name that the result does not hold.
        """
        sheet = history_sheet(self, *channels, **names)
        return draw(sheet, note=axes_note(self, [pick_of("plot", one).channel for one in channels]))

    def to_dataframe(self, *channels: str | Pick) -> pandas.DataFrame:
        """Curves as columns of a table, by time (s); SI units and radians.

        Parameters
        ----------
        *channels : str or Pick
            As `select` takes them, such as "hook_load" or ``"position[load, z]"``; a channel without all its
            names gives a column for each of its curves, named so that `select` finds it. Default: all.

        Returns
        -------
        pandas.DataFrame
            `attrs["units"]` holds the unit of each column.

        Raises
        ------
        KeyError, ValueError
            As `select`; ValueError too where selectors begin at different times.
        """
        return self._curves(channels).to_dataframe()

    def to_csv(self, path: str | os.PathLike[str], *channels: str | Pick) -> Path:
        """Write curves as comma-separated values: a line for each output, time first, SI.

        Parameters
        ----------
        path : path
            Its folder must exist. An older file of that name is replaced, complete or not at all.
        *channels : str or Pick
            As of `to_dataframe`.

        Raises
        ------
        KeyError, ValueError, OSError
        """
        return self._curves(channels).to_csv(path)

    @property
    def utilisation(self) -> Utilisation:
        """How far every limit state of the scene was used, 1 at the limit; see `Scene.add_limit_state`."""
        return utilisation_of(self)

    def to_xarray(self) -> xarray.Dataset:
        """The result as a dataset with named coordinates, units and descriptions (copies the arrays)."""
        import xarray

        variables = {
            name: (self.dims[channel_of(name)], array.copy(), attributes(name))
            for name, array in self.arrays.items()
        }
        if self.events:
            for name, array in event_arrays(self.events).items():
                variables[name] = (("event",), array.astype(str) if array.dtype == object else array, {})
        coords: dict[str, Any] = {"time": ("time", self.time.copy(), attributes("time"))}
        coords.update({dim: list(names) for dim, names in self.coords.items()})
        if self.stages:
            names = np.full(self.time.size, self.stages[0].name, dtype=object)
            for span in self.stages:
                names[self.stage(span.name)] = span.name
            coords["stage"] = ("time", list(names))
        told = {**self.about.to_attributes(), "interrupted": int(self.interrupted)}
        return xarray.Dataset(variables, coords, {**self.stats, **told})

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the result as NetCDF4.

        Parameters
        ----------
        path : path
            Its folder must exist. An older file of that name is replaced, complete or not at all.

        Raises
        ------
        OSError
            If it cannot be written (no such folder, no permission, disk full); the older file stays.
        """
        path = Path(path)
        scene, lacks = (b"", "") if self.kept_scene is None else self.kept_scene.written()
        whole = Piece(
            arrays={"time": self.time, **self.arrays}, coords=self.coords, events=self.events,
            stats={**self.stats, **({NOT_KEPT: lacks} if lacks else {})}, about=self.about,
            interrupted=self.interrupted,
            state=b"" if self.state is None else state_to_bytes(self.state), scene=scene,
        )  # fmt: skip
        with atomic_write(path) as draft:
            try:
                write_netcdf(draft, whole, [whole.arrays], self.time.size)
            except RuntimeError as error:  # the HDF5 library's failures to write arrive as RuntimeError
                raise OSError(f"the NetCDF library reports: {error}") from error
        return path

    @classmethod
    def load(
        cls,
        path: str | os.PathLike[str],
        *,
        channels: Sequence[str] | None = None,
        largest: int = LARGEST_RESULT,
    ) -> Result:
        """Read a result that `save` or `simulate` wrote: the same arrays, bit for bit.

        Parameters
        ----------
        path : path
            NetCDF4 file, or the .partial of a run that is in progress or was killed.
        channels : sequence of str, optional
            Take only those, as far as the file holds them; default: all.
        largest : int
            Bytes that its arrays may take in memory, 4 GiB by default: what a file says that it holds is
            looked at before any of it is read.

        Raises
        ------
        FileNotFoundError
            If there is no such file.
        FileFormatError
            If it is not a NetCDF file, not one of this kind, or larger.
        """
        path = Path(path)
        if not path.is_file():
            started = partial_path(path)
            raise FileNotFoundError(
                f"no result file {path}"
                + (f"; its run has left {started} so far" if started.is_file() else "")
            )
        try:
            piece = (read_partial if is_partial(path) else read_netcdf)(path, largest, channels)
            arrays = dict(piece.arrays)
            return cls.from_arrays(
                time=arrays.pop("time"), arrays=arrays, coords=piece.coords, events=piece.events,
                stats=piece.stats, about=piece.about, interrupted=piece.interrupted,
                state=state_from_bytes(piece.state, path) if piece.state else None,
                scene=KeptScene(None, piece.scene, f"{path.name}: its scene") if piece.scene else None,
            )  # fmt: skip
        except NETCDF_ERRORS as error:
            if isinstance(error, SeacraneError):
                raise
            raise FileFormatError(f"{path} is not a seacrane result: {str(error)[:200]}") from error


def _rebuild(parts: dict[str, Any]) -> Result:
    every = [*parts["channels"].values(), *chain.from_iterable(parts["extremes"].values())]
    for array in (parts["time"], *every):
        array.setflags(write=False)
    return Result(**parts)
