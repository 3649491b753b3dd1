"""The command line from end to end: real runs, files, one-line errors, exit codes, Ctrl-C."""

from __future__ import annotations

import json
import os
import platform
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from seacrane.cli.as_json import to_json
from seacrane.cli.command_line import explain, main
from seacrane.cli.scene_source import run_script
from seacrane.errors import SceneError
from seacrane.plotting.text import text_table
from seacrane.result import Result

PENDULUM = """
import seacrane

def scene():
    scene = seacrane.Scene(name="pendulum")
    scene.add_body(name="bob", mass=2.0, inertia=[[0.1, 0, 0], [0, 0.1, 0], [0, 0, 0.1]],
                   position=[1.0, 0.0, 0.0])
    scene.add_joint(kind="revolute", name="pivot", first="ground", second="bob",
                    point=[0.0, 0.0, 0.0], axis=[0.0, 1.0, 0.0])
    return scene
"""


def command_line(*arguments: str | Path, timeout: float = 300) -> subprocess.CompletedProcess[str]:
    """The command in a process of its own, as a user runs it."""
    command = [sys.executable, "-m", "seacrane", *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)


def refusal(done: subprocess.CompletedProcess[str]) -> str:
    """The one line on standard error of a command that failed."""
    assert done.returncode not in (0, None), done.stdout
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1, done.stderr
    assert "Traceback" not in done.stderr
    return lines[0]


@pytest.mark.parametrize(
    "command", ["", "run", "paper", "report", "show", "view", "hydro", "trade", "schema", "doctor"]
)
def test_every_command_explains_itself(command: str) -> None:
    done = command_line(*command.split(), "--help")
    assert done.returncode == 0 and done.stdout.startswith(f"usage: seacrane {command}".rstrip())
    assert not done.stderr


