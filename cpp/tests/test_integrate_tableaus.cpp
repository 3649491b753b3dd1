#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <iterator>

#include "rooted_trees.hpp"
#include "seacrane/integrate/tableaus/carpenter_kennedy.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54.hpp"
#include "seacrane/integrate/tableaus/dormand_prince54_implicit.hpp"
#include "seacrane/integrate/tableaus/pairs.hpp"
#include "seacrane/integrate/tableaus/rang_angermann34.hpp"

namespace seacrane::test {
namespace {

using namespace tableaus;

/// Roundings a sum over the stages may gather; the digits of the tableaus go beyond them.
constexpr long double rounding = 30.0L;
long double exact(const RootedTree& tree) { return 1.0L / tree.density; }
long double nothing(const RootedTree&) { return 0.0L; }

template <class Array>
Matrix matrix_of(const Array& array) {
  Matrix out;
  for (const auto& row : array) out.emplace_back(std::begin(row), std::end(row));
  return out;
}

template <class T>
Matrix stages_of() {
  Matrix a = matrix_of(T::a);
  a.resize(T::stages + 1);
  for (auto& row : a) row.resize(T::stages);
  return a;
}

/// Defect of the step's weights, the row `stages` of a.
template <class T>
long double step_defect(const Matrix& a, int order) {
  const auto trees = rooted_trees(order);
  return defect(trees, StageWeights(trees, a), a[T::stages], exact);
}

long double error_defect(const Matrix& a, const std::vector<long double>& error, int order) {
  const auto trees = rooted_trees(order);
  return defect(trees, StageWeights(trees, a), error, nothing);
}

}  // namespace

TEST_CASE("there are as many rooted trees as there should be") {
  const std::size_t up_to[] = {1, 2, 4, 8, 17, 37, 85, 200, 486};
  for (int order = 1; order <= 9; ++order) CHECK(rooted_trees(order).size() == up_to[order - 1]);
}

TEST_CASE_TEMPLATE_DEFINE("a pair and its dense output have their orders and no more", T, orders_of_a_pair) {
  CAPTURE(std::string(T::name));
  const Matrix a = stages_of<T>();
  CHECK(step_defect<T>(a, T::order) < rounding);
  CHECK(step_defect<T>(a, T::order + 1) > 1e6L);

  const std::vector<long double> error(std::begin(T::error), std::end(T::error));
  CHECK(error_defect(a, error, T::error_order) < rounding);
  CHECK(error_defect(a, error, T::error_order + 1) > 1e6L);
  if constexpr (requires { T::low_order_error; }) {
    const std::vector<long double> low(std::begin(T::low_order_error), std::end(T::low_order_error));
    CHECK(error_defect(a, low, T::low_error_order) < rounding);
    CHECK(error_defect(a, low, T::low_error_order + 1) > 1e6L);
  }

  // The weights of dense output are polynomials: each power meets the conditions of the trees of its order.
  const auto dense_defect = [&](int order) {
    const auto trees = rooted_trees(order);
    const StageWeights weights(trees, matrix_of(T::a));
    long double worst = 0.0L;
    for (std::size_t power = 1; power <= std::size(T::dense[0]); ++power) {
      std::vector<long double> b;
      for (const auto& row : T::dense) b.push_back(row[power - 1]);
      worst = std::max(worst, defect(trees, weights, b, [&](const RootedTree& tree) {
                         return tree.order == static_cast<int>(power) ? exact(tree) : 0.0L;
                       }));
    }
    return worst;
  };
  CHECK(dense_defect(T::dense_order) < rounding);
  CHECK(dense_defect(T::dense_order + 1) > 1e6L);
  // It ends where the step ends, and no stage looks ahead.
  for (std::size_t j = 0; j < std::size(T::dense); ++j) {
    long double sum = 0.0L, size = 1.0L;
    for (const long double value : T::dense[j]) {
      sum += value;
      size += std::abs(value);
    }
    const long double weight = j < T::stages ? T::a[T::stages][j] : 0.0L;
    CHECK(std::abs(sum - weight) < 1e-18L * size);
    for (std::size_t i = j; i < std::size(T::a[0]); ++i) CHECK(T::a[j][i] == 0.0L);
  }
}
TEST_CASE_TEMPLATE_APPLY(orders_of_a_pair, tableaus::Pairs);

TEST_CASE_TEMPLATE_DEFINE("no coefficient of a pair can be wrong in its twelfth digit", T, digits_of_a_pair) {
  CAPTURE(std::string(T::name));
  const Matrix a = stages_of<T>();
  const std::vector<long double> error(std::begin(T::error), std::end(T::error));
  const auto right = [](const Matrix& rows, const std::vector<long double>& weights) {
    return step_defect<T>(rows, T::order) < rounding &&
           error_defect(rows, weights, T::error_order) < rounding;
  };
  CHECK(right(a, error));
  for (std::size_t i = 0; i <= T::stages; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (a[i][j] == 0.0L) continue;
      CAPTURE(i);
      CAPTURE(j);
      Matrix wrong = a;
      wrong[i][j] *= 1.0L + 1e-12L;
      CHECK_FALSE(right(wrong, error));
    }
    if (i < error.size() && error[i] != 0.0L) {
      std::vector<long double> wrong = error;
      wrong[i] *= 1.0L + 1e-12L;
      CHECK_FALSE(right(a, wrong));
    }
  }
}
TEST_CASE_TEMPLATE_APPLY(digits_of_a_pair, tableaus::Pairs);

