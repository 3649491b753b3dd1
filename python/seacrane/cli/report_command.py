"""``seacrane report``: what the compiled model of a scene holds, or the report of a result."""

from __future__ import annotations

import argparse
from pathlib import Path

from seacrane.cli.as_json import to_json
from seacrane.cli.output_folder import output_folder
from seacrane.cli.scene_source import is_result, load_scene
from seacrane.errors import SceneError


def run(arguments: argparse.Namespace) -> int:
    """Tell a scene from a result by what the file holds, and report it."""
    source = str(arguments.source)
    if is_result(source):
        return _write(arguments, Path(source))
    if source.endswith((".nc", ".partial")) and not Path(source).exists():
        raise SceneError(f"there is no file {source}; `seacrane run` names the file that it saves")
    if arguments.out is not None or arguments.overwrite:
        raise SceneError(f"--out and --overwrite go with the file of a result, and {source} is none")
    return _print(arguments)


def _write(arguments: argparse.Namespace, path: Path) -> int:
    if arguments.json:
        raise SceneError(
            f"--json goes with a scene, and {path} holds results; Result.load() gives its numbers"
        )
    if arguments.out is None:
        raise SceneError(f"{path} holds results; name the folder of its report by --out DIR")
    from seacrane.answers import report
    from seacrane.result import Result

    page = report(Result.load(path))
    name = f"{path.name.removesuffix('.partial').removesuffix('.nc')}.html"
    folder = output_folder(arguments.out, holds=[name], overwrite=arguments.overwrite)
    print(f"saved {page.save(folder / name, overwrite=arguments.overwrite)}")
    return 0


def _print(arguments: argparse.Namespace) -> int:
    """The scene's report as text, or as JSON: a list of {name, value} for each section."""
    _, scene = load_scene(arguments.source, arguments, scripts=False)
    report = scene.report()
    if arguments.json:
        print(
            to_json({section: [{"name": n, "value": v} for n, v in rows] for section, rows in report.items()})
        )
        return 0
    print(report)
    return 0
