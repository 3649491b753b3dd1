"""A sea and its loads on the vessels of a scene."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, Literal

import numpy as np

from seacrane.description.databases import database_of, source_of
from seacrane.description.description import Description
from seacrane.description.given import given_vessels
from seacrane.description.vessel_hydrodynamics import Source
from seacrane.description.waves import STRETCHING, HullLoads, Waves, flowing_water
from seacrane.errors import SceneError
from seacrane.hydro.data.long_waves import warn_of_long_waves
from seacrane.inputs.alike import alike
from seacrane.inputs.caller import tell
from seacrane.inputs.checked import flag_of, number_of, shaped_of, text_of
from seacrane.inputs.frames import heading_of
from seacrane.inputs.plausible import direction_of
from seacrane.inputs.read_only import ReadOnly
from seacrane.inputs.shown import shown
from seacrane.scene.realised_sea import COMPONENTS, realised_sea
from seacrane.scene.sea_loads import slow_below, with_actual_position, with_drift, with_shares
from seacrane.scene.vessel import force_of_components, put_into_sea
from seacrane.sea import Current, SeaState, Spreading
from seacrane.sea.dispersion import wavenumber

MOST_COMPONENTS = 50_000  # whose loads take some seconds to make; 30 hours do not repeat with as many
LEAST_DIFFERENCE = 0.01  # of a wavenumber, between the depths of a sea and of a database


def add_sea(
    scene: Description, *, vessel: str | None = "vessel", hs: float | None = None, tp: float | None = None,
    gamma: float | Literal["dnv"] | None = None, spectrum: str | None = None,
    direction_deg: float | None = None, spreading: float | Spreading | None = None, seed: int | None = None,
    count: int | None = None, sea: SeaState | None = None, position: Any = None,
    heading_deg: float | None = None, relative_bound: float | None = None, evaluation: str | None = None,
    phase: Literal["mean", "slow", "actual"] = "mean", cutoff: float | None = None, drift: bool = False,
    current: Current | None = None, stretching: str | None = None,
) -> Waves | None:  # fmt: skip
    """Add a sea and its force-RAO loads on a vessel, or put one more vessel into the sea that is there.

    A scene has one sea, with phases from the origin of the inertial frame. For every further vessel call it
    again, with the same sea or without any argument of it; a vessel that is in it is put there anew. The
    forces are those of the vessel's database, at the direction of every component. A ship whose
    motion is given takes no load: one that follows RAOs begins to move by them.

    Parameters
    ----------
    vessel : str or None
        Body of the vessel. None puts no vessel into it: a sea for what looks at it by itself.
    hs : float
        Significant wave height, m; needed but with `sea`, or for one more vessel. 0 leaves the sea out; with
        a current it is still water that flows.
    tp : float
        Peak period, s; default 8.
    gamma : float or "dnv"
        Peak enhancement of JONSWAP, 1 to 7 (3.3), or by DNV-RP-C205.
    spectrum : str
        "jonswap" (default), "pierson-moskowitz" or "torsethaugen".
    direction_deg : float
        Mean direction of travel, deg from +x (following sea) towards +y (port); default 135.
    spreading : float or Spreading
        Short-crested sea: s of cos^(2 s)(angle / 2), or `seacrane.sea.cos_n(...)`; default: long-crested.
    seed, count : int
        Of the realisation (1, 200 components); see `seacrane.sea.realise_waves`.
    sea : SeaState
        In place of all of these from hs on: any spectra, several wave systems, measured waves.
    position : array_like, shape (2,)
        Where the vessel's loads are taken, (x, y), m, inertial frame; default: where its body starts.
    heading_deg : float
        At which heading, deg from +x towards +y; default: that of its body at the start.
    relative_bound : float
        Error bound of the load table over the sum of component magnitudes (1e-9).
    evaluation : str
        "table" (default) or "exact"; see `Waves`.
    phase : str
        "mean": loads at that position and heading. "actual": at those of the moment: a vessel under way meets
        the encounter frequency. "slow": at the slow part of those of the moment, since a motion in the waves
        would count a second time. The last two sum all components in every evaluation.
    cutoff : float
        With "slow", below which frequency a motion is slow, rad/s; default: a fifth of that of the peak.
    drift : bool
        Adds Newman's slowly varying drift by the database's mean coefficients; components beyond their
        frequencies take those of the nearest.
    current : Current, optional
        The current of the scene, a profile over depth. Waves travel on it, with the frequencies that a fixed
        observer sees; `sea_at`, lines in the sea and `add_current` read it.
    stretching : str
        How moving points see waves above and below the still water: "wheeler" (default) or "none", see
        `sea_at`.

    The sea is as deep as the database, or as `sea` says. It keeps all its components: loads at frequencies
    that the database does not hold follow from `HydroDatabase.force_at` with ``outside="limits"``.

    Returns
    -------
    Waves or None
        `scene.waves`; None for an hs of 0. A period, direction or gamma that is not given is told on the
        terminal.

    Raises
    ------
    SceneError
        For a sea without hs, a value out of range, `sea` beside what it replaces, a second sea, a vessel that
        is not there, or
        a sea whose waves have another length at its depth than at the database's.

    Warns
    -----
    SteepSeaWarning
        A sea steeper than any that stands.
    OutsideRaosWarning
        More than 2 % of the energy of the waves is outside the frequencies of a table of RAOs.
    WavesWithoutLoadWarning
        More than 2 % of the variance of a load is that of waves above the database's frequencies.
    RaoPhaseWarning
        A hull that follows the database's longest wave by its amplitudes, and is out of phase with it.
    BelowBandWarning
        More than 10 % of the energy of the waves is below the database's trusted band.
    BlockedWavesWarning
        Waves that the current stops are left out.
    """
    arguments = {"hs": hs, "tp": tp, "gamma": gamma, "spectrum": spectrum, "direction_deg": direction_deg,
                 "spreading": spreading, "seed": seed, "count": count}  # fmt: skip
    given = {name: value for name, value in arguments.items() if value is not None}
    if vessel is not None:
        text_of("sea: vessel", vessel)
    if text_of("sea: phase", phase) not in ("mean", "slow", "actual"):
        raise SceneError.of("sea: phase", f"is {phase!r}; choose 'mean', 'slow' or 'actual'")
    flag_of("sea: drift", drift)
    if cutoff is not None and phase != "slow":
        raise SceneError.of(
            "sea: cutoff", f"is {shown(cutoff)} and phase {phase!r}; it belongs to phase='slow'"
        )
    if current is not None and not isinstance(current, Current):
        raise SceneError.of("sea: current", f"is {shown(current)}; give a seacrane.sea.Current")
    if sea is not None and given:
        raise SceneError(f"sea: given beside {', '.join(given)}; put these into the SeaState")
    new = sea is None and (given or scene.waves is None)
    if new and hs is None:
        raise SceneError.of(
            "sea: hs",
            "is None; give the significant wave height in m (0: still water), or sea=SeaState(...); "
            "leave out all that describes a sea to put a vessel into the one that is there",
        )
    if new and number_of("sea: hs", hs) == 0.0:
        depth = float("inf") if vessel not in scene.bodies else _depth_of(source_of(scene, str(vessel)))
        scene.waves = None if current is None else flowing_water(current, depth, stretching or STRETCHING[0])
        return scene.waves
    if vessel is not None and vessel not in scene.bodies:
        known = ", ".join(repr(one.body) for one in scene.vessels.values()) or "none"
        raise SceneError(
            f"sea: there is no vessel {vessel!r}, the scene has {known}; name one by vessel=, or add it"
        )
    if scene.waves is None and sea is None:
        _tell_assumed(given)
    database = None if vessel is None else source_of(scene, vessel)
    waves = _evaluated(
        _sea_of(scene, database, vessel, sea, given, current), relative_bound=relative_bound,
        evaluation=evaluation, stretching=stretching,
    )  # fmt: skip
    if vessel is None:
        scene.waves = waves
        return waves
    place, heading = _pose(scene, vessel, position, heading_deg)
    scene.waves = put(
        scene, waves, vessel=vessel, position=place, heading=heading, phase=phase, cutoff=cutoff, drift=drift
    )
    return scene.waves


def put(
    scene: Description, waves: Waves, *, vessel: str, position: tuple[float, float], heading: float,
    phase: str, cutoff: float | None, drift: bool,
) -> Waves:  # fmt: skip
    """The sea with a vessel of the scene in it, as `add_sea` puts it; one that follows RAOs is set moving."""
    source = source_of(scene, vessel)
    if source is not None:
        require_depth(waves, source, vessel)
    if vessel in given_vessels(scene):
        if drift or phase != "mean":
            raise SceneError(
                f"sea: vessel {vessel!r} has a given motion, no loads; leave out drift and phase"
            )
        return put_into_sea(scene, waves, vessel=vessel, place=position, heading=heading)
    database = database_of(scene, vessel, "a sea")
    warn_of_long_waves(database)
    transfer = force_of_components(database, waves.omega, waves.direction - heading)
    hull = HullLoads(transfer=transfer, position=position, heading=heading)
    provenance = with_shares(waves, database, vessel, hull)
    waves = alike(waves, hulls=ReadOnly({**waves.hulls, vessel: hull}), provenance=provenance)
    if drift:
        waves = with_drift(scene, waves, vessel)
    if phase != "mean":
        slow = slow_below(waves, cutoff) if phase == "slow" else 0.0
        waves = with_actual_position(scene, waves, vessel, slow)
    return waves


def as_put(scene: Description, waves: Waves, vessel: str) -> dict[str, Any]:
    """The words of `add_sea` that put a vessel into a sea as it is in it."""
    hull = waves.hulls[vessel]
    as_at_start = hull.heading == heading_of(scene.bodies[vessel].quaternion)
    return {
        "vessel": vessel, "position": hull.position, "phase": hull.phase, "cutoff": own_cutoff(waves, hull),
        "heading_deg": None if as_at_start else float(np.degrees(hull.heading)),
        "drift": hull.drift is not None,
    }  # fmt: skip


def own_cutoff(waves: Waves, hull: HullLoads) -> float | None:
    """The cut-off that a hull was given; None where it is that of its sea."""
    return None if not hull.cutoff or hull.cutoff == slow_below(waves, None) else hull.cutoff


def _tell_assumed(given: dict[str, Any]) -> None:
    """The period and the direction of a sea that was given without, and with the latter the peakedness."""
    assumed = [] if "tp" in given else ["tp=8"]
    from_where = ""
    if "direction_deg" not in given:
        peaked = given.get("spectrum", "jonswap") == "jonswap" and "gamma" not in given
        assumed += ["direction_deg=135", *(["gamma=3.3"] if peaked else [])]
        from_where = " (135 deg: from the starboard bow)"
    if assumed:
        tell(f"sea: {' and '.join(assumed)} assumed{from_where}")


def _sea_of(
    scene: Description, database: Source | None, vessel: str | None, sea: SeaState | None,
    given: dict[str, Any], current: Current | None,
) -> Waves:  # fmt: skip
    """The sea asked for; in a scene that has a sea, that one, if it is no other."""
    there = scene.waves
    if there is not None and current is not None and current != there.current:
        raise SceneError(
            "sea: a scene has one current, which is given with its sea; leave current out, or set "
            "scene.waves = None before a new sea"
        )
    if there is not None and sea is None and not given:
        return there
    depth = _depth_of(database)
    _require_few(sea, given)
    asked = realised_sea(
        sea, given, depth if there is None else there.depth,
        current=current if there is None else there.current,
    )  # fmt: skip
    if there is None:
        return asked
    alike = (np.array_equal(getattr(there, key), getattr(asked, key)) for key in (*COMPONENTS, "depth"))
    if not all(alike):
        raise SceneError(
            f"sea: vessel {vessel!r} is given another sea than {', '.join(map(repr, there.hulls))} has, and "
            "a scene has one; leave out what describes it to put the vessel into that sea, put several wave "
            "systems into one SeaState, or set scene.waves = None before a new sea"
        )
    return there


def _depth_of(database: Source | None) -> float:
    return float("inf") if database is None else database.depth


def _require_few(sea: SeaState | None, given: dict[str, Any]) -> None:
    """Refuse more components than loads are made of in some seconds, which nothing would stop."""
    counts = [one.count for one in sea.systems] if isinstance(sea, SeaState) else [given.get("count", 1)]
    count = sum(one for one in counts if isinstance(one, int | np.integer))
    if count > MOST_COMPONENTS:
        raise SceneError.of(
            "sea: count",
            f"is {count:,}, components whose loads would take minutes to make; give at most "
            f"{MOST_COMPONENTS:,}: with 5,000 three hours do not repeat",
        )


def _evaluated(waves: Waves, **given: Any) -> Waves:
    """With the settings given; vessels of one sea share them."""
    given = {name: value for name, value in given.items() if value is not None}
    for name, value in given.items():
        checked = number_of if name == "relative_bound" else text_of
        checked(f"sea: {name}", value)
        if waves.hulls and value != getattr(waves, name):
            raise SceneError.of(
                f"sea: {name}",
                f"is {value!r}, that of {', '.join(map(repr, waves.hulls))} is "
                f"{getattr(waves, name)!r}; vessels in one sea share it, leave it out",
            )
    return replace(waves, **given) if given else waves


def _pose(
    scene: Description, vessel: str, position: Any, heading_deg: float | None
) -> tuple[tuple[float, float], float]:
    """Where a vessel's loads are taken: (x, y) and heading, as its body starts where they are not given."""
    body = scene.bodies[vessel]
    x, y = body.position[:2] if position is None else shaped_of("sea: position", position, (2,))
    heading = heading_of(body.quaternion)
    if heading_deg is not None:
        heading = float(np.radians(direction_of("sea: heading_deg", heading_deg)))
    if not np.isfinite([x, y, heading]).all():
        raise SceneError(
            f"sea: loads of {vessel!r} are taken at x, y, heading {x}, {y}, {heading}; give finite ones"
        )
    return (float(x), float(y)), heading


def require_depth(waves: Waves, database: Source, vessel: str) -> None:
    """Refuse a database computed at a depth where the waves of a sea have another length than in that sea."""
    if waves.depth == database.depth:
        return
    there, computed = (
        wavenumber(waves.omega, g=database.g, depth=depth) for depth in (waves.depth, database.depth)
    )
    difference = float(np.max(np.abs(there / computed - 1.0)))
    if difference > LEAST_DIFFERENCE:
        raise SceneError.of(
            f"sea of vessel {vessel!r}: it",
            f"is {waves.depth:g} m deep, the forces of database "
            f"{database.name!r} are for {database.depth:g} m, and wavenumbers differ by up to "
            f"{difference:.0%}; take SeaState(depth={database.depth:g}), or a database of the sea's depth",
        )
