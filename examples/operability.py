"""In which seas a lift may go ahead, how often that is, and how long one waits for it.

Usage: python operability.py [FOLDER FOR A PICTURE]
"""

import sys
from pathlib import Path

import numpy as np

from seacrane import Criterion, allowable_hs, availability, cases, weather_windows  # fmt: skip
from seacrane.crane import Payload
from seacrane.operability import AlphaFactor, ScatterDiagram, WaveHindcast  # fmt: skip
from seacrane.pictures import plot_allowable_hs  # fmt: skip

WEIGHT = 10e3 * 9.80665  # N

# Case 2's crane, swung out, its payload 25 m below the tip; guide lines brake the swing.
scene = cases.case2(payload=Payload(link_length=25.0))
body, tip = scene.roles[""].tip
scene.add_spring(name="guide lines", first=body, second="payload", first_point=tip, damping_ratio=0.03)

table = allowable_hs(
    scene,
    criteria=[
        Criterion(channel="hook_load", maximum=1.15 * WEIGHT),
        Criterion(channel="tip_velocity", names={"axis": "z"}, maximum=0.8),
        Criterion(
            channel="position", names={"body": "payload", "axis": "y"}, maximum=3.0, motion=True,
            statistic="significant", name="swing athwart",
        ),
    ],
    tp=[6.0, 9.0, 12.0],
    direction_deg=[90.0, 135.0, 180.0],
    hs=[0.5, 1.0, 1.5, 2.0],
    seeds=[1, 2, 3, 4],
    duration=300.0,  # short, for an example: 1800 s and ten seeds tell more
    start_up=100.0,
    rtol=1e-4,
    time=50.0,
    alpha=AlphaFactor(values=0.8, source="made up for this example; take that of your standard"),
    hours=12.0,
)  # fmt: skip
print(table)
for cell in table.dataset["reason"].to_numpy().ravel()[:3]:
    print(f"  {cell}")

# Three years of made-up seas, hour by hour; WaveHindcast.load reads yours from NetCDF or CSV.
random = np.random.default_rng(1)
hours, drift = np.arange(3 * 8766), np.zeros(3 * 8766)
for hour in hours[1:]:
    drift[hour] = 0.98 * drift[hour - 1] + 0.2 * random.normal()
hs = 1.1 * (1.0 + 0.4 * np.cos(2.0 * np.pi * hours / 8766.0)) * np.exp(0.45 * drift)
hindcast = WaveHindcast(
    time=np.datetime64("2021-01-01T00") + hours * np.timedelta64(1, "h"),
    hs=hs, tp=np.clip(5.0 + 2.0 * np.sqrt(hs), 6.0, 12.0), source="made-up seas",
)  # fmt: skip
windows = weather_windows(hindcast, table)
print(f"\n{windows}")
scatter = ScatterDiagram.of(hindcast, hs=np.arange(0.0, 16.0, 0.5), tp=np.arange(6.0, 13.0))
print(f"\n{availability(table, scatter)}")

if len(sys.argv) > 1:
    plot_allowable_hs(table).savefig(Path(sys.argv[1]) / "operability.png", dpi=110)
