"""The stability atlas: the quick one must keep every promise, and its parts must notice what goes wrong."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from seacrane import Method, SceneError, cases
from seacrane.accuracy.quantities import ErrorMeasures
from seacrane.trading import row as rows
from seacrane.trading.case import Case
from seacrane.trading.reference import Reference
from seacrane.trading.row import Row
from seacrane.trading.row_file import RowFile
from stability_atlas import committed, stability_atlas, workers
from stability_atlas.__main__ import DOCUMENT, PICTURE, main, publish
from stability_atlas.axes import AXES
from stability_atlas.measure import measure, reference_of
from stability_atlas.methods import DEFAULT, QUICK, every
from stability_atlas.points import points_on_bodies
from stability_atlas.vessel_axes import _turn_of

NO_REFERENCE = Reference()


@pytest.fixture(scope="module")
def quick(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The quick atlas, run once; it fails where a promise of the committed list is broken."""
    folder = tmp_path_factory.mktemp("extremes")
    assert main(["--out", str(folder), "--quick"]) == 0
    return folder


def rows_of(folder: Path) -> list[dict[str, str]]:
    with (folder / "extremes.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


@pytest.mark.slow("an atlas")
def test_the_quick_atlas_keeps_every_promise(quick: Path) -> None:
    found = rows_of(quick)
    assert {row["axis"] for row in found} == set(AXES)
    assert not [row for row in found if row["verdict"] in rows.FORBIDDEN]
    default = {(row["axis"], float(row["value"])): row for row in found if row["formulation"] == "auto"}
    for promise in committed.promises():
        for value in promise.values:
            if value in AXES[promise.axis].long:
                continue
            row = default[promise.axis, value]
            assert row["verdict"] == promise.verdict
            if promise.verdict == rows.COMPLETED:
                assert float(row["left"]) <= promise.left
            else:
                assert all(word in row["message"] for word in promise.words)
    for axis in AXES.values():
        for value in axis.quick:
            methods = [row for row in found if (row["axis"], float(row["value"])) == (axis.name, value)]
            assert len(methods) == len(QUICK)


@pytest.mark.slow("an atlas")
def test_predicted_step_limits_are_those_found(quick: Path) -> None:
    with (quick / "extremes_step.csv").open(newline="", encoding="utf-8") as file:
        limits = list(csv.DictReader(file))
    assert len(limits) == 8
    for row in limits:
        assert float(row["found"]) == pytest.approx(float(row["predicted"]), rel=0.02)


@pytest.mark.slow("an atlas")
def test_heat_maps_are_drawn(quick: Path) -> None:
    import matplotlib.image as mpimg

    for name in [*AXES, "step"]:
        picture = mpimg.imread(quick / f"extremes_{name}.png")
        assert picture.std() > 0.05, name


@pytest.mark.slow("an atlas")
def test_a_second_call_runs_nothing_again(quick: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(groups: Any, jobs: int) -> Any:
        raise AssertionError(f"{len(groups)} groups are run again")

    monkeypatch.setattr("stability_atlas.study.run_all", fail)
    lines = (quick / "extremes_rows.jsonl").read_text().splitlines()
    again = stability_atlas(out=quick, quick=True, axes=["payload", "heel"], figures=False, progress=False)
    assert {row.case["axis"] for row in again.rows} == {"payload", "heel"}
    assert not again.broken
    # A line that an interrupted call was writing is left out.
    (quick / "extremes_rows.jsonl").write_text("\n".join([*lines, '{"axis": "pay']) + "\n")
    stability_atlas(out=quick, quick=True, axes=["payload"], figures=False, progress=False)


def test_what_makes_no_sense_is_refused(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"axis 'depth' is unknown; choose rods, .*, step"):
        stability_atlas(out=tmp_path, axes=["depth"])
    with pytest.raises(SceneError, match="is no folder"):
        stability_atlas(out=tmp_path / "absent")


def known(error: float, uncertainty: float = 0.0) -> dict[str, Any]:
    """Fields of a row whose error and uncertainty are these shares of the motion."""
    measures = ErrorMeasures(largest=2.0 * error, rms=error, std=error)
    return {"errors": {"points": measures}, "uncertainty": {"points": 2.0 * uncertainty},
            "motion": {"points": 2.0}}  # fmt: skip


GOOD = Row(case={"axis": "payload", "value": 10.0}, method=DEFAULT, verdict=rows.COMPLETED,
           left=1e-15, energy=1e-9, **known(1e-9))  # fmt: skip
OPEN = "joint or driver 'hinge': is open by 0.3 m or rad and projection does not close it"
DRIVEN: dict[str, Any] = {"axis": "driven-dead-centre", "value": -0.1}
STOPPED = replace(GOOD, case=DRIVEN, verdict=rows.STOPPED, message=OPEN)
HEEL: dict[str, Any] = {"axis": "heel", "value": 10.0}
RK4 = Method(integrator="rk4", dt=0.02)


@pytest.mark.parametrize(
    ("row", "words"),
    [
        (replace(GOOD, left=1e-6), "constraint error 1e-06, promised 1e-09"),
        (replace(GOOD, left=float("nan")), "constraint error nan"),
        (replace(GOOD, energy=1e-3), "energy error 0.001"),
        (replace(GOOD, **known(0.1)), "error 0.1 of the motion"),
        (replace(GOOD, verdict=rows.SLOW, message="granted 20 s"), "slow instead of completed: granted 20 s"),
        (replace(GOOD, verdict=rows.STOPPED, message="collapsed"), "stopped instead of completed: collapsed"),
        (replace(STOPPED, message="something went wrong"), "says nothing of hinge, open by"),
        (replace(STOPPED, verdict=rows.COMPLETED), "completed instead of stopped"),
        *((replace(GOOD, case=HEEL, method=RK4, verdict=bad, message="x"), bad) for bad in rows.FORBIDDEN),
    ],
)
def test_a_broken_promise_is_told(row: Row, words: str) -> None:
    assert committed.broken([GOOD, STOPPED], list(AXES)) == []
    (text,) = committed.broken([row], list(AXES))
    assert words in text


def test_an_error_against_a_reference_that_is_not_known_breaks_nothing() -> None:
    chaos = replace(GOOD, **known(0.9, 0.8))
    assert committed.broken([chaos], list(AXES)) == []
    assert committed.broken([replace(chaos, **known(0.9, 1e-9))], list(AXES)) != []


def test_every_promise_is_on_an_axis_and_default_runs_cover_it() -> None:
    for promise in committed.promises():
        assert promise.axis in AXES
        assert promise.verdict in (rows.COMPLETED, rows.REFUSED, rows.STOPPED)
        assert (promise.verdict == rows.COMPLETED) == (not promise.words)
    assert len({method.name for method in every()}) == len(list(every()))
    assert DEFAULT in QUICK


def short(t_end: float = 1.0) -> Case:
    return Case(scene=cases.vessel(count=5), t_end=t_end, dt_out=0.5)


def empty(method: Method) -> Row:
    return workers.Group(axis="heel", value=0.0, methods=(method,), limit_s=1.0).empty(method)


def test_a_run_is_cut_off_when_its_time_is_over() -> None:
    method = Method(formulation="redundant", integrator="rk4", dt=1e-5)
    row = measure(short(1e4), method, NO_REFERENCE, 0.05, empty(method))
    assert row.verdict == rows.SLOW
    assert 0 < row.steps < 1e6
    assert row.cpu_s < 10.0
    assert "0.05 s of processor time" in row.message


def test_how_a_run_ends_is_told_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    def verdict(method: Method, case: Case | None = None) -> Row:
        return measure(case or short(), method, NO_REFERENCE, 5.0, empty(method))

    done = verdict(DEFAULT)
    assert (done.verdict, done.message) == (rows.COMPLETED, "")
    assert done.energy < 1e-4
    assert verdict(Method(formulation="recursive", integrator="ida")).verdict == rows.REFUSED
    wild = AXES["memory"].case(-10.0)
    stopped = verdict(Method(formulation="redundant", integrator="rk4", dt=0.02), wild)
    assert stopped.verdict == rows.STOPPED
    assert "vessel" in stopped.message
    monkeypatch.setattr("seacrane.run.run.Run.advance", raising(RuntimeError("mystery")))
    assert verdict(DEFAULT).verdict == rows.UNNAMED


def raising(error: Exception) -> Callable[..., None]:
    def fail(*_: Any) -> None:
        raise error

    return fail


def test_a_value_that_is_not_finite_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    import seacrane.trading.measured_case as module

    real = module.timed

    class Spoilt:
        """A core that has recorded a value that is not finite."""

        def __init__(self, core: Any) -> None:
            self._core = core

        def __getattr__(self, name: str) -> Any:
            return getattr(self._core, name)

        def channels(self) -> dict[str, Any]:
            values = dict(self._core.channels())
            values["velocity"][1] = np.nan
            return values

    def spoilt(*arguments: Any, **settings: Any) -> Any:
        done = real(*arguments, **settings)
        done.run.core = Spoilt(done.run.core)  # type: ignore[assignment]
        return done

    monkeypatch.setattr(module, "timed", spoilt)
    row = measure(short(), DEFAULT, NO_REFERENCE, 5.0, empty(DEFAULT))
    assert (row.verdict, row.message) == (rows.NOT_FINITE, "velocity is not finite")


def test_errors_are_against_a_reference_that_checks_itself() -> None:
    case = short(10.0)
    truth = reference_of(case, 5.0)
    assert truth.uncertainty["points"] < 1e-9 * truth.motion["points"]
    loose = Method(formulation="redundant", integrator="bs32", rtol=1e-3)
    tight = Method(formulation="recursive", integrator="tsit5", rtol=1e-9)
    found = [measure(case, method, truth, 5.0, empty(method)) for method in (loose, tight)]
    errors = [row.relative_error("points") for row in found]
    assert 1e-6 < errors[0] < 1e-1
    assert errors[1] < 1e-7


def test_points_on_a_body_tell_of_its_turning() -> None:
    half = np.sqrt(0.5)
    points = points_on_bodies(np.zeros((1, 1, 3)), np.array([[[half, 0.0, 0.0, half]]]))[0, 0]
    np.testing.assert_allclose(points, [[0, 0, 0], [0, 1, 0], [-1, 0, 0], [0, 0, 1]], atol=1e-15)


class _Fake(workers._Worker):
    """A worker whose process answers as told."""

    def __init__(self, answers: list[Any]) -> None:
        self.answers, self.starts = answers, 0
        self._start()

    def _start(self) -> None:
        self.starts += 1
        self.pipe = self  # type: ignore[assignment]

    def send(self, group: Any) -> None:
        self.group = group

    def poll(self, patience: float) -> bool:
        return bool(self.answers[0] != "hang" or self.answers.pop(0) != "hang")

    def recv(self) -> Any:
        answer = self.answers.pop(0)
        if answer == "crash":
            raise EOFError
        return None if answer is None else self.group.empty(self.group.methods[0])

    def stop(self) -> None:
        pass


def test_hangs_and_crashes_are_told_and_the_rest_goes_on() -> None:
    group = workers.Group(axis="heel", value=5.0, methods=QUICK, limit_s=1.0)
    worker = _Fake(["row", "crash", "hang", "row", None])
    taken: list[Row] = []
    worker.run(replace(group, methods=QUICK[:4]), taken.append)
    assert [row.verdict for row in taken] == ["", rows.CRASHED, rows.HUNG, ""]
    assert [row.method for row in taken] == list(QUICK[:4])
    assert worker.starts == 3


def test_a_scene_that_cannot_be_made_is_a_row_of_its_own() -> None:
    groups = [
        workers.Group(axis="wave-period", value=-1.0, methods=(DEFAULT,), limit_s=1.0),
        workers.Group(axis="no such axis", value=1.0, methods=(DEFAULT,), limit_s=1.0),
    ]
    refused, unnamed = list(workers.run_all(groups, 1))
    assert refused.verdict == rows.REFUSED
    assert "tp is -1" in refused.message
    assert unnamed.verdict == rows.UNNAMED
    assert "KeyError" in unnamed.message


def test_phases_far_from_zero_are_known_exactly() -> None:
    from fractions import Fraction

    pi = Fraction(314159265358979323846264338327950288419716939937510, 10**50)
    for numerator in (1, 12345678, 2**20 * 10**11):
        exact = Fraction(numerator, 2**20)
        expected = exact - int(exact / (2 * pi)) * 2 * pi
        assert _turn_of(numerator) == pytest.approx(float(expected), abs=1e-15)


def test_rows_survive_their_file(tmp_path: Path) -> None:
    file = RowFile(tmp_path / "rows.jsonl", {"study": "test"})
    file.add(GOOD.key, GOOD)
    (again,) = RowFile(tmp_path / "rows.jsonl", {"study": "test"}).rows.values()
    assert json.dumps(asdict(again)) == json.dumps(asdict(GOOD))
    assert not RowFile(tmp_path / "rows.jsonl", {"study": "another"}).rows


def test_the_pictures_that_the_document_shows_are_put_in_their_place(tmp_path: Path) -> None:
    shown = PICTURE.findall(DOCUMENT.read_text())
    assert {"extremes_payload.png", "extremes_step.png"} <= {name for _, name in shown}
    for path, name in shown:
        assert (DOCUMENT.parent / path).is_file()
        (tmp_path / name).write_bytes(name.encode())
    copy = tmp_path / "docs" / "study" / "atlas" / "README.md"
    copy.parent.mkdir(parents=True)
    copy.write_text(DOCUMENT.read_text())
    (tmp_path / "docs" / "docs" / "figures").mkdir(parents=True)
    assert [path.read_bytes().decode() for path in publish(tmp_path, copy)] == [name for _, name in shown]
