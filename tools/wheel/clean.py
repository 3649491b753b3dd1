"""An environment with the wheel, what it asks for, and nothing else: no compiler, no variable of a shell."""

from __future__ import annotations

import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Clean:
    """A virtual environment whose programs see its own commands only.

    Attributes
    ----------
    folder : Path
    """

    folder: Path

    @classmethod
    def with_wheel(cls, wheel: Path, folder: Path) -> Clean:
        """A new environment in `folder` with the wheel; nothing is compiled for it."""
        subprocess.run([sys.executable, "-m", "venv", "--clear", folder], check=True)
        clean = cls(folder)
        clean.run("python", "-m", "pip", "install", "-q", "--only-binary", ":all:", str(wheel), reach=True)
        return clean

    def run(self, *command: str, reach: bool = False) -> str:
        """Standard output of one of the environment's commands; `reach` hands on settings of pip and proxies.

        Raises
        ------
        SystemExit
            The command failed; what it said is printed.
        """
        commands = self.folder / "bin"
        environment = {
            "PATH": str(commands),
            "HOME": str(self.folder),
            "LANG": "C.UTF-8",
            "MPLBACKEND": "Agg",
        }
        if reach:
            environment |= {name: value for name, value in os.environ.items() if _reaches(name)}
        program = [str(commands / command[0]), *command[1:]]
        done = subprocess.run(program, cwd=self.folder, env=environment, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"{done.stdout}{done.stderr}{' '.join(command)}: exit code {done.returncode}")
        return done.stdout


def _reaches(name: str) -> bool:
    return name == "HOME" or name.startswith(("PIP_", "SSL_CERT")) or name.lower().endswith("_proxy")
