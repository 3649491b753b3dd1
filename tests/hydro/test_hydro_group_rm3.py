"""RM3, a float around a spar with a plate, by WAMIT, Capytaine and NEMOH: how far they differ."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane.errors import FileFormatError
from seacrane.hydro import HydroGroup, load_database, read_capytaine, read_nemoh, read_wamit

pytestmark = pytest.mark.filterwarnings("ignore::seacrane.warnings.SourceWarning")

CENTRES = {"rm3_float": (0.0, 0.0, -0.72), "rm3_spar": (0.0, 0.0, -21.29)}
OMEGA = 1.0  # rad/s
# Heave of the float (2) and of the spar (8): WAMIT's value, and how far the others may be.
TABLE = {
    "added_mass": {(2, 2): (1.200e6, 0.005), (8, 2): (-3.07e4, 0.25), (8, 8): (8.851e6, 0.27)},
    "damping": {(2, 2): (6.488e5, 0.012), (8, 2): (-2.270e5, 0.29)},
}


def three_codes(folder: Path) -> dict[str, HydroGroup]:
    """Masses and restoring are those of Capytaine's file: the others hold none by body."""
    capytaine = read_capytaine(folder / "capytaine" / "rm3_hydrodynamics.nc", rotation_centre=CENTRES)
    of_bodies = dict(zip(("float", "spar"), capytaine.bodies, strict=True))
    masses = {name: body.mass_matrix for name, body in of_bodies.items()}
    restorings = {name: body.restoring for name, body in of_bodies.items()}
    return {
        "wamit": read_wamit(folder / "wamit", rho=1000.0, mass_matrix=masses),
        "capytaine": capytaine,
        "nemoh": read_nemoh(folder / "nemoh3", mass_matrix=masses, restoring=restorings),
    }


@pytest.fixture(scope="module")
def codes(shared: Path) -> dict[str, HydroGroup]:
    folder = shared / "rm3"
    if not folder.is_dir():
        pytest.skip(f"no {folder}")
    return three_codes(folder)


def test_codes_agree_as_far_as_they_do(codes: dict[str, HydroGroup], shared: Path) -> None:
    """The bounds are those of the codes; a wrong index, scale or sign is beyond them."""
    at = {name: int(np.abs(group.omega - OMEGA).argmin()) for name, group in codes.items()}
    for table, entries in TABLE.items():
        for entry, (value, limit) in entries.items():
            for name, group in codes.items():
                found = getattr(group, table)[at[name]][entry]
                assert found == pytest.approx(value, rel=2e-3 if name == "wamit" else limit)
    forces = {name: group.force[0, at[name]] for name, group in codes.items()}
    for name in ("capytaine", "nemoh"):
        assert forces[name][2] == pytest.approx(forces["wamit"][2], rel=0.02)
        assert np.angle(forces[name][8] / forces["wamit"][8]) == pytest.approx(0.0, abs=np.radians(1.5))
    # A15 of WAMIT (potentials) is A51 of Capytaine (sources), and the mean of both is one number to 3 %.
    wamit, capytaine = (codes[name].added_mass[at[name]] for name in ("wamit", "capytaine"))
    assert wamit[0, 4] == pytest.approx(capytaine[4, 0], rel=0.04)
    assert wamit[4, 0] == pytest.approx(capytaine[0, 4], rel=0.01)
    assert abs(wamit[0, 4] / wamit[4, 0] - 1.0) > 0.3
    assert wamit[0, 4] + wamit[4, 0] == pytest.approx(capytaine[0, 4] + capytaine[4, 0], rel=0.03)
    # The folder's own KH files hold float and spar together, as C55 below zero tells.
    with pytest.raises(FileFormatError, match=r"body float: restoring C33 .* C55"):
        load_database(shared / "rm3" / "nemoh3")
