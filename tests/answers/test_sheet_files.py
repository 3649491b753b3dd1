"""The [sheet] of a lift: what its example gives, the same by calls, and what is refused with its line."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

from seacrane import FileFormatError, Lift, SceneError
from seacrane.cli.command_line import main
from seacrane.lift.sheet_run import _tail, load_cases, run_sheet
from seacrane.operability import ScatterDiagram, availability, phase_sheet

EXAMPLE = Path(__file__).parents[2] / "examples" / "lifts" / "sheet_by_phases.toml"
SMALL = (
    ("tp_s = [6, 8, 11]", "tp_s = [8, 11]"), ("direction_deg = [135, 180]", "direction_deg = [180]"),
    ("hs_m = [1, 2, 3]\nseeds = 5", "hs_m = [2, 4]\nseeds = 3"),
)  # fmt: skip
LOAD = 'channel = "hook_load"\nmaximum_N = 530e3\nstage = "hoisting"'


def small(folder: Path, *changes: tuple[str, str]) -> Path:
    text = EXAMPLE.read_text()
    for old, new in (*SMALL, *changes):
        assert old in text
        text = text.replace(old, new, 1)
    (folder / "lift.toml").write_text(text, encoding="utf-8")
    (folder / "forecast.csv").write_bytes((EXAMPLE.parent / "forecast.csv").read_bytes())
    return folder / "lift.toml"


@pytest.mark.slow("runs of a whole sheet, twice")
def test_a_file_gives_what_the_call_gives(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = small(tmp_path)
    done = run_sheet(path, tmp_path / "out")
    lift = Lift.load(path)
    asked = lift.sheet
    assert asked is not None and asked.lifts == {"positioning": "vessel"}
    phases = asked.phases[1:]
    alone = phase_sheet(
        lift.scene(),
        phases=phases,
        criteria=asked.criteria[1:],
        stages=lift.stages,
        dt_out=0.5,
        **asked.given,
    )
    for phase in phases:
        assert done.sheet.table(phase.name).dataset.identical(alone.table(phase.name).dataset)
    assert np.isfinite(done.sheet.table("positioning").dataset["allowable_hs"]).all()
    assert done.sheet.dataset["reference_hours"].to_numpy().tolist() == [6.0, 5.0, 6.0]
    page = (tmp_path / "out" / "sheet.html").read_text()
    assert "hoisting" in page and "Forecast" in page and (tmp_path / "out" / "sheet.csv").exists()
    assert main(["sheet", str(path), "--out", str(tmp_path / "out")]) == 0  # runs are not run again
    told = capsys.readouterr().out
    small(tmp_path, ("mass_kg = 50e3", "mass_kg = 60e3"))
    assert main(["sheet", str(path), "--out", str(tmp_path / "out")]) == 1  # of another lift, which is told
    assert Lift.load(tmp_path / "out" / "sheet.toml") == lift
    assert "passage, P90 of 3 seeds" in told and "GO at 2026-06-01T06:00" in told


def test_a_scatter_table_gives_the_availability_of_each_phase(tmp_path: Path) -> None:
    text = EXAMPLE.read_text()
    begin, end = text.index("[[sheet.phase]]                  # happens"), text.index("[[sheet.criterion]]")
    last = text.rindex("[[sheet.criterion]]")
    text = text[:begin] + text[end:last] + text[text.index("[sheet.alpha]") : text.index("[sheet.forecast]")]
    (tmp_path / "site.csv").write_text("Hs [m] \\ Tp [s],6-9,9-12\n0-1,30,10\n1-4,20,40\n")
    (tmp_path / "lift.toml").write_text(f"{text}[sheet.scatter]\nfile = 'site.csv'\n[run]\nstart = 'rest'\n")
    done = run_sheet(tmp_path / "lift.toml", tmp_path / "out")
    assert done is not None
    scatter = ScatterDiagram(hs=[0, 1, 4], tp=[6, 9, 12], counts=[[30, 10], [20, 40]], source="site.csv")
    (tmp_path / "site.csv").unlink()
    with pytest.raises(FileFormatError, match=r"site\.csv cannot be read"):
        run_sheet(tmp_path / "lift.toml", tmp_path / "alone")
    assert not (tmp_path / "alone" / "runs").exists()  # refused before any run
    for phase in ("positioning", "hanging"):
        found = done.answers[f"Availability: {phase}"]
        assert str(found) == str(availability(done.sheet.table(phase), scatter))
        assert 0.0 < found.percent < 100.0


@pytest.mark.slow("sheets of two load cases")
def test_load_cases_are_values_of_keys(tmp_path: Path) -> None:
    cases = "lead_hours = 3\ncases = { hoist.mass_kg = [40e3, 50e3] }"
    calm = small(tmp_path, ("lead_hours = 3", cases))
    lift = Lift.load(calm)
    lift.save(tmp_path / "again.toml")
    assert Lift.load(tmp_path / "again.toml") == lift
    text = calm.read_text()
    one = text[: text.index("[[sheet.phase]]                  # happens once")]
    rest = text[text.index('[[sheet.criterion]]\nname = "roll"') :]
    hoisted = rest[rest.index('[[sheet.criterion]]\nname = "hoisted') : rest.index("[sheet.alpha]")]
    calm.write_text(one + rest.replace(hoisted, ""), encoding="utf-8")
    sheet = run_sheet(calm, tmp_path / "out").sheet
    assert sheet.cases == ("mass_kg 40000", "mass_kg 50000")
    light, heavy = (sheet.table("hanging", case=case).dataset["allowable_hs"] for case in sheet.cases)
    assert np.all(light > heavy)


def test_each_load_case_has_a_name_of_its_own(tmp_path: Path) -> None:
    cases = "lead_hours = 3\ncases = { hoist.mass_kg = [100000.1, 100000.2], vessel.memory = ['none'] }"
    lift = Lift.load(small(tmp_path, ("lead_hours = 3", cases)))
    assert lift.sheet is not None
    assert [*load_cases(lift, lift.sheet)] == [f"mass_kg 100000.{n}, memory none" for n in (1, 2)]
    boom, slew = (f"crane.coordinates.{name}.value_deg" for name in ("boom", "slew"))
    assert _tail(boom, [boom, slew]) == "boom.value_deg"
    assert _tail("hoist.size_m.3", ["hoist.size_m.3"]) == "size_m.3"
    assert _tail("hoist.mass_kg", ["body.pod.mass_kg", "hoist.mass_kg"]) == "hoist.mass_kg"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("passage = true\n", "", r"line \d+.*stages are of a passage"),
        ("maximum_deg = 2", "maximum_m = 2", r"line \d+.*maximum_m.*maximum_rad"),
        ("maximum_deg = 2", "maximum_t = 2", "maximum in that of its channel.*nearest: maximum_tf"),
        (LOAD, 'channel = "position"\nmaximum_m = 9\nstage = "hoisting"', "not which body"),
        ("start = ", "utc_offset = 'two'\nstart = ", r"utc_offset in \[sheet.forecast\].*number"),
        ('"forecast.csv"', '"none.csv"', r"line \d+: \[sheet.forecast\]: .*none.csv cannot be read"),
        ('T06:00"', 'T06:30"', r"line \d+: \[sheet.forecast\]: start is .*a time of the forecast"),
        ('T03:00"', 'T09:00"', r"line \d+: \[sheet.forecast\]: issued is .*after the start"),
        ("[0.80, 0.85, 0.90]", "[0.80, 0.85, 1.90]", "above 0, up to 1"),
        ('name = "hanging"\nhours = 1', 'name = "hanging"\nhours = -1', "hours"),
        ("lead_hours = 3", "lead_h = 3", "nearest: lead_hours"),
        ("lead_hours = 3", "cases = { hoist.mass_kgs = [1.0] }", "nearest: hoist.mass_kg"),
        ("lead_hours = 3", "cases = { sea.hs_m = [1, 2] }", "sea.hs_m is that of the seas of the sheet"),
        ("lead_hours = 3", "cases = { hoist.mass_t = [1], hoist.mass_kg = [2] }", "mass_t in another unit"),
    ],
)
def test_what_is_wrong_is_named_with_its_line(old: str, new: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(FileFormatError, match=message):
        run_sheet(small(tmp_path, (old, new)), tmp_path / "out")
    assert not (tmp_path / "out" / "runs").exists(), "before anything runs"


def test_a_sheet_without_phases_is_refused() -> None:
    with pytest.raises(FileFormatError, match=r"\[sheet\] has no phase"):
        Lift({"sheet": tomllib.loads("[sheet]\ntp_s = [8]\n")["sheet"]})


def test_a_lift_without_a_sheet_says_so(tmp_path: Path) -> None:
    path = tmp_path / "lift.toml"
    path.write_text('format = "seacrane lift"\nversion = 2\n', encoding="utf-8")
    with pytest.raises(SceneError, match=r"no \[sheet\]"):
        run_sheet(path, tmp_path / "out")
    with pytest.raises(FileNotFoundError, match="there is no lift file"):
        run_sheet(tmp_path / "none.toml", tmp_path / "out")
    assert "sheet" in json.dumps(Lift.load(EXAMPLE).tables)
