#include "seacrane/dynamics/redundant.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/paper_kinematics.hpp"
#include "seacrane/elements/loads/registry.hpp"

namespace seacrane {
namespace {

constexpr double kEulerLimit = 1e-3;  // cos(phi_y); negative: a step jumped over +-90 deg

void add_transpose(const RowBlock<double>& block, int side, int rows, const double* lambda, Vec6d& out) {
  for (int r = 0; r < rows; ++r) out += block.d[side].row(r).transpose() * lambda[r];
}

}  // namespace

RedundantSystem::RedundantSystem(std::shared_ptr<const Model> model)
    : model_(std::move(model)), slots_(idx(model_->slot_count), 0.0) {
  const Model& m = *model_;
  const auto bodies = idx(m.body_count()), elements = m.elements.size(), rows = idx(m.rows());
  bodies_.assign(bodies + 1, BodyKinematics<double>::ground());
  wrench_.resize(bodies + 1);
  inertia_.resize(bodies);
  for (auto* vectors : {&bias_, &load_, &acceleration_, &impulse_})
    vectors->assign(bodies + 1, Vec6d::Zero());
  frames_.assign(m.vessels.size(), YawFrame<double>(BodyKinematics<double>::ground()));
  blocks_.resize(elements);
  over_mass_.assign(2 * elements, Mat6d::Zero());
  mass_.assign(bodies, Mat6d::Zero());
  values_.assign(m.schur.value_count(), 0.0);
  for (auto* values : {&lambda_, &gamma_, &residual_, &no_right_, &response_multipliers_}) {
    values->assign(rows, 0.0);
  }
  moved_.assign(idx(m.layout.size), 0.0);
  for (const WaveLoad& wave : m.wave_loads) waves_.emplace_back(wave.sources);
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const auto* tables = std::get_if<Convolution>(&m.vessels[v].memory);
    if (tables) convolutions_.emplace_back(v, RunningConvolution(*tables));
  }
  over_shape_.assign(2 * elements, Mat6d::Zero());
  dense_mass_.assign(bodies, Mat6d::Zero());
  shape_values_.assign(m.schur.value_count(), 0.0);
  if (6 * m.body_count() + m.rows() <= kDenseLimit) {
    dense_.emplace(m.body_count(), m.rows());
    row_space_.emplace(m.body_count(), m.rows());
  }
}

void RedundantSystem::read_state(double t, const double* y) {
  const Model& m = *model_;
  for (int b = 0; b < m.body_count(); ++b) {
    BodyKinematics<double>& k = bodies_[idx(b)];
    const double* pose = y + m.layout.pose(b);
    const double* twist = y + m.layout.twist(b);
    k.position = view<3>(pose);
    if (m.description.orientation == Orientation::quaternion) {
      k.rotation = rotation_from_quaternion<double>(view<4>(pose + 3));
    } else {
      k.rotation = rotation_from_euler_xyz<double>(view<3>(pose + 3));
      if (std::cos(pose[4]) < kEulerLimit) {
        throw std::domain_error("body '" + m.bodies[idx(b)].name + "': Euler angle phi_y is " +
                                std::to_string(pose[4] * 180.0 / 3.14159265358979323846) +
                                " deg at t = " + std::to_string(t) +
                                " s, where XYZ angles are singular; use orientation='quaternion'");
      }
    }
    k.velocity = view<3>(twist);
    k.angular_velocity = view<3>(twist + 3);
  }
  follow_yaw();
}

void RedundantSystem::follow_yaw() {
  for (std::size_t v = 0; v < model_->vessels.size(); ++v) {
    frames_[v] = YawFrame<double>(bodies_[idx(model_->vessels[v].body)]);
  }
}

const RunningConvolution* RedundantSystem::convolution(int vessel) const {
  for (const auto& [v, running] : convolutions_) {
    if (v == idx(vessel)) return &running;
  }
  return nullptr;
}

void RedundantSystem::evaluate_inertia() {
  const Model& m = *model_;
  for (int b = 0; b < m.body_count(); ++b) {
    const BodyModel& body = m.bodies[idx(b)];
    const BodyKinematics<double>& k = bodies_[idx(b)];
    if (body.vessel < 0) {
      bias_[idx(b)] = compact_inertia(body, k, inertia_[idx(b)]);
    } else {
      const auto v = idx(body.vessel);
      bias_[idx(b)] = vessel_inertia(body, m.vessels[v], k, frames_[v], inertia_[idx(b)]);
    }
  }
}

void RedundantSystem::evaluate_rows(double t) {
  evaluate_constraints(*model_, t, curve_limit_, bodies_.data(), blocks_.data());
}

