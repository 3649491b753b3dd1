#pragma once

#include <array>
#include <cmath>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/math/dual.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

inline constexpr double kAtmosphere = 1e5;  // Pa
inline constexpr double kMostAir = 0.1;

struct HydraulicOilDescription {
  double oil_modulus = 1.5e9, hose_modulus = 1.5e8, cylinder_modulus = 3.15e10, air = 0.0;
  double vapour_pressure = 2e3;

  static constexpr auto fields() {
    using D = HydraulicOilDescription;
    return std::tuple(
        optional("oil_modulus", &D::oil_modulus, "Pa", "bulk modulus of the oil without air")
            .positive()
            .usually(1e8, 1e11),
        optional("hose_modulus", &D::hose_modulus, "Pa", "of the hoses, by their volume")
            .positive()
            .usually(5e6, 0.0),
        optional("cylinder_modulus", &D::cylinder_modulus, "Pa", "of the barrel, likewise")
            .positive()
            .usually(1e9, 0.0),
        optional("air", &D::air, "", "share of the volume that is free air at 1e5 Pa")
            .within(0.0, kMostAir)
            .usually(0.0, 0.5),
        optional("vapour_pressure", &D::vapour_pressure, "Pa", "below it the oil boils: an event")
            .not_negative()
            .usually(0.0, 1e5));
  }
};

/// Oil in a chamber of swept volume A s and hose volume V_h, with the compressibilities k of oil and barrel,
/// and k + d of oil and hose:
///
///   p' (A s k + V_h (k + d)) = Q - A s',
///
/// so that 1 / beta = 1 / B_oil + (A s / V) / B_cylinder + (V_h / V) / B_hose. With B from 1 / B = 1 / B_oil
/// + 1 / B_cylinder and a share `air` of free air, compressed by p V^1.4 = constant, the oil's specific
/// volume is
///
///   v = exp(-p / B) + air (p0 / p)^(1 / 1.4),   k = -v' / v.
///
/// The oil stores energy: with the enthalpy of a volume h = (integral of v dp) / v, h' = 1 + k h,
///
///   U = A s (h - p) + V_h (h - p + d integral of h dp),   U' = h Q - p A s'.
struct HydraulicOil {
  double modulus = 1.0;  // Pa, B
  double hose = 0.0;     // 1/Pa, d
  double air = 0.0;

  static void check(const HydraulicOilDescription& d, const Check& c) {
    if (d.hose_modulus > d.cylinder_modulus) {
      c.fail("hose_modulus is " + to_text(d.hose_modulus) + " Pa, stiffer than the barrel's " +
             to_text(d.cylinder_modulus) + " Pa; make it smaller");
    }
  }

  static HydraulicOil compile(const HydraulicOilDescription& d) {
    return {1.0 / (1.0 / d.oil_modulus + 1.0 / d.cylinder_modulus),
            1.0 / d.hose_modulus - 1.0 / d.cylinder_modulus, d.air};
  }

  /// k, 1/Pa.
  template <class T>
  T compressibility(const T& pressure) const {
    if (air == 0.0) return T(1.0 / modulus);
    const T p = bounded(pressure), liquid = liquid_volume(p), gas = gas_volume(p);
    return (liquid / T(modulus) + gas / (T(kExponent) * p)) / (liquid + gas);
  }
  /// A s k + V_h (k + d), m3/Pa.
  template <class T>
  T compliance(const T& pressure, const T& swept, double hose_volume) const {
    const T k = compressibility(pressure);
    return swept * k + T(hose_volume) * (k + T(hose));
  }
  /// h, J/m3.
  template <class T>
  T enthalpy(const T& pressure) const {
    if (air == 0.0) return T(modulus) * (exponential(T(pressure / T(modulus))) - T(1));
    const T p = bounded(pressure), liquid = liquid_volume(p), gas = gas_volume(p);
    return (T(modulus) * (T(1) - liquid) + gas * p / T(1.0 - 1.0 / kExponent)) / (liquid + gas);
  }
  /// U, J.
  double energy(double pressure, double swept, double hose_volume) const {
    const double density = enthalpy(pressure) - pressure;
    return (swept + hose_volume) * density + hose_volume * hose * enthalpy_integral(pressure);
  }

 private:
  static constexpr double kExponent = 1.4;
  static constexpr double kLeast = 1.0;  // Pa: air is not thinner than that

  template <class T>
  static T bounded(const T& p) {
    return select(p > T(kLeast), p, T(kLeast));
  }
  template <class T>
  T liquid_volume(const T& p) const {
    return exponential(T(-p / T(modulus)));
  }
  template <class T>
  T gas_volume(const T& p) const {
    return T(air) * power(T(T(kAtmosphere) / p), 1.0 / kExponent);
  }
  /// The integral of h over the pressure. With air it begins at 1e5 Pa, by Gauss's rule over the logarithm.
  double enthalpy_integral(double pressure) const {
    if (air == 0.0) return modulus * (enthalpy(pressure) - pressure);
    static constexpr std::array<double, 6> at = {0.1252334085114689, 0.3678314989981802, 0.5873179542866175,
                                                 0.7699026741943047, 0.9041172563704749, 0.9815606342467193};
    static constexpr std::array<double, 6> weight = {0.2491470458134028, 0.2334925365383548,
                                                     0.2031674267230659, 0.1600783285433462,
                                                     0.1069393259953184, 0.0471753363865118};
    const double half = 0.5 * std::log(bounded(pressure) / kAtmosphere) / kParts;
    double sum = 0.0;
    for (int part = 0; part < kParts; ++part) {
      const double middle = std::log(kAtmosphere) + (2 * part + 1) * half;
      for (std::size_t i = 0; i < at.size(); ++i) {
        for (const double side : {-1.0, 1.0}) {
          const double p = std::exp(middle + side * half * at[i]);
          sum += weight[i] * half * p * enthalpy(p);
        }
      }
    }
    return sum;
  }
  static constexpr int kParts = 4;
};

}  // namespace seacrane
