#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace seacrane {

/// A number of a load that changes its sign at a kink over the state: positive where nothing is met. With the
/// bound that is met where it turns negative; null: one without a name.
struct Margin {
  const char* bound = nullptr;
  double value = 1.0;

  bool passed() const { return !(value > 0.0); }
};

/// The margins of a load, in an order that does not change, 31 at most. A side is told by a bit for each that
/// is passed.
class Margins {
 public:
  static constexpr std::size_t kMost = 31;

  Margins() = default;
  template <std::size_t n>
  explicit Margins(const std::array<Margin, n>& all) {
    add(all);
  }

  void add(const Margin& one) { all_[count_++] = one; }
  template <std::size_t n>
  void add(const std::array<Margin, n>& more) {
    for (const Margin& one : more) add(one);
  }

  int side() const {
    int out = 0;
    for (std::size_t i = 0; i < count_; ++i) out |= all_[i].passed() ? 1 << i : 0;
    return out;
  }
  /// The least of those that change, positive on the first side: so the first crossing is found.
  double across(int from, int to) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
      if (((from ^ to) >> i & 1) == 0) continue;
      least = std::min(least, (from >> i & 1) != 0 ? -all_[i].value : all_[i].value);
    }
    return least;
  }

 private:
  std::array<Margin, kMost> all_;
  std::size_t count_ = 0;
};

/// The bounds among the first margins of a load that a change of its side meets, such as
/// "hoist.maximum_rate".
template <std::size_t n>
std::vector<std::string> bounds_met(const std::string& load, const std::array<Margin, n>& margins, int from,
                                    int to) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < n; ++i) {
    if (((to & ~from) >> i & 1) != 0 && margins[i].bound != nullptr) {
      out.push_back(load + "." + margins[i].bound);
    }
  }
  return out;
}

}  // namespace seacrane
