#include <doctest/doctest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <thread>
#include <vector>

#include "seacrane/strip/section_panels.hpp"
#include "seacrane/strip/section_solver.hpp"

using namespace seacrane::strip;

namespace {

HalfSection box(double half_breadth, double draught) {
  HalfSection s(3, 2);
  s << half_breadth, 0.0, half_breadth, -draught, 0.0, -draught;
  return s;
}

HalfSection circle(int count) {
  HalfSection s(count + 1, 2);
  for (int i = 0; i <= count; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / count;
    s.row(i) << std::cos(angle), -std::sin(angle);
  }
  return s;
}

}  // namespace

TEST_CASE("panels keep corners, end on waterline and keel, shrink towards corners, face the fluid") {
  const SectionPanels p = make_panels(checked(box(12.0, 6.0), "box"), 30);
  CHECK(p.node.front() == std::complex<double>(0.0, 0.0));
  CHECK(p.node[p.lid] == std::complex<double>(12.0, 0.0));
  CHECK(p.node.back() == std::complex<double>(0.0, -6.0));
  CHECK(p.count() - p.lid == 30);
  bool corner = false;
  double shortest_side = 6.0, shortest_bottom = 12.0;
  for (std::size_t j = p.lid; j < p.count(); ++j) {
    corner = corner || p.end(j) == std::complex<double>(12.0, -6.0);
    const bool side = p.middle(j).real() == 12.0;
    CHECK(std::abs(p.normal(j) - (side ? std::complex<double>(1.0, 0.0) : std::complex<double>(0.0, -1.0))) <
          1e-12);
    double& shortest = side ? shortest_side : shortest_bottom;
    shortest = std::min(shortest, p.length(j));
  }
  CHECK(corner);
  CHECK(shortest_side == doctest::Approx(p.length(p.lid)));
  CHECK(shortest_side < 0.3 * 18.0 / 30.0);
  CHECK(p.length(p.count() - 1) > 2.0 * shortest_bottom);
}

TEST_CASE("cleaning a section removes repeats and noise, and nothing else") {
  HalfSection noisy(5, 2);
  noisy << 12.0, 1e-9, 12.0, 0.0, 12.0, -6.0, 12.0, -6.0, -1e-9, -6.0;
  CHECK(checked(noisy, "box") == box(12.0, 6.0));
  CHECK(checked(HalfSection::Zero(4, 2), "point").rows() == 0);
  CHECK(thickened(box(12.0, 6.0)) == box(12.0, 6.0));
  const HalfSection thin = thickened(box(0.0, 6.0));
  CHECK(thin(0, 0) == doctest::Approx(0.12));
  CHECK(thin(2, 0) == 0.0);
}

TEST_CASE("a section's solution does not depend on other threads") {
  const SectionSolver solver(checked(circle(50), "circle"), {});
  const Eigen::Matrix3d alone = solver.solve(2.0).coefficients.added_mass;
  std::vector<Eigen::Matrix3d> found(4);
  std::vector<std::thread> threads;
  for (Eigen::Matrix3d& value : found) {
    threads.emplace_back([&] {
      for (int repeat = 0; repeat < 20; ++repeat) value = solver.solve(2.0).coefficients.added_mass;
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const Eigen::Matrix3d& value : found) CHECK(value == alone);
}
