"""Panel problems, solved by Capytaine here or in processes of their own, one for each core.

Capytaine holds the interpreter for as long as a matrix takes, many seconds of 3000 panels. A process of its
own is waited for, and ended by Ctrl-C at once. Such processes begin by a command: those of `multiprocessing`
would run a user's script once more.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from io import BytesIO
from queue import SimpleQueue
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from seacrane.arrays import Array
from seacrane.errors import SceneError
from seacrane.hydro.hull.solution import import_capytaine

if TYPE_CHECKING:
    from subprocess import Popen

AXES = ("Surge", "Sway", "Heave")
INSTEAD = "give a TablePart with added masses from elsewhere"
FEW = 600  # panels that are solved here: no wait is long, and processes take seconds to begin
MOST_WORKERS = 8  # of 0.3 GB each, of the most panels
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


def added_mass(panels: Array, surface: float, omega: float) -> Array:
    """Added mass (3, 3) over density, m3, of panels (n, 3, 3), m, below a surface at a level, m.

    `surface` is 0, or infinity where there is none; `omega` is 0 or infinity, rad/s.
    """
    capytaine = import_capytaine("added mass of a mesh", INSTEAD)
    solver = _solver(capytaine)
    faces = np.arange(3 * len(panels)).reshape(-1, 3)[:, [0, 1, 2, 2]]
    mesh = capytaine.Mesh(vertices=panels.reshape(-1, 3), faces=faces)
    dofs = capytaine.rigid_body_dofs(only=AXES, rotation_center=(0.0, 0.0, 0.0))
    body = capytaine.FloatingBody(mesh=mesh, dofs=dofs)
    rows = []
    for axis in AXES:
        problem = capytaine.RadiationProblem(
            body=body, omega=omega, free_surface=surface, water_depth=np.inf, radiating_dof=axis, rho=1.0
        )
        masses = solver.solve(problem, method="direct", keep_details=False).added_masses
        rows.append([float(masses[one]) for one in AXES])
    return np.array(rows)


@cache
def _solver(capytaine: Any) -> Any:
    return capytaine.BEMSolver()


class PanelWorkers:
    """Solves the panel problems of something, of so many panels at most, while the block is open."""

    def __init__(self, what: str, most: int) -> None:
        self._what = what
        self._free: SimpleQueue[Popen[bytes]] = SimpleQueue()
        self._processes = [_begun() for _ in range(_cores() if most > FEW else 0)]
        for process in self._processes:
            self._free.put(process)
        self._threads = ThreadPoolExecutor(max(1, len(self._processes)))

    def __enter__(self) -> PanelWorkers:
        return self

    def __exit__(self, *_: object) -> None:
        for process in self._processes:
            process.kill()
        self._threads.shutdown(cancel_futures=True)
        for process in self._processes:
            process.communicate()

    def ask(self, panels: Array, surface: float, omega: float) -> Callable[[], Array]:
        """What waits for the `added_mass` of a problem, or finds it."""
        if not self._processes:
            return partial(added_mass, panels, surface, omega)
        return self._threads.submit(self._answer, panels=panels, surface=surface, omega=omega).result

    def _answer(self, **problem: Any) -> Array:
        process = self._free.get()
        try:
            assert process.stdin is not None and process.stdout is not None
            _send(process.stdin, **problem)
            answer = _taken(process.stdout)
        except (OSError, EOFError) as error:
            raise SceneError(
                f"{self._what}: the process that solves its panels ended, as where memory runs out; give "
                "fewer (panels=)"
            ) from error
        finally:
            self._free.put(process)
        if "error" in answer:
            raise SceneError(f"{self._what}: {answer['error']}")
        return answer["masses"]


def _cores() -> int:
    allowed = getattr(os, "sched_getaffinity", None)
    return min(len(allowed(0)) if allowed else os.cpu_count() or 1, MOST_WORKERS)


def _send(stream: IO[bytes], **arrays: Any) -> None:
    """Write arrays, after the length of their bytes."""
    held = BytesIO()
    np.savez(held, **arrays)
    stream.write(len(held.getvalue()).to_bytes(8, "little") + held.getvalue())
    stream.flush()


def _taken(stream: IO[bytes]) -> dict[str, Array]:
    """The arrays of one `_send`; EOFError where there is no more."""
    size = int.from_bytes(stream.read(8), "little")
    data = stream.read(size)
    if not size or len(data) < size:
        raise EOFError("no more problems, or answers")
    with np.load(BytesIO(data)) as arrays:
        return dict(arrays)


def _begun() -> Popen[bytes]:
    """A process that answers problems, out of reach of the terminal's Ctrl-C."""
    import subprocess  # with the first mesh of many panels, and where processes can be started

    places = os.pathsep.join(one for one in sys.path if one)
    environment = {**os.environ, "PYTHONPATH": places, **dict.fromkeys(THREADS, "1")}
    return subprocess.Popen(
        [sys.executable, "-m", __name__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment,
        start_new_session=True,
    )  # fmt: skip


def _serve() -> None:
    """Answer the problems that come in, until there are no more."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what libraries print is no answer
    while True:
        try:
            problem = _taken(sys.stdin.buffer)
        except EOFError:
            return
        try:
            found: dict[str, Any] = {
                "masses": added_mass(problem["panels"], float(problem["surface"]), float(problem["omega"]))
            }
        except Exception as error:
            found = {"error": f"{type(error).__name__}: {error}"}
        _send(answers, **found)


if __name__ == "__main__":
    _serve()
