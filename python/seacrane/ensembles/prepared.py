"""Runs of members that differ in their sea alone: described, checked and compiled once."""

from __future__ import annotations

from collections import OrderedDict
from threading import Lock

from seacrane.description.given import given_vessels
from seacrane.ensembles.members import Value
from seacrane.ensembles.study import Study, Values
from seacrane.run.run import Run
from seacrane.scene.scene import Scene

MOST_HELD = 32  # scenes that differ in more than their sea


class Prepared:
    """Makes the runs of a study; threads may share it.

    The run of a member is, to the bit, that of its scene by itself.
    """

    def __init__(self, study: Study) -> None:
        self._study = study
        self._held: OrderedDict[tuple[Value, ...], Run] = OrderedDict()
        self._lock = Lock()

    def run(self, values: Values) -> Run:
        """Of the member with these values, at its start. Raises what describing or compiling it raises."""
        study = self._study
        sea, others = study.parts(values)
        source = study.source
        if not sea or study.start is not None or not isinstance(source, Scene) or given_vessels(source):
            return self._begun(study.scene(values))
        first = self._first(others)
        waves = study.in_sea(first.scene, sea).waves
        assert waves is not None
        return first.in_sea(waves)

    def _begun(self, scene: Scene) -> Run:
        study = self._study
        start = study.start_of(scene)
        return Run(scene, study.t_end, start=start, method=study.method, outputs=study.outputs)

    def _first(self, others: Values) -> Run:
        """The run of the scene's own sea that those of other seas are made from; it is not stepped."""
        key = tuple(others.values())
        with self._lock:
            if key not in self._held:
                self._held[key] = self._begun(self._study.scene(others))
            self._held.move_to_end(key)
            if len(self._held) > MOST_HELD:
                self._held.popitem(last=False)
            return self._held[key]
