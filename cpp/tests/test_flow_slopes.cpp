#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "count_allocations.hpp"
#include "random_sea.hpp"
#include "seacrane/sea/sea_view.hpp"

using namespace seacrane;
using test::RandomSea;

namespace {

constexpr int kNumbers = 11;  // of a flow
using Numbers = Eigen::Matrix<double, kNumbers, 1>;

template <class T, class F>
void each(const LocalFlow<T>& flow, F&& f) {
  int i = 0;
  LocalFlow<double> none;
  LocalFlow<double>::each(flow, none, [&](const T& number, double&) { f(i++, number); });
}
Numbers numbers(const LocalFlow<double>& flow) {
  Numbers out;
  each(flow, [&](int i, double number) { out[i] = number; });
  return out;
}

/// A row that moves along one direction in all that it depends on.
struct Moving {
  FlowPoint at, rate;
  Vec3d step, step_rate;
  bool point;

  Moving(RandomSea& random, double z, bool of_point) : point(of_point) {
    at.position = random.vector(200.0);
    at.position.z() = z;
    rate.position = random.vector(1.0);
    step = 1.1 * random.vector(1.0).normalized();
    step_rate = random.vector(0.2);
    if (point) return;
    for (int j = 0; j < 3; ++j)
      at.extents.col(j) = random.vector(1.5), rate.extents.col(j) = random.vector(0.5);
    at.turning = random.vector(1.0), rate.turning = random.vector(1.0);
    at.height = random.number(0.0, 2.0), rate.height = random.number(-0.3, 0.3);
  }
  FlowPoint place(double h) const {
    return {at.position + h * rate.position, at.extents + h * rate.extents, at.turning + h * rate.turning,
            at.height + h * rate.height};
  }
  LocalFlow<double> flow(const SeaView& view, int stencil, int n, double t, double h) const {
    if (point) return view.at_point<double>(stencil, t, place(h).position);
    return view.in_row<double>(stencil, n, t, place(h), step + h * step_rate);
  }
  LocalFlow<Dual<1>> slopes(const SeaView& view, int stencil, int n, double t) const {
    const auto dual = [](double value, double slope) {
      Dual<1> out(value);
      out.slope[0] = slope;
      return out;
    };
    const FlowPlace<Dual<1>> first{at.position.binaryExpr(rate.position, dual),
                                   at.extents.binaryExpr(rate.extents, dual),
                                   at.turning.binaryExpr(rate.turning, dual), dual(at.height, rate.height)};
    if (point) return view.at_point<Dual<1>>(stencil, t, first.position);
    return view.in_row<Dual<1>>(stencil, n, t, first, Vec3<Dual<1>>(step.binaryExpr(step_rate, dual)));
  }
  /// Seven-point differences.
  Numbers differences(const SeaView& view, int stencil, int n, double t, double h) const {
    const auto odd = [&](double by) -> Numbers {
      return numbers(flow(view, stencil, n, t, by * h)) - numbers(flow(view, stencil, n, t, -by * h));
    };
    return (0.75 * odd(1.0) - 0.15 * odd(2.0) + odd(3.0) / 60.0) / h;
  }
};

/// Checks the slopes at a place. False where the flow jumps or has a kink between the differences: where the
/// surface is met, and where one pack of components more or less reaches.
bool agree(const SeaView& view, int stencil, int n, double t, const Moving& row, const Numbers& size) {
  constexpr double h = 4e-3, bound = 1e-10;
  const Numbers coarse = row.differences(view, stencil, n, t, h),
                fine = row.differences(view, stencil, n, t, 0.5 * h);
  if (((coarse - fine).array().abs() > 0.5 * bound * size.array()).any()) return false;
  const Numbers here = numbers(row.flow(view, stencil, n, t, 0.0));
  each(row.slopes(view, stencil, n, t), [&](int i, const Dual<1>& number) {
    CAPTURE(i);
    CHECK(std::fabs(number.value - here[i]) < 1e-12 * size[i]);
    CHECK(std::fabs(number.slope[0] - fine[i]) < bound * size[i]);
  });
  return true;
}

constexpr double kDeep = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("slopes are those of the few components, in 60 seas, at all depths, in and between regions") {
  const std::vector<FlowStencil> stencils = {
      {.name = "row", .count = 9, .waves = 1.3, .reach = 6.0, .width = 3.0},
      {.name = "point", .surface = false, .reach = 0.0}};
  RandomSea random{std::mt19937_64(41)};
  int compared = 0, between = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const double depth = trial % 2 ? kDeep : random.number(30.0, 90.0), t = random.number(0.0, 9e3);
    const auto sea = random.long_crested(depth, trial % 3 ? Current() : test::shear());
    const auto near = NearSea::of(sea, stencils);
    REQUIRE(near);
    const SeaView view(sea, stencils, near);
    const bool point = trial % 5 == 4;
    Moving row(random, trial % 4 < 2 ? random.number(-28.0, 2.0) : -20.0 * random.number(0.0, 1.0), point);
    if (trial % 3 == 1) {  // into the overlap of two regions
      const Vec3d along(sea->arrays().x[0], sea->arrays().y[0], 0.0);
      const Vec3d middle = row.at.position + (point ? 0.0 : 4.0) * row.step;
      const double place =
          (std::floor(random.number(-9.0, 9.0)) + 0.5 + random.number(-0.12, 0.12)) * near->spacing();
      row.at.position += (place - along.dot(middle)) * along;
      ++between;
    }
    const Numbers size = 1.3 * numbers(sea->magnitude()).array() + 1e-3;
    compared += agree(view, point ? 1 : 0, point ? 0 : trial % 9, t, row, size);
  }
  CHECK(between == 20);
  CHECK(compared > 54);
}

