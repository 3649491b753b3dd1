"""Hostile input: fuzz targets, mutators, driver and corpus; see docs/hostile-input.md."""
