"""What the page says in words: which scene, which run, how accurate, what is drawn and what is made up."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from seacrane.description.description import Description
from seacrane.description.loads import lines_of
from seacrane.description.wet_parts import wet_bodies
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.pose_curves import Motion
from seacrane.result import Result
from seacrane.result.contact_loads import contact_loads
from seacrane.result.kept_scene import NOT_KEPT
from seacrane.scene.file import scene_digest

AXES = "x forward, y to port, z up, about the origin of the inertial frame; m, s"
REAL_WIRES = "as thick as steel ropes of their EA, EA = 40 GPa times the square of the diameter"
ESTIMATE = "error_estimate_"
Array = NDArray[np.float64]


def caption(
    scene: Description, result: Result | None, motion: Motion, looks: Mapping[str, Look]
) -> list[tuple[str, str]]:
    """Rows of what and its words; rows without words are left out."""
    rows = [
        ("scene hash", scene_digest(scene)[:12]),
        ("left out", _left_out(result)),
        ("sea", sea_words(scene)),
    ]
    seed = None if scene.waves is None else scene.waves.provenance.seed
    rows += [("seed", str(seed))] if seed is not None else []
    rows += _run_rows(result, motion) if result is not None else [("run", "none: the scene at its start")]
    rows += [("axes", AXES), ("drawn", _drawn(looks))]
    rows += [("real wires", REAL_WIRES)] if lines_of(scene.loads) else []
    return [(what, words) for what, words in rows if words]


def _left_out(result: Result | None) -> str:
    """What of the scene its file does not hold."""
    return "" if result is None or result.scene is None else str(result.stats.get(NOT_KEPT, ""))


def _run_rows(result: Result, motion: Motion) -> list[tuple[str, str]]:
    distance, angle = motion.error
    stopped = ", interrupted" if result.interrupted else ""
    return [
        (
            "run",
            f"{motion.start:g} to {motion.end:g} s{stopped}, seacrane {result.stats['seacrane_version']}",
        ),
        ("method", _method(result)),
        ("accuracy", _accuracy(result)),
        ("energy balance", _energy(result)),
        ("contacts", _contacts(result)),
        (
            "shown",
            f"{1.0 / motion.interval:.3g} poses a second, cubic between them: within {1e3 * distance:.2g} mm "
            f"and {np.degrees(angle):.2g} deg of the run",
        ),
    ]


def _method(result: Result) -> str:
    settings = result.settings
    words = [str(result.stats["integrator"]), str(result.stats["formulation"])]
    for key, name, unit in (("rtol", "tolerance", ""), ("dt", "step", " s")):
        if settings.get(key) is not None:
            words.append(f"{name} {settings[key]:g}{unit}")
    return ", ".join(words)


def _accuracy(result: Result) -> str:
    """Estimated errors by quantity, and the joints' residual."""
    words = [
        f"{name.removeprefix(ESTIMATE).replace('_', ' ')}: estimated error {float(value):.2g}"
        for name, value in result.stats.items()
        if name.startswith(ESTIMATE) and not isinstance(value, str)
    ]
    if "constraint_error" in result.channels and int(result.stats["constraints"]) > 0:
        words.append(f"joints closed to {_largest(result, 'constraint_error'):.2g} m or rad")
    return ", ".join(words)


def _energy(result: Result) -> str:
    if not {"energy_balance", "absolute_work"} <= set(result.channels):
        return ""
    balance, work = _largest(result, "energy_balance"), _largest(result, "absolute_work")
    share = f", {balance / work:.2g} of the absolute work {work:.3g} J" if work > 0.0 else ""
    return f"closes to {balance:.2g} J{share}"


def _contacts(result: Result) -> str:
    """How hard and how fast each was hit."""
    return "; ".join(
        f"{one.name}: {one.peak / 1e3:.1f} kN at most, {one.speed:.3g} m/s, {one.rehits} re-hits"
        for one in contact_loads(result)
    )


def _largest(result: Result, channel: str) -> float:
    values = np.abs(result[channel])
    return float(values[np.isfinite(values)].max(initial=0.0))


def _drawn(looks: Mapping[str, Look]) -> str:
    """Which shapes stand for something, by what they are."""
    by_note: dict[str, list[str]] = {}
    for name, look in looks.items():
        if look.note:
            by_note.setdefault(look.note, []).append(name)
    return "; ".join(f"{_few(names)}: {note}" for note, names in by_note.items())


def _few(names: list[str]) -> str:
    return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")


def sea_components(scene: Description) -> Array:
    """Amplitude (m), frequency (rad/s), phase (rad), wavenumber along x and along y (rad/m): (n, 5).

    Elevation = sum a cos(w t + phase - kx x - ky y) in the inertial frame; largest amplitude first.
    """
    if scene.waves is None:
        return np.zeros((0, 5))
    waves = scene.waves.components()
    k, b = np.asarray(waves.wavenumber), np.asarray(waves.direction)
    phase = np.remainder(np.asarray(waves.phase), 2.0 * np.pi)
    table = np.column_stack([waves.amplitude, waves.omega, phase, k * np.cos(b), k * np.sin(b)])
    return np.asarray(table[np.argsort(-np.asarray(waves.amplitude), kind="stable")])


def without_sea(scene: Description) -> bool:
    """Whether there is no water to draw."""
    return scene.waves is None and not scene.vessels and not wet_bodies(scene)


def sea_words(scene: Description) -> str:
    """The sea in words, for the caption."""
    if scene.waves is None:
        return "" if without_sea(scene) else "calm water"
    known = scene.waves.provenance
    told = (
        (known.realised_hs, "Hs {:.2f} m realised"),
        (known.tp, "Tp {:g} s"),
        (known.wave_direction_deg, "towards {:g} deg from x to y"),
    )
    words = [text.format(value) for value, text in told if value is not None]
    return ", ".join([f"{np.size(scene.waves.omega)} wave components", *words])