void RedundantSystem::apply_hydrodynamics(const LoadInput<double>& input, const double* memory,
                                          double* memory_rate, LoadSum<double>& sum) {
  const Model& m = *model_;
  for (std::size_t v = 0; v < m.vessels.size(); ++v) {
    const Vessel& vessel = m.vessels[v];
    const int own = vessel.memory_offset - m.layout.memory;
    const double* x = memory + own;
    double* x_rate = memory_rate + own;
    if (m.paper_kinematics) {
      const auto b = idx(vessel.body);
      const PaperVessel paper(m.bodies[b], vessel, bodies_[b], x, x_rate);
      mass_[b] = paper.mass;
      wrench_[b].force += paper.load.head<3>();
      wrench_[b].moment += paper.load.tail<3>();
    } else {
      vessel.apply<double>(input, frames_[v], x, x_rate, sum);
    }
  }
  for (const auto& [v, memory] : convolutions_) {
    m.vessels[v].radiate(frames_[v], memory.evaluate(input.time, frames_[v].twist), sum);
  }
}

Vec3d RedundantSystem::wave_pose(const WaveLoad& wave, const double* memory) const {
  const Vessel& vessel = model_->vessels[idx(wave.vessel)];
  const Vec3d& place = bodies_[idx(wave.body)].position;
  const Vec3d pose(place.x(), place.y(), frames_[idx(wave.vessel)].yaw);
  if (!vessel.fast) return pose;
  const int own = vessel.memory_offset - model_->layout.memory + vessel.fluid_states();
  return pose - FastMotion::of(memory + own);
}

void RedundantSystem::apply_waves(double t, const double* memory, LoadSum<double>& sum) {
  const Model& m = *model_;
  for (std::size_t i = 0; i < m.wave_loads.size(); ++i) {
    const WaveLoad& wave = m.wave_loads[i];
    const YawFrame<double>& frame = frames_[idx(wave.vessel)];
    waves_[i].evaluate(t, wave_pose(wave, memory));
    const Vec6d force = waves_[i].sum();
    const Vec6d inertial = m.paper_kinematics ? force : frame.to_inertial(force);
    wrench_[idx(wave.body)].force += inertial.head<3>();
    wrench_[idx(wave.body)].moment += inertial.tail<3>();
    sum.add_power(force.dot(frame.twist));
  }
}

void RedundantSystem::evaluate_wrenches(double t, const double* memory, double* memory_rate) {
  const Model& m = *model_;
  for (auto& w : wrench_) w = BodyLoad<double>();
  const LoadInput<double> input = load_input(t);
  LoadSum<double> sum{wrench_.data()};
  for (const auto& load : m.gravity) load.apply<double>(input, sum);
  for_each_load_type([&]<class Load>() {
    for (const Load& load : std::get<std::vector<Load>>(*m.loads)) load.template apply<double>(input, sum);
  });
  apply_hydrodynamics(input, memory, memory_rate, sum);
  apply_waves(t, memory, sum);
  power_ = sum.power;
  absolute_power_ = sum.absolute_power;
}

void RedundantSystem::evaluate_loads(double t, const double* y, double* ydot) {
  const Model& m = *model_;
  evaluate_wrenches(t, y + m.layout.memory, ydot + m.layout.memory);
  for (int b = 0; b < m.body_count(); ++b) {
    Vec6d& load = load_[idx(b)];
    load << wrench_[idx(b)].force, wrench_[idx(b)].moment;
    // The paper's vessel carries its velocity terms in its own load.
    if (!(m.paper_kinematics && m.bodies[idx(b)].vessel >= 0)) load -= bias_[idx(b)];
  }
}

Mat6d RedundantSystem::mass_matrix(int body) const {
  const bool unsymmetric = model_->paper_kinematics && model_->bodies[idx(body)].vessel >= 0;
  return unsymmetric ? mass_[idx(body)] : symmetric_mass(body);
}

void RedundantSystem::factor() {
  const Model& m = *model_;
  for_each_side(m.elements, m.body_count(), [&](std::size_t e, int side, int body) {
    rows_over_mass(inertia_[idx(body)], blocks_[e].d[side], over_mass_[2 * e + idx(side)]);
  });
  m.schur.assemble(blocks_.data(), over_mass_.data(), values_.data());
  condition_ = m.schur.factor(values_.data());
  regular_ = !dense_ || (!m.redundant && condition_ <= kInaccuratePivot);
  if (!regular_) factor_dense();
}

double RedundantSystem::shape_condition() {
  const Model& m = *model_;
  for_each_side(m.elements, m.body_count(), [&](std::size_t e, int side, int body) {
    rows_over_shape(m.bodies[idx(body)], bodies_[idx(body)], blocks_[e].d[side],
                    over_shape_[2 * e + idx(side)]);
  });
  m.schur.assemble(blocks_.data(), over_shape_.data(), shape_values_.data());
  return m.schur.factor(shape_values_.data());
}

