#include "seacrane/dynamics/recursive/recursive.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

#include "seacrane/dynamics/constraints.hpp"
#include "seacrane/dynamics/projection.hpp"
#include "seacrane/dynamics/recursive/tree_branches.hpp"
#include "seacrane/dynamics/state_names.hpp"
#include "seacrane/math/clones.hpp"

namespace seacrane {

template class TreeKinematics<double>;
template class ArticulatedTree<double>;

namespace {

/// Angular velocity, inertial axes, of a quaternion and its rate: the vector part of 2 q' q^-1.
Vec3d turning_of(const Vec4d& q, const Vec4d& rate) {
  const Vec3d v = q.tail<3>(), v_rate = rate.tail<3>();
  return 2.0 / q.squaredNorm() * (q[0] * v_rate - rate[0] * v - v_rate.cross(v));
}

}  // namespace

RecursiveSystem::RecursiveSystem(std::shared_ptr<Terms> terms)
    : terms_(std::move(terms)),
      model_(terms_->model()),
      own_(model_, {model_.bodies.begin(), model_.bodies.end()}),
      tree_(own_.tree()),
      articulated_(own_.articulated()),
      driven_(own_.driven()),
      loops_(model_, tree_),
      tensions_(model_),
      actuators_(model_, tree_),
      residual_(VecXd::Zero(loops_.rows())),
      loop_bias_(VecXd::Zero(loops_.rows())) {
  if (model_.paper_kinematics) {
    throw std::invalid_argument(
        "formulation 'recursive' needs a symmetric mass matrix, which kinematics 'paper' has not; choose "
        "formulation 'redundant'");
  }
  if (model_.description.baumgarte > 0.0) {
    throw std::invalid_argument(
        "formulation 'recursive' closes loops by projection; set baumgarte to 0 or choose formulation "
        "'redundant'");
  }
  if (!tree_.refused.empty()) {
    throw std::invalid_argument("formulation 'recursive': " + tree_.refused +
                                "; choose formulation 'redundant'");
  }
  const auto bodies = idx(model_.body_count());
  mass_.assign(bodies, Mat6d::Zero());
  for (std::size_t b = 0; b < bodies; ++b) mass_[b].diagonal().head<3>().setConstant(model_.bodies[b].mass);
  for (auto* vectors : {&load_, &acceleration_, &twist_, &direction_}) {
    vectors->assign(bodies + 1, Vec6d::Zero());
  }
  along_.assign(bodies + 1, Wrench<double>::zero());
  scratch_.assign(bodies + 1, BodyKinematics<double>::ground());
  blocks_.resize(model_.elements.size());
  speed_rate_.assign(idx(tree_.speeds), 0.0);
  position_rate_.assign(idx(tree_.positions), 0.0);
  inertial_speed_rates_ = MatXd::Zero(tree_.speeds, tensions_.count());
  force_response_.resize(static_cast<std::size_t>(tensions_.count()));
  keeps_terms_ = loops_.rows() > 0;
  layout_.speeds = tree_.positions;
  layout_.memory = layout_.speeds + tree_.speeds;
  layout_.work = layout_.memory + model_.layout.work - model_.layout.memory;
  layout_.size = layout_.work + 2;
  followed_.assign(idx(layout_.size), 0.0);
  choose_rows();
  find_near();
}

/// A tension moves the trees that it acts on, where nothing joins them and nothing drives them.
void RecursiveSystem::find_near() {
  near_.resize(idx(tensions_.count()));
  const auto driven = [](const Cluster& c) { return c.is_driven(); };
  if (loops_.rows() > 0 || std::ranges::any_of(tree_.clusters, driven)) return;
  const std::vector<int> root = roots_of(tree_, model_.body_count());
  std::vector<std::vector<int>> moved(near_.size());
  for (std::size_t i = 0; i < near_.size(); ++i) {
    const std::vector<int>& bodies = tensions_.bodies(static_cast<Eigen::Index>(i));
    for (std::size_t c = 0; c < tree_.clusters.size(); ++c) {
      const int own = root[idx(tree_.clusters[c].body)];
      if (std::ranges::none_of(bodies, [&](int b) { return root[idx(b)] == own; })) continue;
      near_[i].push_back(c);
      for (const Member& m : tree_.clusters[c].members) moved[i].push_back(m.body);
    }
  }
  tensions_.confine(std::move(moved));
}

/// Where the model is assembled; the sets of limits that are compiled on the way are not.
void RecursiveSystem::choose_rows() {
  if (loops_.rows() == 0 || model_.assembly.rank == 0) return;
  std::vector<double> y(idx(layout_.size));
  read_bodies(0.0, model_.initial_state.data(), y.data());
  place_as_given(y.data());
  evaluate_constraints(model_, 0.0, terms_->curve_limit(), terms_->bodies().data(), blocks_.data());
  loops_.choose_rows(blocks_.data(), terms_->bodies().data(), articulated_);
}

std::vector<double> RecursiveSystem::scale() const {
  std::vector<double> out = tree_.scales(model_.translation_scale, model_.rotation_scale);
  out.insert(out.end(), model_.scale.begin() + model_.layout.memory, model_.scale.end());
  return out;
}

/// What drivers prescribe: the state with it, and its rates.
const double* RecursiveSystem::followed(double t, const double* y) {
  if (!driven_.any()) return y;
  followed_.assign(y, y + layout_.size);
  driven_.follow(t, terms_->curve_limit(), followed_.data(), followed_.data() + layout_.speeds,
                 own_.driven_rate().data());
  return followed_.data();
}

void RecursiveSystem::place(double t, const double* y) { place_as_given(followed(t, y)); }

void RecursiveSystem::place_as_given(const double* y) {
  articulated_.place(y, y + layout_.speeds, terms_->kinematics());
}

/// Keeps mass matrices where they are asked for, of compact bodies the part that turns with the body.
void RecursiveSystem::evaluate_inertia(double t, const double* y) {
  struct Kept {
    Mat6d* mass;  // by body; null: not asked for
    void operator()(int body, const SpatialInertia<double>& inertia) const {
      if (mass) mass[body] = inertia.matrix();
    }
    void operator()(int body, const CompactInertia<double>& inertia) const {
      if (mass) inertia.turning.write(mass[body].bottomRightCorner<3, 3>());
    }
  };
  const std::vector<Mat6d>& added = terms_->evaluate_added_inertia(t, y + layout_.memory);
  own_.evaluate_inertia(terms_->bodies().data(), terms_->frames().data(),
                        added.empty() ? nullptr : added.data(), Kept{keeps_terms_ ? mass_.data() : nullptr});
}

void RecursiveSystem::factor(double t, const double* y) {
  evaluate_inertia(t, y);
  articulated_.factor();
  if (loops_.rows() == 0) return;
  evaluate_constraints(model_, t, terms_->curve_limit(), terms_->bodies().data(), blocks_.data());
  loops_.factor(blocks_.data(), mass_.data(), terms_->bodies().data(), articulated_);
}

void RecursiveSystem::derivative(double t, const double* y, double* ydot) { evaluate(t, y, ydot, true); }

/// Within a step what drivers prescribe is integrated, as what hangs on it is: at a stage both are off alike,
/// where their difference would be of a stiff line's. The rates are exact, and project() sets the values.
SEACRANE_CLONES("avx2")
void RecursiveSystem::evaluate(double t, const double* y, double* ydot, bool actuators_on_tree) {
  evaluated_at_ = t;
  keeps_terms_ = loops_.rows() > 0 || !actuators_on_tree;
  followed(t, y);
  place_as_given(y);
  terms_->follow_yaw();
  factor(t, y);
  evaluate_wrenches(t, y, ydot, actuators_on_tree);
  solve_acceleration(ydot + layout_.speeds);
  own_.read_forces(forces_);
  if (tensions_.any()) add_inertial_tensions(ydot + layout_.speeds);
  if (loops_.rows() > 0) loops_.add_driver_power(blocks_.data(), loops_.multipliers(), *terms_);
  for (std::size_t k = 0; k < driven_.count(); ++k) terms_->add_driver_power(driven_.power(k, forces_));
  if (loops_.rows() > 0) {
    kept_acceleration_ = acceleration_;
    kept_multipliers_ = loops_.multipliers();
  }
  articulated_.kinematics().position_rates(y, y + layout_.speeds, terms_->bodies().data(), ydot);
  ydot[layout_.work] = terms_->power().sum;
  ydot[layout_.work + 1] = terms_->power().absolute;
}

/// Evaluates wrenches, and the actuators' torques: on the speeds, or as wrenches on the bodies, which the
/// Jacobian needs.
void RecursiveSystem::evaluate_wrenches(double t, const double* y, double* ydot, bool actuators_on_tree) {
  const double* const memory = y + layout_.memory;
  std::ranges::fill(own_.torque(), 0.0);
  if (!actuators_on_tree) return terms_->evaluate_wrenches(t, memory, ydot + layout_.memory);
  terms_->evaluate_wrenches(t, memory, ydot + layout_.memory, actuators_.others());
  LoadSum<double> sum{nullptr};
  actuators_.apply<double>(terms_->load_input(t, memory), articulated_.kinematics(), y, y + layout_.speeds,
                           own_.torque().data(), sum,
                           [&](std::size_t k, const LoadInput<double>& in, double value, double rate) {
                             const TreeActuators::Along& one = actuators_.along()[k];
                             return one.list->force(one.at, in, value, rate);
                           });
  terms_->add_power({sum.power, sum.absolute_power});
}

/// Under the wrenches of the terms and the torques of the actuators.
void RecursiveSystem::solve_acceleration(double* u_rate) {
  solve_with_loops(u_rate);
  if (!loops_.misses(blocks_.data(), acceleration_.data())) return;
  loops_.factor_all(blocks_.data(), mass_.data(), terms_->bodies().data(), articulated_);
  solve_with_loops(u_rate);
}

void RecursiveSystem::solve_with_loops(double* u_rate) {
  const double *const torque = own_.torque().data(), *const driven = own_.driven_rate().data();
  for (int b = 0; b < model_.body_count(); ++b) {
    const Wrench<double> load = own_.load(b, terms_->applied(b));
    articulated_.set_load(b, load);
    if (keeps_terms_) load_[idx(b)] = load.vector();
  }
  articulated_.solve(true, u_rate, torque, driven);
  articulated_.write_accelerations(acceleration_.data());
  if (loops_.rows() == 0) return;
  loops_.acceleration_residual(blocks_.data(), acceleration_.data(), residual_);
  loops_.add_load(blocks_.data(), loops_.solve(residual_), load_.data());
  articulated_.solve(load_.data(), true, acceleration_.data(), u_rate, torque, driven);
}

/// With what speeds change; where `near` knows which, no others.
void RecursiveSystem::respond_to_tension(Eigen::Index i, double* u_rate) {
  const std::vector<std::size_t>& near = near_[idx(i)];
  std::vector<Vec6d>& response = tensions_.response(i);
  if (near.empty()) {
    load_response(tensions_.unit(i), response);
    std::ranges::copy(speed_rate_, u_rate);
    return;
  }
  articulated_.rest(near);
  for (const InertialTension::Pull& p : tensions_.pulls(i)) articulated_.push(p.body, p.unit());
  articulated_.respond(near, u_rate);
  for (const std::size_t c : near) {
    for (const Member& m : tree_.clusters[c].members) {
      const Twist<double>& a = articulated_.acceleration(m.body);
      response[idx(m.body)] << a.linear(), a.angular();
    }
  }
}

void RecursiveSystem::add_inertial_tensions(double* u_rate) {
  tensions_.start(*terms_, acceleration_.data());
  for (Eigen::Index i = 0; i < tensions_.count(); ++i) {
    respond_to_tension(i, inertial_speed_rates_.col(i).data());
    own_.read_forces(force_response_[idx(i)], near_[idx(i)]);
  }
  const VecXd& tension = tensions_.finish(*terms_);
  if (loops_.rows() > 0) {  // whose multipliers the responses have overwritten
    solve_acceleration(u_rate);
    own_.read_forces(forces_);
    return;
  }
  for (Eigen::Index i = 0; i < tensions_.count(); ++i) {
    const std::vector<double>& response = force_response_[idx(i)];
    for (std::size_t k = 0; k < forces_.size(); ++k) forces_[k] += tension[i] * response[k];
  }
  if (keeps_terms_) tensions_.add_loads(tension, load_.data());
  tensions_.add_accelerations(acceleration_);
  for (Eigen::Index i = 0; i < tensions_.count(); ++i) {
    const double pull = tension[i], *const rates = inertial_speed_rates_.col(i).data();
    const auto add = [&](int first, int count) {
      for (int k = first; k < first + count; ++k) u_rate[k] += pull * rates[k];
    };
    if (near_[idx(i)].empty()) add(0, tree_.speeds);
    for (const std::size_t c : near_[idx(i)]) add(tree_.clusters[c].u, tree_.clusters[c].speeds);
  }
}

double RecursiveSystem::condition(double t, const double* y) {
  std::vector<double> rate(size());
  evaluate(t, y, rate.data(), false);
  return std::max(articulated_.condition(mass_.data()), loops_.condition());
}

/// Of a branch as the tree holds it; of a cut joint and of a driver in rows its multiplier.
double RecursiveSystem::tension(int element) const {
  const ElementModel& e = model_.elements[idx(element)];
  if (const auto link = own_.link(element)) {
    return e.unique_reaction ? forces_[*link] : std::numeric_limits<double>::quiet_NaN();
  }
  const int row = loops_.row_of(element);
  if (row >= 0 && (e.driver || e.unique_reaction)) return (e.driver ? 1.0 : -1.0) * kept_multipliers_[row];
  return driven_.force(element, forces_, evaluated_at_, terms_->curve_limit(), followed_.data());
}

void RecursiveSystem::take_solution(double t, const double* y, const LaneOf& solution) {
  evaluated_at_ = t;
  followed(t, y);
  const double* next = solution.values + solution.lane;
  const auto take = [&](double& value) {
    value = *next;
    next += solution.lanes;
  };
  for (int b = 0; b < model_.body_count(); ++b) std::ranges::for_each(acceleration_[idx(b)], take);
  forces_.resize(own_.force_count());
  std::ranges::for_each(forces_, take);
  inertial_.resize(tensions_.count());
  std::ranges::for_each(inertial_, take);
  terms_->set_inertial(inertial_);
}

bool RecursiveSystem::jacobian(double t, const double* y, double* out) {
  if (!jacobian_) {
    jacobian_.emplace(model_, tree_);
    jacobian_rate_.resize(size());
  }
  evaluate(t, y, jacobian_rate_.data(), false);
  if (!loops_.regular()) return false;
  if (!tree_.coupled.empty()) terms_->evaluate_couplings(direction_.data());
  jacobian_->evaluate({*terms_, articulated_, loops_, tensions_, mass_.data(), load_.data(),
                       acceleration_.data(), blocks_.data(), driven_, forces_},
                      t, y, jacobian_rate_.data(), out);
  return true;
}

void RecursiveSystem::move(double h, double* y) {
  place_as_given(y);
  articulated_.kinematics().position_rates(y, y + layout_.speeds, terms_->bodies().data(),
                                           position_rate_.data());
  for_each_quaternion(tree_, [&](int at) {
    const Vec4d q = view<4>(y + at);
    const Vec4d turned = rotate_quaternion(h * turning_of(q, view<4>(&position_rate_[idx(at)])), q);
    view<4>(&position_rate_[idx(at)]) = (turned - q) / h;
  });
  for (int i = 0; i < tree_.positions; ++i) y[i] += h * position_rate_[idx(i)];
}

/// q -= (rates of the positions at `velocities`, speeds of an impulse).
void RecursiveSystem::move_positions(double* y, const Vec6d* velocities) {
  scratch_ = terms_->bodies();
  for (int b = 0; b < model_.body_count(); ++b) {
    scratch_[idx(b)].angular_velocity = velocities[b].tail<3>();
  }
  articulated_.kinematics().position_rates(y, speed_rate_.data(), scratch_.data(), position_rate_.data());
  for (int i = 0; i < tree_.positions; ++i) y[i] -= position_rate_[idx(i)];
}

void RecursiveSystem::twists_here() {
  for (int b = 0; b < model_.body_count(); ++b) {
    const BodyKinematics<double>& k = terms_->bodies()[idx(b)];
    twist_[idx(b)] = k.twist().vector();
  }
}

/// Takes over what drivers prescribe. Where it jumps in rate, the driven bodies strike the others; whether
/// they do.
bool RecursiveSystem::follow_drivers(double t, double* y) {
  double* const u = y + layout_.speeds;
  const double limit = terms_->curve_limit();
  const bool jumps = driven_.jump(t, limit, y, u, own_.jump());
  driven_.follow(t, limit, y, u, own_.driven_rate().data());
  if (jumps) strike(t, y);
  return jumps;
}

/// The impulse of jumps of the driven speeds on the others.
void RecursiveSystem::strike(double t, double* y) {
  place_as_given(y);
  terms_->follow_yaw();
  factor(t, y);
  own_.strike(speed_rate_.data(), y + layout_.speeds);
}

bool RecursiveSystem::project(double t, double* y, bool evaluated_here) {
  bool moved_before = false;
  for_each_quaternion(tree_, [&](int at) { moved_before |= normalise_drifted(view<4>(y + at)); });
  if (driven_.any()) moved_before |= follow_drivers(t, y);
  if (loops_.rows() == 0) return moved_before || driven_.any();
  if (!evaluated_here || moved_before) {
    place(t, y);
    terms_->follow_yaw();
    factor(t, y);
  }
  const auto open = [&] {
    loops_.position_residual(blocks_.data(), residual_);
    return residual_.cwiseAbs().maxCoeff();
  };
  const double worst = open();
  before_projection_ = std::max(before_projection_, worst);
  const auto impulse = [&] {
    for (auto& load : load_) load.setZero();
    loops_.add_load(blocks_.data(), loops_.solve(residual_), load_.data());
    articulated_.solve(load_.data(), false, acceleration_.data(), speed_rate_.data());
  };
  const double tolerance = position_tolerance(terms_->bodies().data(), model_.body_count());
  const bool moved = projection::close_positions(worst, tolerance, [&](int /*i*/) {
    impulse();
    move_positions(y, acceleration_.data());
    place(t, y);
    terms_->follow_yaw();
    factor(t, y);
    return open();
  });
  const bool turned = projection::close_rates(
      [&] {
        twists_here();
        loops_.rate_residual(blocks_.data(), twist_.data(), residual_);
        return residual_.cwiseAbs().maxCoeff();
      },
      [&] {
        impulse();
        for (int k = 0; k < tree_.speeds; ++k) y[layout_.speeds + k] -= speed_rate_[idx(k)];
        place(t, y);
      });
  return moved_before || moved || turned || driven_.any();
}

double RecursiveSystem::take_residual_before_projection() {
  const double out = before_projection_;
  before_projection_ = 0.0;
  return out;
}

void RecursiveSystem::read_bodies(double t, const double* bodies, double* y) {
  terms_->read(t, bodies);
  articulated_.read(terms_->bodies().data(), y, y + layout_.speeds);
  std::copy_n(bodies + model_.layout.memory, layout_.size - layout_.memory, y + layout_.memory);
}

void RecursiveSystem::write_bodies(double t, const double* y, double* bodies) {
  place(t, y);
  const StateLayout& s = model_.layout;
  for (int b = 0; b < s.bodies; ++b) {
    const BodyKinematics<double>& k = terms_->bodies()[idx(b)];
    double* pose = bodies + s.pose(b);
    view<3>(pose) = k.position;
    if (s.pose_size == 7) {
      view<4>(pose + 3) = quaternion_from_rotation(k.rotation);
    } else {
      view<3>(pose + 3) = euler_xyz_from_rotation(k.rotation);
    }
    view<6>(bodies + s.twist(b)) << k.velocity, k.angular_velocity;
  }
  std::copy_n(y + layout_.memory, layout_.size - layout_.memory, bodies + s.memory);
}

std::string RecursiveSystem::describe(std::size_t component) const {
  const int i = static_cast<int>(component);
  const auto within = [](int at, int first, int count) { return at >= first && at < first + count; };
  for (const Cluster& c : tree_.clusters) {
    const bool position = within(i, c.q, c.positions);
    const bool speed = within(i, layout_.speeds + c.u, c.speeds);
    if (!position && !speed) continue;
    const std::string of = c.kind == Cluster::floating
                               ? "body '" + model_.bodies[idx(c.body)].name + "'"
                               : "joint '" + model_.elements[idx(c.element)].name + "'";
    return (position ? "coordinate " + std::to_string(i - c.q)
                     : "speed " + std::to_string(i - layout_.speeds - c.u)) +
           " of " + of;
  }
  return i < layout_.work ? describe_memory(model_, i - layout_.memory) : "work integral";
}

void RecursiveSystem::load_response(const std::vector<Vec6d>& load, std::vector<Vec6d>& acceleration) {
  articulated_.solve(load.data(), false, acceleration.data(), speed_rate_.data());
  if (loops_.rows() == 0) return;
  // Rows know gamma - D a: without gamma, the difference from that of bodies at rest.
  std::ranges::fill(load_, Vec6d::Zero());
  loops_.acceleration_residual(blocks_.data(), load_.data(), loop_bias_);
  loops_.acceleration_residual(blocks_.data(), acceleration.data(), residual_);
  residual_ -= loop_bias_;
  std::ranges::copy(load, load_.begin());
  loops_.add_load(blocks_.data(), loops_.solve(residual_), load_.data());
  articulated_.solve(load_.data(), false, acceleration.data(), speed_rate_.data());
}

void RecursiveSystem::load_direction(const std::vector<Vec6d>& load, double* power, double* rates) {
  for (double* const out : {power, rates}) std::fill_n(out, size(), 0.0);
  load_response(load, direction_);
  std::ranges::copy(speed_rate_, rates + layout_.speeds);
  for (std::size_t b = 0; b < load.size(); ++b) along_[b] = Wrench<double>(load[b]);
  const TreeKinematics<double>& tree = articulated_.kinematics();
  for (auto c = tree_.clusters.rbegin(); c != tree_.clusters.rend(); ++c) {
    for (const Member& m : c->members) {
      const Wrench<double>& f = along_[idx(m.body)];
      for (int k = 0; k < c->speeds; ++k) power[layout_.speeds + c->u + k] += dot(tree.columns(m)[k], f);
      if (c->kind != Cluster::floating)
        along_[idx(c->parent)].add_shifted_from(tree.over_parent(m.body).reach, f);
    }
  }
}

}  // namespace seacrane
