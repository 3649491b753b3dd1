"""Case 2 in the interpreter that runs this: ``python same_run.py SECONDS FILE`` keeps where bodies are."""

import sys
import warnings

import numpy as np

from seacrane import cases, simulate

span, file = float(sys.argv[1]), sys.argv[2]
warnings.simplefilter("ignore")
scene = cases.case2()
runs = [simulate(scene, span, channels=["position"]) for _ in range(3)]
np.save(file, runs[0]["position"])
print(min(float(run.stats["wall_s"]) for run in runs))
