"""Axes of the vessel and the sea: the waves, roll damping, capsizing, fluid memory, the origin of time."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from seacrane import Method, _core, cases, simulate
from seacrane.accuracy.case import Case
from seacrane.description.description import STANDARD_GRAVITY
from seacrane.sea import steepness_limit
from stability_atlas.axis import Axis
from stability_atlas.crane_axes import DT_OUT, WAVES
from stability_atlas.points import POINTS, KnownCase

T_END = 20.0  # s
SHORTEST = 6.5  # s: peak period whose sea lies within the frequencies of the shipped database
PERIODS = np.linspace(2.0, 40.0, 3801)  # s


def steepest_period(hs: float) -> float:
    """Shortest peak period (s) of a real sea of this height."""
    highest = np.array([steepness_limit(tp) * STANDARD_GRAVITY * tp**2 / (2.0 * np.pi) for tp in PERIODS])
    return float(PERIODS[np.searchsorted(highest, hs)])


def _height(hs: float) -> Case:
    """Case 2 in the steepest sea of this height that its database holds."""
    scene = cases.case2(count=WAVES, hs=hs, tp=max(steepest_period(hs), SHORTEST))
    return Case(scene=scene, t_end=T_END, dt_out=DT_OUT)


def _period(tp: float) -> Case:
    """Case 2 in a sea of 2.5 m with this peak period; 5 s is its steepness limit."""
    return Case(scene=cases.case2(count=WAVES, hs=2.5, tp=tp), t_end=T_END, dt_out=DT_OUT)


def _heading(degrees: float) -> Case:
    """Case 2 in a sea of 5 m and 10 s from this side."""
    scene = cases.case2(count=WAVES, hs=5.0, tp=10.0, wave_direction_deg=degrees)
    return Case(scene=scene, t_end=T_END, dt_out=DT_OUT)


def _roll_damping(factor: float) -> Case:
    """Case 2 in beam seas near resonance, its roll damping beside radiation multiplied."""
    scene = cases.case2(count=WAVES, hs=5.0, tp=12.0, wave_direction_deg=90.0)
    vessel = scene.vessels["vessel"]
    linear, quadratic = np.array(vessel.linear_damping), np.array(vessel.quadratic_damping)
    linear[3, 3] *= factor
    quadratic[3] *= factor
    scene.replace("vessel", kind="vessel", linear_damping=linear, quadratic_damping=quadratic)
    return Case(scene=scene, t_end=60.0, dt_out=DT_OUT)


def _turned(axis: tuple[float, float, float], degrees: float) -> Case:
    scene = cases.vessel(hs=0.0)
    half = 0.5 * np.radians(degrees)
    turned = np.append(np.cos(half), np.sin(half) * np.array(axis))
    scene.replace("vessel", kind="body", quaternion=turned)
    return Case(scene=scene, t_end=60.0, dt_out=0.5)


def _heel(degrees: float) -> Case:
    """The vessel in calm water, let go at this angle of roll."""
    return _turned((1.0, 0.0, 0.0), degrees)


def _trim(degrees: float) -> Case:
    """The vessel in calm water, let go at this angle of pitch."""
    return _turned((0.0, 1.0, 0.0), degrees)


def _memory(factor: float) -> Case:
    """The vessel in waves, the loads of its fluid memory multiplied: below 0 the memory drives the motion."""
    scene = cases.vessel(count=WAVES, memory="by-motion")
    blocks = scene.vessels["vessel"].memory
    assert isinstance(blocks, list)
    scaled = [
        _core.StateSpaceBlock(**one.__getstate__() | {"c": factor * one.c, "d": factor * one.d})
        for one in blocks
    ]
    scene.replace("vessel", kind="vessel", memory=scaled)
    return Case(scene=scene, t_end=300.0, dt_out=2.0)


def _time_origin(t0: float) -> Case:
    """The vessel in waves from time t0 on; the truth is the same sea with its phases turned to t0, from 0 on.

    Frequencies are rounded to multiples of 2^-20 rad/s, so that their phases at t0 are known exactly.
    """
    scene = cases.vessel(count=WAVES)
    waves = scene.waves
    assert waves is not None
    omega = np.round(waves.omega * 2.0**20) / 2.0**20
    scene.waves = replace(waves, omega=omega, relative_bound=1e-12)
    twin = scene.copy()
    # Both factors are integers: their product is exact, and the rest of a whole turn is right to 40 digits.
    turned = [_turn_of(int(w * 2.0**20) * int(t0)) for w in omega]
    twin.waves = replace(scene.waves, phase=np.asarray(waves.phase) + np.array(turned))
    tight = Method(integrator="verner76", rtol=1e-11)
    run = simulate(twin, t_end=60.0, method=tight, dt_out=0.5, channels=["position", "quaternion"])
    begin = _core.initial_state(scene.compile())
    start = _core.State(time=t0, values=begin.values, inputs=begin.inputs)
    return KnownCase(scene=scene, t_end=t0 + 60.0, dt_out=0.5, start=start, truth=POINTS.values(run))


def _turn_of(numerator: int) -> float:
    """numerator / 2^20 rad less its whole turns."""
    from decimal import Decimal, localcontext

    with localcontext() as context:
        context.prec = 60
        turn = 2 * Decimal("3.14159265358979323846264338327950288419716939937510582097494")
        return float((Decimal(numerator) / Decimal(2**20)) % turn)


AXES = (
    Axis(name="wave-height", title="Steepest sea of each height, case 2", label="significant wave height [m]",
         values=(0.0, 2.0, 5.0, 10.0, 20.0), quick=(0.0, 5.0, 20.0), case=_height),
    Axis(name="wave-period", title="Peak period of a sea of 2.5 m, case 2", label="peak period [s]",
         values=(5.0, 6.5, 8.0, 12.0, 25.0), quick=(5.0, 6.5, 25.0), case=_period),
    Axis(name="heading", title="Direction of a sea of 5 m and 10 s, case 2",
         label="direction waves travel to [deg]",
         values=(0.0, 90.0, 135.0, 180.0, 270.0), quick=(90.0,),
         case=_heading),
    Axis(name="roll-damping", title="Roll damping beside radiation, case 2 in beam seas of 5 m",
         label="times the vessel's roll damping", values=(0.0, 0.1, 1.0, 10.0), quick=(0.0,),
         case=_roll_damping),
    Axis(name="heel", title="The vessel let go heeled over, calm water", label="roll at the start [deg]",
         values=(5.0, 20.0, 60.0, 89.0, 91.0, 179.0), quick=(20.0, 89.0, 179.0), case=_heel),
    Axis(name="trim", title="The vessel let go on its nose, calm water", label="pitch at the start [deg]",
         values=(5.0, 20.0, 60.0, 89.0, 91.0, 179.0), quick=(20.0, 89.0, 91.0), case=_trim),
    Axis(name="memory", title="Fluid memory made active, the vessel in waves",
         label="times the load of the memory", values=(1.0, 0.0, -0.01, -0.1, -1.0),
         quick=(1.0, 0.0, -1.0), case=_memory),
    Axis(name="time-origin", title="Time far from zero, the vessel in waves", label="time at the start [s]",
         values=(0.0, 1e5, 1e7, 1e9, 1e11), quick=(0.0, 1e5, 1e9), case=_time_origin),
)  # fmt: skip
