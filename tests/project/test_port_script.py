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
    )
    new, notes = PORT["ported"]("\n".join(old))
    assert new.splitlines() == [
        'a = "\u00e9"; s.add_sea(vessel=v, drift=True)  # kept', 'f(s.add_sea(cutoff=w, phase="slow"))'
    ]  # fmt: skip
    assert [note.partition(":")[0] for note in notes] == ["line 1", "line 2"]


def test_keywords_become_fields_of_values() -> None:
    call = "s.add_gas_spring('a', area=A, pressure=p, exponent=1.3, maximum=9)"
    new, notes = PORT["ported"](f"{call}\noil = {{'pump_check': c, 'air': a}}")
    assert new.splitlines() == [
        "s.add_gas_spring('a', area=A, gas=Gas(pressure=p, exponent=1.3), stops=Stops(maximum=9))",
        'oil = {"pump": Pump(check=c), "oil": Oil(air=a)}',
    ]
    assert len(notes) == 2 and PORT["ported"](new) == (new, [])


def test_every_call_of_today_is_there_and_none_of_before() -> None:
    for old, new in PORT["CALLS"].items():
        assert old == new.name or not (hasattr(sc.Scene, old) or hasattr(sc, old))
        called = inspect.signature(getattr(sc.Scene, new.name, None) or getattr(sc, new.name))
        values = [(*word.split("="), name) for word, name in new.values.values()]
        words = {word for word, _, _ in values}
        assert {*new.words, *new.places, *new.renamed.values(), *words} - {""} <= {*called.parameters}
        assert all(hasattr(getattr(sc.scene, kind)(), name) for _, kind, name in values)
