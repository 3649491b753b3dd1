"""Measured series: their files, their clock, what is mended in them, and the values themselves."""
