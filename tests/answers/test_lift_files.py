"""Lifts as files: each table is its call, what was written is read again, and mistakes are told by line."""

from __future__ import annotations

import inspect
import json
import pickle
import re
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lift_examples import EVERY_TABLE, HEAD, PENDULUM, every_table, lift_of

from seacrane import Lift, Method, Outputs, Result, Scene, cases, simulate
from seacrane.cli import main
from seacrane.crane.load_crane import SHIPPED
from seacrane.errors import FileFormatError, SceneError
from seacrane.hydro import HydroDatabase, shipped_database
from seacrane.inputs.units import UNITS, in_si, others_of
from seacrane.lift.build import times_of
from seacrane.lift.keys import suffix
from seacrane.lift.lift import LIFTS
from seacrane.lift.schema import schema, schema_path, schema_text
from seacrane.lift.tables import TABLES
from seacrane.scene.file import scene_digest
from seacrane.sea import SeaState, WaveSystem, cos_2s, jonswap

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE, STUDY = (
    (ROOT / "examples" / "lifts" / f"{name}.toml").read_text(encoding="utf-8")
    for name in ("box_over_the_side", "case2_study")
)


def test_a_depth_chooses_among_those_of_a_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And the sea is as deep."""

    def load(file: str, *, depth: float) -> HydroDatabase:
        assert Path(file).name == "hull.nc"
        return replace(shipped_database(), depth=depth)

    monkeypatch.setattr("seacrane.lift.calls.load_hull", load)
    (tmp_path / "hull.nc").touch()
    vessel = '[vessel]\ndatabase = "hull.nc"\nmemory = "none"\ndepth_m = 40\n'
    scene = lift_of(HEAD + vessel + "[sea]\nhs_m = 1\ntp_s = 9\n", tmp_path).scene()
    assert scene.waves is not None and scene.waves.depth == 40.0


@pytest.mark.parametrize("name", LIFTS)
def test_a_case_and_its_file_are_one_scene(name: str) -> None:
    scene, case = Lift.shipped(name).scene(), getattr(cases, name)()
    assert scene == case
    assert scene_digest(scene) == scene_digest(case)
    first, second = (simulate(one, 0.5) for one in (scene, case))
    for channel, values in first.channels.items():
        np.testing.assert_array_equal(second[channel], values, err_msg=channel)


@pytest.mark.warns("SeabedWarning")
def test_every_table_is_its_call(tmp_path: Path) -> None:
    assert lift_of(EVERY_TABLE, tmp_path).scene() == every_table()


def test_a_table_that_is_not_above_is_in_a_lift_of_another_test() -> None:
    headers = re.compile(r"""(?:["'\n]|\\n)\[\[?(\w+)\]""")
    tests = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "tests").glob("*/test_*.py"))
    assert set(TABLES) - set(tomllib.loads(EVERY_TABLE)) <= set(headers.findall(tests))


def test_method_outputs_and_end_time(tmp_path: Path) -> None:
    lift = lift_of(PENDULUM, tmp_path)
    assert lift.method == Method(integrator="rk4", dt=0.01)
    assert lift.outputs == Outputs(dt_out=0.5, channels=("position", "constraint_error", "energy_balance"))
    result = lift.simulate()
    other = simulate(lift.scene(), 2.0, method=lift.method, outputs=lift.outputs)
    np.testing.assert_array_equal(result["position"], other["position"])
    assert result.time.tolist() == [0.0, 0.5, 1.0, 1.5, 2.0]
    bare = Lift({})
    assert (bare.method, bare.outputs, bare.t_end) == (Method(), Outputs(), 100.0)


SYSTEMS = """
[vessel]
database = "hull_115"; name = "barge"; memory = "none"
position_m = [10, 5, 0]; heading_deg = 30; mooring_period_s = inf

[sea]
vessel = "barge"; seed = 4
systems = [
    { name = "swell", spectrum = "jonswap", hs_m = 1, tp_s = 14, gamma = 5, direction_deg = 10, count = 20 },
    { spectrum = "pierson-moskowitz", hs_m = 2, tp_s = 9, direction_deg = 90, spreading = 10, count = 30 },
]
""".replace("; ", "\n")


