#include <doctest/doctest.h>

#include <Eigen/LU>
#include <random>

#include "count_allocations.hpp"
#include "seacrane/integrate/sparse_lu.hpp"
#include "seacrane/math/types.hpp"

namespace seacrane {

TEST_CASE("factors that skip zeros solve as those of Eigen, and allocate nothing") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  for (const Eigen::Index size : {1, 2, 7, 64, 65, 130}) {
    for (const double share : {0.02, 0.1, 1.0}) {
      CAPTURE(size);
      CAPTURE(share);
      // A cycle keeps it regular while half of the diagonal is zero, as multipliers have it.
      const MatXd a = MatXd::NullaryExpr(size, size, [&](Eigen::Index i, Eigen::Index j) {
        const double own = (j == (i + 1) % size ? 4.0 : 0.0) + (i == j && i % 2 == 1 ? 1.0 : 0.0);
        return own + (i != j && uniform(random) < share ? normal(random) : 0.0);
      });
      const VecXd right = VecXd::NullaryExpr(size, [&] { return normal(random); });
      SparseLu lu(static_cast<std::size_t>(size));
      VecXd x = right;
      for (int time = 0; time < 2; ++time) {  // what the first factors filled is written anew
        x = right;
        Eigen::Map<MatXd>(lu.column(0), size, size) = a;
        const long before = test::allocation_count();
        CHECK(lu.factor());
        lu.solve(x.data());
        CHECK(test::allocation_count() == before);
      }
      const VecXd expected = a.partialPivLu().solve(right);
      CHECK((a * x - right).norm() <= 1e-10 * (1.0 + x.norm()));
      CHECK((x - expected).norm() <= 1e-9 * expected.norm() * std::max(1.0, expected.norm()));
    }
  }
}

TEST_CASE("a matrix whose rows depend on each other has no factors") {
  SparseLu lu(3);
  Eigen::Map<MatXd>(lu.column(0), 3, 3) << 1, 2, 0, 2, 4, 0, 0, 1, 0;
  CHECK_FALSE(lu.factor());
}

}  // namespace seacrane
