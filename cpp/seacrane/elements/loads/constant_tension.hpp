#pragma once

#include <array>
#include <tuple>

#include "seacrane/elements/field.hpp"
#include "seacrane/elements/loads/load.hpp"
#include "seacrane/elements/loads/margin.hpp"
#include "seacrane/math/curve.hpp"
#include "seacrane/math/select.hpp"

namespace seacrane {

struct ConstantTensionDescription {
  Curve tension;
  double tension_gain = 0.0, dead_band = 0.0;

  static constexpr auto fields() {
    using D = ConstantTensionDescription;
    return std::tuple(
        optional("tension", &D::tension, "N", "that the winch holds: it renders above, recovers below"),
        optional("tension_gain", &D::tension_gain, "m/s/N", "rate over tension beyond the band; 0: none held")
            .not_negative(),
        optional("dead_band", &D::dead_band, "N", "on both sides of the tension, in which it stands still")
            .not_negative());
  }
};

/// A tension that a winch holds: a rate is added to its command, gain times what EA e is beyond the set
/// tension and the dead band. Above it pays out, below it hauls in, a slack line too.
struct ConstantTension {
  ConstantTensionDescription d;

  static void check(const ConstantTensionDescription& d, const Check& c) {
    const bool given = d.tension.pieces().size() > 1 || d.tension.at(0.0).value != 0.0;
    if (d.tension_gain == 0.0 && (given || d.dead_band > 0.0)) {
      c.fail(
          "holds a tension without a tension_gain; give the m/s of rope for each N beyond it, such as 1e-5");
    }
    if (d.tension_gain == 0.0) return;
    for (const Curve::Piece& piece : d.tension.pieces()) {
      const double start = d.tension.at(piece.start).value;
      if (start > d.dead_band) continue;
      c.fail("tension is " + to_text(start) + " N at t = " + to_text(piece.start) + " s and the dead_band " +
             to_text(d.dead_band) +
             " N: a slack line would not be hauled in; give a tension above the dead_band");
    }
  }

  /// m/s.
  template <class T>
  T rate(const LoadInput<T>& in, const T& pull) const {
    const T beyond = excess(in, pull);
    return T(d.tension_gain) * (beyond - clamped(beyond, T(-d.dead_band), T(d.dead_band)));
  }
  /// At the ends of the dead band.
  std::array<Margin, 2> margins(const LoadInput<double>& in, double pull) const {
    const double beyond = excess(in, pull);
    return {{{nullptr, d.dead_band - beyond}, {nullptr, d.dead_band + beyond}}};
  }

 private:
  template <class T>
  T excess(const LoadInput<T>& in, const T& pull) const {
    return pull - T(d.tension.at(in.time, in.curve_limit).value);
  }
};

}  // namespace seacrane