TEST_CASE("the low-storage method has order 4 as a Runge-Kutta method") {
  using T = CarpenterKennedy;
  // The registers as combinations of the slopes: row i of a is what u holds before stage i.
  Matrix a(T::stages + 1, std::vector<long double>(T::stages, 0.0L));
  std::vector<long double> change(T::stages, 0.0L), u(T::stages, 0.0L);
  for (std::size_t i = 0; i < T::stages; ++i) {
    long double node = 0.0L;
    for (std::size_t j = 0; j < T::stages; ++j) {
      node += u[j];
      change[j] *= T::a[i];
    }
    CHECK(std::abs(node - T::c[i]) < 1e-17L);
    change[i] += 1.0L;
    for (std::size_t j = 0; j < T::stages; ++j) u[j] += T::b[i] * change[j];
    a[i + 1] = u;
  }
  // Published as fractions of twelve digits, which leaves more than rounding.
  const auto trees = rooted_trees(4);
  const StageWeights weights(trees, a);
  CHECK(defect(trees, weights, u, exact) * std::numeric_limits<long double>::epsilon() < 1e-17L);
  CHECK(step_defect<T>(a, 5) > 1e6L);
}

TEST_CASE(
    "the implicit companion of Dormand and Prince couples with the pair up to order 4, for any matrix") {
  // A node of the linear part has one branch. Weights and matrices are those of the part that a node is of.
  constexpr std::size_t n = 7;
  using Weights = std::array<double, n>;
  std::array<std::array<double, n>, n> a[2] = {};  // explicit, implicit
  Weights c{}, row_sum{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      if (j < n - 1) a[0][i][j] = static_cast<double>(DormandPrince54::a[i][j]);
      a[1][i][j] = DormandPrince54Implicit::a[i][j];
      c[i] += a[0][i][j];
      row_sum[i] += a[1][i][j];
    }
    CHECK(std::abs(row_sum[i] - c[i]) < 1e-14);
  }
  const auto through = [&](int part, const Weights& x) {
    Weights out{};
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= i; ++j) out[i] += a[part][i][j] * x[j];
    }
    return out;
  };
  const auto sum = [&](int part, const Weights& x) {
    double out = 0.0;
    for (std::size_t j = 0; j < n; ++j) out += a[part][n - 1][j] * x[j];
    return out;
  };
  const auto times_c = [&](Weights x) {
    for (std::size_t i = 0; i < n; ++i) x[i] *= c[i];
    return x;
  };
  const Weights square = times_c(c);
  for (const int i : {0, 1}) {
    CHECK(std::abs(sum(i, c) - 1.0 / 2.0) < 1e-14);
    CHECK(std::abs(sum(0, times_c(through(i, c))) - 1.0 / 8.0) < 1e-14);
    CHECK(std::abs(sum(i, through(0, square)) - 1.0 / 12.0) < 1e-14);
    for (const int j : {0, 1}) {
      CHECK(std::abs(sum(i, through(j, c)) - 1.0 / 6.0) < 1e-14);
      for (const int k : {0, 1}) {
        CHECK(std::abs(sum(i, through(j, through(k, c))) - 1.0 / 24.0) < 1e-14);
      }
    }
  }
  // A-stable with the exact matrix, but for little: the last stage on the imaginary axis.
  for (double y = 1e-2; y < 1e5; y *= 1.2) {
    std::array<std::complex<double>, n> stage{};
    for (std::size_t i = 0; i < n; ++i) {
      std::complex<double> right = 1.0;
      for (std::size_t j = 0; j < i; ++j) right += std::complex<double>(0.0, y) * a[1][i][j] * stage[j];
      stage[i] = right / (1.0 - std::complex<double>(0.0, y) * a[1][i][i]);
    }
    CHECK(std::abs(stage[n - 1]) < 1.0 + 1e-3);
  }
}