/// Lost digits come from light bodies, where pivoted LU keeps them, or from rows that depend on each
/// other, in redundant joints or near a singular position: there only the independent ones are enforced.
void RedundantSystem::factor_dense() {
  const Model& m = *model_;
  dependent_ = shape_condition() > kDependentPivot || m.redundant;
  if (dependent_) {
    const int rank =
        row_space_->factor(m.elements, blocks_.data(), over_shape_.data(), kEnforcedSingularValue);
    most_left_out_ = std::max(most_left_out_, m.rows() - rank);
  }
  for (int b = 0; b < m.body_count(); ++b) dense_mass_[idx(b)] = symmetric_mass(b);
  dense_->factor(m.elements, blocks_.data(), dense_mass_.data(), dependent_ ? &*row_space_ : nullptr);
}

Dependence RedundantSystem::take_dependence() {
  const Model& m = *model_;
  if (m.rows() == 0) return {};
  const int left_out = !regular_ && dependent_ ? m.rows() - row_space_->rank() : 0;
  redundant_ = redundant_rows(m, redundant_, left_out);
  // Rows redundant from the start leave nothing of the worst one, always.
  const bool hidden = redundant_ > 0 && redundant_ <= left_out;
  const double ratio = hidden ? std::pow(row_space_->singular_value(redundant_), -2) : condition_;
  return {ratio, redundant_, left_out, std::exchange(most_left_out_, 0)};
}

Mat6d RedundantSystem::symmetric_mass(int body) const {
  const BodyModel& b = model_->bodies[idx(body)];
  return b.vessel >= 0 ? inertia_[idx(body)].mass : rigid_mass_matrix(b, bodies_[idx(body)].rotation);
}

void RedundantSystem::multiplier_load(const double* lambda, std::vector<Vec6d>& out) const {
  const Model& m = *model_;
  for (auto& load : out) load.setZero();
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    add_transpose(blocks_[e], 0, element.rows, lambda + element.row, out[idx(element.first)]);
    add_transpose(blocks_[e], 1, element.rows, lambda + element.row, out[idx(element.second)]);
  }
}

void RedundantSystem::solve_acceleration() {
  const Model& m = *model_;
  const double beta = m.description.baumgarte;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    const RowBlock<double>& block = blocks_[e];
    for (int r = 0; r < element.rows; ++r) {
      double g = block.gamma[r];
      if (beta > 0.0) g -= beta * beta * block.phi[r] + 2.0 * beta * residual_[idx(element.row + r)];
      gamma_[idx(element.row + r)] = g;
    }
  }
  if (!regular_ || m.paper_kinematics) {
    solve_dense();
    return;
  }
  solve(load_, gamma_, acceleration_, lambda_);
}

void RedundantSystem::solve(const std::vector<Vec6d>& load, const std::vector<double>& right,
                            std::vector<Vec6d>& acceleration, std::vector<double>& lambda) {
  const Model& m = *model_;
  if (!regular_) {
    dense_->solve(load.data(), right.data(), acceleration.data(), lambda.data());
    return;
  }
  for (int b = 0; b < m.body_count(); ++b)
    acceleration[idx(b)] = solve_inertia(inertia_[idx(b)], load[idx(b)]);
  acceleration.back().setZero();
  lambda = right;
  for (std::size_t e = 0; e < m.elements.size(); ++e) {
    const ElementModel& element = m.elements[e];
    if (element.rows == 0) continue;
    const Vec6d free = blocks_[e].d[0] * acceleration[idx(element.first)] +
                       blocks_[e].d[1] * acceleration[idx(element.second)];
    for (int r = 0; r < element.rows; ++r) lambda[idx(element.row + r)] -= free[r];
  }
  m.schur.solve(values_.data(), lambda.data());
  multiplier_load(lambda.data(), impulse_);
  for (int b = 0; b < m.body_count(); ++b) {
    acceleration[idx(b)] += solve_inertia(inertia_[idx(b)], impulse_[idx(b)]);
  }
}

void RedundantSystem::solve_dense() {
  const Model& m = *model_;
  ++dense_solves_;
  if (m.paper_kinematics) {
    for (int b = 0; b < m.body_count(); ++b) dense_mass_[idx(b)] = mass_matrix(b);
    dense_->factor(m.elements, blocks_.data(), dense_mass_.data(), nullptr);
  }
  dense_->solve(load_.data(), gamma_.data(), acceleration_.data(), lambda_.data());
  if (m.paper_kinematics && !regular_) factor_dense();  // project() corrects in the symmetric metric
}

