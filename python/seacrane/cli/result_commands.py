"""``seacrane report``, ``show`` and ``view``: what a scene, a result or a study says, printed and drawn."""

from __future__ import annotations

import argparse
from pathlib import Path

from seacrane.cli.output import output_folder, stem_of, to_json
from seacrane.cli.scene_source import is_result, load_source
from seacrane.errors import SceneError


def report(arguments: argparse.Namespace) -> int:
    """Tell a scene from a result by what the file holds, and report it."""
    source = str(arguments.source)
    if is_result(source):
        return _write(arguments, Path(source))
    if source.endswith((".nc", ".partial")) and not Path(source).exists():
        raise SceneError(f"there is no file {source}; `seacrane run` names the file that it saves")
    if arguments.out is not None or arguments.overwrite:
        raise SceneError(f"--out and --overwrite go with the file of a result, and {source} is none")
    told = load_source(source, arguments).scene.report()
    by_section = {title: [{"name": n, "value": v} for n, v in rows] for title, rows in told.items()}
    print(to_json(by_section) if arguments.json else told)
    return 0


def _write(arguments: argparse.Namespace, path: Path) -> int:
    if arguments.json:
        raise SceneError(
            f"--json goes with a scene, and {path} holds results; Result.load() gives its numbers"
        )
    if arguments.out is None:
        raise SceneError(f"{path} holds results; name the folder of its report by --out DIR")
    from seacrane import answers
    from seacrane.result import Result

    page, name = answers.report(Result.load(path)), f"{stem_of(path)}.html"
    folder = output_folder(arguments.out, holds=[name], overwrite=arguments.overwrite)
    print(f"saved {page.save(folder / name, overwrite=arguments.overwrite)}")
    return 0


def show(arguments: argparse.Namespace) -> int:
    """Print the summary; with --out, draw its curves. Of the folder of a study: tables and figures."""
    path = Path(arguments.result)
    if path.is_dir():
        given = {"--start": arguments.start, "--end": arguments.end, "--json": arguments.json or None}
        named = [name for name, value in given.items() if value is not None]
        if named:
            raise SceneError(f"{', '.join(named)} is for a result, and {path} is a folder of a study")
        show_study(arguments.result, arguments.out)
        return 0
    from seacrane.answers.reported_curves import plot_summary
    from seacrane.answers.summary import summary
    from seacrane.plotting.panel import save_figure
    from seacrane.result import Result

    result = Result.load(path)
    told = summary(result, after=arguments.start, before=arguments.end)
    rows = {row.name: {k: v for k, v in vars(row).items() if k not in ("name", "printed")} for row in told}
    print(to_json({"rows": rows, "remarks": told.remarks}) if arguments.json else told)
    if arguments.out is not None:
        name = f"{stem_of(path)}.png"
        folder = output_folder(arguments.out, holds=[name], overwrite=arguments.overwrite)
        picture = save_figure(plot_summary(result), folder / name)
        if not arguments.json:
            print(f"saved {picture}")
    return 0


def show_study(study: str, out: str | None) -> None:
    """Print the tables of a study, and write them and their figures into a folder, by default its own."""
    from seacrane.lift.shown_study import shown_study, study_sheets
    from seacrane.plotting.panel import draw, save_figure, save_table

    shown = shown_study(study)
    print(shown)
    folder = output_folder(study if out is None else out)
    saved = [save_table(one.head(), list(one.rows()), folder / f"{one.name}.csv") for one in shown.tables]
    saved += [save_figure(draw(sheet), folder / f"{name}.png") for name, sheet in study_sheets(shown)]
    if saved:
        print(f"\nsaved {', '.join(path.name for path in saved)} in {folder}")


def view(arguments: argparse.Namespace) -> int:
    """Refuse before the work what could not be written after it."""
    page, source = Path(arguments.out), str(arguments.source)
    if page.is_dir():
        raise IsADirectoryError(f"--out {page} is a folder; name the page, such as {page / 'lift.html'}")
    if page.exists() and not arguments.overwrite:
        raise FileExistsError(f"--out {page} is there already; give another name, or --overwrite")
    from seacrane import pictures
    from seacrane.result import Result

    what = Result.load(source) if is_result(source) else load_source(source, arguments).scene
    print(f"saved {pictures.view(what).save(page, overwrite=arguments.overwrite)}")
    return 0
