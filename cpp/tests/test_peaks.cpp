#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "seacrane/run/peak_window.hpp"

namespace seacrane::test {
namespace {

struct Range {
  double least = 1e300, largest = -1e300;
};

/// What a window shows of values at times.
template <class Curve>
Range seen(const std::vector<double>& times, Curve&& curve) {
  PeakWindow window(1);
  Range out;
  const auto found = [&](std::size_t, double, double value) {
    out = {std::min(out.least, value), std::max(out.largest, value)};
  };
  for (const double t : times) {
    const double value = curve(t);
    window.add(t, &value, found);
  }
  window.end(found);
  CHECK(window.empty());
  return out;
}

std::vector<double> times(double end, double step, double uneven) {
  std::vector<double> out{0.0};
  for (int i = 0; out.back() < end; ++i) out.push_back(out.back() + step * (i % 2 == 0 ? 1.0 : uneven));
  return out;
}

}  // namespace

TEST_CASE("a window finds the peaks of a wave to a thousandth from 16 values a period") {
  const double period = 2.0 * 3.14159265358979;
  for (double phase = 0.0; phase < period; phase += 0.1) {
    for (const double uneven : {1.0, 0.5, 1.7}) {
      const Range found = seen(times(3.0 * period, period / 16.0, uneven),
                               [&](double t) { return 2.0 + std::cos(t + phase); });
      CHECK(found.largest == doctest::Approx(3.0).epsilon(uneven > 1.0 ? 4e-3 : 1e-3));
      CHECK(found.least == doctest::Approx(1.0).epsilon(uneven > 1.0 ? 1e-2 : 3e-3));
    }
  }
}

TEST_CASE("where no smooth curve leads through all values, a peak is that of the parabola through three") {
  const std::vector<double> values{9.0, 7.0, 10.0, 9.0, -10.0};
  const auto at = [&](double t) { return values[static_cast<std::size_t>(t)]; };
  CHECK(seen({0.0, 1.0, 2.0, 3.0, 4.0}, at).largest == doctest::Approx(10.125).epsilon(1e-12));
}

TEST_CASE("a window finds the peak of a hit that ends with it, and makes none of a jump") {
  const auto hit = [](double t) { return std::sin(3.14159265358979 * t); };
  CHECK(seen(times(0.99, 0.2, 1.0), hit).largest == doctest::Approx(1.0).epsilon(1e-3));
  const auto angle = [](double t) { return t < 5.0 ? t : t - 10.0; };
  const Range found = seen(times(10.0, 0.3, 1.0), angle);
  CHECK(found.largest < 5.0);
  CHECK(found.least > -5.2);
  CHECK(seen(times(10.0, 0.3, 1.0), [](double t) { return t < 5.0 ? 1.0 : 0.0; }).largest == 1.0);
}

TEST_CASE("a window that is saved goes on") {
  PeakWindow whole(2), first(2);
  std::vector<double> of_whole, of_parts;
  const auto into = [](std::vector<double>& out) {
    return [&out](std::size_t, double, double value) { out.push_back(value); };
  };
  for (int i = 0; i < 20; ++i) {
    const std::vector<double> values{std::sin(0.4 * i), std::cos(0.5 * i)};
    whole.add(i, values.data(), into(of_whole));
    first.add(i, values.data(), into(of_parts));
    std::vector<double> saved;
    first.save(saved);
    first = PeakWindow(2);
    CHECK(first.load(saved.data()) == saved.data() + saved.size());
  }
  CHECK(of_whole == of_parts);
}

}  // namespace seacrane::test
