#pragma once

#include <cmath>

#include "seacrane/elements/loads/line_path.hpp"
#include "seacrane/math/dual.hpp"

namespace seacrane {

/// Friction of a line on its sheaves. Rope passes sheave k at the rate s_k, positive towards the line's end,
/// with the strain that it has on average, and
///
///   T_{k+1} = T_k exp((mu_k wrap_k - log(efficiency_k)) tanh(s_k / v)).
///
/// The mean of the tensions by length is what the line's strain makes, so that
///
///   sum_k (T - T_k) l_k' = (T - T_1) (1 + e) l0' - sum_k (T_{k+1} - T_k) s_k:
///
/// the winch pulls T_1, and the last sum is lost, never less than nothing.
template <class T>
class SheaveFriction {
 public:
  SheaveFriction() = default;  // none
  /// For a path's length and rate, and an unstretched length and rate.
  SheaveFriction(const T& length, const T& rate, const T& unstretched, const T& unstretched_rate,
                 double speed)
      : straining_(rate / length - unstretched_rate / unstretched),
        passes_(length / unstretched * unstretched_rate),
        speed_(speed) {}

  /// The tension of the next section over that of the first; after the last of them as before it.
  const T& share() const { return share_; }
  /// Goes over the sheave behind a section.
  void pass(const PathSection<T>& section, const PathPoint& sheave) {
    using std::tanh;
    passes_ -= section.rate - section.length * straining_;
    weight_ += share_ * section.length;
    const T before = share_;
    const T slip = passes_ / T(speed_);
    rise_ = T(exponential(T((T(sheave.grip) * section.wrap + T(sheave.drag)) * T(tanh(slip))))) - T(1);
    share_ += before * rise_;
    lost_ += before * rise_ * passes_;
  }
  /// Sum of share times length, the last section included once it was passed.
  const T& weight() const { return weight_; }
  /// What sheaves dissipate for 1 N in the first section, W.
  const T& lost() const { return lost_; }
  /// Power of the friction on the last sheave for 1 N in the section before it, W.
  T last_power() const { return -rise_ * passes_; }

 private:
  T straining_ = T(0), passes_ = T(0);
  double speed_ = 1.0;
  T share_ = T(1), weight_ = T(0), lost_ = T(0), rise_ = T(0);
};

}  // namespace seacrane