def test_the_sea_of_several_systems(tmp_path: Path) -> None:
    database, scene = shipped_database(), Scene()
    scene.add_vessel(database, name="barge", memory="none", position=(10, 5, 0), heading_deg=30, mooring=None)
    swell = WaveSystem(name="swell", spectrum=jonswap(hs=1, tp=14, gamma=5), direction_deg=10, count=20)
    spectrum = cases._core.pierson_moskowitz(hs=2, tp=9)
    wind = WaveSystem(spectrum=spectrum, direction_deg=90, spreading=cos_2s(10), count=30)
    scene.add_sea(vessel="barge", sea=SeaState(systems=[swell, wind], seed=4, depth=database.depth))
    assert lift_of(HEAD + SYSTEMS, tmp_path).scene() == scene


@pytest.mark.parametrize("name", [*LIFTS, "pendulum", "every table", "example", "study"])
def test_written_and_read_again_it_is_equal(name: str, tmp_path: Path) -> None:
    texts = {"pendulum": PENDULUM, "every table": EVERY_TABLE, "example": EXAMPLE, "study": STUDY}
    lift = Lift.shipped(name) if name in LIFTS else lift_of(texts[name], tmp_path)
    lift.save(tmp_path / "again.toml")
    again = Lift.load(tmp_path / "again.toml")
    assert again == lift and again.tables == lift.tables
    assert (again.method, again.outputs, again.t_end) == (lift.method, lift.outputs, lift.t_end)
    again.save(tmp_path / "third.toml")
    assert (tmp_path / "third.toml").read_bytes() == (tmp_path / "again.toml").read_bytes()
    assert Lift(lift.tables) == lift == pickle.loads(pickle.dumps(lift))


TYPED = {  # of the lift with every table: in SI, and as an engineer types it
    "mass_kg = 12.5": "mass_t = 0.0125", "inertia_kg_m2 = [1, 2, 3]": "inertia_t_m2 = [1e-3, 2e-3, 3e-3]",
    "EA_N = 1e6": "EA_kN = 1000", "breaking_load_N = 6e5": "breaking_load_MN = 0.6",
    "tensions_N = [0, 1000]": "tensions_kN = [0, 1]", "maximum_power_W = 5e4": "maximum_power_kW = 50",
    "stiffness_N_m_per_rad = 1e3": "stiffness_kN_m_per_rad = 1", "from_s = 9": "from_min = 0.15",
    "feed_forward_N_m = 5.5": "feed_forward_kN_m = 0.0055", "brake_give_m = 2e-3": "brake_give_mm = 2",
    "stiffness_N_per_m = 100\n": "stiffness_N_per_mm = 0.1\n", "full_area_m2 = 0.05": "full_area_cm2 = 500",
    "pressure_Pa = 2e7": "pressure_bar = 200", "initial_m3 = 0.5": "initial_l = 500",
    "rated_flow_m3_per_s = 0.01": "rated_flow_l_per_min = 600", "maximum_N = 8e4": "maximum_kN = 80",
    "density_kg_per_m3 = 1000": "density_t_per_m3 = 1",
    "length_m = 1.25": "length_mm = 1250", "damping_N_s_per_m = 100\n": "damping_kN_s_per_m = 0.1\n",
    'rate_m_per_s = {kind = "quintic", start_time_s = 0, end_time_s = 2, start = 0, end = 0.5}':
    'rate_m_per_min = {kind = "quintic", start_time_s = 0, end_time_s = 2, start = 0, end = 30}',
}  # fmt: skip
BY_HAND = {
    "t": 1000.0, "tf": 9806.65, "kN": 1e3, "bar": 1e5, "N/mm": 1e3, "kN/m2": 1e3, "mm": 1e-3, "kn": 0.514444,
    "l/min": 1.0 / 60e3, "rpm": 0.1047198, "kN m/deg": 57295.8, "tf m": 9806.65, "h": 3600.0, "cm2": 1e-4,
}  # fmt: skip


