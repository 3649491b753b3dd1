"""The command line ``seacrane``; commands are imported when they are called, so that help is quick."""

from seacrane.cli.command_line import main

__all__ = ["main"]
