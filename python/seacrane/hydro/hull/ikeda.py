"""Roll damping that waves do not explain: of a hull or its main particulars, and eddies of one section."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from seacrane.errors import SceneError
from seacrane.hydro.hull.hull import Hull
from seacrane.inputs.checked import not_negative_of, number_of, positive_of
from seacrane.inputs.plausible import swing_of

STATIONS = 41
HARMONIC = 8.0 / (3.0 * np.pi)  # of v |v| over a period
RANGES = {  # in the order in which they are asked for; the last two of ships that have bilge keels
    "block_coefficient": (0.5, 0.85),
    "midship_coefficient": (0.9, 0.99),
    "breadth / draught": (2.5, 4.5),
    "depth of the roll axis / draught": (-1.5, 0.2),
    "omega sqrt(B / 2 g)": (0.0, 1.0),
    "bilge_keel_breadth / breadth": (0.01, 0.06),
    "bilge_keel_length / length": (0.05, 0.4),
}
LARGEST_AMPLITUDE = 20.0  # deg: ours, the sources state none


@dataclass(frozen=True, kw_only=True)
class MainParticulars:
    """What Ikeda's simple formulas ask of a ship: ``length`` between perpendiculars, ``breadth``, ``draught``
    (m), ``block_coefficient`` and ``midship_coefficient``."""

    length: float
    breadth: float
    draught: float
    block_coefficient: float
    midship_coefficient: float

    def __post_init__(self) -> None:
        for name in self.__dataclass_fields__:
            positive_of(f"main particulars: {name}", getattr(self, name))

    @staticmethod
    def of(hull: Hull) -> MainParticulars:
        """Particulars of a hull's wetted surface; the midship coefficient is that of its largest section."""
        cut = hull.sections(np.linspace(hull.extent[0, 0], hull.extent[1, 0], STATIONS))
        areas = [2.0 * abs(float(np.trapezoid(one.section[:, 0], one.section[:, 1]))) for one in cut]
        box = hull.breadth * hull.draught
        return MainParticulars(
            length=hull.length,
            breadth=hull.breadth,
            draught=hull.draught,
            block_coefficient=hull.hydrostatics.volume / (hull.length * box),
            midship_coefficient=max(areas) / box,
        )


@dataclass(frozen=True, kw_only=True)
class IkedaDamping:
    """Roll damping beside waves, by component, as linear damping of the same work per period.

    Attributes
    ----------
    friction, eddy, lift, bilge_keels : N m s/rad at the amplitude and frequency asked for.
    linear, quadratic : N m s/rad and N m s2/rad2, of rate and rate |rate|: the pair that does the method's
        work at the amplitude and at half of it.
    amplitude_deg, omega : deg and rad/s, for which all this holds.
    """

    friction: float
    eddy: float
    lift: float
    bilge_keels: float
    linear: float
    quadratic: float
    amplitude_deg: float
    omega: float

    @property
    def total(self) -> float:
        """Equivalent linear B44, N m s/rad."""
        return self.friction + self.eddy + self.lift + self.bilge_keels


