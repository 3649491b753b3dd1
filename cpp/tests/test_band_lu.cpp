#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>

#include "count_allocations.hpp"
#include "seacrane/math/band_lu.hpp"

namespace seacrane {

TEST_CASE("factors of a matrix within a band solve as those of Eigen, and allocate nothing") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (const Eigen::Index size : {1, 2, 3, 8, 41}) {
    for (const Eigen::Index band : {Eigen::Index{0}, Eigen::Index{1}, Eigen::Index{3}, size - 1}) {
      CAPTURE(size);
      CAPTURE(band);
      const MatXd a = MatXd::NullaryExpr(size, size, [&](Eigen::Index i, Eigen::Index j) {
        const double off = normal(random);  // small diagonals: rows are exchanged
        return std::abs(i - j) > band ? 0.0 : i == j && band > 0 ? 0.01 * off : off;
      });
      const VecXd right = VecXd::NullaryExpr(size, [&] { return normal(random); });
      BandLu lu(size, std::min(band, size - 1));
      VecXd x = right;
      for (int time = 0; time < 2; ++time) {  // what the first factors filled is written anew
        x = right;
        lu.clear();
        for (Eigen::Index j = 0; j < size; ++j) {
          const Eigen::Index first = std::max<Eigen::Index>(0, j - band), last = std::min(j + band, size - 1);
          for (Eigen::Index i = first; i <= last; ++i) lu.matrix()(i, j) = a(i, j);
        }
        const long before = test::allocation_count();
        lu.factor();
        lu.solve(x);
        CHECK(test::allocation_count() == before);
      }
      const VecXd expected = a.partialPivLu().solve(right);
      CHECK((a * x - right).norm() <= 1e-10 * (1.0 + x.norm()));
      CHECK((x - expected).norm() <= 1e-9 * expected.norm() * std::max(1.0, expected.norm()));
    }
  }
}

}  // namespace seacrane
