"""``seacrane report``: what the compiled model of a scene holds."""

from __future__ import annotations

import argparse

from seacrane.cli.scene_source import load_scene
from seacrane.cli.tables import text_table, to_json


def run(arguments: argparse.Namespace) -> int:
    """Print the scene's report as text, or as JSON: a list of {name, value} for each section."""
    _, scene = load_scene(arguments.scene, arguments, scripts=False)
    report = scene.report()
    if arguments.json:
        print(
            to_json({section: [{"name": n, "value": v} for n, v in rows] for section, rows in report.items()})
        )
        return 0
    from seacrane.figures.report import format_value

    for number, (section, rows) in enumerate(report.items()):
        print(("\n" if number else "") + section)
        table = text_table(["", ""], [(str(name), format_value(value)) for name, value in rows])
        print("\n".join(f"  {line}" for line in table.splitlines()[1:]))
    return 0