def ikeda_roll_damping(
    hull: Hull | MainParticulars, *, amplitude_deg: float, omega: float, axis_height: float = 0.0,
    bilge_keel_length: float = 0.0, bilge_keel_breadth: float = 0.0, speed: float = 0.0,
    rho: float = 1025.0, g: float = 9.81, viscosity: float = 1.19e-6,
) -> IkedaDamping:  # fmt: skip
    """Friction, eddies, bilge keels and, at speed, lift: what joins a database's radiation damping.

    Friction and lift follow ITTC 7.5-02-07-04.5; eddies and bilge keels follow the simple formulas that
    Kawahara, Maekawa and Ikeda (2009) fitted to Ikeda's method. Their wave component is left out: databases
    have it. The lift of bilge keels at speed and skegs are left out too. docs/hull-hydrodynamics.md says what
    was checked against which source, and what could not be.

    Parameters
    ----------
    hull : a hull counts with its wetted length.
    amplitude_deg, omega : of roll, deg and rad/s.
    axis_height : of the roll axis, commonly the centre of gravity, above the waterline, m.
    bilge_keel_length, bilge_keel_breadth : m, of the keel on one side; both sides have one. Default: none.
    speed : m/s.
    rho, g, viscosity : kg/m3, m/s2, m2/s.

    Warns
    -----
    AngleUnitWarning : an amplitude that looks like radians.

    Raises
    ------
    SceneError : outside the range that the formulas were fitted to, which the message states.
    """
    ship = MainParticulars.of(hull) if isinstance(hull, Hull) else hull
    if not isinstance(ship, MainParticulars):
        raise SceneError(f"roll damping: {type(hull).__name__} is no hull; give a Hull or MainParticulars")
    keels = (bilge_keel_length, bilge_keel_breadth)
    positive = {"amplitude_deg": amplitude_deg, "omega": omega, "rho": rho, "g": g, "viscosity": viscosity}
    for name, value in positive.items():
        positive_of(f"roll damping: {name}", value)
    for name, value in zip(
        ("bilge_keel_length", "bilge_keel_breadth", "speed"), (*keels, speed), strict=True
    ):
        not_negative_of(f"roll damping: {name}", value)
    number_of("roll damping: axis_height", axis_height)
    swing_of("roll damping: amplitude_deg", amplitude_deg)
    _require_range(ship, amplitude_deg, omega * np.sqrt(ship.breadth / 2.0 / g), -axis_height, keels)

    def at(degrees: float) -> dict[str, float]:
        return _components(
            ship, np.radians(degrees), omega, -axis_height, keels, speed=speed, rho=rho, g=g, nu=viscosity
        )

    found = at(amplitude_deg)
    if found["eddy"] < 0.0:
        raise SceneError(
            f"roll damping: eddies come out at {found['eddy']:.4g} N m s/rad, below zero: block_coefficient "
            f"{ship.block_coefficient:.4g} is at the end of the formulas. Take roll damping from a model test"
        )
    whole, half = sum(found.values()), sum(at(0.5 * amplitude_deg).values())
    rate = float(omega * np.radians(amplitude_deg))
    quadratic = max((whole - half) / (HARMONIC * 0.5 * rate), 0.0)
    linear = whole - HARMONIC * rate * quadratic
    if linear < 0.0:
        linear, quadratic = 0.0, whole / (HARMONIC * rate)
    return IkedaDamping(
        **found, linear=linear, quadratic=quadratic, amplitude_deg=float(amplitude_deg), omega=float(omega)
    )


def _components(
    ship: MainParticulars, amplitude: float, omega: float, depth: float, keels: tuple[float, float], *,
    speed: float, rho: float, g: float, nu: float,
) -> dict[str, float]:  # fmt: skip
    """By name, N m s/rad; ``depth`` of the roll axis below the waterline, m."""
    length, breadth, draught = ship.length, ship.breadth, ship.draught
    cb, cm = ship.block_coefficient, ship.midship_coefficient
    surface = length * (1.7 * draught + cb * breadth)
    radius = ((0.887 + 0.145 * cb) * surface / length - 2.0 * depth) / np.pi
    frequency = omega * np.sqrt(breadth / 2.0 / g)
    unit = rho * cb * length * breadth**3 * draught * np.sqrt(2.0 * g / breadth)
    ratios = {"cb": cb, "cm": cm, "bd": breadth / draught, "og": depth / draught}
    swing = {"amplitude": amplitude, "frequency": frequency}
    on = keels[0] > 0.0 and keels[1] > 0.0
    eddies = (0.04 * omega * length) ** 2  # shed downstream: Ikeda, Himeno and Tanaka (1978)
    full = max(cm - 0.91, 0.0)
    kappa = 106.0 * full**2 - 700.0 * full**3
    slope = float(2.0 * np.pi * draught / length + kappa * (4.1 * breadth / length - 0.045))
    parts = {
        "friction": friction_at_speed(speed, omega, length)
        * friction(radius=radius, surface=surface, amplitude=amplitude, omega=omega, rho=rho, viscosity=nu),
        "eddy": unit * (eddies / (speed**2 + eddies)) * eddy(**ratios, **swing),
        "lift": lift(length=length, draught=draught, speed=speed, og=depth, slope=slope, rho=rho),
        "bilge_keels": unit
        * (bilge_keels(**ratios, **swing, breadth=keels[1] / breadth, length=keels[0] / length) if on else 0),
    }
    return {name: float(value) for name, value in parts.items()}


