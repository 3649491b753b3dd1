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
SCENE = "case1, case2, case3, vessel (the vessel alone in waves), a lift (.toml) or a scene file; data only"
PATH = (
    "a file or folder of any supported kind: a VERES or WAMIT folder or common stem, a NetCDF file of "
    "seacrane or Capytaine, and others (`seacrane hydro` lists them)"
)
FOLDER = "folder to write to; made if absent"
RESULT = "a result that `seacrane run` wrote"
AS_JSON = ("--json", None, str, "print JSON instead of tables")
FLAG, REQUIRED = None, {"required": True}  # in place of what a value is called, and behind a row
# Name, what its value is called or may be, type, help, and what else it has.
Row = tuple[Any, ...]


def _gamma(text: str) -> float | str:
    return text if text == "dnv" else float(text)


WORKERS: Sequence[Row] = (
    ("--workers", "N", int, "processes to run in; default: this one"),
    ("--dask", "ADDRESS", str, "scheduler of a Dask cluster to run on"),
    ("--progress", FLAG, str, "a bar with the time left, without a terminal"),
)
MANY: Sequence[Row] = (  # of what is run many times
    ("--part", "I/N", str, "run this part of N alone; seacrane merge makes one of all"),
    ("--price", FLAG, str, "run a few members, which are kept, print what all cost, and stop"),
    *WORKERS,
)
COMMANDS: dict[str, tuple[str, str, Sequence[Row]]] = {
    "run": ("run_command", "simulate a scene and write DIR/<scene>.nc", (
        ("scene", "SCENE", str, f"{SCENE}, or a .py script defining scene(), which is executed"),
        ("--out", "DIR", str, FOLDER, REQUIRED),
        ("--t-end", "S", float, "end time, s"),
        ("--dt-out", "S", float, "output interval, s"),
        ("--integrator", "NAME", str, "default dopri5; an unknown name lists them all"),
        ("--rtol", "X", float, "tolerance of adaptive integrators: error per step over each state's scale"),
        ("--dt", "S", float, "step of fixed-step integrators, s"),
        ("--spectral-radius", "R", float, "of generalized-alpha, 0 to 1"),
        ("--formulation", ("redundant", "recursive", "auto"), str, "equations of motion"),
        ("--checkpoint-every", "S", float, "simulated time between two writes to disk, s"),
        ("--resume", FLAG, str, "go on with the run that DIR holds, stopped or killed"),
        ("--overwrite", FLAG, str,
         "replace a result of another scene or other settings, and what a killed run left"),
        ("--progress", FLAG, str, "show a progress bar"),
    )),
    "paper": ("paper_command",
              "compute the paper's cases: figures 3 to 10, the data behind every panel, and report.html", (
        ("--out", "DIR", str, FOLDER, REQUIRED),
        ("--overwrite", FLAG, str, "replace what an earlier call wrote there"),
    )),
    "report": ("result_commands", "print what the compiled model of a scene holds, or write the report of a "
               "result: DIR/<name>.html", (
        ("source", "SCENE|RESULT.nc", str, f"{SCENE}; or {RESULT}"),
        ("--json", FLAG, str, "of a scene: print JSON instead of tables"),
        ("--out", "DIR", str, f"of a result: {FOLDER}"),
        ("--overwrite", FLAG, str, "of a result: replace an earlier report"),
    )),
    "show": ("result_commands", "print what a result or a study says, and draw it", (
        ("result", "RESULT.nc|DIR", str, f"{RESULT}, or the folder of a study, also while it runs"),
        ("--start", "S", float, "leave out what comes before, s"),
        ("--end", "S", float, "leave out what comes after, s"),
        AS_JSON,
        ("--out", "DIR", str, "draw it into this folder; made if absent; of a study: default its own"),
        ("--overwrite", FLAG, str, "replace an earlier picture"),
    )),
    "study": ("study_command",
              "run the study of a lift: many runs, and what they tell; a call that was stopped goes on", (
        ("study", "LIFT.toml", str, "a lift with a [study]; data only"),
        ("--out", "DIR", str, "folder of the study; made if absent", REQUIRED),
        ("--member-limit", "S", float, "processor time after which a member has failed, s; others go on"),
        *MANY,
    )),
    "sheet": ("study_command", "make the sheet of a lift: the seas that each phase allows, go or no go, "
              "windows; a call that was stopped goes on", (
        ("sheet", "LIFT.toml", str, "a lift with a [sheet]; data only"),
        ("--out", "DIR", str, "folder of sheet.csv, sheet.html and the runs; made if absent", REQUIRED),
        *MANY,
    )),
    "answers": ("study_command", "give the answers that a lift asks for: fatigue, codes beside the run, "
                "re-hits, deck cargo; a call that was stopped goes on", (
        ("lift", "LIFT.toml", str, "a lift with tables of answers, such as [fatigue]; data only"),
        ("--out", "DIR", str, "folder of answers.html, tables and runs; made if absent", REQUIRED),
        *WORKERS,
    )),
    "merge": ("study_command", "make one study or sheet of the folders of all its parts, and tell what it "
              "says", (
        ("parts", "PART", str, "folder of a part, of seacrane study or sheet --part", {"nargs": "+"}),
        ("--out", "DIR", str, "folder of the whole; made if absent", REQUIRED),
    )),
    "view": ("result_commands", "write a result, or a scene at its start, as a page in three dimensions: one "
             "HTML file that needs no network", (
        ("source", "RESULT.nc|SCENE", str, f"{RESULT}; or {SCENE}"),
        ("--out", "PAGE.html", str, "file to write; its folder must exist", REQUIRED),
        ("--overwrite", FLAG, str, "replace a file of that name"),
    )),
    "hydro": ("data_commands",
              "read a hydrodynamic database and print the verdict table of its self-check", (
        ("path", "PATH", str, f"{PATH}; without one, a table of all kinds", {"nargs": "?"}),
        ("--memory", ("by-motion", "per-pair"), str,
         "kind of the memory that is fitted; default by-motion, where the file holds none"),
        ("--band", ("LOW", "HIGH"), float, "rad/s that the memory is fitted over", {"nargs": 2}),
        ("--depth", "M", float, "water depth, of a file that holds several"),
        ("--mass", ("T", "X", "Y", "Z", "RX", "RY", "RZ"), float,
         "mass in t, its centre in m from the file's reference point, and radii of gyration in m, of a file "
         "that holds none", {"nargs": 7}),
        ("--write", "FILE", str,
         "also write it: NetCDF of seacrane (.nc), or WAMIT's .1 .3 .hst .frc (.1); read back and compared"),
        AS_JSON,
        ("--out", "DIR", str, "also plot the database into this folder; made if absent"),
        ("--overwrite", FLAG, str, "replace earlier plots in that folder, and what --write names"),
    )),
    "trade": ("run_command", "measure what every setting costs and what error it brings: trade.csv and "
              "trade.png; a call that was stopped goes on", (
        ("scene", "SCENE", str, SCENE),
        ("--out", "DIR", str, FOLDER, REQUIRED),
        ("--budget", "RUNS", float, "runs of the default setting that it may take beside its reference (20); "
         "inf: the whole grid", {"default": 20.0}),
    )),
    "schema": ("data_commands",
               "print the JSON Schema of lift files, with which editors complete and check them", (
        ("--path", FLAG, str, "print where the installed copy is instead"),
    )),
    "examples": ("data_commands",
                 "write the scripts, jobs, lift files and notebooks that come with seacrane", (
        ("folder", "DIR", str, FOLDER),
        ("--overwrite", FLAG, str, "replace earlier ones in that folder"),
    )),
    "doctor": ("doctor_command", "tell what is installed, what is fast and what is missing", (AS_JSON,)),
}  # fmt: skip
CASES: Sequence[Row] = (
    ("--memory", ("by-motion", "per-pair", "convolution", "none"), str,
     "fluid memory of the vessel; default per-pair, which is the paper's"),
    ("--hs", "M", float, "significant wave height, m"),
    ("--tp", "S", float, "peak period, s"),
    ("--wave-direction-deg", "D", float,
     "direction the waves travel to, deg, from forward towards port: 0 following, 180 head seas"),
    ("--spectrum", ("jonswap", "pierson-moskowitz", "torsethaugen"), str, "shape of the sea's spectrum"),
    ("--gamma", "X", _gamma, "peak enhancement of jonswap, 1 to 7, or dnv: by DNV-RP-C205"),
    ("--spreading", "S", float, "short-crested sea: exponent s of cos^2s(angle / 2)"),
    ("--seed", "N", int, "seed of the wave realisation"),
    ("--database", "PATH", str, f"the vessel's hydrodynamics: {PATH}"),
)  # fmt: skip


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(MISUSED, f"{self.prog}: {message} (see {self.prog} --help)\n")


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    parser = _Parser(prog="seacrane", description=DESCRIPTION)
    parser.add_argument("--version", action="store_true", help="print version and build, and stop")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for name, (_, text, rows) in COMMANDS.items():
        command = commands.add_parser(name, help=text, description=text)
        _add(command, rows)
        if name == "run":
            words = "these choose the vessel and the sea of a named case"
            _add(command.add_argument_group("the built-in cases", words), CASES)
    return parser


