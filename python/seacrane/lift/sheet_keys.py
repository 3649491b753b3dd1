"""Keys of [sheet]: phases, criteria, seas, the alpha factor, load cases, a forecast and a hindcast."""

from __future__ import annotations

from typing import Any

from seacrane.lift.inner_keys import CHANNEL_UNITS, LENGTH, LIFTS, NUMBER, ROW, TIME
from seacrane.lift.keys import Key, keys_of
from seacrane.operability.allowable import allowable_hs
from seacrane.operability.alpha import AlphaFactor
from seacrane.operability.availability import ScatterDiagram
from seacrane.operability.criterion import Criterion
from seacrane.operability.go import go_or_no_go
from seacrane.operability.hindcast import WaveHindcast
from seacrane.operability.phase import Phase
from seacrane.operability.phase_sheet import phase_sheet

LIMIT = NUMBER | {"unit": CHANNEL_UNITS}
CRITERION = keys_of(
    Criterion, more={"maximum": LIMIT, "minimum": LIMIT, "exposure": TIME, "names": {"type": "names"}}
)
PHASE = (
    *keys_of(Phase, more={"stages": {"type": "texts"}, "time": TIME}, without=("scene",)),
    Key("lift", "file", choices=LIFTS,
        text="Of a stationary phase: the lift whose scene it has; default: this one."),
)  # fmt: skip
ALPHA = keys_of(
    AlphaFactor,
    more={
        "values": {"type": "array", "shapes": ((-1, -1), ())},
        "hours": ROW, "hs": ROW | LENGTH,
    },
)  # fmt: skip
SERIES: dict[str, Any] = {"type": "file", "required": True, "text": "A NetCDF or CSV file of sea states."}
HEADING = Key("heading_deg", "number", text="Compass heading of the bow; default: the worst direction.")
READ = keys_of(
    WaveHindcast.load, more={"names": {"type": "names"}, "units": {"type": "names"}},
    only=("names", "units", "utc_offset"),
)  # fmt: skip
FORECAST = (
    Key("file", **SERIES),
    HEADING,
    *READ,
    *keys_of(
        go_or_no_go, more={"start": {"type": "text"}, "issued": {"type": "text"}}, only=("start", "issued")
    ),
)
HINDCAST = (Key("file", **SERIES), HEADING, *READ)
SCATTER = (
    Key("file", "file", required=True, text="A scatter table, of classes of Hs and of Tp."),
    *keys_of(ScatterDiagram.load, more={"units": {"type": "names"}}, only=("rows", "units", "classes")),
)  # fmt: skip
SEAS = {"tp": ROW | TIME, "direction_deg": ROW | {"unit": "deg"}, "hs": ROW | LENGTH}
SHEET = (
    Key("phase", "tables", keys=PHASE, required=True, text="In their order."),
    Key("criterion", "tables", keys=CRITERION, required=True, text="Of every phase, or of one by its stage."),
    *keys_of(phase_sheet, more=SEAS, only=("tp", "direction_deg", "hs", "lead_hours")),
    Key("seeds", "whole", text="How many, from 1 on; default 20.", bounds={"minimum": 3}),
    *keys_of(
        allowable_hs, more={"duration": TIME, "start_up": TIME},
        only=("domain", "linear_within", "until", "duration", "start_up"),
    ),
    Key("alpha", "table", keys=ALPHA, text="For the uncertainty of forecasts, with its source."),
    Key("cases", "values", text="Load cases: values by key of the lift, all combinations."),
    Key("forecast", "table", keys=FORECAST, text="Judged by the sheet: go or no go."),
    Key("hindcast", "table", keys=HINDCAST, text="Its weather windows, phases in series."),
    Key("scatter", "table", keys=SCATTER, text="Availability of each phase by it."),
)  # fmt: skip
