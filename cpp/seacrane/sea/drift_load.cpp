#include "seacrane/sea/drift_load.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <utility>

#include "seacrane/sea/require.hpp"
#include "seacrane/sea/sincos.hpp"

namespace seacrane {

DriftLoad::DriftLoad(WaveComponents waves, const Eigen::Ref<const Eigen::MatrixXd>& coefficient,
                     WavePoint position)
    : waves_(std::move(waves)) {
  const auto count = static_cast<Eigen::Index>(waves_.size());
  sea::require(coefficient.rows() == count && coefficient.cols() == 6, object, "shape of coefficient",
               sea::pair_text(coefficient.rows(), coefficient.cols()),
               "give one row per wave component and six columns, " + sea::pair_text<Eigen::Index>(count, 6));
  sea::require(std::isfinite(position.x) && std::isfinite(position.y), object, "position",
               sea::pair_text(position.x, position.y), "give finite x and y in m");
  for (Eigen::Index i = 0; i < count; ++i) {
    Row row{};
    for (Eigen::Index j = 0; j < 6; ++j) {
      if (!std::isfinite(coefficient(i, j))) {
        sea::require_finite(coefficient(i, j), object, "coefficient" + sea::pair_text(i, j),
                            "N/m2 or N m/m2");
      }
      row[static_cast<std::size_t>(j)] = coefficient(i, j);
    }
    row[6] = 1.0;
    rows_.push_back(row);
    const auto n = static_cast<std::size_t>(i);
    const std::complex<double> p =
        std::polar(waves_.amplitude()[n], waves_.phase_at(n, position.x, position.y));
    real_.push_back(p.real());
    imaginary_.push_back(p.imag());
    largest_omega_ = std::max(largest_omega_, waves_.omega()[n]);
  }
}

template <std::size_t orders>
void DriftLoad::sum(double t, Sums (&out)[orders]) const {
  constexpr std::size_t chunk = 64;  // sines and cosines held on the stack
  double sine[chunk], cosine[chunk];
  for (Sums& s : out) s = Sums{};
  for (std::size_t first = 0; first < rows_.size(); first += chunk) {
    const std::size_t count = std::min(chunk, rows_.size() - first);
    const double* omega = waves_.omega().data() + first;
    sea::sincos_of(omega, count, largest_omega_, t, sine, cosine);
    for (std::size_t i = 0; i < count; ++i) {
      const Row& row = rows_[first + i];
      const double p = real_[first + i], q = imaginary_[first + i];
      double re = p * cosine[i] - q * sine[i], im = p * sine[i] + q * cosine[i];
      for (Sums& s : out) {
        for (std::size_t j = 0; j < lanes; ++j) s.real[j] += row[j] * re;
        for (std::size_t j = 0; j < lanes; ++j) s.imaginary[j] += row[j] * im;
        const double turned = -omega[i] * im;  // d/dt multiplies by i omega
        im = omega[i] * re;
        re = turned;
      }
    }
  }
}

void DriftLoad::evaluate(double t, double* out) const {
  Sums s[1];
  sum(t, s);
  for (std::size_t j = 0; j < channels; ++j)
    out[j] = s[0].real[6] * s[0].real[j] + s[0].imaginary[6] * s[0].imaginary[j];
}

void DriftLoad::evaluate(double t, double* value, double* rate, double* acceleration) const {
  Sums s[3];
  sum(t, s);
  const auto product = [&s](int a, int b, std::size_t j) {
    return s[a].real[6] * s[b].real[j] + s[a].imaginary[6] * s[b].imaginary[j];
  };
  for (std::size_t j = 0; j < channels; ++j) {
    value[j] = product(0, 0, j);
    rate[j] = product(1, 0, j) + product(0, 1, j);
    acceleration[j] = product(2, 0, j) + 2.0 * product(1, 1, j) + product(0, 2, j);
  }
}

/// The double sum of an even power by the binomial theorem, about the middle of the band.
DriftLoad::Channels DriftLoad::magnitude(int order) const {
  const auto [low, high] = std::minmax_element(waves_.omega().begin(), waves_.omega().end());
  const double middle = 0.5 * (*low + *high);
  const auto moment = [&](int power, auto weight) {
    double out = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      out += waves_.amplitude()[i] * weight(i) * std::pow(waves_.omega()[i] - middle, power);
    return out;
  };
  Channels out{};
  double binomial = 1.0;
  for (int k = 0; k <= order; ++k) {
    const double envelope = moment(k, [](std::size_t) { return 1.0; });
    for (std::size_t j = 0; j < channels; ++j) {
      const double load = moment(order - k, [&](std::size_t i) { return std::fabs(rows_[i][j]); });
      out[j] += (k % 2 ? -binomial : binomial) * envelope * load;
    }
    binomial *= static_cast<double>(order - k) / (k + 1);
  }
  for (double& v : out) v = std::max(v, 0.0);
  return out;
}

}  // namespace seacrane