def test_help_loads_no_numerical_package() -> None:
    script = (
        "import sys\nfrom seacrane.cli import main\n"
        "try:\n    main(['--help'])\nexcept SystemExit:\n    pass\n"
        "heavy = {'numpy', 'scipy', 'xarray', 'matplotlib', 'netCDF4'} & set(sys.modules)\n"
        "sys.exit(f'loaded {heavy}' if heavy else 0)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_version_is_printed() -> None:
    from seacrane.version import __version__

    first, *build = command_line("--version").stdout.splitlines()
    assert first == f"seacrane {__version__}"
    facts = dict(line.split(maxsplit=1) for line in build)
    assert facts["core"].startswith("_core.") and platform.python_version() in facts["python"]


def test_no_command_is_a_misuse(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([]) == 2
    assert "usage: seacrane" in capsys.readouterr().err


MISUSED = {
    "an unknown command": (["sail"], "invalid choice: 'sail'"),
    "no folder": (["run", "vessel"], "--out"),
    "a time that is no number": (["run", "vessel", "--out", "x", "--t-end", "long"], "invalid float value"),
    "an unknown memory": (
        ["run", "vessel", "--out", "x", "--memory", "elephant"],
        "choice: 'elephant'",
    ),
}


@pytest.mark.parametrize("case", MISUSED)
def test_misuse_is_told_in_one_line(case: str) -> None:
    arguments, message = MISUSED[case]
    done = command_line(*arguments)
    assert done.returncode == 2 and message in refusal(done)


FAILING = {
    "an absent scene": (["run", "case9", "--out", "OUT"], "no scene 'case9'"),
    "an absent database": (["run", "vessel", "--out", "OUT", "--database", "none.nc"], "none.nc"),
    "an integrator that does not exist": (
        ["run", "vessel", "--out", "OUT", "--integrator", "magic"],
        "magic",
    ),
    "a run of negative length": (["run", "vessel", "--out", "OUT", "--t-end", "-1"], "t_end is -1.0 s"),
    "a negative wave height": (["run", "vessel", "--out", "OUT", "--hs", "-2"], "-2"),
    "a formulation that the integrator cannot step": (
        ["run", "vessel", "--out", "OUT", "--formulation", "recursive", "--integrator", "ida"],
        "formulation 'recursive' is not available",
    ),
    "an absent database file": (["hydro", "none.nc"], "no such file"),
}


@pytest.mark.parametrize("case", FAILING)
def test_failure_is_told_in_one_line(case: str, tmp_path: Path) -> None:
    arguments, message = FAILING[case]
    out = tmp_path / "out"
    done = command_line(*[str(out) if argument == "OUT" else argument for argument in arguments])
    assert done.returncode == 1 and message in refusal(done)
    assert not out.exists() or not list(out.iterdir()), "a run that failed leaves no file"


def test_out_must_be_a_folder(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("a file")
    done = command_line("run", "vessel", "--out", tmp_path / "taken", "--t-end", "1")
    assert "is a file; name a folder" in refusal(done)


@pytest.fixture(scope="module")
def lift(tmp_path_factory: pytest.TempPathFactory) -> tuple[subprocess.CompletedProcess[str], Path]:
    folder = tmp_path_factory.mktemp("lift") / "deep" / "out"
    return command_line("run", "case2", "--out", folder, "--t-end", "5", "--dt-out", "0.5"), folder


def test_a_run_writes_its_file_and_a_summary(
    lift: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    done, folder = lift
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in folder.iterdir()) == ["case2.nc"]
    assert "times real time" in done.stdout and "worst constraint error" in done.stdout
    (tension,) = [line.split() for line in done.stdout.splitlines() if line.startswith("hoist tension")]
    assert tension[2:4] == ["kN", "98.07"]
    assert f"saved {folder / 'case2.nc'}" in done.stdout


def test_the_runs_file_holds_what_the_design_lists(
    lift: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    result = Result.load(lift[1] / "case2.nc")
    np.testing.assert_allclose(result.time, np.arange(0, 5.25, 0.5))
    bodies = "vessel tower king main_barrel main_rod main_jib knuckle_barrel knuckle_rod knuckle_jib payload"
    joints = "deck A B C D E F G main_cylinder knuckle_cylinder link"
    channels = (
        "position velocity angular_velocity quaternion euler_xyz vessel_motion stroke stroke_rate "
        "cylinder_force slew_angle slew_torque link_tension reaction_force reaction_moment wave_elevation "
        "wave_force constraint_error constraint_rate_error constraint_error_before_projection "
        "energy_balance absolute_work"
    )
    stats = (
        "seacrane_version scene formulation integrator seed realised_hs simulated_s wall_s "
        "evaluations steps rejected_steps states coordinates constraints degrees_of_freedom "
        "compiled_coordinates compiled_constraints wave_components"
    )
    assert sorted(result.coords["body"]) == sorted(bodies.split())
    assert sorted(result.coords["joint"]) == sorted(joints.split())
    assert set(channels.split()) <= set(result.channels)
    assert set(stats.split()) <= set(result.stats)
    assert result.stats["coordinates"] == 60 and result.stats["constraints"] == 46
    assert result.stats["degrees_of_freedom"] == 14
    assert result["constraint_error"].max() < 1e-9
    assert "t_end" in result.settings


@pytest.mark.slow("many processes")
def test_show_prints_and_draws_a_result(
    lift: tuple[subprocess.CompletedProcess[str], Path], tmp_path: Path
) -> None:
    file = lift[1] / "case2.nc"
    done = command_line("show", file, "--out", tmp_path, "--start", "1")
    assert done.returncode == 0, done.stderr
    assert "case2, 1 to 5 s" in done.stdout and f"saved {tmp_path / 'case2.png'}" in done.stdout
    assert (tmp_path / "case2.png").read_bytes().startswith(b"\x89PNG")
    told = json.loads(command_line("show", file, "--json").stdout)
    assert told["rows"]["hoist tension"]["unit"] == "N" and "Too short" in told["remarks"][0]
    assert "overwrite" in refusal(command_line("show", file, "--out", tmp_path))
    assert "no result file" in refusal(command_line("show", tmp_path / "none.nc"))


def test_options_reach_the_case_and_the_integrator(tmp_path: Path) -> None:
    options = (
        "--t-end 2 --integrator rk4 --dt 0.05 --hs 3 --tp 9 --seed 5 --wave-direction-deg 90 --memory none "
        "--formulation redundant"
    )
    done = command_line("run", "vessel", "--out", tmp_path, *options.split())
    assert done.returncode == 0, done.stderr
    result = Result.load(tmp_path / "vessel.nc")
    stats, settings = result.stats, result.settings
    assert (stats["integrator"], stats["formulation"], stats["seed"]) == ("rk4", "redundant", 5)
    assert stats["realised_hs"] == pytest.approx(3.0, rel=0.01)
    assert settings["dt"] == 0.05 and settings["memory"] == "none" and settings["tp"] == 9.0


def test_a_scene_file_runs_and_is_reported(tmp_path: Path) -> None:
    script, file = tmp_path / "pendulum.py", tmp_path / "pendulum.json"
    script.write_text(PENDULUM)
    run_script(script).save(file)
    done = command_line("run", file, "--out", tmp_path / "out", "--t-end", "1")
    assert done.returncode == 0, done.stderr
    by_script = command_line("run", script, "--out", tmp_path / "scripted", "--t-end", "1")
    assert by_script.returncode == 0, by_script.stderr
    first, second = (Result.load(tmp_path / folder / "pendulum.nc") for folder in ("out", "scripted"))
    np.testing.assert_array_equal(first["position"], second["position"])
    done = command_line("report", file)
    assert done.returncode == 0 and "bob" in done.stdout + file.read_text(), done.stderr


def test_a_scene_file_that_is_none_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "scene.json"
    file.write_text('{"bodies": [')
    assert "scene.json" in refusal(command_line("run", file, "--out", tmp_path / "out"))


def test_the_report_is_the_scenes_own() -> None:
    from seacrane import cases

    done = command_line("report", "case2", "--json")
    assert done.returncode == 0, done.stderr
    printed = json.loads(done.stdout)
    own = cases.case2().report()
    assert list(printed) == list(own)
    for section, rows in own.items():
        assert [row["name"] for row in printed[section]] == [str(name) for name, _ in rows], section
    values = {row["name"]: row["value"] for rows in printed.values() for row in rows}
    assert 60 in values.values() and 46 in values.values() and 14 in values.values()
    text = command_line("report", "case2").stdout
    assert all(section in text for section in own)


@pytest.mark.slow("many processes")
def test_a_result_is_told_from_a_scene_by_its_content(
    lift: tuple[subprocess.CompletedProcess[str], Path], tmp_path: Path
) -> None:
    file = tmp_path / "a lift.json"  # the name says nothing
    file.write_bytes((lift[1] / "case2.nc").read_bytes())
    done = command_line("report", file, "--out", tmp_path / "pages")
    assert done.returncode == 0, done.stderr
    (page,) = (tmp_path / "pages").iterdir()
    text = page.read_text(encoding="utf-8")
    assert page.name == "a lift.json.html" and "<h2>At a glance</h2>" in text
    page.write_text("mine")
    again = command_line("report", file, "--out", tmp_path / "pages")
    assert "holds an earlier a lift.json.html; give another folder, or --overwrite" in refusal(again)
    assert page.read_text() == "mine"
    done = command_line("report", file, "--out", tmp_path / "pages", "--overwrite")
    assert done.returncode == 0 and page.read_text(encoding="utf-8") == text


MISTAKEN = {
    "a result without a folder": (["report", "RESULT"], "name the folder of its report by --out DIR"),
    "a result as JSON": (["report", "RESULT", "--json", "--out", "x"], "--json goes with a scene"),
    "a folder for a scene": (
        ["report", "case2", "--out", "x"],
        "--out and --overwrite go with the file of a",
    ),
}


@pytest.mark.parametrize("case", MISTAKEN)
def test_options_of_the_other_report_are_refused(
    case: str,
    lift: tuple[subprocess.CompletedProcess[str], Path],
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    arguments, message = MISTAKEN[case]
    monkeypatch.chdir(tmp_path)
    assert main([str(lift[1] / "case2.nc") if one == "RESULT" else one for one in arguments]) == 1
    assert message in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_database_is_no_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import seacrane.hydro

    database = Path(seacrane.hydro.__file__).parents[1] / "data" / "hull_115.nc"
    assert main(["report", str(database), "--out", str(tmp_path / "out")]) == 1
    assert "is not a seacrane result" in capsys.readouterr().err


def test_an_earlier_paper_is_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "report.html").write_text("mine")
    assert main(["paper", "--out", str(tmp_path)]) == 1
    assert "holds an earlier report.html; give another folder, or --overwrite" in capsys.readouterr().err
    assert [path.read_text() for path in tmp_path.iterdir()] == ["mine"]


@pytest.fixture(scope="module")
def paper(
    tmp_path_factory: pytest.TempPathFactory,
) -> tuple[subprocess.CompletedProcess[str], Path]:
    folder = tmp_path_factory.mktemp("paper")
    return command_line("paper", "--out", folder), folder


@pytest.mark.slow("many processes")
def test_the_paper_command_writes_figures_data_runs_and_report(
    paper: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    done, folder = paper
    assert done.returncode == 0, done.stderr
    figures = {f"figure_{number:02d}.{kind}" for number in range(3, 11) for kind in ("png", "csv")}
    runs = {f"{name}.nc" for name in ("vessel", "vessel_without_memory", "case1", "case2", "case3")}
    assert {path.name for path in folder.iterdir()} == figures | runs | {"report.html"}
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert page.count("data:image/png;base64,") == 8
    assert all(f"Figure {number}:" in page for number in range(3, 11))


@pytest.mark.slow("many processes")
def test_the_papers_findings_are_reproduced(
    paper: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    output = paper[0].stdout
    assert output.count(" reproduced: ") == 6 and "not reproduced" not in output, output


# Without memory nothing damps heave and pitch near resonance, and local errors add up: 2.1e-5 at the default
# rtol of 1e-6, falling with it (2.2e-6 at 1e-7, 2.2e-7 at 1e-8). The other runs meet 1e-6.
ENERGY_CLOSURE = {"vessel_without_memory": 5e-5}


def test_the_papers_runs_are_accurate(
    paper: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    for path in paper[1].glob("*.nc"):
        result = Result.load(path)
        assert result.time[-1] == pytest.approx(100.0) and not result.interrupted
        assert result["constraint_error"].max() < 1e-9, path.name
        closure = abs(result["energy_balance"]).max() / result["absolute_work"].max()
        assert closure < ENERGY_CLOSURE.get(path.stem, 1e-6), path.name


def test_progress_is_shown_on_request(tmp_path: Path) -> None:
    done = command_line("run", "vessel", "--out", tmp_path, "--t-end", "2", "--progress")
    assert done.returncode == 0 and "simulated" in done.stderr


def test_a_script_is_executed_by_run_only(tmp_path: Path) -> None:
    script = tmp_path / "pendulum.py"
    script.write_text(PENDULUM)
    done = command_line("run", script, "--out", tmp_path / "out", "--t-end", "1")
    assert done.returncode == 0, done.stderr
    result = Result.load(tmp_path / "out" / "pendulum.nc")
    assert result.coords["body"] == ("bob",)
    swing = result.select("position", body="bob", axis="z")
    assert swing.min() < -0.3, "it falls"
    assert "only `seacrane run` executes scripts" in refusal(command_line("report", script))


def test_case_options_do_not_apply_to_scripts(tmp_path: Path) -> None:
    script = tmp_path / "pendulum.py"
    script.write_text(PENDULUM)
    done = command_line("run", script, "--out", tmp_path / "out", "--hs", "2", "--wave-direction-deg", "0")
    assert "--hs, --wave-direction-deg applies to the built-in cases only" in refusal(done)


BAD_SCRIPTS = {
    "no function": ("x = 1\n", "defines no function scene()"),
    "an error": ("def scene():\n    return 1 / 0\n", "bad.py line 2: ZeroDivisionError"),
    "not a scene": ("def scene():\n    return 3\n", "returns a int; return a seacrane.Scene"),
    "bad syntax": ("def scene(:\n", "bad.py line 1: SyntaxError"),
    "an early exit": ("raise SystemExit(0)\n", "bad.py line 1: SystemExit"),
    "an absent helper": ("import helper_that_is_absent\n", "bad.py line 1: ModuleNotFoundError"),
}


@pytest.mark.parametrize("case", BAD_SCRIPTS)
def test_a_script_that_fails_is_named_with_its_line(case: str, tmp_path: Path) -> None:
    text, message = BAD_SCRIPTS[case]
    script = tmp_path / "bad.py"
    script.write_text(text)
    with pytest.raises(SceneError) as caught:
        run_script(script)
    assert message in str(caught.value)


def test_a_script_may_import_its_neighbour(tmp_path: Path) -> None:
    (tmp_path / "neighbour_of_pendulum.py").write_text(PENDULUM)
    script = tmp_path / "two_files.py"
    script.write_text("from neighbour_of_pendulum import scene\n")
    before = list(sys.path)
    assert run_script(script).name == "pendulum"
    assert sys.path == before


def test_ctrl_c_leaves_what_was_computed(tmp_path: Path) -> None:
    """A run too long to finish is interrupted once it has started; its file holds the outputs so far."""
    command = [sys.executable, "-m", "seacrane", "run", "vessel", "--out", str(tmp_path), "--t-end", "1e7"]
    process = subprocess.Popen(
        [*command, "--dt-out", "1000", "--progress"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "TQDM_MININTERVAL": "0.01"},
    )
    assert process.stderr is not None
    try:
        while "simulated" not in process.stderr.read(64):
            assert process.poll() is None, "ended before it was interrupted"
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 130, output
    assert "interrupted: outputs end at" in output
    result = Result.load(tmp_path / "vessel.nc")
    assert result.interrupted and 0 < result.time[-1] < 1e7


@pytest.mark.slow("many processes")
def test_hydro_prints_its_verdicts(shared: Path, tmp_path: Path) -> None:
    done = command_line("hydro", shared / "veres" / "supply", "--json", "--out", tmp_path / "plots")
    assert done.returncode == 0, done.stderr
    rows = json.loads(done.stdout)
    assert all(set(row) == {"check", "value", "limit", "verdict"} for row in rows)
    verdicts = {row["check"]: row["verdict"] for row in rows}
    for motion in ("surge", "sway", "heave", "roll", "pitch", "yaw"):
        assert verdicts[f"motion_rao_{motion}"] == "pass"
    names = {path.name for path in (tmp_path / "plots").iterdir()}
    plots = {"added_mass", "damping", "retardation", "wave_force", "motion"}
    assert names == {f"{plot}.{kind}" for plot in plots for kind in ("png", "csv")}


def test_earlier_plots_are_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    import seacrane.hydro

    database = Path(seacrane.hydro.__file__).parents[1] / "data" / "hull_115.nc"
    (tmp_path / "motion.png").write_text("mine")
    assert main(["hydro", str(database), "--out", str(tmp_path)]) == 1
    assert "holds an earlier motion.png; give another folder, or --overwrite" in capsys.readouterr().err
    assert [path.read_text() for path in tmp_path.iterdir()] == ["mine"]


@pytest.mark.slow("many processes")
def test_hydro_prints_a_table(shared: Path) -> None:
    done = command_line("hydro", shared / "veres" / "supply" / "input")
    assert done.returncode == 0, done.stderr
    head, *rows = (line.split() for line in done.stdout.splitlines())
    assert head == ["check", "value", "limit", "verdict"]
    told = {row[0]: row[1] for row in rows}
    assert float(told["mass_t"]) == pytest.approx(6362.2, abs=0.1) and "motion_rao_surge" in told
    assert float(told["GM_of_C44_and_mass_m"]) == pytest.approx(2.14, abs=0.005)


@pytest.mark.slow("many processes")
def test_a_real_ships_files_run(shared: Path, tmp_path: Path) -> None:
    done = command_line(
        "run", "vessel", "--database", shared / "veres" / "supply", "--out", tmp_path, "--t-end", "5"
    )
    assert done.returncode == 0, done.stderr
    assert np.isfinite(Result.load(tmp_path / "vessel.nc")["vessel_motion"]).all()


def test_the_reader_of_our_output_may_leave() -> None:
    import seacrane.hydro

    database = Path(seacrane.hydro.__file__).parents[1] / "data" / "hull_115.nc"
    reading, writing = os.pipe()
    os.close(reading)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "seacrane", "hydro", str(database)],
            stdout=writing,
            stderr=subprocess.PIPE,
            text=True,
            timeout=300,
            check=False,
        )
    finally:
        os.close(writing)
    assert done.returncode == 1 and done.stderr == ""


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (ValueError("two\nlines"), "two lines"),
        (OSError("disk full"), "disk full"),
        (SceneError("body 'x' is heavy"), "body 'x' is heavy"),
        (TypeError("a bug"), "unexpected TypeError: a bug"),
        (KeyError("no channel"), "unexpected KeyError: no channel"),
        (ValueError(), "ValueError"),
    ],
)
def test_errors_become_one_line(error: Exception, text: str) -> None:
    assert explain(error) == text


def test_json_has_no_words_for_infinity() -> None:
    value = {"a": np.array([1.0, np.inf]), "b": (np.float64("nan"), np.int64(2)), "c": None, "d": True}
    assert json.loads(to_json(value)) == {"a": [1.0, None], "b": [None, 2], "c": None, "d": True}


def test_tables_align_their_columns() -> None:
    lines = text_table(("check", "value"), [("a", "1.5"), ("longer name", "2")]).splitlines()
    assert lines == ["check        value", "a            1.5", "longer name  2"]


TWO_HINGES = """
import warnings

import seacrane


def scene():
    warnings.warn("look here", UserWarning)
    out = seacrane.Scene(name="door")
    out.add_body(name="door", mass=30.0, inertia=[[1, 0, 0], [0, 1, 0], [0, 0, 1]], position=(0.5, 0, 0))
    for z in (-0.8, 0.8):
        out.add_joint(name=f"hinge {z}", kind="revolute", first="ground", second="door",
                      point=(0, 0, z), axis=(0, 0, 1))
    return out
"""


@pytest.mark.parametrize("launcher", ["module", "program"])
def test_warnings_name_the_users_line_or_none(launcher: str, tmp_path: Path) -> None:
    """Not the line of the program that starts the command."""
    script = tmp_path / "door.py"
    script.write_text(TWO_HINGES)
    program = [sys.executable, "-m", "seacrane"]
    if launcher == "program":
        program = [str(Path(sys.executable).with_name("seacrane"))]
    command = [*program, "run", str(script), "--out", str(tmp_path), "--t-end", "0.1"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    told = [line for line in done.stderr.splitlines() if "redundant" in line]
    start = "seacrane run: RedundantJointsWarning: scene 'door': constraints"
    assert told and all(line.startswith(start) for line in told)
    assert f"{script}:8: UserWarning: look here" in done.stderr


@pytest.mark.slow("fits a memory")
def test_hydro_fits_over_a_band_that_is_named(capsys: pytest.CaptureFixture[str], shared: Path) -> None:
    from seacrane.cli import main

    path = str(shared / "veres" / "supply")
    with pytest.warns(UserWarning, match="no infinite-frequency added mass"):
        assert main(["hydro", path, "--band", "0.4", "2.0", "--memory", "by-motion", "--json"]) == 0
    rows = {row["check"]: row for row in json.loads(capsys.readouterr().out)}
    assert rows["memory_motion_error"]["limit"] == 0.01
    assert main(["hydro", path, "--band", "2.9", "3.0"]) != 0
    assert "the band 2.9 to 3 rad/s holds" in capsys.readouterr().err
