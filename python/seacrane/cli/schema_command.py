"""``seacrane schema``: the JSON Schema of lift files and of study files."""

from __future__ import annotations

import argparse


def run(arguments: argparse.Namespace) -> int:
    """Print the schema, or its path."""
    from seacrane.lift.schema import schema_path, schema_text
    from seacrane.lift.study_schema import study_schema_text

    if arguments.path:
        print(schema_path("study" if arguments.study else "lift"))
    else:
        print(study_schema_text() if arguments.study else schema_text(), end="")
    return 0
