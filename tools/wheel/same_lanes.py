"""Seeds of case 2 side by side and one by one in the interpreter that runs this: ``same_lanes.py SECONDS``.

Prints, as JSON, a row for each number of lanes of this build: how many seeds went side by side, how far their
payload is from where it is one by one (m), and the time over that of one by one.
"""

import json
import sys
import time
import warnings

import numpy as np

from seacrane import Kept, cases, ensemble
from seacrane.run.lanes import INSTRUCTIONS, module_of

REPEATS = 3
SPAN_OF_TIMES = 100.0  # s
SCENE = cases.case2()


def lanes_used(result):
    """Beside how many, itself included, a member was stepped."""
    return float(result.stats.get("lanes", 1))


def seeds(count, lanes, span, rtol):
    """The ensemble, and the seconds that it took."""
    keep = {"track": Kept(channel="position", names={"body": "payload"}), "lanes": lanes_used}
    over = {"seed": range(1, count + 1)}
    begin = time.perf_counter()
    made = ensemble(
        SCENE, over=over, keep=keep, t_end=span, rtol=rtol, lanes=lanes,
        on_error="raise",
    )  # fmt: skip
    return made.dataset, time.perf_counter() - begin


warnings.simplefilter("ignore")
span = float(sys.argv[1])
rows = []
for lanes in INSTRUCTIONS:
    if module_of(lanes) is None:
        continue
    beside, alone = (seeds(lanes, how, span, 1e-9)[0] for how in (lanes, 1))
    quickest = [min(seeds(lanes, how, SPAN_OF_TIMES, 1e-3)[1] for _ in range(REPEATS)) for how in (lanes, 1)]
    rows.append(
        {
            "lanes": lanes,
            "beside": int((beside.lanes == lanes).sum()),
            "apart": float(np.abs(beside.track - alone.track).max()),
            "time": quickest[0] / quickest[1],
        }
    )
print(json.dumps(rows))
