"""What the page says beside shapes: in words, and stages, points, forces in wires, channels over time."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from seacrane.arrays import Array
from seacrane.description.description import Description
from seacrane.description.loads import lines_of
from seacrane.description.pick import Pick
from seacrane.description.wet_parts import wet_bodies
from seacrane.errors import SceneError
from seacrane.inputs.shown import shown
from seacrane.pictures.drawn_bodies import Look
from seacrane.pictures.pose_curves import Blob, Motion, linear_rows
from seacrane.pictures.wheels import end_of
from seacrane.result import Result
from seacrane.result.about import NOT_KEPT
from seacrane.result.contact_loads import contact_loads
from seacrane.result.history import wanted_traces
from seacrane.result.traces import Trace
from seacrane.scene.file import scene_digest

AXES = "x forward, y to port, z up, about the origin of the inertial frame; m, s"
REAL_WIRES = "as thick as steel ropes of their EA, EA = 40 GPa times the square of the diameter"
ESTIMATE = "error_estimate_"
FINENESS = 2.0**-14  # step of a force over its largest
MOST_LINES, MOST_PANELS, USUAL_PANELS = 6, 8, 4
LINE_FINENESS = 2.0**-13  # step of a line over its range
USUAL = (
    "link_tension", "line_tension", "roll", "heave", "wave_elevation", "limit_force", "stroke", "coordinate",
)  # fmt: skip


def caption(
    scene: Description, result: Result | None, motion: Motion, looks: Mapping[str, Look]
) -> list[tuple[str, str]]:
    """Rows of what and its words; rows without words are left out."""
    left_out = "" if result is None or result.scene is None else str(result.stats.get(NOT_KEPT, ""))
    rows = [("scene hash", scene_digest(scene)[:12]), ("left out", left_out), ("sea", _sea_words(scene))]
    seed = None if scene.waves is None else scene.waves.provenance.seed
    rows += [("seed", str(seed))] if seed is not None else []
    rows += _run_rows(result, motion) if result is not None else [("run", "none: the scene at its start")]
    rows += [("axes", AXES), ("drawn", _drawn(looks))]
    rows += [("real wires", REAL_WIRES)] if lines_of(scene.loads) else []
    return [(what, words) for what, words in rows if words]


def _run_rows(result: Result, motion: Motion) -> list[tuple[str, str]]:
    distance, angle = motion.error
    stopped = ", interrupted" if result.interrupted else ""
    run = f"{motion.start:g} to {motion.end:g} s{stopped}, seacrane {result.stats['seacrane_version']}"
    shown = (
        f"{1.0 / motion.interval:.3g} poses a second, cubic between them: within {1e3 * distance:.2g} mm "
        f"and {np.degrees(angle):.2g} deg of the run"
    )
    told = {"method": _method, "accuracy": _accuracy, "energy balance": _energy, "contacts": _contacts}
    return [("run", run), *((what, words(result)) for what, words in told.items()), ("shown", shown)]


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
    return "; ".join(
        f"{', '.join(names[:3])}{f' and {len(names) - 3} more' if len(names) > 3 else ''}: {note}"
        for note, names in by_note.items()
    )


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


def _sea_words(scene: Description) -> str:
    """The sea in words, for the caption."""
    if scene.waves is None:
        return "" if without_sea(scene) else "calm water"
    known = scene.waves.provenance
    told = ((known.realised_hs, "Hs {:.2f} m realised"), (known.tp, "Tp {:g} s"),
            (known.wave_direction_deg, "towards {:g} deg from x to y"))  # fmt: skip
    words = [text.format(value) for value, text in told if value is not None]
    return ", ".join([f"{np.size(scene.waves.omega)} wave components", *words])


def marks_of(scene: Description, result: Result | None, bodies: Sequence[str]) -> dict[str, Any]:
    """Stages as name, start and end (s); points and boxes as ends of wires, sizes in m."""
    stages = [] if result is None else [[span.name, span.start, span.end] for span in result.stages]
    points = {
        name: end_of(scene, bodies, one.body, one.point)
        for name, one in scene.points.items() if one.body in scene.bodies
    }  # fmt: skip
    clearances = [
        {"name": name, "points": [points[point] for point in one.points if point in points],
         "at": end_of(scene, bodies, one.body, one.center), "size": list(one.size)}
        for name, one in scene.clearances.items()
    ]  # fmt: skip
    named = [{"name": name, "at": at} for name, at in points.items()]
    return {"stages": stages, "points": named, "clearances": [one for one in clearances if one["points"]]}


def forces_of(
    result: Result | None, wires: Sequence[Mapping[str, Any]], motion: Motion, blob: Blob
) -> dict[str, Any]:
    """Tension of lines and links over the frames, N, by element; of those that were recorded."""
    if result is None:
        return {}
    found = {}
    for element in dict.fromkeys(wire["element"] for wire in wires):
        values = _tension(result, element)
        if values is not None and np.isfinite(values).all() and np.any(values):
            step = float(np.abs(values).max()) * FINENESS
            found[element] = blob.series(linear_rows(motion, result.time, values[:, None]), step)
    return found


def _tension(result: Result, element: str) -> Array | None:
    if element in result.coords.get("line", ()) and "line_tension" in result.channels:
        return result.select("line_tension", line=element)
    if element in result.coords.get("joint", ()) and "reaction_force" in result.channels:
        return np.asarray(np.linalg.norm(result.select("reaction_force", joint=element), axis=1))
    return None


def strip_of(
    result: Result | None, channels: Sequence[str | Pick] | None, motion: Motion, blob: Blob
) -> list[dict[str, Any]]:
    """Panels of the strip: title, unit, lines over the frames, and their least and largest values between.

    Raises SceneError for a channel or a name that the result does not hold, or too many lines or panels.
    """
    if result is None:
        if channels:
            raise SceneError("view: channels is given for a scene that has not run; give its result")
        return []
    if channels is None:
        usual = (choice for choice in USUAL if _held(result, choice))
        return [_panel(result, choice, motion, blob) for choice in itertools.islice(usual, USUAL_PANELS)]
    if isinstance(channels, str) or not isinstance(channels, Sequence) or len(channels) > MOST_PANELS:
        raise SceneError(
            f"view: channels is {shown(channels)}; give a list of at most {MOST_PANELS}, such as "
            "['link_tension', 'vessel_motion[roll]']"
        )
    return [_panel(result, choice, motion, blob) for choice in channels]


def _held(result: Result, choice: str) -> bool:
    try:
        return len(_lines(result, choice)) <= MOST_LINES
    except SceneError:
        return False


def _lines(result: Result, choice: str | Pick) -> list[Trace]:
    return next(iter(wanted_traces(result, [choice], {}).values()))


def _panel(result: Result, choice: str | Pick, motion: Motion, blob: Blob) -> dict[str, Any]:
    lines = _lines(result, choice)
    if len(lines) > MOST_LINES:
        names = ", ".join(one.label for one in lines[:12])
        raise SceneError(
            f"view: {choice} has {len(lines)} lines, a panel shows {MOST_LINES}; pick among {names}, such as "
            f"'{lines[0].channel}[{lines[0].names[0]}]'"
        )
    rows = linear_rows(motion, result.time, np.array([one.values for one in lines]).T)
    least, largest = rows.copy(), rows.copy()  # since the frame before, with those of the frames
    at = np.ceil((result.time - motion.start) / motion.interval - 1e-6)
    frame = np.clip(at, 0, rows.shape[1] - 1).astype(int)
    for i, one in enumerate(lines):
        for row, bound, extreme in ((least[i], one.least, np.fmin), (largest[i], one.largest, np.fmax)):
            good = np.isfinite(bound)
            extreme.at(row, frame[good], bound[good])
    low, high = float(least.min()), float(largest.max())
    step = max((high - low) * LINE_FINENESS, 1e-12)
    alone = len(lines) == 1
    return {
        "title": lines[0].title if alone else str(choice).replace("_", " "),
        "unit": ", ".join(dict.fromkeys(one.unit for one in lines)),
        "labels": ["" if alone else one.label for one in lines], "low": low, "high": high,
        "values": blob.series(rows, step), "bounds": blob.series(np.concatenate([least, largest]), step),
    }  # fmt: skip
