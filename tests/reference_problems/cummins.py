"""A ship in waves after Cummins: (M + A_inf) eta'' + B eta' + int_0^t K(s) eta'(t - s) ds + C eta = F(t).

For the small motions of the shipped hull, moored, whose matrices and kernel K(t) = C exp(A t) B are data: the
integral itself, as a sum over the whole past in NumPy (Cummins, Schiffstechnik 9, 1962), and the roots of the
equation for free decay; its solution in the frequency domain is in `test_vessel`.
"""

from __future__ import annotations

import itertools
from functools import cache

import numpy as np
from linear_scenes import reference_vessel
from scipy.linalg import expm
from test_convolution import fitted_kernel, with_kernel
from test_vessel import moored, regular_wave

from seacrane import Scene, State, linear_model, natural_modes, simulate
from seacrane.arrays import Array
from seacrane.hydro import RetardationFunctions, shipped_database
from seacrane.scene import Waves

AMPLITUDE, OMEGA = 1e-5, 0.7


def waves() -> Waves:
    return regular_wave(shipped_database(), omega=OMEGA, heading_deg=135.0, amplitude=AMPLITUDE, phase=0.4)


def scene(memory: str = "states") -> Scene:
    """At rest in a regular wave that is there at once: memory by states, or convolved in steps of 0.05 s."""
    out = moored(shipped_database())
    if memory == "convolution":
        out = with_kernel(out, RetardationFunctions(step=0.05, kernel=fitted_kernel(0.05)))
    out.waves = waves()
    return out


def trapezoidal(step: float, t_end: float) -> Array:
    """Motions (k, 6) by the trapezoidal rule, in time and integral: errors in even powers of the step."""
    linear = reference_vessel(moored(shipped_database()))
    count = round(t_end / step)
    ahead, kernel = expm(linear.memory.a * step), np.zeros((count + 1, 6, 6))
    states = np.array(linear.memory.b)
    for k in range(count + 1):
        kernel[k] = linear.memory.c @ states
        states = ahead @ states
    sea = waves()
    phase = sea.phase[0] + OMEGA * step * np.arange(count + 1)[:, None]
    force = sea.hull().transfer[0] * AMPLITUDE * np.exp(1j * phase)
    damping = linear.damping + linear.memory.d
    flat = kernel[::-1].transpose(1, 0, 2).reshape(6, -1)  # newest last, to meet the oldest velocity first
    # Unknown: the rate at the end of a step; everything it multiplies goes to the left.
    left = linear.mass + 0.5 * step * (damping + 0.5 * step * kernel[0]) + 0.25 * step**2 * linear.restoring
    inverse = np.linalg.inv(left)
    eta, rate = np.zeros((count + 1, 6)), np.zeros((count + 1, 6))
    acceleration = np.linalg.solve(linear.mass, force[0].real)
    for n in range(1, count + 1):
        past = flat[:, 6 * (count - n) : 6 * count] @ rate[:n].ravel() * step  # the first rate is zero
        drifted = eta[n - 1] + 0.5 * step * rate[n - 1]
        load = force[n].real - linear.restoring @ drifted - past
        rate[n] = inverse @ (linear.mass @ (rate[n - 1] + 0.5 * step * acceleration) + 0.5 * step * load)
        eta[n] = drifted + 0.5 * step * rate[n]
        acceleration = (rate[n] - rate[n - 1]) * 2.0 / step - acceleration
    return eta


@cache
def by_convolution(t_end: float = 60.0, every: float = 1.0) -> Array:
    """Motions at whole seconds, extrapolated twice to steps of zero."""
    coarse, middle, fine = (trapezoidal(step, t_end)[:: round(every / step)] for step in (0.1, 0.05, 0.025))
    first, second = middle + (middle - coarse) / 3.0, fine + (fine - middle) / 3.0
    return np.asarray(second + (second - first) / 15.0)


def decay(label: str) -> tuple[complex, complex]:
    """Eigenvalue found from a run that starts in a mode's shape, and that of the vessel's matrices.

    The period is twice the mean distance of zero crossings, the logarithmic decrement the mean over half
    periods of the logarithm of the ratio of extremes.
    """
    calm = moored(shipped_database())
    modes = natural_modes(linear_model(calm))
    mode = modes.find(label)
    start: State = linear_model(calm).full_state(1e-4 * modes.state_vectors[mode].real)
    period = 2.0 * np.pi / modes.eigenvalues[mode].imag
    how = {"dt_out": period / 4000.0, "rtol": 1e-11, "channels": ["vessel_motion"]}
    result = simulate(calm, 4.0 * period, start=start, **how)
    signal = result.select("vessel_motion", motion=label.split()[1])
    change = np.flatnonzero(signal[:-1] * signal[1:] < 0.0)
    before, after = signal[change], signal[change + 1]
    crossings = result.time[change] + np.diff(result.time)[0] * before / (before - after)
    half = np.diff(crossings).mean()
    extremes = np.array([_extreme(np.abs(signal[a + 1 : b + 1])) for a, b in itertools.pairwise(change)])
    rate = np.log(extremes[1:] / extremes[:-1]).mean() / half
    expected = reference_vessel(calm).eigenvalues()
    nearest = expected[np.argmin(np.abs(expected - complex(rate, np.pi / half)))]
    return complex(rate, np.pi / half), complex(nearest)


def _extreme(values: Array) -> float:
    """Of a parabola through the largest sample and its neighbours."""
    k = int(np.argmax(values))
    before, here, after = values[k - 1 : k + 2]
    return float(here - (after - before) ** 2 / (8.0 * (before + after - 2.0 * here)))
