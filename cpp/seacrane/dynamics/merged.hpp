#pragma once

#include <memory>
#include <string>
#include <vector>

#include "seacrane/dynamics/redundant.hpp"

namespace seacrane {

/// Bodies' states of a model to those of the model with merged bodies, and back: poses and twists move
/// between the state points, all else is the same.
void merge_state(const Model& full, const Model& merged, const double* bodies, double* y);
void spread_state(const Model& full, const Model& merged, const double* y, double* bodies);

/// A formulation of the merged bodies of a model, told from and to the states of the described ones.
class MergedSystem final : public Formulation {
 public:
  MergedSystem(const std::string& formulation, const Model& full);

  std::size_t size() const override { return stepped().size(); }
  void derivative(double t, const double* y, double* ydot) override { stepped().derivative(t, y, ydot); }
  bool project(double t, double* y, bool evaluated_here) override {
    return stepped().project(t, y, evaluated_here);
  }
  bool has_projection() const override { return stepped().has_projection(); }
  bool jacobian(double t, const double* y, double* out) override { return stepped().jacobian(t, y, out); }
  double condition() const override { return stepped().condition(); }
  Dependence take_dependence() override { return stepped().take_dependence(); }
  PositionMap& positions() override { return stepped().positions(); }
  void load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) override {
    stepped().load_response(load, acceleration);
  }
  const char* name() const override { return stepped().name(); }
  std::vector<double> scale() const override { return stepped().scale(); }
  void read_bodies(double t, const double* bodies, double* y) override;
  void write_bodies(double t, const double* y, double* bodies) override;
  const std::vector<Vec6d>& accelerations() override;
  double take_residual_before_projection() override { return stepped().take_residual_before_projection(); }
  std::string describe(std::size_t component) const override { return stepped().describe(component); }
  RedundantSystem& loads_from() override { return terms_; }

 private:
  Formulation& stepped() const { return *stepped_; }

  const Model& full_;
  const Model& merged_;
  RedundantSystem terms_;
  std::unique_ptr<Formulation> reduced_;  // null: the terms themselves are stepped
  Formulation* stepped_;
  std::vector<double> bodies_;  // state of the merged bodies
  std::vector<Vec6d> acceleration_;
};

}  // namespace seacrane
