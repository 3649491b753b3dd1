"""What an ensemble runs: where its scenes come from, how they are run and what is kept of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from seacrane.ensembles.kept import Kept, made_by
from seacrane.ensembles.labelled import Labelled
from seacrane.ensembles.members import Value
from seacrane.ensembles.other_sea import WORDS, Databases, require_same_sea, with_sea
from seacrane.ensembles.paths import require_paths, with_values
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.result import Result
from seacrane.run.method import Method
from seacrane.run.outputs import Outputs
from seacrane.scene.scene import Scene

Source = Scene | Callable[..., Scene]
Keep = Mapping[str, Kept | Callable[[Result], Any]]


@dataclass(frozen=True, kw_only=True)
class Study:
    """One run of it for given values.

    Attributes
    ----------
    source : Scene or callable
    databases : HydroDatabase, mapping or None
        With which the sea of a scene is made again, by vessel where there are several.
    t_end : float
        s.
    method, outputs
        Of every run.
    keep : mapping
        What is kept of each, by name.
    lanes : int
        Runs that are stepped side by side, by the number of the member; 1: none.
    """

    source: Source
    databases: Databases
    t_end: float
    method: Method
    outputs: Outputs
    keep: Keep
    lanes: int = 1

    def require_names(self, names: list[str]) -> None:
        """Raise SceneError for a parameter that the scene does not have, or one whose sea cannot vary."""
        if not isinstance(self.source, Scene):
            return
        require_paths(self.source, names, WORDS)
        if any(name in WORDS for name in names):
            require_same_sea(self.source, self.databases)

    def scene(self, values: Mapping[str, Value]) -> Scene:
        """The scene of a member."""
        if isinstance(self.source, Scene):
            words = {name: value for name, value in values.items() if name in WORDS}
            paths = {name: value for name, value in values.items() if name not in WORDS}
            made = with_values(self.source, paths)
            return with_sea(made, self.databases, words) if words else made
        made = self.source(**values)
        if not isinstance(made, Scene):
            raise SceneError(f"the function returned {shown(made)}; return a Scene")
        return made

    def kept_of(self, result: Result) -> dict[str, Labelled]:
        """What is kept of a result."""
        return {
            name: what.of(result) if isinstance(what, Kept) else made_by(name, what, result)
            for name, what in self.keep.items()
        }


def checked_keep(keep: Any) -> Keep:
    """The mapping, or a SceneError that names what is wrong in it."""
    if not isinstance(keep, Mapping) or not keep:
        raise SceneError(f"keep is {shown(keep)}; give what to keep by name, such as {{'tilt': Kept(...)}}")
    for name, what in keep.items():
        if not isinstance(name, str) or not name.isidentifier():
            raise SceneError(f"keep: {shown(name)} is no name; give letters, digits and underscores")
        if name in RESERVED:
            raise SceneError(f"keep: the name {name!r} is taken; choose another")
        if not (isinstance(what, Kept) or callable(what)):
            raise SceneError(f"keep: {name} is {shown(what)}; give a Kept, or a function of a Result")
    return dict(keep)


def outputs_for(keep: Keep, outputs: Outputs) -> Outputs:
    """The outputs; where they name no channels and no function is kept, those that are kept."""
    if outputs.channels is not None or not all(isinstance(what, Kept) for what in keep.values()):
        return outputs
    channels = dict.fromkeys(what.channel for what in keep.values() if isinstance(what, Kept))
    return Outputs(dt=outputs.dt, channels=tuple(channels))


RESERVED = ("member", "time", "failure", "validity")
