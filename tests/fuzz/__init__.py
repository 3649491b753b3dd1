"""Hostile input: fuzz targets, mutators, driver and corpus; see docs/contributing.md."""
