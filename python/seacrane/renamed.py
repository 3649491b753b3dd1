"""Names of 0.1 and 0.2 that are called otherwise since 0.3; 1.0 drops this module.

Scripts are refused with the new name in the message. Lift and study files with ``version = 1`` are read, with
one warning that lists their old keys and the new ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from typing import Any, TypeVar

# A new name with spaces is a sentence: what to write instead.
# Keywords, by the function or class that takes them; of a method that is defined in a class, "Class.method".
# What was given by its place has the name BY_PLACE.
BY_PLACE = "by place"
KEPT = "the scene keeps the database of each vessel since it was added; leave it out"
MOTION = "name the motion, such as 'position[load, z]' or 'acceleration[load, z]'"
SETTINGS = {"max_step": "maximum_step"}  # of a run, by `simulate` and all that take its words
BOUNDS = {"max": "maximum", "min": "minimum"}
PASSED = {"above": "minimum", "below": "maximum"}
BAND = {"omega_min": "minimum_omega", "omega_max": "maximum_omega"}
KEYWORDS: dict[str, dict[str, str]] = {
    "Method": {"tolerance": "rtol", "step": "dt", **SETTINGS},
    "Outputs": {"dt": "dt_out"},
    "Kept": {"at": "names", "step": "interval"},
    "Criterion": {"where": "names"},
    "add_limit_state": {"where": "names", **BOUNDS},
    "Until.channel": PASSED,
    "Until.tension": PASSED,
    "Until.length": PASSED,
    "extremes": {"start": "after"},
    "motion_rao": {"heading": "direction"},
    "response_statistics": {"heading": "direction"},
    "hydro_from_hull": {"centre_of_gravity": "center_of_gravity"},
    "record_extremes": {"dt": "interval"},
    "spectrum_estimate": {"dt": "interval"},
    "add_ballast": {"body": "vessel"},
    "add_slack_tank": {"body": "vessel"},
    "plot_spectrum": {"start": "after"},
    "summary": {"start": "after", "end": "before"},
    "Stage": {"longest": "maximum_duration"},
    "WaveSystem": BAND,
    "MeasuredWaves": BAND,
    "add_line": {"stiffness": "EA", "stretch": "rung"},
    "add_bridle": {"stiffnesses": "EA", "stretch": "rung"},
    "Line": {"stiffness": "EA", "stretch": "rung"},
    "LuffingRope": {"stiffness": "EA"},
    "add_crane": {"theta": "slew"},
    **{name: {"database": KEPT, BY_PLACE: KEPT} for name in (
        "add_sea", "add_drift", "use_actual_position", "use_slow_position",
    )},
    **{name: {"database": KEPT} for name in (
        "ensemble", "allowable_hs", "trade", "model_error",
    )},
    "plot_rao": {"database": KEPT, "headings_deg": "directions_deg"},
    "HookLoadControl": {"database": KEPT, "dt": "dt_out"},
    "LinearControl": {
        "database": KEPT, "dt": "dt_out", **dict.fromkeys(("body", "axis", "derivative"), MOTION),
    },
}  # fmt: skip
# Methods of `Scene`.
METHODS: dict[str, str] = {
    "add_wire": "write add_line(joint=..., rung='rigid')",
    "add_heavy_line": "write add_line(..., rung='with mass'), with EA, segment_rung for stiffness, stretch",
}
# Public names of the package, by their new address from `seacrane` on, such as "analysis.jacobian".
NAMES: dict[str, str] = {
    "plot_history": "Result.plot",
    "still": "view",
    "video": "view",
}

# Tables of lift files: the new table, and keys that say there what the old name said.
LIFT_TABLES: dict[str, tuple[str, dict[str, Any]]] = {
    "wire": ("line", {"rung": "rigid"}),
    "heavy_line": ("line", {"rung": "with mass"}),
}
# Keys of lift and study files without their units, by table, such as "limit_state" or "stage.until".
LIFT_KEYS: dict[str, dict[str, str]] = {
    "line": {"stiffness": "EA", "stretch": "rung"},
    "heavy_line": {"stiffness": "EA", "stretch": "segment_rung"},
    "bridle": {"stiffnesses": "EA", "stretch": "rung"},
    "method": {"tolerance": "rtol", "step": "dt", **SETTINGS},
    "outputs": {"dt": "dt_out"},
    "limit_state": {"where": "names", **BOUNDS},
    "stage": {"longest": "maximum_duration"},
    "stage.until": {"where": "names", **PASSED},
    "sea.systems": BAND,
    "crane": {"theta": "slew"},
    "control.tuned_at": {"theta": "slew"},
    **{table: {"body": "vessel"} for table in ("balance", "ballast", "slack_tank")},
}
# Quantities of `accuracy` and `trade`, in scripts and in [accuracy] of a study.
QUANTITIES = {"hook_tension": "hook_load"}
STUDY_KEYS: dict[str, dict[str, str]] = {"keep": {"at": "names", "step": "interval"}}
# What leaving a key out meant in files of version 1, by table, where it means something else now.
LIFT_DEFAULTS: dict[str, dict[str, Any]] = {"crane": {"held": False}}

Call = TypeVar("Call", bound=Callable[..., Any])


def refusing(call: Call) -> Call:
    """The function or class, which refuses its keywords of `KEYWORDS` by their new names."""
    name = call.__qualname__
    older = KEYWORDS[name]
    inner: Any = call.__init__ if isinstance(call, type) else call  # type: ignore[misc]
    places = inner.__code__.co_argcount

    @wraps(inner)
    def checked(*args: Any, **given: Any) -> Any:
        if len(args) > places and BY_PLACE in older:
            raise TypeError(f"{name}() takes no {type(args[places]).__name__} since 0.3; {older[BY_PLACE]}")
        for keyword in given.keys() & older.keys():
            raise TypeError(f"{name}() has no keyword {keyword!r} since 0.3; {instead(older[keyword])}")
        return inner(*args, **given)

    if not isinstance(call, type):
        return checked  # type: ignore[return-value]
    call.__init__ = checked  # type: ignore[misc]
    return call


def instead(new: str) -> str:
    """What a message says of a new name."""
    return new if " " in new else f"it is {new!r}"


def new_spelling(
    older: Mapping[str, Mapping[str, str]], table: str, spelling: str, known: Iterable[str]
) -> str | None:
    """The key that an old one, with its unit, is in a table now; None where it is no old one."""
    names = older.get(table, {})
    found = (new + spelling[len(old) :] for old, new in names.items() if spelling.startswith(old))
    return next((new for new in found if new in known), None)
