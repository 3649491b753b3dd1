"""Arguments of every command, and what the shell is told about success and failure."""

from __future__ import annotations

import argparse
import contextlib
import os
import sys
import warnings
from collections.abc import Callable, Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

PACKAGE = Path(__file__).parents[1]
FAILED, MISUSED, INTERRUPTED = 1, 2, 130
DESCRIPTION = "Offshore crane, payload and vessel moving together in waves."
SCENE_HELP = (
    "case1, case2, case3, vessel (the vessel alone in waves), a lift (.toml) or a scene file; data only"
)
PATH_HELP = (
    "a file or folder of any supported kind: a VERES or WAMIT folder or common stem, or a NetCDF file of "
    "seacrane or Capytaine"
)


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(MISUSED, f"{self.prog}: {message} (see {self.prog} --help)\n")


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands; `command` holds the module that runs one."""
    parser = _Parser(prog="seacrane", description=DESCRIPTION)
    parser.add_argument("--version", action="store_true", help="print version and build, and stop")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    _add_run(commands)
    _add_paper(commands)
    _add_report(commands)
    _add_show(commands)
    _add_study(commands)
    _add_view(commands)
    _add_hydro(commands)
    _add_trade(commands)
    _add_schema(commands)
    _add_examples(commands)
    _add_doctor(commands)
    return parser


def _add_run(commands: Any) -> None:
    text = "simulate a scene and write DIR/<scene>.nc"
    run = commands.add_parser("run", help=text, description=text)
    run.add_argument(
        "scene", metavar="SCENE", help=f"{SCENE_HELP}, or a .py script defining scene(), which is executed"
    )
    run.add_argument("--out", metavar="DIR", required=True, help="folder to write to; made if absent")
    run.add_argument("--t-end", metavar="S", type=float, help="end time, s")
    run.add_argument("--dt-out", metavar="S", type=float, help="output interval, s")
    run.add_argument("--integrator", metavar="NAME", help="default dopri5; an unknown name lists them all")
    run.add_argument(
        "--rtol",
        metavar="X",
        type=float,
        help="tolerance of adaptive integrators: error per step over the scale of each state",
    )
    run.add_argument("--dt", metavar="S", type=float, help="step of fixed-step integrators, s")
    run.add_argument("--spectral-radius", metavar="R", type=float, help="of generalized-alpha, 0 to 1")
    run.add_argument("--formulation", choices=("redundant", "recursive", "auto"), help="equations of motion")
    run.add_argument(
        "--checkpoint-every", metavar="S", type=float, help="simulated time between two writes to disk, s"
    )
    run.add_argument(
        "--resume", action="store_true", help="go on with the run that DIR holds, stopped or killed"
    )
    run.add_argument(
        "--overwrite",
        action="store_true",
        help="replace a result of another scene or other settings, and what a killed run left",
    )
    run.add_argument("--progress", action="store_true", help="show a progress bar")
    case = run.add_argument_group("the built-in cases", "these choose the vessel and the sea of a named case")
    case.add_argument(
        "--memory",
        choices=("by-motion", "per-pair", "convolution", "none"),
        help="fluid memory of the vessel; default per-pair, which is the paper's",
    )
    case.add_argument("--hs", metavar="M", type=float, help="significant wave height, m")
    case.add_argument("--tp", metavar="S", type=float, help="peak period, s")
    case.add_argument(
        "--wave-direction-deg",
        metavar="D",
        type=float,
        help="direction the waves travel to, deg, from forward towards port: 0 following, 180 head seas",
    )
    case.add_argument(
        "--spectrum",
        choices=("jonswap", "pierson-moskowitz", "torsethaugen"),
        help="shape of the sea's spectrum",
    )
    case.add_argument(
        "--gamma",
        metavar="X",
        type=_gamma,
        help="peak enhancement of jonswap, 1 to 7, or dnv: by DNV-RP-C205",
    )
    case.add_argument(
        "--spreading", metavar="S", type=float, help="short-crested sea: exponent s of cos^2s(angle / 2)"
    )
    case.add_argument("--seed", metavar="N", type=int, help="seed of the wave realisation")
    case.add_argument("--database", metavar="PATH", help=f"the vessel's hydrodynamics: {PATH_HELP}")


def _gamma(text: str) -> float | str:
    return text if text == "dnv" else float(text)


def _add_paper(commands: Any) -> None:
    text = "compute the paper's cases: figures 3 to 10, the data behind every panel, and report.html"
    paper = commands.add_parser("paper", help=text, description=text)
    paper.add_argument("--out", metavar="DIR", required=True, help="folder to write to; made if absent")
    paper.add_argument("--overwrite", action="store_true", help="replace what an earlier call wrote there")


def _add_report(commands: Any) -> None:
    text = "print what the compiled model of a scene holds, or write the report of a result: DIR/<name>.html"
    report = commands.add_parser("report", help=text, description=text)
    report.add_argument(
        "source", metavar="SCENE|RESULT.nc", help=f"{SCENE_HELP}; or a result that `seacrane run` wrote"
    )
    report.add_argument("--json", action="store_true", help="of a scene: print JSON instead of tables")
    report.add_argument("--out", metavar="DIR", help="of a result: folder to write to; made if absent")
    report.add_argument("--overwrite", action="store_true", help="of a result: replace an earlier report")


def _add_show(commands: Any) -> None:
    text = "print what a result or a study says, and draw it"
    show = commands.add_parser("show", help=text, description=text)
    show.add_argument(
        "result", metavar="RESULT.nc|DIR",
        help="a result that `seacrane run` wrote, or the folder of a study, also while it runs",
    )  # fmt: skip
    show.add_argument("--start", metavar="S", type=float, help="leave out what comes before, s")
    show.add_argument("--end", metavar="S", type=float, help="leave out what comes after, s")
    show.add_argument("--json", action="store_true", help="print JSON instead of a table")
    show.add_argument(
        "--out", metavar="DIR", help="draw it into this folder; made if absent; of a study: default its own"
    )
    show.add_argument("--overwrite", action="store_true", help="replace an earlier picture")


def _add_study(commands: Any) -> None:
    text = "run the study of a lift: many runs, and what they tell; a call that was stopped goes on"
    study = commands.add_parser("study", help=text, description=text)
    study.add_argument("study", metavar="LIFT.toml", help="a lift with a [study]; data only")
    study.add_argument("--out", metavar="DIR", required=True, help="folder of the study; made if absent")
    study.add_argument("--workers", metavar="N", type=int, help="processes to run in; default: this one")
    study.add_argument("--dask", metavar="ADDRESS", help="scheduler of a Dask cluster to run on")
    study.add_argument("--progress", action="store_true", help="a bar with the time left, without a terminal")


def _add_view(commands: Any) -> None:
    text = "write a result, or a scene at its start, as a page in three dimensions"
    view = commands.add_parser("view", help=text, description=f"{text}: one HTML file that needs no network")
    view.add_argument(
        "source", metavar="RESULT.nc|SCENE", help=f"a result that `seacrane run` wrote; or {SCENE_HELP}"
    )
    view.add_argument(
        "--out", metavar="PAGE.html", required=True, help="file to write; its folder must exist"
    )
    view.add_argument("--overwrite", action="store_true", help="replace a file of that name")


def _add_hydro(commands: Any) -> None:
    text = "read a hydrodynamic database and print the verdict table of its self-check"
    hydro = commands.add_parser("hydro", help=text, description=text)
    hydro.add_argument("path", metavar="PATH", help=PATH_HELP)
    hydro.add_argument(
        "--memory",
        choices=("by-motion", "per-pair"),
        help="kind of the memory that is fitted; default by-motion, where the file holds none",
    )
    hydro.add_argument(
        "--band", nargs=2, type=float, metavar=("LOW", "HIGH"), help="rad/s that the memory is fitted over"
    )
    hydro.add_argument("--depth", type=float, metavar="M", help="water depth, of a file that holds several")
    hydro.add_argument("--json", action="store_true", help="print JSON instead of a table")
    hydro.add_argument("--out", metavar="DIR", help="also plot the database into this folder; made if absent")
    hydro.add_argument("--overwrite", action="store_true", help="replace earlier plots in that folder")


def _add_trade(commands: Any) -> None:
    text = "measure what every setting costs and what error it brings: trade.csv and trade.png"
    trade = commands.add_parser("trade", help=text, description=f"{text}; a call that was stopped goes on")
    trade.add_argument("scene", metavar="SCENE", help=SCENE_HELP)
    trade.add_argument("--out", metavar="DIR", required=True, help="folder to write to; made if absent")
    trade.add_argument(
        "--budget", type=float, metavar="RUNS", default=20.0,
        help="runs of the default setting that it may take beside its reference (20); inf: the whole grid",
    )  # fmt: skip


def _add_schema(commands: Any) -> None:
    text = "print the JSON Schema of lift files, with which editors complete and check them"
    schema = commands.add_parser("schema", help=text, description=text)
    schema.add_argument("--path", action="store_true", help="print where the installed copy is instead")


def _add_examples(commands: Any) -> None:
    text = "write the scripts, jobs, lift files and notebooks that come with seacrane"
    examples = commands.add_parser("examples", help=text, description=text)
    examples.add_argument("folder", metavar="DIR", help="folder to write to; made if absent")
    examples.add_argument("--overwrite", action="store_true", help="replace earlier ones in that folder")


def _add_doctor(commands: Any) -> None:
    text = "tell what is installed, what is fast and what is missing"
    doctor = commands.add_parser("doctor", help=text, description=text)
    doctor.add_argument("--json", action="store_true", help="print JSON instead of tables")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command; errors become one line on standard error.

    Parameters
    ----------
    arguments : sequence of str, optional
        What follows the program's name; the process's own arguments if None.

    Returns
    -------
    int
        Exit status: 0 done, 1 failed, 2 wrong arguments (then raised as SystemExit), 130 interrupted.
    """
    parser = build_parser()
    _complete(parser)
    chosen = parser.parse_args(arguments)
    if chosen.version:
        print(_version())
        return 0
    if chosen.command is None:
        parser.print_help(sys.stderr)
        return MISUSED
    return _run_command(chosen)


