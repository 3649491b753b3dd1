"""Sets of measured series, a file each, with `SOURCE` and `rows`; `benchmarks/measurements.py` finds them here."""