@pytest.mark.warns("SeabedWarning")
def test_units_that_an_engineer_types(tmp_path: Path) -> None:
    """The scene and its digest are those of the same file in SI, and the file is written back as typed."""
    text = EVERY_TABLE
    for si, typed in TYPED.items():
        assert si in text, si
        text = text.replace(si, typed, 1)
    lift, plain = lift_of(text, tmp_path), lift_of(EVERY_TABLE, tmp_path, "si.toml")
    assert lift.scene() == plain.scene() and lift != plain
    assert scene_digest(lift.scene()) == scene_digest(plain.scene())
    lift.save(tmp_path / "again.toml")
    written = (tmp_path / "again.toml").read_text(encoding="utf-8")
    assert all(typed.partition(" = ")[0] in written for typed in TYPED.values())
    jsonschema = pytest.importorskip("jsonschema", reason="needs the package 'jsonschema'")
    jsonschema.Draft7Validator(schema()).validate(tomllib.loads(text))


def test_the_table_of_units() -> None:
    """Factors by hand; what is typed in decimals is the SI number of these decimals; a page names each."""
    for unit, factor in BY_HAND.items():
        assert in_si(1.0, unit) == pytest.approx(factor, rel=2e-6)
    assert all(in_si(k / 10.0, "mm") == float(f"{k / 10.0}e-3") for k in range(1, 2000))
    assert all(in_si(6.0 * k, "m/min") == k / 10.0 for k in range(1, 200))
    assert in_si(60.0, "l/min") == 1e-3 and in_si(1.8, "kn") == 0.926
    assert in_si(-3.3, "tf") == pytest.approx(-32361.945) and in_si(1e308, "kN") == float("inf")
    page = (ROOT / "docs" / "lift-files.md").read_text(encoding="utf-8")
    typed = {one for unit in UNITS for one in others_of(unit) if UNITS[one][0] != 1.0}
    assert [one for one in sorted(typed) if f"`_{suffix(one)}`" not in page] == []
    for table in TABLES.values():
        spelled = [one for key in table.keys for one in key.spellings]
        assert len(set(spelled)) == len(spelled), "no two keys may be spelled alike"


def test_a_study_may_give_a_key_of_its_lift_in_another_unit(tmp_path: Path) -> None:
    lift_of(HEAD + "[run]\nt_end_s = 60\n", tmp_path)
    study = 'run = { t_end_min = 0.5 }\n[study]\nlift = "my_lift.toml"\nover.seed = [1]\nexposure_h = 3\n'
    keep = '[[study.keep]]\nname = "a"\nchannel = "position"\n'
    lift = lift_of(HEAD + study + keep, tmp_path, "study.toml")
    assert lift.t_end == 30.0 and lift.study is not None and lift.study.exposure == 10800.0
    assert lift.tables["run"] == {"t_end_min": 0.5}


def test_texts_of_any_kind_are_written(tmp_path: Path) -> None:
    lift = Lift({"notes": {"a b": 'quote " and \\ and\nline \x7f\t', "é": "λ", "x": [True, -0.0, 1e300, 7]}})
    lift.save(tmp_path / "notes.toml")
    assert Lift.load(tmp_path / "notes.toml").scene().notes == lift.scene().notes
    with pytest.raises(SceneError, match="surrogate"):
        Lift({"notes": {"x": "\ud800"}}).save(tmp_path / "x.toml")
    assert not (tmp_path / "x.toml").exists()
    (tmp_path / "a.toml").write_bytes(b"\xef\xbb\xbf" + PENDULUM.replace("\n", "\r\n").encode())
    assert Lift.load(tmp_path / "a.toml") == lift_of(PENDULUM, tmp_path), "marks and ends of other editors"


