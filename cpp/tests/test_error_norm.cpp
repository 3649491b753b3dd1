#include <doctest/doctest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "seacrane/integrate/error_norm.hpp"

using namespace seacrane;

TEST_CASE("the norm of systems side by side is that of the worst of them, each counted by itself") {
  const std::vector<double> absolute{1e-3, 2e-3, std::numeric_limits<double>::infinity(), 5e-3};
  const std::vector<double> y{0.3, -0.7, 2.0, 0.1}, error{2e-4, -3e-4, 7.0, 1e-4};
  const ErrorNorm alone({.relative = 1e-4, .absolute = absolute}, y.size());
  for (const std::size_t lanes : {4, 8}) {
    Tolerances tolerances{.relative = 1e-4, .absolute = {}, .lanes = lanes};
    std::vector<double> states, errors;
    for (std::size_t i = 0; i < y.size(); ++i) {
      for (std::size_t j = 0; j < lanes; ++j) {
        tolerances.absolute.push_back(absolute[i]);
        states.push_back(y[i]);
        errors.push_back(static_cast<double>(j + 1) * error[i]);
      }
    }
    const ErrorNorm norm(tolerances, states.size());
    const double one = alone.norm(error.data(), y.data());
    CHECK(norm.norm(errors.data(), states.data()) == doctest::Approx(static_cast<double>(lanes) * one));
    const ErrorNorm::Lanes each = norm.norms(errors.data(), states.data());
    for (std::size_t j = 0; j < lanes; ++j) {
      CHECK(each[j] == doctest::Approx(static_cast<double>(j + 1) * one));
    }
  }
}
