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
        "s.add_given_vessel(x, ramp=0)",
        "fit_memory(database=d, kind='passive', evaluation='fft')",
        "from seacrane.crane import KnuckleBoomCrane",
        "read_bemio(f)",
        "read_bemio(f, mass_matrix=m)",
    )
    new, notes = PORT["ported"]("\n".join(old))
    assert new.splitlines()[:4] == [
        'a = "\u00e9"; s.add_sea(vessel=v, drift=True)  # kept', 'f(s.add_sea(cutoff=w, phase="slow"))',
        "s.add_vessel(motion=x, ramp=0)", "fit_memory(database=d, kind='by-motion', evaluation='table')",
    ]  # fmt: skip
    assert [note.partition(":")[0] for note in notes] == [f"line {i}" for i in (1, 2, 4, 5, 6, 7)]


def test_keywords_become_fields_of_values() -> None:
    call = "s.add_gas_spring('a', area=A, pressure=p, exponent=1.3, maximum=9)"
    new, notes = PORT["ported"](f"{call}\noil = {{'pump_check': c, 'air': a}}")
    assert new.splitlines() == [
        "s.add_spring('a', gas=Gas(area=A, pressure=p, exponent=1.3), stops=Stops(maximum=9))",
        'oil = {"pump": Pump(check=c), "oil": Oil(air=a)}',
    ]
    assert len(notes) == 2 and PORT["ported"](new) == (new, [])


def test_every_call_of_today_is_there_and_none_of_before() -> None:
    for old, new in PORT["CALLS"].items():
        owners = [owner for owner in (sc.Scene, sc, sc.hydro) if hasattr(owner, new.name)]
        assert old == new.name or not any(hasattr(owner, old) for owner in (sc.Scene, sc, sc.hydro))
        values = [(*word.split("="), name) for word, name in new.values.values()]
        given = {*new.words, *new.places, *new.renamed.values(), *(word for word, _, _ in values)} - {""}
        known = inspect.signature(getattr(owners[0], new.name)).parameters
        assert given <= {*known} or "keywords" in known
        rooms = {"Compartment": sc.hydro}
        assert all(
            name in getattr(rooms.get(kind, sc.scene), kind).__dataclass_fields__ for _, kind, name in values
        )