def _complete(parser: argparse.ArgumentParser) -> None:
    """Answer the shell where it asks for completions, and argcomplete is installed."""
    if "_ARGCOMPLETE" in os.environ:
        with contextlib.suppress(ImportError):
            import_module("argcomplete").autocomplete(parser)


def _version() -> str:
    """The version, and below it how the package was built."""
    from seacrane.cli.built import build_facts
    from seacrane.plotting.table import table_of

    facts = build_facts()
    rows = [(name, text) for name, text in facts.items() if name != "seacrane"]
    return str(table_of(("", ""), rows, title=f"seacrane {facts['seacrane']}"))


def _run_command(chosen: argparse.Namespace) -> int:
    usual = warnings.formatwarning
    warnings.formatwarning = partial(_one_line, f"seacrane {chosen.command}", usual)
    try:
        status: int = import_module(f"seacrane.cli.{chosen.command}_command").run(chosen)
        sys.stdout.flush()
        return status
    except KeyboardInterrupt:
        return _complain(chosen, "interrupted", INTERRUPTED)
    except BrokenPipeError:  # the reader of our output has left: nothing more to say, nor a place to say it
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FAILED
    except Exception as error:
        return _complain(chosen, explain(error), FAILED)
    finally:
        warnings.formatwarning = usual


def _one_line(
    command: str,
    usual: Callable[..., str],
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    line: str | None = None,
) -> str:
    """A warning as errors are told; with its place only where that is a line of the user's own script."""
    place = Path(filename)
    if place.exists() and place.resolve() != Path(sys.argv[0]).resolve() and PACKAGE not in place.parents:
        return usual(message, category, filename, lineno, line)
    return f"{command}: {category.__name__}: {message}\n"


def _complain(chosen: argparse.Namespace, text: str, status: int) -> int:
    print(f"seacrane {chosen.command}: {text}", file=sys.stderr)
    return status


def explain(error: Exception) -> str:
    """One line about an error; the kind of error is named where its text was not written for users."""
    text = " ".join(str(error.args[0] if isinstance(error, KeyError) and error.args else error).split())
    if isinstance(error, (ValueError, OSError)) or type(error).__module__.startswith("seacrane."):
        return text or type(error).__name__
    return f"unexpected {type(error).__name__}: {text}"
