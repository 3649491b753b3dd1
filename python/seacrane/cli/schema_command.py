"""``seacrane schema``: the JSON Schema of lift files."""

from __future__ import annotations

import argparse


def run(arguments: argparse.Namespace) -> int:
    """Print the schema, or its path."""
    from seacrane.lift.schema import schema_path, schema_text

    print(schema_path() if arguments.path else schema_text(), end="\n" if arguments.path else "")
    return 0
