#include "seacrane/math/curve_table.hpp"

#include <cmath>
#include <stdexcept>

namespace seacrane {
namespace {

std::string sample(const char* of, std::size_t i, double value) {
  return "curve: " + std::string(of) + "[" + std::to_string(i) + "] is " + std::to_string(value);
}

void check_samples(const std::vector<double>& times, const std::vector<double>& values) {
  if (times.size() != values.size()) {
    throw std::invalid_argument("curve: there are " + std::to_string(times.size()) + " times and " +
                                std::to_string(values.size()) + " values; give one value for each time");
  }
  if (times.size() < 2) throw std::invalid_argument("curve: a table has two samples at least; give more");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) {
      throw std::invalid_argument(sample("times", i, times[i]) + "; give finite ones");
    }
    if (!std::isfinite(values[i])) {
      throw std::invalid_argument(sample("values", i, values[i]) + "; give finite ones");
    }
    if (i > 0 && !(times[i] > times[i - 1])) {
      throw std::invalid_argument(sample("times", i, times[i]) + " s, not after " +
                                  std::to_string(times[i - 1]) + " s before it; give times that increase");
    }
  }
}

/// Rates of the cubic spline at its samples, zero at both ends: Thomas' algorithm on the condition that the
/// acceleration is continuous.
std::vector<double> rates_at(const std::vector<double>& t, const std::vector<double>& x) {
  const std::size_t n = t.size();
  std::vector<double> above(n, 0.0), rate(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = 1.0 / (t[i] - t[i - 1]), after = 1.0 / (t[i + 1] - t[i]);
    const double pull = 3.0 * ((x[i] - x[i - 1]) * before * before + (x[i + 1] - x[i]) * after * after) -
                        before * rate[i - 1];
    const double pivot = 2.0 * (before + after) - before * above[i - 1];
    above[i] = after / pivot;
    rate[i] = pull / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) rate[i] -= above[i] * rate[i + 1];
  return rate;
}

Curve::Piece piece(double start, double value) {
  Curve::Piece out;
  out.start = start;
  out.coefficients[0] = value;
  return out;
}

}  // namespace

Curve tabulated(const std::vector<double>& times, const std::vector<double>& values,
                const std::string& between) {
  const bool cubic = between == "cubic";
  if (!cubic && between != "linear") {
    throw std::invalid_argument("curve: between is '" + between + "'; choose 'linear' or 'cubic'");
  }
  check_samples(times, values);
  const std::vector<double> rates = cubic ? rates_at(times, values) : std::vector<double>{};
  std::vector<Curve::Piece> pieces;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const double h = times[i + 1] - times[i], mean = (values[i + 1] - values[i]) / h;
    pieces.push_back(piece(times[i], values[i]));
    auto& c = pieces.back().coefficients;
    c[1] = cubic ? rates[i] : mean;
    if (cubic) {
      c[2] = (3.0 * mean - 2.0 * rates[i] - rates[i + 1]) / h;
      c[3] = (rates[i] + rates[i + 1] - 2.0 * mean) / (h * h);
    }
  }
  pieces.push_back(piece(times.back(), values.back()));
  return Curve(std::move(pieces));
}

}  // namespace seacrane
