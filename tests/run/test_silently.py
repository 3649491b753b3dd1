"""What one thread does not show, another one does; Python's own filters are of the whole process."""

from __future__ import annotations

import warnings
from threading import Event, Thread

import pytest

from seacrane.inputs.caller import keeping, recorded, silently, warn_caller
from seacrane.warnings import AssemblyWarning, SteepSeaWarning


def test_of_its_thread_alone() -> None:
    """While another thread is silent, and after it, filters are as they were."""
    inside, over = Event(), Event()
    before = list(warnings.filters)

    def silent() -> None:
        with silently():
            inside.set()
            over.wait()
            warn_caller("not shown", SteepSeaWarning)

    other = Thread(target=silent)
    other.start()
    inside.wait()
    try:
        with pytest.warns(SteepSeaWarning, match="shown"):
            warn_caller("shown", SteepSeaWarning)
        assert list(warnings.filters) == before
    finally:
        over.set()
        other.join()


def test_of_a_category() -> None:
    """Others are shown; who listens hears both, and who repeats repeats what was aloud."""
    told: dict[str, None] = {}
    with keeping(told), recorded() as said, pytest.warns(SteepSeaWarning) as seen, silently(AssemblyWarning):
        warn_caller("moved", AssemblyWarning)
        warn_caller("breaks", SteepSeaWarning)
    assert [str(one.message) for one in seen] == ["breaks"]
    assert list(told) == ["moved", "breaks"]
    assert [(message, aloud) for message, _, aloud in said] == [("moved", False), ("breaks", True)]
