"""Results kept: scenes run by two methods each, and what their channels were, to the bit.

`python -m bits` with PYTHONPATH=tools; docs/contributing.md says when.
"""

import os

# Before NumPy is loaded, here and in every worker: fits are made, not found on disk, and sums of linear
# algebra have one order.
os.environ["SEACRANE_CACHE"] = "off"
os.environ.update(dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"))
