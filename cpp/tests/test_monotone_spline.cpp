#include <doctest/doctest.h>

#include "seacrane/math/dual.hpp"
#include "seacrane/math/monotone_spline.hpp"

namespace seacrane {
namespace {

using Row = Eigen::Matrix<double, 1, 1>;

MonotoneSpline<1> grown() {
  const std::vector<double> places{0.0, 0.3, 1.0, 1.2, 2.5};
  const std::vector<Row> values{Row(0.0), Row(0.4), Row(1.0), Row(1.6), Row(1.7)};
  return {places, values};
}

double at(const MonotoneSpline<1>& f, double x) { return x <= 0.0 ? 0.0 : f.at(x).value[0]; }

}  // namespace

TEST_CASE("a monotone spline over a stretch: its mean, its chord, and how far the ends' mean is above") {
  const auto f = grown();
  constexpr int kPieces = 200'000;
  for (const auto& [from, to] : {std::pair{-0.7, 0.1},
                                 {-3.0, 9.0},
                                 {0.05, 0.25},
                                 {0.1, 1.1},
                                 {0.95, 2.4},
                                 {2.0, 4.0},
                                 {3.0, 5.0},
                                 {0.35, 0.35 + 1e-3}}) {
    const double length = to - from, step = length / kPieces;
    double sum = 0.0;
    for (int i = 0; i < kPieces; ++i) sum += at(f, from + (i + 0.5) * step);
    const auto found = f.over(from, to);
    CHECK(found.mean[0] == doctest::Approx(sum / kPieces).epsilon(1e-8));
    CHECK(found.chord[0] == doctest::Approx((at(f, to) - at(f, from)) / length).epsilon(1e-9));
    const double above = 0.5 * (at(f, from) + at(f, to)) - sum / kPieces;
    CHECK(found.bend[0] * length == doctest::Approx(above).epsilon(1e-5));
  }
}

TEST_CASE("over nothing it is the value and the slope, and its derivatives are those of differences") {
  const auto f = grown();
  const auto here = f.at(0.7);
  const auto over = f.over(0.7, 0.7);
  CHECK(over.mean[0] == doctest::Approx(here.value[0]).epsilon(1e-14));
  CHECK(over.chord[0] == doctest::Approx(here.slope[0]).epsilon(1e-14));
  CHECK(over.bend[0] == 0.0);
  for (const auto& [from, to] : {std::pair{-0.2, 0.8}, {0.4, 0.9}, {0.1, 1.1}, {0.8, 3.0}}) {
    const auto both = f.over(Dual<2>::variable(from, 0), Dual<2>::variable(to, 1));
    constexpr double kStep = 1e-6;
    const double by_from = f.over(from + kStep, to).mean[0] - f.over(from - kStep, to).mean[0];
    const double by_to = f.over(from, to + kStep).mean[0] - f.over(from, to - kStep).mean[0];
    CHECK(both.mean[0].slope[0] == doctest::Approx(by_from / (2.0 * kStep)).epsilon(1e-6));
    CHECK(both.mean[0].slope[1] == doctest::Approx(by_to / (2.0 * kStep)).epsilon(1e-6));
  }
}

}  // namespace seacrane
