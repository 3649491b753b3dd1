"""
Compiled core of seacrane: descriptions, compiled model, stepping loop. SI units, radians.
"""
from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import types
import typing
__all__: list[str] = ['Actuator', 'Body', 'Channel', 'Contact', 'Current', 'Curve', 'DriftLoad', 'DriftTable', 'Driver', 'EntrappedWater', 'Evaluator', 'ExactWaveLoad', 'Field', 'FlowEvaluator', 'FlowForce', 'ForceTable', 'Frame', 'Friction', 'FunctionForce', 'GasSpring', 'GroupHydrodynamics', 'HeaveCompensator', 'HydraulicCylinder', 'ImmersedPart', 'ImmersedSpan', 'Integrator', 'Joint', 'JointKind', 'LOAD_KINDS', 'LaneEvaluator', 'Limit', 'Line', 'Model', 'PendulumDamping', 'Point', 'PointForce', 'PositionedWaveLoad', 'RecordHistory', 'RepeatPeriod', 'RetardationFunctions', 'RunOptions', 'SeaField', 'SeabedNode', 'Simulation', 'SoftStop', 'SpanDrag', 'Spectrum', 'Spring', 'State', 'StateSpaceBlock', 'StepHistory', 'TwistHistory', 'VesselHydrodynamics', 'WaveBins', 'WaveComponents', 'WaveKinematics', 'WaveLoads', 'WaveTable', 'WoundSpan', 'advance_side_by_side', 'axes', 'channels', 'compile', 'curve_of', 'dnv_gamma', 'finite_of', 'flag_of', 'has_instructions', 'initial_state', 'integrator', 'integrator_names', 'integrators', 'joint_kinds', 'jonswap', 'kept_apart', 'lanes_differ', 'lanes_of', 'matrix_of', 'name_of', 'not_negative_of', 'number_of', 'numbers_of', 'ochi_hubble', 'philox_uniform', 'pierson_moskowitz', 'positive_of', 'realise_waves', 'require_unmasked', 'rows_of', 'section_radiation', 'shaped_of', 'spline_rows', 'stability_polynomial', 'strip_theory', 'tabulated_density', 'text_of', 'texts_of', 'torsethaugen', 'turned', 'vector_of', 'weighted_sums', 'without_smallest']
class Curve:
    """
    A reference as a function of time: pieces of quintic polynomials plus one cosine each.
    
    Before its first piece a curve holds its first value at rest; its last piece goes on for ever: a polynomial
    as the polynomial that it is. Values are in the unit of what the curve drives (m, rad, N, N m or m/s), times
    in s. Immutable.
    """
    @staticmethod
    def constant(*, value: typing.SupportsFloat | typing.SupportsIndex) -> Curve:
        """
        One value at all times.
        """
    @staticmethod
    def harmonic(*, start_time: typing.SupportsFloat | typing.SupportsIndex = 0.0, offset: typing.SupportsFloat | typing.SupportsIndex = 0.0, amplitude: typing.SupportsFloat | typing.SupportsIndex, omega: typing.SupportsFloat | typing.SupportsIndex, phase: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> Curve:
        """
        offset + amplitude cos(omega (t - start_time) + phase), omega in rad/s.
        """
    @staticmethod
    def pieces(*, starts: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], coefficients: collections.abc.Sequence[typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(6)"]], cosines: collections.abc.Sequence[typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(3)"]] = []) -> Curve:
        """
        Pieces from their start times on: coefficients (n, 6) of powers of (t - start), cosines (n, 3) of amplitude, omega, phase. The last piece continues as it is: end with a constant to hold a value.
        """
    @staticmethod
    def quintic(*, start_time: typing.SupportsFloat | typing.SupportsIndex, end_time: typing.SupportsFloat | typing.SupportsIndex, start: typing.SupportsFloat | typing.SupportsIndex, end: typing.SupportsFloat | typing.SupportsIndex) -> Curve:
        """
        From `start` at `start_time` to `end` at `end_time`, at rest with zero acceleration at both ends, held before and after. Raises SceneError when the times do not increase.
        """
    @staticmethod
    def table(times: typing.Any, values: typing.Any, *, between: str = 'linear') -> Curve:
        """
        Through samples (n,) of two or more: times in s that increase, values in the unit of what the curve drives, such as a channel of a result. `between`: "linear", whose rate jumps at the samples; or "cubic", whose rate and acceleration do not, at rest at both ends. Before the first sample it is held at its value, and after the last one at that. Steps end at its jumps.
        """
    def __copy__(self) -> Curve:
        ...
    def __deepcopy__(self, memo: dict) -> Curve:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def evaluate(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Values, rates and accelerations, shape (n, 3), at times (n,) in s.
        """
    def then(self, *, time: typing.SupportsFloat | typing.SupportsIndex, curve: Curve) -> Curve:
        """
        This curve until `time`, the other one afterwards (at its own clock).
        """
    def to_pieces(self) -> dict:
        """
        The arguments of Curve.pieces() that make this curve.
        """
    @property
    def breakpoints(self) -> list[float]:
        """
        Times (s) where value, rate or acceleration jumps.
        """
class Spectrum:
    """
    One-sided wave spectrum S(omega) in m2 s/rad; immutable. Parametric ones are normalised by quadrature to hs^2 / 16.
    """
    def __repr__(self) -> str:
        ...
    def density(self, omega: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        """
        S(omega) in m2 s/rad for frequencies in rad/s, any shape; zero for omega <= 0.
        """
    def energy(self, *, minimum_omega: typing.SupportsFloat | typing.SupportsIndex = 0.0, maximum_omega: typing.SupportsFloat | typing.SupportsIndex = ...) -> float:
        """
        Integral of S between two frequencies, m2.
        """
    def moment(self, order: typing.SupportsInt | typing.SupportsIndex) -> float:
        """
        Integral of omega^order S over all frequencies, for orders where it is finite (JONSWAP: -4 to 3).
        """
    def parts(self) -> list[Spectrum]:
        """
        Each wave system by itself, the one with the given or the highest peak first.
        """
    def steepness(self, *, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665) -> float:
        """
        hs over the deep-water wave length of the peak period, hs / (g tp^2 / 2 pi).
        """
    @property
    def default_range(self) -> typing.Annotated[list[float], "FixedSize(2)"]:
        """
        Frequencies that a realisation covers by default, rad/s.
        """
    @property
    def gamma(self) -> float | None:
        """
        Peak enhancement of the first part; 1 for Pierson-Moskowitz, None for a table.
        """
    @property
    def hs(self) -> float:
        """
        Significant wave height, m.
        """
    @property
    def name(self) -> str:
        ...
    @property
    def peak_omega(self) -> float:
        """
        Peak frequency of the first part, rad/s.
        """
    @property
    def tp(self) -> float:
        """
        Peak period, s.
        """
class Current:
    """
    Steady horizontal current over depth: linear between depths, held beyond the first and the last.
    
    `depth` (n,), m below the still water, increasing; `x`, `y` (n,), m/s, inertial frame. Raises
    ValueError.
    """
    def __init__(self, *, depth: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def velocity(self, z: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Along x and y, (n, 2), m/s, at heights z (n,), m.
        """
    def wavenumber(self, *, omega: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], depth: typing.SupportsFloat | typing.SupportsIndex = ..., gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665) -> numpy.typing.NDArray[numpy.float64]:
        """
        Wavenumbers (n,), rad/m, of waves that a fixed observer sees at omega (n,), rad/s, and that travel to direction (n,), rad: (omega - k U)^2 = g k tanh(k depth), with U of the profile by Stewart and Joy (1974) and Skop (1987). NaN where the current stops the wave.
        """
class RepeatPeriod:
    """
    Answer of `WaveComponents.repeat_period`.
    """
    def __repr__(self) -> str:
        ...
    @property
    def found(self) -> bool:
        """
        Whether the sea repeats at `time`.
        """
    @property
    def time(self) -> float:
        """
        First repeat, or the proven lower bound of it, s.
        """