def _require_range(
    ship: MainParticulars, amplitude: float, frequency: float, depth: float, keels: tuple[float, float]
) -> None:
    ratios = (ship.breadth / ship.draught, depth / ship.draught, frequency)
    values = [ship.block_coefficient, ship.midship_coefficient, *ratios]
    if (keels[0] > 0.0) != (keels[1] > 0.0):
        raise SceneError(
            f"roll damping: bilge keels are {keels[0]:g} m long and {keels[1]:g} m broad; give both, or none"
        )
    if keels[0] > 0.0:
        values += [keels[1] / ship.breadth, keels[0] / ship.length]
    for value, (name, (low, high)) in zip(values, RANGES.items(), strict=False):
        if not low - 1e-9 <= value <= high + 1e-9:
            raise SceneError(
                f"roll damping: {name} is {value:.4g}; the formulas hold from {low:g} to {high:g}. Take roll "
                "damping from a model test or from free decay"
            )
    if amplitude > LARGEST_AMPLITUDE:
        raise SceneError(
            f"roll damping: amplitude_deg is {amplitude:g}; give {LARGEST_AMPLITUDE:g} or less, beyond which "
            "bilge keels come out of the water"
        )


# Components as functions of ratios. Eddies and bilge keels are the simple formulas of Kawahara, Maekawa and
# Ikeda (2009), fitted to Ikeda's method over systematically varied hulls.
def friction(
    *, radius: float, surface: float, amplitude: float, omega: float, rho: float, viscosity: float
) -> float:
    """Friction without speed, N m s/rad: laminar (Kato 1957), and turbulent (Hughes) beside it.

    ``radius`` (m) is the mean one of the ``surface`` (m2), ``amplitude`` in rad. ITTC 7.5-02-07-04.5, 2.2.3:
    B = (4 / 3 pi) rho S r^3 phi w Cf, Cf = 1.328 Re^-0.5 + 0.014 Re^-0.114, Re = 3.22 (r phi)^2 / (T nu).
    """
    reynolds = 3.22 * (radius * amplitude) ** 2 * omega / (2.0 * np.pi * viscosity)
    coefficient = 1.328 * reynolds**-0.5 + 0.014 * reynolds**-0.114
    return float(4.0 / (3.0 * np.pi) * rho * surface * radius**3 * amplitude * omega * coefficient)


def eddy(*, cb: float, cm: float, bd: float, og: float, amplitude: float, frequency: float) -> float:
    """Eddies of the naked hull, without dimensions; ``amplitude`` in rad."""
    size = (-0.0182 * cb + 0.0155) * (bd - 1.8) ** 3 + np.polyval(
        [-79.414, 215.695, -215.883, 93.894, -14.848], cb
    )
    height = (3.98 * cb - 5.1525) * (-0.2 * bd + 1.6) * og
    height *= (0.9717 * cb**2 - 1.55 * cb + 0.723) * og + 0.04567 * cb + 0.9408
    fullness = (0.25 * og + 0.95) * og + np.polyval([-219.2, 443.7, -283.3, 59.6], cb)
    power = -15.0 * cb * bd + 46.5 * cb + 11.2 * bd - 28.6
    pressure = size * np.exp(height + fullness * cm**power)
    return float(4.0 * frequency * amplitude / (3.0 * np.pi * cb * bd**3) * pressure)


