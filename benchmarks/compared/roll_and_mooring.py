"""Roll damping after Ikeda, moorings, and damping by the far field of real ships' wave forces."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import test_ikeda_roll_damping as ikeda
import test_mooring as mooring

from seacrane import load_database
from seacrane.hydro.hull.ikeda import friction, lift
from seacrane.scene import MooringSpring, mooring_matrix

from .row import Row

SUBJECT = "Hydrodynamics"
IKEDA, MOORING = "hydro/test_ikeda_roll_damping.py", "sea/test_mooring.py"


def roll_damping() -> Iterator[Row]:
    """Ikeda's method against programs and other forms of it, and the decay that it makes."""
    yield _roll(
        "eddies and bilge keels of a ship of 300 m",
        "the program of Kawahara, Maekawa and Ikeda",
        _of_authors(),
        1e-10,
    )
    yield _roll("lift of S175 at 1 m/s", "another program", _of_s175(), 1e-6)
    yield _roll("friction of ITTC", "Himeno's form (1981)", _of_himeno(), 2e-3)
    keels = max(_of_keels(breadth, degrees) for breadth in (0.02, 0.03) for degrees in (5.0, 10.0, 15.0))
    yield _roll("bilge keels by the simple formulas", "Ikeda's own equations for one section", keels, 0.3)
    yield _roll("decrement of a free decay", "logarithmic decrement in closed form", _of_decay(), 2e-3)


def moorings() -> Iterator[Row]:
    """Stiffness of a moored vessel as linearised, less that of the free one, turned and displaced."""
    pose: dict[str, Any] = {"position": (30.0, -20.0, 0.0), "heading_deg": 130.0}
    free = mooring.stiffness(mooring.vessel(mooring=None, **pose))
    wanted = mooring_matrix(mooring.FOUR)
    held = mooring.stiffness(mooring.vessel(mooring=mooring.FOUR, **pose)) - free
    yield _moored("four springs", "the matrix assembled from them", held, wanted)
    wanted = mooring_matrix(mooring.SYMMETRIC)
    held = mooring.stiffness(mooring.vessel(mooring=wanted, **pose)) - free
    yield _moored("a full matrix, as springs of the scene", "the matrix as given", held, wanted)
    one = MooringSpring(point=(20.0, 0.0, 3.0), direction_deg=0.0, stiffness=1e5)
    closed = np.zeros((6, 6))
    closed[0, 0], closed[0, 4], closed[4, 0], closed[4, 4] = 1e5, 3e5, 3e5, 9e5
    yield _moored("one spring ahead", "k, k z, k z^2", mooring_matrix([one]), closed, limit=1e-12)


def far_fields(shared: Path) -> Iterator[Row]:
    """Damping of a file against what its wave forces radiate, worst motion over its largest damping."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        database = load_database(shared / "wamit")
    found = [row.value for row in database.check() if row.check.startswith("damping_from_forces")]
    yield Row(
        subject=SUBJECT,
        compared="a tanker's WAMIT files: damping from the far field of the forces (Haskind)",
        reference="the damping that the files hold", difference=max(found), unit="", limit=0.025,
        test="hydro/test_hydro_wamit.py",
    )  # fmt: skip


def _roll(compared: str, reference: str, difference: float, limit: float) -> Row:
    return Row(
        subject=SUBJECT, compared=f"roll damping: {compared}", reference=reference, difference=difference,
        unit="", limit=limit, test=IKEDA,
    )  # fmt: skip


def _moored(compared: str, reference: str, held: Any, wanted: Any, limit: float = 1e-5) -> Row:
    difference = float(np.abs(held - wanted).max() / np.abs(wanted).max())
    return Row(
        subject=SUBJECT, compared=f"mooring: stiffness of {compared}", reference=reference,
        difference=difference, unit="", limit=limit, test=MOORING,
    )  # fmt: skip


def _of_authors() -> float:
    """The program's total less its waves and its friction, in units of rho V B^2 sqrt(2 g / B)."""
    found = ikeda.ikeda_roll_damping(ikeda.SHIP, **ikeda.CALL)
    return float(abs((found.eddy + found.bilge_keels) / ikeda.UNIT / ikeda.OF_AUTHORS - 1.0))


def _of_s175() -> float:
    return float(abs(lift(**ikeda.S175, rho=1025.0) / ikeda.LIFT_OF_S175 - 1.0))


def _of_himeno() -> float:
    return float(abs(friction(**ikeda.PLATE) / ikeda.himeno(**ikeda.PLATE) - 1.0))


def _of_keels(breadth: float, degrees: float) -> float:
    simple, direct = ikeda.both_bilge_keels(breadth, degrees)
    return float(abs(simple / direct - 1.0))


def _of_decay() -> float:
    measured, decrement = ikeda.decrements(1e8)
    return float(max(abs(one / decrement - 1.0) for one in measured))
