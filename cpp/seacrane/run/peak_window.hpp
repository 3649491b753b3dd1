#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace seacrane {

/// The last values of several curves in a smooth stretch of a run, and their peaks between these: where a
/// value is larger or smaller than both beside it, the peak of the polynomial through all that are held.
/// Nothing is allocated after construction.
class PeakWindow {
 public:
  explicit PeakWindow(std::size_t curves) : curves_(curves), values_(kMost * curves, 0.0) {}

  bool empty() const { return count_ == 0; }

  /// Adds the values of all curves at a time; calls found(curve, time, value) for them, and for peaks that
  /// they show between the values before. A time that is not later than the last is left out.
  template <class Found>
  void add(double time, const double* values, Found&& found) {
    if (count_ > 0 && !(time > times_[count_ - 1])) return;
    if (count_ == kMost) drop_first();
    times_[count_] = time;
    std::copy_n(values, curves_, values_.begin() + static_cast<std::ptrdiff_t>(count_ * curves_));
    ++count_;
    for (std::size_t k = 0; k < curves_; ++k) found(k, time, values[k]);
    if (count_ < kMost) return;
    if (!all_seen_) look(1, found);
    look(kMost / 2, found);
    all_seen_ = true;
  }

  /// Ends the stretch: looks for the peaks that values to come would have shown.
  template <class Found>
  void end(Found&& found) {
    const std::size_t first = all_seen_ && count_ == kMost ? kMost / 2 + 1 : 1;
    for (std::size_t i = first; i + 1 < count_; ++i) look(i, found);
    forget();
  }

  /// Ends the stretch without a look at it.
  void forget() {
    count_ = 0;
    all_seen_ = false;
  }
  /// Appends what a window that goes on holds, and takes it back; returns what follows.
  void save(std::vector<double>& out) const;
  const double* load(const double* saved);

 private:
  static constexpr std::size_t kMost = 5;

  struct Peak {
    double time, value;
  };

  double value(std::size_t i, std::size_t curve) const { return values_[i * curves_ + curve]; }
  void drop_first();
  std::optional<Peak> peak(std::size_t i, std::size_t curve) const;

  template <class Found>
  void look(std::size_t i, Found&& found) const {
    for (std::size_t k = 0; k < curves_; ++k) {
      const double here = value(i, k), before = here - value(i - 1, k), after = here - value(i + 1, k);
      if (!(before * after > 0.0)) continue;
      if (const std::optional<Peak> one = peak(i, k)) found(k, one->time, one->value);
    }
  }

  std::size_t curves_, count_ = 0;
  bool all_seen_ = false;  // but for the last two of a full window
  std::array<double, kMost> times_{};
  std::vector<double> values_;  // by time
};

}  // namespace seacrane