def test_paths_are_from_the_folder_of_the_file(tmp_path: Path) -> None:
    for folder in ("data", "lifts"):
        (tmp_path / folder).mkdir()
    (tmp_path / "data" / "crane.toml").write_bytes((SHIPPED / "knuckle_boom_250t.toml").read_bytes())
    text = HEAD + '[crane]\nbase = "ground"\ncrane = "../data/crane.toml"\n'
    lift = lift_of(text, tmp_path / "lifts")
    lift.save(tmp_path / "moved.toml")
    assert 'crane = "data/crane.toml"' in (tmp_path / "moved.toml").read_text()
    (tmp_path / "lift.toml").write_text(text.replace("../data/crane.toml", "a_frame_40t"), encoding="utf-8")
    Lift.load(tmp_path / "lift.toml").save(tmp_path / "again.toml")
    assert Lift.load(tmp_path / "again.toml").scene().compile() is not None  # one that comes with seacrane
    assert Lift.load(tmp_path / "moved.toml") == lift
    expected = Scene()
    expected.add_crane(base="ground")
    assert lift.scene() == expected


CONTROLLED = (
    HEAD
    + """
[[body]]
name = "arm"; mass_kg = 5; inertia_kg_m2 = [1, 2, 3]; position_m = [1, 0, 0]
[joint]
kind = "revolute"; name = "pin"; first = "ground"; second = "arm"; point_m = [0, 0, 0]; axis = [0, 1, 0]
[control]
natural_frequency_Hz = 2
damping_ratio = 0.5
FEED_FORWARD
[command]
joint = "pin"
reference_deg = { kind = "quintic", start_time_s = 0, end_time_s = 6, start = 0, end = -45 }
""".replace("; ", "\n")
)


def test_a_command_is_tuned_and_fed_forward(tmp_path: Path) -> None:
    inertia, weight = 2.0 + 5.0 * 1.0**2, 5.0 * 9.80665
    omega = 2.0 * np.pi * 2.0
    parts = "times = [{ until_s = 6, every_s = 0.5 }]"
    actuator = lift_of(CONTROLLED.replace("FEED_FORWARD", parts), tmp_path).scene().actuators["pin"]
    assert actuator.stiffness == pytest.approx(inertia * omega**2, rel=1e-9)
    assert actuator.damping == pytest.approx(2.0 * 0.5 * omega * inertia, rel=1e-9)
    for time, angle in ((0.0, 0.0), (6.0, np.radians(-45)), (9.0, np.radians(-45))):
        held = actuator.feed_forward.evaluate([time])[0, 0]
        assert held == pytest.approx(-weight * np.cos(angle), rel=1e-6)
    for kind, first in (("start", -weight), ("none", 0.0)):
        text = CONTROLLED.replace("FEED_FORWARD", f'feed_forward = "{kind}"')
        load = lift_of(text, tmp_path).scene().actuators["pin"].feed_forward
        assert load.evaluate([0.0, 6.0])[:, 0] == pytest.approx([first, first], rel=1e-6)


def test_times_go_on_from_part_to_part() -> None:
    parts = [{"until": 45.0, "every": 5.0}, {"until": 100.0, "every": 0.5}]
    expected = np.append(np.linspace(0.0, 45.0, 10), np.arange(45.0, 100.1, 0.5)[1:])
    np.testing.assert_array_equal(times_of(parts), expected)
    for until, every in ((5.0, 2.0), (5.0, 1e-300)):
        with pytest.raises(SceneError, match="times"):
            times_of([{"until": until, "every": every}])