TEST_CASE("the Rosenbrock method has order 3 for any matrix in the place of the Jacobian") {
  // Conditions of a W-method up to order 3 [Hairer, Wanner, Solving Ordinary Differential Equations II,
  // IV.7].
  using T = RangAngermann34;
  constexpr std::size_t n = T::stages;
  double alpha[n] = {}, gamma[n] = {};
  for (std::size_t i = 0; i < n; ++i) {
    gamma[i] = T::gamma;
    for (std::size_t j = 0; j < i; ++j) {
      alpha[i] += T::a[i][j];
      gamma[i] += T::coupling[i][j];
    }
  }
  const auto entry = [](std::size_t i, std::size_t j) { return i == j ? T::gamma : T::coupling[i][j]; };
  const auto conditions = [&](const double* b) {
    std::array<double, 8> sums{};
    for (std::size_t i = 0; i < n; ++i) {
      sums[0] += b[i];
      sums[1] += b[i] * alpha[i];
      sums[2] += b[i] * gamma[i];
      sums[3] += b[i] * alpha[i] * alpha[i];
      for (std::size_t j = 0; j <= i; ++j) {
        sums[4] += b[i] * T::a[i][j] * alpha[j];
        sums[5] += b[i] * T::a[i][j] * gamma[j];
        sums[6] += b[i] * entry(i, j) * alpha[j];
        sums[7] += b[i] * entry(i, j) * gamma[j];
      }
    }
    return sums;
  };
  const double expected[8] = {1.0, 0.5, 0.0, 1.0 / 3.0, 1.0 / 6.0, 0.0, 0.0, 0.0};
  const auto step = conditions(T::b), embedded = conditions(T::embedded);
  for (std::size_t i = 0; i < 8; ++i) {
    CHECK(std::abs(step[i] - expected[i]) < 1e-15);
    if (i < 3) CHECK(std::abs(embedded[i] - expected[i]) < 1e-15);
  }
  CHECK(std::abs(embedded[3] - expected[3]) > 1e-2);
  // Stiffly accurate: the last stage's row is the step's.
  for (std::size_t j = 0; j + 1 < n; ++j)
    CHECK(std::abs(T::a[n - 1][j] + T::coupling[n - 1][j] - T::b[j]) < 1e-15);
}

}  // namespace seacrane::test