TEST_CASE("slopes of all components: short-crested, wide, deep below the waves, without stretching") {
  RandomSea random{std::mt19937_64(42)};
  int compared = 0;
  for (int trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const double depth = trial % 2 ? kDeep : random.number(15.0, 60.0), t = random.number(0.0, 300.0);
    const Current current = trial % 3 ? Current() : test::shear();
    const auto stretching = trial % 4 == 3 ? Stretching::none : Stretching::wheeler;
    const auto sea = std::make_shared<const SeaField>(random.waves(70, depth, current), stretching);
    const SeaView view(
        sea, {{.name = "row", .count = 9, .cut = 1e-14}, {.name = "point", .cut = 1e-3, .surface = false}});
    const bool point = trial % 5 == 4;  // at a depth that few components reach
    const Moving row(random, point ? (trial % 2 ? -90.0 : -14.5) : random.number(-14.0, 2.0), point);
    const Numbers size = numbers(sea->magnitude()).array() + 1e-3;
    compared += agree(view, point ? 1 : 0, point ? 0 : trial % 9, t, row, size);
  }
  CHECK(compared > 36);
}

TEST_CASE("slopes of a row are summed once, whatever was asked before, and allocate nothing") {
  RandomSea random{std::mt19937_64(43)};
  const auto sea = random.long_crested(kDeep, {});
  const std::vector<FlowStencil> stencils = {{.name = "row", .count = 9, .reach = 6.0, .width = 3.0}};
  const SeaView view(sea, stencils, NearSea::of(sea, stencils)),
      other(sea, stencils, NearSea::of(sea, stencils));
  const Moving row(random, -2.0, false), elsewhere(random, -3.0, false);
  const long before = test::allocation_count();
  elsewhere.slopes(other, 0, 3, 7.0);
  for (int n = 0; n < 9; ++n) {
    const LocalFlow<double> flow = row.flow(other, 0, n, 9.0, 0.0);
    const LocalFlow<Dual<1>> one = row.slopes(view, 0, n, 9.0), two = row.slopes(other, 0, n, 9.0);
    LocalFlow<Dual<1>> same = two;
    LocalFlow<Dual<1>>::each(one, same, [](const Dual<1>& a, const Dual<1>& b) {
      CHECK(a.value == b.value);
      CHECK(a.slope[0] == b.slope[0]);
    });
    CHECK(std::fabs(flow.pressure - one.pressure.value) < 1e-12);
  }
  CHECK(test::allocation_count() == before);
}
