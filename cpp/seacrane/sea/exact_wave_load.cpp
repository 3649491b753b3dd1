#include "seacrane/sea/exact_wave_load.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <utility>

#include "seacrane/math/clones.hpp"
#include "seacrane/sea/require.hpp"
#include "seacrane/sea/sincos.hpp"

namespace seacrane {
namespace {

constexpr const char* object = ExactWaveLoad::object;

void check(const WaveComponents& waves, const Eigen::Ref<const Eigen::MatrixXcd>& transfer) {
  const auto rows = static_cast<Eigen::Index>(waves.size());
  sea::require(transfer.rows() == rows && transfer.cols() == 6, object, "shape of transfer",
               sea::pair_text(transfer.rows(), transfer.cols()),
               "give one row per wave component and six columns, " + sea::pair_text<Eigen::Index>(rows, 6));
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      const std::complex<double> x = transfer(i, j);
      if (std::isfinite(x.real()) && std::isfinite(x.imag())) continue;
      sea::require(false, object, "transfer" + sea::pair_text(i, j), x,
                   "give finite force per metre of wave amplitude");
    }
  }
}

void check(const WavePoint& point, const char* name) {
  sea::require(std::isfinite(point.x) && std::isfinite(point.y), object, name,
               sea::pair_text(point.x, point.y), "give finite x and y in m");
}

}  // namespace

ExactWaveLoad::ExactWaveLoad(WaveComponents waves, const Eigen::Ref<const Eigen::MatrixXcd>& transfer,
                             WavePoint position, WavePoint elevation_point)
    : waves_(std::move(waves)) {
  check(waves_, transfer);
  check(position, "position");
  check(elevation_point, "elevation_point");
  for (std::size_t i = 0; i < waves_.size(); ++i) {
    const double a = waves_.amplitude()[i];
    const double phase = waves_.phase_at(i, position.x, position.y);
    const double phase_there = waves_.phase_at(i, elevation_point.x, elevation_point.y);
    const std::complex<double> at_vessel = std::polar(a, phase);
    Coefficients c{};
    const auto set = [&c](std::size_t channel, std::complex<double> p) {
      c.real[channel / side][channel % side] = p.real();
      c.imaginary[channel / side][channel % side] = p.imag();
    };
    for (std::size_t j = 0; j < 6; ++j) {
      set(j, at_vessel * transfer(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
    set(6, phase_there == phase ? at_vessel : std::polar(a, phase_there));
    coefficients_.push_back(c);
    largest_omega_ = std::max(largest_omega_, waves_.omega()[i]);
  }
}

template <std::size_t orders>
void ExactWaveLoad::add(std::size_t first, std::size_t count, const double* cosine, const double* sine,
                        Sums<orders>& sums) const {
  for (std::size_t i = 0; i < count; ++i) {
    const Coefficients& c = coefficients_[first + i];
    const double omega = waves_.omega()[first + i];
    double re = cosine[i], im = -sine[i];
    for (std::size_t k = 0; k < orders; ++k) {
      for (std::size_t p = 0; p < packs; ++p) sums[k][p] += c.real[p] * re + c.imaginary[p] * im;
      // d/dt of (cos, -sin) is omega (-sin, -cos).
      const double turned = -omega * re;
      re = omega * im;
      im = turned;
    }
  }
}

template <std::size_t orders>
void ExactWaveLoad::sum(double t, double (&out)[orders][lanes]) const {
  constexpr std::size_t chunk = 64;  // sines and cosines held on the stack
  double sine[chunk], cosine[chunk];
  Sums<orders> sums = {};
  for (std::size_t first = 0; first < coefficients_.size(); first += chunk) {
    const std::size_t count = std::min(chunk, coefficients_.size() - first);
    sea::sincos_of(waves_.omega().data() + first, count, largest_omega_, t, sine, cosine);
    add<orders>(first, count, cosine, sine, sums);
  }
  for (std::size_t k = 0; k < orders; ++k) std::memcpy(out[k], sums[k], sizeof(sums[k]));
}

ExactWaveLoad::KnotPhases::KnotPhases(const ExactWaveLoad& load, double step)
    : omega_(load.waves_.omega()),
      turn_cosine_(omega_.size()),
      turn_sine_(omega_.size()),
      cosine_(omega_.size()),
      sine_(omega_.size()),
      largest_omega_(load.largest_omega_),
      step_(step) {
  sea::sincos_of(omega_.data(), omega_.size(), largest_omega_, step, turn_sine_.data(), turn_cosine_.data());
}

SEACRANE_CLONES("avx2")
void ExactWaveLoad::KnotPhases::turn() {
  for (std::size_t i = 0; i < omega_.size(); ++i) {
    const double cosine = cosine_[i], sine = sine_[i];
    cosine_[i] = cosine * turn_cosine_[i] - sine * turn_sine_[i];
    sine_[i] = sine * turn_cosine_[i] + cosine * turn_sine_[i];
  }
}

void ExactWaveLoad::KnotPhases::move_to(std::int64_t number) {
  const std::int64_t begin = number - ((number % restart) + restart) % restart;
  if (!(begin <= number_ && number_ <= number)) {
    sea::sincos_of(omega_.data(), omega_.size(), largest_omega_, static_cast<double>(begin) * step_,
                   sine_.data(), cosine_.data());
    number_ = begin;
  }
  for (; number_ < number; ++number_) turn();
}

SEACRANE_CLONES("avx2")
void ExactWaveLoad::evaluate(const KnotPhases& phases, double* value, double* rate,
                             double* acceleration) const {
  Sums<3> sums = {};
  add<3>(0, coefficients_.size(), phases.cosine_.data(), phases.sine_.data(), sums);
  double out[3][lanes];
  std::memcpy(out, sums, sizeof(sums));
  std::copy_n(out[0], wave_channels, value);
  std::copy_n(out[1], wave_channels, rate);
  std::copy_n(out[2], wave_channels, acceleration);
}

void ExactWaveLoad::evaluate(double t, double* out) const {
  double sums[1][lanes];
  sum(t, sums);
  std::copy_n(sums[0], wave_channels, out);
}

void ExactWaveLoad::evaluate(double t, double* value, double* rate, double* acceleration) const {
  double sums[3][lanes];
  sum(t, sums);
  std::copy_n(sums[0], wave_channels, value);
  std::copy_n(sums[1], wave_channels, rate);
  std::copy_n(sums[2], wave_channels, acceleration);
}

std::array<WaveChannels, 2> ExactWaveLoad::bounds() const {
  std::array<WaveChannels, 2> sum{};
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    const double factor = std::pow(waves_.omega()[i], 12);
    for (std::size_t j = 0; j < wave_channels; ++j) {
      const double size = std::abs(coefficient(i, j));
      sum[0][j] += size;
      sum[1][j] += factor * size;
    }
  }
  return sum;
}

}  // namespace seacrane