def bilge_keels(
    *, cb: float, cm: float, bd: float, og: float, breadth: float, length: float, amplitude: float,
    frequency: float,
) -> float:  # fmt: skip
    """Bilge keels of both sides, their pressure on the hull included, without dimensions.

    ``breadth`` and ``length`` are shares of the ship's. The formula counts the amplitude in degrees.
    """
    degrees = np.degrees(amplitude)
    hull = (-0.3651 * cb + 0.3907) * (bd - 2.83) ** 2 - 2.21 * cb + 2.632
    swing = np.polyval([0.00255, 0.122, 0.4794], degrees)
    keel = (-0.8913 * breadth**2 - 0.0733 * breadth) * length**2
    keel += (5.2857 * breadth**2 - 0.01185 * breadth + 0.00189) * length
    height = 5.0 * breadth + 0.3 * bd - 0.2 * length + 0.00125 * degrees**2 - 0.0425 * degrees - 1.86
    fullness = -15.0 * breadth + 1.2 * cb - 0.1 * bd - 0.0657 * og**2 + 0.0586 * og + 1.6164
    return float(hull * swing * keel * np.exp(height * og + fullness * cm ** (2.5 * og + 15.75)) * frequency)


def lift(*, length: float, draught: float, speed: float, og: float, slope: float, rho: float) -> float:
    """Lift of the hull at speed, N m s/rad; ``og`` (m) from the waterline down to the axis, ``slope`` of the
    lift. ITTC 7.5-02-07-04.5, 2.2.2, with the levers 0.3 and 0.5 of the draught."""
    force, point = 0.3 * draught, 0.5 * draught
    shape = 1.0 - 1.4 * og / point + 0.7 * og**2 / (force * point)
    return 0.5 * rho * length * draught * speed * slope * force * point * shape


def friction_at_speed(speed: float, omega: float, length: float) -> float:
    """Factor on friction (Tamiya and Komura 1972)."""
    return 1.0 + 4.1 * speed / (omega * length)


def section_eddy_damping(
    *, breadth: float, draught: float, area_coefficient: float, amplitude_deg: float, omega: float,
    axis_height: float = 0.0, bilge_radius: float | None = None, rho: float = 1025.0,
) -> float:  # fmt: skip
    """Eddies of a naked section that rolls without speed, as linear damping of the same work per period.

    The section counts as the Lewis form of its breadth, draught and area. Integrated over the length of a
    ship this is what the simple formulas of `ikeda_roll_damping` were fitted to, and it has none of their
    ranges. docs/measurements.md compares it with sections in a tank.

    Parameters
    ----------
    breadth, draught : at the waterline, m.
    area_coefficient : area over breadth times draught, up to 1.
    amplitude_deg, omega : of roll, deg and rad/s.
    axis_height : of the roll axis above the waterline, m.
    bilge_radius : m. Default: the one that gives the area, at most the draught or half of the breadth.
    rho : kg/m3.

    Returns
    -------
    float : N m s/rad for each metre of length.

    Raises
    ------
    SceneError : a size that is not positive, an area that no Lewis form has, a roll axis below the keel.

    Notes
    -----
    B = 4 rho d^4 w phi C_r / (3 pi); Y. Ikeda, On eddy making component of roll damping force on naked hull,
    J. SNAJ 142 (1978), in the form of ITTC 7.5-02-07-04.5 (2011), 2.2.4. Neither was at hand: the equations
    agree with a public program but for the brackets of gamma, where the measured sections decided.
    """
    names = ("breadth", "draught", "area_coefficient", "amplitude_deg", "omega", "rho")
    sizes = (breadth, draught, area_coefficient, amplitude_deg, omega, rho)
    for name, value in zip(names, sizes, strict=True):
        positive_of(f"section eddies: {name}", value)
    if bilge_radius is not None:
        not_negative_of("section eddies: bilge_radius", bilge_radius)
    depth = -number_of("section eddies: axis_height", axis_height) / draught
    if area_coefficient > 1.0 or not depth < 1.0:
        raise SceneError(
            f"section eddies: area_coefficient is {area_coefficient:.4g} and the roll axis {depth:.4g} "
            "draughts below the waterline; give an area of at most 1 and an axis above the keel"
        )
    half = 0.5 * breadth / draught
    two_arcs = 2.0 * float(np.sqrt(half * (1.0 - area_coefficient) / (4.0 - np.pi)))  # which give the area
    radius = min(two_arcs, 1.0, half) if bilge_radius is None else bilge_radius / draught
    coefficient = eddy_coefficient(half=half, area=area_coefficient, depth=depth, radius=radius)
    swing = omega * np.radians(amplitude_deg)
    return float(4.0 / (3.0 * np.pi) * rho * draught**4 * swing * coefficient)