class WaveKinematics:
    """
    Answer of `WaveComponents.kinematics`. Arrays of the shape of the points; vectors have three inertial components last. In air velocity, acceleration and pressure are zero.
    """
    def __repr__(self) -> str:
        ...
    @property
    def acceleration(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        m/s2, of the water, first order: partial derivative in time, and along a current
        """
    @property
    def dynamic_pressure(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Pa, without the hydrostatic -density g z
        """
    @property
    def elevation(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        m, of the surface above the point
        """
    @property
    def submerged(self) -> numpy.typing.NDArray[numpy.bool]:
        """
        Whether the point is below the surface.
        """
    @property
    def velocity(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        m/s, with the current
        """
class WaveComponents:
    """
    Regular waves whose sum is the sea; immutable.
    
    Elevation = sum a cos(omega t - k (x cos b + y sin b) + phase), inertial frame (x forward, y port), b the
    direction of travel from +x towards +y. Arrays are read-only views of shape (components,).
    
    Parameters
    ----------
    omega : array_like, shape (n,)
        Frequencies, rad/s, above zero.
    amplitude, phase, direction : float or array_like, shape (n,)
        m, rad, rad.
    depth : float
        Water depth, m; infinity for deep water. Wavenumbers follow from omega^2 = g k tanh(k depth).
    gravity : float
        m/s2.
    current : Current, optional
        On which the waves travel: (omega - k U)^2 = g k tanh(k depth), see `Current.wavenumber`; omega is what a
        fixed observer sees.
    
    Raises
    ------
    ValueError
        A value is not finite or out of range, the lengths differ, or the current stops a wave.
    """
    def __init__(self, *, omega: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], amplitude: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], phase: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = 0.0, direction: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = 0.0, depth: typing.SupportsFloat | typing.SupportsIndex = ..., gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, current: Current = None) -> None:
        ...
    def __len__(self) -> int:
        ...
    def __repr__(self) -> str:
        ...
    def autocorrelation(self, lag: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Any:
        """
        Autocorrelation coefficient of the elevation at one point, for lags in s, any shape.
        """
    def elevation(self, times: typing.Any, *, x: typing.Any = 0.0, y: typing.Any = 0.0) -> numpy.typing.NDArray[numpy.float64]:
        """
        Wave elevation (m) at times (s) and points (m, inertial frame), broadcast against each other.
        """
    def kinematics(self, *, time: typing.Any, x: typing.Any, y: typing.Any, z: typing.Any, stretching: str = 'wheeler', density: typing.SupportsFloat | typing.SupportsIndex = 1025.0) -> WaveKinematics:
        """
        Undisturbed wave at points by linear theory, for finite or infinite depth.
        
        Parameters
        ----------
        time, x, y, z : array_like, broadcast against each other
            s; m, inertial frame, z up from the still water.
        stretching : str
            How linear theory, which ends at z = 0, is taken to the moving surface. "wheeler" (default): at
            z' = (z - elevation) / (1 + elevation / depth), so that the pressure vanishes at the surface. "none": linear
            theory itself up to z = 0, the values of z = 0 above it.
        density : float
            kg/m3, for the pressure.
        
        Returns
        -------
        WaveKinematics
        
        Raises
        ------
        ValueError
            A value is not finite, a point lies below the sea floor, or `stretching` is unknown.
        
        Notes
        -----
        J. D. Wheeler, "Method for calculating forces produced by irregular waves", J. Petroleum Technology 22, 1970;
        DNV-RP-C205, 3.3.
        """
    def repeat_period(self, horizon: typing.SupportsFloat | typing.SupportsIndex = 10800.0) -> RepeatPeriod:
        """
        First time after the initial decay at which the autocorrelation is 0.99 again, s; `found` is False when it is proven that there is none before `horizon`.
        """
    @property
    def amplitude(self) -> numpy.ndarray:
        """
        m
        """
    @property
    def depth(self) -> float:
        """
        m
        """
    @property
    def direction(self) -> numpy.ndarray:
        """
        rad, travelling to
        """
    @property
    def gravity(self) -> float:
        """
        m/s2
        """
    @property
    def intrinsic(self) -> numpy.ndarray:
        """
        rad/s, omega - k U: with which the water moves
        """
    @property
    def m0(self) -> float:
        """
        sum a^2 / 2, m2.
        """
    @property
    def mean_period(self) -> float:
        """
        Mean zero-upcrossing period 2 pi sqrt(m0 / m2), s.
        """
    @property
    def omega(self) -> numpy.ndarray:
        """
        rad/s
        """
    @property
    def phase(self) -> numpy.ndarray:
        """
        rad
        """
    @property
    def realised_hs(self) -> float:
        """
        4 sqrt(m0) of the amplitudes, m: no sampling scatter.
        """
    @property
    def wavenumber(self) -> numpy.ndarray:
        """
        rad/m
        """
class SeaField:
    """
    Waves and current of a scene as loads see them at moving points; immutable.
    
    Flows are rows of eleven numbers: elevation (m), its rate (m/s) and its slopes over x and y, velocity (3, m/s,
    with the current), acceleration (3, m/s2, of the water, first order), dynamic pressure over density (m2/s2).
    Above the water they are those at its level.
    """
    def __init__(self, waves: WaveComponents, *, stretching: str = 'wheeler') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def at(self, *, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Flows (n, m, 11) at times (n,), s, and points (m, 3), m, component by component.
        """
class FlowEvaluator:
    """
    A stencil of `count` points in a sea field, for tests and timing; loads hold theirs in the core.
    """
    def __init__(self, field: SeaField, *, count: typing.SupportsInt | typing.SupportsIndex, cut: typing.SupportsFloat | typing.SupportsIndex = 1e-05) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def cloud(self, *, time: typing.SupportsFloat | typing.SupportsIndex, points: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]], extents: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 3]"]]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Flows (count, 11) at points (count, 3), m, of elements whose extents along three axes are the columns of (count, 3, 3), m.
        """
    def error_bound(self, *, time: typing.SupportsFloat | typing.SupportsIndex, x: typing.SupportsFloat | typing.SupportsIndex, y: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
        """
        Bounds (1, 11) of the distance from the sum component by component.
        """
    def line(self, *, time: typing.SupportsFloat | typing.SupportsIndex, first: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], step: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"], whole: bool = True) -> numpy.typing.NDArray[numpy.float64]:
        """
        Flows (count, 11) at first + i step, m; with `whole` each is the mean over an element as long as the step.
        """
class WaveBins:
    """
    A spectrum cut into bins, of which `realise` makes what `realise_waves` makes of the spectrum. What the seeds share is worked out once.
    """
    def __init__(self, spectrum: Spectrum, *, count: typing.Any = 200, minimum_omega: typing.SupportsFloat | typing.SupportsIndex | None = None, maximum_omega: typing.SupportsFloat | typing.SupportsIndex | None = None, placement: str = 'jittered') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def realise(self, *, seed: typing.Any, direction: typing.SupportsFloat | typing.SupportsIndex, depth: typing.SupportsFloat | typing.SupportsIndex = ..., gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, system: typing.Any = 0) -> WaveComponents:
        """
        Arguments as of `realise_waves`.
        """
class ExactWaveLoad:
    """
    First-order wave load of a vessel at its mean position, summed over all components; immutable.
    
    F_j(t) = Re sum_i a_i X_ij exp(i (omega_i t + phase_i - k_i (x cos b_i + y sin b_i))), in the axes and about the
    reference point of the transfer.
    
    Parameters
    ----------
    waves : WaveComponents
    transfer : array_like of complex, shape (components, 6)
        X: N/m and N m/m, time factor exp(+i omega t), phase referring to `position`. Copied.
    position : tuple of float
        x, y of the phase reference of X, m, inertial frame.
    elevation_point : tuple of float, optional
        x, y where the elevation is taken, m; `position` by default.
    
    Raises
    ------
    ValueError
        A wrong shape or a value that is not finite.
    """
    def __init__(self, waves: WaveComponents, *, transfer: typing.Annotated[numpy.typing.ArrayLike, numpy.complex128], position: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0), elevation_point: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def elevation(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Wave elevation (m) at the elevation point, shape of `times` (s).
        """
    def evaluate(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], *, derivative: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forces (N) and moments (N m) at times (s): shape times.shape + (6,). `derivative` 1 or 2 gives the time derivatives of that order.
        """
    def magnitude(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        sum |a X_ij|, shape (6,): no load ever exceeds it.
        """
    @property
    def waves(self) -> WaveComponents:
        """
        The components (a copy).
        """
class WaveTable:
    """
    A wave load by Hermite interpolation of degree 11 on a global time grid; immutable.
    
    |table - exact| <= 3.72e-10 step^12 sum |a X_ij| omega^12 at any time (Hermite remainder), plus rounding. Knots are
    computed when a run reaches them and held in a ring of fixed size: constant memory for any duration.
    
    Parameters
    ----------
    load : ExactWaveLoad
    relative_bound : float
        The bound over sum |a X_ij|, 1e-14 to 1e-2; it sets the step. The default 1e-9 is about 1e-8 of a load's
        standard deviation with 200 components.
    
    Raises
    ------
    ValueError
        `relative_bound` is out of range.
    """
    def __init__(self, load: ExactWaveLoad, *, relative_bound: typing.SupportsFloat | typing.SupportsIndex = 1e-09) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def elevation(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Wave elevation (m) at the elevation point, shape of `times` (s).
        """
    def evaluate(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forces (N) and moments (N m) at times (s): shape times.shape + (6,).
        """
    @property
    def error_bound(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Bound of |table - exact| per motion, N and N m, shape (6,).
        """
    @property
    def step(self) -> float:
        """
        Distance of the knots, s.
        """
class DriftLoad:
    """
    Slowly varying second-order load at the mean position, Newman's approximation; immutable.
    
    F_j(t) = sum_ik a_i a_k (D_ij + D_kj) / 2 cos(theta_i - theta_k), theta_i = omega_i t + phase_i
    - k_i (x cos b_i + y sin b_i); its mean is sum a^2 D.
    
    Parameters
    ----------
    waves : WaveComponents
    coefficient : array_like, shape (components, 6)
        D: mean load over amplitude squared, N/m2 and N m/m2. Copied.
    position : tuple of float
        x, y of the vessel, m, inertial frame.
    
    Raises
    ------
    ValueError
        A wrong shape or a value that is not finite.
    """
    def __init__(self, waves: WaveComponents, *, coefficient: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], position: tuple[typing.SupportsFloat | typing.SupportsIndex, typing.SupportsFloat | typing.SupportsIndex] = (0.0, 0.0)) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def evaluate(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], *, derivative: typing.SupportsInt | typing.SupportsIndex = 0) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forces (N) and moments (N m) at times (s): shape times.shape + (6,); `derivative` 0, 1 or 2.
        """
    @property
    def waves(self) -> WaveComponents:
        """
        The components (a copy).
        """
class DriftTable:
    """
    A DriftLoad by Hermite interpolation on a global time grid, as WaveTable.
    """
    def __init__(self, load: DriftLoad, *, relative_bound: typing.SupportsFloat | typing.SupportsIndex = 1e-09) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def evaluate(self, times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        Forces (N) and moments (N m) at times (s): shape times.shape + (6,).
        """
    @property
    def error_bound(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Bound of |table - exact| per motion, N and N m, shape (6,).
        """
    @property
    def step(self) -> float:
        """
        Distance of the knots, s.
        """
class PositionedWaveLoad:
    """
    Wave loads with phase and heading of the vessel as it is now, in axes that follow its yaw; immutable.
    
    F_j = Re sum_i a_i X_j(omega_i, b_i - psi) exp(i (omega_i t + phase_i - k_i (x cos b_i + y sin b_i))), X by periodic
    cubic splines in the relative heading; slow drift, if asked for, as in DriftLoad with D at b_i - psi.
    
    Parameters
    ----------
    waves : WaveComponents
    headings : array_like, shape (m,)
        Increasing within one turn, at most 45 deg apart, rad.
    transfer : array_like of complex, shape (m, components, 6)
        X at each heading for each component's frequency, N/m and N m/m. Copied.
    drift_headings, drift : array_like, shapes (p,) and (p, components, 6), optional
        D over its headings, N/m2 and N m/m2. Copied.
    cutoff : float
        rad/s: in a run the loads are those of the position and heading below this frequency; 0: of the moment.
    
    Raises
    ------
    ValueError
        A wrong shape, a value that is not finite or out of range, or a gap between headings.
    """
    def __init__(self, waves: WaveComponents, *, headings: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], transfer: typing.Annotated[numpy.typing.ArrayLike, numpy.complex128], drift_headings: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [], drift: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] | None = None, cutoff: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def evaluate(self, time: typing.SupportsFloat | typing.SupportsIndex, *, x: typing.SupportsFloat | typing.SupportsIndex = 0.0, y: typing.SupportsFloat | typing.SupportsIndex = 0.0, yaw: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> tuple[numpy.typing.NDArray[numpy.float64], numpy.typing.NDArray[numpy.float64], float]:
        """
        First-order load (6,), slow drift (6,), in yaw-following axes, and elevation (m) at one time (s) and pose (m, rad).
        """
    @property
    def waves(self) -> WaveComponents:
        """
        The components (a copy).
        """
class WaveLoads:
    """
    Wave loads on a vessel: exact sums at the mean position, or tables of them with a stated error bound; or loads at the actual position, which replace all others.
    """
    def __init__(self, *, name: str, body: str, exact: ExactWaveLoad = None, table: WaveTable = None, drift: DriftLoad = None, drift_table: DriftTable = None, positioned: PositionedWaveLoad = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def name(self) -> str:
        ...
class Field:
    """
    An entry of an element: what FIELDS of its class lists.
    """
    def __repr__(self) -> str:
        ...
    @property
    def bounds(self) -> dict:
        """
        what its numbers must be, in the words of JSON Schema: minimum, exclusiveMinimum, ...
        """
    @property
    def default(self) -> typing.Any:
        """
        where it is not required
        """
    @property
    def least(self) -> float:
        """
        usual magnitude of what is not zero; 0: no bound
        """
    @property
    def most(self) -> float:
        """
        likewise
        """
    @property
    def name(self) -> str:
        ...
    @property
    def required(self) -> bool:
        ...
    @property
    def role(self) -> str:
        """
        name, body, joint, coordinate, distance or value
        """
    @property
    def shape(self) -> tuple:
        """
        of an array; -1: any length
        """
    @property
    def text(self) -> str:
        ...
    @property
    def type(self) -> str:
        """
        text, texts, number, flag, array, curve, frame, function or object
        """
    @property
    def unit(self) -> str:
        ...
class Body:
    """
    A rigid body: inertia about the centre of mass in body axes, pose of the body origin in the inertial frame, quaternion (w, x, y, z) body to inertial. Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> Body:
        ...
    def __deepcopy__(self, memo: dict) -> Body:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, mass: typing.SupportsFloat, inertia: numpy.typing.ArrayLike, center_of_mass: numpy.typing.ArrayLike = ..., position: numpy.typing.ArrayLike = ..., quaternion: numpy.typing.ArrayLike = ..., velocity: numpy.typing.ArrayLike = ..., angular_velocity: numpy.typing.ArrayLike = ..., gravity: bool = ..., size: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def angular_velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        rad/s, inertial frame
        """
    @property
    def center_of_mass(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, body axes
        """
    @property
    def gravity(self) -> bool:
        """
        whether weight acts on it
        """
    @property
    def inertia(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        kg m2, about the centre of mass, body axes
        """
    @property
    def mass(self) -> float:
        """
        kg
        """
    @property
    def name(self) -> str:
        ...
    @property
    def position(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, of the body origin, inertial frame
        """
    @property
    def quaternion(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
        """
        w, x, y, z: body to inertial
        """
    @property
    def size(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, edges of the box that it is, about its centre of mass, body axes
        """
    @property
    def velocity(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m/s, of the body origin, inertial frame
        """
class Frame:
    """
    A joint frame: a point (m) and axes (3, 3, columns; z is the joint axis) in body coordinates. Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> Frame:
        ...
    def __deepcopy__(self, memo: dict) -> Frame:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, point: numpy.typing.ArrayLike = ..., axes: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def axes(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        columns x, y, z in body coordinates; z is the joint axis
        """
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, body coordinates
        """
class Joint:
    """
    A joint between two bodies ('ground' is the inertial frame); may close a loop. A kind's own parameters, such as the length of a distance joint, are arguments too; see joint_kinds(). Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> Joint:
        ...
    def __deepcopy__(self, memo: dict) -> Joint:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getattr__(self, name: str) -> float:
        """
        A parameter by its name, or its default.
        """
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, kind: str, first: str, second: str, first_frame: Frame, second_frame: Frame, **parameters: typing.SupportsFloat) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def first(self) -> str:
        """
        body or ground
        """
    @property
    def first_frame(self) -> Frame:
        """
        on the first body
        """
    @property
    def kind(self) -> str:
        """
        one of joint_kinds()
        """
    @property
    def name(self) -> str:
        ...
    @property
    def parameters(self) -> dict[str, float]:
        """
        The kind's own numbers by name, such as the length of a distance joint (copy).
        """
    @property
    def second(self) -> str:
        """
        body or ground
        """
    @property
    def second_frame(self) -> Frame:
        """
        on the second body
        """
class JointKind:
    """
    What a joint type says of itself; see joint_kinds().
    """
    def __repr__(self) -> str:
        ...
    def example(self, seed: typing.SupportsInt | typing.SupportsIndex) -> Joint:
        """
        A closed joint of bodies 'first' and 'second' at one pose, with random frames.
        """
    @property
    def branch(self) -> bool:
        """
        whether formulation 'recursive' may step it
        """
    @property
    def coordinates(self) -> typing.Any:
        """
        those it offers
        """
    @property
    def name(self) -> str:
        ...
    @property
    def own_axis(self) -> bool:
        """
        whether the axis on the second body is another one
        """
    @property
    def own_point(self) -> bool:
        """
        whether the point on the second body is another one
        """
    @property
    def parameters(self) -> tuple:
        """
        numbers of its own, (Field, ...)
        """
    @property
    def rows(self) -> int:
        """
        constraints
        """
    @property
    def slides(self) -> bool:
        """
        whether its reaction is taken on the first body
        """
    @property
    def usual(self) -> str:
        """
        the coordinate meant where none is named; may be empty
        """
class Driver:
    """
    Prescribes a joint coordinate as a function of time. Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> Driver:
        ...
    def __deepcopy__(self, memo: dict) -> Driver:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, joint: str, coordinate: str, curve: Curve | typing.SupportsFloat) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def coordinate(self) -> str:
        """
        one that the joint offers
        """
    @property
    def curve(self) -> Curve:
        """
        m or rad
        """
    @property
    def joint(self) -> str:
        """
        joint
        """
    @property
    def name(self) -> str:
        ...
class Point:
    """
    A point of a body, whose motion is recorded. Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> Point:
        ...
    def __deepcopy__(self, memo: dict) -> Point:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def name(self) -> str:
        ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the body
        """
class HeaveCompensator:
    """
    Active heave compensation: a stroke that follows the motion of a point, and that a winch or an actuator follows; see Scene.add_heave_compensation. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> HeaveCompensator:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> HeaveCompensator:
        ...
    def __deepcopy__(self, memo: dict) -> HeaveCompensator:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ..., direction: numpy.typing.ArrayLike = ..., winch: str = ..., actuator: str = ..., ratio: typing.SupportsFloat = ..., gain: typing.SupportsFloat = ..., high_pass: typing.SupportsFloat = ..., lag: typing.SupportsFloat = ..., lag_order: typing.SupportsFloat = ..., actuator_frequency: typing.SupportsFloat = ..., actuator_damping: typing.SupportsFloat = ..., maximum_rate: typing.SupportsFloat = ..., maximum_stroke: typing.SupportsFloat = ..., settling: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def actuator(self) -> str:
        """
        actuator that follows, in place of a winch
        """
    @property
    def actuator_damping(self) -> float:
        """
        of critical damping of the drive
        """
    @property
    def actuator_frequency(self) -> float:
        """
        Hz, natural frequency of the drive, second order; 0: none
        """
    @property
    def body(self) -> str:
        """
        body whose motion is measured
        """
    @property
    def direction(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        along which it is measured, inertial axes
        """
    @property
    def gain(self) -> float:
        """
        of the stroke to the motion
        """
    @property
    def high_pass(self) -> float:
        """
        Hz, corner of the filter; 0: none
        """
    @property
    def lag(self) -> float:
        """
        s, of the measured motion
        """
    @property
    def lag_order(self) -> float:
        """
        1, or 2: nearer to a pure delay
        """
    @property
    def maximum_rate(self) -> float:
        """
        m/s, of the stroke; at 1e7 there is none
        """
    @property
    def maximum_stroke(self) -> float:
        """
        m, of the stroke in both directions; at 1e7 there is none
        """
    @property
    def name(self) -> str:
        ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, measured point, coordinates of the body
        """
    @property
    def ratio(self) -> float:
        """
        of what follows to the stroke: m/m, or rad/m
        """
    @property
    def settling(self) -> float:
        """
        s, in which the stroke returns to the motion after a bound, and brakes before its own
        """
    @property
    def winch(self) -> str:
        """
        line whose winch follows
        """
class Actuator:
    """
    State feedback on a joint coordinate q: feed_forward + stiffness (reference - q) + damping (reference rate - q rate), N (N/m, N s/m) or N m (N m/rad, N m s/rad). Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> Actuator:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> Actuator:
        ...
    def __deepcopy__(self, memo: dict) -> Actuator:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, joint: str, coordinate: str, stiffness: typing.SupportsFloat = ..., damping: typing.SupportsFloat = ..., feed_forward: Curve | typing.SupportsFloat = ..., reference: Curve | typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def coordinate(self) -> str:
        """
        one that the joint offers
        """
    @property
    def damping(self) -> float:
        """
        N s/m or N m s/rad
        """
    @property
    def feed_forward(self) -> Curve:
        """
        N or N m
        """
    @property
    def joint(self) -> str:
        """
        joint
        """
    @property
    def name(self) -> str:
        ...
    @property
    def reference(self) -> Curve:
        """
        m or rad
        """
    @property
    def stiffness(self) -> float:
        """
        N/m or N m/rad
        """
class PointForce:
    """
    A constant force at a body-fixed point, in inertial or body axes. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> PointForce:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> PointForce:
        ...
    def __deepcopy__(self, memo: dict) -> PointForce:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ..., force: numpy.typing.ArrayLike, body_axes: bool = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def body_axes(self) -> bool:
        """
        whether the force turns with the body
        """
    @property
    def force(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        N
        """
    @property
    def name(self) -> str:
        ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, body coordinates
        """
class Spring:
    """
    Tension between two body-fixed points: stiffness times elongation, or a table of tension over length, plus damping times the rate of length. Immutable.
    """
    DRAWN: typing.ClassVar[str] = 'spring'
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = True
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> Spring:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> Spring:
        ...
    def __deepcopy__(self, memo: dict) -> Spring:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., stiffness: typing.SupportsFloat = ..., damping: typing.SupportsFloat = ..., natural_length: typing.SupportsFloat = ..., lengths: numpy.typing.ArrayLike = ..., forces: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def damping(self) -> float:
        """
        N s/m
        """
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def forces(self) -> list[float]:
        """
        N, tension at the lengths
        """
    @property
    def lengths(self) -> list[float]:
        """
        m, of a table of tension, in place of stiffness
        """
    @property
    def name(self) -> str:
        ...
    @property
    def natural_length(self) -> float:
        """
        m
        """
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
    @property
    def stiffness(self) -> float:
        """
        N/m
        """
class ForceTable:
    """
    Force and moment (n, 6), N and N m, inertial axes, about a body-fixed point, over times (n,) in s; linear in between, held outside. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> ForceTable:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> ForceTable:
        ...
    def __deepcopy__(self, memo: dict) -> ForceTable:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ..., times: numpy.typing.ArrayLike, wrenches: numpy.typing.ArrayLike) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def name(self) -> str:
        ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, body coordinates
        """
    @property
    def times(self) -> list[float]:
        """
        s
        """
    @property
    def wrenches(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]"]:
        """
        N, N m, force and moment at the times
        """
class FunctionForce:
    """
    A C function called in every evaluation, by its address (numba.cfunc(...).address): void f(double t, const double* state13, const double* parameters, double* wrench6); state: position, quaternion, velocity, angular velocity of the body origin; inertial axes. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = True
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> FunctionForce:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> FunctionForce:
        ...
    def __deepcopy__(self, memo: dict) -> FunctionForce:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, address: int, parameters: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __reduce__(self) -> typing.Any:
        ...
    def __repr__(self) -> str:
        ...
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def name(self) -> str:
        ...
    @property
    def parameters(self) -> list[float]:
        """
        handed to the function
        """
class FlowForce:
    """
    Wind or current on a body by coefficients; see Scene.add_wind and Scene.add_current.
    
    F_x, F_y = density / 2 V^2 (C_x frontal_area, C_y lateral_area), N = density / 2 V^2 C_n lateral_area
    length, V the horizontal flow relative to `point`, in axes that follow the body's yaw; C over `angles`,
    where the relative flow goes, from the bow towards port, by periodic cubic splines. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> FlowForce:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> FlowForce:
        ...
    def __deepcopy__(self, memo: dict) -> FlowForce:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ..., density: typing.SupportsFloat, speed: Curve | typing.SupportsFloat, direction: typing.SupportsFloat, frontal_area: typing.SupportsFloat, lateral_area: typing.SupportsFloat, length: typing.SupportsFloat, angles: numpy.typing.ArrayLike, coefficients: numpy.typing.ArrayLike) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def angles(self) -> list[float]:
        """
        rad
        """
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def coefficients(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        C_x, C_y, C_n at the angles
        """
    @property
    def density(self) -> float:
        """
        kg/m3
        """
    @property
    def direction(self) -> float:
        """
        rad, where the flow goes, from +x towards +y
        """
    @property
    def frontal_area(self) -> float:
        """
        m2
        """
    @property
    def lateral_area(self) -> float:
        """
        m2
        """
    @property
    def length(self) -> float:
        """
        m
        """
    @property
    def name(self) -> str:
        ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, where the load acts, body coordinates
        """
    @property
    def speed(self) -> Curve:
        """
        m/s
        """
class Friction:
    """
    Dry friction on a joint coordinate: -load tanh(rate / speed); see Scene.add_friction. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = True
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> Friction:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> Friction:
        ...
    def __deepcopy__(self, memo: dict) -> Friction:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, joint: str, coordinate: str, load: typing.SupportsFloat, speed: typing.SupportsFloat) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def coordinate(self) -> str:
        """
        one that the joint offers
        """
    @property
    def joint(self) -> str:
        """
        joint
        """
    @property
    def load(self) -> float:
        """
        N or N m
        """
    @property
    def name(self) -> str:
        ...
    @property
    def speed(self) -> float:
        """
        m/s or rad/s
        """
class SoftStop:
    """
    Compliant bounds of a joint coordinate: stiffness p (1 + damping p') back where it is beyond one by p, never a pull; see Scene.add_stop. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = True
    PASSIVE: typing.ClassVar[bool] = True
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> SoftStop:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> SoftStop:
        ...
    def __deepcopy__(self, memo: dict) -> SoftStop:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, joint: str, coordinate: str, minimum: typing.SupportsFloat = ..., maximum: typing.SupportsFloat = ..., stiffness: typing.SupportsFloat, damping: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def coordinate(self) -> str:
        """
        one that the joint offers
        """
    @property
    def damping(self) -> float:
        """
        s/m or s/rad
        """
    @property
    def joint(self) -> str:
        """
        joint
        """
    @property
    def maximum(self) -> float:
        """
        m or rad, at 1e7 there is none
        """
    @property
    def minimum(self) -> float:
        """
        m or rad, at -1e7 there is none
        """
    @property
    def name(self) -> str:
        ...
    @property
    def stiffness(self) -> float:
        """
        N/m or N m/rad
        """
class Line:
    """
    An elastic line without mass over points of bodies, with a winch or without; see Scene.add_line. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> Line:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> Line:
        ...
    def __deepcopy__(self, memo: dict) -> Line:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, bodies: collections.abc.Sequence[str], points: numpy.typing.ArrayLike, EA: typing.SupportsFloat, length: Curve | typing.SupportsFloat, damping_ratio: typing.SupportsFloat = ..., mass: typing.SupportsFloat = ..., rung: str = ..., settling: typing.SupportsFloat = ..., winch: bool = ..., rate: Curve | typing.SupportsFloat = ..., maximum_rate: typing.SupportsFloat = ..., maximum_acceleration: typing.SupportsFloat = ..., lag: typing.SupportsFloat = ..., minimum_length: typing.SupportsFloat = ..., maximum_length: typing.SupportsFloat = ..., tension: Curve | typing.SupportsFloat = ..., tension_gain: typing.SupportsFloat = ..., dead_band: typing.SupportsFloat = ..., drum_inertia: typing.SupportsFloat = ..., drum_radius: typing.SupportsFloat = ..., maximum_tension: typing.SupportsFloat = ..., maximum_power: typing.SupportsFloat = ..., brake: Curve | typing.SupportsFloat = ..., brake_capacity: typing.SupportsFloat = ..., brake_give: typing.SupportsFloat = ..., radii: numpy.typing.ArrayLike = ..., axes: numpy.typing.ArrayLike = ..., turns: numpy.typing.ArrayLike = ..., efficiencies: numpy.typing.ArrayLike = ..., frictions: numpy.typing.ArrayLike = ..., slip_speed: typing.SupportsFloat = ..., strains: numpy.typing.ArrayLike = ..., tensions: numpy.typing.ArrayLike = ..., paid_out_by: str = ..., share: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def EA(self) -> float:
        """
        N, axial stiffness: tension over strain
        """
    @property
    def axes(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        of the sheaves, body coordinates; the line runs about them by the right hand
        """
    @property
    def bodies(self) -> list[str]:
        """
        bodies of the points, in the order of the path
        """
    @property
    def brake(self) -> Curve:
        """
        share of its capacity that is applied, 0 (open) to 1
        """
    @property
    def brake_capacity(self) -> float:
        """
        N, of the brake, at the rope; 0: no brake
        """
    @property
    def brake_give(self) -> float:
        """
        m, of rope, before the brake bears its capacity
        """
    @property
    def damping_ratio(self) -> float:
        """
        of critical damping of `mass` on the line
        """
    @property
    def dead_band(self) -> float:
        """
        N, on both sides of the tension, in which it stands still
        """
    @property
    def drum_inertia(self) -> float:
        """
        kg m2, of drum, gear and motor at the drum; 0: none
        """
    @property
    def drum_radius(self) -> float:
        """
        m, at which the rope runs
        """
    @property
    def efficiencies(self) -> list[float]:
        """
        of each: the smaller tension over the larger
        """
    @property
    def frictions(self) -> list[float]:
        """
        coefficients of friction on each
        """
    @property
    def lag(self) -> float:
        """
        s, of the winch's rate behind the command
        """
    @property
    def length(self) -> Curve:
        """
        m, unstretched; with a winch, at the start
        """
    @property
    def mass(self) -> float:
        """
        kg, that bounces on the line; 0: what its start tells, see LineBounce
        """
    @property
    def maximum_acceleration(self) -> float:
        """
        m/s2, likewise; needs a lag
        """
    @property
    def maximum_length(self) -> float:
        """
        m, that the drum holds: there paying out stops; at 1e7 there is no end
        """
    @property
    def maximum_power(self) -> float:
        """
        W, that the motor gives
        """
    @property
    def maximum_rate(self) -> float:
        """
        m/s, of the winch; at 1e7 there is none
        """
    @property
    def maximum_tension(self) -> float:
        """
        N, of the motor, at the rope; 0: no motor
        """
    @property
    def minimum_length(self) -> float:
        """
        m, at which hauling in stops
        """
    @property
    def name(self) -> str:
        ...
    @property
    def paid_out_by(self) -> str:
        """
        line with mass, on a winch, of which it is a segment
        """
    @property
    def points(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        m, coordinates of these bodies
        """
    @property
    def radii(self) -> list[float]:
        """
        m, of sheaves at the points; 0: a point
        """
    @property
    def rate(self) -> Curve:
        """
        m/s, commanded, positive: pays out
        """
    @property
    def rung(self) -> str:
        """
        'elastic', or 'quasi-static': its stretch follows the tension
        """
    @property
    def settling(self) -> float:
        """
        s, in which a quasi-static stretch follows
        """
    @property
    def share(self) -> float:
        """
        of the length that this winch pays out
        """
    @property
    def slip_speed(self) -> float:
        """
        m/s, at which sheaves have 76 % of their friction
        """
    @property
    def strains(self) -> list[float]:
        """
        from 0, of a table in place of EA
        """
    @property
    def tension(self) -> Curve:
        """
        N, that the winch holds: it renders above, recovers below
        """
    @property
    def tension_gain(self) -> float:
        """
        m/s/N, rate over tension beyond the band; 0: none held
        """
    @property
    def tensions(self) -> list[float]:
        """
        N, at these strains, from 0
        """
    @property
    def turns(self) -> list[float]:
        """
        whole turns on each besides
        """
    @property
    def winch(self) -> bool:
        """
        whether the length is a state that `rate` drives
        """
class GasSpring:
    """
    A cylinder with a gas accumulator between two body-fixed points, with oil damping and end stops; see Scene.add_spring. Immutable.
    """
    DRAWN: typing.ClassVar[str] = 'spring'
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = True
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = (('length', 'distance', '{} times the distance', 0.05, 20.0))
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> GasSpring:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> GasSpring:
        ...
    def __deepcopy__(self, memo: dict) -> GasSpring:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., area: typing.SupportsFloat, pressure: typing.SupportsFloat, volume: typing.SupportsFloat, length: typing.SupportsFloat, exponent: typing.SupportsFloat = ..., pushes: bool = ..., damping: typing.SupportsFloat = ..., quadratic_damping: typing.SupportsFloat = ..., minimum: typing.SupportsFloat = ..., maximum: typing.SupportsFloat = ..., stop_stiffness: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def area(self) -> float:
        """
        m2, of the piston
        """
    @property
    def damping(self) -> float:
        """
        N s/m, of the oil, times the rate of length
        """
    @property
    def exponent(self) -> float:
        """
        of the gas, p V^exponent stays: 1 slow, 1.4 nitrogen
        """
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def length(self) -> float:
        """
        m, at which pressure and volume are given
        """
    @property
    def maximum(self) -> float:
        """
        m, likewise; at 1e7 there is none
        """
    @property
    def minimum(self) -> float:
        """
        m, length at which an end stop is met; 0: none
        """
    @property
    def name(self) -> str:
        ...
    @property
    def pressure(self) -> float:
        """
        Pa, of the gas at `length`
        """
    @property
    def pushes(self) -> bool:
        """
        shortening compresses the gas, in place of lengthening
        """
    @property
    def quadratic_damping(self) -> float:
        """
        N s2/m2, times the rate times its magnitude
        """
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
    @property
    def stop_stiffness(self) -> float:
        """
        N/m, of the end stops
        """
    @property
    def volume(self) -> float:
        """
        m3, of the gas at `length`
        """
class PendulumDamping:
    """
    Damping of a load that swings below a point, as a ratio of critical; see Scene.add_spring. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = (('mass', 'mass', '{} times the mass that swings', 0.0033333333333333335, 300.0))
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> PendulumDamping:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> PendulumDamping:
        ...
    def __deepcopy__(self, memo: dict) -> PendulumDamping:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., ratio: typing.SupportsFloat, mass: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def mass(self) -> float:
        """
        kg, that swings; 0: that of the second body
        """
    @property
    def name(self) -> str:
        ...
    @property
    def ratio(self) -> float:
        """
        of critical damping of the swing
        """
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
class SpanDrag:
    """
    Drag across a straight span of wire between two points, in air or water that flows steadily. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = (('length', 'distance', '{} times the span', 0.05, 20.0))
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> SpanDrag:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> SpanDrag:
        ...
    def __deepcopy__(self, memo: dict) -> SpanDrag:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., density: typing.SupportsFloat, diameter: typing.SupportsFloat, length: typing.SupportsFloat, coefficient: typing.SupportsFloat, flow: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def coefficient(self) -> float:
        """
        drag coefficient across the wire
        """
    @property
    def density(self) -> float:
        """
        kg/m3, of the fluid
        """
    @property
    def diameter(self) -> float:
        """
        m
        """
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def flow(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m/s, velocity of the fluid, inertial axes
        """
    @property
    def length(self) -> float:
        """
        m, of wire in the span
        """
    @property
    def name(self) -> str:
        ...
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
class HydraulicCylinder:
    """
    A hydraulic cylinder between two body-fixed points, with the pressures of its chambers and its valves; see Scene.add_hydraulic_cylinder. Immutable.
    """
    DRAWN: typing.ClassVar[str] = 'cylinder'
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = True
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = True
    @staticmethod
    def example() -> HydraulicCylinder:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> HydraulicCylinder:
        ...
    def __deepcopy__(self, memo: dict) -> HydraulicCylinder:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., full_area: typing.SupportsFloat, rod_side_area: typing.SupportsFloat, retracted_length: typing.SupportsFloat, stroke: typing.SupportsFloat, pressure: typing.SupportsFloat, pressure_rod: typing.SupportsFloat, hose_volume: typing.SupportsFloat, hose_volume_rod: typing.SupportsFloat, oil_modulus: typing.SupportsFloat = ..., hose_modulus: typing.SupportsFloat = ..., cylinder_modulus: typing.SupportsFloat = ..., air: typing.SupportsFloat = ..., vapour_pressure: typing.SupportsFloat = ..., pump_pressure: typing.SupportsFloat = ..., tank_pressure: typing.SupportsFloat = ..., rated_flow: typing.SupportsFloat = ..., rated_flow_rod: typing.SupportsFloat = ..., rated_drop: typing.SupportsFloat = ..., laminar_drop: typing.SupportsFloat = ..., overlap: typing.SupportsFloat = ..., spool_lag: typing.SupportsFloat = ..., pump_check: bool = ..., makeup_flow: typing.SupportsFloat = ..., relief_pressure: typing.SupportsFloat = ..., relief_pressure_rod: typing.SupportsFloat = ..., relief_flow: typing.SupportsFloat = ..., relief_override: typing.SupportsFloat = ..., counterbalance_pressure: typing.SupportsFloat = ..., counterbalance_pressure_rod: typing.SupportsFloat = ..., counterbalance_flow: typing.SupportsFloat = ..., counterbalance_range: typing.SupportsFloat = ..., pilot_ratio: typing.SupportsFloat = ..., command: Curve | typing.SupportsFloat = ..., reference: Curve | typing.SupportsFloat = ..., gain: typing.SupportsFloat = ..., rate_gain: typing.SupportsFloat = ..., internal_leakage: typing.SupportsFloat = ..., external_leakage: typing.SupportsFloat = ..., viscous_friction: typing.SupportsFloat = ..., friction: typing.SupportsFloat = ..., friction_speed: typing.SupportsFloat = ..., stop_stiffness: typing.SupportsFloat = ..., accumulator_volume: typing.SupportsFloat = ..., accumulator_pressure: typing.SupportsFloat = ..., accumulator_flow: typing.SupportsFloat = ..., accumulator_exponent: typing.SupportsFloat = ..., rupture_time: typing.SupportsFloat = ..., rupture_area: typing.SupportsFloat = ..., rod_side_ruptures: bool = ..., discharge_coefficient: typing.SupportsFloat = ..., oil_density: typing.SupportsFloat = ..., refuse_void: bool = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def accumulator_exponent(self) -> float:
        """
        of its gas: p V^exponent stays
        """
    @property
    def accumulator_flow(self) -> float:
        """
        m3/s, through its throttle at `rated_drop`
        """
    @property
    def accumulator_pressure(self) -> float:
        """
        Pa, of its gas without oil
        """
    @property
    def accumulator_volume(self) -> float:
        """
        m3, of gas, without oil, in an accumulator on the full side; 0: none
        """
    @property
    def air(self) -> float:
        """
        share of the volume that is free air at 1e5 Pa
        """
    @property
    def command(self) -> Curve:
        """
        of the spool, -1 (retracts) to 1 (extends)
        """
    @property
    def counterbalance_flow(self) -> float:
        """
        m3/s, of a load-holding valve, open, at `rated_drop`
        """
    @property
    def counterbalance_pressure(self) -> float:
        """
        Pa, at which the full side's load-holding valve opens without pilot; 0: none
        """
    @property
    def counterbalance_pressure_rod(self) -> float:
        """
        Pa, the rod side's; 0: none
        """
    @property
    def counterbalance_range(self) -> float:
        """
        Pa, from its opening to fully open
        """
    @property
    def cylinder_modulus(self) -> float:
        """
        Pa, of the barrel, likewise
        """
    @property
    def discharge_coefficient(self) -> float:
        """
        of the hole
        """
    @property
    def external_leakage(self) -> float:
        """
        m3/s/Pa, from each side to the tank
        """
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def friction(self) -> float:
        """
        N, of the seals, dry
        """
    @property
    def friction_speed(self) -> float:
        """
        m/s, about which dry friction changes its sign
        """
    @property
    def full_area(self) -> float:
        """
        m2, of the piston, full side
        """
    @property
    def gain(self) -> float:
        """
        1/m, spool over the stroke that is missing; 0: open loop
        """
    @property
    def hose_modulus(self) -> float:
        """
        Pa, of the hoses, by their volume
        """
    @property
    def hose_volume(self) -> float:
        """
        m3, of the full side: hose and what the stroke leaves
        """
    @property
    def hose_volume_rod(self) -> float:
        """
        m3, of the rod side, likewise
        """
    @property
    def internal_leakage(self) -> float:
        """
        m3/s/Pa, past the piston
        """
    @property
    def laminar_drop(self) -> float:
        """
        Pa, about which flow turns from linear to square root
        """
    @property
    def makeup_flow(self) -> float:
        """
        m3/s, of the check valves from the tank at `rated_drop`; 0: none
        """
    @property
    def name(self) -> str:
        ...
    @property
    def oil_density(self) -> float:
        """
        kg/m3, that leaves through the hole
        """
    @property
    def oil_modulus(self) -> float:
        """
        Pa, bulk modulus of the oil without air
        """
    @property
    def overlap(self) -> float:
        """
        share of the spool's travel before an edge opens
        """
    @property
    def pilot_ratio(self) -> float:
        """
        of the other side's pressure in its opening
        """
    @property
    def pressure(self) -> float:
        """
        Pa, of the full side at the start, absolute
        """
    @property
    def pressure_rod(self) -> float:
        """
        Pa, of the rod side, likewise
        """
    @property
    def pump_check(self) -> bool:
        """
        whether a check valve keeps oil from the pump
        """
    @property
    def pump_pressure(self) -> float:
        """
        Pa, of the supply, absolute; 0: no pump
        """
    @property
    def rate_gain(self) -> float:
        """
        s/m, spool over the rate of the reference
        """
    @property
    def rated_drop(self) -> float:
        """
        Pa, at which flows are rated
        """
    @property
    def rated_flow(self) -> float:
        """
        m3/s, of the valve's edges to the full side, open, at `rated_drop`; 0: no valve
        """
    @property
    def rated_flow_rod(self) -> float:
        """
        m3/s, of those to the rod side; 0: the same
        """
    @property
    def reference(self) -> Curve:
        """
        m, stroke that the spool is to follow
        """
    @property
    def refuse_void(self) -> bool:
        """
        whether a run ends where oil boils
        """
    @property
    def relief_flow(self) -> float:
        """
        m3/s, of a relief valve at `relief_override`
        """
    @property
    def relief_override(self) -> float:
        """
        Pa, above the opening
        """
    @property
    def relief_pressure(self) -> float:
        """
        Pa, at which the full side's relief valve opens; 0: none
        """
    @property
    def relief_pressure_rod(self) -> float:
        """
        Pa, the rod side's; 0: none
        """
    @property
    def retracted_length(self) -> float:
        """
        m, between the points at stroke 0
        """
    @property
    def rod_side_area(self) -> float:
        """
        m2, of the piston less the rod
        """
    @property
    def rod_side_ruptures(self) -> bool:
        """
        in place of the full side
        """
    @property
    def rupture_area(self) -> float:
        """
        m2, of the hole
        """
    @property
    def rupture_time(self) -> float:
        """
        s, at which a hose bursts; at 1e7 none does
        """
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
    @property
    def spool_lag(self) -> float:
        """
        s, of the spool behind its command, first order; 0: none
        """
    @property
    def stop_stiffness(self) -> float:
        """
        N/m, of the ends of the stroke
        """
    @property
    def stroke(self) -> float:
        """
        m, largest
        """
    @property
    def tank_pressure(self) -> float:
        """
        Pa, absolute
        """
    @property
    def vapour_pressure(self) -> float:
        """
        Pa, below it the oil boils: an event
        """
    @property
    def viscous_friction(self) -> float:
        """
        N s/m, of the seals
        """
class ImmersedPart:
    """
    Water on a part of a body: buoyancy, added mass over depth, slam, drag; see Scene.add_immersed. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> ImmersedPart:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> ImmersedPart:
        ...
    def __deepcopy__(self, memo: dict) -> ImmersedPart:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, shape: str = ..., point: numpy.typing.ArrayLike = ..., axes: numpy.typing.ArrayLike = ..., size: numpy.typing.ArrayLike, fill: typing.SupportsFloat = ..., density: typing.SupportsFloat, depths: numpy.typing.ArrayLike, added_masses: numpy.typing.ArrayLike, volumes: numpy.typing.ArrayLike = ..., drag: numpy.typing.ArrayLike = ..., row: str = ..., place: typing.SupportsFloat = ..., count: typing.SupportsFloat = ..., step: numpy.typing.ArrayLike = ..., wave_factor: typing.SupportsFloat = ..., source: str = ..., slow_added_masses: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def added_masses(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        kg, along its axes, at the depths
        """
    @property
    def axes(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        columns: its axes in those of the body
        """
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def count(self) -> float:
        """
        strips of its row
        """
    @property
    def density(self) -> float:
        """
        kg/m3, of the water
        """
    @property
    def depths(self) -> list[float]:
        """
        m, of its lowest point below the surface, from 0
        """
    @property
    def drag(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        N s2/m2, density / 2 times C_D times area, along its axes
        """
    @property
    def fill(self) -> float:
        """
        share of its volume that keeps water out
        """
    @property
    def name(self) -> str:
        ...
    @property
    def place(self) -> float:
        """
        in its row, from 0
        """
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, its centre, body coordinates
        """
    @property
    def row(self) -> str:
        """
        name of a row of strips at equal steps, for which the sea is summed at once
        """
    @property
    def shape(self) -> str:
        """
        'box', 'cylinder', 'disc', 'sphere' or 'table'
        """
    @property
    def size(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, along its axes; of a cylinder, its length and twice its diameter; of a disc, an end of one that looks along x, first the depth over which it gains its water facing up
        """
    @property
    def slow_added_masses(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        kg, at zero frequency, at the depths: what slow waves feel, for answers.scattered
        """
    @property
    def source(self) -> str:
        """
        where its coefficients are from
        """
    @property
    def step(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, from strip to strip of its row, body coordinates
        """
    @property
    def volumes(self) -> list[float]:
        """
        m3, of a table: what is wet, at the depths
        """
    @property
    def wave_factor(self) -> float:
        """
        times the waves of the sea: what a hull beside makes of them
        """
class EntrappedWater:
    """
    Water in a compartment of a body, which comes and goes through openings; see Scene.add_immersed. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> EntrappedWater:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> EntrappedWater:
        ...
    def __deepcopy__(self, memo: dict) -> EntrappedWater:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ..., area: typing.SupportsFloat, height: typing.SupportsFloat, opening_points: numpy.typing.ArrayLike, opening_areas: numpy.typing.ArrayLike, air: str, exponent: typing.SupportsFloat = ..., air_pressure: typing.SupportsFloat = ..., discharge_coefficient: typing.SupportsFloat = ..., initial: typing.SupportsFloat = ..., density: typing.SupportsFloat, wave_factor: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def air(self) -> str:
        """
        above the water: free, vented, or shut in
        """
    @property
    def air_pressure(self) -> float:
        """
        Pa, absolute, of air that is shut in, at the start
        """
    @property
    def area(self) -> float:
        """
        m2, of its section, the same at every height
        """
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def density(self) -> float:
        """
        kg/m3, of the water
        """
    @property
    def discharge_coefficient(self) -> float:
        """
        C_d: share of an opening's area that the jet fills
        """
    @property
    def exponent(self) -> float:
        """
        of air that is shut in: p V^exponent stays
        """
    @property
    def height(self) -> float:
        """
        m, along the body's z
        """
    @property
    def initial(self) -> float:
        """
        m3, of water in it at the start
        """
    @property
    def name(self) -> str:
        ...
    @property
    def opening_areas(self) -> list[float]:
        """
        m2, of the openings
        """
    @property
    def opening_points(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        m, centres of its openings, body coordinates
        """
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, centre of its bottom, body coordinates
        """
    @property
    def wave_factor(self) -> float:
        """
        times the waves of the sea: what a hull beside makes of them
        """
class ImmersedSpan:
    """
    Water on a straight span of wire between two points: buoyancy, added mass, drag; see Scene.add_line. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> ImmersedSpan:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> ImmersedSpan:
        ...
    def __deepcopy__(self, memo: dict) -> ImmersedSpan:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., density: typing.SupportsFloat, diameter: typing.SupportsFloat, length: Curve | typing.SupportsFloat, added_mass_coefficient: typing.SupportsFloat = ..., drag_coefficient: typing.SupportsFloat, drag_coefficient_along: typing.SupportsFloat = ..., source: str = ..., paid_out_by: str = ..., share: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def added_mass_coefficient(self) -> float:
        """
        C_a: added mass across, over the water that it displaces
        """
    @property
    def density(self) -> float:
        """
        kg/m3, of the water
        """
    @property
    def diameter(self) -> float:
        """
        m
        """
    @property
    def drag_coefficient(self) -> float:
        """
        across, over the diameter
        """
    @property
    def drag_coefficient_along(self) -> float:
        """
        along, over the skin
        """
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def length(self) -> Curve:
        """
        m, of wire in the span, a number or a Curve
        """
    @property
    def name(self) -> str:
        ...
    @property
    def paid_out_by(self) -> str:
        """
        line with mass, on a winch, that it is a part of
        """
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
    @property
    def share(self) -> float:
        """
        of the length that this winch pays out
        """
    @property
    def source(self) -> str:
        """
        where its coefficients are from
        """
class WoundSpan:
    """
    A segment of a line with mass that is paid out and hauled in: the mass that its ends gain, and that moves past them; see Scene.add_line. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> WoundSpan:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> WoundSpan:
        ...
    def __deepcopy__(self, memo: dict) -> WoundSpan:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, first: str, second: str, first_point: numpy.typing.ArrayLike = ..., second_point: numpy.typing.ArrayLike = ..., mass_per_length: typing.SupportsFloat, length: Curve | typing.SupportsFloat, below_first: typing.SupportsFloat, below_second: typing.SupportsFloat, paid_out_by: str = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def below_first(self) -> float:
        """
        share of the line beyond the first end
        """
    @property
    def below_second(self) -> float:
        """
        and beyond the second end, which is less
        """
    @property
    def first(self) -> str:
        """
        body
        """
    @property
    def first_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the first body
        """
    @property
    def length(self) -> Curve:
        """
        m, unstretched, of the segment; with a winch, that whose mass its ends have
        """
    @property
    def mass_per_length(self) -> float:
        """
        kg/m
        """
    @property
    def name(self) -> str:
        ...
    @property
    def paid_out_by(self) -> str:
        """
        line with mass, on a winch, that it is a part of
        """
    @property
    def second(self) -> str:
        """
        body
        """
    @property
    def second_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, coordinates of the second body
        """
class SeabedNode:
    """
    A level seabed under a point of a line: it bears, and holds by friction; see Scene.add_line. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = True
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> SeabedNode:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> SeabedNode:
        ...
    def __deepcopy__(self, memo: dict) -> SeabedNode:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, point: numpy.typing.ArrayLike = ..., depth: typing.SupportsFloat, stiffness: typing.SupportsFloat, damping: typing.SupportsFloat = ..., friction: typing.SupportsFloat = ..., load: typing.SupportsFloat = ..., give: typing.SupportsFloat = ..., anchor: numpy.typing.ArrayLike = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def anchor(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, place, inertial axes, that it holds at the start; z is left out
        """
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def damping(self) -> float:
        """
        s/m, share of the force for each m/s of sinking in
        """
    @property
    def depth(self) -> float:
        """
        m, of the seabed below z = 0
        """
    @property
    def friction(self) -> float:
        """
        Coulomb's coefficient
        """
    @property
    def give(self) -> float:
        """
        m, that it slides under this load before friction is full
        """
    @property
    def load(self) -> float:
        """
        N, that it bears at rest
        """
    @property
    def name(self) -> str:
        ...
    @property
    def point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, body coordinates
        """
    @property
    def stiffness(self) -> float:
        """
        N/m, of the seabed under the point
        """
class Contact:
    """
    Points of a body against the surface of another, which presses and rubs; see Scene.add_contact. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = True
    PASSIVE: typing.ClassVar[bool] = False
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    @staticmethod
    def example() -> Contact:
        """
        One for checks, on bodies 'first', 'second' and 'third'.
        """
    def __copy__(self) -> Contact:
        ...
    def __deepcopy__(self, memo: dict) -> Contact:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, on: str, points: numpy.typing.ArrayLike, surface: str = ..., place: numpy.typing.ArrayLike = ..., axes: numpy.typing.ArrayLike = ..., size: numpy.typing.ArrayLike = ..., edge: typing.SupportsFloat = ..., stiffness: typing.SupportsFloat, damping: typing.SupportsFloat = ..., compressions: numpy.typing.ArrayLike = ..., forces: numpy.typing.ArrayLike = ..., friction: typing.SupportsFloat = ..., shear_stiffness: typing.SupportsFloat = ..., shear_damping: typing.SupportsFloat = ..., hold: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def distance(self, point: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]) -> tuple[float, typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]]:
        """
        How far a point in axes of the surface, from its place, is outside (m; negative: inside), and the way out.
        """
    @property
    def axes(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 3]"]:
        """
        columns: its axes in those of on; z away from a plane, along a post
        """
    @property
    def body(self) -> str:
        """
        whose points they are
        """
    @property
    def compressions(self) -> list[float]:
        """
        m, of a table, from 0, in place of stiffness
        """
    @property
    def damping(self) -> float:
        """
        s/m, force = elastic force (1 + damping rate)
        """
    @property
    def edge(self) -> float:
        """
        m, radius of its edges
        """
    @property
    def forces(self) -> list[float]:
        """
        N, elastic force at the compressions
        """
    @property
    def friction(self) -> float:
        """
        coefficient, of sticking and of sliding
        """
    @property
    def hold(self) -> float:
        """
        m, that a point gives before it slides: errors of anchors count over it
        """
    @property
    def name(self) -> str:
        ...
    @property
    def on(self) -> str:
        """
        whose surface it is
        """
    @property
    def place(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, of a plane one of its points, else its centre; coordinates of on
        """
    @property
    def points(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        m, body coordinates
        """
    @property
    def shear_damping(self) -> float:
        """
        N s/m, likewise
        """
    @property
    def shear_stiffness(self) -> float:
        """
        N/m, of each point, while it sticks
        """
    @property
    def size(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        m, of a box along its axes; of a post or pipe its inner and outer diameter, and its length
        """
    @property
    def stiffness(self) -> float:
        """
        N/m, of each point; not used beside a table
        """
    @property
    def surface(self) -> str:
        """
        'plane', 'box', 'post' or 'pipe'
        """
class Limit:
    """
    What a joint does one way only; see Scene.add_line and add_stop. Immutable.
    """
    DRAWN: typing.ClassVar[str] = ''
    FIELDS: typing.ClassVar[tuple]
    HOLDS: typing.ClassVar[bool] = False
    OWN_PACE: typing.ClassVar[bool] = False
    PASSIVE: typing.ClassVar[bool] = True
    PROPORTIONS: typing.ClassVar[tuple] = tuple()
    STIFF: typing.ClassVar[bool] = False
    def __copy__(self) -> Limit:
        ...
    def __deepcopy__(self, memo: dict) -> Limit:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, kind: str, joint: str, coordinate: str = ..., minimum: typing.SupportsFloat = ..., maximum: typing.SupportsFloat = ..., restitution: typing.SupportsFloat = ..., sticking_speed: typing.SupportsFloat = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def coordinate(self) -> str:
        """
        one that the joint offers
        """
    @property
    def joint(self) -> str:
        """
        joint
        """
    @property
    def kind(self) -> str:
        """
        wire, stop or seat
        """
    @property
    def maximum(self) -> float:
        """
        m or rad, at 1e7 there is none
        """
    @property
    def minimum(self) -> float:
        """
        m or rad, at -1e7 there is none
        """
    @property
    def name(self) -> str:
        ...
    @property
    def restitution(self) -> float:
        """
        0 to 1
        """
    @property
    def sticking_speed(self) -> float:
        """
        m/s or rad/s, slower impacts do not rebound
        """
class StateSpaceBlock:
    """
    Fluid memory x' = A x + B u, mu = C x + D u between motions 0 (surge) ... 5 (yaw), of a group six for each vessel in turn, eqs (29)-(30).
    """
    def __copy__(self) -> StateSpaceBlock:
        ...
    def __deepcopy__(self, memo: dict) -> StateSpaceBlock:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, inputs: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], outputs: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], a: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], b: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], c: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], d: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], state_scale: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 1]"] = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def a(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
    @property
    def b(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
    @property
    def c(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
    @property
    def d(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        ...
    @property
    def inputs(self) -> list[int]:
        ...
    @property
    def outputs(self) -> list[int]:
        ...
    @property
    def state_scale(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        ...
class RetardationFunctions:
    """
    Fluid memory by direct convolution, mu_j(t) = sum_k integral K_jk(tau) v_k(t - tau) dtau: kernel (n, 6, 6) at tau = 0, step, 2 step ... in s, cubic in between, zero beyond. Motions 0 (surge) ... 5 (yaw); the motion is sampled at the same step.
    """
    def __copy__(self) -> RetardationFunctions:
        ...
    def __deepcopy__(self, memo: dict) -> RetardationFunctions:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, step: typing.SupportsFloat | typing.SupportsIndex, kernel: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def kernel(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (n, 6, 6), N and N m per m/s and rad/s and s, copy
        """
    @property
    def step(self) -> float:
        """
        s
        """
class VesselHydrodynamics:
    """
    Linear hydrodynamics of a body about its origin (the reference point). Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> VesselHydrodynamics:
        ...
    def __deepcopy__(self, memo: dict) -> VesselHydrodynamics:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, body: str, added_mass: numpy.typing.ArrayLike = ..., linear_damping: numpy.typing.ArrayLike = ..., quadratic_damping: numpy.typing.ArrayLike = ..., restoring: numpy.typing.ArrayLike = ..., mooring_stiffness: numpy.typing.ArrayLike = ..., mooring_damping: numpy.typing.ArrayLike = ..., memory: typing.Any = ..., kinematics: str = ..., floats: bool = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def added_mass(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[6, 6]"]:
        """
        kg, kg m, kg m2
        """
    @property
    def body(self) -> str:
        """
        body
        """
    @property
    def floats(self) -> bool:
        """
        whether `restoring` holds weight and buoyancy; else it weighs
        """
    @property
    def kinematics(self) -> str:
        """
        yaw_following, or paper: eqs (17)-(31)
        """
    @property
    def linear_damping(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[6, 6]"]:
        """
        N s/m, N s, N m s
        """
    @property
    def memory(self) -> list[StateSpaceBlock] | RetardationFunctions:
        """
        blocks of states, or retardation functions
        """
    @property
    def mooring_damping(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        N s/m, N m s/rad, of surge, sway, yaw
        """
    @property
    def mooring_stiffness(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        N/m, N m/rad, of surge, sway, yaw
        """
    @property
    def name(self) -> str:
        ...
    @property
    def quadratic_damping(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[6, 1]"]:
        """
        N s2/m2, N m s2
        """
    @property
    def restoring(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[6, 6]"]:
        """
        N/m, N, N m, of heave, roll and pitch alone
        """
class GroupHydrodynamics:
    """
    Vessels that load each other through the water, over six motions of each in turn. Immutable.
    """
    FIELDS: typing.ClassVar[tuple]
    def __copy__(self) -> GroupHydrodynamics:
        ...
    def __deepcopy__(self, memo: dict) -> GroupHydrodynamics:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, name: str, *, vessels: collections.abc.Sequence[str], added_mass: numpy.typing.ArrayLike = ..., memory: typing.Any = ...) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def added_mass(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        kg, kg m, kg m2, (6n, 6n) between vessels, zero of each with itself; empty: none
        """
    @property
    def memory(self) -> list[StateSpaceBlock]:
        """
        blocks of states over all motions
        """
    @property
    def name(self) -> str:
        ...
    @property
    def vessels(self) -> list[str]:
        """
        two or more, whose own memory is empty where the group has one
        """
class Model:
    """
    A compiled scene: immutable, shareable between threads.
    """
    def __copy__(self) -> typing.Any:
        ...
    def __deepcopy__(self, memo: dict) -> typing.Any:
        ...
    def __reduce__(self) -> tuple[typing.Any, tuple]:
        ...
    def __repr__(self) -> str:
        ...
    def channel_names(self, defaults_only: bool = True) -> list[str]:
        ...
    def channel_values(self, names: collections.abc.Set[str]) -> int:
        """
        How many numbers one output of these channels holds.
        """
    def in_sea(self, wave_loads: collections.abc.Sequence[WaveLoads], sea: SeaField = None) -> Model:
        """
        The model of the same scene with other wave loads on the same vessels, in another field, as compiling it again gives. Raises SceneError.
        """
    def pose_index(self, body: typing.SupportsInt | typing.SupportsIndex) -> int:
        ...
    def twist_index(self, body: typing.SupportsInt | typing.SupportsIndex) -> int:
        ...
    @property
    def assembly(self) -> dict:
        ...
    @property
    def axes(self) -> dict[str, list[str]]:
        """
        The names along each dimension of its channels but time.
        """
    @property
    def baumgarte(self) -> float:
        ...
    @property
    def bodies(self) -> list[str]:
        ...
    @property
    def breakpoints(self) -> list[float]:
        """
        Times (s) at which curves of drivers and loads are not smooth.
        """
    @property
    def compiled_from(self) -> tuple:
        """
        The scene as it was, and whether bodies were merged.
        """
    @compiled_from.setter
    def compiled_from(self, arg1: tuple) -> None:
        ...
    @property
    def constraints(self) -> int:
        ...
    @property
    def coordinates(self) -> int:
        ...
    @property
    def degrees_of_freedom(self) -> int:
        ...
    @property
    def elements(self) -> list[tuple[str, str, int, bool]]:
        """
        (name, kind, rows, whether the reaction is unique) of joints, then drivers.
        """
    @property
    def euler_angles(self) -> bool:
        """
        Whether the state holds XYZ Euler angles.
        """
    @property
    def history_samples(self) -> int:
        """
        Points in time at which convolutions keep the motion of their vessels.
        """
    @property
    def initial_state(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Consistent start (copy): poses, twists, memory states, states of loads, work.
        """
    @property
    def inputs(self) -> list[tuple[str, int, int]]:
        """
        (name, first slot, number of slots) of the zero-order-held inputs.
        """
    @property
    def kinks(self) -> list[tuple[float, typing.Annotated[list[float], "FixedSize(4)"]]]:
        """
        (time, jumps) by time, one for each curve that is not smooth there: of velocity, acceleration and its first two derivatives, at the described start, over the scale of the state (1/s^p).
        """
    @property
    def limits(self) -> list[tuple[str, bool]]:
        """
        (name, whether it holds at the described start) of wires, bounds and seats, in the order of the channel limit_force.
        """
    @property
    def line_bounces(self) -> dict[str, tuple[float, float, float]]:
        """
        By line: the mass (kg) that bounces on it at the start, as on one fall, the frequency of that (rad/s), and the ratio of critical damping that the lines give it.
        """
    @property
    def load_states(self) -> list[tuple[str, str, int, float, float]]:
        """
        (name, unit, place in the state, start, scale of errors) of the states that loads have of their own; they are the last of the memory states.
        """
    @property
    def memory_states(self) -> int:
        ...
    @property
    def merge(self) -> dict:
        """
        What runs step: bodies merged by the one that carries them, drivers that lock a joint, elements dropped, coordinates and constraints of formulation 'redundant'.
        """
    @property
    def name(self) -> str:
        ...
    @property
    def paper_kinematics(self) -> bool:
        ...
    @property
    def redundant(self) -> list[str]:
        """
        Names of elements whose reactions are not unique.
        """
    @property
    def scale(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Typical magnitude per state (copy); infinity: outside the error norm.
        """
    @property
    def slots(self) -> int:
        ...
    @property
    def states(self) -> int:
        ...
    @property
    def tree(self) -> dict:
        """
        What formulation 'recursive' makes of the scene: clusters, struts (cylinder loops in closed form), positions, speeds, driven (drivers whose coordinate is a function of time and no unknown), loop_rows (rows left to close), loop_trees (trees, each with a root of its own, that they couple).
        """
class Evaluator:
    """
    Evaluates a compiled model at single states (t in s, y as Model.initial_state).
    """
    def __init__(self, model: Model, formulation: str = 'redundant') -> None:
        ...
    def __repr__(self) -> str:
        ...
    def accelerations(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]"]:
        """
        Accelerations of the bodies' state points by the formulation, m/s2 and rad/s2, (bodies, 6).
        """
    def condition(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> float:
        """
        How many times larger the terms are than what they cancel to, of inertias along the tree of the recursive formulation and of its loops: the digits that light bodies between heavy ones cost.
        """
    def derivative(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        dy/dt, a new array.
        """
    def energy(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> float:
        """
        Mechanical energy, J.
        """
    def jacobian(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        Exact d(dy/dt)/dy (n, n), a new array: automatic differentiation, differences only for function forces; the history of a convolution is held. ValueError where there is none.
        """
    def project(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
        """
        y on the constraints, a new array.
        """
    def repeat(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], count: typing.SupportsInt | typing.SupportsIndex, dt: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        """
        Evaluates `count` times, advancing t by dt; for timing.
        """
    def residual(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> tuple[float, float]:
        """
        Largest constraint residuals (position in m or rad, rate per s).
        """
    def terms(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> dict:
        """
        Dense mass, jacobian, gamma, phi, load, acceleration, multipliers of eq (9).
        """
    def time_parts(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], count: typing.SupportsInt | typing.SupportsIndex = 2000) -> dict:
        """
        Nanoseconds per evaluation by part.
        """
class Integrator:
    """
    What an integration method is; see `integrators`.
    """
    def __repr__(self) -> str:
        ...
    @property
    def default(self) -> float:
        """
        That setting without a choice of the user: a tolerance, or s.
        """
    @property
    def dense_order(self) -> int:
        """
        Of the solution inside a step; 0: it varies.
        """
    @property
    def error_order(self) -> int:
        """
        Of the embedded method that estimates the error; 0: there is none.
        """
    @property
    def has_spectral_radius(self) -> bool:
        """
        `spectral_radius` can be chosen.
        """
    @property
    def joints(self) -> str:
        """
        How it keeps joints closed, in words.
        """
    @property
    def kind(self) -> str:
        """
        What it is, in words.
        """
    @property
    def lowest_order(self) -> int:
        """
        That of `order`, unless the order varies.
        """
    @property
    def name(self) -> str:
        """
        By which `simulate` takes it.
        """
    @property
    def order(self) -> int:
        """
        The highest one for a method of variable order.
        """
    @property
    def purpose(self) -> str:
        """
        What it is there for, in words.
        """
    @property
    def residual_form(self) -> bool:
        """
        It solves the residual form, which formulation "redundant" has.
        """
    @property
    def restarts(self) -> bool:
        """
        It loses its history where a run continues from a state, or is changed.
        """
    @property
    def setting(self) -> str:
        """
        What sets its accuracy: "rtol", or the "dt" of its steps.
        """
    @property
    def stable_up_to(self) -> float:
        """
        |eigenvalue| times step up to which an oscillation does not grow, of explicit methods of fixed step; 0: no such limit.
        """
    @property
    def uses_jacobian(self) -> bool:
        """
        It solves with the Jacobian, so that fast modes do not limit its steps.
        """
class Channel:
    """
    A quantity that can be recorded.
    """
    def __repr__(self) -> str:
        ...
    @property
    def by_default(self) -> bool:
        """
        Whether it is recorded unasked.
        """
    @property
    def dims(self) -> list[str]:
        """
        Dimensions after time.
        """
    @property
    def dims_of_several(self) -> list[str]:
        """
        The same where a scene holds several of what it has one of otherwise, such as vessels.
        """
    @property
    def has_extremes(self) -> bool:
        """
        Whether least and largest values between outputs can be kept of it.
        """
    @property
    def name(self) -> str:
        ...
    @property
    def text(self) -> str:
        ...
    @property
    def unit(self) -> str:
        ...
class TwistHistory:
    """
    What a convolution keeps of a vessel's motion, in the frame that follows yaw: `recent` (3, 6) at the newest samples, `quadrature` (n, 6) at the quadrature points of the past, newest first; at rest before `start` (s), `intervals` steps of the convolution ago.
    """
    def __copy__(self) -> TwistHistory:
        ...
    def __deepcopy__(self, memo: dict) -> TwistHistory:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, start: typing.SupportsFloat | typing.SupportsIndex, intervals: typing.SupportsInt | typing.SupportsIndex, recent: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 6]"], quadrature: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, 6]"]) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def intervals(self) -> int:
        ...
    @property
    def quadrature(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]"]:
        """
        m/s and rad/s, copy
        """
    @property
    def recent(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 6]"]:
        """
        m/s and rad/s, copy
        """
    @property
    def start(self) -> float:
        """
        s
        """
class StepHistory:
    """
    What an integrator keeps from step to step, in the coordinates of a formulation, and the rate of the state: a run with the same settings continues bit for bit (methods of SUNDIALS restart). Another formulation, integrator or scene, or other values or inputs, start from the values alone.
    """
    def __copy__(self) -> StepHistory:
        ...
    def __deepcopy__(self, memo: dict) -> StepHistory:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, formulation: str, integrator: str, values: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rate: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], kink: typing.SupportsFloat | typing.SupportsIndex | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def formulation(self) -> str:
        ...
    @property
    def integrator(self) -> str:
        ...
    @property
    def kink(self) -> float | None:
        """
        Where a step that is taken again is to end, at a kink of a load in the state, s; None: nowhere.
        """
    @property
    def rate(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        copy
        """
    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        copy
        """
class RecordHistory:
    """
    What recording keeps from output to output, used where `steps` is: energy and work (J) that energy_balance is counted from, the largest residual before projection since the last output (m or rad), energy lost in impacts (J), the last recorded quaternions, and least and largest values since the last output.
    """
    def __copy__(self) -> RecordHistory:
        ...
    def __deepcopy__(self, memo: dict) -> RecordHistory:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, start_energy: typing.SupportsFloat | typing.SupportsIndex, start_work: typing.SupportsFloat | typing.SupportsIndex, residual: typing.SupportsFloat | typing.SupportsIndex, impact_loss: typing.SupportsFloat | typing.SupportsIndex, quaternions: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], extremes: typing.Annotated[numpy.typing.ArrayLike, numpy.float64] = []) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    @property
    def extremes(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Least and largest values since the last output, and the steps before; a copy.
        """
    @property
    def impact_loss(self) -> float:
        """
        J
        """
    @property
    def quaternions(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        copy
        """
    @property
    def residual(self) -> float:
        """
        m or rad
        """
    @property
    def start_energy(self) -> float:
        """
        J
        """
    @property
    def start_work(self) -> float:
        """
        J
        """
class RunOptions:
    """
    Formulation and method of a run, and what it records. `scaled_tolerance`: local error of a step in units of the scale of each state (Model.scale). None: of `fixed_step` and `spectral_radius` the method's own, of `max_step` and `energy_limit` no limit, of `capacity` memory for all outputs. `extremes`: those of the channels of which least and largest values between outputs are kept, where the core has them (Channel.has_extremes). `trail`: those whose values at every step are kept, where they follow from a state.
    """
    def __init__(self, *, formulation: str = 'redundant', integrator: str, scaled_tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06, fixed_step: typing.SupportsFloat | typing.SupportsIndex | None = None, max_step: typing.SupportsFloat | typing.SupportsIndex | None = None, spectral_radius: typing.SupportsFloat | typing.SupportsIndex | None = None, energy_limit: typing.SupportsFloat | typing.SupportsIndex | None = None, output_times: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], channels: collections.abc.Set[str], extremes: collections.abc.Set[str] = set(), trail: collections.abc.Set[str] = set(), capacity: typing.SupportsInt | typing.SupportsIndex | None = None) -> None:
        ...
    def __repr__(self) -> str:
        ...
class State:
    """
    Time (s), state values and inputs of a run; a copy is a checkpoint.
    """
    @staticmethod
    def load(path: typing.Any, *, scene: typing.Any = None) -> State:
        """
        Reads what save() wrote; FileFormatError for a damaged file, and for a state of other parts than those of `scene`, where one is given.
        """
    def __copy__(self) -> State:
        ...
    def __deepcopy__(self, memo: dict) -> State:
        ...
    def __eq__(self, arg0: typing.Any) -> typing.Any:
        ...
    def __getstate__(self) -> dict:
        ...
    def __hash__(self) -> int:
        ...
    def __init__(self, *, time: typing.SupportsFloat | typing.SupportsIndex, values: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], inputs: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], histories: collections.abc.Sequence[TwistHistory] = [], steps: StepHistory = ..., closed: collections.abc.Sequence[str] | None = None, record: RecordHistory | None = None, parts: collections.abc.Sequence[str] = []) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def __setstate__(self, arg0: dict) -> None:
        ...
    def save(self, path: typing.Any) -> None:
        """
        Writes the state to a file, complete or not at all; see docs/restart.md.
        """
    def with_load_states(self, values: collections.abc.Mapping[str, typing.SupportsFloat | typing.SupportsIndex]) -> State:
        """
        The same state with other values of states of loads, by name; a run starts from it afresh.
        """
    @property
    def closed(self) -> list[str] | None:
        """
        Names of the limits that hold (copy); None: as at the described start.
        """
    @property
    def histories(self) -> list[TwistHistory]:
        """
        One TwistHistory per vessel with a convolution (copies); none: at rest before `time`.
        """
    @property
    def inputs(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        copy
        """
    @property
    def load_states(self) -> dict:
        """
        The states that loads have of their own, by name, such as a winch's "hoist.length" (copy).
        """
    @property
    def parts(self) -> list[str]:
        """
        What the values belong to, in words; a run of a scene with other parts refuses the state. Empty: not known.
        """
    @property
    def record(self) -> RecordHistory | None:
        """
        RecordHistory (copy), or None.
        """
    @property
    def steps(self) -> StepHistory:
        """
        StepHistory (copy); its names are empty: none.
        """
    @property
    def time(self) -> float:
        ...
    @property
    def values(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        copy
        """
class Simulation:
    """
    One run of a model: advance(), inputs, recorded channels. Threads may share it: one at a time is inside; advance() lets the others in every 20 ms, between two steps. In a with statement it is this thread's until the end of it.
    """
    def __enter__(self) -> typing.Any:
        ...
    def __exit__(self, arg0: typing.Any, arg1: typing.Any, arg2: typing.Any) -> None:
        ...
    def __init__(self, *, model: Model, start: State, options: RunOptions) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def advance(self, t_end: typing.SupportsFloat | typing.SupportsIndex, progress: typing.Any = None) -> bool:
        """
        Steps to t_end (s) without the GIL; returns False when Ctrl-C stopped it, or the interpreter ends. progress(time) is called now and then. SimulationError while the run is advanced already.
        """
    def channels(self, most: typing.SupportsInt | typing.SupportsIndex = 9223372036854775807) -> dict:
        """
        Recorded arrays by name, time first (copies), of no more than the first `most` outputs.
        """
    def drop(self, count: typing.SupportsInt | typing.SupportsIndex) -> None:
        """
        Drops the first `count` outputs recorded.
        """
    def events(self) -> list:
        """
        (time in s, limit, kind, speed of approach in m/s or rad/s, impulse in N s or N m s, energy lost in J) of all events so far.
        """
    def extremes(self, most: typing.SupportsInt | typing.SupportsIndex = 9223372036854775807) -> dict:
        """
        Least and largest values by channel, at each output those since the output before (copies).
        """
    def set_inputs(self, slots: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> None:
        """
        Sets the zero-order-held inputs from now on.
        """
    def snapshot(self) -> dict:
        """
        All channels at the present time, arrays of one row.
        """
    def statistics(self) -> dict:
        ...
    def trail(self) -> dict:
        """
        Values of the channels of RunOptions.trail at the middle and the end of every step, time first (copies).
        """
    @property
    def adaptive(self) -> bool:
        """
        Whether the method chooses its steps.
        """
    @property
    def order(self) -> int:
        """
        Order of the method, the highest where it varies.
        """
    @property
    def recorded(self) -> int:
        """
        Outputs recorded.
        """
    @property
    def set_aside(self) -> str:
        """
        Why it was not stepped on beside others; empty: it was.
        """
    @property
    def state(self) -> State:
        """
        copy
        """
    @property
    def steps(self) -> int:
        """
        Steps so far; `statistics` tells more, and takes longer.
        """
    @property
    def time(self) -> float:
        ...
class LaneEvaluator:
    """
    Evaluates models that differ in their seas at single states (lanes, n), in coordinates of the tree.
    """
    def __init__(self, module: types.ModuleType, models: collections.abc.Sequence[Model]) -> None:
        ...
    def __repr__(self) -> str:
        ...
    def derivative(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        dy/dt, in lanes.
        """
    def repeat(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"], count: typing.SupportsInt | typing.SupportsIndex, dt: typing.SupportsFloat | typing.SupportsIndex = 0.0) -> None:
        """
        Evaluates in lanes `count` times, advancing t by dt; for timing.
        """
    def scalar_derivative(self, t: typing.SupportsFloat | typing.SupportsIndex, y: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[m, n]"]) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        dy/dt, one by one.
        """
    def start(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        The described starts.
        """
def advance_side_by_side(runs: collections.abc.Sequence[Simulation], module: types.ModuleType, t_end: typing.SupportsFloat | typing.SupportsIndex, progress: typing.Any = None) -> bool:
    """
    Steps runs, whose models differ in their seas alone, to t_end (s) in the lanes of a module, as far as each goes there; False as of Simulation.advance.
    """
def axes() -> dict[str, list[str]]:
    """
    The names along each dimension of channels but time; none: those of a scene, `Model.axes`.
    """
def channels() -> list[Channel]:
    """
    Every channel there is, in the order of results.
    """
def compile(*, name: str, gravity: typing.SupportsFloat | typing.SupportsIndex, orientation: str, baumgarte: typing.SupportsFloat | typing.SupportsIndex, length_scale: typing.SupportsFloat | typing.SupportsIndex, bodies: collections.abc.Sequence[Body], joints: collections.abc.Sequence[Joint], drivers: collections.abc.Sequence[Driver], loads: collections.abc.Sequence[typing.Any], vessels: collections.abc.Sequence[VesselHydrodynamics], groups: collections.abc.Sequence[GroupHydrodynamics], wave_loads: collections.abc.Sequence[WaveLoads], coordinates: collections.abc.Sequence[tuple[str, str, str]], points: collections.abc.Sequence[Point] = [], merge: bool = True, sea: SeaField = None) -> Model:
    """
    Checks and compiles a scene; seacrane.Scene.compile() calls it. Raises SceneError.
    """
def curve_of(what: str, value: typing.Any) -> Curve:
    """
    A curve, or a number as a constant one.
    """
def dnv_gamma(*, hs: typing.SupportsFloat | typing.SupportsIndex, tp: typing.SupportsFloat | typing.SupportsIndex) -> float:
    """
    Peak enhancement by DNV-RP-C205 (3.5.5): 5 for tp / sqrt(hs) <= 3.6, 1 from 5 on, between them exp(5.75 - 1.15 tp / sqrt(hs)); m and s.
    """
def finite_of(what: str, value: typing.Any, unit: str = '') -> float:
    """
    A number that is neither infinite nor none; the unit is for the error.
    """
def flag_of(what: str, value: typing.Any) -> bool:
    """
    A truth value, nothing that merely counts as one.
    """
def has_instructions(name: str) -> bool:
    """
    Whether this processor has the instructions that a lane module is compiled for.
    """
def initial_state(model: Model) -> State:
    ...
def integrator(name: str) -> Integrator:
    """
    The one of that name; SceneError where there is none.
    """
def integrator_names() -> list[str]:
    """
    Their names alone.
    """
def integrators() -> list[Integrator]:
    """
    All integration methods, in the order of the documents: a new list.
    """
def joint_kinds() -> dict:
    """
    The joint types by name.
    """
def jonswap(*, hs: typing.SupportsFloat | typing.SupportsIndex, tp: typing.SupportsFloat | typing.SupportsIndex, gamma: typing.SupportsFloat | typing.SupportsIndex = 3.3) -> Spectrum:
    """
    JONSWAP spectrum.
    
    Parameters
    ----------
    hs : float
        Significant wave height, m.
    tp : float
        Peak period, s.
    gamma : float
        Peak enhancement, 1 to 7. The width is 0.07 below and 0.09 above the peak.
    
    Raises
    ------
    ValueError
        A parameter is not finite or out of range.
    
    Notes
    -----
    Hasselmann et al., Deutsche Hydrographische Zeitschrift A8 (12), 1973. Normalised by quadrature.
    """
def kept_apart(runs: collections.abc.Sequence[Simulation]) -> str:
    """
    Why runs cannot be stepped side by side; empty: they can.
    """
def lanes_differ(one: Model, other: Model) -> str:
    """
    What two models differ in of what runs side by side share; empty: nothing.
    """
def lanes_of(module: types.ModuleType) -> int:
    """
    How many runs a lane module steps side by side.
    """
def matrix_of(what: str, value: typing.Any) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rows of numbers, of any length; an empty list is none.
    """
def name_of(kind: str, value: typing.Any, usual: str = '') -> str:
    """
    A printable text that is not empty; None and the empty text stand for the usual one.
    """
def not_negative_of(what: str, value: typing.Any, unit: str = '') -> float:
    """
    A finite number of zero or more.
    """
def number_of(what: str, value: typing.Any) -> float:
    """
    A float; not a text that reads like one, nor a row of one number.
    """
def numbers_of(what: str, value: typing.Any) -> numpy.typing.NDArray[numpy.float64]:
    """
    An array of floats of any shape; no texts that read like numbers, no dates.
    """
def ochi_hubble(*, hs: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"], tp: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"], shape: typing.Annotated[collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex], "FixedSize(2)"]) -> Spectrum:
    """
    Ochi-Hubble spectrum: two systems of three parameters each.
    
    Parameters
    ----------
    hs : tuple of float
        Significant wave heights of both systems, m.
    tp : tuple of float
        Peak periods, s.
    shape : tuple of float
        Their lambda, above 0.5 to 20; 1 is Pierson-Moskowitz, larger is narrower.
    
    Raises
    ------
    ValueError
        A parameter is not finite or out of range.
    
    Notes
    -----
    M. K. Ochi and E. N. Hubble, Proc. 15th Coastal Engineering Conference, 1976.
    """
def philox_uniform(*, seed: typing.Any, stream: typing.Any, index: typing.Any) -> float:
    """
    Uniform number in (0, 1) by Philox4x32-10 (Salmon et al., SC11, 2011): key = seed, counter = index + 2^64 stream; the first two output words, lowest first, shifted right by 11, made odd, times 2^-53.
    """
def pierson_moskowitz(*, hs: typing.SupportsFloat | typing.SupportsIndex, tp: typing.SupportsFloat | typing.SupportsIndex) -> Spectrum:
    """
    Pierson-Moskowitz spectrum, in its form for a given significant wave height and peak period.
    
    Parameters
    ----------
    hs : float
        Significant wave height, m.
    tp : float
        Peak period, s.
    
    Raises
    ------
    ValueError
        A parameter is not finite or not above zero.
    
    Notes
    -----
    W. J. Pierson and L. Moskowitz, J. Geophys. Res. 69 (24), 1964.
    """
def positive_of(what: str, value: typing.Any, unit: str = '') -> float:
    """
    A finite number above zero.
    """
def realise_waves(spectrum: Spectrum, *, seed: typing.Any, direction: typing.SupportsFloat | typing.SupportsIndex, count: typing.Any = 200, minimum_omega: typing.SupportsFloat | typing.SupportsIndex | None = None, maximum_omega: typing.SupportsFloat | typing.SupportsIndex | None = None, depth: typing.SupportsFloat | typing.SupportsIndex = ..., gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665, placement: str = 'jittered', system: typing.Any = 0) -> WaveComponents:
    """
    Long-crested sea with deterministic amplitudes and jittered frequencies.
    
    The frequency range is cut into `count` bins of one width. Component i has exactly the energy of bin i, a
    frequency placed uniformly within it and a uniform phase; both from Philox4x32-10 with the seed as key,
    streams 0 and 1, index i (`philox_uniform`). Energy outside the range is left out and not made up for: see
    `realised_hs`.
    
    Parameters
    ----------
    spectrum : Spectrum
    seed : int
        0 to 2^64 - 1. The same seed gives the same waves; the random bits are the same on every platform, the
        derived numbers up to the rounding of its mathematical library.
    direction : float
        Where the waves travel to, rad, from +x (forward) towards +y (port).
    count : int
        Number of components.
    minimum_omega, maximum_omega : float, optional
        Range, rad/s; by default `Spectrum.default_range`. For JONSWAP and Pierson-Moskowitz the realised hs is
        then within 1 %.
    depth : float
        Water depth, m.
    gravity : float
        m/s2.
    placement : str
        "jittered" (default), or "uniform": frequencies are multiples of one bin width, as an FFT needs them, and
        the sea repeats after 2 pi over that width.
    system : int
        Number of the wave system in a sea of several: each takes random numbers of its own, from the streams
        3 system (jitter) and 3 system + 1 (phase).
    
    Raises
    ------
    ValueError
        A parameter is not finite or out of range.
    """
def require_unmasked(what: str, value: typing.Any) -> None:
    """
    Refuses NumPy's masked values, below which anything may stand.
    """
def rows_of(what: str, value: typing.Any, width: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float64]:
    """
    Rows of so many numbers; an empty list is no rows.
    """
def section_radiation(*, points: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], omega: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], rho: typing.SupportsFloat | typing.SupportsIndex = 1025.0, g: typing.SupportsFloat | typing.SupportsIndex = 9.81, panels: typing.SupportsInt | typing.SupportsIndex = 40) -> dict:
    """
    Added mass and damping of a symmetric section on deep water, per metre of length.
    
    Parameters
    ----------
    points : array_like, shape (p, 2)
        y >= 0 and z <= 0 in m on the port half, from the waterline (z = 0) to the keel (y = 0).
    omega : array_like, shape (n,)
        Frequencies above zero, rad/s.
    rho, g : float
        kg/m3, m/s2.
    panels : int
        Panels on the half section.
    
    Returns
    -------
    dict of arrays; rows and columns are sway, heave, roll about the waterline on the centre line
        added_mass, damping : (n, 3, 3)
        wave_amplitude : (n, 3) complex, of the waves far to port per unit of motion (m/m, m/rad)
        infinite_added_mass : (3, 3)
        zero_added_mass : (3, 3), NaN in heave, which has no limit.
    
    Raises
    ------
    ValueError
        The points are not a half section as above, a value is not finite or out of range, or the panels are too
        few for the shape, which shows as radiated energy that is not the damping's.
    
    Notes
    -----
    Close-fit sources on straight panels (Frank, NSRDC report 2375, 1967), with a rigid lid on the interior free
    surface against irregular frequencies. Sections thinner than 2 % are solved as 2 % thick: a stem in sway is
    a plate.
    """
def shaped_of(what: str, value: typing.Any, shape: collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]) -> numpy.typing.NDArray[numpy.float64]:
    """
    An array of floats of one shape.
    """
def spline_rows(*, knot: typing.Annotated[numpy.typing.ArrayLike, numpy.int64], column: typing.Annotated[numpy.typing.ArrayLike, numpy.int64], left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], bend_left: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], bend_right: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], curvature: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    Weights (q, n) of a cubic spline at places behind knots (q,), by their shares of the values and of the second derivatives at both ends; see seacrane.hydro.data.interpolation. Raises ValueError for other shapes.
    """
def stability_polynomial(integrator: str) -> list[float]:
    """
    Coefficients of the stability polynomial of an explicit Runge-Kutta method, lowest power first: a step h of y' = lambda y multiplies y by R(h lambda). Empty for an integrator that has no tableau here.
    """
def strip_theory(*, x: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], sections: collections.abc.Sequence[typing.Annotated[numpy.typing.ArrayLike, numpy.float64]], omega: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], heading: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], speed: typing.SupportsFloat | typing.SupportsIndex = 0.0, rho: typing.SupportsFloat | typing.SupportsIndex = 1025.0, g: typing.SupportsFloat | typing.SupportsIndex = 9.81, panels: typing.SupportsInt | typing.SupportsIndex = 40) -> dict:
    """
    Strip theory of Salvesen, Tuck and Faltinsen (1970) for a port-starboard symmetric hull in deep water.
    
    Parameters
    ----------
    x : array_like, shape (s,)
        Stations, m, increasing, forward.
    sections : list of array_like, each of shape (p_i, 2)
        y >= 0 and z <= 0 in m on the port half, from the waterline (z = 0) to the keel (y = 0). A last section
        aft of finite area is a transom.
    omega : array_like, shape (n,)
        Frequencies above zero, rad/s: of encounter for the matrices, of the waves for the forces.
    heading : array_like, shape (m,)
        Direction the waves travel to, rad: 0 following, pi head sea.
    speed : float
        Forward speed, m/s.
    rho, g : float
        kg/m3, m/s2.
    panels : int
        Panels on each half section.
    
    Returns
    -------
    dict of arrays, SI units, about x = 0 on the centre line at the waterline, time factor exp(+i omega t)
        added_mass, damping : (n, 6, 6). Surge is zero: the theory has none.
        infinite_frequency_added_mass : (6, 6)
        zero_frequency_added_mass : (6, 6), at zero speed; NaN in heave and pitch, which have no limit.
        force, froude_krylov : (m, n, 6) complex, per metre of wave amplitude, phases at the origin. Surge is the
        Froude-Krylov force alone.
        encounter_frequency : (m, n), rad/s
        sectional_added_mass, sectional_damping : (n, s, 3, 3), per metre of length, sway, heave and roll.
        sectional_infinite_added_mass, sectional_zero_added_mass : (s, 3, 3)
    
    Raises
    ------
    ValueError
        Stations not increasing, a section that is not a half section as above, values that are not finite or
        out of range, a wave that the ship keeps up with (encounter frequency zero), or panels too few for the
        shape, which shows as radiated energy that is not the damping's.
    
    Notes
    -----
    N. Salvesen, E. O. Tuck and O. Faltinsen, Ship motions and sea loads, Trans. SNAME 78, 1970; with the end
    terms of the transom. Sections by `section_radiation`; between stations everything but the wave's phase is
    linear. Unlike theirs, the Froude-Krylov part is the exact pressure integral over the piecewise linear hull,
    with what faces forward or aft (surge, and small parts of pitch and yaw), both ends included.
    """
def tabulated_density(*, omega: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], density: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> Spectrum:
    """
    Spectrum from a table in rad/s and m2 s/rad, linear between its points, zero outside.
    """
def text_of(what: str, value: typing.Any, usual: str = '') -> str:
    """
    A printable text; None and the empty text stand for the usual one.
    """
def texts_of(what: str, value: typing.Any) -> list[str]:
    """
    A list of printable texts.
    """
def torsethaugen(*, hs: typing.SupportsFloat | typing.SupportsIndex, tp: typing.SupportsFloat | typing.SupportsIndex, gravity: typing.SupportsFloat | typing.SupportsIndex = 9.80665) -> Spectrum:
    """
    Torsethaugen's spectrum in its simplified form: wind sea and swell from one height and period.
    
    Parameters
    ----------
    hs : float
        Significant wave height of both systems together, m.
    tp : float
        Peak period of the primary system, s: wind sea up to 6.6 hs^(1/3), else swell.
    gravity : float
        m/s2.
    
    Raises
    ------
    ValueError
        A parameter is not finite or out of range.
    
    Notes
    -----
    K. Torsethaugen and S. Haver, ISOPE 2004; DNV-RP-C205 appendix A. Norwegian waters, fetch 370 km. Normalised by
    quadrature instead of the fitted factor A_gamma.
    """
def turned(quaternion: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], vector: typing.Annotated[numpy.typing.ArrayLike, numpy.float64]) -> numpy.typing.NDArray[numpy.float64]:
    """
    A vector (3,) of a body in the inertial frame (n, 3), by its quaternions (n, 4).
    """
def vector_of(what: str, value: typing.Any) -> list[float]:
    """
    A list of floats from a one-dimensional array_like.
    """
def weighted_sums(weights: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], values: typing.Annotated[numpy.typing.ArrayLike, numpy.complex128]) -> numpy.typing.NDArray[numpy.complex128]:
    """
    Complex sums (q, d) of weights (q, n) times values (n, d), or (q, n, d), term by term in their order. Raises ValueError for other shapes.
    """
def without_smallest(magnitudes: typing.Annotated[numpy.typing.ArrayLike, numpy.float64], limit: typing.SupportsFloat | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.bool]:
    """
    Which rows of magnitudes (n, m) are left where the smallest are left out, which sum to no more than a share of all in each column; at least one.
    """
LOAD_KINDS: dict = {'heave compensator': HeaveCompensator, 'actuator': Actuator, 'point force': PointForce, 'spring': Spring, 'force table': ForceTable, 'function force': FunctionForce, 'flow force': FlowForce, 'friction': Friction, 'soft stop': SoftStop, 'line': Line, 'gas spring': GasSpring, 'pendulum damping': PendulumDamping, 'span drag': SpanDrag, 'hydraulic cylinder': HydraulicCylinder, 'immersed part': ImmersedPart, 'entrapped water': EntrappedWater, 'immersed span': ImmersedSpan, 'wound span': WoundSpan, 'seabed node': SeabedNode, 'contact': Contact, 'limit': Limit}
