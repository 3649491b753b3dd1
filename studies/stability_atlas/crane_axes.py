"""Axes of the crane: masses, lengths, gains, cylinders, slewing, and how well the start closes."""

from __future__ import annotations

import numpy as np

from seacrane import Scene, _core, cases
from seacrane.accuracy.case import Case
from seacrane.analysis.weight_balance import balance
from seacrane.crane import Payload
from stability_atlas.axis import Axis

T_END, DT_OUT = 10.0, 0.25  # s
WAVES = 40  # components: what they excite matters here, not their statistics
RODS = ("main_rod", "knuckle_rod")
TONNE = 1e3
SLEW_RATE = 0.2  # rad/s, mean


def _rods(factor: float) -> Case:
    """Case 2 with the rods' mass and inertia multiplied."""
    scene = cases.case2(count=WAVES)
    for name in RODS:
        body = scene.bodies[name]
        scene.replace(name, kind="body", mass=body.mass * factor, inertia=np.asarray(body.inertia) * factor)
    return Case(scene=scene, t_end=T_END, dt_out=DT_OUT)


def _payload(tonnes: float) -> Case:
    """Case 2 with another payload, of the same size; some capsize the ship, which then has no rest state."""
    scene = cases.case2(count=WAVES, payload=Payload(mass=TONNE * tonnes), feed_forward="start")
    return Case(scene=scene, t_end=T_END, dt_out=DT_OUT)


def _link(length: float) -> Case:
    """Case 2 with another length of the wire."""
    return Case(
        scene=cases.case2(count=WAVES, payload=Payload(link_length=length)), t_end=T_END, dt_out=DT_OUT
    )


def _gains(factor: float) -> Case:
    """Case 2 with stiffness and damping of every actuator multiplied."""
    scene = cases.case2(count=WAVES)
    stiffened(scene, factor)
    return Case(scene=scene, t_end=T_END, dt_out=DT_OUT)


def stiffened(scene: Scene, factor: float) -> None:
    """Stiffness and damping of every actuator multiplied."""
    for name, one in list(scene.actuators.items()):
        scene.replace(name, kind="actuator", stiffness=factor * one.stiffness, damping=factor * one.damping)


def held_crane(references: dict[str, _core.Curve] | None = None) -> Scene:
    """The crane on the ground with its payload, balanced, with the gains of case 2."""
    scene = Scene(name="crane on the ground")
    scene.add_crane(base="ground", payload=Payload(), damping=False)
    for name, joint in cases.ACTUATORS.items():
        scene.add_actuator(name=name, joint=joint)
    loads = balance(scene).loads
    like = cases.case2(hs=0.0).actuators
    for name, actuator in list(scene.actuators.items()):
        scene.replace(
            name, kind="actuator", stiffness=like[name].stiffness, damping=like[name].damping,
            feed_forward=_core.Curve.constant(value=loads[name]),
            reference=(references or {}).get(name, actuator.reference),
        )  # fmt: skip
    return scene


def _slew(turns: float) -> Case:
    """The crane turned about its tower that many times."""
    t_end = 2.0 * np.pi * turns / SLEW_RATE
    curve = _core.Curve.quintic(start_time=0.0, end_time=t_end, start=0.0, end=2.0 * np.pi * turns)
    return Case(scene=held_crane({"slew": curve}), t_end=t_end, dt_out=t_end / 40.0)


def _open_start(gap: float) -> Case:
    """The crane on the ground, one of its rods described that far from where its joints want it."""
    turned = _core.Curve.quintic(start_time=0.0, end_time=5.0, start=0.0, end=1.0)
    scene = held_crane({"slew": turned})
    apart = np.asarray(scene.bodies["main_rod"].position) + gap * np.array([0.6, 0.0, 0.8])
    scene.replace("main_rod", kind="body", position=apart)
    return Case(scene=scene, t_end=5.0, dt_out=DT_OUT)


AXES = (
    Axis(name="rods", title="Mass of the cylinders' rods, case 2", label="times the rods' mass",
         values=(1e-8, 1e-4, 1e-2, 1.0, 1e2, 1e4), quick=(1e-8, 1.0, 1e4), case=_rods),
    Axis(name="payload", title="Payload, case 2", label="payload [t]",
         values=(1e-7, 0.01, 10.0, 100.0, 500.0, 2500.0, 1e5),
         quick=(1e-7, 0.01, 100.0, 2500.0), case=_payload),
    Axis(name="link", title="Length of the wire, case 2", label="link length [m]",
         values=(0.05, 0.5, 8.0, 50.0, 300.0, 3000.0), quick=(0.05, 8.0, 3000.0), case=_link),
    Axis(name="gains", title="Gains of the actuators, case 2", label="times the usual gains",
         values=(0.01, 0.1, 1.0, 10.0, 100.0, 1000.0), quick=(0.01, 1.0, 100.0), case=_gains),
    Axis(name="slew", title="Slewing through many turns, crane on the ground", label="turns",
         values=(1.0, 10.0, 100.0), quick=(1.0,), long=(1000.0,), case=_slew),
    Axis(name="open-start", title="Bodies described apart from their joints", label="gap at the start [m]",
         values=(1e-12, 1e-6, 1e-3, 0.1, 1.0), quick=(1e-12, 1e-3, 1.0), case=_open_start),
)  # fmt: skip
