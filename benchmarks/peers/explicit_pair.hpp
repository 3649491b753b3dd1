#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

/// Counters of a run.
struct Work {
  long steps = 0, rejected = 0, evaluations = 0;
};

/// Classical RK4 at equal steps, ending at t1.
template <class Rate>
void rk4(Rate &&rate, std::vector<double> &y, double t0, double t1,
         double longest, Work &work) {
  const std::size_t n = y.size();
  static thread_local std::vector<double> k1, k2, k3, k4, z;
  for (auto *v : {&k1, &k2, &k3, &k4, &z})
    v->resize(n);
  const long count = std::lround(std::ceil((t1 - t0) / longest - 1e-9));
  const double h = (t1 - t0) / double(count);
  for (long step = 0; step < count; ++step) {
    const double t = t0 + double(step) * h;
    rate(t, y.data(), k1.data());
    for (std::size_t i = 0; i < n; ++i)
      z[i] = y[i] + 0.5 * h * k1[i];
    rate(t + 0.5 * h, z.data(), k2.data());
    for (std::size_t i = 0; i < n; ++i)
      z[i] = y[i] + 0.5 * h * k2[i];
    rate(t + 0.5 * h, z.data(), k3.data());
    for (std::size_t i = 0; i < n; ++i)
      z[i] = y[i] + h * k3[i];
    rate(t + h, z.data(), k4.data());
    for (std::size_t i = 0; i < n; ++i)
      y[i] += h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
    work.evaluations += 4;
    ++work.steps;
  }
}

/// Embedded explicit pair with error control, on a tableau of seacrane (rows of
/// a, the last one the solution; weights of the error). Steps end at the
/// outputs; the step length is kept across them.
template <class Tableau> class ExplicitPair {
public:
  ExplicitPair(std::vector<double> scale, double tolerance)
      : scale_(std::move(scale)), tolerance_(tolerance) {
    for (auto &k : k_)
      k.resize(scale_.size());
    z_.resize(scale_.size());
    for (std::size_t s = 0; s <= stages; ++s) {
      for (std::size_t j = 0; j < s; ++j)
        a_[s][j] = double(Tableau::a[s][j]), c_[s] += a_[s][j];
      e_[s] = double(Tableau::error[s]);
    }
  }

  template <class Rate>
  void advance(Rate &&rate, std::vector<double> &y, double t, double t1,
               Work &work) {
    if (!started_)
      rate(t, y.data(), k_[0].data()), ++work.evaluations, started_ = true;
    while (t1 - t > 1e-12 * t1) {
      const bool last = t + 1.01 * h_ >= t1;
      const double h = last ? t1 - t : h_;
      for (std::size_t s = 1; s <= stages; ++s) {
        combine(a_[s], s, h, y);
        rate(t + c_[s] * h, z_.data(), k_[s].data());
        ++work.evaluations;
      }
      const double error = norm(h);
      if (!std::isfinite(error) && h < 1e-9)
        throw std::runtime_error("steps vanish");
      const double factor =
          std::isfinite(error)
              ? std::clamp(0.9 * std::pow(error, -1.0 / Tableau::order), 0.2,
                           5.0)
              : 0.2;
      if (error <= 1.0) {
        t += h;
        y.swap(z_);
        k_[0].swap(k_[stages]);
        ++work.steps;
        h_ = last ? std::max(h_, h * factor) : h * factor;
        if (last)
          return;
      } else {
        h_ = h * factor;
        ++work.rejected;
      }
    }
  }

private:
  static constexpr std::size_t stages = Tableau::stages;

  void combine(const double *a, std::size_t s, double h,
               const std::vector<double> &y) {
    std::copy(y.begin(), y.end(), z_.begin());
    for (std::size_t j = 0; j < s; ++j) {
      if (a[j] == 0.0)
        continue;
      const double w = h * a[j];
      for (std::size_t i = 0; i < z_.size(); ++i)
        z_[i] += w * k_[j][i];
    }
  }

  double norm(double h) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < scale_.size(); ++i) {
      double e = 0.0;
      for (std::size_t s = 0; s <= stages; ++s)
        e += e_[s] * k_[s][i];
      e *= h / (tolerance_ * scale_[i]);
      sum += e * e;
    }
    return std::sqrt(sum / double(scale_.size()));
  }

  std::vector<double> scale_, z_;
  double tolerance_, h_ = 0.01;
  bool started_ = false;
  std::vector<double> k_[stages + 1];
  double a_[stages + 1][stages + 1] = {}, c_[stages + 1] = {},
                                 e_[stages + 1] = {};
};
