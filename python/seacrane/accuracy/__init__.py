"""The error of a run: what it is measured in, how it is told, and methods chosen by it."""
