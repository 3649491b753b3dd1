"""A ship led by the record of its motion sensor, and the hook load beside what was measured.

Both records are made up, so that the truth is known: the load cell's clock is 1.3 s late, and it reads 4 kN
too much. The comparison finds both.

Usage: python compared_with_a_record.py [FOLDER FOR A PICTURE]
"""

import sys
import tempfile
from pathlib import Path

import numpy as np

from seacrane import MotionHistory, Scene, simulate
from seacrane.statistics import MeasuredSeries, compare

MASS, TIP, LOAD = 50e3, (30.0, 15.0, 25.0), (30.0, 15.0, 20.0)
LATE, TOO_MUCH = 1.3, 4.0  # s, kN
random = np.random.default_rng(7)


def run(history: MotionHistory):
    scene = Scene(name="lift that was measured")
    scene.add_vessel(motion=history, ramp=0.0)
    scene.add_body(name="load", mass=MASS, inertia=(1e5, 1e5, 1e5), position=LOAD)
    scene.add_joint(kind="distance", name="wire", first="vessel", second="load", point=TIP, second_point=LOAD)
    return simulate(scene, t_end=290.0, dt_out=0.1)


# What happened: heave, roll and pitch of many periods, growing over the first minute.
time = np.arange(0.0, 300.0, 0.1)
omega = np.linspace(0.45, 1.0, 45)
waves = np.cos(np.outer(time, omega) + random.uniform(0.0, 2.0 * np.pi, omega.size))
grown = np.minimum(1.0, time / 60.0) ** 3
heave, roll, pitch = (grown * (waves @ random.normal(0.0, size, omega.size)) for size in (0.06, 0.003, 0.002))
still = 0.0 * time
truth = run(MotionHistory(time=time, motion=np.column_stack([still, still, heave, roll, pitch, still])))

with tempfile.TemporaryDirectory() as place:
    # What the instruments wrote: degrees, noise of 5 mm, decimal commas; tonnes by a clock of its own.
    folder = Path(place)
    noisy = heave + random.normal(0.0, 5e-3, time.size)
    rows = np.column_stack([time, noisy, *np.degrees([roll, pitch])])
    text = "\n".join(";".join(f"{one:.5f}".replace(".", ",") for one in row) for row in rows)
    (folder / "mru.csv").write_text("Time (s);Heave_m;Roll [deg];Pitch [deg]\n" + text)
    stamps = np.arange(40.0, 280.0, 0.2)
    tension = np.interp(stamps - LATE, truth.time, truth.curve("hook_load"))
    tonnes = (tension + 1e3 * TOO_MUCH + random.normal(0.0, 200.0, stamps.size)) / 9806.65
    cell = "\n".join(f"{t:.1f},{one:.4f}" for t, one in zip(stamps, tonnes, strict=True))
    (folder / "cell.csv").write_text("time [s],hook load [t]\n" + cell)

    # What a user does.
    history = MotionHistory.load(
        folder / "mru.csv", zero=("surge", "sway", "yaw"), filter_hz=0.5, interval=0.2
    )
    cell_record = MeasuredSeries.load(folder / "cell.csv")

print(history.record)
found = compare(run(history), cell_record)
print(found)
print(f"found: {found.shift:.2f} s late, {-found.bias / 1e3:.2f} kN too much; "
      f"true: {LATE:.2f} s, {TOO_MUCH:.2f} kN")  # fmt: skip

if len(sys.argv) > 1:
    found.plot().savefig(Path(sys.argv[1]) / "compared_with_a_record.png")
