#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace seacrane {

struct Stepper;

/// Tensions of the links described and forces of the drivers described: what holds a distance or a
/// coordinate.
class HeldForces {
 public:
  /// As the last derivative() of what is stepped has them; not a number where it does not know one.
  void read_stepped(const Stepper& at);
  /// As the last derivative() of the described system has them.
  void read_described(const Stepper& at);

  bool known() const {
    return std::ranges::none_of(forces_, [](double force) { return std::isnan(force); });
  }
  std::span<const double> links() const { return std::span(forces_).first(links_); }
  std::span<const double> drivers() const { return std::span(forces_).subspan(links_); }

 private:
  void find(const Stepper& at);
  int stepped_element(const Stepper& at, int described) const;

  const Stepper* found_in_ = nullptr;
  std::size_t links_ = 0;
  std::vector<int> described_, stepped_;  // elements of each: links, then drivers
  std::vector<double> forces_;
};

}  // namespace seacrane
