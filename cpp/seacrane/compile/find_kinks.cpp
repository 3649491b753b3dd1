#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "seacrane/compile/steps.hpp"
#include "seacrane/dynamics/maximal.hpp"

namespace seacrane {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A driver prescribes value and rate of its coordinate: their jumps are those of states.
LoadKinks driver_kinks(const Curve& curve) {
  LoadKinks out;
  for (const CurveKink& kink : curve.kinks()) {
    LoadKink of{kink.time, Eigen::Matrix<double, 1, 4>::Zero()};
    of.jump << std::abs(kink.jump(0)) + std::abs(kink.jump(1)), kink.jump(2), kink.jump(3), 0.0;
    out.push_back(std::move(of));
  }
  return out;
}

class Finder {
 public:
  explicit Finder(const Model& model) : model_(model) {}

  std::vector<Kink> run() {
    model_.loads.for_each([&](const LoadList& list, std::size_t i) { load(list, i); });
    for (const DriverData& driver : model_.drivers) {
      const LoadKinks found = driver_kinks(driver.curve);
      if (!found.empty()) add(found, of_driver(driver));
    }
    std::stable_sort(out_.begin(), out_.end(), [](const Kink& a, const Kink& b) { return a.time < b.time; });
    return std::move(out_);
  }

 private:
  void load(const LoadList& list, std::size_t i) {
    for (LoadKinks found : list.kinks(i)) {
      std::erase_if(found, [](const LoadKink& kink) { return kink.jump.isZero(0.0); });
      if (found.empty()) continue;
      add(found, of_load(list, i, static_cast<int>(found.front().jump.rows())));
    }
  }

  LoadInput<double> input() {
    return system().terms().load_input(0.0, model_.initial_state.data() + model_.layout.memory);
  }

  /// Evaluated where there is a kink at all.
  MaximalSystem& system() {
    if (!system_) {
      system_.emplace(std::shared_ptr<const Model>(&model_, [](const Model*) {}));
      std::vector<double> rate(system_->size());
      system_->derivative(0.0, model_.initial_state.data(), rate.data());
      for (auto* bodies : {&wrenches_, &acceleration_})
        bodies->assign(idx(model_.body_count()) + 1, Vec6d::Zero());
      for (auto* rows : {&right_, &multipliers_}) rows->assign(idx(model_.rows()), 0.0);
    }
    return *system_;
  }

  /// Accelerations over the scales of the velocities, by state and component of a load.
  MatXd of_load(const LoadList& list, std::size_t i, int components) {
    const LoadInput<double> in = input();
    MatXd out(6 * model_.body_count(), components);
    for (int k = 0; k < components; ++k) {
      for (Vec6d& wrench : wrenches_) wrench.setZero();
      list.add_unit(i, k, in, wrenches_.data());
      out.col(k) = accelerate();
    }
    return out;
  }

  MatXd of_driver(const DriverData& driver) {
    system();
    for (Vec6d& wrench : wrenches_) wrench.setZero();
    double& row = right_[idx(model_.elements[idx(driver.element)].row)];
    row = 1.0;
    const MatXd out = accelerate();
    row = 0.0;
    return out;
  }

  MatXd accelerate() {
    system().solver().solve(wrenches_, right_, acceleration_, multipliers_);
    MatXd out(6 * model_.body_count(), 1);
    for (int b = 0; b < model_.body_count(); ++b) {
      for (int i = 0; i < 6; ++i) {
        out(6 * b + i, 0) =
            std::abs(acceleration_[idx(b)][i]) / model_.scale[idx(model_.layout.twist(b) + i)];
      }
    }
    return out;
  }

  void add(const LoadKinks& found, const MatXd& response) {
    const auto sizes = [&](const Eigen::Matrix<double, Eigen::Dynamic, 4>& jump) {
      std::array<double, 4> out{};
      for (const int p : {0, 1, 2, 3}) out[idx(p)] = (response * jump.col(p).cwiseAbs()).maxCoeff();
      return out;
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
      Kink kink{found[i].time, kInfinity, sizes(found[i].jump), {}};
      kink.alone = kink.jump;
      if (i > 0 && i + 1 < found.size()) {
        kink.span = half_gap(found, i);
        kink.alone = sizes(found[i].jump - 0.5 * kink.span * (density(found, i - 1) + density(found, i + 1)));
      }
      out_.push_back(kink);
    }
  }

  /// Half the time between the neighbours; at the ends, where there is one, the time to it.
  static double half_gap(const LoadKinks& found, std::size_t i) {
    const std::size_t a = i > 0 ? i - 1 : i, b = i + 1 < found.size() ? i + 1 : i;
    return (found[b].time - found[a].time) / static_cast<double>(b - a);
  }

  static Eigen::Matrix<double, Eigen::Dynamic, 4> density(const LoadKinks& found, std::size_t i) {
    return found[i].jump / half_gap(found, i);
  }

  const Model& model_;
  std::optional<MaximalSystem> system_;
  std::vector<Vec6d> wrenches_, acceleration_;
  std::vector<double> right_, multipliers_;
  std::vector<Kink> out_;
};

}  // namespace

std::vector<Kink> find_kinks(const Model& model) { return Finder(model).run(); }

}  // namespace seacrane
