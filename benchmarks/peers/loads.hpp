#pragma once

#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

/// Arrays by name as `system.write_tree` writes them.
struct TreeData {
  std::map<std::string, std::vector<double>> arrays;

  explicit TreeData(const std::string &path) {
    std::ifstream file(path);
    if (!file)
      throw std::runtime_error("cannot open " + path);
    std::string key;
    std::size_t count = 0;
    while (std::getline(file, key, '\t') && file >> count) {
      std::vector<double> values(count);
      for (double &value : values)
        file >> value;
      arrays[key] = values;
      file.ignore();
    }
  }

  const std::vector<double> &at(const std::string &key) const {
    const auto found = arrays.find(key);
    if (found == arrays.end())
      throw std::runtime_error("no array '" + key + "'");
    return found->second;
  }
};

constexpr int coordinates = 20;
enum Coordinate {
  surge,
  sway,
  heave,
  yaw,
  pitch,
  roll,
  slew,
  main_stroke = 9,
  knuckle_stroke = 13
};

/// Quintic from rest to rest: value and rate.
struct Quintic {
  double t0, t1, from, to;

  std::array<double, 2> at(double t) const {
    const double u = std::fmin(std::fmax((t - t0) / (t1 - t0), 0.0), 1.0),
                 w = u * (1.0 - u);
    return {from + (to - from) * u * u * u * (10.0 - 15.0 * u + 6.0 * u * u),
            (to - from) * 30.0 * w * w / (t1 - t0)};
  }
};

/// Generalised loads of the vessel's water, waves and moorings, and of the
/// three controllers, in the coordinates of the tree: x, y, z, yaw, pitch, roll
/// of the hull's reference point, then the joints.
class Loads {
public:
  explicit Loads(const TreeData &d)
      : damping_(d.at("damping")), restoring_(d.at("restoring")),
        mooring_stiffness_(d.at("mooring stiffness")),
        mooring_damping_(d.at("mooring damping")), omega_(d.at("wave omega")),
        real_(d.at("wave force_real")), imaginary_(d.at("wave force_imag")) {
    const auto &lift = d.at("lift");
    const auto &hull = d.at("body vessel");
    // Restoring holds the hull's weight: it is taken back, together with the
    // lift, at the common point.
    const double weight = hull[0] * d.at("gravity")[0];
    lift_ = lift[0] + weight;
    for (int i = 0; i < 3; ++i)
      point_[i] = (lift[0] * lift[1 + i] + weight * hull[1 + i]) / lift_;
    const std::array<const char *, 3> names{"A", "main_cylinder",
                                            "knuckle_cylinder"};
    for (int i = 0; i < 3; ++i) {
      const auto &a = d.at(std::string("actuator ") + names[i]);
      controllers_[i] = {a[0], a[1], a[2], {a[3], a[4], a[5], a[6]}};
    }
  }

  void operator()(double t, const double *q, const double *v,
                  double *load) const {
    for (int i = 0; i < coordinates; ++i)
      load[i] = 0.0;
    water(t, q, v, load);
    const std::array<int, 3> places{slew, main_stroke, knuckle_stroke};
    for (int i = 0; i < 3; ++i) {
      const auto &c = controllers_[i];
      const auto [value, rate] = c.reference.at(t);
      load[places[i]] = c.feed_forward + c.stiffness * (value - q[places[i]]) +
                        c.damping * (rate - v[places[i]]);
    }
  }

private:
  struct Controller {
    double stiffness, damping, feed_forward;
    Quintic reference;
  };

  void water(double t, const double *q, const double *v, double *load) const {
    const double cy = std::cos(q[yaw]), sy = std::sin(q[yaw]),
                 cp = std::cos(q[pitch]), sp = std::sin(q[pitch]);
    const double cr = std::cos(q[roll]), sr = std::sin(q[roll]);
    // twist and wrench about the reference point in the frame that follows yaw
    const std::array<double, 6> u{cy * v[surge] + sy * v[sway],
                                  cy * v[sway] - sy * v[surge],
                                  v[heave],
                                  cp * v[roll],
                                  v[pitch],
                                  v[yaw] - sp * v[roll]};
    std::array<double, 6> w{};
    for (std::size_t k = 0; k < omega_.size(); ++k) {
      const double c = std::cos(omega_[k] * t), s = std::sin(omega_[k] * t);
      for (int i = 0; i < 6; ++i)
        w[i] += real_[6 * k + i] * c - imaginary_[6 * k + i] * s;
    }
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j)
        w[i] -= damping_[6 * i + j] * u[j];
    }
    // arm of the lift in the same frame: Ry(pitch) Rx(roll) point
    const double across = cr * point_[1] - sr * point_[2],
                 up = sr * point_[1] + cr * point_[2];
    w[2] += lift_;
    w[3] += across * lift_;
    w[4] -= (cp * point_[0] + sp * up) * lift_;

    const std::array<double, 3> eta{q[heave], q[roll], q[pitch]};
    std::array<double, 3> r{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        r[i] += restoring_[6 * (2 + i) + 2 + j] * eta[j];
    }
    load[surge] = cy * w[0] - sy * w[1] - mooring_stiffness_[0] * q[surge] -
                  mooring_damping_[0] * v[surge];
    load[sway] = sy * w[0] + cy * w[1] - mooring_stiffness_[1] * q[sway] -
                 mooring_damping_[1] * v[sway];
    load[heave] = w[2] - r[0];
    load[roll] = cp * w[3] - sp * w[5] - r[1];
    load[pitch] = w[4] - r[2];
    load[yaw] =
        w[5] - mooring_stiffness_[2] * q[yaw] - mooring_damping_[2] * v[yaw];
  }

  std::vector<double> damping_, restoring_, mooring_stiffness_,
      mooring_damping_, omega_, real_, imaginary_;
  double lift_ = 0.0;
  std::array<double, 3> point_{};
  std::array<Controller, 3> controllers_{};
};