ARM = CONTROLLED.replace("FEED_FORWARD", "")
VESSEL = '[vessel]\ndatabase = "hull_115"\nmemory = "none"\n'
DRIVEN = '[driver]\njoint = "x"\n'
ONE, TWO = '{ kind = "constant", value = 1 }', '{ kind = "constant", value = 2 }'
MISTAKES = [
    ("[crane.payload]\nmas_kg = 3", 4, "mas_kg .*nearest: mass_kg"), ("\n[crain]", 4, "nearest: crane"),
    ("[crane.payload]\nmass_kN = 3", 4, "is in kN, and mass in kg; give mass_kg or mass_t$"),
    ("[crane.payload]\nmass_t = 3\nmass_kg = 3e3", 4, "mass_t stands beside mass_kg"),
    ("[hoist]\nEA_t = 3e3", 4, "in t, and EA in N; give EA_N or EA_kN or EA_MN or EA_tf$"),
    ("[crane]\nslew_deg = 3\nslew_rad = 1", 4, "slew_"), ('[sea]\nhs_m = "two"', 4, "hs_m .*'two'"),
    ("[sea]\nseed = 1.5", 4, "whole"), ("[sea]\nhs_m = 2\ntp_s = -1", 5, "tp_s .*above 0"),
    ("[study.over]\nhs = 2", 4, "hs .*list"), ("[study]\nkep = [1]", 4, "nearest: keep"),
    ('[[study.keep]]\nname = "a"\nafter = 2', 5, "nearest: after_s"),
    ("[[study.keep]]\nname = 'a'\nchannel = 'b'\n[study.design]\nranges.hs = [1]", 7, "hs"),
    ("[crane]\nfoot_m = [1, 2]", 4, "foot_m.* 3"),
    ('[[body]]\nname = "a"', 3, r"body\]\] 1 .*mass_kg"), ('[sea]\nspectrum = "jonswop"', 4, "jonswap"),
    ("[[run]]\nt_end_s = 1", 3, r"\[run\]"), (DRIVEN + 'curve_m = { kind = "gust" }', 5, "constant"),
    (f"{DRIVEN}curve_m = [\n{ONE},\n{TWO},\n]", 7, r"driver\.curve_m\]\] 2 .*from_s"),
]  # fmt: skip
NOT_IN_SCHEMA = [
    ("[sea]\nhs_m = nan", 4, "finite"), ("[sea]\n\nx = [1,", 5, "truncated or malformed"),
    ("a" + " . a" * 20 + " = 1", 3, "parts"),
]  # fmt: skip
RAM = (
    HEAD
    + """[body]; name = "load"; mass_kg = 1; inertia_kg_m2 = [1, 1, 1]; position_m = [0, 0, 1.5]
[hydraulic_cylinder]; name = "ram"; first = "ground"; second = "load"; full_area_m2 = 0.01; stroke_m = 1
rod_side_area_m2 = 0.005; retracted_length_m = 1; [hydraulic_cylinder.valve]; rated_flow_m3_per_s = 24
""".replace("; ", "\n")
)
BUILT = [
    (RAM, "rated_flow_m3_per_s", "ram': rated_flow is 24 m3/s"),
    (
        ARM + '\n[[actuator]]\njoint = "pin"\nstiffness_N_per_m = 3\n', "stiffness_N_per_m",
        "joint 'pin' .*stiffness_N_m_per_rad",
    ),
    (ARM.replace("reference_deg", "reference_m"), "reference_m", "reference_rad or reference_deg"),
    (HEAD + VESSEL + "[sea]\ndepth_m = 60\n", "depth_m", "systems"), (ARM, "[control]", "times"),
    (
        ARM.replace("damping_ratio", 'feed_forward = "none"\nperiod_s = 5\ndamping_ratio'), "period_s",
        "feed_forward = 'none'",
    ),
    (ARM.replace("[control]", "[notes]"), "[command]", r"\[control\]"),
]  # fmt: skip


def test_a_mistake_is_told_by_its_line(tmp_path: Path) -> None:
    """On reading, or once the scene is made: by the first line that begins so."""
    for text, line, words in (*MISTAKES, *NOT_IN_SCHEMA):
        with pytest.raises(FileFormatError, match=rf"^my_lift\.toml line {line}\b(?s:.*){words}"):
            lift_of(HEAD + text + "\n", tmp_path)
    for text, at, words in BUILT:
        lift = lift_of(text, tmp_path)
        line = next(i for i, one in enumerate(text.splitlines(), start=1) if one.startswith(at))
        with pytest.raises(FileFormatError, match=rf"^my_lift\.toml line {line}: .*{words}"):
            lift.scene()


