"""Measured sets, a file each with `SOURCE` and `rows`; `benchmarks/measurements.py` finds them here."""
