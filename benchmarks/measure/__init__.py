"""What `benchmarks/run.py` measures, one subject per module."""

from __future__ import annotations

import os

# One thread for every library; it counts only before NumPy is loaded.
for _name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[_name] = "1"