void RedundantSystem::write_pose_rates(const double* y, double* ydot) const {
  const Model& m = *model_;
  for (int b = 0; b < m.body_count(); ++b) {
    const BodyKinematics<double>& k = bodies_[idx(b)];
    double* pose = ydot + m.layout.pose(b);
    const double* angles = y + m.layout.pose(b) + 3;
    view<3>(pose) = k.velocity;
    if (m.description.orientation == Orientation::quaternion) {
      view<4>(pose + 3) = quaternion_rate<double>(view<4>(angles), k.angular_velocity);
    } else {
      view<3>(pose + 3) = euler_xyz_rate<double>(view<3>(angles), k.angular_velocity);
    }
  }
}

void RedundantSystem::write_rates(const double* y, double* ydot) {
  const Model& m = *model_;
  write_pose_rates(y, ydot);
  for (int b = 0; b < m.body_count(); ++b) view<6>(ydot + m.layout.twist(b)) = acceleration_[idx(b)];
  // Drivers do work lambda nu on the system.
  for (std::size_t e = m.elements.size() - m.drivers.size(); e < m.elements.size(); ++e) {
    add_driver_power(lambda_[idx(m.elements[e].row)] * blocks_[e].nu[0]);
  }
  ydot[m.layout.work] = power_;
  ydot[m.layout.work + 1] = absolute_power_;
}

void RedundantSystem::add_driver_power(double power) {
  power_ += power;
  absolute_power_ += std::abs(power);
}

void RedundantSystem::evaluate_terms(double t, const double* y, double* ydot) {
  read_state(t, y);
  evaluate_inertia();
  evaluate_rows(t);
  evaluate_loads(t, y, ydot);
}

void RedundantSystem::derivative(double t, const double* y, double* ydot) {
  evaluate_terms(t, y, ydot);
  if (model_->description.baumgarte > 0.0) rate_residual(y, residual_.data());
  factor();
  solve_acceleration();
  write_rates(y, ydot);
}

bool RedundantSystem::jacobian(double t, const double* y, double* out) {
  if (model_->paper_kinematics) return false;
  if (!jacobian_) {
    jacobian_.emplace(*model_);
    jacobian_rate_.resize(size());
  }
  derivative(t, y, jacobian_rate_.data());
  if (!missing_jacobian().empty()) return false;
  jacobian_->evaluate(*this, t, y, out);
  return true;
}

std::string RedundantSystem::missing_jacobian() const {
  if (model_->paper_kinematics) return "kinematics \"paper\" is not differentiated";
  if (!regular_ && dependent_) return "constraint rows depend on each other here";
  return "";
}

void RedundantSystem::read_bodies(double /*t*/, const double* bodies, double* y) {
  std::copy_n(bodies, size(), y);
}

void RedundantSystem::write_bodies(double /*t*/, const double* y, double* bodies) {
  std::copy_n(y, size(), bodies);
}

std::string RedundantSystem::describe(std::size_t component) const {
  static const char* axis[] = {"x", "y", "z"};
  const StateLayout& s = model_->layout;
  const int i = static_cast<int>(component);
  if (i < s.velocity) {
    const int k = i % s.pose_size;
    return std::string(k < 3 ? "position " : "orientation ") + (k < 3 ? axis[k] : std::to_string(k - 3)) +
           " of body '" + model_->bodies[idx(i / s.pose_size)].name + "'";
  }
  if (i < s.memory) {
    const int k = (i - s.velocity) % 6;
    return std::string(k < 3 ? "velocity " : "angular velocity ") + axis[k % 3] + " of body '" +
           model_->bodies[idx((i - s.velocity) / 6)].name + "'";
  }
  return i < s.work ? describe_memory(i - s.memory) : "work integral";
}

double RedundantSystem::energy(double t, const double* y) {
  read_state(t, y);
  evaluate_inertia();
  return energy_here(t, y);
}

double RedundantSystem::energy_here(double t, const double* y) const {
  const Model& m = *model_;
  const LoadInput<double> input = load_input(t);
  double sum = 0.0;
  for (int b = 0; b < m.body_count(); ++b) {
    const auto v = view<6>(y + m.layout.twist(b));
    sum += 0.5 * v.dot(mass_matrix(b) * v);
  }
  for (const auto& load : m.gravity) sum += load.potential(input);
  for_each_load_type([&]<class Load>() {
    if constexpr (requires(const Load& load) { load.potential(input); }) {
      for (const Load& load : std::get<std::vector<Load>>(*m.loads)) sum += load.potential(input);
    }
  });
  for (const auto& vessel : m.vessels) sum += vessel.potential(bodies_[idx(vessel.body)]);
  return sum;
}

}  // namespace seacrane
