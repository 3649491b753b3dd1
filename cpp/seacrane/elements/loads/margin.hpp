#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace seacrane {

/// On which side of its kinks a load is: one of its own names for it, as a rule which of its margins are
/// passed.
inline constexpr std::size_t kMostMargins = 128;
using Side = std::bitset<kMostMargins>;

inline Side side_of(std::initializer_list<std::size_t> passed) {
  Side out;
  for (const std::size_t i : passed) out.set(i);
  return out;
}

/// A number of a load that changes its sign at a kink over the state: positive where nothing is met. With the
/// bound that is met where it turns negative; null: one without a name.
struct Margin {
  const char* bound = nullptr;
  double value = 1.0;
};

/// The margins of a load, in an order that does not change, kMostMargins at most.
class Margins {
 public:
  Margins() {}  // without zeros
  template <std::size_t n>
  explicit Margins(const std::array<Margin, n>& all) {
    add(all);
  }

  void add(const Margin& one) { values_[count_++] = one.value; }
  template <std::size_t n>
  void add(const std::array<Margin, n>& more) {
    for (const Margin& one : more) add(one);
  }

  Side side() const {
    Side out;
    for (std::size_t i = 0; i < count_; ++i) out[i] = !(values_[i] > 0.0);
    return out;
  }
  /// The least of those that change, positive on the first side: so the first crossing is found.
  double across(const Side& from, const Side& to) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
      if (from[i] != to[i]) least = std::min(least, from[i] ? -values_[i] : values_[i]);
    }
    return least;
  }

 private:
  std::array<double, kMostMargins> values_;
  std::size_t count_ = 0;
};

/// The bounds among the first margins of a load that a change of its side meets, such as
/// "hoist.maximum_rate".
template <std::size_t n>
std::vector<std::string> bounds_met(const std::string& load, const std::array<Margin, n>& margins,
                                    const Side& from, const Side& to) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < n; ++i) {
    if (to[i] && !from[i] && margins[i].bound != nullptr) out.push_back(load + "." + margins[i].bound);
  }
  return out;
}

}  // namespace seacrane
