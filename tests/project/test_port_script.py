"""`tools/port_script.py`: old calls become those of today, in place, and every new name is there."""

from __future__ import annotations

import inspect
import runpy
from pathlib import Path

import seacrane as sc

PORT = runpy.run_path(str(Path(__file__).resolve().parents[2] / "tools" / "port_script.py"))


def test_calls_are_replaced_where_they_stand() -> None:
    old = (
        'a = "\u00e9"; s.add_drift(vessel=v, outside="hold")  # kept',
        "f(s.use_slow_position(",
        "  cutoff=w))",
        "from seacrane.crane import KnuckleBoomCrane",
    )
    new, notes = PORT["ported"]("\n".join(old))
    assert new.splitlines()[:2] == [
        'a = "\u00e9"; s.add_sea(vessel=v, drift=True)  # kept', 'f(s.add_sea(cutoff=w, phase="slow"))'
    ]  # fmt: skip
    assert [note.partition(":")[0] for note in notes] == ["line 1", "line 2", "line 4"]


def test_every_call_of_today_is_there_and_none_of_before() -> None:
    for old, new in PORT["CALLS"].items():
        assert not hasattr(sc.Scene, old) and not hasattr(sc, old)
        called = inspect.signature(getattr(sc.Scene, new.name, None) or getattr(sc, new.name))
        assert {*new.words, *new.places, *new.renamed.values()} - {""} <= {*called.parameters}
