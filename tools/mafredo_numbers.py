"""MaFreDo's reading of public OrcaFlex models, as JSON: by Python 3.12 with ``pip install mafredo``.

    python tools/mafredo_numbers.py ../shared/orcaflex > tests/hydro/mafredo_numbers.json

In SI, phases of exp(+i omega t), at the grid of each file; no directions are interpolated.
"""

import json
import sys
from pathlib import Path

import numpy as np
from mafredo import Hyddb1

MODELS = ("barge_100x30x4_q1", "refcase_lags", "refcase_leads")  # it refuses testModel's period Infinity
PLACES = 3, 9


def numbers(path):
    data = Hyddb1.create_from_orcaflex_yml(str(path), vessel_type_name="Vessel type1")
    found = []
    for omega in np.sort(data.frequencies)[list(PLACES)]:
        force = np.conj([rao.get_value(omega, 45.0) for rao in data._force]) * 1e3
        found.append(
            {
                "omega": float(omega),
                "added_mass": (np.asarray(data.amass(omega)) * 1e3).tolist(),
                "damping": (np.asarray(data.damping(omega)) * 1e3).tolist(),
                "force_at_45_deg": [[one.real, one.imag] for one in force.tolist()],
            }
        )
    return found


read = {name: numbers(Path(sys.argv[1]) / f"{name}.yml") for name in MODELS}
print("{" + ",\n".join(f"{json.dumps(name)}: {json.dumps(found)}" for name, found in read.items()) + "}")
