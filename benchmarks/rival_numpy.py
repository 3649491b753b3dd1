"""Benchmark rival: the plain NumPy/SciPy reference on the same scene, one process, one thread.

Reads a scene as JSON records (schema: `tests/reference/system.py`). Prints one line of JSON: settings,
counters, wall time, constraint errors. With --out it also writes the arrays as an .npz file.

    OMP_NUM_THREADS=1 python benchmarks/rival_numpy.py SCENE.json --t-end 100 --dt-out 0.1 --rtol 1e-6 --out
    run.npz
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from reference.simulate import simulate
from reference.system import System

METHODS = ("DOP853", "RK45", "RK23", "Radau", "BDF", "LSODA")


def arguments(argv: Sequence[str] | None) -> argparse.Namespace:
    """Parse the command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("scene", type=Path, help="JSON records")
    parser.add_argument("--t-end", type=float, default=100.0, help="s")
    parser.add_argument("--dt-out", type=float, default=0.1, help="s")
    parser.add_argument("--rtol", type=float, default=1e-6)
    parser.add_argument("--method", choices=METHODS, default="DOP853")
    parser.add_argument("--projection-interval", type=float, default=1.0, help="s")
    parser.add_argument("--out", type=Path, help=".npz file for the arrays")
    return parser.parse_args(argv)


def load_records(path: Path) -> dict[str, Any]:
    """Records from a JSON file."""
    try:
        records = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, json.JSONDecodeError) as error:
        raise ValueError(f"{path}: cannot be read as JSON records: {error}") from error
    if not isinstance(records, dict):
        raise ValueError(f"{path}: holds {type(records).__name__}, needs an object of records")
    return records


def output_times(t_end: float, dt_out: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    """0, dt, 2 dt, ... up to t_end."""
    if not (t_end > 0.0 and dt_out > 0.0):
        raise ValueError(f"t_end = {t_end} and dt_out = {dt_out} must be positive")
    count = int(np.floor(t_end / dt_out * (1.0 + 1e-12)))
    return np.asarray(np.minimum(dt_out * np.arange(count + 1), t_end), dtype=float)


def summary(result: dict[str, Any], settings: argparse.Namespace) -> dict[str, Any]:
    """What the benchmark table needs."""
    return {
        "scene": str(settings.scene),
        "method": settings.method,
        "rtol": settings.rtol,
        "simulated_s": settings.t_end,
        **result["stats"],
        "constraint_error": float(np.max(result["constraint_error"])),
        "constraint_error_before_projection": float(np.max(result["constraint_error_before_projection"])),
    }


def save(result: dict[str, Any], path: Path) -> None:
    """Write the arrays in one step, so that no reader sees half a file."""
    arrays: dict[str, Any] = {k: v for k, v in result.items() if isinstance(v, np.ndarray)}
    arrays |= {f"{kind}_names": np.array(names) for kind, names in result["names"].items() if names}
    handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".npz")
    try:
        with os.fdopen(handle, "wb") as file:
            np.savez(file, **arrays)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise


def main(argv: Sequence[str] | None = None) -> int:
    """Run and print; returns the exit status."""
    settings = arguments(argv)
    try:
        system = System.from_records(load_records(settings.scene))
        times = output_times(settings.t_end, settings.dt_out)
        result = simulate(
            system,
            settings.t_end,
            times,
            settings.rtol,
            method=settings.method,
            projection_interval=settings.projection_interval,
        )
    except (ValueError, KeyError, RuntimeError) as error:
        print(f"rival_numpy: {error}", file=sys.stderr)
        return 1
    if settings.out is not None:
        save(result, settings.out)
    print(json.dumps(summary(result, settings)))
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