def _add(command: Any, rows: Sequence[Row]) -> None:
    for name, shown, kind, text, *more in rows:
        given: dict[str, Any] = {"help": text, **(more[0] if more else {})}
        if shown is FLAG:
            command.add_argument(name, action="store_true", **given)
        elif isinstance(shown, tuple) and "nargs" not in given:
            command.add_argument(name, choices=shown, **given)
        else:
            command.add_argument(name, metavar=shown, type=kind, **given)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command by what follows the program's name; errors become one line on standard error.

    Returns the exit status: 0 done, 1 failed, 2 wrong arguments (then raised as SystemExit), 130 interrupted.
    """
    parser = build_parser()
    if "_ARGCOMPLETE" in os.environ:  # the shell asks for completions
        with contextlib.suppress(ImportError):
            import_module("argcomplete").autocomplete(parser)
    chosen = parser.parse_args(arguments)
    if chosen.version:
        print(_version())
        return 0
    if chosen.command is None:
        parser.print_help(sys.stderr)
        return MISUSED
    return _run_command(chosen)


def _version() -> str:
    """The version, and below it how the package was built."""
    from seacrane.cli.doctor_command import build_facts
    from seacrane.plotting.table import table_of

    facts = build_facts()
    rows = [(name, text) for name, text in facts.items() if name != "seacrane"]
    return str(table_of(("", ""), rows, title=f"seacrane {facts['seacrane']}"))


def _run_command(chosen: argparse.Namespace) -> int:
    usual = warnings.formatwarning
    warnings.formatwarning = partial(_one_line, f"seacrane {chosen.command}", usual)
    try:
        module = import_module(f"seacrane.cli.{COMMANDS[chosen.command][0]}")
        status: int = getattr(module, chosen.command)(chosen)
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
    command: str, usual: Callable[..., str], message: Warning | str, category: type[Warning], filename: str,
    lineno: int, line: str | None = None,
) -> str:  # fmt: skip
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
