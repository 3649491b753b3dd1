"""Hostile input: fuzz targets, mutators and corpus; driven by tools/fuzzing, see docs/contributing.md."""
