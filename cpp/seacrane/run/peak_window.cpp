#include "seacrane/run/peak_window.hpp"

#include <algorithm>
#include <cmath>

namespace seacrane {
namespace {

constexpr double kHighest = 0.25;  // of the larger difference beside it: a peak above is of no smooth curve
constexpr double kAbrupt = 0.25;  // of the slope on that side: a curve whose next slope is smaller has jumped
constexpr int kIterations = 4;

}  // namespace

void PeakWindow::drop_first() {
  std::copy(times_.begin() + 1, times_.end(), times_.begin());
  std::copy(values_.begin() + static_cast<std::ptrdiff_t>(curves_), values_.end(), values_.begin());
  --count_;
}

void PeakWindow::save(std::vector<double>& out) const {
  out.push_back(static_cast<double>(count_));
  out.push_back(all_seen_ ? 1.0 : 0.0);
  out.insert(out.end(), times_.begin(), times_.end());
  for (const double value : values_) out.push_back(std::isnan(value) ? 0.0 : value);
}

const double* PeakWindow::load(const double* saved) {
  count_ = static_cast<std::size_t>(std::min(std::max(0.0, *saved++), static_cast<double>(kMost)));
  all_seen_ = *saved++ != 0.0;
  std::copy_n(saved, times_.size(), times_.begin());
  std::copy_n(saved + times_.size(), values_.size(), values_.begin());
  return saved + times_.size() + values_.size();
}

/// Of a curve whose value at i is larger or smaller than both beside it.
std::optional<PeakWindow::Peak> PeakWindow::peak(std::size_t i, std::size_t curve) const {
  const double here = value(i, curve), before = here - value(i - 1, curve),
               after = here - value(i + 1, curve);
  const bool falls = std::abs(after) > std::abs(before);
  const double largest = std::max(std::abs(before), std::abs(after));
  if (falls ? i + 2 < count_ : i >= 2) {
    const std::size_t near = falls ? i + 1 : i - 1, far = falls ? i + 2 : i - 2;
    const double share = (times_[far] - times_[near]) / (times_[near] - times_[i]);
    if (!(std::abs(value(near, curve) - value(far, curve)) >= kAbrupt * share * largest)) return std::nullopt;
  }
  const double scale = 0.5 * (times_[i + 1] - times_[i - 1]), start = (times_[i - 1] - times_[i]) / scale,
               end = (times_[i + 1] - times_[i]) / scale;
  // The parabola through three.
  const double bend = (-before / start + after / end) / (start - end), slope = -before / start - bend * start;
  const double vertex = -slope / (2.0 * bend), top = here + 0.5 * slope * vertex;
  // The polynomial through all, by divided differences.
  std::array<double, kMost> place{}, factor{};
  for (std::size_t j = 0; j < count_; ++j) {
    place[j] = (times_[j] - times_[i]) / scale;
    factor[j] = value(j, curve) - here;
  }
  for (std::size_t order = 1; order < count_; ++order) {
    for (std::size_t j = count_ - 1; j >= order; --j) {
      factor[j] = (factor[j] - factor[j - 1]) / (place[j] - place[j - order]);
    }
  }
  double s = std::clamp(vertex, start, end), rise = 0.0;
  bool converges = true;
  for (int n = 0; n <= kIterations; ++n) {
    double p = factor[count_ - 1], first = 0.0, second = 0.0;
    for (std::size_t j = count_ - 1; j-- > 0;) {
      const double x = s - place[j];
      second = second * x + 2.0 * first;
      first = first * x + p;
      p = p * x + factor[j];
    }
    rise = p;
    if (n < kIterations) s -= first / second;
    if (!(s >= start && s <= end)) {
      converges = false;
      break;
    }
  }
  const double most = kHighest * largest, sign = before > 0.0 ? 1.0 : -1.0;
  if (converges && sign * rise >= 0.0 && sign * rise <= most) return Peak{times_[i] + s * scale, here + rise};
  if (!(sign * (top - here) >= 0.0 && sign * (top - here) <= most)) return std::nullopt;
  return Peak{times_[i] + vertex * scale, top};
}

}  // namespace seacrane
