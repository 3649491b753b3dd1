"""VERES reader on a small set written from the documented layout: round trip, random damage."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from seacrane.hydro import read_veres

TO_FILE = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])
OMEGA = np.array([0.4, 0.7, 1.1])
HEADING_DEG = np.array([0.0, 45.0, 90.0, 135.0, 180.0])
TEXT = ["HYDRODYNAMIC COEFFICIENTS (Version 2)", " Run name:", " Ship name: Box", " loading", "", " test"]
SCALE = np.array([1.0, 1.5, 3.0, 40.0, 90.0, 80.0])


def matrices(seed: int) -> np.ndarray:
    """Symmetric, positive definite (3, 6, 6) in our axes."""
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(3, 6, 6)) * 0.2 + np.eye(6)
    return np.asarray(np.einsum("nij,nkj->nik", root, root) * np.sqrt(np.outer(SCALE, SCALE)) * 1e5)


def transfer(seed: int) -> np.ndarray:
    """Complex (5, 3, 6) in our axes."""
    rng = np.random.default_rng(seed)
    return np.asarray(rng.normal(size=(5, 3, 6)) + 1j * rng.normal(size=(5, 3, 6)))


def header() -> list[str]:
    return [*TEXT, "1025.0 9.81", "60.0 14.0 5.0", "1.5 6.0"]


def transfer_lines(values: np.ndarray) -> list[str]:
    """A .re1 or .re8 file of ``values`` in our axes."""
    lines = [*header(), f"1 {len(HEADING_DEG)} {len(OMEGA)} 6", "0.0 0.0 0.0 1.5 5.0"]
    for h, heading in enumerate(HEADING_DEG):
        lines.append(f"{heading}")
        for k, omega in enumerate(OMEGA):
            lines.append(f"{omega}")
            file_axes = values[h, k] * TO_FILE
            lines += [f"{i + 1} {value.real!r} {value.imag!r}" for i, value in enumerate(file_axes.tolist())]
    return lines


def matrix_lines() -> list[str]:
    """A .re7 file of the matrices of this module."""
    both = np.outer(TO_FILE, TO_FILE)

    def rows(matrix: np.ndarray) -> list[str]:
        return [" ".join(repr(x) for x in row) for row in (matrix * both).tolist()]

    zero = np.zeros((6, 6))
    lines = [*header(), "-1 2", f"1 {len(HEADING_DEG)} {len(OMEGA)} 6", *rows(matrices(1)[0])]
    lines.append("0.0 0.0 0.0 1.5 5.0")
    for heading in HEADING_DEG:
        lines.append(f"{heading}")
        for k, omega in enumerate(OMEGA):
            lines.append(f"{omega}")
            for matrix in (matrices(2)[k], zero, matrices(3)[k], zero, matrices(4)[0], zero):
                lines += rows(matrix)
            lines.append(f"{1e4 + k} {2e4 + k} {3e4 + k}")
    return lines


CONTENT = {
    ".re7": "\n".join(matrix_lines()),
    ".re8": "\n".join(transfer_lines(transfer(5))),
    ".re1": "\n".join(transfer_lines(transfer(6))),
}


def write(folder: Path, content: dict[str, str] = CONTENT) -> Path:
    """The set of files as ``box`` in ``folder``."""
    for suffix, text in content.items():
        (folder / f"box{suffix}").write_text(text, encoding="latin-1")
    return folder


def test_round_trip_from_our_axes(tmp_path: Path) -> None:
    database = read_veres(write(tmp_path))
    assert np.array_equal(database.mass_matrix, matrices(1)[0])
    assert np.array_equal(database.added_mass, matrices(2))
    assert np.array_equal(database.damping, matrices(3))
    assert np.array_equal(database.restoring, matrices(4)[0])
    direction = np.degrees(database.heading)
    assert direction == pytest.approx([0.0, 180.0, 225.0, 270.0, 315.0])
    order = [4, 0, 1, 2, 3]
    assert np.array_equal(database.force, transfer(5)[order])
    assert database.motion_rao is not None
    assert np.array_equal(database.motion_rao, transfer(6)[order])
    assert database.additional == ()
    assert database.roll_damping is not None
    assert database.roll_damping.quadratic.tolist() == [20000.0, 20001.0, 20002.0]
    assert "1.5 m aft of midship" in database.origin