def eddy_coefficient(*, half: float, area: float, depth: float, radius: float) -> float:
    """C_r of a section with its ``area`` coefficient; over the draught: ``half`` of its breadth, ``depth`` of
    the roll axis, bilge ``radius``."""
    reach, speed = _fastest(half, area)
    fullness = 1.0 + 4.0 * np.exp(-1.65e5 * (1.0 - area) ** 2)
    below = (half / (1.0 - depth)) * (area - depth) / (1.0 - depth)
    if below <= 0.0:
        raise SceneError(
            f"section eddies: the roll axis is {depth:.4g} draughts below the waterline, where a section of "
            f"the area coefficient {area:.4g} has no area below it; raise the axis"
        )
    gamma = np.sqrt(np.pi) * fullness / (2.0 * (1.0 - depth) * np.sqrt(below)) * (reach + speed)
    pressure = 0.5 * (0.87 * np.exp(-gamma) - 4.0 * np.exp(-0.187 * gamma) + 3.0)
    f1 = 0.5 * (1.0 + np.tanh(20.0 * (area - 0.7)))
    f2 = 0.5 * (1.0 - np.cos(np.pi * area))
    f2 -= 1.5 * (1.0 - np.exp(-5.0 * (1.0 - area))) * np.sin(np.pi * area) ** 2
    lever = (1.0 - f1 * radius) * (1.0 - depth - f1 * radius) + f2 * (half - f1 * radius) ** 2
    return float(lever * pressure * reach**2)


def _fastest(half: float, area: float) -> tuple[float, float]:
    """Over the draught: the largest radius of a Lewis form, and the potential flow there over the rate of
    roll."""
    slim = (half - 1.0) / (half + 1.0)
    d = 3.0 + 4.0 * area / np.pi + (1.0 - 4.0 * area / np.pi) * slim**2
    if d > 4.5:
        raise SceneError(
            f"section eddies: no Lewis form has the area coefficient {area:.4g} with B/2T {half:.4g}"
        )
    a3 = (3.0 - d + np.sqrt(9.0 - 2.0 * d)) / d
    a1 = (1.0 + a3) * slim
    scale = half / (1.0 + a1 + a3)
    turn = 0.5 * np.arccos(np.clip(a1 * (1.0 + a3) / (4.0 * a3), -1.0, 1.0)) if a3 else 0.0

    def radius(psi: float) -> float:
        across = (1.0 + a1) * np.sin(psi) - a3 * np.sin(3.0 * psi)
        down = (1.0 - a1) * np.cos(psi) + a3 * np.cos(3.0 * psi)
        return float(scale * np.hypot(across, down))

    psi = max((0.0, turn), key=radius)
    stretch = 1.0 + a1**2 + 9.0 * a3**2 + 2.0 * a1 * (1.0 - 3.0 * a3) * np.cos(2.0 * psi)
    stretch -= 6.0 * a3 * np.cos(4.0 * psi)
    even, odd = 6.0 * a3**2 + a1**2 * (1.0 + a3), 3.0 * a1 * a3 * (1.0 + a3)
    down = a1 * (1.0 - a3) * np.cos(3.0 * psi) + (even - odd) * np.cos(psi) - 2.0 * a3 * np.cos(5.0 * psi)
    across = a1 * (1.0 - a3) * np.sin(3.0 * psi) + (even + odd) * np.sin(psi) - 2.0 * a3 * np.sin(5.0 * psi)
    return radius(psi), float(2.0 * scale / stretch * np.hypot(down, across))
