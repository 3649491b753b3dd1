"""Small sets of ShipX/VERES files written from the documented layout, at any number of speeds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

TO_FILE = np.array([-1.0, -1.0, 1.0, -1.0, -1.0, 1.0])
BOTH = np.outer(TO_FILE, TO_FILE)
G = 9.81
LENGTH, BREADTH, DRAUGHT, RHO = 60.0, 14.0, 5.0, 1025.0
SIZE = np.array([1.0, 1.5, 3.0, 40.0, 90.0, 80.0]) * 1e6
COUPLING = np.zeros((6, 6))
for j, k, value in ((0, 2, 0.1), (0, 4, 0.1), (2, 4, 0.2), (1, 3, -0.2), (1, 5, 0.15), (3, 5, 0.1)):
    COUPLING[j, k] = COUPLING[k, j] = value
MASS = np.diag([4.3e6, 4.3e6, 4.3e6, 1.1e8, 9e8, 9e8])
RESTORING = np.diag([0.0, 0.0, 8e6, 6e7, 2.2e9, 0.0])
ROLL = (2e7, 3e8)  # linear, quadratic
HEADING_DEG = np.arange(0.0, 181.0, 30.0)
TEXT = ["HYDRODYNAMIC COEFFICIENTS (Version 2)", " Run name:", " Ship name: Box", " loading", "", " test"]


def added_mass(encounter: np.ndarray, speed: float) -> np.ndarray:
    """Added mass (..., 6, 6) in file axes; at speed with the terms that strip theory adds."""
    w = np.abs(encounter)[..., None, None]
    matrix = np.sqrt(np.outer(SIZE, SIZE)) * (np.eye(6) + COUPLING) * (0.8 + 0.5 * np.exp(-(w**2)))
    return np.asarray(matrix + with_speed(speed * -_zero_speed_damping(encounter) / w**2))


def damping(encounter: np.ndarray, speed: float) -> np.ndarray:
    """Damping (..., 6, 6) in file axes."""
    w = np.abs(encounter)[..., None, None]
    still = np.sqrt(np.outer(SIZE, SIZE)) * (np.eye(6) + COUPLING) * (0.8 + 0.5 * np.exp(-(w**2)))
    return np.asarray(_zero_speed_damping(encounter) + with_speed(speed * still))


def _zero_speed_damping(encounter: np.ndarray) -> np.ndarray:
    w = np.abs(encounter)[..., None, None]
    return np.asarray(np.sqrt(np.outer(SIZE, SIZE)) * (np.eye(6) + COUPLING) * w**3 * np.exp(-(w**2)))


def with_speed(term: np.ndarray) -> np.ndarray:
    """Heave-pitch and sway-yaw terms of opposite signs (Salvesen, Tuck and Faltinsen 1970)."""
    out = np.zeros_like(term)
    out[..., 2, 4], out[..., 4, 2] = term[..., 2, 2], -term[..., 2, 2]
    out[..., 1, 5], out[..., 5, 1] = -term[..., 1, 1], term[..., 1, 1]
    return out


@dataclass
class VeresRun:
    """What is written; ``encounter_of`` lets a test spoil the dependence on the encounter frequency."""

    speeds: Sequence[float] = (0.0,)
    heading_deg: np.ndarray = field(default_factory=lambda: HEADING_DEG)
    omega: np.ndarray = field(default_factory=lambda: np.linspace(0.15, 2.65, 51))
    version: int = 2
    heading_error: float = 0.0

    def encounter(self, speed: float) -> np.ndarray:
        """Encounter frequency (m, n), file headings: 0 is a head sea."""
        along = np.cos(np.radians(self.heading_deg))
        along[np.abs(along) < 1e-12] = 0.0
        return np.asarray(self.omega + speed / G * np.outer(along, self.omega**2))

    def matrices(self, speed: float) -> tuple[np.ndarray, np.ndarray]:
        """A and B (m, n, 6, 6)."""
        we = self.encounter(speed)
        factor = 1.0 + self.heading_error * np.cos(np.radians(self.heading_deg))[:, None, None, None]
        return added_mass(we, speed) * factor, damping(we, speed) * factor

    def force(self) -> np.ndarray:
        """Excitation (m, n, 6) with the symmetry of a ship."""
        beta, w = np.radians(self.heading_deg)[:, None], self.omega[None, :]
        shape = np.stack([np.cos(beta) * 1j, np.sin(beta) * 1j, 1.0 + 0.0 * beta, np.sin(beta) * 3j,
                          np.cos(beta) * 20j, 5.0 * np.sin(2.0 * beta)], axis=-1)  # fmt: skip
        return np.asarray(shape * (2e6 * np.exp(-0.4 * w**2))[..., None] * np.exp(0.3j * w)[..., None])

    def linearised(self) -> np.ndarray:
        """Linearised roll damping (m, n)."""
        return np.asarray(1e7 * np.outer(1.0 + np.sin(np.radians(self.heading_deg)), self.omega))

    def motion(self, speed: float) -> np.ndarray:
        """Motions (m, n, 6), solved exactly at the encounter frequencies."""
        a, b = self.matrices(speed)
        b[..., 3, 3] += ROLL[0] + self.linearised()
        w = self.encounter(speed)[..., None, None]
        dynamic = -(w**2) * (MASS + a) + 1j * w * b + RESTORING
        return np.asarray(np.linalg.solve(dynamic, self.force()[..., None])[..., 0])

    def write(self, folder: Path, *, leave_out: dict[str, Sequence[float]] | None = None) -> Path:
        """``box.re7``, ``.re8``, ``.re1``, ``.re2`` in ``folder``; ``leave_out`` are speeds by suffix."""
        missing = leave_out or {}

        def kept(suffix: str) -> list[float]:
            return [speed for speed in self.speeds if speed not in missing.get(suffix, ())]

        texts = {
            ".re7": self._re7(kept(".re7")),
            ".re8": self._transfer(kept(".re8"), {speed: self.force() for speed in self.speeds}),
            ".re1": self._transfer(kept(".re1"), {speed: self.motion(speed) for speed in self.speeds}),
            ".re2": self._re2(kept(".re2")),
        }
        for suffix, lines in texts.items():
            (folder / f"box{suffix}").write_text("\n".join(lines) + "\n")
        return folder / "box"

    def _header(self, *, gravity_line: bool = True) -> list[str]:
        lines = [*TEXT, f"{RHO} {G}", f"{LENGTH} {BREADTH} {DRAUGHT}"]
        return [*lines, "1.5 6.0"] if gravity_line else lines

    def _counts(self, speeds: Sequence[float]) -> str:
        return f"{len(speeds)} {len(self.heading_deg)} {len(self.omega)}"

    def _re7(self, speeds: Sequence[float]) -> list[str]:
        lines = self._header() + (["-1 2"] if self.version == 2 else [])
        lines += [self._counts(speeds) + " 6", *rows(MASS)]
        zero = np.zeros((6, 6))
        linearised = self.linearised()
        for speed in speeds:
            a, b = self.matrices(speed)
            lines.append(f"{speed} 0.0 0.0 1.5 5.0")
            for h, heading in enumerate(self.heading_deg):
                lines.append(f"{heading}")
                for k, omega in enumerate(self.omega):
                    lines.append(f"{omega}")
                    blocks = (a[h, k], zero, b[h, k], zero, RESTORING, zero)
                    for matrix in blocks if self.version == 2 else blocks[::2]:
                        lines += rows(matrix)
                    lines.append(f"{ROLL[0]} {ROLL[1]} {linearised[h, k]}")
        return lines

    def _transfer(self, speeds: Sequence[float], values: dict[float, np.ndarray]) -> list[str]:
        lines = [*self._header(), self._counts(speeds) + " 6"]
        for speed in speeds:
            lines.append(f"{speed} 0.0 0.0 1.5 5.0")
            for h, heading in enumerate(self.heading_deg):
                lines.append(f"{heading}")
                for k, omega in enumerate(self.omega):
                    lines.append(f"{omega}")
                    row = values[speed][h, k].tolist()
                    lines += [f"{i + 1} {value.real!r} {value.imag!r}" for i, value in enumerate(row)]
        return lines

    def _re2(self, speeds: Sequence[float]) -> list[str]:
        lines = [*self._header(gravity_line=False), self._counts(speeds)]
        for speed in speeds:
            for h, heading in enumerate(self.heading_deg):
                lines.append(f"{speed:.5f} {heading:.2f}")
                for k, omega in enumerate(self.omega):
                    lines.append(f"{omega:.4f} {0.1 * h} {0.2 * k} {speed + 0.3}")
        return lines


def rows(matrix: np.ndarray) -> list[str]:
    """A matrix as lines of numbers with all digits."""
    return [" ".join(repr(x) for x in row) for row in matrix.tolist()]