def test_a_file_of_another_kind_or_version_is_refused(tmp_path: Path) -> None:
    for text, words in (
        ('{"format": "seacrane scene"}', r"Scene\.load"), (" \n", "empty"),
        (HEAD.replace("version = 2", "version = 3"), r"line 2: .*version = 2"),
    ):  # fmt: skip
        with pytest.raises(FileFormatError, match=f"my_lift.toml.*{words}"):
            lift_of(text, tmp_path)
    lift_of(PENDULUM, tmp_path)
    with pytest.raises(FileFormatError, match=r"Lift\.load"):
        Scene.load(tmp_path / "my_lift.toml")


def test_the_schema_is_current_and_agrees_with_the_reader() -> None:
    jsonschema = pytest.importorskip("jsonschema", reason="needs the package 'jsonschema'")
    text = schema_path().read_text(encoding="utf-8")
    assert text == schema_text() and json.loads(text) == schema(), "make it anew by `seacrane schema`"
    jsonschema.Draft7Validator.check_schema(schema())
    check, paths = jsonschema.Draft7Validator(schema()), list(schema_path().parent.glob("lifts/*.toml"))
    assert len(paths) == len(LIFTS)
    for path in paths:
        mark = path.read_text(encoding="utf-8").splitlines()[0]
        assert (path.parent / mark.removeprefix("#:schema ")).resolve() == schema_path().resolve()
    for one in (
        *(path.read_text(encoding="utf-8") for path in paths),
        PENDULUM,
        EVERY_TABLE,
        ARM,
        EXAMPLE,
        STUDY,
    ):
        check.validate(tomllib.loads(one))
    for text, *_ in MISTAKES:
        assert list(check.iter_errors(tomllib.loads(HEAD + text))), text


CALLS = {
    "vessel": "add_vessel", "hydrodynamics": "add_vessel",
} | {name: f"add_{name}" for name in TABLES if hasattr(Scene, f"add_{name}")}  # fmt: skip
# Kinds of loads have tables of their own.
LEFT_OUT = {"add_load"}


def test_every_call_that_adds_has_its_table_and_every_keyword_its_key() -> None:
    """A document names each table; what only a script can give is named here."""
    adding = {name for name in dir(Scene) if name.startswith("add_")}
    assert adding == set(CALLS.values()) | LEFT_OUT
    pages = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md"))
    assert [name for name in TABLES if f"`[{name}]`" not in pages] == []
    scripted = {"sea": {"database", "sea"}, "hydrodynamics": {"what", "motion", "memory"}}
    scripted |= {"vessel": {"what", "body"}, "force": {"parameters"}}
    scripted |= {"mesh": {"vertices", "faces"}, "roles": {"ropes"}}
    for name, call in CALLS.items():
        parameters = inspect.signature(getattr(Scene, call)).parameters.values()
        words = {one.name for one in parameters if one.kind is not one.VAR_KEYWORD} - {"scene"}
        assert words - scripted.get(name, set()) <= {key.name for key in TABLES[name].keys}, name


def test_the_command_runs_a_lift(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path, out = tmp_path / "my_lift.toml", tmp_path / "out"
    path.write_text(PENDULUM)
    assert main(["run", str(path), "--out", str(out)]) == 0
    result, direct = Result.load(out / "my_lift.nc"), Lift.load(path).simulate()
    assert result.stats["integrator"] == "rk4"
    np.testing.assert_array_equal(result["position"], direct["position"])
    options = ["--t-end", "1", "--dt-out", "0.25", "--integrator", "semi-implicit-euler", "--dt", "0.005"]
    assert main(["run", str(path), "--out", str(out), "--overwrite", *options]) == 0
    result = Result.load(out / "my_lift.nc")
    assert result.time.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert result.stats["integrator"] == "semi-implicit-euler" and result.settings["dt"] == 0.005
    capsys.readouterr()
    assert main(["report", str(path)]) == 0 and "pivot" in capsys.readouterr().out
    path.write_text(HEAD)
    assert main(["run", str(path), "--out", str(tmp_path / "other"), "--hs", "2"]) == 1
    assert "--hs" in capsys.readouterr().err and not (tmp_path / "other").exists()
